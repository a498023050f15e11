//! Impulses of the rigid contacts of a step: the problem that the Delassus operator of the factored tangent poses, and its solution.

use super::contacts::{ActiveContact, GAP_RESOLUTION, IMPULSIVE, ImpulseLaw, Phase};
use super::newton::{Failure, StepProblem};
use super::workspace::Workspace;
use crate::geometry::pair::Target;

impl StepProblem<'_> {
    /// Answers of the factored tangent to unit forces along the rows of the active contacts.
    pub(super) fn contact_columns(&self, work: &mut Workspace) {
        let (nodes, constraints) = (self.model.node_count(), self.model.constraints.len());
        let rows = 2 * self.active.len();
        if work.contact_columns.len() < rows {
            work.contact_columns.resize(rows, (vec![[0.0; 4]; nodes], vec![0.0; constraints]));
        }
        for k in 0..rows {
            let row = work.rigid[k / 2].row(k);
            if row.is_empty() {
                continue;
            }
            let (column, multiplier) = &mut work.contact_columns[k];
            column.fill([0.0; 4]);
            multiplier.fill(0.0);
            row.spread(1.0, column);
            let step = self.constraint_step(&work.increment);
            work.tangent.solve(self.model, &step, column, multiplier, None);
        }
    }

    /// Impulses of the active contacts from the Delassus operator of the factored tangent, and their effect.
    pub(super) fn impact(&self, work: &mut Workspace) -> Result<(), Failure> {
        let n = self.active.len();
        if n == 0 {
            return Ok(());
        }
        self.pose(work);
        work.impulses.clear();
        work.impulses.extend(work.rigid[..n].iter().flat_map(|c| c.impulse));
        if self.law == ImpulseLaw::Moreau {
            self.expand(work)?;
        } else {
            work.impact.solve(&mut work.impulses)?;
            work.impact_residual = relative_residual(work);
        }
        let h = self.integration.h;
        for k in 0..2 * n {
            let impulse = &mut work.rigid[k / 2].impulse[k % 2];
            let change = work.impulses[k] - *impulse;
            *impulse = work.impulses[k];
            if change == 0.0 {
                continue;
            }
            let (column, multiplier) = &work.contact_columns[k];
            for (target, c) in work.correction.iter_mut().zip(column) {
                (0..4).for_each(|i| target[i] += change / h * c[i]);
            }
            for (target, m) in work.multiplier.iter_mut().zip(multiplier) {
                *target += change / h * m;
            }
        }
        Ok(())
    }

    /// Poses the problem of the impulses: operator, rates without impulses, conditions.
    fn pose(&self, work: &mut Workspace) {
        let (n, h) = (self.active.len(), self.integration.h);
        let rate_per_force = 2.0 / (h * h); // for the midpoint rule: v1 = 2 d/h - v0, force L/h
        let problem = &mut work.impact;
        problem.resize(n);
        let m = 2 * n;
        for a in 0..m {
            let row = work.rigid[a / 2].row(a);
            for b in 0..m {
                let moves = !row.is_empty() && !work.rigid[b / 2].row(b).is_empty();
                let rate = || rate_per_force * row.on(&work.contact_columns[b].0);
                problem.delassus[b * m + a] = if moves { rate() } else { 0.0 };
            }
            let carried: f64 = (0..m)
                .map(|b| problem.delassus[b * m + a] * work.rigid[b / 2].impulse[b % 2])
                .sum();
            let moved = row.on(&work.increment) + row.on(&work.correction);
            problem.free[a] = 2.0 * moved / h - row.on(&self.state.velocity) - carried;
        }
        for (a, contact) in self.active.iter().enumerate() {
            let condition = &mut problem.contacts[a];
            let (seen, rows) = (self.seen(contact.pair), &work.rigid[a]);
            let law = self.rigid_law(contact.pair);
            let before = rows.normal.on(&self.state.velocity);
            condition.friction = law.map_or(0.0, |law| law.friction);
            condition.bound = match contact.phase {
                Phase::Resting { .. } => self.resting_bound(contact, before, seen.gap),
                phase => phase.least_rate(before),
            };
            condition.carried = contact.phase.carried();
            if self.law == ImpulseLaw::Mean
                && matches!(contact.phase, Phase::PlasticPostStep { .. })
            {
                // A zero mean sliding velocity does not cancel previous friction.
                condition.friction = 0.0;
            }
            let sliding = rows.tangent.on(&self.state.velocity);
            condition.target = match contact.phase {
                _ if self.law == ImpulseLaw::Mean => -sliding,
                Phase::Impact { tangential, .. } => -tangential * sliding,
                Phase::Resting { mean: true } => -sliding,
                Phase::Resting { mean: false } | Phase::PlasticPostStep { .. } => 0.0,
            };
        }
    }

    /// Least rate at the end of the step of a contact that remains closed.
    ///
    /// The gap of a guided projectile is linear: the rate vanishes, or, if the contact opens at the start of the step, its mean, so that the
    /// impulse does not create energy. For other contacts the mean rate closes the remaining gap: the gap neither drifts nor creates energy, for
    /// any rotation of the normal. In steps as short as an impact interval a remaining gap would be a velocity, and one of round-off would be in
    /// any step: twice the gap over the step, which grows in the following free motion into a larger gap.
    fn resting_bound(&self, contact: &ActiveContact, before: f64, gap: f64) -> f64 {
        let guided = matches!(self.model.pairs[contact.pair].target, Target::Guided { .. });
        if guided || self.feedback < IMPULSIVE {
            contact.phase.least_rate(before)
        } else {
            let left = (gap - GAP_RESOLUTION * self.positions).max(0.0);
            -before - 2.0 * left / self.integration.h
        }
    }

    /// Moreau's law: the impulses of the plastic impact, times 1 + e with the least coefficient of all that strike.
    fn expand(&self, work: &mut Workspace) -> Result<(), Failure> {
        let each = self.active.iter().filter_map(|c| match c.phase {
            Phase::Impact { restitution, .. } => Some(restitution),
            Phase::Resting { .. } | Phase::PlasticPostStep { .. } => None,
        });
        let e = each.fold(1.0, f64::min);
        for condition in &mut work.impact.contacts {
            condition.bound = 0.0;
            condition.target = 0.0;
        }
        let scale = 1.0 + e;
        work.impulses.iter_mut().for_each(|l| *l /= scale);
        work.impact.solve(&mut work.impulses)?;
        work.impact_residual = relative_residual(work);
        work.impulses.iter_mut().for_each(|l| *l *= scale);
        Ok(())
    }
}

fn relative_residual(work: &Workspace) -> f64 {
    let scale = work.impact.scale();
    if scale > 0.0 { work.impact.residual(&work.impulses) / scale } else { 0.0 }
}
