//! Supports and joints as held components of nodes and as constraints with multipliers.

use super::builder::{ModelBuilder, locate};
use super::definition::*;
use super::fault::Fault;
use super::frozen::*;
use crate::math::vec2::{cross, dot, norm, rot90, scale};

/// A support holds a direction of the displacement, or of the slope.
#[derive(Clone, Copy)]
struct HeldDirection {
    direction: [f64; 2],
    gradient: bool,
}

/// Adds the supports: at nodes as held components, between nodes as constraints.
pub(super) fn supports(builder: &ModelBuilder, model: &mut Model) {
    for support in &builder.supports {
        let point = locate(model, &support.at);
        for held in held_directions(&support.kind, point.tangent) {
            match node_of(&point) {
                Some(node) => hold(model, node, held),
                None => {
                    let (direction, gradient) = (held.direction, held.gradient);
                    let point = point.clone();
                    model.constraints.push(Constraint::Held { point, direction, gradient });
                }
            }
        }
    }
    remove_dependent(model);
}

/// Adds the joints.
///
/// # Errors
/// A fault for a joint that repeats what supports and earlier joints already hold.
pub(super) fn joints(builder: &ModelBuilder, model: &mut Model) -> Result<(), Vec<Fault>> {
    let mut faults = Vec::new();
    for joint in &builder.joints {
        let points = [locate(model, &joint.between[0]), locate(model, &joint.between[1])];
        let before = model.constraints.len();
        for direction in [[1.0, 0.0], [0.0, 1.0]] {
            let points = Box::new(points.clone());
            model.constraints.push(Constraint::Shared { points, direction });
        }
        if joint.kind == JointKind::Rigid {
            let (ta, tb) = (points[0].tangent, points[1].tangent);
            let (cosine, sine) = (dot(tb, ta), cross(tb, ta));
            let points = Box::new(points);
            model.constraints.push(Constraint::Angle { points, cosine, sine });
        }
        remove_dependent(model);
        if model.constraints.len() == before {
            let found = "a joint between points that are held or joined already";
            let path = format!("joint.{}.between", joint.name);
            faults.push(Fault::new(path, found, "a joint that connects something"));
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

fn held_directions(kind: &SupportKind, tangent: [f64; 2]) -> Vec<HeldDirection> {
    let displacement = |direction| HeldDirection { direction, gradient: false };
    let slope = |direction| HeldDirection { direction, gradient: true };
    let (e1, e2) = (displacement([1.0, 0.0]), displacement([0.0, 1.0]));
    match kind {
        SupportKind::Clamp => vec![e1, e2, slope(rot90(tangent))],
        SupportKind::Pin => vec![e1, e2],
        SupportKind::Elastic { .. } | SupportKind::Stop { .. } => Vec::new(),
        SupportKind::Roller { direction } => {
            vec![displacement(rot90(scale(1.0 / norm(*direction), *direction)))]
        }
        SupportKind::Fix { components } => components
            .iter()
            .map(|c| match c {
                Component::Displacement1 => e1,
                Component::Displacement2 => e2,
                Component::Rotation => slope(rot90(tangent)),
                Component::Stretch => slope(tangent),
            })
            .collect(),
    }
}

fn node_of(point: &MaterialPoint) -> Option<usize> {
    if point.shape[0] == 1.0 {
        Some(point.node)
    } else if point.shape[2] == 1.0 {
        Some(point.node + 1)
    } else {
        None
    }
}

/// Holds one more direction at a node, unless it is held already (Gram-Schmidt).
fn hold(model: &mut Model, node: usize, held: HeldDirection) {
    let offset = if held.gradient { 2 } else { 0 };
    let mut normal = [0.0; 4];
    normal[offset] = held.direction[0];
    normal[offset + 1] = held.direction[1];
    let index = model.holds.iter().position(|h| h.node == node).unwrap_or_else(|| {
        model.holds.push(NodeHold { node, normals: Vec::new() });
        model.holds.len() - 1
    });
    let normals = &mut model.holds[index].normals;
    for n in normals.iter() {
        let along: f64 = (0..4).map(|k| n[k] * normal[k]).sum();
        (0..4).for_each(|k| normal[k] -= along * n[k]);
    }
    let size = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
    if size > 1e-9 {
        normals.push(normal.map(|c| c / size));
    }
}

/// Drops constraints that follow from held components and the constraints before them, so that no multiplier is
/// indeterminate (Gram-Schmidt on the constraint gradients of the reference configuration).
fn remove_dependent(model: &mut Model) {
    let mut basis: Vec<Vec<(usize, f64)>> = Vec::new();
    let mut kept = Vec::new();
    for constraint in std::mem::take(&mut model.constraints) {
        let mut row = reference_gradient(&constraint, model);
        let before = size(&row);
        for b in &basis {
            let along = -inner(&row, b);
            row = combine(&row, along, b);
        }
        let after = size(&row);
        if after > 1e-9 * before.max(1e-300) && after > 1e-9 {
            basis.push(row.into_iter().map(|(k, c)| (k, c / after)).collect());
            kept.push(constraint);
        }
    }
    model.constraints = kept;
}

/// Gradient in the reference configuration as (component, value) pairs in order, free components only.
fn reference_gradient(constraint: &Constraint, model: &Model) -> Vec<(usize, f64)> {
    let mut row = std::collections::BTreeMap::<usize, [f64; 4]>::new();
    let mut add = |point: &MaterialPoint, direction: [f64; 2], gradient: bool, sign: f64| {
        let n = if gradient { point.slope } else { point.shape };
        for (node, value, slope) in [(point.node, n[0], n[1]), (point.node + 1, n[2], n[3])] {
            let entry = row.entry(node).or_default();
            for i in 0..2 {
                entry[i] += sign * value * direction[i];
                entry[2 + i] += sign * slope * direction[i];
            }
        }
    };
    match constraint {
        Constraint::Held { point, direction, gradient } => add(point, *direction, *gradient, 1.0),
        Constraint::Shared { points, direction } => {
            add(&points[0], *direction, false, 1.0);
            add(&points[1], *direction, false, -1.0);
        }
        Constraint::Angle { points, .. } => {
            add(&points[0], rot90(points[0].tangent), true, 1.0);
            add(&points[1], rot90(points[1].tangent), true, -1.0);
        }
    }
    for hold in &model.holds {
        if let Some(entry) = row.get_mut(&hold.node) {
            for n in &hold.normals {
                let along: f64 = (0..4).map(|k| n[k] * entry[k]).sum();
                (0..4).for_each(|k| entry[k] -= along * n[k]);
            }
        }
    }
    row.into_iter()
        .flat_map(|(node, entry)| (0..4).map(move |k| (4 * node + k, entry[k])))
        .filter(|(_, value)| *value != 0.0)
        .collect()
}

fn size(row: &[(usize, f64)]) -> f64 {
    row.iter().map(|(_, c)| c * c).sum::<f64>().sqrt()
}

fn inner(a: &[(usize, f64)], b: &[(usize, f64)]) -> f64 {
    let value = |k: usize| b.binary_search_by_key(&k, |x| x.0).map_or(0.0, |i| b[i].1);
    a.iter().map(|(k, c)| c * value(*k)).sum()
}

/// `a + factor b`.
fn combine(a: &[(usize, f64)], factor: f64, b: &[(usize, f64)]) -> Vec<(usize, f64)> {
    let mut sum: std::collections::BTreeMap<usize, f64> = a.iter().copied().collect();
    for (k, c) in b {
        *sum.entry(*k).or_default() += factor * c;
    }
    sum.into_iter().collect()
}
