//! Estimate of the first contact to close, and of the effective mass and closing rates there.

use std::borrow::Cow;

use crate::geometry::configuration::Configuration;
use crate::geometry::pair::{Memory, Pair};
use crate::geometry::touch::{SearchRegion, Touch};
use crate::model::Model;
use crate::step::effective_mass::{EffectiveMass, mass_matrix};
use crate::step::tangent::{Singular, Tangent};

/// Number of repeated estimates of the distance to the first contact: on straight paths the second estimate is exact.
const ESTIMATES: usize = 4;

/// First touches of the contacts of a model, estimated in the reference configuration and the motion at the start.
pub struct FirstTouches<'m> {
    model: &'m Model,
    /// The mass matrix of the reference configuration, factored when it is first needed.
    mass: Option<Result<Tangent, Singular>>,
    /// No displacement of any node, shape (nodes, 4) \[m, -, rad\].
    rest: Vec<[f64; 4]>,
    /// Velocity of all nodes at the start, shape (nodes, 4) \[m/s, 1/s, rad/s\].
    velocity: Vec<[f64; 4]>,
}

/// A pair that is likely to close first, with its displacements then, and whether it approaches.
struct FirstTouch<'a> {
    pair: &'a Pair,
    touch: Touch,
    /// Displacements of the nodes, shape (nodes, 4) \[m, -, rad\].
    u: Cow<'a, [[f64; 4]]>,
    comes: bool,
}

impl<'m> FirstTouches<'m> {
    /// The motion at the start; other data are computed on request.
    pub fn new(model: &'m Model) -> Self {
        let rest = vec![[0.0; 4]; model.node_count()];
        Self { model, mass: None, rest, velocity: velocities(model) }
    }

    /// Effective mass of the beams of the contact of number `contact` under a rigid law at the likely first point of contact; `None` without a beam.
    pub fn effective_mass(&mut self, contact: usize) -> Option<EffectiveMass> {
        let model = self.model;
        let data = &model.contacts[contact];
        let pairs = &model.pairs[data.pairs.clone()];
        let beams = |pair: &Pair| pair.movers.iter().any(|m| *m < model.beams.len());
        if !data.law.is_rigid() || !pairs.first().is_some_and(beams) {
            return None;
        }
        let (rest, velocity) = (&self.rest, &self.velocity);
        let FirstTouch { pair, touch, u, comes } = first_touch(model, pairs, [rest, velocity])?;
        let mass = self.mass.get_or_insert_with(|| mass_matrix(model, rest)).as_mut().ok()?;
        let found = EffectiveMass::of_pair(model, mass, &u, pair, &touch)?;
        // Without an approaching pair, the closest one may be fixed and never close.
        (comes || found.on_mesh.is_finite()).then_some(found)
    }

    /// Rates at which motions of the beams' nodes close the gap of a contact where it is likely to close first, one entry for each motion; each
    /// motion has the shape (number of beam nodes).
    pub fn closing_rates(&self, contact: usize, motions: &[&[[f64; 4]]]) -> Option<Vec<f64>> {
        let model = self.model;
        let data = &model.contacts[contact];
        let FirstTouch { pair, touch, u, .. } =
            first_touch(model, &model.pairs[data.pairs.clone()], [&self.rest, &self.velocity])?;
        let row = pair.normal_row(&touch, &Configuration::of(&u));
        let mut all = vec![[0.0; 4]; model.node_count()];
        let each = motions.iter().map(|motion| {
            all[..motion.len()].copy_from_slice(motion);
            -row.on(&all)
        });
        Some(each.collect())
    }

    /// Number of pairs of a contact that touch at once, each under its law, as the corners of a flat end on a wall do: those whose
    /// gap in the reference configuration is the least one.
    pub fn simultaneous(&self, contact: usize) -> usize {
        let model = self.model;
        let gap = |pair: &Pair| {
            let at = Configuration::of(&self.rest);
            let touch = pair.touch(model, &at, &Memory::default(), SearchRegion::All);
            touch.map_or(f64::INFINITY, |touch| touch.gap)
        };
        let gaps: Vec<f64> =
            model.pairs[model.contacts[contact].pairs.clone()].iter().map(gap).collect();
        let least = gaps.iter().copied().fold(f64::INFINITY, f64::min);
        let size = model.beams.iter().map(|beam| beam.length).fold(0.0, f64::max);
        gaps.iter().filter(|gap| **gap - least <= 1e-9 * size).count().max(1)
    }
}

/// The pair that closes first in the initial motion of all bodies; without an approaching pair the closest one.
fn first_touch<'a>(
    model: &Model,
    pairs: &'a [Pair],
    [rest, velocity]: [&'a [[f64; 4]]; 2],
) -> Option<FirstTouch<'a>> {
    let mut u = Cow::Borrowed(rest);
    let mut found = None;
    for _ in 0..ESTIMATES {
        let at = Configuration::of(&u);
        let seen = pairs.iter().filter_map(|pair| {
            let touch = pair.touch(model, &at, &Memory::default(), SearchRegion::All)?;
            let rate = pair.normal_row(&touch, &at).on(velocity);
            let time = if rate < 0.0 { touch.gap.max(0.0) / -rate } else { f64::INFINITY };
            touch.gap.is_finite().then_some((pair, touch, time))
        });
        let sooner = |a: &(&Pair, Touch, f64), b: &(&Pair, Touch, f64)| {
            a.2.total_cmp(&b.2).then(a.1.gap.total_cmp(&b.1.gap))
        };
        let (pair, touch, time) = seen.min_by(sooner)?;
        found = Some((pair, touch, time.is_finite()));
        if !time.is_finite() || time == 0.0 {
            break;
        }
        for (u, v) in u.to_mut().iter_mut().zip(velocity) {
            (0..4).for_each(|i| u[i] += time * v[i]);
        }
    }
    found.map(|(pair, touch, comes)| FirstTouch { pair, touch, u, comes })
}

/// Velocities of all nodes at the start.
fn velocities(model: &Model) -> Vec<[f64; 4]> {
    let beams = (0..model.beam_node_count()).map(|node| model.initial_velocity(node));
    let bodies = model.bodies.iter();
    let bodies = bodies.map(|body| [body.velocity[0], body.velocity[1], body.spin, 0.0]);
    beams.chain(bodies).collect()
}
