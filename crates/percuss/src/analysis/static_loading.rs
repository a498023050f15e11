//! Loading from rest in steps; at a failure its load factor is determined, the part is removed, and its forces are released at this factor until
//! the rest is in equilibrium.

use super::course::Course;
use super::failure::{StaticFailure, first_failure, in_words};
use super::lost::lost;
use super::stability::stability;
use super::static_search::{Reached, StaticSearch};
use crate::error::Error;
use crate::model::Model;

/// A step is cut down to this share of the total before the analysis ends without convergence.
const SMALLEST_STEP: f64 = 1e-4;
/// Steps that lead to an unstable equilibrium are cut down to this share before it is believed.
const FINEST_SHARE: f64 = 1.0 / 4096.0;
/// Beside a bifurcation steps are that fine, and the analysis ends without convergence below this share.
const SMALLEST_BESIDE: f64 = 1e-6;
/// Purpose of a step.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// The loads grow: their share.
    Loads,
    /// At this share of the loads, the forces of failed parts are released.
    Release(f64),
}

/// End of a step.
enum StepOutcome {
    /// The step was completed.
    There,
    /// A part fails.
    Failing(f64),
    /// No equilibrium was found.
    NoEquilibrium,
}

/// A structure during loading.
pub(super) struct Loading<'a, 'm> {
    search: &'a mut StaticSearch<'m>,
    accepted: Reached,
    /// The longest step \[share of the loads\].
    longest: f64,
    /// Whether all equilibria during loading were stable.
    pub stable: bool,
    /// Whether none lies behind the one before, however fine the step: the direction of the path is known.
    onward: bool,
    /// Steps taken.
    pub steps: usize,
    /// Failures, in their order, shape (failures).
    pub failures: Vec<StaticFailure>,
    /// Events during loading.
    pub course: Course,
}

impl<'a, 'm> Loading<'a, 'm> {
    pub fn new(search: &'a mut StaticSearch<'m>, longest: f64) -> Self {
        let accepted = search.reached();
        let (failures, course) = (Vec::new(), Course::new(search));
        Self { search, accepted, longest, stable: true, onward: true, steps: 0, failures, course }
    }

    /// Whether load steps may have lost the branch that begins without load: an equilibrium was unstable, or lay behind the one before, however fine
    /// the steps.
    pub fn is_astray(&self) -> bool {
        !(self.stable && self.onward)
    }

    /// Brings the loads up; `structure` is the beams alone, for their stability.
    pub fn bring_up(&mut self, structure: &Model) -> Result<(), Error> {
        let (mut reached, mut step, mut smallest) = (0.0, self.longest, SMALLEST_STEP);
        while reached < 1.0 {
            let target: f64 = f64::min(reached + step, 1.0);
            let onset = self.onset(reached);
            let found = self.go(Stage::Loads, reached, target);
            if matches!(found, StepOutcome::There) {
                // Near a bifurcation the iteration may go to another branch, on the other side of the loads, or along one that has lost its stability:
                // smaller steps show it.
                let behind = onset.is_some_and(|onset| self.search.leaves(&self.accepted, &onset));
                let unstable = self.loses_stability(structure);
                if (behind || unstable) && step > self.longest * FINEST_SHARE {
                    (step, smallest) = (0.5 * step, SMALLEST_BESIDE);
                    self.search.go_back(&self.accepted);
                    continue;
                }
                self.stable &= !unstable;
                self.onward &= !behind;
            }
            match found {
                StepOutcome::There => {
                    reached = if target > 1.0 - 1e-12 { 1.0 } else { target };
                    step = (1.5 * step).min(self.longest);
                    self.accept();
                    self.course.take(self.search, reached);
                }
                StepOutcome::Failing(share) => {
                    reached = share;
                    self.accept();
                    self.settle(share)?;
                    self.course.take(self.search, share);
                }
                StepOutcome::NoEquilibrium => {
                    if let Some(name) = self.search.contacts.lost(self.search.model) {
                        let lost = Error::nothing_holds(name.to_owned());
                        return Err(lost.after(&in_words(self.failures.iter(), true)));
                    }
                    step *= 0.5;
                    self.search.go_back(&self.accepted);
                    if step < smallest {
                        let failures = in_words(self.failures.iter(), true);
                        return Err(lost(self.search, reached).after(&failures));
                    }
                }
            }
        }
        self.search.set_share(1.0);
        Ok(())
    }

    /// The direction in which the path leaves the last accepted equilibrium, at a share of the loads; not for a structure with contacts, where
    /// those that close may turn it.
    fn onset(&mut self, share: f64) -> Option<Vec<[f64; 4]>> {
        let known = self.stable && self.onward && self.search.contacts.is_empty();
        known.then(|| self.search.onset(&self.accepted, share)).flatten()
    }

    /// Whether the current equilibrium is unstable after stable ones; a structure with active contacts has not jumped to another branch.
    fn loses_stability(&mut self, structure: &Model) -> bool {
        let alone = !self.search.contacts.press();
        alone && self.stable && !stability(structure, self.search).stable
    }

    fn accept(&mut self) {
        self.steps += 1;
        self.accepted = self.search.reached();
    }

    /// Removes the part that fails in the current equilibrium, and continues at its share of the loads to one without it.
    pub fn settle(&mut self, share: f64) -> Result<(), Error> {
        self.fail(share);
        let (mut gone, mut step) = (0.0, 1.0_f64);
        while gone < 1.0 {
            let target: f64 = f64::min(gone + step, 1.0);
            match self.go(Stage::Release(share), gone, target) {
                StepOutcome::There => {
                    gone = target;
                    step *= 1.5;
                    self.accept();
                }
                StepOutcome::Failing(_) => {
                    self.accept();
                    self.fail(share);
                    (gone, step) = (0.0, 1.0);
                }
                StepOutcome::NoEquilibrium => {
                    step *= 0.5;
                    self.search.go_back(&self.accepted);
                    if step < SMALLEST_STEP {
                        return Err(self.nothing_left(share));
                    }
                }
            }
        }
        self.search.release();
        Ok(())
    }

    /// Failure at a share of the loads that leaves no equilibrium.
    fn nothing_left(&self, share: f64) -> Error {
        let there = self.failures.iter().filter(|f| f.factor >= share);
        let before = self.failures.iter().filter(|f| f.factor < share);
        Error::nothing_left(share, in_words(there, false)).after(&in_words(before, true))
    }

    /// Lets the part at its full strength fail; its forces are held.
    fn fail(&mut self, share: f64) {
        self.failures.extend(self.search.fail(share));
        self.search.withhold();
        self.accepted = self.search.reached();
    }

    /// Continues from the last accepted equilibrium, up to the next failure.
    fn go(&mut self, stage: Stage, from: f64, to: f64) -> StepOutcome {
        let start = self.search.largest_use() - 1.0;
        if !self.solve(stage, to) {
            return StepOutcome::NoEquilibrium;
        }
        let end = self.search.largest_use() - 1.0;
        if end < 0.0 {
            return StepOutcome::There;
        }
        self.locate(stage, [from, to], [start, end])
            .map_or(StepOutcome::NoEquilibrium, StepOutcome::Failing)
    }

    /// Goes to the first failure, between two points of a step with uses of strengths above one at the second.
    fn locate(&mut self, stage: Stage, range: [f64; 2], excess: [f64; 2]) -> Option<f64> {
        let at = first_failure(range, excess, |at| {
            self.search.go_back(&self.accepted);
            self.solve(stage, at).then(|| self.search.largest_use() - 1.0)
        })?;
        self.search.go_back(&self.accepted);
        self.solve(stage, at).then_some(at)
    }

    fn solve(&mut self, stage: Stage, at: f64) -> bool {
        match stage {
            Stage::Loads => self.search.solve(at) || self.search.relax_from(&self.accepted, at),
            Stage::Release(share) => {
                self.search.let_go = at;
                self.search.solve(share)
            }
        }
    }
}
