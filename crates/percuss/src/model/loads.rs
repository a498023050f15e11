//! Loads placed on the mesh.

use super::builder::ModelBuilder;
use super::definition::*;
use super::frozen::*;
use super::material_points::{locate, point_at};
use super::time_function::{PreparedFunction, TimeFunction};
use crate::math::hermite::{GAUSS_WEIGHTS, gauss_points};

/// Adds the loads.
pub(super) fn place(builder: &ModelBuilder, model: &mut Model) {
    for load in &builder.loads {
        let kind = match &load.kind {
            LoadKind::Gravity { acceleration } => {
                LoadAction::Gravity { acceleration: *acceleration }
            }
            // Against a base that is accelerated, what has mass is as heavy the other way.
            LoadKind::Base { acceleration } => {
                LoadAction::Gravity { acceleration: acceleration.map(|a| -a) }
            }
            LoadKind::Point { at, force, moment, follower } => LoadAction::Point {
                point: locate(model, at),
                force: *force,
                moment: *moment,
                follower: *follower,
            },
            LoadKind::Strain { beam, stretch, strain, curvature } => {
                // Bending strains are positive where they turn the tangent clockwise.
                let of = |_: &Span| [*strain, -curvature];
                let elements = strained(model, beam.0 as usize, *stretch, of);
                LoadAction::Strain { elements, change: None }
            }
            LoadKind::Temperature { beam, stretch, change, gradient } => {
                let of = |span: &Span| [change, gradient].map(|rise| span.expansion * rise);
                let elements = strained(model, beam.0 as usize, *stretch, of);
                LoadAction::Strain { elements, change: Some(*change) }
            }
            LoadKind::Distributed { beam, stretch, force, follower } => {
                let points = distributed(model, beam.0 as usize, *stretch, *force);
                if *follower { LoadAction::Follower { points } } else { dead(&points) }
            }
        };
        let load = match load.kind {
            LoadKind::Base { .. } => &within_its_table(load),
            _ => load,
        };
        let function = PreparedFunction::new(&load.function);
        let (name, from, until) = (load.name.clone(), load.from, load.until);
        let base = matches!(load.kind, LoadKind::Base { .. });
        model.loads.push(LoadData { name, kind, function, base, from, until });
    }
}

/// The same load, acting only at the times of its table, if it has one: a record that ends with a small value does not push on for ever.
fn within_its_table(load: &Load) -> Load {
    let mut load = load.clone();
    if let TimeFunction::Table { times, .. } = &mut load.function
        && let [first, .., last] = times[..]
    {
        // What comes before `from` does not act.
        let start = first.max(0.0);
        load.until = load.until.min(load.from + last);
        load.from += start;
        times.iter_mut().for_each(|t| *t -= start);
    }
    load
}

/// Quadrature points of a force per length along a stretch of a beam; elements it covers in part count in part.
fn distributed(
    model: &Model,
    beam_index: usize,
    stretch: [Along; 2],
    force: [[f64; 2]; 2],
) -> Vec<FollowerPoint> {
    let beam = &model.beams[beam_index];
    let [from, to] = stretch.map(|along| match along {
        Along::Fraction(f) => f * beam.length,
        Along::Distance(s) => s,
    });
    let mut points = Vec::new();
    for span in &model.spans[beam.spans.clone()] {
        for w in span.stations.windows(2) {
            let (a, b) = (w[0].max(from), w[1].min(to));
            if b - a <= 1e-12 * beam.length {
                continue;
            }
            for (x, weight) in gauss_points().into_iter().zip(GAUSS_WEIGHTS) {
                let s = a + x * (b - a);
                let f = (s - from) / (to - from);
                let q = [0, 1].map(|i| force[0][i] + f * (force[1][i] - force[0][i]));
                let force = q.map(|q| q * weight * (b - a));
                points.push(FollowerPoint { point: point_at(model, beam_index, s), force });
            }
        }
    }
    points
}

/// Elements of a stretch of a beam with the membrane and bending strains given to those of each span; elements begin and end where it does.
fn strained(
    model: &Model,
    beam_index: usize,
    stretch: [Along; 2],
    of: impl Fn(&Span) -> [f64; 2],
) -> Vec<StrainedElement> {
    let beam = &model.beams[beam_index];
    let [from, to] = stretch.map(|along| match along {
        Along::Fraction(f) => f * beam.length,
        Along::Distance(s) => s,
    });
    let mut elements = Vec::new();
    for span in &model.spans[beam.spans.clone()] {
        let [strain, bending] = of(span);
        for (k, w) in span.stations.windows(2).enumerate() {
            let middle = 0.5 * (w[0] + w[1]);
            if middle > from && middle < to {
                let (node, element) = (span.nodes.start + k, span.elements.start + k);
                elements.push(StrainedElement { node, element, strain, bending });
            }
        }
    }
    elements
}

/// Nodal forces of a dead load.
fn dead(points: &[FollowerPoint]) -> LoadAction {
    let mut nodal: Vec<(usize, [f64; 4])> = Vec::new();
    let mut shares: Vec<(usize, [[f64; 4]; 2])> = Vec::new();
    for p in points {
        let n = &p.point.shape;
        if shares.last().is_none_or(|(node, _)| *node != p.point.node) {
            shares.push((p.point.node, [[0.0; 4]; 2]));
        }
        if let Some((_, share)) = shares.last_mut() {
            p.point.spread_over(p.force, share);
        }
        for (node, value, slope) in [(p.point.node, n[0], n[1]), (p.point.node + 1, n[2], n[3])] {
            let index = nodal.iter().rposition(|(k, _)| *k == node).unwrap_or_else(|| {
                nodal.push((node, [0.0; 4]));
                nodal.len() - 1
            });
            for i in 0..2 {
                nodal[index].1[i] += value * p.force[i];
                nodal[index].1[2 + i] += slope * p.force[i];
            }
        }
    }
    LoadAction::Dead { nodal, shares }
}
