//! Newton's iteration of the runs of an ensemble: lanes converge independently, by the tests of a single run.

mod increments;
mod search;

use self::increments::largest;
use super::constraints::FOLLOWING;
use super::engine::Engine;
use super::ledger::LaneLedger;
use percuss::internals::model::frozen::ConstraintKind;
use percuss::internals::scalar::{Mask, Number, Task};
use percuss::internals::step::newton::MOST_ITERATIONS;

pub use search::LaneNewton;

/// Unbalanced impulse of a contact, relative to the momentum scale, that exceeds round-off: the contact has opened or closed in a correction that
/// was predicted to be the last.
const UNFORESEEN: f64 = 1e-13;

impl<S: Number> Engine<S> {
    /// Solves for the increments of the current step; lanes without a solution are marked as failed.
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
            let of_energy = (self.numbers.total_mass * ledger.sums.energy_scale * 2.0).sqrt();
            of_energy.max(ledger.sums.linear_scale)
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
    }

    /// Ends the iteration of lanes for which the last correction is predicted to leave a negligible residual. Only contact forces, since contacts
    /// may have opened or closed, and constraints are evaluated for them; reactions follow the correction to first order, like the forces that it
    /// balances, and do not change while other lanes iterate: a run is independent of the other lanes.
    #[inline(always)]
    fn end_ahead(&mut self, search: &mut LaneNewton<S>, took: S::Mask, momentum: S, reach: S) {
        if !(took & search.foreseen).any() {
            return;
        }
        // This uses the factors of the correction and comes before the evaluation of contacts.
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

    /// Factors the last assembled tangent for the lanes that need new factors; the factors of the other lanes do not change.
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

    /// Factors the tangent at the solution of the step.
    pub fn renew_at_solution(&mut self, search: &mut LaneNewton<S>) {
        self.evaluate::<true>();
        search.renew = search.live;
        self.renew(search);
    }

    /// Derivatives follow the values of the solution with the factors of the tangent there, which have no derivatives: one linear step, or several
    /// with rigid joints. The unbalanced forces vanish, so that those of the factors would have no effect.
    pub fn follow(&mut self) {
        self.evaluate::<false>();
        let all = !self.settled;
        self.factor_constraints(all);
        self.forget_answer();
        let turns =
            self.numbers.constraints.iter().any(|c| matches!(c.kind, ConstraintKind::Angle { .. }));
        let steps = if turns { FOLLOWING } else { 1 };
        for step in 1..=steps {
            self.correct();
            self.press(all);
            for (d, c) in self.increment.iter_mut().zip(&self.correction) {
                (0..4).for_each(|i| d[i] += c[i]);
            }
            for guide in &mut self.guides {
                guide.increment += guide.correction;
            }
            self.constraints.correct(all);
            if step < steps {
                self.evaluate::<false>();
            }
        }
        self.h.apart(Connect(self));
    }
}

/// Forces of contacts, springs and constraints at an increment, without those of the beams, on which nothing depends any more in a solved step.
struct Connect<'a, S: Number>(&'a mut Engine<S>);

impl<S: Number> Task for Connect<'_, S> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        self.0.connect::<false>();
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
