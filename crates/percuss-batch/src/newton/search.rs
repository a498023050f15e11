//! Where the iterations of the runs stand, lane by lane: what is still to be corrected, and what the factors in use are good for.

use percuss::internals::scalar::{Mask, Number};
use percuss::internals::step::convergence::{ConvergenceMonitor, WORK_TOLERANCE};
use percuss::internals::step::newton::{IMPULSE_TOLERANCE, MOST_IMPULSE};

/// Factors of the tangent serve at most so many steps: masses dominate it, so it changes little, and renewing it costs as much as
/// two corrections.
const MOST_SERVICE: f64 = 8.0;

/// The same where lanes go by parts of their own: they seldom renew together, and every renewal costs all of them.
const MOST_SERVICE_APART: f64 = 32.0;

/// So large a share of the size of a step, up to which it differs from the one that the tangent was factored for, costs no correction.
const NEARLY: f64 = 1e-3;

/// The iterations of the runs, lane by lane.
#[derive(Clone, Copy, Debug)]
pub struct LaneNewton<S: Number> {
    /// Whether there is a run in the lane.
    pub live: S::Mask,
    /// Whether the step found no solution.
    pub failed: S::Mask,
    /// Still to be corrected.
    pub seeking: S::Mask,
    pub convergence: ConvergenceMonitor<S>,
    /// Impulse left unbalanced, relative to the momentum scale.
    impulse: S,
    /// Whether the last correction leaves nothing, by its contraction.
    pub foreseen: S::Mask,
    /// The size of the step that the tangent was factored for \[s\], the steps it has served, and those it may serve.
    factored_for: S,
    served: S,
    service: S,
    /// Whether the tangent is to be factored anew.
    pub renew: S::Mask,
    /// Size of the last step \[s\].
    pub size: S,
    /// Accelerations, as a share of those of the step before, by the square of what this one is longer: if they stay, if none, if that
    /// step was not accepted; and whether others say so than steps of the same size.
    pub ahead: S,
    pub by_parts: bool,
    /// Share of the last change of these additions that is expected again.
    pub trusted: S,
    /// Corrections and factorisations of the run so far.
    pub iterations: S,
    pub factorizations: S,
}

impl<S: Number> LaneNewton<S> {
    /// No lane has a run yet.
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

    /// Begins with a run in a lane, or with none.
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
            // Derivatives need the tangent at the solution anyway.
            let steady = if S::DERIVES { no } else { h.equals(self.size) };
            self.ahead = S::choose(steady, h.constant(1.0), h.constant(0.0));
        }
        let before = std::mem::replace(&mut self.size, h);
        self.served += h.constant(1.0);
        let due = if S::DERIVES { !no } else { self.service.at_most(self.served) };
        self.renew = self.live & (due | !self.fits(h));
        let most = h.constant(if self.by_parts { MOST_SERVICE_APART } else { MOST_SERVICE });
        let longer = self.service + h.constant(1.0);
        let longer = longer.if_less(most, longer, most);
        self.service = S::choose(due, longer, self.service);
        before
    }

    /// Whether the factors are those of steps of size `h`, or of nearly that.
    #[inline(always)]
    pub fn fits(&self, h: S) -> S::Mask {
        let near = h * if self.by_parts { NEARLY } else { 0.0 };
        (h - self.factored_for).abs().at_most(near)
    }

    /// Wants the tangent renewed if the iteration no longer contracts well.
    #[inline(always)]
    pub fn judge(&mut self) {
        self.renew = self.seeking & !self.convergence.contracts();
        let shorter = (self.service * 0.5).max(self.service.constant(1.0));
        self.service = S::choose(self.renew, shorter, self.service);
    }

    /// Takes in new factors of the lanes that wanted them.
    #[inline(always)]
    pub fn renewed(&mut self, h: S) {
        let (renew, zero) = (self.renew, h.constant(0.0));
        self.factorizations += S::choose(renew, h.constant(1.0), zero);
        self.served = S::choose(renew, zero, self.served);
        self.factored_for = S::choose(renew, h, self.factored_for);
        self.renew = h.less(h);
    }

    /// Looks ahead after a correction: the work and the impulse left by one that contracted well are known from those before it,
    /// round-off apart; not where something may begin to yield.
    #[inline(always)]
    pub fn foresee(&mut self) {
        let small = self.impulse.constant(IMPULSE_TOLERANCE);
        let impulse = self.impulse * self.convergence.left_share();
        let work = self.convergence.work_left();
        self.foreseen =
            work.at_most(self.convergence.energy * WORK_TOLERANCE) & impulse.at_most(small);
    }

    /// Looks at what is unbalanced: nothing, or nothing but round-off, and the lane is done.
    #[inline(always)]
    pub fn weigh(&mut self, work: S, impulse: S, met: S::Mask, corrections: usize) {
        self.convergence.unbalanced(work);
        self.impulse = impulse;
        self.failed = self.failed | self.seeking & !work.finite();
        self.seeking = self.seeking & work.finite();
        if corrections > 0 {
            let small = work.constant(IMPULSE_TOLERANCE);
            // Where nothing moves the impulse is NaN, and passes.
            let exact =
                work.at_most(self.convergence.energy * WORK_TOLERANCE) & !small.less(impulse) & met;
            let passable = !work.constant(MOST_IMPULSE).less(impulse);
            let done = exact | (self.foreseen & met | self.convergence.settled()) & passable;
            self.seeking = self.seeking & !done;
        }
    }
}
