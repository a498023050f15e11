//! One step of a run.
//!
//! Its parts end at impacts, at releases of supports and at jumps of prescribed velocities. Each is solved according to its contacts
//! ([`decider`](super::solving::decider)), accepted by the only writer of the state, passed to observers, and recorded before and after an impact.
//! A part without a solution is cut in half; if that does not help, the run ends without convergence and gives the reason.

use super::giving_up::{MOST_CORRECTIONS, give_up};
use super::observing::step_size::StepSizeControl;
use super::recording::record::{Flow, Recorder};
use super::simulation::Simulation;
use super::solving::accept::Acceptance;
use super::solving::decider::{Decider, Moment, Resolution};
use super::solving::solver::Solving;
use super::solving::trial::{Accepted, PartKind, Solved, Trial};
use crate::error::Error;
use crate::settings::SAME_INSTANT;
use crate::step::newton::Failure;

/// Growth of energy at which a run ends, relative to the initial and the supplied energy.
const MOST_MADE: f64 = 10.0;

impl Simulation<'_> {
    /// Advances by one step of the given size; rows before and after an impact go to `recorder`, which may stop it between
    /// two parts of the step.
    ///
    /// # Errors
    /// If no solution is found even for very short steps; the state is the last one accepted.
    pub fn advance(&mut self, recorder: &mut dyn Recorder) -> Result<Flow, Error> {
        let most_corrections = self.solver.counts.effort.iterations + MOST_CORRECTIONS;
        let mut decider = Decider::new(&self.settings, self.solver.positions, self.target());
        while decider.remains(self.state.offset) && decider.goes_on(&self.moment()) {
            let (solver, at) = self.solver();
            match solver.solve(at, |solving| solve_part(solving, &mut decider)) {
                Ok(solved) => {
                    if let Some(size) = self.too_long(&solved) {
                        self.refuse(&mut decider, size);
                        self.solver.keep(solved.solution);
                        continue;
                    }
                    decider.spend(solved.trial.is_event());
                    self.accept_all(solved, recorder)?;
                    self.slow_down(&mut decider);
                    let goes_on = decider.remains(self.state.offset);
                    if goes_on && recorder.progress(self.state.time) == Flow::Stop {
                        return Ok(Flow::Stop);
                    }
                }
                Err(failure) => {
                    self.solver.counts.step_cuts += 1;
                    if !decider.halve() {
                        return Err(self.give_up(failure, decider.part.size));
                    }
                }
            }
            if self.solver.counts.effort.iterations > most_corrections {
                return Err(self.give_up(Failure::Endless, decider.part.size));
            }
        }
        let closed = self.close_step(&decider);
        self.monitor.settle(self.model, &self.state);
        closed?;
        Ok(recorder.progress(self.state.time))
    }

    /// Status of the run within the step.
    fn moment(&mut self) -> Moment {
        let (solver, at) = self.solver();
        solver.moment(at)
    }

    /// Size of the next step \[s\].
    fn target(&self) -> f64 {
        match &self.step_size {
            Some(step_size) => step_size.target(self.settings.end - self.state.time),
            None => self.settings.size_behind(self.state.step),
        }
    }

    /// The size that a part should have had, if it is too long for the requested accuracy \[s\].
    fn too_long(&self, solved: &Solved) -> Option<f64> {
        self.step_size.as_ref()?.too_long(self.model, solved)
    }

    /// A part was too long for the requested accuracy: the step ends after one of the given size.
    fn refuse(&mut self, decider: &mut Decider, size: f64) {
        decider.end_at(self.state.offset + size);
        if let Some(step_size) = &mut self.step_size {
            step_size.refuse();
        }
    }

    /// After a jump of velocities a step with a requested accuracy ends soon.
    fn slow_down(&self, decider: &mut Decider) {
        if let Some(size) = self.step_size.as_ref().and_then(StepSizeControl::restart_size) {
            decider.end_at(self.state.offset + size);
        }
    }

    /// Accepts a part and its immediate consequences, with rows before and after an impact.
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
            separated: &reached.separated,
            yielded: reached.yielded,
        };
        self.monitor.take(&accepted);
        self.rows.take(&accepted);
        self.frames.take(&accepted);
        if let Some(step_size) = &mut self.step_size {
            step_size.take(&accepted);
        }
    }

    /// Consequence of an accepted part at its end: the next impact of a sequence, or bringing held contacts to rest.
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

    /// Counts the step; its end is on the grid of steps, or after an impact that exceeded it.
    fn close_step(&mut self, decider: &Decider) -> Result<(), Error> {
        self.solver.counts.accumulated_steps += usize::from(decider.accumulates());
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

    /// Ends a run whose scheme creates energy. Conserving schemes never reach the limit: their residual is round-off relative to the largest energy
    /// so far.
    fn refuse_growth(&self) -> Result<(), Error> {
        let ledger = &self.state.ledger;
        let (made, came) = (ledger.energy_residual(&self.measures), self.monitor.energy_came);
        let grown = made > MOST_MADE * came && made > 0.5 * ledger.energy_scale;
        if grown || made == f64::INFINITY {
            return Err(Error::grown(self.state.time, made, came));
        }
        Ok(())
    }

    /// Reason for the end of the run after a step of the given size has failed.
    #[doc(hidden)]
    pub fn give_up(&self, failure: Failure, step: f64) -> Error {
        give_up((self.model, &self.state, &self.solver.search), failure, step)
    }
}

/// Solves the current part according to its contacts.
fn solve_part(solving: &mut Solving<'_>, decider: &mut Decider) -> Result<Trial, Failure> {
    match decider.part.resolution {
        Resolution::Jump => solving.jump(&decider.part),
        Resolution::Free | Resolution::Accumulated => solving.advance_freely(decider),
        Resolution::Impact => solving.strike(&decider.part),
        Resolution::Sequence => solving.strike_fastest(&decider.part),
        Resolution::TimeStepping => solving.step_in_time(&decider.part),
    }
}

/// Single parts of steps, for tests: runs use them only if no simpler part is possible.
#[doc(hidden)]
impl Simulation<'_> {
    /// Accepts a part of the given size as after the Zeno limit, and its consequences.
    pub fn advance_held(&mut self, size: f64) -> Result<(), Failure> {
        let mut decider = Decider::new(&self.settings, self.solver.positions, size).exhausted();
        decider.goes_on(&self.moment());
        let (solver, at) = self.solver();
        let mut next = Some(solver.solve(at, |solving| solve_part(solving, &mut decider))?);
        while let Some(mut solved) = next {
            self.accept(&mut solved);
            next = self.follow_up(solved);
        }
        Ok(())
    }
}
