//! Where a contact of beams is likely to close first, and the effective mass there.

use crate::contact::configuration::Configuration;
use crate::contact::effective_mass::{EffectiveMass, mass_matrix};
use crate::contact::pair::{Memory, Pair};
use crate::contact::touch::{Reach, Touch};
use crate::math::vec2::{add, rot90, scale, sub};
use crate::model::{Model, TouchLaw};
use crate::step::tangent::{Singular, Tangent};

/// Times that the way to the first touch is estimated anew: on straight paths the second estimate is exact.
const ESTIMATES: usize = 4;

/// The mass matrix of the reference configuration, factored when it is first needed.
pub(super) type Factored = Option<Result<Tangent, Singular>>;

/// Effective mass of the beams of a contact under a rigid law where they are likely to touch first; none where no beam takes
/// part.
pub(super) fn effective_mass(
    model: &Model,
    contact: usize,
    factored: &mut Factored,
) -> Option<EffectiveMass> {
    let data = &model.contacts[contact];
    let pairs = &model.pairs[data.pairs.clone()];
    let beams = |pair: &Pair| pair.movers.iter().any(|m| *m < model.beams.len());
    if !matches!(data.law, TouchLaw::Rigid(_)) || !pairs.first().is_some_and(beams) {
        return None;
    }
    let rest = vec![[0.0; 4]; model.node_count()];
    let First { pair, touch, u, comes } = first_touch(model, pairs)?;
    let mass = factored.get_or_insert_with(|| mass_matrix(model, &rest)).as_mut().ok()?;
    let found = EffectiveMass::of_pair(model, mass, &u, pair, &touch)?;
    // Where nothing approaches, the nearest pair may be one that is held and will never close.
    (comes || found.on_mesh.is_finite()).then_some(found)
}

/// A pair that is likely to close first, with the displacements in which it does, and whether it approaches.
struct First<'a> {
    pair: &'a Pair,
    touch: Touch,
    u: Vec<[f64; 4]>,
    comes: bool,
}

/// How fast motions of the beams' nodes close the gap of a contact where it is likely to close first, one entry a motion.
pub(super) fn closing(model: &Model, contact: usize, motions: &[&[[f64; 4]]]) -> Option<Vec<f64>> {
    let data = &model.contacts[contact];
    let First { pair, touch, u, .. } = first_touch(model, &model.pairs[data.pairs.clone()])?;
    let row = pair.normal_row(&touch, &Configuration::of(&u));
    let mut all = vec![[0.0; 4]; model.node_count()];
    let each = motions.iter().map(|motion| {
        all[..motion.len()].copy_from_slice(motion);
        -row.on(&all)
    });
    Some(each.collect())
}

/// The pair that closes first in the motion that all things start with; where nothing approaches, the nearest one.
fn first_touch<'a>(model: &Model, pairs: &'a [Pair]) -> Option<First<'a>> {
    let velocity = velocities(model);
    let mut u = vec![[0.0; 4]; model.node_count()];
    let mut found = None;
    for _ in 0..ESTIMATES {
        let at = Configuration::of(&u);
        let seen = pairs.iter().filter_map(|pair| {
            let touch = pair.touch(model, &at, &Memory::default(), Reach::All)?;
            let rate = pair.normal_row(&touch, &at).on(&velocity);
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
        for (u, v) in u.iter_mut().zip(&velocity) {
            (0..4).for_each(|i| u[i] += time * v[i]);
        }
    }
    found.map(|(pair, touch, comes)| First { pair, touch, u, comes })
}

/// Velocities of all nodes at the start.
fn velocities(model: &Model) -> Vec<[f64; 4]> {
    let beams = model.beam_node_count();
    let each = model.nodes.iter().enumerate();
    each.map(|(i, node)| match i.checked_sub(beams) {
        None => {
            let own = model.own_motions.iter().rev().find(|(range, _)| range.contains(&i));
            let motion = own.map_or(&model.initial_motion, |(_, motion)| motion);
            let away = sub(node.position, motion.about);
            let v = add(motion.velocity, scale(motion.spin, rot90(away)));
            let g = scale(motion.spin, rot90(node.tangent));
            [v[0], v[1], g[0], g[1]]
        }
        Some(body) => {
            let body = &model.bodies[body];
            [body.velocity[0], body.velocity[1], body.spin, 0.0]
        }
    })
    .collect()
}
