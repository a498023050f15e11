//! Static equilibrium under the loads that act at time zero, and the mechanisms that keep a structure from having one.

use super::section_forces;
use crate::contact::effective_mass;
use crate::element::beam::{ElementValues, step_point};
use crate::element::collocation;
use crate::error::Error;
use crate::model::{Fault, Model};
use crate::settings::Scheme;
use crate::state::State;
use crate::step::integration::{Integration, Rule};
use crate::step::tangent::project;
use crate::step::workspace::Workspace;
use crate::step::{assemble, constraint, external};
use crate::summary::SectionForceSummary;

/// Share of a beam's own bending frequency (squared) by which the tangent is shifted.
const SHIFT: f64 = 1e-6;
/// Load steps, as a share of the load: small enough to stay on the branch that starts at rest where a beam has several
/// equilibria (a roll of one turn more or less).
const FIRST_STEP: f64 = 0.1;
/// A load step is cut down to this share of the load before the analysis gives up.
const SMALLEST_STEP: f64 = 1e-4;
/// Corrections of a load step.
const MOST_ITERATIONS: usize = 20;
/// Last correction of an equilibrium, relative to its displacements; the next would be its square.
const SETTLED: f64 = 1e-9;

/// A static equilibrium.
#[derive(Clone, Debug)]
pub struct Equilibrium {
    /// The state of equilibrium, at rest.
    pub state: State,
    /// Displacements of the recorded points \[m\], with their names.
    pub points: Vec<(String, [f64; 2])>,
    /// Section forces of largest magnitude, one entry a beam.
    pub section_forces: Vec<SectionForceSummary>,
    /// Load steps taken.
    pub load_steps: usize,
    /// Newton iterations.
    pub newton_iterations: usize,
}

/// Static equilibrium of `model` under the loads that act at time zero; projectiles take no part.
///
/// Newton's iteration on the full load, in smaller load steps where it does not converge.
///
/// # Errors
/// Convergence lost even for small load steps: a limit point, or a load no equilibrium can carry.
pub fn equilibrium(model: &Model) -> Result<Equilibrium, Error> {
    let mut search = Search::new(model);
    let (mut reached, mut step) = (0.0, FIRST_STEP);
    while reached < 1.0 {
        let target = (reached + step).min(1.0);
        if search.solve(target) {
            reached = target;
            search.load_steps += 1;
            search.accepted.copy_from_slice(&search.work.increment);
        } else {
            step *= 0.5;
            search.work.increment.copy_from_slice(&search.accepted);
            search.foresee(true);
            if step < SMALLEST_STEP {
                return Err(Error::no_equilibrium(reached));
            }
        }
    }
    Ok(search.finish())
}

struct Search<'m> {
    model: &'m Model,
    rest: State,
    work: Workspace,
    accepted: Vec<[f64; 4]>,
    rule: Integration,
    load_steps: usize,
    iterations: usize,
}

impl<'m> Search<'m> {
    fn new(model: &'m Model) -> Self {
        let work = Workspace::new(model);
        Self {
            model,
            // Its stored strains are those foreseen for the next correction.
            rest: State::at_rest(model, Scheme::StrainRate),
            accepted: work.increment.clone(),
            work,
            rule: Integration { h: 1.0, rule: Rule::Static { shift: shift(model) } },
            load_steps: 0,
            iterations: 0,
        }
    }

    /// Newton's iteration at a share of the loads, from the increment that stands in the workspace.
    fn solve(&mut self, share: f64) -> bool {
        let mut scaled = self.model.clone();
        for g in &mut scaled.gravity {
            g.acceleration = g.acceleration.map(|a| share * a);
        }
        for load in &mut scaled.point_loads {
            load.force = load.force.map(|f| share * f);
            load.moment *= share;
        }
        for _ in 0..MOST_ITERATIONS {
            self.assemble(&scaled);
            let work = &mut self.work;
            if work.tangent.factor(self.model, &self.rest.displacement, &work.increment).is_err() {
                return false;
            }
            work.correction.copy_from_slice(&work.residual);
            project(self.model, &mut work.correction);
            for c in &mut work.correction {
                *c = c.map(|x| -x);
            }
            let (u, d) = (&self.rest.displacement, &work.increment);
            work.tangent.solve(
                self.model,
                u,
                d,
                &mut work.correction,
                &mut work.multiplier,
                Some(1.0),
            );
            self.foresee(false);
            let work = &mut self.work;
            for (d, c) in work.increment.iter_mut().zip(&work.correction) {
                (0..4).for_each(|i| d[i] += c[i]);
            }
            self.iterations += 1;
            let (moved, reach) = (largest(&work.correction), largest(&work.increment));
            if !moved.is_finite() || reach > 1e6 * self.size() {
                return false;
            }
            if moved <= SETTLED * reach {
                return true;
            }
        }
        false
    }

    /// Strains that the correction leads to, to first order; those of the increment itself if `still`.
    fn foresee(&mut self, still: bool) {
        let no_motion = [0.0; 4];
        for beam in &self.model.beams {
            for (k, element) in beam.elements.clone().enumerate() {
                let a = beam.nodes.start + k;
                let values = |n: &[[f64; 4]]| ElementValues::new(&n[a], &n[a + 1]);
                let (u, d) = (values(&self.rest.displacement), values(&self.work.increment));
                let c = if still {
                    ElementValues::new(&no_motion, &no_motion)
                } else {
                    values(&self.work.correction)
                };
                for (j, row) in beam.table.rows.iter().enumerate() {
                    let point = step_point(&beam.table, row, &u, &d);
                    let (slope, bend) = (c.at(&row.first), c.at(&row.second));
                    let s = collocation::foresee(&beam.law, &point, slope, bend);
                    self.rest.strain[element][j] = [s.membrane, s.bending];
                }
            }
        }
    }

    /// Residual and tangent at the current increment.
    fn assemble(&mut self, scaled: &Model) {
        let h = 1e-9; // loads that act at time zero
        let gravity = external::gravity(scaled, 0.0, h);
        let Workspace { increment, residual, tangent, multiplier, .. } = &mut self.work;
        let chain = &mut tangent.chain;
        assemble::beams::<true>(
            scaled, &self.rest, &self.rule, gravity, increment, residual, chain,
        );
        external::apply::<true>(scaled, &self.rest, h, 1.0, increment, residual, chain);
        for (c, multiplier) in self.model.constraints.iter().zip(multiplier) {
            let u = &self.rest.displacement;
            constraint::add_gradient(c, u, increment, 0.5, *multiplier, residual);
        }
    }

    /// Size of the structure \[m\].
    fn size(&self) -> f64 {
        self.model.beams.iter().map(|b| b.length).sum::<f64>().max(1.0)
    }

    fn finish(self) -> Equilibrium {
        let mut state = self.rest;
        state.displacement = self.work.increment;
        state.strain.clear();
        let mut forces = section_forces::unset(self.model);
        section_forces::update(self.model, &state, &mut forces);
        let at = |p: &crate::model::frozen::MaterialPoint| p.value(&state.displacement);
        Equilibrium {
            points: self.model.points.iter().map(|p| (p.label.clone(), at(p))).collect(),
            section_forces: forces,
            load_steps: self.load_steps,
            newton_iterations: self.iterations,
            state,
        }
    }
}

fn largest(nodal: &[[f64; 4]]) -> f64 {
    nodal.as_flattened().iter().fold(0.0, |m, x| if x.is_nan() { f64::NAN } else { m.max(x.abs()) })
}

/// Shift of the tangent: small against the lowest bending frequency any beam of the model could have.
fn shift(model: &Model) -> f64 {
    let own =
        |b: &crate::model::frozen::BeamData| b.law.bending / (b.mass_per_length * b.length.powi(4));
    SHIFT * model.beams.iter().map(own).fold(f64::INFINITY, f64::min)
}

/// A fault if supports and joints leave a beam free to move without strain.
///
/// Inverse iteration on stiffness and mass about the reference: a mechanism is a mode of no stiffness.
pub fn mechanism(model: &Model) -> Option<Fault> {
    let mut search = Search::new(model);
    search.assemble(model);
    let rest = &search.rest.displacement;
    let mass = effective_mass::mass_band(model);
    let tangent = &mut search.work.tangent;
    let fault = |beam: &str| {
        let found = format!("a mechanism: `{beam}` can move without being strained");
        Fault::new(format!("beam.{beam}"), found, "supports and joints that hold every beam")
    };
    if tangent.factor(model, rest, rest).is_err() {
        return Some(fault(&model.beams[0].name));
    }
    let shift = shift(model);
    // Any start that is orthogonal to no motion will do.
    let mut x: Vec<[f64; 4]> = (0..model.node_count())
        .map(|n| std::array::from_fn(|i| 1.0 + 0.37 * ((7 * n + 3 * i) % 11) as f64))
        .collect();
    project(model, &mut x);
    let mut stiffness = f64::INFINITY;
    for _ in 0..30 {
        let load = mass.multiply(&x);
        let mut y = load.clone();
        let mut multiplier = vec![0.0; model.constraints.len()];
        tangent.solve(model, rest, rest, &mut y, &mut multiplier, None);
        let inner = |a: &[[f64; 4]], b: &[[f64; 4]]| -> f64 {
            a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
        };
        let (xmy, ymy) = (inner(&load, &y), inner(&mass.multiply(&y), &y));
        if ymy.is_nan() || ymy <= 0.0 {
            return None; // nothing can move at all
        }
        stiffness = xmy / ymy - shift;
        let size = ymy.sqrt();
        x = y.iter().map(|v| v.map(|c| c / size)).collect();
    }
    (stiffness <= 10.0 * shift).then(|| {
        let reach = |b: &crate::model::frozen::BeamData| largest(&x[b.nodes.clone()]);
        let most = model.beams.iter().max_by(|a, b| reach(a).total_cmp(&reach(b)));
        fault(most.map_or("", |b| b.name.as_str()))
    })
}
