//! Failure along an equilibrium path: the arc ends where a part reaches its strength, and its forces are released there, with constant load factor
//! or displacement, whichever controls the path.

use super::goal::Goal;
use super::tracer::{Mark, Tracer};
use crate::analysis::failure::{StaticFailure, first_failure};

/// The path ends if its forces cannot be released in steps of at least this size.
const SMALLEST_STEP: f64 = 1e-4;
/// Steps longer than this are repeated if uses of strengths exceed one by more than this: the part that fails first then fails first.
const BEYOND: f64 = 1e-6;
const FINEST_STEP: f64 = 1e-3;

impl Tracer<'_> {
    /// Goes back on an arc from a mark to the first failure; returns the arc that leads there.
    pub(super) fn locate_failure(&mut self, before: &Mark, arc: f64) -> Option<f64> {
        let end = self.search.largest_use() - 1.0;
        self.back_to(before);
        let start = self.search.largest_use() - 1.0;
        let at = first_failure([0.0, arc], [start, end], |at| {
            self.back_to(before);
            self.advance(at)?;
            Some(self.search.largest_use() - 1.0)
        })?;
        self.back_to(before);
        self.advance(at).map(|_| at)
    }

    /// Lets the part at its full strength fail at the current point, and goes to an equilibrium without it; `None` without one.
    pub(super) fn fail(&mut self, goal: &Goal) -> Option<Vec<StaticFailure>> {
        // A joint that tears ends the path; `static` continues without it.
        if self.search.first_to_fail().is_some_and(|name| name.starts_with("joint.")) {
            return None;
        }
        let here = self.mark();
        let held = goal.here(self);
        if let Some(found) = self.let_go(&held) {
            return Some(found);
        }
        self.search.release();
        self.back_to(&here);
        let found = self.let_go(&Goal::Factor(self.factor));
        if found.is_none() {
            self.search.release();
            self.back_to(&here);
        }
        found
    }

    /// The same with the control of the path held constant.
    fn let_go(&mut self, held: &Goal) -> Option<Vec<StaticFailure>> {
        let mut failures = self.withhold_failing();
        let mut start = self.mark();
        // However far it may be.
        self.arc = f64::INFINITY;
        let (mut gone, mut step) = (0.0, 1.0_f64);
        while gone < 1.0 {
            let target: f64 = f64::min(gone + step, 1.0);
            self.search.let_go = target;
            let found = self.hit(held);
            let beyond = self.search.largest_use() - 1.0;
            if !found || (beyond > BEYOND && step > FINEST_STEP) {
                step *= 0.5;
                self.back_to(&start);
                if step < SMALLEST_STEP {
                    return None;
                }
                continue;
            }
            (gone, step) = (target, 1.5 * step);
            if beyond >= 0.0 {
                failures.extend(self.withhold_failing());
                (gone, step) = (0.0, 1.0);
            }
            start = self.mark();
        }
        self.search.release();
        Some(failures)
    }

    fn withhold_failing(&mut self) -> Vec<StaticFailure> {
        self.search.set_share(self.factor);
        self.search.reached();
        let failures = self.search.fail(self.factor);
        self.search.withhold();
        failures
    }
}
