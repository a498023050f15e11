//! The transient analysis: steps of the given size, cut where Newton's iteration fails, recorded row by row.

use super::channels::{self, SinceLast};
use super::frame::Frames;
use super::given::{Given, RowReactions};
use super::impacts::Advance;
use super::jumps;
use super::modes;
use super::monitor::Monitor;
use super::start::{Initial, initial_state, massless};
use super::static_contacts::takes_part;
use super::trial::size_of;
use crate::analysis::record::{Channel, Flow, Recorder};
use crate::contact::search::Search;
use crate::error::Error;
use crate::geometry::row::Row;
use crate::geometry::touch::Reach;
use crate::ledger::{Ledger, Measures, RoundOff};
use crate::math::vec2::{dot, norm, scale};
use crate::model::frozen::ContactData;
use crate::model::{Fault, Model};
use crate::settings::{SAME_INSTANT, Settings, Start};
use crate::state::State;
use crate::step::contacts::{ActiveContact, IMPULSIVE};
use crate::step::effective_mass::EffectiveMass;
use crate::step::forcing::Forcing;
use crate::step::modal_damping::ModalDamping;
use crate::step::newton::{Effort, Failure};
use crate::step::workspace::Workspace;
use crate::summary::*;

/// A step is cut down to this share of its size before the analysis gives up.
const SMALLEST_SHARE: f64 = 1e-4;
/// Parts of a step, impacts and cuts included, before the analysis gives up: more would not end.
const MOST_PARTS: usize = 20_000;
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
    pub(super) work: Workspace,
    pub(super) forcing: Forcing,
    pub(super) damping: ModalDamping,
    pub(super) monitor: Monitor,
    pub(super) effort: Effort,
    /// Steps of the solver accepted, and solved in search of impacts.
    pub(super) solver_steps: usize,
    pub(super) step_cuts: usize,
    pub(super) accumulated_steps: usize,
    /// Times at which steps are cut, increasing \[s\].
    pub(super) cuts: Vec<f64>,
    /// Whether prescribed velocities jump in the impact interval at hand.
    pub(super) jumping: bool,
    pub(super) measures: Measures,
    pub(super) rows: usize,
    pub(super) row: Vec<f64>,
    /// Impulses since the last row along normal and tangent, shape (n_contact) \[N s\].
    pub(super) row_impulse: Vec<[f64; 2]>,
    /// What supports gave since the last row.
    pub(super) row_reactions: RowReactions,
    /// What striking bodies gave through contacts.
    pub(super) given: Vec<Given>,
    /// Contacts that press in the equilibrium the run started from, with their forces \[N\]; empty otherwise.
    pub(super) pressed: Vec<(Row, f64)>,
    pub(super) row_iterations: usize,
    /// Time of the last row \[s\].
    pub(super) row_time: f64,
    /// Pair whose instant of contact the last accepted step was cut to.
    pub(super) located: Option<usize>,
    /// Which pairs are near.
    pub(super) search: Search,
    /// Pairs taken into the step at hand, those it brought within reach, and sleeping ones looked at on that account.
    pub(super) near: Vec<usize>,
    pub(super) reached: Vec<usize>,
    pub(super) looked: Vec<usize>,
    /// In time-stepping, which of the active contacts rest.
    pub(super) persistent: Vec<bool>,
    /// Whether Moreau's impact law stands in for Newton's in the step solved last.
    pub(super) fallback_law: bool,
    /// Effective masses of the beams of each contact, once it has struck under a rigid law.
    pub(super) struck_masses: Vec<Option<EffectiveMass>>,
    /// Impacts so far that several touching bodies shared.
    pub(super) shared_blows: SharedBlows,
    /// Size of the structure \[m\].
    pub(super) size: f64,
    /// What is shown of the part of a step accepted last.
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
        let mut simulation = Self {
            model,
            settings: *settings,
            monitor: Monitor::new(model, &state, &pressed),
            state,
            work: Workspace::new(model),
            forcing: Forcing::new(model),
            damping: ModalDamping::default(),
            effort: Effort::default(),
            solver_steps: 0,
            step_cuts: 0,
            accumulated_steps: 0,
            measures: Measures::default(),
            rows: 0,
            row: Vec::new(),
            cuts: jumps::cuts(model, settings.step),
            jumping: false,
            row_impulse: vec![[0.0; 2]; model.contacts.len()],
            row_reactions: RowReactions::new(model, reactions),
            given: vec![Given::default(); model.striking_bodies().count()],
            pressed,
            row_iterations: 0,
            row_time: f64::NEG_INFINITY,
            located: None,
            search: Search::new(model),
            near: Vec::new(),
            reached: Vec::new(),
            looked: Vec::new(),
            persistent: Vec::new(),
            fallback_law: false,
            struck_masses: vec![None; model.contacts.len()],
            shared_blows: SharedBlows::default(),
            size: size_of(model),
            frames: Frames::default(),
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
        self.damping = modes::modal_damping(self.model, &self.state);
        self.measures = Measures::of(self.model, &self.state, self.search.awake());
        let round_off = RoundOff::new(self.model, self.settings.step);
        self.state.ledger = Ledger::open(&self.measures, &round_off);
        self.monitor = Monitor::new(self.model, &self.state, &self.pressed);
        self.monitor.open_reactions(self.row_reactions.mean(), self.state.time);
        self.row_time = f64::NEG_INFINITY;
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

    /// Number of steps of the given size up to the end; the last one may be shorter.
    pub fn step_count(&self) -> usize {
        self.settings.step_count()
    }

    /// Runs to the end.
    pub fn run(mut self, recorder: &mut dyn Recorder) -> RunSummary {
        let termination = self.run_steps(recorder);
        self.summary(termination)
    }

    fn run_steps(&mut self, recorder: &mut dyn Recorder) -> Termination {
        let begun = recorder.begin(&self.channels()).map_err(Error::recorder);
        // A run that goes on from a checkpoint has left its first row already.
        let goes_on = self.rows > 0;
        if let Err(error) =
            begun.and_then(|()| if goes_on { Ok(()) } else { self.record(recorder) })
        {
            return Termination::Failed(error);
        }
        let last = self.step_count();
        while self.state.step < last {
            let step = self.state.step;
            if let Err(error) = self.offer_checkpoint(recorder, step + 1 == last) {
                return Termination::Failed(error);
            }
            let flow = match self.advance(recorder) {
                Ok(flow) => flow,
                Err(error) => return Termination::Failed(error),
            };
            let stops = flow == Flow::Stop && self.state.step < last;
            let due = self.state.step.is_multiple_of(self.settings.record_every);
            let mut noted = if due { self.record(recorder) } else { Ok(()) };
            // Before a row that a run that goes on would not have.
            if stops && self.state.step > step {
                noted = noted.and_then(|()| self.offer_checkpoint(recorder, false));
            }
            if stops || self.state.step == last {
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

    /// Hands a checkpoint to a recorder that wants one.
    fn offer_checkpoint(&self, recorder: &mut dyn Recorder, last: bool) -> Result<(), Error> {
        match recorder.wants_checkpoint(last) {
            true => recorder.checkpoint(&self.checkpoint()).map_err(Error::recorder),
            false => Ok(()),
        }
    }

    /// Advances by one step of the given size; rows before and after an impact go to `recorder`, which may stop it between
    /// two parts of the step.
    ///
    /// # Errors
    /// If no solution is found even for very short steps; the state is the last one accepted.
    pub fn advance(&mut self, recorder: &mut dyn Recorder) -> Result<Flow, Error> {
        let step = self.settings.step;
        let target = step.min(self.settings.end - self.state.step as f64 * step);
        let target = if (target - step).abs() <= SAME_INSTANT * step { step } else { target };
        let mut size = target;
        let mut events_left = Advance::MOST_EVENTS;
        let mut parts = 0;
        while self.state.offset < target * (1.0 - SAME_INSTANT) {
            parts += 1;
            if parts > MOST_PARTS {
                return Err(self.give_up(Failure::Impact, size));
            }
            let trial = size.min(target - self.state.offset).min(self.until_cut());
            let mut advance = Advance { size: trial, share: size / target, events_left };
            match self.advance_part(&mut advance, recorder)? {
                Ok(done) => {
                    events_left = advance.events_left;
                    self.state.offset += done;
                    size = (2.0 * size).min(target);
                    let ends = self.state.offset >= target * (1.0 - SAME_INSTANT);
                    if !ends && recorder.progress(self.state.time) == Flow::Stop {
                        return Ok(Flow::Stop);
                    }
                }
                Err(failure) => {
                    self.step_cuts += 1;
                    size = 0.5 * trial;
                    if size < SMALLEST_SHARE * step {
                        return Err(self.give_up(failure, trial));
                    }
                }
            }
        }
        self.accumulated_steps += usize::from(events_left == 0);
        self.state.step += 1;
        self.state.offset -= target;
        if self.state.offset.abs() <= SAME_INSTANT * step {
            self.state.offset = 0.0;
        }
        let grid = self.state.step as f64 * step;
        // Never back, not even by the last bit, behind an impact at the end of the step.
        let time = grid.min(self.settings.end) + self.state.offset;
        self.state.time = if self.state.offset > 0.0 { time.max(self.state.time) } else { time };
        self.refuse_growth()?;
        Ok(recorder.progress(self.state.time))
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

    /// Measures the new state; follows every accepted step.
    pub(super) fn measure(&mut self) {
        self.measures = Measures::of(self.model, &self.state, self.search.awake());
        self.state.ledger.rescale(&self.measures);
        self.monitor.audit(&self.state.ledger, &self.measures);
    }

    /// Hands a row to the recorder, unless this instant has one: an impact at the very end of a step has left it already.
    pub(super) fn record(&mut self, recorder: &mut dyn Recorder) -> Result<(), Error> {
        if self.state.time <= self.row_time {
            return Ok(());
        }
        let iterations = self.effort.iterations - self.row_iterations;
        self.row_iterations = self.effort.iterations;
        self.rows += 1;
        self.row_time = self.state.time;
        recorder.state(&self.state);
        self.show(recorder);
        if recorder.wants_rows() {
            self.row_reactions.close(&self.state, IMPULSIVE * self.settings.step);
            let since = SinceLast {
                impulse: &self.row_impulse,
                search: &self.search,
                reactions: self.row_reactions.mean(),
                reaction_impulses: self.row_reactions.impulses(),
                lines: self.monitor.lines(),
                iterations,
            };
            channels::values(self.model, &self.state, &self.measures, &since, &mut self.row);
            recorder.row(&self.row).map_err(Error::recorder)?;
        }
        self.row_impulse.fill([0.0; 2]);
        Ok(())
    }

    /// Adds the reactions of an accepted part of a step; those of an `carries_impulses` one are no forces.
    pub(super) fn gather_reactions(&mut self, h: f64, carries_impulses: bool) {
        self.row_reactions.gather(&self.state, h, carries_impulses, &mut self.monitor.supports);
    }

    /// Adds what striking bodies gave through their contacts in the part of a step that stands solved, before it is accepted.
    pub(super) fn gather_given(&mut self, h: f64) {
        for (i, given) in self.model.striking_bodies().zip(&mut self.given) {
            given.gather(&self.work, self.model.body_node(i), h);
        }
    }

    /// Adds the impulses of an accepted part of a step of size `h`.
    pub(super) fn gather_impulses(&mut self, h: f64, active: &[ActiveContact]) {
        let contact_of = |pair: usize| self.model.pairs[pair].contact;
        for contact in &self.work.smooth {
            self.row_impulse[contact_of(contact.pair)][0] += h * contact.force.force;
        }
        for (contact, found) in active.iter().zip(&self.work.rigid) {
            let sum = &mut self.row_impulse[contact_of(contact.pair)];
            (0..2).for_each(|i| sum[i] += found.impulse[i]);
        }
    }

    fn projectiles(&self) -> Vec<ProjectileSummary> {
        let (model, state) = (self.model, &self.state);
        let each = model.striking_bodies().zip(&self.given).map(|(first, given)| {
            let body = &model.bodies[first];
            let v = &state.velocity[model.body_node(first)];
            // At rest at the start, it has a direction only if it is guided.
            let guide = model.projectiles.iter().find(|p| p.body == first).map(|p| p.direction);
            let speed = norm(body.velocity);
            let along = guide.unwrap_or(scale(1.0 / speed, body.velocity));
            let plain = |x: f64| x + 0.0; // no -0.0
            ProjectileSummary {
                name: body.name.clone(),
                velocity_final: [plain(v[0]), plain(v[1])],
                spin_final: plain(v[2]),
                momentum_transferred: if speed > 0.0 || guide.is_some() {
                    plain(dot(along, given.impulse))
                } else {
                    plain(-norm(given.impulse))
                },
                energy_transferred: plain(given.work),
            }
        });
        each.collect()
    }

    fn summary(self, termination: Termination) -> RunSummary {
        let ledger = &self.state.ledger;
        let relative = |value: f64, scale: f64| if value == 0.0 { 0.0 } else { value / scale };
        let effective = self.model.effective_masses();
        let [energy_scale, linear_scale, angular_scale] = ledger.audit_scales();
        RunSummary {
            termination,
            time: self.state.time,
            steps: self.state.step,
            solver_steps: self.solver_steps,
            step_cuts: self.step_cuts,
            accumulated_steps: self.accumulated_steps,
            newton_iterations: self.effort.iterations,
            factorizations: self.effort.factorizations,
            rows: self.rows,
            energy: EnergySummary {
                initial: ledger.energy_initial,
                final_: self.measures.total(),
                work_loads: ledger.work_loads,
                work_supports: ledger.work_supports,
                loss_impacts: ledger.loss_impacts,
                loss_damping: ledger.loss_damping,
                scale: energy_scale,
                residual_max: relative(self.monitor.energy_residual, energy_scale),
            },
            momentum: MomentumSummary {
                linear_scale,
                linear_residual_max: relative(self.monitor.linear_residual, linear_scale),
                angular_scale,
                angular_residual_max: relative(self.monitor.angular_residual, angular_scale),
            },
            audit: AuditSummary {
                curvature_drift_max: self.monitor.curvature_drift,
                membrane_drift_max: self.monitor.membrane_drift,
            },
            projectiles: self.projectiles(),
            contacts: (self.model.contacts.iter().zip(self.monitor.contacts.records).enumerate())
                .map(|(i, (contact, mut record))| {
                    record.intervals_mut().iter_mut().for_each(|c| c.energy.balance());
                    ContactSummary {
                        name: contact.name.clone(),
                        between: contact.between.clone(),
                        effective_mass: effective.get(i).copied().or(self.struck_masses[i]),
                        record,
                    }
                })
                .collect(),
            contact_residual_max: self.monitor.contacts.residual,
            shared_blows: self.shared_blows,
            points: (self.model.points.iter().zip(self.monitor.points))
                .map(|(p, mut crests)| {
                    crests.iter_mut().for_each(|crest| crest.close(0, self.state.time));
                    PointSummary {
                        name: p.label.clone(),
                        displacement_max: crests.map(|c| Peak { value: c.value, time: c.time }),
                        resolved: crests.map(|c| c.is_resolved(0)),
                    }
                })
                .collect(),
            supports: self.monitor.supports,
            section_forces: self.monitor.section_forces,
        }
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
