//! A transient run: its parts, its setup, the loop over its steps.

use super::observing::monitor::Monitor;
use super::observing::status::RunStatus;
use super::observing::step_size::StepSizeControl;
use super::recording::channels::{self, Channel};
use super::recording::checkpoint::{Checkpoint, ResumeError};
use super::recording::frame::Frames;
use super::recording::record::{Flow, Recorder};
use super::recording::rows::Rows;
use super::solving::jumps;
use super::solving::solver::{Solver, StateView};
use super::start::{
    Initial, initial_acceleration, initial_state, massless, reference, reverse, set_velocities,
    start_moving,
};
use super::summarize::{Ended, summarize};
use crate::analysis::damped_modes::{modal_damping, undampable};
use crate::analysis::static_contacts::takes_part;
use crate::contact::search::Search;
use crate::error::Error;
use crate::geometry::touch::SearchRegion;
use crate::ledger::{Ledger, Measures, RoundOff};
use crate::model::frozen::ContactData;
use crate::model::{Fault, Model};
use crate::settings::{ImpactResolution, SAME_INSTANT, Settings, Start};
use crate::state::State;
use crate::step::commit;
use crate::step::contacts::PressingPair;
use crate::step::newton::Effort;
use crate::summary::{RunSummary, Termination};

/// A transient analysis in progress.
///
/// ```
/// # use percuss::*;
/// # fn model() -> Model {
/// # let mut b = ModelBuilder::new();
/// # let m = b.material(Material::new("m", 2e9, 3e3));
/// # let s = b.section(Section::new("s", 0.1, 8.33e-5));
/// # b.beam(Beam::new("girder", &[[0.0, 0.0], [3.0, 0.0]], 2, m, s));
/// # b.build().unwrap() }
/// let model = model();
/// let mut simulation = Simulation::new(&model, &Settings::new(1.0, 1e-3)).unwrap();
/// simulation.set_velocities(|_, _| [0.0, 1.0]);
/// simulation.advance(&mut NoRecorder).unwrap();
/// assert_eq!(simulation.state().time, 1e-3);
/// ```
#[derive(Clone, Debug)]
pub struct Simulation<'m> {
    pub(super) model: &'m Model,
    pub(super) settings: Settings,
    pub(super) state: State,
    /// Energies and momenta of the state.
    pub(super) measures: Measures,
    /// Solver of parts of steps.
    pub(super) solver: Solver,
    /// The size of steps, for a requested accuracy in place of a step.
    pub(super) step_size: Option<StepSizeControl>,
    /// Data of the summary.
    pub(super) monitor: Monitor,
    pub(super) rows: Rows,
    pub(super) frames: Frames,
    /// Active contacts in the equilibrium at the start of the run, with their forces, shape (such contacts) \[N\]; empty otherwise.
    pub(super) pressed: Vec<PressingPair>,
}

impl<'m> Simulation<'m> {
    /// The model at rest, with moving projectiles.
    ///
    /// # Errors
    /// Every fault of the settings.
    pub fn new(model: &'m Model, settings: &Settings) -> Result<Self, Vec<Fault>> {
        let faults = settings.validate(model);
        if !faults.is_empty() {
            return Err(faults);
        }
        let massless = massless(model);
        if !massless.is_empty() {
            return Err(massless);
        }
        Self::starting(model, settings, initial_state(model, settings)?)
    }

    /// The same from the reference configuration, for structures that may have beams without mass, which do not move in time.
    pub(super) fn about(model: &'m Model, settings: &Settings) -> Result<Self, Vec<Fault>> {
        Self::starting(model, settings, reference(model, settings))
    }

    fn starting(
        model: &'m Model,
        settings: &Settings,
        initial: Initial,
    ) -> Result<Self, Vec<Fault>> {
        let Initial { state, reactions, pressed } = initial;
        // Bodies in compliant contact in equilibrium may overlap.
        let may_press = |c: &ContactData| {
            settings.start == Start::Static
                && model.pairs[c.pairs.clone()].iter().all(|p| takes_part(model, p))
        };
        let overlaps = model.overlaps(&state.displacement, |c| !may_press(c));
        if !overlaps.is_empty() {
            return Err(overlaps);
        }
        if let Some(fault) = undampable(model, &state) {
            return Err(vec![fault]);
        }
        let mut simulation = Self {
            model,
            settings: *settings,
            measures: Measures::default(),
            solver: Solver::new(model, jumps::cuts(model, settings.step)),
            step_size: None,
            monitor: Monitor::new(model, &state, &reactions),
            rows: Rows::new(model),
            frames: Frames::default(),
            state,
            pressed,
        };
        start_moving(model, settings.step, &mut simulation.state);
        simulation.open();
        Ok(simulation)
    }

    fn open(&mut self) {
        let (model, settings, state) = (self.model, &self.settings, &mut self.state);
        commit::steer_obstacles(model, state, settings.step);
        self.solver.search = Search::new(model);
        self.solver.search.see(model, state, SearchRegion::All);
        if settings.scheme.advances_accelerations() {
            initial_acceleration(model, settings.step, state, &self.pressed);
        }
        self.solver.damping = modal_damping(model, state);
        self.measures = self.solver.measures(model, state);
        let round_off = RoundOff::new(model, settings.step);
        state.ledger = Ledger::open(&self.measures, &round_off);
        self.monitor.open(model, state, &self.pressed);
        self.frames = Frames::at_start(&self.pressed);
        self.rows.time = f64::NEG_INFINITY;
        self.step_size = StepSizeControl::new(model, settings, state);
        state.pairs.iter_mut().for_each(|pair| pair.closed = false);
        if settings.impacts == ImpactResolution::Event {
            let at_rest = self.solver.at_rest(StateView { model, settings, state });
            at_rest.into_iter().for_each(|pair| state.pairs[pair].closed = true);
        }
    }

    /// The solver, and its view of the run.
    pub(super) fn solver(&mut self) -> (&mut Solver, StateView<'_>) {
        let Self { model, settings, state, solver, .. } = self;
        (solver, StateView { model, settings, state })
    }

    /// Sets initial velocities of the beams \[m/s\]: `velocity(beam, position)` at the nodes of each beam. Slope rates are those of a rigid motion
    /// between neighbouring nodes. Opens a new ledger.
    pub fn set_velocities(&mut self, velocity: impl Fn(&str, [f64; 2]) -> [f64; 2]) {
        set_velocities(self.model, self.settings.step, &mut self.state, velocity);
        self.open();
    }

    /// Reverses every velocity: without losses the motion returns to its start. Opens a new ledger.
    pub fn reverse(&mut self) {
        reverse(&mut self.state);
        self.open();
    }

    /// The state reached.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Energies and momenta of the state reached.
    pub fn measures(&self) -> &Measures {
        &self.measures
    }

    /// Newton iterations and factorisations so far.
    pub fn effort(&self) -> Effort {
        self.solver.counts.effort
    }

    /// Columns of the history.
    pub fn channels(&self) -> Vec<Channel> {
        channels::channels(self.model)
    }

    /// Number of steps of the given size up to the end; the last one may be shorter. For a requested accuracy the size is that of the first step,
    /// and the number is not known in advance.
    pub fn step_count(&self) -> usize {
        self.settings.step_count()
    }

    /// Whether the end is reached.
    pub fn is_over(&self) -> bool {
        match self.step_size {
            Some(_) => self.state.time >= self.settings.end,
            None => self.state.step >= self.step_count(),
        }
    }

    /// Whether the end influences the size of the next step.
    fn is_last_step(&self) -> bool {
        match &self.step_size {
            Some(step_size) => step_size.is_last(self.settings.end - self.state.time),
            None => self.state.step + 1 == self.step_count(),
        }
    }

    /// Runs to the end.
    pub fn run(mut self, recorder: &mut dyn Recorder) -> RunSummary {
        let termination = self.run_steps(recorder);
        let Self { model, settings, state, measures, solver, step_size, monitor, rows, .. } = self;
        let counts = solver.counts;
        // The summary solves for small forces: for very many elements both would need too much memory.
        drop(solver);
        let run = Ended {
            at: StateView { model, settings: &settings, state: &state },
            measures: &measures,
            counts,
            rows: rows.count,
            step_control: step_size.as_ref().map(StepSizeControl::control),
            monitor,
        };
        summarize(run, termination)
    }

    fn run_steps(&mut self, recorder: &mut dyn Recorder) -> Termination {
        let begun = recorder.begin(&self.channels()).map_err(Error::recorder);
        // A resumed run has its first row already.
        let goes_on = self.rows.count > 0;
        if let Err(error) =
            begun.and_then(|()| if goes_on { Ok(()) } else { self.record(recorder) })
        {
            return Termination::Failed(error);
        }
        self.tell_status(recorder);
        while !self.is_over() {
            let step = self.state.step;
            let last = self.is_last_step();
            if let Err(error) = self.offer_checkpoint(recorder, last) {
                return Termination::Failed(error);
            }
            if let Some(step_size) = self.step_size.as_mut().filter(|_| last) {
                step_size.ends = true;
            }
            let flow = match self.advance(recorder) {
                Ok(flow) => flow,
                Err(error) => return Termination::Failed(error),
            };
            self.tell_status(recorder);
            let stops = flow == Flow::Stop && !self.is_over();
            let due = self.state.step.is_multiple_of(self.settings.record_every);
            let mut noted = if due { self.record(recorder) } else { Ok(()) };
            // Before a row that a resumed run would not have.
            if stops && self.state.step > step {
                noted = noted.and_then(|()| self.offer_checkpoint(recorder, false));
            }
            if stops || self.is_over() {
                noted = noted.and_then(|()| self.record(recorder));
            }
            match noted {
                Err(error) => return Termination::Failed(error),
                Ok(()) if stops => return Termination::Interrupted { time: self.state.time },
                Ok(()) => {}
            }
        }
        Termination::Completed
    }

    /// Passes a row to the recorder, unless this instant has one: an impact at the very end of a step has recorded it already.
    pub(super) fn record(&mut self, recorder: &mut dyn Recorder) -> Result<(), Error> {
        let Self { model, state, measures, solver, monitor, rows, frames, .. } = self;
        if state.time <= rows.time {
            return Ok(());
        }
        let iterations = rows.begin(state.time, solver.counts.effort.iterations);
        monitor.settle(model, state);
        monitor.reactions.close();
        recorder.state(state);
        let [force, impulse] = frames.contact();
        if recorder.wants_frame(state.time, force, impulse) {
            let forces = (monitor.lines(), &monitor.section_forces[..]);
            recorder.frame(&frames.frame(model, state, forces));
        }
        if recorder.wants_rows() {
            let seen = (*model, &*state, &*measures);
            let values = rows.values(seen, &solver.search, monitor, iterations);
            recorder.row(values).map_err(Error::recorder)?;
        }
        rows.end();
        frames.end_row();
        Ok(())
    }

    /// Progress of the run.
    pub fn status(&self) -> RunStatus<'_> {
        let at = StateView { model: self.model, settings: &self.settings, state: &self.state };
        let control = self.step_size.as_ref().map(StepSizeControl::control);
        RunStatus::of(at, &self.monitor.contacts, self.solver.counts.effort.iterations, control)
    }

    /// Takes a checkpoint of the run between two steps.
    pub fn checkpoint(&self) -> Checkpoint {
        // Every field is named, so that a new field cannot be forgotten.
        let Self {
            state,
            measures,
            solver,
            step_size,
            monitor,
            rows,
            frames,
            // These follow from model and settings.
            model: _,
            settings: _,
            pressed: _,
        } = self;
        Checkpoint {
            state: state.clone(),
            measures: *measures,
            step_size: step_size.clone(),
            counts: solver.counts,
            search: solver.search.clone(),
            ties: solver.ties(),
            monitor: monitor.clone(),
            rows: rows.clone(),
            frames: frames.clone(),
        }
    }

    /// Continues a run from a checkpoint to the end of the settings, which may be later than in the original run: rows and summary are those of an
    /// uninterrupted run, bit for bit. All other settings must be unchanged.
    ///
    /// # Errors
    /// Every fault of the settings; a checkpoint that does not belong to the model.
    pub fn resume(
        model: &'m Model,
        settings: &Settings,
        checkpoint: Checkpoint,
    ) -> Result<Self, ResumeError> {
        let mut run = Self::new(model, settings).map_err(ResumeError::Faults)?;
        let beyond = match checkpoint.step_size {
            Some(_) => checkpoint.time() > settings.end * (1.0 + SAME_INSTANT),
            None => checkpoint.step() > run.step_count(),
        };
        if beyond || !checkpoint.fits(&run.checkpoint(), model) {
            return Err(ResumeError::Foreign);
        }
        let Checkpoint { state, measures, step_size, counts, search, ties, monitor, rows, frames } =
            checkpoint;
        run.solver.resume(model, counts, search, &ties);
        Ok(Self { state, measures, step_size, monitor, rows, frames, ..run })
    }

    /// Passes the status to a recorder that requests it.
    fn tell_status(&self, recorder: &mut dyn Recorder) {
        if recorder.wants_status() {
            recorder.status(&self.status());
        }
    }

    /// Passes a checkpoint to a recorder that requests one, up to the first step whose size the end determines: an extended run takes another one.
    fn offer_checkpoint(&self, recorder: &mut dyn Recorder, last: bool) -> Result<(), Error> {
        if self.step_size.as_ref().is_some_and(|step_size| step_size.ends) {
            return Ok(());
        }
        match recorder.wants_checkpoint(last) {
            true => recorder.checkpoint(&self.checkpoint()).map_err(Error::recorder),
            false => Ok(()),
        }
    }
}

/// Simulates `model` under `settings`, handing rows to `recorder`.
///
/// # Errors
/// Every fault of the settings. A run without convergence is no error here: its summary gives the time it reached.
pub fn simulate(
    model: &Model,
    settings: &Settings,
    recorder: &mut dyn Recorder,
) -> Result<RunSummary, Vec<Fault>> {
    Ok(Simulation::new(model, settings)?.run(recorder))
}

/// The reference configuration at rest, that of a beam in flight too: as it would vibrate at rest.
///
/// # Errors
/// The overlapping bodies.
pub fn reference_state(model: &Model) -> Result<State, Vec<Fault>> {
    let mut state = Simulation::about(model, &Settings::new(1.0, 1.0))?.state().clone();
    state.velocity.fill([0.0; 4]);
    state.spin.iter_mut().for_each(|spin| spin.fill(0.0));
    Ok(state)
}
