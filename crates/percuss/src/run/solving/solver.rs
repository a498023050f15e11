//! Solver of parts of steps. It reads the state and does not write it: results belong to the part.

use serde::{Deserialize, Serialize};

use super::decider::Moment;
use super::trial::{Encounters, PartKind, PartSolution, Solved, Trial};
use crate::contact::search::Search;
use crate::ledger::Measures;
use crate::model::Model;
use crate::model::frozen::JointLoad;
use crate::settings::{Scheme, Settings};
use crate::state::{PairState, State};
use crate::step::constraint::ConstraintStep;
use crate::step::contacts::{ActiveContact, IMPULSIVE, Phase, RigidContact};
use crate::step::forcing::Forcing;
use crate::step::integration::Integration;
use crate::step::joints;
use crate::step::modal_damping::ModalDamping;
use crate::step::newton::{Effort, seen};
use crate::step::workspace::Workspace;

/// Counts so far.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct Counts {
    /// Newton iterations and factorisations.
    pub effort: Effort,
    /// Solutions of parts of steps, trials of the root searches for impacts included.
    pub solver_steps: usize,
    /// Parts of steps that had no solution and were cut.
    pub step_cuts: usize,
    /// Steps in which impacts accumulated.
    pub accumulated_steps: usize,
}

impl Counts {
    /// All of them, shape (5) \[-\].
    pub fn all(&self) -> [usize; 5] {
        let Effort { iterations, factorizations } = self.effort;
        [iterations, factorizations, self.solver_steps, self.step_cuts, self.accumulated_steps]
    }
}

/// Status of a run.
#[derive(Clone, Copy, Debug)]
pub struct StateView<'a> {
    /// The model.
    pub model: &'a Model,
    /// Settings.
    pub settings: &'a Settings,
    /// State.
    pub state: &'a State,
}

/// Data for the solution of parts of steps.
#[derive(Clone, Debug)]
pub struct Solver {
    /// Pairs that are close.
    pub search: Search,
    /// Modal damping.
    pub damping: ModalDamping,
    /// Times at which steps are cut, increasing, shape (cuts) \[s\].
    pub cuts: Vec<f64>,
    /// Size of the structure \[m\].
    pub size: f64,
    /// Scale of positions \[m\].
    pub positions: f64,
    /// Counts so far.
    pub counts: Counts,
    /// Memory of the next part; `None` while a solved part uses it.
    spare: Option<Box<PartSolution>>,
}

impl Solver {
    /// Before the first part; steps are cut at the given times.
    pub fn new(model: &Model, cuts: Vec<f64>) -> Self {
        Self {
            search: Search::new(model),
            damping: ModalDamping::default(),
            cuts,
            size: model.extent(),
            positions: model.position_scale(),
            counts: Counts::default(),
            spare: Some(Box::new(PartSolution::new(model))),
        }
    }

    /// Memory of a part of a step, taken from the solver until it is returned.
    pub fn room(&mut self, model: &Model) -> Box<PartSolution> {
        self.spare.take().unwrap_or_else(|| Box::new(PartSolution::new(model)))
    }

    /// Returns the memory of a completed part for the next one.
    pub fn keep(&mut self, room: Box<PartSolution>) {
        self.spare = Some(room);
    }

    /// Energies and momenta of a state.
    pub fn measures(&mut self, model: &Model, state: &State) -> Measures {
        let mut room = self.room(model);
        let measures = self.measures_in(&mut room, model, state);
        self.keep(room);
        measures
    }

    /// The same, of a state at the end of a part.
    pub fn measures_in(&self, room: &mut PartSolution, model: &Model, state: &State) -> Measures {
        Measures::of(model, state, self.search.awake(), &mut room.work.beams.sweep)
    }

    /// Nodes tied together by contacts in the pattern of the tangent, shape (pairs of nodes) \[index of a node, index of a node\].
    pub fn ties(&self) -> Vec<(usize, usize)> {
        self.spare.as_ref().map_or_else(Vec::new, |room| room.work.tangent.ties())
    }

    /// Continues from another state, with the given counts, sights and ties.
    pub fn resume(
        &mut self,
        model: &Model,
        counts: Counts,
        search: Search,
        ties: &[(usize, usize)],
    ) {
        (self.counts, self.search) = (counts, search);
        let mut room = self.room(model);
        room.work.beams.sweep.end();
        room.work.tangent.tie(model, ties);
        self.keep(room);
    }

    /// Status of a run within a step, for decisions.
    pub fn moment(&mut self, at: StateView<'_>) -> Moment {
        let cut = self.time_to_cut(at.state.time, at.settings.step);
        let mut room = self.room(at.model);
        let moment = self.solving(at, &mut room).moment(cut);
        self.keep(room);
        moment
    }

    /// Resting pairs in the current state, shape (such pairs) \[index of a pair\].
    pub fn at_rest(&mut self, at: StateView<'_>) -> Vec<usize> {
        let mut room = self.room(at.model);
        let found = self.solving(at, &mut room).at_rest();
        self.keep(room);
        found
    }

    /// A solved part, in its own memory.
    pub(super) fn solving<'a>(
        &'a mut self,
        at: StateView<'a>,
        room: &'a mut PartSolution,
    ) -> Solving<'a> {
        let StateView { model, settings, state } = at;
        let Self { search, damping, cuts, size, positions, counts, .. } = self;
        let PartSolution { work, forcing, encounters, .. } = room;
        let (size, positions) = (*size, *positions);
        Solving {
            model,
            settings,
            state,
            search,
            damping,
            cuts,
            size,
            positions,
            counts,
            work,
            forcing,
            encounters,
        }
    }

    /// Solves a part of a step.
    ///
    /// # Errors
    /// The reason why there is no solution for `how`.
    pub fn solve<E>(
        &mut self,
        at: StateView<'_>,
        how: impl FnOnce(&mut Solving<'_>) -> Result<Trial, E>,
    ) -> Result<Solved, E> {
        let room = self.room(at.model);
        self.solve_in(room, at, how)
    }

    /// The same in given memory, which may be that of the previous part.
    ///
    /// # Errors
    /// As of [`Self::solve`]; the memory is returned to the solver.
    pub fn solve_in<E>(
        &mut self,
        mut room: Box<PartSolution>,
        at: StateView<'_>,
        how: impl FnOnce(&mut Solving<'_>) -> Result<Trial, E>,
    ) -> Result<Solved, E> {
        let mut solving = self.solving(at, &mut room);
        match how(&mut solving) {
            Ok(trial) => {
                let rule = solving.rule(&trial);
                let impulsive = solving.is_impulsive(trial.h);
                let jumps = impulsive || solving.gives_impulses(&trial);
                let shared = solving.multiple_impact(&trial);
                let joint_loads = solving.joint_loads(&trial, &rule);
                room.begin(at.model, at.state);
                Ok(Solved { trial, rule, impulsive, jumps, shared, joint_loads, solution: room })
            }
            Err(why) => {
                self.keep(room);
                Err(why)
            }
        }
    }
}

/// A part of a step during its solution, from the current state.
#[derive(Debug)]
pub struct Solving<'a> {
    pub(super) model: &'a Model,
    pub(super) settings: &'a Settings,
    pub(super) state: &'a State,
    pub(super) search: &'a mut Search,
    pub(super) damping: &'a ModalDamping,
    /// As in [`Solver`], shape (cuts) \[s\].
    pub(super) cuts: &'a [f64],
    pub(super) size: f64,
    pub(super) positions: f64,
    pub(super) counts: &'a mut Counts,
    pub(super) work: &'a mut Workspace,
    pub(super) forcing: &'a mut Forcing,
    pub(super) encounters: &'a mut Encounters,
}

impl Solving<'_> {
    /// Last evaluation of a pair.
    pub(super) fn seen(&self, pair: usize) -> &PairState {
        seen(self.state, &self.encounters.sights, pair)
    }

    /// The scheme on a part of size `h`; accelerations do not represent impulses, so jumps of prescribed velocities are made by the midpoint rule.
    pub(super) fn integration(&self, h: f64, jumps: bool) -> Integration {
        let by_midpoint = jumps && self.settings.scheme.advances_accelerations();
        let scheme = if by_midpoint { Scheme::Midpoint } else { self.settings.scheme };
        Integration::new(scheme, h)
    }

    /// The same for a solved part.
    fn rule(&self, trial: &Trial) -> Integration {
        self.integration(trial.h, matches!(trial.kind, PartKind::Jump))
    }

    /// Whether a part is as short as an impact.
    fn is_impulsive(&self, h: f64) -> bool {
        h < IMPULSIVE * self.settings.step
    }

    /// Whether a contact that was not at rest has an impulse.
    fn gives_impulses(&self, trial: &Trial) -> bool {
        let persistent = trial.persistent();
        let rests = |i: usize, contact: &ActiveContact| match contact.phase {
            Phase::Resting { .. } => self.state.pairs[contact.pair].closed,
            Phase::Impact { .. } => persistent.get(i).is_some_and(|rests| *rests),
            Phase::PlasticPostStep { .. } => false,
        };
        let given = |found: &RigidContact| found.impulse != [0.0; 2];
        let mut found = trial.active.iter().zip(&self.work.rigid).enumerate();
        found.any(|(i, (contact, found))| given(found) && !rests(i, contact))
    }

    /// Loads of joints with a strength, in a part without impulses.
    fn joint_loads(&self, trial: &Trial, rule: &Integration) -> Vec<JointLoad> {
        let impulses = self.is_impulsive(trial.h) || trial.carries_impulses();
        if self.model.joints.is_empty() || impulses {
            return Vec::new();
        }
        let (start, increment) = (&self.state.displacement[..], &self.work.increment[..]);
        let step = ConstraintStep { start, increment, forcing: self.forcing, share: rule.theta() };
        joints::loads(self.model, &step, &self.work.multiplier).collect()
    }
}
