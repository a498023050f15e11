//! Newton's iteration of the runs of an ensemble: each converges on its own, by the tests of a single run.

mod increments;

use self::increments::largest;
use super::constraints::FOLLOWING;
use super::engine::Engine;
use super::ledger::LaneLedger;
use percuss::internals::model::frozen::ConstraintKind;
use percuss::internals::scalar::{Mask, Number, Task};
use percuss::internals::step::convergence::{ConvergenceMonitor, WORK_TOLERANCE};
use percuss::internals::step::newton::{IMPULSE_TOLERANCE, MOST_IMPULSE, MOST_ITERATIONS};

/// Factors of the tangent serve at most so many steps: masses dominate it, so it changes little, and renewing it costs as much as
/// two corrections.
const MOST_SERVICE: f64 = 8.0;

/// The same where lanes go by parts of their own: they seldom renew together, and every renewal costs all of them.
const MOST_SERVICE_APART: f64 = 32.0;

/// So large a share of the size of a step, up to which it differs from the one that the tangent was factored for, costs no correction.
const NEARLY: f64 = 1e-3;

/// Impulse left unbalanced at a contact, relative to the momentum scale, that is more than round-off: it has opened or closed with
/// a correction that was foreseen to be the last.
const UNFORESEEN: f64 = 1e-13;

/// The iterations of the runs, lane by lane.
#[derive(Clone, Copy, Debug)]
pub struct LaneNewton<S: Number> {
    /// Whether there is a run in the lane.
    live: S::Mask,
    /// Whether the step found no solution.
    pub failed: S::Mask,
    /// Still to be corrected.
    seeking: S::Mask,
    convergence: ConvergenceMonitor<S>,
    /// Impulse left unbalanced, relative to the momentum scale.
    impulse: S,
    /// Whether the last correction leaves nothing, by its contraction.
    foreseen: S::Mask,
    /// The size of the step that the tangent was factored for \[s\], the steps it has served, and those it may serve.
    factored_for: S,
    served: S,
    service: S,
    /// Whether the tangent is to be factored anew.
    renew: S::Mask,
    /// Size of the last step \[s\].
    pub size: S,
    /// Accelerations, as a share of those of the step before, by the square of what this one is longer: if they stay, if none, if that
    /// step was not accepted; and whether others say so than steps of the same size.
    pub ahead: S,
    pub told: bool,
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
            told: false,
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

impl<S: Number> Engine<S> {
    /// Finds the increments of the step at hand; lanes in which there is none are marked.
    #[inline(always)]
    pub fn solve(&mut self, ledger: &LaneLedger<S>, search: &mut LaneNewton<S>) {
        self.h.apart(SolveStep { engine: self, ledger, search });
    }

    #[inline(always)]
    fn iterate(&mut self, ledger: &LaneLedger<S>, search: &mut LaneNewton<S>) {
        let before = search.begin(ledger.sums.energy_scale, self.h);
        self.settled = self.h.less(self.h);
        self.predict(before, search.ahead, search.trusted);
        let reach = largest(&self.displacement, self.numbers.size);
        let momentum = {
            let play = (self.numbers.total_mass * ledger.sums.energy_scale * 2.0).sqrt();
            play.max(ledger.sums.linear_scale)
        };
        let (mut assemble, mut seen) = (search.renew.any(), false);
        let mut corrections = 0;
        while corrections < MOST_ITERATIONS {
            if assemble {
                self.evaluate::<true>();
            } else {
                self.evaluate::<false>();
            }
            if !seen {
                let (left, met) = (self.unbalanced(), self.meet_constraints(reach, false));
                search.weigh(left.work, left.impulse / momentum, met, corrections);
                if !search.seeking.any() {
                    break;
                }
            }
            if !assemble && corrections > 0 {
                search.judge();
                if search.renew.any() {
                    (assemble, seen) = (true, true);
                    continue;
                }
            }
            if assemble {
                self.renew(search);
            }
            self.correct();
            self.press(search.seeking);
            corrections += 1;
            let took = search.seeking;
            self.take(search, reach, ledger, corrections == 1);
            self.end_ahead(search, took, momentum, reach);
            if !search.seeking.any() {
                break;
            }
            (assemble, seen) = (false, false);
        }
        search.failed = search.failed | search.seeking;
        if S::DERIVES {
            self.follow();
        }
    }

    /// Ends the iterations of lanes that the correction just taken foreseeably leaves nothing to do in. No forces are
    /// evaluated for them any more but those of contacts, which may have opened or closed, and constraints are looked at; reactions follow
    /// the correction to first order, as the others do that it balances, and stay so while other lanes go on: a run knows nothing of those beside it.
    #[inline(always)]
    fn end_ahead(&mut self, search: &mut LaneNewton<S>, took: S::Mask, momentum: S, reach: S) {
        if S::DERIVES || !(took & search.foreseen).any() {
            return;
        }
        // Factors of the correction enter, so before the contacts are looked at.
        self.correct_reactions(took & search.foreseen);
        let (rate, small) = (self.h.recip(), momentum * UNFORESEEN);
        let mut ends = took & search.foreseen & self.meet_constraints(reach, true);
        ends = ends & self.springs_foreseen(small);
        for k in 0..self.guides.len() {
            self.push(k, rate);
            ends = ends & (self.guides[k].residual * self.h).abs().at_most(small);
        }
        search.seeking = search.seeking & !ends;
        self.settled = self.settled | ends;
    }

    /// Factors the tangent as assembled last, for the lanes that want it renewed; in the others the factors stay.
    #[inline(always)]
    fn renew(&mut self, search: &mut LaneNewton<S>) {
        self.keep_reaction_rows(search.renew);
        self.factor();
        let renew = search.renew;
        if (search.live & !renew).any() {
            self.factors.take(&self.tangent, renew);
            for guide in &mut self.guides {
                for (mine, new) in guide.factored.iter_mut().zip(guide.assembled) {
                    *mine = S::choose(renew, new, *mine);
                }
            }
        } else {
            std::mem::swap(&mut self.factors, &mut self.tangent);
            self.guides.iter_mut().for_each(|g| g.factored = g.assembled);
        }
        self.factor_constraints(renew);
        self.factor_springs(renew);
        self.forget_answer();
        search.renewed(self.h);
    }

    /// Derivatives follow the values with the tangent at the solution: one linear step, or some where angles are kept.
    fn follow(&mut self) {
        self.evaluate::<true>();
        self.factor();
        std::mem::swap(&mut self.factors, &mut self.tangent);
        self.guides.iter_mut().for_each(|g| g.factored = g.assembled);
        let all = !self.settled;
        self.factor_constraints(all);
        self.forget_answer();
        let turns =
            self.numbers.constraints.iter().any(|c| matches!(c.kind, ConstraintKind::Angle { .. }));
        for _ in 0..if turns { FOLLOWING } else { 1 } {
            self.correct();
            self.press(all);
            for (d, c) in self.increment.iter_mut().zip(&self.correction) {
                (0..4).for_each(|i| d[i] += c[i]);
            }
            for guide in &mut self.guides {
                guide.increment += guide.correction;
            }
            self.constraints.correct(all);
            self.evaluate::<false>();
        }
    }
}

/// See [`Engine::solve`].
struct SolveStep<'a, S: Number> {
    engine: &'a mut Engine<S>,
    ledger: &'a LaneLedger<S>,
    search: &'a mut LaneNewton<S>,
}

impl<S: Number> Task for SolveStep<'_, S> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        self.engine.iterate(self.ledger, self.search);
    }
}

impl<S: Number> LaneNewton<S> {
    /// Begins a step of size `h`; returns the size of the last one.
    #[inline(always)]
    fn begin(&mut self, energy: S, h: S) -> S {
        let no = h.less(h);
        self.convergence = ConvergenceMonitor::new(energy);
        (self.seeking, self.failed) = (self.live, no);
        if !self.told {
            // Derivatives need the tangent at the solution anyway.
            let steady = if S::DERIVES { no } else { h.equals(self.size) };
            self.ahead = S::choose(steady, h.constant(1.0), h.constant(0.0));
        }
        let before = std::mem::replace(&mut self.size, h);
        self.served += h.constant(1.0);
        let due = if S::DERIVES { !no } else { self.service.at_most(self.served) };
        self.renew = self.live & (due | !self.fits(h));
        let most = h.constant(if self.told { MOST_SERVICE_APART } else { MOST_SERVICE });
        let longer = self.service + h.constant(1.0);
        let longer = longer.if_less(most, longer, most);
        self.service = S::choose(due, longer, self.service);
        before
    }

    /// Whether the factors are those of steps of size `h`, or of nearly that.
    #[inline(always)]
    fn fits(&self, h: S) -> S::Mask {
        let near = h * if self.told { NEARLY } else { 0.0 };
        (h - self.factored_for).abs().at_most(near)
    }

    /// Wants the tangent renewed if the iteration no longer contracts well.
    #[inline(always)]
    fn judge(&mut self) {
        self.renew = self.seeking & !self.convergence.contracts();
        let shorter = (self.service * 0.5).max(self.service.constant(1.0));
        self.service = S::choose(self.renew, shorter, self.service);
    }

    /// Takes in new factors of the lanes that wanted them.
    #[inline(always)]
    fn renewed(&mut self, h: S) {
        let (renew, zero) = (self.renew, h.constant(0.0));
        self.factorizations += S::choose(renew, h.constant(1.0), zero);
        self.served = S::choose(renew, zero, self.served);
        self.factored_for = S::choose(renew, h, self.factored_for);
        self.renew = h.less(h);
    }

    /// Looks ahead after a correction: the work and the impulse left by one that contracted well are known from those before it,
    /// round-off apart; not where something may begin to yield.
    #[inline(always)]
    fn foresee(&mut self) {
        let small = self.impulse.constant(IMPULSE_TOLERANCE);
        let impulse = self.impulse * self.convergence.left_share();
        let work = self.convergence.work_left();
        self.foreseen =
            work.at_most(self.convergence.energy * WORK_TOLERANCE) & impulse.at_most(small);
    }

    /// Looks at what is unbalanced: nothing, or nothing but round-off, and the lane is done.
    #[inline(always)]
    fn weigh(&mut self, work: S, impulse: S, met: S::Mask, corrections: usize) {
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
