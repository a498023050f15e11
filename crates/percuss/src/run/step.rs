//! One step of a run.
//!
//! Its parts end at impacts, at releases of supports and at jumps of prescribed velocities. Each is solved as its contacts ask for (`decider`),
//! accepted by the only writer of the state, and recorded before and after an impact. A part that has no solution is cut in half; where
//! that does not help, the run gives up with its reason.

use super::decider::{Decider, Resolution, step_behind};
use super::record::{Flow, Recorder};
use super::simulation::Simulation;
use super::step_size::StepSizeControl;
use super::trial::{PartKind, Trial};
use crate::error::Error;
use crate::settings::SAME_INSTANT;
use crate::step::newton::Failure;

/// Corrections of Newton's iteration in a step, over all its parts, impacts and cuts, before the run gives up: more would not end.
pub(super) const MOST_CORRECTIONS: usize = 100_000;

impl Simulation<'_> {
    /// Advances by one step of the given size; rows before and after an impact go to `recorder`, which may stop it between
    /// two parts of the step.
    ///
    /// # Errors
    /// If no solution is found even for very short steps; the state is the last one accepted.
    pub fn advance(&mut self, recorder: &mut dyn Recorder) -> Result<Flow, Error> {
        let most_corrections = self.effort.iterations + MOST_CORRECTIONS;
        let mut decider = Decider::new(&self.settings, self.positions, self.target());
        while decider.goes_on(&self.moment()) {
            match self.solve_part(&mut decider) {
                Ok(trial) => {
                    if let Some(size) = self.too_long(&trial) {
                        self.refuse(&mut decider, size);
                        continue;
                    }
                    decider.spend(trial.is_event());
                    self.accept_all(trial, recorder)?;
                    self.slow_down(&mut decider);
                    let goes_on = decider.remains(self.state.offset);
                    if goes_on && recorder.progress(self.state.time) == Flow::Stop {
                        return Ok(Flow::Stop);
                    }
                }
                Err(failure) => {
                    self.step_cuts += 1;
                    if !decider.halve() {
                        return Err(self.give_up(failure, decider.part.size));
                    }
                }
            }
            if self.effort.iterations > most_corrections {
                return Err(self.give_up(Failure::Endless, decider.part.size));
            }
        }
        let closed = self.close_step(&decider);
        self.settle_reactions();
        closed?;
        Ok(recorder.progress(self.state.time))
    }

    /// Solves the part at hand as its contacts ask for.
    fn solve_part(&mut self, decider: &mut Decider) -> Result<Trial, Failure> {
        match decider.part.resolution {
            Resolution::Jump => self.jump(&decider.part),
            Resolution::Free | Resolution::Accumulated => self.advance_freely(decider),
            Resolution::Impact => self.strike(&decider.part),
            Resolution::Sequence => self.strike_fastest(&decider.part),
            Resolution::TimeStepping => self.step_in_time(&decider.part),
        }
    }

    /// Size of the step to come \[s\].
    fn target(&self) -> f64 {
        match &self.step_size {
            Some(step_size) => step_size.target(self.settings.end - self.state.time),
            None => step_behind(&self.settings, self.state.step),
        }
    }

    /// A trial was too long for the accuracy asked for: the step ends after a part of the given size.
    fn refuse(&mut self, decider: &mut Decider, size: f64) {
        decider.end_at(self.state.offset + size);
        if let Some(step_size) = &mut self.step_size {
            step_size.refuse();
        }
    }

    /// Behind a jump of velocities a step ends soon where an accuracy is asked for.
    fn slow_down(&self, decider: &mut Decider) {
        if let Some(size) = self.step_size.as_ref().and_then(StepSizeControl::afresh) {
            decider.end_at(self.state.offset + size);
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
    fn close_step(&mut self, decider: &Decider) -> Result<(), Error> {
        self.accumulated_steps += usize::from(decider.accumulates());
        self.state.step += 1;
        let (state, end) = (&mut self.state, self.settings.end);
        if let Some(step_size) = &mut self.step_size {
            step_size.close(state.offset, &state.pairs);
            state.offset = 0.0;
            if (state.time - end).abs() <= SAME_INSTANT * self.settings.step {
                state.time = end;
            }
        } else {
            (state.time, state.offset) = decider.close(state.step, state.time, state.offset);
        }
        self.refuse_growth()
    }
}
