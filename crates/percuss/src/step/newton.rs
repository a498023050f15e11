//! Newton's iteration for the increment of a step.
//!
//! The tangent is factored at the predictor and kept while the iteration contracts well with it; unbalanced forces are
//! always those of the current increment, so the result does not depend on how often the tangent was renewed.

use super::integration::{Integration, Rule};
use super::tangent::{Singular, project};
use super::workspace::Workspace;
use super::{assemble, constraint, external};
use crate::contact::impact::Stalled;
use crate::contact::law;
use crate::math::vec2::{dot, scale};
use crate::model::Model;
use crate::model::frozen::ContactLaw;
use crate::state::State;

/// A rigid contact that takes part in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveContact {
    /// Index of the projectile.
    pub projectile: usize,
    /// Least gap rate at the end of the step, Newton's `-alpha z0` \[m/s\].
    pub bound: f64,
}

/// A step to be solved: from `state`, by `integration`, with the `active` contacts.
#[derive(Clone, Copy, Debug)]
pub struct StepProblem<'a> {
    /// What moves.
    pub model: &'a Model,
    /// Start of the step.
    pub state: &'a State,
    /// Scheme and size of the step.
    pub integration: Integration,
    /// Gravity in the step \[m/s^2\].
    pub gravity: [f64; 2],
    /// Contacts that may carry an impulse.
    pub active: &'a [ActiveContact],
}

/// What an iteration took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// Corrections computed.
    pub iterations: usize,
    /// Tangents factored.
    pub factorizations: usize,
}

/// Why a step has no solution (yet).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure {
    /// The iteration did not converge.
    Diverged {
        /// Unbalanced work relative to the energy in play.
        residual: f64,
        /// Node with the largest unbalanced force.
        node: usize,
    },
    /// The tangent is singular.
    Singular(Singular),
    /// The impact problem stalled.
    Impact,
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

/// Most corrections before a step counts as failed.
const MOST_ITERATIONS: usize = 24;
/// The tangent is renewed when unbalanced work shrinks by less than this factor per correction.
const CONTRACTION: f64 = 0.02;
/// Unbalanced work of an accepted step, relative to the energy in play: far below 1e-10 even if every step of a long run
/// errs to the same side.
const WORK_TOLERANCE: f64 = 1e-16;
/// Unbalanced impulse of an accepted step, relative to the momentum in play.
const IMPULSE_TOLERANCE: f64 = 1e-15;
/// Unbalanced work that may pass for round-off, relative to the energy in play: 1e-10 was seen on 60 000 elements.
const MOST_ROUND_OFF: f64 = 1e-8;
/// Corrections this small against the step that no longer shrink are round-off.
const STALLED: f64 = 1e-10;
/// A correction below so many units in the last place of the displacements moves nothing any more.
const ROUND_OFF: f64 = 8.0 * f64::EPSILON;

impl StepProblem<'_> {
    /// Finds the increment; it and its residual stand in `work` afterwards.
    ///
    /// # Errors
    /// Why there is none; `work` then holds rubbish, the state is untouched.
    pub fn solve(&self, work: &mut Workspace, effort: &mut Effort) -> Result<(), Failure> {
        self.predict(work);
        let mut watch = Watch::new(self.state.books.energy_scale);
        let mut renew = true;
        for iteration in 0..MOST_ITERATIONS {
            self.residual(work, renew);
            watch.unbalanced(self.unbalanced_work(work));
            if !watch.unbalanced.is_finite() {
                break;
            }
            if iteration > 0 && (watch.settled() || self.balanced(work, &watch)) {
                return Ok(());
            }
            if !renew && !watch.contracts() {
                renew = true;
                self.residual(work, renew);
            }
            if renew {
                self.factor(work)?;
                effort.factorizations += 1;
            }
            let correction_work = self.correct(work)?;
            effort.iterations += 1;
            let (_, reach) = largest(&self.state.displacement);
            let (_, step) = largest(&work.increment);
            watch.corrected(largest(&work.correction).1, correction_work, reach, step);
            renew = false;
        }
        let (node, _) = largest(&work.residual);
        Err(Failure::Diverged { residual: watch.unbalanced / watch.energy, node })
    }

    /// Whether nothing is left unbalanced.
    fn balanced(&self, work: &Workspace, watch: &Watch) -> bool {
        watch.unbalanced <= WORK_TOLERANCE * watch.energy
            && self.unbalanced_impulse(work) <= IMPULSE_TOLERANCE * self.momentum(watch.energy)
            && self.constraints_met(work)
    }

    fn predict(&self, work: &mut Workspace) {
        let state = self.state;
        for (n, d) in work.increment.iter_mut().enumerate() {
            let a0 = state.acceleration.get(n).unwrap_or(&[0.0; 4]);
            let v0 = &state.velocity[n];
            *d = std::array::from_fn(|i| self.integration.predict(v0[i], a0[i]));
        }
        work.multiplier.copy_from_slice(&state.multiplier);
        for (i, p) in state.projectiles.iter().enumerate() {
            work.travel[i] = self.integration.predict(p.speed, p.acceleration);
        }
        work.impulse.fill(0.0);
        self.move_rigid(work);
    }

    /// Rigid projectiles move as gravity and their impulses say.
    fn move_rigid(&self, work: &mut Workspace) {
        let h = self.integration.h;
        for (i, p) in self.model.projectiles.iter().enumerate() {
            if matches!(p.law, ContactLaw::Unilateral { .. }) {
                let change = h * dot(self.gravity, p.direction) - work.impulse[i] / p.mass;
                work.travel[i] = h * (self.state.projectiles[i].speed + 0.5 * change);
            }
        }
    }

    /// Residual at the current increment, and the assembled tangent if asked for.
    fn residual(&self, work: &mut Workspace, tangent: bool) {
        if tangent { self.residual_with::<true>(work) } else { self.residual_with::<false>(work) }
    }

    fn residual_with<const TANGENT: bool>(&self, work: &mut Workspace) {
        let Workspace { increment, residual, tangent, .. } = work;
        let rule = &self.integration;
        let chain = &mut tangent.chain;
        assemble::beams::<TANGENT>(
            self.model,
            self.state,
            rule,
            self.gravity,
            increment,
            residual,
            chain,
        );
        external::apply::<TANGENT>(
            self.model,
            self.state,
            rule.h,
            rule.theta(),
            increment,
            residual,
            chain,
        );
        for (c, multiplier) in self.model.constraints.iter().zip(&work.multiplier) {
            let u = &self.state.displacement;
            constraint::add_gradient(c, u, increment, 0.5, *multiplier, residual);
        }
        self.springs::<TANGENT>(work);
        for contact in self.active {
            let p = &self.model.projectiles[contact.projectile];
            let force = work.impulse[contact.projectile] / self.integration.h;
            p.point.spread(scale(-force, p.direction), &mut work.residual);
        }
    }

    /// Contact springs, their projectiles' unknowns condensed into the band (theory, section 4).
    fn springs<const TANGENT: bool>(&self, work: &mut Workspace) {
        let rule = &self.integration;
        for (i, p) in self.model.projectiles.iter().enumerate() {
            let ContactLaw::Spring { stiffness, force } = p.law else { continue };
            let state = &self.state.projectiles[i];
            let p0 = -self.state.gap(self.model, i);
            let moved = dot(p.direction, p.point.value(&work.increment));
            let p1 = p0 + work.travel[i] - moved;
            let step = match rule.rule {
                Rule::Midpoint(_) => law::step_force(force, stiffness, p0, p1),
                Rule::Alpha(_) | Rule::Static { .. } => {
                    law::collocated(stiffness, p0, p1, rule.theta())
                }
            };
            work.force[i] = step.force;
            let acceleration = rule.inertia(work.travel[i], state.speed, state.acceleration);
            work.projectile_residual[i] =
                step.force + p.mass * (acceleration - dot(self.gravity, p.direction));
            p.point.spread(scale(-step.force, p.direction), &mut work.residual);
            if TANGENT {
                work.spring_slope[i] = step.slope;
                if step.slope != 0.0 {
                    let inertia = p.mass * rule.inertia_slope();
                    let k = step.slope * inertia / (inertia + step.slope);
                    let d = p.direction;
                    let matrix =
                        [[k * d[0] * d[0], k * d[0] * d[1]], [k * d[1] * d[0], k * d[1] * d[1]]];
                    let (node, n) = (p.point.node, &p.point.shape);
                    work.tangent.chain.add_outer(node, n, n, &matrix);
                }
            }
        }
    }

    fn factor(&self, work: &mut Workspace) -> Result<(), Failure> {
        let u = &self.state.displacement;
        work.tangent.factor(self.model, u, &work.increment)?;
        let (nodes, constraints) = (self.model.node_count(), self.model.constraints.len());
        if work.contact_columns.len() < self.active.len() {
            let empty = (vec![[0.0; 4]; nodes], vec![0.0; constraints]);
            work.contact_columns.resize(self.active.len(), empty);
        }
        for (contact, (column, multiplier)) in self.active.iter().zip(&mut work.contact_columns) {
            let p = &self.model.projectiles[contact.projectile];
            column.fill([0.0; 4]);
            multiplier.fill(0.0);
            p.point.spread(p.direction, column);
            work.tangent.solve(self.model, u, &work.increment, column, multiplier, true);
        }
        Ok(())
    }

    /// One correction of the increment; returns the work of the unbalanced forces on it.
    fn correct(&self, work: &mut Workspace) -> Result<f64, Failure> {
        let rule = &self.integration;
        for (c, r) in work.correction.iter_mut().zip(&work.residual) {
            *c = r.map(|x| -x);
        }
        for (i, p) in self.model.projectiles.iter().enumerate() {
            let slope = work.spring_slope[i];
            if slope != 0.0 {
                let inertia = p.mass * rule.inertia_slope();
                let force = -slope * work.projectile_residual[i] / (inertia + slope);
                p.point.spread(scale(force, p.direction), &mut work.correction);
            }
        }
        let u = &self.state.displacement;
        let Workspace { tangent, correction, multiplier, increment, .. } = work;
        tangent.solve(self.model, u, increment, correction, multiplier, false);
        self.impact(work)?;
        let mut correction_work = 0.0;
        for ((d, c), r) in work.increment.iter_mut().zip(&work.correction).zip(&work.residual) {
            for i in 0..4 {
                d[i] += c[i];
                correction_work += (c[i] * r[i]).abs();
            }
        }
        for (i, p) in self.model.projectiles.iter().enumerate() {
            if matches!(p.law, ContactLaw::Spring { .. }) {
                let inertia = p.mass * rule.inertia_slope();
                let (slope, r) = (work.spring_slope[i], work.projectile_residual[i]);
                let moved = dot(p.direction, p.point.value(&work.correction));
                work.travel[i] += (slope * moved - r) / (inertia + slope);
            }
        }
        self.move_rigid(work);
        Ok(correction_work)
    }

    /// Impulses of the active contacts from the Delassus operator of the factored tangent, and what they change.
    fn impact(&self, work: &mut Workspace) -> Result<(), Failure> {
        let n = self.active.len();
        if n == 0 {
            return Ok(());
        }
        let h = self.integration.h;
        let rate_per_force = 2.0 / (h * h); // of the gap, for the midpoint rule: v1 = 2 d/h - v0, force L/h
        let problem = &mut work.impact;
        problem.delassus.resize(n * n, 0.0);
        problem.free.resize(n, 0.0);
        problem.bound.resize(n, 0.0);
        work.active_impulse.resize(n, 0.0);
        for (a, contact) in self.active.iter().enumerate() {
            let i = contact.projectile;
            let p = &self.model.projectiles[i];
            for (b, (column, _)) in work.contact_columns[..n].iter().enumerate() {
                problem.delassus[a * n + b] =
                    rate_per_force * dot(p.direction, p.point.value(column));
            }
            problem.delassus[a * n + a] += 1.0 / p.mass;
            work.active_impulse[a] = work.impulse[i];
            let d = p.point.value(&work.increment);
            let c = p.point.value(&work.correction);
            let v0 = p.point.value(&self.state.velocity);
            let beam: f64 =
                (0..2).map(|k| p.direction[k] * (2.0 * (d[k] + c[k]) / h - v0[k])).sum();
            let speed = self.state.projectiles[i].speed + h * dot(self.gravity, p.direction)
                - work.impulse[i] / p.mass;
            let row = &problem.delassus[a * n..(a + 1) * n];
            let carried: f64 =
                self.active.iter().zip(row).map(|(c, w)| w * work.impulse[c.projectile]).sum();
            problem.free[a] = beam - speed - carried;
            problem.bound[a] = contact.bound;
        }
        problem.solve(&mut work.active_impulse)?;
        for (a, contact) in self.active.iter().enumerate() {
            let change = work.active_impulse[a] - work.impulse[contact.projectile];
            work.impulse[contact.projectile] = work.active_impulse[a];
            let (column, multiplier) = &work.contact_columns[a];
            for (target, c) in work.correction.iter_mut().zip(column) {
                for i in 0..4 {
                    target[i] += change / h * c[i];
                }
            }
            for (target, m) in work.multiplier.iter_mut().zip(multiplier) {
                *target += change / h * m;
            }
        }
        Ok(())
    }

    /// Work of the unbalanced forces over the step, all taken with the same sign \[J\].
    fn unbalanced_work(&self, work: &mut Workspace) -> f64 {
        let Workspace { residual, correction, increment, .. } = work;
        // The correction is free now: it holds the residual without the reactions of the supports.
        correction.copy_from_slice(residual);
        project(self.model, correction);
        let mut sum = 0.0;
        for (r, d) in correction.iter().zip(increment.iter()) {
            for i in 0..4 {
                sum += (r[i] * d[i]).abs();
            }
        }
        for (r, d) in work.projectile_residual.iter().zip(&work.travel) {
            sum += (r * d).abs();
        }
        sum
    }

    /// Impulse of the unbalanced forces \[N s\]; follows [`StepProblem::unbalanced_work`], whose projection it uses.
    fn unbalanced_impulse(&self, work: &Workspace) -> f64 {
        let mut sum = [0.0; 2];
        for r in &work.correction {
            sum[0] += r[0];
            sum[1] += r[1];
        }
        for (p, r) in self.model.projectiles.iter().zip(&work.projectile_residual) {
            sum[0] += p.direction[0] * r;
            sum[1] += p.direction[1] * r;
        }
        self.integration.h * sum[0].hypot(sum[1])
    }

    /// Momentum that goes with an energy: a scale.
    fn momentum(&self, energy: f64) -> f64 {
        (2.0 * self.model.total_mass * energy).sqrt()
    }

    fn constraints_met(&self, work: &Workspace) -> bool {
        let u = &self.state.displacement;
        self.model.constraints.iter().all(|c| {
            let (_, reach) = largest(u);
            constraint::value(c, u, &work.increment).abs() <= ROUND_OFF * (1.0 + reach)
        })
    }
}

/// Watches an iteration: how fast it contracts, and whether it has reached the last digit.
#[derive(Clone, Copy, Debug)]
struct Watch {
    /// Largest energy in play \[J\].
    energy: f64,
    /// Unbalanced work now, and before the last correction \[J\].
    unbalanced: f64,
    before: f64,
    /// Unbalanced work per size of correction, at the first one.
    stiffness: f64,
    /// Size of the last correction, and its ratio to the one before.
    size: f64,
    rate: f64,
    /// Whether further corrections would move nothing but round-off.
    settled: bool,
}

impl Watch {
    fn new(energy: f64) -> Self {
        let infinity = f64::INFINITY;
        Self {
            energy,
            unbalanced: infinity,
            before: infinity,
            stiffness: infinity,
            size: infinity,
            rate: infinity,
            settled: false,
        }
    }

    fn unbalanced(&mut self, unbalanced: f64) {
        self.before = std::mem::replace(&mut self.unbalanced, unbalanced);
    }

    /// Whether the last factored tangent is still good enough. On very fine meshes the unbalanced work soon is round-off
    /// and no longer falls; the corrections then still tell.
    fn contracts(&self) -> bool {
        self.unbalanced <= CONTRACTION * self.before || self.rate <= CONTRACTION
    }

    /// Whether only round-off is left, and little of it.
    fn settled(&self) -> bool {
        self.settled && self.unbalanced <= MOST_ROUND_OFF * self.energy
    }

    fn corrected(&mut self, size: f64, correction_work: f64, reach: f64, step: f64) {
        if self.size.is_infinite() {
            self.energy = self.energy.max(correction_work);
            self.stiffness = self.unbalanced / size;
        } else {
            self.rate = size / self.size;
        }
        self.size = size;
        let round_off = size <= ROUND_OFF * reach.max(step);
        // What the next correction would find unbalanced, were there no round-off.
        let ahead = size * self.rate * self.stiffness;
        let predicted = self.rate <= CONTRACTION && ahead <= WORK_TOLERANCE * self.energy;
        let stalled = self.rate > 0.5 && self.rate.is_finite() && size <= STALLED * step;
        self.settled = round_off || predicted || stalled;
    }
}

/// Node and magnitude of the largest component.
fn largest(nodal: &[[f64; 4]]) -> (usize, f64) {
    let mut found = (0, 0.0);
    for (n, x) in nodal.iter().enumerate() {
        let size = x.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        if size > found.1 {
            found = (n, size);
        }
    }
    found
}
