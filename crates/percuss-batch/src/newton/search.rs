//! State of the iterations in all lanes: lanes still to be corrected, and the use of the factors.

use percuss::internals::scalar::{Mask, Number};
use percuss::internals::step::convergence::{ConvergenceMonitor, WORK_TOLERANCE};
use percuss::internals::step::newton::{IMPULSE_TOLERANCE, MOST_IMPULSE};

/// Largest number of steps with the same factors of the tangent: masses dominate it, so it changes little, and a factorisation costs as much as two
/// corrections.
const MOST_SERVICE: f64 = 8.0;

/// The same for lanes with individual parts of steps: their factorisations seldom coincide, and each one costs all lanes.
const MOST_SERVICE_APART: f64 = 32.0;

/// Relative difference of the step size to that of the factored tangent that does not cost an additional correction.
const NEARLY: f64 = 1e-3;

/// The iterations of all lanes.
#[derive(Clone, Copy, Debug)]
pub struct LaneNewton<S: Number> {
    /// Whether there is a run in the lane.
    pub live: S::Mask,
    /// Whether the step found no solution.
    pub failed: S::Mask,
    /// Whether the lane still iterates.
    pub seeking: S::Mask,
    pub convergence: ConvergenceMonitor<S>,
    /// Unbalanced impulse, relative to the momentum scale.
    impulse: S,
    /// Whether the last correction leaves a negligible residual, as predicted from its contraction.
    pub foreseen: S::Mask,
    /// Size of the step for which the tangent was factored \[s\], the number of steps with these factors, and its limit.
    factored_for: S,
    served: S,
    service: S,
    /// Whether the tangent is to be factored again.
    pub renew: S::Mask,
    /// Size of the last step \[s\].
    pub size: S,
    /// Accelerations relative to those of the previous step, times the ratio of the squared sizes (1 for a constant acceleration, 0 without
    /// extrapolation, negative after a step that was not accepted); and whether the driver of lanes with parts of steps sets it.
    pub ahead: S,
    pub by_parts: bool,
    /// Share of the last change of accelerations that is extrapolated.
    pub trusted: S,
    /// Corrections and factorisations of the run so far.
    pub iterations: S,
    pub factorizations: S,
}

impl<S: Number> LaneNewton<S> {
    /// State without a run in any lane.
    pub fn idle(like: S) -> Self {
        let (zero, never) = (like.constant(0.0), like.constant(f64::NAN));
        let no = zero.less(zero);
        Self {
            live: no,
            failed: no,
            seeking: no,
            convergence: ConvergenceMonitor::new(zero),
            impulse: zero,
            foreseen: no,
            factored_for: never,
            served: zero,
            service: zero.constant(MOST_SERVICE),
            renew: no,
            size: never,
            ahead: zero,
            by_parts: false,
            trusted: zero,
            iterations: zero,
            factorizations: zero,
        }
    }

    /// Begins a run in a lane, or leaves the lane without one.
    pub fn set_run(&mut self, lane: usize, live: bool) {
        let fresh = Self::idle(self.size);
        for (mine, new) in [
            (&mut self.factored_for, fresh.factored_for),
            (&mut self.served, fresh.served),
            (&mut self.service, fresh.service),
            (&mut self.size, fresh.size),
            (&mut self.iterations, fresh.iterations),
            (&mut self.factorizations, fresh.factorizations),
        ] {
            mine.set_lane(lane, new, lane);
        }
        let before = self.live;
        self.live = self.size.mask(|i| if i == lane { live } else { before.lane(i) });
    }
}

impl<S: Number> LaneNewton<S> {
    /// Begins a step of size `h`; returns the size of the last one.
    #[inline(always)]
    pub fn begin(&mut self, energy: S, h: S) -> S {
        let no = h.less(h);
        self.convergence = ConvergenceMonitor::new(energy);
        (self.seeking, self.failed) = (self.live, no);
        if !self.by_parts {
            let steady = h.equals(self.size);
            self.ahead = S::choose(steady, h.constant(1.0), h.constant(0.0));
        }
        let before = std::mem::replace(&mut self.size, h);
        self.served += h.constant(1.0);
        let due = self.service.at_most(self.served);
        self.renew = self.live & (due | !self.fits(h));
        let most = h.constant(if self.by_parts { MOST_SERVICE_APART } else { MOST_SERVICE });
        let longer = self.service + h.constant(1.0);
        let longer = longer.if_less(most, longer, most);
        self.service = S::choose(due, longer, self.service);
        before
    }

    /// Whether the factors were computed for steps of about the size `h`.
    #[inline(always)]
    pub fn fits(&self, h: S) -> S::Mask {
        let near = h * if self.by_parts { NEARLY } else { 0.0 };
        (h - self.factored_for).abs().at_most(near)
    }

    /// Requests new factors if the iteration no longer contracts well.
    #[inline(always)]
    pub fn judge(&mut self) {
        self.renew = self.seeking & !self.convergence.contracts();
        let shorter = (self.service * 0.5).max(self.service.constant(1.0));
        self.service = S::choose(self.renew, shorter, self.service);
    }

    /// Records new factors in the lanes that requested them.
    #[inline(always)]
    pub fn renewed(&mut self, h: S) {
        let (renew, zero) = (self.renew, h.constant(0.0));
        self.factorizations += S::choose(renew, h.constant(1.0), zero);
        self.served = S::choose(renew, zero, self.served);
        self.factored_for = S::choose(renew, h, self.factored_for);
        self.renew = h.less(h);
    }

    /// Predicts the work and impulse that remain after a correction that contracted well from the previous ones, except for round-off; not valid
    /// where fibres may begin to yield.
    #[inline(always)]
    pub fn foresee(&mut self) {
        let small = self.impulse.constant(IMPULSE_TOLERANCE);
        let impulse = self.impulse * self.convergence.left_share();
        let work = self.convergence.work_left();
        self.foreseen =
            work.at_most(self.convergence.energy * WORK_TOLERANCE) & impulse.at_most(small);
    }

    /// Tests the unbalanced work and impulse: a lane whose values are zero or round-off has converged.
    #[inline(always)]
    pub fn weigh(&mut self, work: S, impulse: S, met: S::Mask, corrections: usize) {
        self.convergence.unbalanced(work);
        self.impulse = impulse;
        self.failed = self.failed | self.seeking & !work.finite();
        self.seeking = self.seeking & work.finite();
        if corrections > 0 {
            let small = work.constant(IMPULSE_TOLERANCE);
            // Without motion the impulse is NaN, and passes the test.
            let exact =
                work.at_most(self.convergence.energy * WORK_TOLERANCE) & !small.less(impulse) & met;
            let passable = !work.constant(MOST_IMPULSE).less(impulse);
            let done = exact | (self.foreseen & met | self.convergence.settled()) & passable;
            self.seeking = self.seeking & !done;
        }
    }
}
