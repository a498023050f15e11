//! Supports and joints as fixed components of nodes and as constraints with multipliers, with the unit vectors of shear-flexible beams.

use std::collections::BTreeMap;

use super::builder::ModelBuilder;
use super::connect::drive_of;
use super::definition::*;
use super::fault::Fault;
use super::frozen::*;
use super::material_points::locate;
use super::prescribed::Prescribed;
use crate::math::vec2::{cross, dot, norm, rot90, scale};

/// A support fixes a direction of the displacement, or of the slope.
#[derive(Clone, Copy)]
struct HeldDirection {
    /// The direction, of unit length, shape (2) \[-\].
    direction: [f64; 2],
    gradient: bool,
}

/// Adds supports, the joints between spans of a beam, and joints: permanent constraints first, then those of limited duration.
///
/// # Errors
/// A fault for a joint that is redundant with supports and earlier joints, and for supports that prescribe different values of the same component.
pub(super) fn all(builder: &ModelBuilder, model: &mut Model) -> Result<(), Vec<Fault>> {
    let held = model.prescribed.iter().enumerate().map(|(k, dofs)| (dofs.node, k)).collect();
    let mut independent = Independent {
        builder,
        held,
        basis: Vec::new(),
        touching: BTreeMap::new(),
        prescribed: Prescribed::default(),
    };
    for (index, support) in builder.supports.iter().enumerate() {
        if support.until == f64::INFINITY {
            prescribe_nodes(index, support, model, &mut independent);
        }
    }
    model.prescribed.sort_by_key(|h| h.node);
    for (index, support) in builder.supports.iter().enumerate() {
        if support.until == f64::INFINITY {
            constrain_points(index, support, model, &mut independent);
        }
    }
    lengths(model, &mut independent);
    corners(model, &mut independent);
    let mut faults = joints(builder, model, &mut independent);
    // Of two equal temporary constraints, the one with the longer duration is kept.
    let mut passing: Vec<(usize, &Support)> =
        builder.supports.iter().enumerate().filter(|(_, s)| s.until < f64::INFINITY).collect();
    passing.sort_by(|a, b| b.1.until.total_cmp(&a.1.until));
    for (index, support) in passing {
        constrain_points(index, support, model, &mut independent);
    }
    faults.extend(independent.prescribed.faults(model));
    if faults.is_empty() { Ok(()) } else { Err(faults) }
}

fn held_directions(support: &Support, tangent: [f64; 2]) -> Vec<HeldDirection> {
    let displacement = |direction| HeldDirection { direction, gradient: false };
    let slope = |direction| HeldDirection { direction, gradient: true };
    let (e1, e2) = (displacement([1.0, 0.0]), displacement([0.0, 1.0]));
    match &support.kind {
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

/// Whether a support rotates the tangent that it fixes.
fn turns(support: &Support) -> bool {
    support.motion.as_ref().is_some_and(|m| m.rotation != 0.0)
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

/// Fixes components of nodes; a prescribed rotation becomes a constraint.
fn prescribe_nodes(
    index: usize,
    support: &Support,
    model: &mut Model,
    independent: &mut Independent,
) {
    let Some(point) = model.supports[index].point.clone() else { return };
    let Some(node) = node_of(&point) else { return };
    for held in held_directions(support, point.tangent) {
        if held.gradient && turns(support) && dot(held.direction, point.tangent).abs() < 0.5 {
            continue;
        }
        let drive = if held.gradient {
            Vec::new()
        } else {
            drive_of(support, model, index, held.direction)
        };
        hold(model, independent, index, node, held, drive);
    }
}

/// Fixes one more direction at a node, unless it is fixed already (Gram-Schmidt).
fn hold(
    model: &mut Model,
    independent: &mut Independent,
    support: usize,
    node: usize,
    held: HeldDirection,
    mut drive: Drive,
) {
    let offset = if held.gradient { 2 } else { 0 };
    let mut normal = [0.0; 4];
    normal[offset] = held.direction[0];
    normal[offset + 1] = held.direction[1];
    let index = *independent.held.entry(node).or_insert_with(|| {
        model.prescribed.push(PrescribedDofs::new(node, Some(support)));
        model.prescribed.len() - 1
    });
    let at = &mut model.prescribed[index];
    for (n, own) in at.normals.iter().zip(&at.drives) {
        let along: f64 = (0..4).map(|k| n[k] * normal[k]).sum();
        (0..4).for_each(|k| normal[k] -= along * n[k]);
        drive.extend(own.iter().map(|(motion, a)| (*motion, -along * a)));
    }
    let size = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
    if size > 1e-9 {
        let drive = drive.into_iter().map(|(motion, a)| (motion, a / size)).collect();
        at.hold(normal.map(|c| c / size), drive);
        independent.prescribed.at_nodes.entry(node).or_default().push(support);
        return;
    }
    let others = independent.prescribed.at_nodes.get(&node).cloned().unwrap_or_default();
    let Independent { builder, prescribed, .. } = independent;
    let path = format!("support.{}", builder.supports[support].name);
    prescribed.check(builder, model, &path, &drive, others.into_iter().chain([support]));
}

/// Constraints of a support: between nodes, for a limited time, or of the rotation of the tangent.
fn constrain_points(
    index: usize,
    support: &Support,
    model: &mut Model,
    independent: &mut Independent,
) {
    let Some(point) = model.supports[index].point.clone() else { return };
    let for_ever = support.until == f64::INFINITY;
    for held in held_directions(support, point.tangent) {
        let turned =
            held.gradient && turns(support) && dot(held.direction, point.tangent).abs() < 0.5;
        if !turned && for_ever && node_of(&point).is_some() {
            continue; // fixed at its node
        }
        let (direction, gradient) = (held.direction, held.gradient);
        let (kind, drive) = if turned {
            let rotation = support.motion.as_ref().map_or(0.0, |m| m.rotation);
            let motion = model.supports[index].motion;
            let drive = motion.map(|m| (m, rotation)).into_iter().collect();
            (ConstraintKind::Turned { point: point.clone() }, drive)
        } else {
            let drive =
                if gradient { Vec::new() } else { drive_of(support, model, index, direction) };
            (ConstraintKind::Held { point: point.clone(), direction, gradient }, drive)
        };
        let constraint =
            Constraint { kind, support: Some(index), joint: None, drive, until: support.until };
        independent.keep(model, constraint, &format!("support.{}", support.name));
    }
}

/// Unit length of the vectors of the nodes of shear-flexible beams.
fn lengths(model: &mut Model, independent: &mut Independent) {
    for beam in 0..model.beams.len() {
        let path = format!("beam.{}", model.beams[beam].name);
        for span in model.beams[beam].spans.clone() {
            if model.spans[span].shear.is_none() {
                continue;
            }
            for k in 0..model.spans[span].nodes.len() {
                let kind = ConstraintKind::Length { point: node_point(model, beam, span, k) };
                let (drive, until) = (Vec::new(), f64::INFINITY);
                let constraint = Constraint { kind, support: None, joint: None, drive, until };
                independent.keep(model, constraint, &path);
            }
        }
    }
}

/// Rigid joints between the spans of each beam.
fn corners(model: &mut Model, independent: &mut Independent) {
    for beam in 0..model.beams.len() {
        for span in model.beams[beam].spans.clone().skip(1) {
            let end = end_point(model, beam, span - 1, true);
            let start = end_point(model, beam, span, false);
            let path = format!("beam.{}", model.beams[beam].name);
            join(model, independent, [end, start], (true, None), &path);
        }
    }
}

/// The point at the last or first node of a span.
fn end_point(model: &Model, beam: usize, span: usize, last: bool) -> MaterialPoint {
    let k = if last { model.spans[span].nodes.len() - 1 } else { 0 };
    node_point(model, beam, span, k)
}

/// The point at node `k` of a span.
fn node_point(model: &Model, beam: usize, span: usize, k: usize) -> MaterialPoint {
    let span = &model.spans[span];
    let (own, s) = (span.nodes.start + k, span.stations[k]);
    let frame = model.nodes[own];
    // No element begins at the last one.
    let (node, shape, slope) = if own + 1 == span.nodes.end {
        (own - 1, [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0])
    } else {
        (own, [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0])
    };
    let (position, tangent) = (frame.position, frame.tangent);
    let xi = shape[2];
    let (label, stretched) = (String::new(), None);
    MaterialPoint { label, beam, node, xi, s, shape, slope, position, tangent, stretched }
}

/// Adds the joints; returns faults of those without effect.
fn joints(builder: &ModelBuilder, model: &mut Model, independent: &mut Independent) -> Vec<Fault> {
    let mut faults = Vec::new();
    let parts = builder.joints.iter().any(|joint| joint.strength.is_some());
    for joint in &builder.joints {
        let points = [locate(model, &joint.between[0]), locate(model, &joint.between[1])];
        let rigid = joint.kind == JointKind::Rigid;
        let path = format!("joint.{}.between", joint.name);
        let own = joint.strength.map(|strength| {
            let most = |limit: Option<f64>| limit.unwrap_or(f64::INFINITY);
            let strength = [most(strength.force), most(strength.moment)];
            model.joints.push(JointData { name: joint.name.clone(), strength });
            model.joints.len() - 1
        });
        let kept = join(model, independent, points, (rigid, own), &path);
        if parts && kept != 0 && kept < 2 + usize::from(rigid) {
            // If one of them has failed, the others would have to carry its remaining force here.
            let found = "a joint that is partly redundant with supports or other joints, in a model whose joints can fail";
            faults.push(Fault::new(path, found, "joints without redundancy"));
            continue;
        }
        if kept == 0 && !matches!(joint.kind, JointKind::ElasticHinge { .. }) {
            let found = "a joint between points that are fixed or connected already";
            faults.push(Fault::new(path, found, "no redundant joint"));
        }
    }
    faults
}

/// Connects two points; returns the number of constraints.
fn join(
    model: &mut Model,
    independent: &mut Independent,
    points: [MaterialPoint; 2],
    (rigid, joint): (bool, Option<usize>),
    path: &str,
) -> usize {
    let (ta, tb) = (points[0].tangent, points[1].tangent);
    let shared = |direction| ConstraintKind::Shared { points: Box::new(points.clone()), direction };
    let mut kinds = vec![shared([1.0, 0.0]), shared([0.0, 1.0])];
    if rigid {
        let (cosine, sine) = (dot(tb, ta), cross(tb, ta));
        kinds.push(ConstraintKind::Angle { points: Box::new(points.clone()), cosine, sine });
    }
    let keep = |kind| {
        let until = f64::INFINITY;
        let constraint = Constraint { kind, support: None, joint, drive: Vec::new(), until };
        usize::from(independent.keep(model, constraint, path))
    };
    kinds.into_iter().map(keep).sum()
}

/// Keeps constraints that do not follow from fixed components and the constraints before them, so that no multiplier is indeterminate (Gram-Schmidt
/// on the constraint gradients of the reference configuration).
struct Independent<'b> {
    builder: &'b ModelBuilder,
    /// The constraints kept, shape (constraints kept).
    basis: Vec<Known>,
    /// Basis vectors that touch a component, by its number among all of the nodes, shape (such vectors) \[index in `basis`\].
    touching: BTreeMap<usize, Vec<usize>>,
    prescribed: Prescribed,
    /// Place of the prescribed values of a node in the model, until they are sorted by nodes.
    held: BTreeMap<usize, usize>,
}

/// A constraint kept, across those before it.
struct Known {
    row: BTreeMap<usize, f64>,
    /// The prescribed value, scaled like its row, shape (motions that take part) \[index of a motion, m or rad by the row's scale\].
    drive: Drive,
    /// Supports that prescribe it, shape (such supports) \[index of a support\].
    supports: Vec<usize>,
}

impl Independent<'_> {
    /// Adds the constraint to the model if it is independent; returns whether it was.
    fn keep(&mut self, model: &mut Model, constraint: Constraint, path: &str) -> bool {
        let supports = constraint.support.into_iter().collect();
        let mut known = Known { row: BTreeMap::new(), drive: constraint.drive.clone(), supports };
        self.reference_gradient(&constraint, model, &mut known);
        let before = size(&known.row);
        let mut others: Vec<usize> =
            known.row.keys().filter_map(|k| self.touching.get(k)).flatten().copied().collect();
        others.sort_unstable();
        others.dedup();
        // Twice is enough: the basis is orthonormal to round-off.
        for _ in 0..2 {
            for other in &others {
                let other = &self.basis[*other];
                let row = &mut known.row;
                let along: f64 =
                    other.row.iter().map(|(k, c)| c * row.get(k).unwrap_or(&0.0)).sum();
                for (k, c) in &other.row {
                    *row.entry(*k).or_default() -= along * c;
                }
                known.less(along, &other.drive, &other.supports);
            }
        }
        let after = size(&known.row);
        if after <= 1e-9 * before.max(1.0) {
            let Known { drive, supports, .. } = known;
            self.prescribed.check(self.builder, model, path, &drive, supports.into_iter());
            return false;
        }
        known.row.values_mut().for_each(|c| *c /= after);
        known.drive.iter_mut().for_each(|(_, a)| *a /= after);
        for k in known.row.keys() {
            self.touching.entry(*k).or_default().push(self.basis.len());
        }
        self.basis.push(known);
        model.constraints.push(constraint);
        true
    }
}

impl Known {
    /// Subtracts `along` times the value already prescribed in a fixed direction.
    fn less(&mut self, along: f64, drive: &Drive, supports: &[usize]) {
        self.drive.extend(drive.iter().map(|(motion, a)| (*motion, -along * a)));
        if along.abs() > 1e-9 {
            self.supports.extend_from_slice(supports);
        }
    }
}

impl Independent<'_> {
    /// Gradient in the reference configuration by component, free components only.
    fn reference_gradient(&self, constraint: &Constraint, model: &Model, known: &mut Known) {
        let mut row = BTreeMap::<usize, [f64; 4]>::new();
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
        match &constraint.kind {
            ConstraintKind::Held { point, direction, gradient } => {
                add(point, *direction, *gradient, 1.0)
            }
            ConstraintKind::Turned { point } => add(point, rot90(point.tangent), true, 1.0),
            ConstraintKind::Length { point } => add(point, point.tangent, true, 1.0),
            ConstraintKind::Shared { points, direction } => {
                add(&points[0], *direction, false, 1.0);
                add(&points[1], *direction, false, -1.0);
            }
            ConstraintKind::Angle { points, .. } => {
                add(&points[0], rot90(points[0].tangent), true, 1.0);
                add(&points[1], rot90(points[1].tangent), true, -1.0);
            }
        }
        for (node, entry) in &mut row {
            if let Some(dofs) = model.dofs_at(*node) {
                let owners = self.prescribed.at_nodes.get(&dofs.node);
                for (i, n) in dofs.normals.iter().enumerate() {
                    let along: f64 = (0..4).map(|k| n[k] * entry[k]).sum();
                    (0..4).for_each(|k| entry[k] -= along * n[k]);
                    let owner = owners.and_then(|o| o.get(i)).map_or(&[][..], std::slice::from_ref);
                    known.less(along, &dofs.drives[i], owner);
                }
            }
        }
        known.row = row
            .into_iter()
            .flat_map(|(node, entry)| (0..4).map(move |k| (4 * node + k, entry[k])))
            .filter(|(_, value)| *value != 0.0)
            .collect();
    }
}

fn size(row: &BTreeMap<usize, f64>) -> f64 {
    row.values().map(|c| c * c).sum::<f64>().sqrt()
}
