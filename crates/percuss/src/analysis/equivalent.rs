//! The equivalent static force of an impact: the force with the same peak effect on the structure, as used in design.
//!
//! It acts at the struck point along the line of motion, in addition to weight, on the structure in its reference configuration, by linear
//! elasticity: its largest bending moment in the struck beam, or its deflection of the struck point, is that of the run. For a structure that
//! yielded it is the force on the same structure, assumed elastic.

use super::section_forces::{self, Acting, Lines};
use super::spectrum::{Layout, free_motions};
use super::static_search::{RULE, StaticSearch};
use crate::geometry::row::Row;
use crate::inspect::LoadView;
use crate::math::vec2::dot;
use crate::model::Model;
use crate::model::frozen::{ConnectorLaw, ProjectileData};
use crate::settings::{Scheme, Start};
use crate::state::State;
use crate::step::workspace::Workspace;
use crate::summary::{EquivalentForce, RunSummary};

/// Displacements of the linear solution relative to the size of the structure: so small that second-order terms are round-off.
const SMALL: f64 = 1e-7;
/// Relative tolerance of the moment in the search, and the largest number of secant steps.
const FOUND: f64 = 1e-11;
const SECANTS: usize = 60;

/// The equivalent static force of a run in which one guided projectile strikes a structure at rest.
///
/// # Errors
/// The reason why there is none: more actions than the impact and weight, or a structure that linear analysis does not support.
pub fn equivalent_force(
    model: &Model,
    start: Start,
    run: &RunSummary,
) -> Result<EquivalentForce, &'static str> {
    let projectile = striker(model)?;
    refuse_others(model, start)?;
    refuse_what_is_not_linear(model, run)?;
    let mut linear = SmallForces::new(model, projectile)
        .ok_or("the structure is not supported in this direction")?;
    let moment = run.section_forces[projectile.point.beam].moment.largest().value.abs();
    if moment.is_nan() || moment <= linear.moment(0.0) * (1.0 + FOUND) {
        return Err("the impact does not increase the bending moment");
    }
    let along = (0..2).find(|k| projectile.direction[*k].abs() > 1.0 - 1e-12);
    let recorded = run.points.iter().find(|p| p.name == model.contacts[0].between[0]);
    let deflection = along.zip(recorded).map(|(k, p)| match model.loads.is_empty() {
        true => p.displacement_max[k].value.abs(),
        false => p.displacement_max[k].value * projectile.direction[k] - linear.sag(),
    });
    let yielded = run.plastic.iter().any(|beam| beam.first_yield.is_some())
        || run.yielding.iter().any(|one| one.first_yield.is_some());
    Ok(EquivalentForce {
        moment: linear.force_of(moment),
        deflection: deflection.filter(|d| *d > 0.0).map(|d| d / linear.deflection),
        as_if_elastic: yielded,
    })
}

/// The only projectile.
fn striker(model: &Model) -> Result<&ProjectileData, &'static str> {
    match (model.projectiles.as_slice(), model.contacts.len()) {
        ([projectile], 1) => Ok(projectile),
        ([], _) => Err("no guided projectile"),
        _ => Err("other contacts are possible"),
    }
}

/// Rejects motions and loads other than the impact and weight at rest.
fn refuse_others(model: &Model, start: Start) -> Result<(), &'static str> {
    let steady = |load: &LoadView<'_>| {
        load.gravity().is_some()
            && [0.0, 1e-3, 1.0, 1e3].iter().all(|t| load.factor(*t, 1e-6) == 1.0)
    };
    if !model.loads().all(|load| steady(&load)) {
        return Err("loads other than a steady weight act");
    }
    if !model.loads.is_empty() && start != Start::Static {
        return Err("the structure vibrates under self-weight: use time.start = \"static\"");
    }
    if !model.motions.is_empty() {
        return Err("supports have prescribed motions");
    }
    if !model.is_still() {
        return Err("the structure moves from the start");
    }
    Ok(())
}

/// Rejects structures that are not linear before yield.
fn refuse_what_is_not_linear(model: &Model, run: &RunSummary) -> Result<(), &'static str> {
    if run.joints.iter().any(|joint| joint.parted.is_some())
        || run.plastic.iter().any(|beam| !beam.parted.is_empty() || beam.failed > 0)
        || run.yielding.iter().any(|one| one.failed.is_some())
    {
        return Err("part of the structure failed");
    }
    refuse_springs(model)?;
    let mut laws = model.spans.iter().filter_map(|s| s.fibres.as_ref()).flat_map(|f| &f.laws);
    if laws.any(|law| law.slack().is_some()) {
        return Err("a material is tension-only or compression-only");
    }
    Ok(())
}

/// Rejects springs other than linear ones of the structure without force at the start.
fn refuse_springs(model: &Model) -> Result<(), &'static str> {
    let start = State::at_rest(model, Scheme::EnergyMomentum);
    for (c, &q) in model.connectors.iter().zip(&start.coordinates) {
        if c.tied_nodes().next().is_some() {
            return Err("a spring ends at a projectile");
        }
        if !matches!(c.law, ConnectorLaw::Linear { .. }) {
            return Err(match c.support {
                Some(_) => "the structure has stops",
                None => "a spring is not linear",
            });
        }
        if c.potential(q, &start.memories) != 0.0 {
            return Err("a spring has initial strain");
        }
    }
    Ok(())
}

/// Displacements, and multipliers of constraints.
#[derive(Clone, Default)]
struct Solution {
    /// Of the nodes, shape (nodes, 4) \[m, -\].
    displacement: Vec<[f64; 4]>,
    /// Of the constraints, shape (constraints) \[N, N m\].
    multiplier: Vec<f64>,
}

/// The structure in its reference configuration under small forces.
struct SmallForces {
    structure: Model,
    projectile: ProjectileData,
    /// Under a unit force along the line of motion.
    unit: Solution,
    /// Under the weight.
    weight: Solution,
    /// Deflection of the struck point along a unit force \[m/N\].
    deflection: f64,
}

impl SmallForces {
    /// None where beams can move freely.
    fn new(model: &Model, projectile: &ProjectileData) -> Option<Self> {
        let structure = model.structure();
        let (unit, weight) = solutions(&structure, projectile)?;
        let deflection = dot(projectile.direction, projectile.point.value(&unit.displacement));
        let projectile = projectile.clone();
        (deflection > 0.0 && deflection.is_finite()).then_some(Self {
            structure,
            projectile,
            unit,
            weight,
            deflection,
        })
    }

    /// Deflection of the struck point under the weight, along the line of motion \[m\].
    fn sag(&self) -> f64 {
        let Self { projectile, weight, .. } = self;
        dot(projectile.direction, projectile.point.value(&weight.displacement))
    }

    /// Largest magnitude of the bending moment in the struck beam under a unit force only \[N m\].
    fn unit_moment(&self) -> f64 {
        self.largest_moment([0.0, 1.0])
    }

    /// The same under the weight and a force \[N\].
    fn moment(&self, force: f64) -> f64 {
        self.largest_moment([1.0, force])
    }

    /// The same under shares of the weight and of a unit force.
    fn largest_moment(&self, shares: [f64; 2]) -> f64 {
        let Self { structure, projectile, unit, weight, .. } = self;
        let both = |w: f64, u: f64| shares[0] * w + shares[1] * u;
        let moved: Vec<[f64; 4]> = weight
            .displacement
            .iter()
            .zip(&unit.displacement)
            .map(|(w, u)| std::array::from_fn(|k| both(w[k], u[k])))
            .collect();
        let most = moved.iter().map(|u| u[0].abs().max(u[1].abs())).fold(0.0, f64::max);
        if most == 0.0 {
            return 0.0;
        }
        let rest = State::at_rest(structure, Scheme::EnergyMomentum);
        let mut search = StaticSearch::at(structure, &rest);
        let small = SMALL * search.size() / most;
        search.forcing.set_static(structure, small * shares[0]);
        for (d, u) in search.work.increment.iter_mut().zip(&moved) {
            *d = u.map(|u| small * u);
        }
        drop(moved);
        let multipliers = weight.multiplier.iter().zip(&unit.multiplier);
        for (m, (w, u)) in search.work.multiplier.iter_mut().zip(multipliers) {
            *m = small * both(*w, *u);
        }
        search.assemble::<false>();
        // For very many elements memory is not spent on results without section forces.
        search.work.residual = Vec::new();
        let (row, force) = (row(projectile), small * shares[1]);
        let state = search.state();
        let Workspace { increment, beams, .. } = &search.work;
        let forcing = &search.forcing;
        let acting = Acting { state: &search.base, increment, rule: &RULE, beams, forcing };
        let (mut lines, mut forces) = (Lines::default(), section_forces::unset(structure));
        lines.set(structure, &acting, std::iter::once(([&row; 2], [force, 0.0])));
        section_forces::update(structure, &lines, &state, &mut forces);
        forces[projectile.point.beam].moment.largest().value.abs() / small
    }

    /// The force with a given largest moment, in addition to weight \[N\]: moments are piecewise linear functions of the force.
    fn force_of(&mut self, moment: f64) -> f64 {
        let first = moment / self.unit_moment();
        if self.structure.loads.is_empty() {
            return first;
        }
        let (mut low, mut high) = ([0.0, self.moment(0.0)], [first, self.moment(first)]);
        while high[1] < moment && high[0].is_finite() {
            low = high;
            high = [2.0 * high[0], self.moment(2.0 * high[0])];
        }
        for _ in 0..SECANTS {
            let share = ((moment - low[1]) / (high[1] - low[1])).clamp(0.01, 0.99);
            let force = low[0] + share * (high[0] - low[0]);
            let found = [force, self.moment(force)];
            if (found[1] - moment).abs() <= FOUND * moment {
                return force;
            }
            if found[1] < moment { low = found } else { high = found }
        }
        0.5 * (low[0] + high[0])
    }
}

/// The point under the projectile's force, as a form.
fn row(projectile: &ProjectileData) -> Row {
    let (point, [e1, e2]) = (&projectile.point, projectile.direction);
    let [n0, n1, n2, n3] = point.shape;
    let mut row = Row::default();
    row.add(point.node, [n0 * e1, n0 * e2, n1 * e1, n1 * e2]);
    row.add(point.node + 1, [n2 * e1, n2 * e2, n3 * e1, n3 * e2]);
    row
}

/// Linear solutions under a unit force and under the weight; none where beams can move freely.
fn solutions(structure: &Model, projectile: &ProjectileData) -> Option<(Solution, Solution)> {
    let rest = State::at_rest(structure, Scheme::EnergyMomentum);
    let mut search = StaticSearch::at(structure, &rest);
    if !free_motions(&Layout::new(structure), &search).motions.is_empty() {
        return None;
    }
    search.assemble::<true>();
    search.factor_assembled().ok()?;
    let solve = |search: &mut StaticSearch<'_>| {
        search.correction();
        let Workspace { correction, multiplier, .. } = &search.work;
        Solution { displacement: correction.clone(), multiplier: multiplier.clone() }
    };
    search.work.residual.fill([0.0; 4]);
    projectile.point.spread(projectile.direction.map(|d| -d), &mut search.work.residual);
    search.work.multiplier.fill(0.0);
    let unit = solve(&mut search);
    search.forcing.set_static(structure, 1.0);
    search.work.multiplier.fill(0.0);
    search.assemble::<false>();
    let weight = solve(&mut search);
    Some((unit, weight))
}
