//! A transient run: what it consists of, how it is set up, the loop over its steps.

use super::channels;
use super::frame::Frames;
use super::given::Given;
use super::jumps;
use super::monitor::Monitor;
use super::record::{Channel, Flow, Recorder};
use super::rows::Rows;
use super::solve::Encounters;
use super::start::{Initial, initial_state, massless};
use super::step_size::StepSizeControl;
use crate::analysis::damped_modes::{modal_damping, undampable};
use crate::analysis::static_contacts::takes_part;
use crate::contact::search::Search;
use crate::error::Error;
use crate::geometry::row::Row;
use crate::geometry::touch::Reach;
use crate::ledger::{Ledger, Measures, RoundOff};
use crate::model::frozen::ContactData;
use crate::model::{Fault, Model};
use crate::settings::{ImpactResolution, Settings, Start};
use crate::state::State;
use crate::step::effective_mass::EffectiveMass;
use crate::step::forcing::Forcing;
use crate::step::modal_damping::ModalDamping;
use crate::step::newton::Effort;
use crate::step::workspace::Workspace;
use crate::summary::{RunSummary, SharedBlows, Termination};

/// Energy out of nothing at which a run ends, beside what was there at the start or was put in.
const MOST_MADE: f64 = 10.0;

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
    /// The size of steps, where an accuracy is asked for in place of one.
    pub(super) step_size: Option<StepSizeControl>,
    /// Energies and momenta of the state.
    pub(super) measures: Measures,

    // The part of a step solved last.
    pub(super) work: Workspace,
    pub(super) forcing: Forcing,
    pub(super) encounters: Encounters,
    /// Which pairs are near.
    pub(super) search: Search,

    // What follows from model and settings.
    pub(super) damping: ModalDamping,
    /// Times at which steps are cut, increasing, shape (cuts) \[s\].
    pub(super) cuts: Vec<f64>,
    /// Size of the structure \[m\].
    pub(super) size: f64,
    /// What positions are as large as \[m\].
    pub(super) positions: f64,
    /// Contacts that press in the equilibrium the run started from, with their forces, shape (such contacts) \[N\]; empty otherwise.
    pub(super) pressed: Vec<(Row, f64)>,

    // What the summary, rows and frames tell.
    pub(super) monitor: Monitor,
    pub(super) effort: Effort,
    /// Solutions of parts of steps, trials of the root searches for impacts included.
    pub(super) solver_steps: usize,
    pub(super) step_cuts: usize,
    pub(super) accumulated_steps: usize,
    /// What striking bodies gave through contacts, shape (striking bodies).
    pub(super) given: Vec<Given>,
    /// Effective masses of the beams of each contact, once it has struck under a rigid law, shape (contacts).
    pub(super) struck_masses: Vec<Option<EffectiveMass>>,
    /// Impacts so far that several touching bodies shared.
    pub(super) shared_blows: SharedBlows,
    pub(super) rows: Rows,
    pub(super) frames: Frames,
}

impl<'m> Simulation<'m> {
    /// The model at rest, its projectiles on their way.
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
        Self::about(model, settings)
    }

    /// The same of structures that may have beams without mass, which nothing moves in time.
    pub(super) fn about(model: &'m Model, settings: &Settings) -> Result<Self, Vec<Fault>> {
        let Initial { state, reactions, pressed } = initial_state(model, settings)?;
        // What presses on something in equilibrium may well be inside it.
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
            step_size: None,
            work: Workspace::new(model),
            forcing: Forcing::new(model),
            encounters: Encounters::default(),
            search: Search::new(model),
            damping: ModalDamping::default(),
            cuts: jumps::cuts(model, settings.step),
            size: model.extent(),
            positions: model.position_scale(),
            monitor: Monitor::new(model, &state, &pressed),
            effort: Effort::default(),
            solver_steps: 0,
            step_cuts: 0,
            accumulated_steps: 0,
            given: vec![Given::default(); model.striking_bodies().count()],
            struck_masses: vec![None; model.contacts.len()],
            shared_blows: SharedBlows::default(),
            rows: Rows::new(model, reactions),
            frames: Frames::default(),
            state,
            pressed,
        };
        simulation.start_moving();
        simulation.open();
        Ok(simulation)
    }

    pub(super) fn open(&mut self) {
        self.steer_obstacles();
        self.search = Search::new(self.model);
        self.search.see(self.model, &mut self.state, Reach::All);
        if self.settings.scheme.advances_accelerations() {
            self.initial_acceleration();
        }
        self.damping = modal_damping(self.model, &self.state);
        self.take_measures();
        let round_off = RoundOff::new(self.model, self.settings.step);
        self.state.ledger = Ledger::open(&self.measures, &round_off);
        self.monitor = Monitor::new(self.model, &self.state, &self.pressed);
        self.monitor.open_reactions(self.rows.reactions.mean(), self.state.time);
        self.rows.time = f64::NEG_INFINITY;
        self.step_size = StepSizeControl::new(self.model, &self.settings, &self.state);
        self.state.pairs.iter_mut().for_each(|pair| pair.closed = false);
        if self.settings.impacts == ImpactResolution::Event {
            self.close_at_rest();
        }
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
        self.effort
    }

    /// Columns of the history.
    pub fn channels(&self) -> Vec<Channel> {
        channels::channels(self.model)
    }

    /// Number of steps of the given size up to the end; the last one may be shorter. Where an accuracy is asked for, of steps of the size
    /// of the first one, and the number is not known before.
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

    /// Whether the end has a say in the size of the next step.
    fn is_last_step(&self) -> bool {
        match &self.step_size {
            Some(step_size) => step_size.is_last(self.settings.end - self.state.time),
            None => self.state.step + 1 == self.step_count(),
        }
    }

    /// Runs to the end.
    pub fn run(mut self, recorder: &mut dyn Recorder) -> RunSummary {
        let termination = self.run_steps(recorder);
        self.summary(termination)
    }

    fn run_steps(&mut self, recorder: &mut dyn Recorder) -> Termination {
        let begun = recorder.begin(&self.channels()).map_err(Error::recorder);
        // A run that goes on from a checkpoint has left its first row already.
        let goes_on = self.rows.count > 0;
        if let Err(error) =
            begun.and_then(|()| if goes_on { Ok(()) } else { self.record(recorder) })
        {
            return Termination::Failed(error);
        }
        self.tell_pace(recorder);
        while !self.is_over() {
            let step = self.state.step;
            if let Err(error) = self.offer_checkpoint(recorder, self.is_last_step()) {
                return Termination::Failed(error);
            }
            let flow = match self.advance(recorder) {
                Ok(flow) => flow,
                Err(error) => return Termination::Failed(error),
            };
            self.tell_pace(recorder);
            let stops = flow == Flow::Stop && !self.is_over();
            let due = self.state.step.is_multiple_of(self.settings.record_every);
            let mut noted = if due { self.record(recorder) } else { Ok(()) };
            // Before a row that a run that goes on would not have.
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

    /// Hands the pace to a recorder that wants it.
    fn tell_pace(&self, recorder: &mut dyn Recorder) {
        if recorder.wants_status() {
            recorder.status(&self.status());
        }
    }

    /// Hands a checkpoint to a recorder that wants one.
    fn offer_checkpoint(&self, recorder: &mut dyn Recorder, last: bool) -> Result<(), Error> {
        match recorder.wants_checkpoint(last) {
            true => recorder.checkpoint(&self.checkpoint()).map_err(Error::recorder),
            false => Ok(()),
        }
    }

    /// Ends a run whose scheme makes energy out of nothing. What conserves it never comes near: its residual is round-off beside the
    /// largest energy so far.
    pub(super) fn refuse_growth(&self) -> Result<(), Error> {
        let ledger = &self.state.ledger;
        let (made, came) = (ledger.energy_residual(&self.measures), self.monitor.energy_came);
        let grown = made > MOST_MADE * came && made > 0.5 * ledger.energy_scale;
        if grown || made == f64::INFINITY {
            return Err(Error::grown(self.state.time, made, came));
        }
        Ok(())
    }

    fn take_measures(&mut self) {
        let (awake, sweep) = (self.search.awake(), &mut self.work.beams.sweep);
        self.measures = Measures::of(self.model, &self.state, awake, sweep);
    }

    /// Measures the new state; follows every accepted step.
    pub(super) fn measure(&mut self) {
        self.take_measures();
        self.state.ledger.rescale(&self.measures);
        self.monitor.audit(&self.state.ledger, &self.measures);
    }
}

/// Simulates `model` under `settings`, handing rows to `recorder`.
///
/// # Errors
/// Every fault of the settings. A run that gives up on its way is no error here: its summary says how far it came.
pub fn simulate(
    model: &Model,
    settings: &Settings,
    recorder: &mut dyn Recorder,
) -> Result<RunSummary, Vec<Fault>> {
    Ok(Simulation::new(model, settings)?.run(recorder))
}
