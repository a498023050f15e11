//! Newton's iteration for the increment of a step.
//!
//! The tangent is factored at the predictor and kept while the iteration contracts well with it; unbalanced forces are always those of the current
//! increment, so the result does not depend on the number of factorisations.

mod balance;
mod contacts;

use serde::{Deserialize, Serialize};

use super::constraint::ConstraintStep;
use super::contacts::{ActiveContact, ImpulseLaw};
use super::convergence::{ConvergenceMonitor, ROUND_OFF};
use super::forcing::Forcing;
use super::integration::Integration;
use super::modal_damping::{ModalDamping, StepView};
use super::tangent::{DampedVectors, Singular};
use super::workspace::Workspace;
use super::{assemble, bodies, connectors, external, masses};
use crate::contact::impact::Stalled;
use crate::geometry::touch::SearchRegion;
use crate::model::Model;
use crate::state::{PairState, State};

/// A step to be solved: from `state`, by `integration`, with the `active` contacts.
#[derive(Clone, Copy, Debug)]
pub struct StepProblem<'a> {
    /// The model.
    pub model: &'a Model,
    /// Start of the step.
    pub state: &'a State,
    /// Scheme and size of the step.
    pub integration: Integration,
    /// Loads and prescribed motions in the step.
    pub forcing: &'a Forcing,
    /// Modal damping.
    pub damping: &'a ModalDamping,
    /// Size of the structure \[m\].
    pub size: f64,
    /// Scale of positions \[m\].
    pub positions: f64,
    /// Pairs that are close enough to touch, shape (such pairs) \[index of a pair\].
    pub near: &'a [usize],
    /// Pairs whose evaluation differs from the state, in their order, shape (such pairs) \[index of a pair\].
    pub sights: &'a [(usize, PairState)],
    /// Rigid contacts that may carry an impulse, shape (active contacts).
    pub active: &'a [ActiveContact],
    /// Relation of impulses to velocities.
    pub law: ImpulseLaw,
    /// Size of this step as a share of the given step size: the same share of the constraints' round-off is compensated in it.
    pub feedback: f64,
    /// Upper bound of element lengths at the start, one per beam, shape (beams) \[m\]; empty if no pair is near a face.
    pub arcs: &'a [f64],
    /// Region of the search for closest points of smooth contacts at the end of the step. The neighbourhood of the last ones is enough unless
    /// another point has come closer, which only an evaluation of the solved step shows.
    pub reach: SearchRegion,
}

/// Last evaluation of a pair: among the `sights`, or in the state.
pub fn seen<'a>(state: &'a State, sights: &'a [(usize, PairState)], pair: usize) -> &'a PairState {
    match sights.binary_search_by_key(&pair, |sight| sight.0) {
        Ok(k) => &sights[k].1,
        Err(_) => &state.pairs[pair],
    }
}

/// Counts of an iteration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Effort {
    /// Corrections computed.
    pub iterations: usize,
    /// Tangents factored.
    pub factorizations: usize,
}

/// Reason why a step has no solution (yet).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure {
    /// The iteration did not converge.
    Diverged {
        /// Unbalanced work relative to the energy scale.
        residual: f64,
        /// Node with the largest unbalanced force.
        node: usize,
    },
    /// The tangent is singular.
    Singular(Singular),
    /// The impact problem stalled.
    Impact,
    /// Bodies passed through each other without detection.
    Passed,
    /// The parts of a step would not end.
    Endless,
}

impl From<Singular> for Failure {
    fn from(singular: Singular) -> Self {
        Self::Singular(singular)
    }
}

impl From<Stalled> for Failure {
    fn from(_: Stalled) -> Self {
        Self::Impact
    }
}

/// A correction of the increment.
#[derive(Clone, Copy, Debug)]
struct Correction {
    /// Its largest component.
    size: f64,
    /// Work of the unbalanced forces on it, all taken with the same sign \[J\].
    work: f64,
}

/// Largest number of corrections before a step counts as failed, and that for steadily decreasing ones: at contacts whose closest point slides fast
/// or jumps, and in collapsing beams, the iteration converges only linearly.
pub const MOST_ITERATIONS: usize = 24;
const MOST_STEADY: usize = 250;
/// Corrections from this one on are compared with the one before.
const SWINGS_FROM: usize = 5;
/// Corrections below this share of the largest are set to zero: ahead of a wave the solution decays exponentially, into numbers so small that
/// processors take a hundred times as long for them.
const QUIET: f64 = 1e-120;
/// Unbalanced impulse of an accepted step, relative to the momentum scale.
pub const IMPULSE_TOLERANCE: f64 = 1e-15;
/// Impulses times the rotation of their forms by the last correction, of an accepted step, relative likewise.
const TURNED_TOLERANCE: f64 = 1e-14;
/// Unbalanced impulse that may pass for round-off, relative to the momentum scale.
pub const MOST_IMPULSE: f64 = 1e-10;

impl StepProblem<'_> {
    /// Solves for the increment, which is in `work` afterwards with its residual.
    ///
    /// # Errors
    /// The reason why there is none; the content of `work` is then invalid, the state is unchanged.
    pub fn solve(&self, work: &mut Workspace, effort: &mut Effort) -> Result<(), Failure> {
        let found = self.iterate(work, effort);
        self.measure_arcs(work);
        found
    }

    fn iterate(&self, work: &mut Workspace, effort: &mut Effort) -> Result<(), Failure> {
        self.predict(work);
        work.correction_before.clear();
        let mut convergence = ConvergenceMonitor::new(self.state.ledger.energy_scale);
        let reach = largest(&self.state.displacement, self.size);
        let mut renew = true;
        for iteration in 0..MOST_STEADY {
            if iteration >= MOST_ITERATIONS && !convergence.closes_in() {
                break;
            }
            self.residual(work, renew);
            convergence.unbalanced(self.unbalanced_work(work));
            if !convergence.unbalanced.is_finite() {
                break;
            }
            if iteration > 0 && self.balanced(work, &convergence) {
                return Ok(());
            }
            if !renew && !convergence.contracts() {
                renew = true;
                self.residual(work, renew);
            }
            if renew {
                self.factor(work)?;
                effort.factorizations += 1;
            }
            let correction = self.correct(work, iteration)?;
            effort.iterations += 1;
            // Work supplied by a step itself, or by moving supports, has the accuracy of its increment.
            let moves = !self.model.motions.is_empty();
            if iteration == 0 || moves || convergence.energy > self.state.ledger.energy_scale {
                convergence.set_energy_scale(self.energy_scale(work, correction.work));
            }
            let step = largest(&work.increment, self.size);
            let touching =
                !self.active.is_empty() || work.smooth.iter().any(|c| c.force.force > 0.0);
            // A structure at rest moves by round-off of positions alone: there is nothing to follow.
            let rests = reach.max(step) <= self.positions * ROUND_OFF;
            let places = if touching || rests { self.positions } else { 0.0 };
            convergence.corrected(correction.size, reach, step, correction.work, places);
            renew = false;
        }
        // Unbalanced forces without reactions.
        self.unbalanced_work(work);
        let node = farthest_node(&work.correction, self.size);
        Err(Failure::Diverged { residual: convergence.unbalanced / convergence.energy, node })
    }

    fn predict(&self, work: &mut Workspace) {
        let state = self.state;
        self.integration.predict_all(&state.velocity, &state.acceleration, &mut work.increment);
        prescribe(self.model, self.forcing, &mut work.increment);
        work.lead.set(self.model, state, &self.integration, self.forcing);
        if self.integration.sweeps() {
            work.beams.sweep.begin_once(self.model, state);
        }
        for (i, acts) in self.forcing.constrained.iter().enumerate() {
            work.multiplier[i] = if *acts { state.multiplier[i] } else { 0.0 };
        }
        work.rigid.clear();
        work.rigid_pairs.clear();
        work.rigid_pairs.extend(self.active.iter().map(|c| c.pair));
        self.measure_arcs_if_needed(work);
        for contact in self.active {
            let found = self.rigid_contact(contact, work, [0.0; 2]);
            work.rigid.push(found.unwrap_or_default());
        }
    }

    /// Last evaluation of a pair.
    pub(super) fn seen(&self, pair: usize) -> &PairState {
        seen(self.state, self.sights, pair)
    }

    /// Residual of the step solved in `work`.
    pub fn unbalanced(&self, work: &mut Workspace) {
        self.residual(work, false);
    }

    /// Residual at the current increment, and the assembled tangent if requested.
    fn residual(&self, work: &mut Workspace, tangent: bool) {
        if tangent { self.residual_with::<true>(work) } else { self.residual_with::<false>(work) }
    }

    fn residual_with<const TANGENT: bool>(&self, work: &mut Workspace) {
        let Workspace { increment, residual, tangent, beams, lead, modal, .. } = work;
        let (model, state, rule) = (self.model, self.state, &self.integration);
        let gravity = self.forcing.gravity;
        let sums = (tangent.chain_mut(), &mut *beams);
        assemble::beams::<TANGENT>(model, state, rule, gravity, increment, residual, sums);
        if TANGENT {
            tangent.clear_ties();
        }
        let forcing = self.forcing;
        external::apply::<TANGENT>(model, state, forcing, rule, increment, residual, tangent);
        bodies::apply::<TANGENT>(model, state, rule, gravity, increment, residual, tangent);
        masses::apply::<TANGENT>(model, state, rule, gravity, increment, residual, tangent);
        connectors::apply::<TANGENT>(model, state, rule, forcing, increment, residual, tangent);
        lead.add_inertia(model, &state.displacement, increment, rule, (residual, beams));
        modal.set(self.damping, &StepView { model, state, rule, forcing, increment });
        modal.apply(self.damping, increment, rule.h, residual);
        let step = self.constraint_step(increment);
        for (i, (c, multiplier)) in model.constraints.iter().zip(&work.multiplier).enumerate() {
            step.add_gradient(c, *multiplier, residual);
            if TANGENT {
                tangent.add_constraint(i, c, &step, *multiplier);
            }
        }
        self.measure_arcs_if_needed(work);
        self.smooth_contacts::<TANGENT>(work);
        self.rigid_contacts(work);
    }

    /// The step for constraints.
    pub(super) fn constraint_step<'b>(&'b self, increment: &'b [[f64; 4]]) -> ConstraintStep<'b> {
        let start = &self.state.displacement;
        ConstraintStep { start, increment, forcing: self.forcing, share: 0.5 }
    }

    fn factor(&self, work: &mut Workspace) -> Result<(), Failure> {
        let Workspace { tangent, increment, modal, .. } = work;
        let step = self.constraint_step(increment);
        let (vectors, h) = (modal.vectors(self.damping), self.integration.h);
        let damping = DampedVectors { vectors, rates: &self.damping.rates, h };
        tangent.factor(self.model, &step, Some(damping))?;
        self.contact_columns(work);
        Ok(())
    }

    /// One correction of the increment.
    fn correct(&self, work: &mut Workspace, iteration: usize) -> Result<Correction, Failure> {
        for (c, r) in work.correction.iter_mut().zip(&work.residual) {
            *c = r.map(|x| -x);
        }
        let Workspace { tangent, correction, multiplier, increment, .. } = work;
        let step = self.constraint_step(increment);
        let feedback = Some(self.feedback);
        tangent.solve(self.model, &step, correction, multiplier, feedback);
        self.impact(work)?;
        let size = largest(&work.correction, self.size);
        let quiet = QUIET * size;
        let share = if iteration < SWINGS_FROM { 1.0 } else { share_taken(work) };
        let mut correction = Correction { size, work: 0.0 };
        for ((d, c), r) in work.increment.iter_mut().zip(&mut work.correction).zip(&work.residual) {
            for i in 0..4 {
                if c[i].abs() < quiet {
                    c[i] = 0.0;
                }
                d[i] += share * c[i];
                correction.work += (c[i] * r[i]).abs();
            }
        }
        Ok(correction)
    }
}

/// Applied share of a correction: half of one that reverses most of the previous one, which overshot. If a closest point moves far for a small
/// increment, friction would otherwise reverse in every correction.
fn share_taken(work: &mut Workspace) -> f64 {
    let Workspace { correction, correction_before: before, .. } = work;
    let on = |a: &[[f64; 4]], b: &[[f64; 4]]| -> f64 {
        a.iter().zip(b).map(|(a, b)| (0..4).map(|i| a[i] * b[i]).sum::<f64>()).sum()
    };
    let swings = before.len() == correction.len()
        && on(correction, before) < -0.5 * on(before, before).min(on(correction, correction));
    before.clone_from(correction);
    if swings { 0.5 } else { 1.0 }
}

/// Sets fixed components to their prescribed increments.
pub fn prescribe(model: &Model, forcing: &Forcing, increment: &mut [[f64; 4]]) {
    for dofs in &model.prescribed {
        let x = &mut increment[dofs.node];
        if dofs.is_whole() && dofs.drives.iter().all(Vec::is_empty) {
            *x = [0.0; 4];
            continue;
        }
        for (n, drive) in dofs.normals.iter().zip(&dofs.drives) {
            let miss = (0..4).map(|k| n[k] * x[k]).sum::<f64>() - forcing.increment(drive);
            (0..4).for_each(|k| x[k] -= miss * n[k]);
        }
    }
}

/// Magnitude of the largest component \[m\]; slopes and angles are multiplied by a length, the structure's size, so that a scene in millimetres
/// needs the same iterations as one in kilometres.
fn largest(nodal: &[[f64; 4]], length: f64) -> f64 {
    // Separate components use vector registers. One comparison each: `f64::max` would test for NaN as well, which no comparison finds larger.
    let mut most = [0.0_f64; 4];
    for x in nodal {
        for i in 0..4 {
            let size = x[i].abs();
            most[i] = if size > most[i] { size } else { most[i] };
        }
    }
    sizes(&most, length).into_iter().fold(0.0, |m, size| if size > m { size } else { m })
}

/// The node with the largest component.
fn farthest_node(nodal: &[[f64; 4]], length: f64) -> usize {
    let mut found = (0, 0.0);
    for (n, x) in nodal.iter().enumerate() {
        let size = largest(std::slice::from_ref(x), length);
        if size > found.1 {
            found = (n, size);
        }
    }
    found.0
}

/// Magnitudes of nodal values \[m\].
fn sizes(x: &[f64; 4], length: f64) -> [f64; 4] {
    [x[0].abs(), x[1].abs(), length * x[2].abs(), length * x[3].abs()]
}
