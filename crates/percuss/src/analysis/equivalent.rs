//! The static force that does to a structure what an impact did to it at most: what engineers design against.
//!
//! It acts at the struck point along the line of flight, on the structure in its reference configuration, by linear elasticity:
//! its largest bending moment in the struck beam, or its deflection of the struck point, is that of the run.

use super::section_forces::{self, Acting, Lines};
use super::spectrum::{Layout, free_motions};
use super::static_search::{RULE, StaticSearch};
use crate::geometry::row::Row;
use crate::math::vec2::dot;
use crate::model::Model;
use crate::model::frozen::{Connector, ConnectorLaw, ProjectileData};
use crate::settings::Scheme;
use crate::state::State;
use crate::step::workspace::Workspace;
use crate::summary::{EquivalentForce, RunSummary};

/// Displacements of the linear solution against the size of the structure: so small that what is of second order is round-off.
const SMALL: f64 = 1e-7;

/// What a unit force at the struck point along the line of flight does to the structure at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitResponse {
    /// Deflection of the struck point along the force \[m/N\].
    pub deflection: f64,
    /// Largest magnitude of the bending moment in the struck beam \[N m/N\].
    pub moment: f64,
}

/// The equivalent static force of a run, if one guided projectile strikes an elastic structure at rest on which nothing else acts:
/// else its largest moment and deflection are not those of the impact alone. Neither are they where a stop takes part, which no linear
/// analysis knows, or a spring that is strained from the start.
pub fn equivalent_force(model: &Model, run: &RunSummary) -> Option<EquivalentForce> {
    let [projectile] = model.projectiles.as_slice() else { return None };
    let alone = model.contacts.len() == 1 && model.loads.is_empty() && model.motions.is_empty();
    let whole = run.joints.iter().all(|joint| joint.parted.is_none());
    if !whole || !alone || !model.is_still() || model.is_inelastic() || !has_slack_springs(model) {
        return None;
    }
    let unit = unit_response(model, projectile)?;
    let moment = run.section_forces[projectile.point.beam].moment.largest().value.abs();
    let along = (0..2).find(|k| projectile.direction[*k].abs() > 1.0 - 1e-12);
    let recorded = run.points.iter().find(|p| p.name == model.contacts[0].between[0]);
    let deflection = along.zip(recorded).map(|(k, p)| p.displacement_max[k].value.abs());
    Some(EquivalentForce {
        moment: moment / unit.moment,
        deflection: deflection.map(|d| d / unit.deflection),
    })
    .filter(|force| force.moment > 0.0)
}

/// Whether all springs are linear ones without force at the start.
fn has_slack_springs(model: &Model) -> bool {
    let start = State::at_rest(model, Scheme::EnergyMomentum);
    let linear = |c: &Connector| matches!(c.law, ConnectorLaw::Linear { .. });
    model
        .connectors
        .iter()
        .zip(&start.coordinates)
        .all(|(c, &q)| linear(c) && c.potential(q, &start.memories) == 0.0)
}

/// The response of the beams to a unit force where a projectile strikes; none where they can move freely.
pub fn unit_response(model: &Model, projectile: &ProjectileData) -> Option<UnitResponse> {
    let structure = &model.structure();
    let rest = State::at_rest(structure, Scheme::EnergyMomentum);
    let (point, direction) = (&projectile.point, projectile.direction);
    let mut search = StaticSearch::at(structure, &rest);
    if !free_motions(&Layout::new(structure), &search).motions.is_empty() {
        return None;
    }
    search.assemble::<true>();
    search.factor_assembled().ok()?;
    search.work.residual.fill([0.0; 4]);
    point.spread(direction.map(|d| -d), &mut search.work.residual);
    search.work.multiplier.fill(0.0);
    search.correction();
    let unit = dot(direction, point.value(&search.work.correction));
    let most =
        search.work.correction.iter().map(|u| u[0].abs().max(u[1].abs())).fold(0.0, f64::max);
    if !(most > 0.0 && most.is_finite()) {
        return None;
    }
    let force = SMALL * search.size() / most;
    let Workspace { increment, correction, multiplier, .. } = &mut search.work;
    for (d, u) in increment.iter_mut().zip(correction.iter()) {
        *d = u.map(|u| force * u);
    }
    multiplier.iter_mut().for_each(|m| *m *= force);
    search.assemble::<false>();
    let mut row = Row::default();
    let [n0, n1, n2, n3] = point.shape;
    let [e1, e2] = direction;
    row.add(point.node, [n0 * e1, n0 * e2, n1 * e1, n1 * e2]);
    row.add(point.node + 1, [n2 * e1, n2 * e2, n3 * e1, n3 * e2]);
    let state = search.state();
    let Workspace { increment, beams, .. } = &search.work;
    let acting =
        Acting { state: &search.base, increment, rule: &RULE, beams, forcing: &search.forcing };
    let (mut lines, mut forces) = (Lines::default(), section_forces::unset(structure));
    lines.set(structure, &acting, std::iter::once(([&row; 2], [force, 0.0])));
    section_forces::update(structure, &lines, &state, &mut forces);
    let moment = forces[point.beam].moment.largest().value.abs() / force;
    (unit > 0.0 && moment > 0.0).then_some(UnitResponse { deflection: unit, moment })
}
