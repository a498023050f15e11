//! One step of a run.
//!
//! Its parts end at impacts, at releases of supports and at jumps of prescribed velocities. Each is solved as its contacts ask for,
//! accepted by the only writer of the state, shown to observers, and recorded before and after an impact. A part that has no solution is
//! cut in half; where that does not help, the run gives up with its reason.

use super::giving_up::give_up;
use super::observing::step_size::StepSizeControl;
use super::recording::record::{Flow, Recorder};
use super::simulation::Simulation;
use super::solving::accept::Acceptance;
use super::solving::budget::Budget;
use super::solving::contact_status::Resolution;
use super::solving::solver::Solving;
use super::solving::trial::{Accepted, PartKind, Solved, Trial};
use crate::error::Error;
use crate::settings::SAME_INSTANT;
use crate::step::newton::Failure;

pub use super::solving::budget::{MOST_EVENTS, Part};

/// Energy out of nothing at which a run ends, beside what was there at the start or was put in.
const MOST_MADE: f64 = 10.0;

impl Simulation<'_> {
    /// Advances by one step of the given size; rows before and after an impact go to `recorder`, which may stop it between
    /// two parts of the step.
    ///
    /// # Errors
    /// If no solution is found even for very short steps; the state is the last one accepted.
    pub fn advance(&mut self, recorder: &mut dyn Recorder) -> Result<Flow, Error> {
        let mut budget = self.budget();
        while let Some(part) = budget.next(self.state.offset, self.time_to_cut()) {
            let (solver, at) = self.solver();
            match solver.solve(at, |solving| solve_part(solving, &part, budget.events_left)) {
                Ok(solved) => {
                    if let Some(size) = self.too_long(&solved) {
                        self.refuse(&mut budget, size);
                        self.solver.keep(solved.solution);
                        continue;
                    }
                    budget.spend(&solved.trial);
                    self.accept_all(solved, recorder)?;
                    self.slow_down(&mut budget);
                    let goes_on = budget.remains(self.state.offset);
                    if goes_on && recorder.progress(self.state.time) == Flow::Stop {
                        return Ok(Flow::Stop);
                    }
                }
                Err(failure) => {
                    self.solver.counts.step_cuts += 1;
                    budget.halve(&part, failure).map_err(|why| self.give_up(why, part.size))?;
                }
            }
            if self.solver.counts.effort.iterations > budget.most_corrections {
                return Err(self.give_up(Failure::Endless, part.size));
            }
        }
        let closed = self.close_step(&budget);
        self.monitor.settle(&self.state);
        closed?;
        Ok(recorder.progress(self.state.time))
    }

    /// The step to come.
    fn budget(&self) -> Budget {
        let (settings, corrections) = (&self.settings, self.solver.counts.effort.iterations);
        match &self.step_size {
            Some(step_size) => {
                let left = settings.end - self.state.time;
                Budget::of(step_size.target(left), settings.step, corrections)
            }
            None => Budget::new(settings, self.state.step, corrections),
        }
    }

    /// Time to the next cut of the step \[s\].
    fn time_to_cut(&self) -> f64 {
        self.solver.time_to_cut(self.state.time, self.settings.step)
    }

    /// The size that a part should have had, if it is too long for the accuracy asked for \[s\].
    fn too_long(&self, solved: &Solved) -> Option<f64> {
        self.step_size.as_ref()?.too_long(self.model, solved)
    }

    /// A part was too long for the accuracy asked for: the step ends after one of the given size.
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

    /// Accepts a part and what follows from it at once, with rows before and after an impact.
    fn accept_all(&mut self, solved: Solved, recorder: &mut dyn Recorder) -> Result<(), Error> {
        let strikes = solved.strikes();
        if strikes {
            self.record(recorder)?;
        }
        let mut next = Some(solved);
        while let Some(mut solved) = next {
            self.accept(&mut solved);
            next = self.follow_up(solved);
        }
        if strikes { self.record(recorder) } else { Ok(()) }
    }

    /// Moves the state to the end of a part, and shows that to all observers, in any order.
    fn accept(&mut self, solved: &mut Solved) {
        self.monitor.measure_lines(self.model, &self.state, solved);
        let (model, settings) = (self.model, &self.settings);
        let (state, solver) = (&mut self.state, &mut self.solver);
        let reached = Acceptance { model, settings, state, solver }.accept(solved);
        self.measures = reached.measures;
        let accepted = Accepted {
            model,
            solved,
            after: &self.state,
            measures: &self.measures,
            awake: self.solver.search.awake(),
            parted: &reached.parted,
        };
        self.monitor.take(&accepted);
        self.rows.take(&accepted);
        self.frames.take(&accepted);
        if let Some(step_size) = &mut self.step_size {
            step_size.take(&accepted);
        }
    }

    /// What an accepted part leaves to be done at its end: the next impact of a sequence, or bringing what was held to rest.
    fn follow_up(&mut self, solved: Solved) -> Option<Solved> {
        let Solved { trial, solution, .. } = solved;
        let (solver, at) = self.solver();
        let next = match trial.kind {
            PartKind::InSequence(sequence) => {
                solver.solve_in(solution, at, |solving| solving.next_of(sequence).ok_or(()))
            }
            PartKind::Held => {
                solver.solve_in(solution, at, |solving| solving.plastic_post_step(&trial).ok_or(()))
            }
            _ => {
                solver.keep(solution);
                return None;
            }
        };
        next.ok()
    }

    /// Counts the step; its end is on the grid of steps, or behind an impact that went beyond.
    fn close_step(&mut self, budget: &Budget) -> Result<(), Error> {
        let step = self.settings.step;
        self.solver.counts.accumulated_steps += usize::from(budget.events_left == 0);
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

    /// Ends a run whose scheme makes energy out of nothing. What conserves it never comes near: its residual is round-off beside the
    /// largest energy so far.
    fn refuse_growth(&self) -> Result<(), Error> {
        let ledger = &self.state.ledger;
        let (made, came) = (ledger.energy_residual(&self.measures), self.monitor.energy_came);
        let grown = made > MOST_MADE * came && made > 0.5 * ledger.energy_scale;
        if grown || made == f64::INFINITY {
            return Err(Error::grown(self.state.time, made, came));
        }
        Ok(())
    }

    /// Why the run ends here, after a step of the given size has failed.
    #[doc(hidden)]
    pub fn give_up(&self, failure: Failure, step: f64) -> Error {
        give_up((self.model, &self.state, &self.solver.search), failure, step)
    }
}

/// Solves a part of a step that may still have so many events, as its contacts ask for.
fn solve_part(
    solving: &mut Solving<'_>,
    part: &Part,
    events_left: usize,
) -> Result<Trial, Failure> {
    match solving.resolution(events_left) {
        Resolution::Jump => solving.jump(part),
        Resolution::Free => solving.advance_to_contact(part),
        Resolution::Impact(touching) => solving.strike(&touching, part),
        Resolution::Sequence(touching) => solving.strike_fastest(&touching, part),
        Resolution::Accumulated => solving.hold(part),
        Resolution::TimeStepping { closed } => solving.step_in_time(part, closed),
    }
}

/// Parts of steps by themselves, for tests: runs take them where nothing simpler will do.
#[doc(hidden)]
impl Simulation<'_> {
    /// Takes a part in which nothing rigid ends inside another, and what follows from it.
    pub fn advance_held(&mut self, part: &Part) -> Result<(), Failure> {
        let (solver, at) = self.solver();
        let mut next = Some(solver.solve(at, |solving| solving.hold(part))?);
        while let Some(mut solved) = next {
            self.accept(&mut solved);
            next = self.follow_up(solved);
        }
        Ok(())
    }
}
