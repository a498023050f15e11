//! One step of a run.
//!
//! Its parts end at impacts, at releases of supports and at jumps of prescribed velocities. Each is solved as its contacts ask for,
//! accepted by the only writer of the state, and recorded before and after an impact. A part that has no solution is cut in half; where
//! that does not help, the run gives up with its reason.

use super::contact_status::Resolution;
use super::record::{Flow, Recorder};
use super::simulation::Simulation;
use super::step_size::StepSizeControl;
use super::trial::{PartKind, Trial};
use crate::error::Error;
use crate::settings::{SAME_INSTANT, Settings};
use crate::step::newton::Failure;

/// A step is cut down to this share of its size before the run gives up.
const SMALLEST_SHARE: f64 = 1e-4;
/// Corrections of Newton's iteration in a step, over all its parts, impacts and cuts, before the run gives up: more would not end.
pub(super) const MOST_CORRECTIONS: usize = 100_000;
/// More instants located and impacts than this in one step count as accumulated: for the rest of it what touches stays together.
pub const MOST_EVENTS: usize = 128;

impl Simulation<'_> {
    /// Advances by one step of the given size; rows before and after an impact go to `recorder`, which may stop it between
    /// two parts of the step.
    ///
    /// # Errors
    /// If no solution is found even for very short steps; the state is the last one accepted.
    pub fn advance(&mut self, recorder: &mut dyn Recorder) -> Result<Flow, Error> {
        let mut budget = self.budget();
        while let Some(part) = budget.next(self.state.offset, self.time_to_cut()) {
            let trial = match self.resolution(&budget) {
                Resolution::Jump => self.jump(&part),
                Resolution::Free => self.advance_to_contact(&part),
                Resolution::Impact(touching) => self.strike(&touching, &part),
                Resolution::Sequence(touching) => self.strike_fastest(&touching, &part),
                Resolution::Accumulated => self.hold(&part),
                Resolution::TimeStepping { closed } => self.step_in_time(&part, closed),
            };
            match trial {
                Ok(trial) => {
                    if let Some(size) = self.too_long(&trial) {
                        self.refuse(&mut budget, size);
                        continue;
                    }
                    budget.spend(&trial);
                    self.accept_all(trial, recorder)?;
                    self.slow_down(&mut budget);
                    let goes_on = budget.remains(self.state.offset);
                    if goes_on && recorder.progress(self.state.time) == Flow::Stop {
                        return Ok(Flow::Stop);
                    }
                }
                Err(failure) => {
                    self.step_cuts += 1;
                    budget.halve(&part, failure).map_err(|why| self.give_up(why, part.size))?;
                }
            }
            if self.effort.iterations > budget.most_corrections {
                return Err(self.give_up(Failure::Endless, part.size));
            }
        }
        let closed = self.close_step(&budget);
        self.settle_reactions();
        closed?;
        Ok(recorder.progress(self.state.time))
    }

    /// The step to come.
    fn budget(&self) -> Budget {
        let (settings, corrections) = (&self.settings, self.effort.iterations);
        match &self.step_size {
            Some(step_size) => {
                let left = settings.end - self.state.time;
                Budget::of(step_size.target(left), settings.step, corrections)
            }
            None => Budget::new(settings, self.state.step, corrections),
        }
    }

    /// A trial was too long for the accuracy asked for: the step ends after a part of the given size.
    fn refuse(&mut self, budget: &mut Budget, size: f64) {
        budget.end_at(self.state.offset + size);
        if let Some(step_size) = &mut self.step_size {
            step_size.refuse();
        }
    }

    /// Behind a jump of velocities a step ends soon where an accuracy is asked for.
    fn slow_down(&self, budget: &mut Budget) {
        if let Some(size) = self.step_size.as_ref().and_then(StepSizeControl::afresh) {
            budget.end_at(self.state.offset + size);
        }
    }

    /// Accepts a trial and what follows from it at once, with rows before and after an impact.
    fn accept_all(&mut self, trial: Trial, recorder: &mut dyn Recorder) -> Result<(), Error> {
        let strikes = trial.strikes(&self.work);
        if strikes {
            self.record(recorder)?;
        }
        let mut next = Some(trial);
        while let Some(trial) = next {
            self.accept(&trial);
            next = self.follow_up(trial);
        }
        if strikes { self.record(recorder) } else { Ok(()) }
    }

    /// What an accepted trial leaves to be done at its end: the next impact of a sequence, or bringing what was held to rest.
    fn follow_up(&mut self, trial: Trial) -> Option<Trial> {
        match trial.kind {
            PartKind::InSequence(sequence) => self.next_of(sequence),
            PartKind::Held => self.plastic_post_step(&trial),
            _ => None,
        }
    }

    /// Counts the step; its end is on the grid of steps, or behind an impact that went beyond.
    fn close_step(&mut self, budget: &Budget) -> Result<(), Error> {
        let step = self.settings.step;
        self.accumulated_steps += usize::from(budget.events_left == 0);
        self.state.step += 1;
        if let Some(step_size) = &mut self.step_size {
            step_size.close(self.state.offset, &self.state.pairs);
            self.state.offset = 0.0;
            if (self.state.time - self.settings.end).abs() <= SAME_INSTANT * step {
                self.state.time = self.settings.end;
            }
            return self.refuse_growth();
        }
        self.state.offset -= budget.target;
        if self.state.offset.abs() <= SAME_INSTANT * step {
            self.state.offset = 0.0;
        }
        let grid = self.state.step as f64 * step;
        // Never back, not even by the last bit, behind an impact at the end of the step.
        let time = grid.min(self.settings.end) + self.state.offset;
        self.state.time = if self.state.offset > 0.0 { time.max(self.state.time) } else { time };
        self.refuse_growth()
    }
}

/// A part of a step that is to be solved.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Its size at most \[s\].
    pub size: f64,
    /// Share of the step to which failures have cut it; impact intervals are cut likewise.
    pub share: f64,
}

/// What is left of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    /// Size of the step: the one given, or what is left up to the end of the run \[s\].
    target: f64,
    /// Size of its next part at most \[s\].
    size: f64,
    /// Size below which parts are not cut any further \[s\].
    smallest: f64,
    /// Instants located and impacts that it may still have.
    pub events_left: usize,
    /// Corrections that the run may have taken at its end.
    most_corrections: usize,
}

impl Budget {
    fn new(settings: &Settings, steps: usize, corrections: usize) -> Self {
        let step = settings.step;
        let target = step.min(settings.end - steps as f64 * step);
        let target = if (target - step).abs() <= SAME_INSTANT * step { step } else { target };
        Self::of(target, step, corrections)
    }

    /// A step of size `target`, cut by shares of `step` where parts of it fail.
    fn of(target: f64, step: f64, corrections: usize) -> Self {
        let smallest = SMALLEST_SHARE * step;
        let most_corrections = corrections + MOST_CORRECTIONS;
        Self { target, size: target, smallest, events_left: MOST_EVENTS, most_corrections }
    }

    /// Whether something is left of the step, `offset` of it done.
    fn remains(&self, offset: f64) -> bool {
        offset < self.target * (1.0 - SAME_INSTANT)
    }

    /// The next part, `offset` of the step done; it ends at the next cut at the latest, which is `cut` away.
    fn next(&self, offset: f64, cut: f64) -> Option<Part> {
        let size = self.size.min(self.target - offset).min(cut);
        self.remains(offset).then_some(Part { size, share: self.size / self.target })
    }

    /// Ends the step so long after its beginning at the latest.
    fn end_at(&mut self, target: f64) {
        if target < self.target {
            self.target = target;
            self.size = self.size.min(target);
        }
    }

    /// Takes a part off that ends with a trial; behind one of its whole size the next may be larger again. That one ends at an instant of
    /// contact, or is an impact, says nothing of the size that failed before.
    fn spend(&mut self, trial: &Trial) {
        if trial.is_event() {
            self.events_left = self.events_left.saturating_sub(1);
        } else {
            self.size = (2.0 * self.size).min(self.target);
        }
    }

    /// Cuts the size of a part that has failed in half.
    ///
    /// # Errors
    /// The failure, if the step cannot be cut any further.
    fn halve(&mut self, part: &Part, failure: Failure) -> Result<(), Failure> {
        self.size = 0.5 * part.size;
        if self.size >= self.smallest { Ok(()) } else { Err(failure) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_that_failed_is_tried_again_behind_a_whole_part_alone() {
        let settings = Settings::new(1.0, 0.1);
        let trial = |kind| Trial { h: 0.0, active: Vec::new(), fallback_law: false, kind };
        let mut budget = Budget::new(&settings, 0, 7);
        assert_eq!(budget.most_corrections, 7 + MOST_CORRECTIONS);
        let part = budget.next(0.0, f64::INFINITY).unwrap();
        budget.halve(&part, Failure::Impact).unwrap();
        for kind in [PartKind::Free { located: Some(0) }, PartKind::Impact] {
            budget.spend(&trial(kind));
            assert_eq!(budget.next(0.0, f64::INFINITY).unwrap().size, 0.05);
        }
        assert_eq!(budget.events_left, MOST_EVENTS - 2);
        budget.spend(&trial(PartKind::Free { located: None }));
        assert_eq!(budget.next(0.0, f64::INFINITY).unwrap().size, 0.1);
    }
}
