//! Increments of the runs of an ensemble: prediction, unbalanced work and impulse, and corrections.

use super::search::LaneNewton;
use crate::engine::Engine;
use crate::ledger::LaneLedger;
use percuss::internals::scalar::Number;
use percuss::internals::step::projection::project_held;

/// Unbalanced work and impulse of an increment.
pub(super) struct Unbalanced<S> {
    /// Work over the step, sum of magnitudes \[J\].
    pub work: S,
    /// Impulse \[N s\].
    pub impulse: S,
}

impl<S: Number> Engine<S> {
    /// Increments for the accelerations of the previous step, of size `before`, times `ahead`, which includes the ratio of the squared sizes, plus
    /// the share `trusted` of their last change.
    #[inline(always)]
    pub(super) fn predict(&mut self, before: S, ahead: S, trusted: S) {
        let (zero, extrapolated) = (self.h.constant(0.0), !ahead.equals(self.h.constant(0.0)));
        for n in 0..self.increment.len() {
            for i in 0..4 {
                let v = self.velocity[n][i];
                let last = (before * v - self.increment[n][i]) * ahead;
                let change = last + (last - self.trend[n][i]) * trusted;
                self.trend[n][i] = S::choose(extrapolated, last, zero);
                self.increment[n][i] = self.h * v + S::choose(extrapolated, change, zero);
            }
        }
        project_held(&self.numbers.prescribed, &mut self.increment);
        self.predict_multipliers();
        for guide in &mut self.guides {
            let v = guide.velocity;
            let change = (before * v - guide.increment) * ahead;
            guide.increment = self.h * v + S::choose(extrapolated, change, zero);
            if self.press.is_some() {
                guide.impulse = zero; // determined again in this step
            }
        }
    }

    #[inline(always)]
    pub(super) fn unbalanced(&self) -> Unbalanced<S> {
        let zero = self.h.constant(0.0);
        let (mut work, mut sum) = (zero, [zero; 2]);
        for n in 0..self.increment.len() {
            let (r, d) = (&self.residual[n], &self.increment[n]);
            for i in 0..4 {
                work += (r[i] * d[i]).abs();
            }
            for i in 0..2 {
                sum[i] += r[i];
            }
        }
        for k in 0..self.guides.len() {
            let (guide, state) = (&self.numbers.guides[k], &self.guides[k]);
            work += (state.residual * state.increment).abs();
            for i in 0..2 {
                sum[i] += state.residual * guide.direction[i];
            }
        }
        let impulse = self.h * (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
        Unbalanced { work, impulse }
    }

    /// Adds the correction to the increments of the lanes that iterate.
    #[inline(always)]
    pub(super) fn take(
        &mut self,
        search: &mut LaneNewton<S>,
        reach: S,
        ledger: &LaneLedger<S>,
        first: bool,
    ) {
        let (zero, seeking) = (self.h.constant(0.0), search.seeking);
        let length = self.numbers.size;
        let (mut work, mut size, mut step) = (zero, zero, zero);
        for n in 0..self.increment.len() {
            let (d, c, r) = (&mut self.increment[n], &self.correction[n], &self.residual[n]);
            for i in 0..4 {
                work += (c[i] * r[i]).abs();
                d[i] += S::choose(seeking, c[i], zero);
                let (moved, stepped) = (c[i].abs(), d[i].abs());
                size = size.max(if i < 2 { moved } else { moved * length });
                step = step.max(if i < 2 { stepped } else { stepped * length });
            }
        }
        self.constraints.correct(seeking);
        let mut force = zero;
        for guide in &mut self.guides {
            work += (guide.correction * guide.residual).abs();
            size = size.max(guide.correction.abs());
            guide.increment += S::choose(seeking, guide.correction, zero);
            step = step.max(guide.increment.abs());
            force += guide.force + guide.impulse;
        }
        if first {
            let scale = ledger.sums.energy_scale;
            search.convergence.set_energy_scale(zero.if_less(scale, scale, work));
        }
        let places = zero.if_less(force, self.numbers.round_off.size, zero);
        search.convergence.corrected(size, reach, step, work, places);
        search.iterations += S::choose(seeking, zero.constant(1.0), zero);
        if self.fibres.is_empty() {
            search.foresee();
        }
    }
}

/// The largest component \[m\], slopes multiplied by a length.
#[inline(always)]
pub(super) fn largest<S: Number>(nodal: &[[S; 4]], length: S) -> S {
    let mut most = length.constant(0.0);
    for x in nodal {
        for i in 0..2 {
            most = most.max(x[i].abs()).max(x[2 + i].abs() * length);
        }
    }
    most
}
