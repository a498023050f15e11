//! Whether a step is solved: unbalanced work and impulse relative to the energy and the momentum of the run.

use super::{IMPULSE_TOLERANCE, MOST_IMPULSE, StepProblem, TURNED_TOLERANCE, largest};
use crate::model::frozen::Constraint;
use crate::step::convergence::{ConvergenceMonitor, ROUND_OFF, WORK_TOLERANCE};
use crate::step::external;
use crate::step::tangent::project;
use crate::step::workspace::Workspace;

impl StepProblem<'_> {
    /// The largest energy of the run so far, or the work of the loads in this step; in a first step without either, the work of the first correction.
    pub(super) fn energy_scale(&self, work: &Workspace, correction_work: f64) -> f64 {
        let rule = &self.integration;
        let loads = external::work(
            self.model,
            self.state,
            rule.h,
            rule.theta(),
            self.forcing,
            &work.increment,
        );
        // Moving supports cause no unbalanced forces at the predictor.
        let moved = |(c, m): (&Constraint, &f64)| (m * self.forcing.increment(&c.drive)).abs();
        let mut supports: f64 =
            self.model.constraints.iter().zip(&work.multiplier).map(moved).sum();
        for dofs in &self.model.prescribed {
            for (n, drive) in dofs.normals.iter().zip(&dofs.drives) {
                let force: f64 = (0..4).map(|k| n[k] * work.residual[dofs.node][k]).sum();
                supports += (force * self.forcing.increment(drive)).abs();
            }
        }
        let energy = self.state.ledger.energy_scale.max(loads.work.abs()).max(supports);
        if energy > 0.0 { energy } else { correction_work }
    }

    /// Whether the unbalanced forces are zero or round-off.
    pub(super) fn balanced(&self, work: &Workspace, convergence: &ConvergenceMonitor<f64>) -> bool {
        let impulse = self.unbalanced_impulse(work) / self.momentum_scale(convergence.energy);
        if convergence.settled() && (impulse <= MOST_IMPULSE || impulse.is_nan()) {
            return true;
        }
        // Forces along forms that have turned since may do no work and still have a moment.
        let turned = work.turned / self.momentum_scale(convergence.energy);
        convergence.unbalanced <= WORK_TOLERANCE * convergence.energy
            && (turned <= TURNED_TOLERANCE || turned.is_nan())
            && (impulse <= IMPULSE_TOLERANCE || impulse.is_nan())
            && self.constraints_met(work)
    }

    /// Work of the unbalanced forces over the step, all taken with the same sign \[J\].
    pub(super) fn unbalanced_work(&self, work: &mut Workspace) -> f64 {
        let Workspace { residual, correction, increment, .. } = work;
        // The correction is free now: it stores the residual without the reactions of the supports.
        correction.copy_from_slice(residual);
        project(self.model, correction);
        let mut sum = 0.0;
        for (r, d) in correction.iter().zip(increment.iter()) {
            for i in 0..4 {
                sum += (r[i] * d[i]).abs();
            }
        }
        sum
    }

    /// Impulse of the unbalanced forces \[N s\]; follows [`StepProblem::unbalanced_work`], whose projection it uses.
    pub(super) fn unbalanced_impulse(&self, work: &Workspace) -> f64 {
        let mut sum = [0.0; 2];
        for r in &work.correction {
            sum[0] += r[0];
            sum[1] += r[1];
        }
        self.integration.h * sum[0].hypot(sum[1])
    }

    /// The largest momentum of the run so far, or the one corresponding to the energy scale; NaN without motion.
    pub(super) fn momentum_scale(&self, energy: f64) -> f64 {
        let scale = (2.0 * self.model.total_mass * energy).sqrt();
        let scale = scale.max(self.state.ledger.linear_scale);
        if scale > 0.0 { scale } else { f64::NAN }
    }

    pub(super) fn constraints_met(&self, work: &Workspace) -> bool {
        let u = &self.state.displacement;
        let reach = largest(u, self.size);
        let step = largest(&work.increment, self.size);
        // Tolerance of positions, and of angles times the size of the structure.
        let tolerance = ROUND_OFF * (step + self.feedback * (self.size + reach));
        let seen = self.constraint_step(&work.increment);
        self.model.constraints.iter().zip(&self.forcing.constrained).all(|(c, acts)| {
            let unit = if c.kind.is_of_slopes() { self.size } else { 1.0 };
            let left = seen.change(c) + self.feedback * seen.start_value(c);
            !acts || unit * left.abs() <= tolerance
        })
    }
}
