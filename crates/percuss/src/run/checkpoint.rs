//! Everything that changes while a run steps, taken between two steps: what a run needs to go on later as if it had never stopped.

use serde::{Deserialize, Serialize};

use super::given::Given;
use super::monitor::Monitor;
use super::rows::Rows;
use super::simulation::Simulation;
use super::step_size::StepSizeControl;
use crate::contact::search::Search;
use crate::ledger::Measures;
use crate::model::{Fault, Model};
use crate::settings::{SAME_INSTANT, Settings};
use crate::state::State;
use crate::step::effective_mass::EffectiveMass;
use crate::step::newton::Effort;
use crate::summary::SharedBlows;

/// A run between two steps, of the model and the settings it was begun with; [`Simulation::resume`] goes on from there.
///
/// Scratch of the solver is left out but for the pattern of its tangent: the rest may be dropped without changing a bit of what follows.
/// So is what follows from model and settings.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Checkpoint {
    state: State,
    step_size: Option<StepSizeControl>,
    monitor: Monitor,
    effort: Effort,
    solver_steps: usize,
    step_cuts: usize,
    accumulated_steps: usize,
    measures: Measures,
    rows: Rows,
    /// What striking bodies gave through contacts, shape (striking bodies).
    given: Vec<Given>,
    search: Search,
    /// Effective masses of the beams of each contact, once it has struck, shape (contacts).
    struck_masses: Vec<Option<EffectiveMass>>,
    shared_blows: SharedBlows,
    /// Nodes tied together by contacts in the pattern of the tangent, shape (pairs of nodes) \[index of a node, index of a node\].
    ties: Vec<(usize, usize)>,
}

/// No run counts further.
pub(super) const MOST_COUNTED: usize = 1 << 48;

/// Why a run cannot go on from a checkpoint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ResumeError {
    /// Faults of the settings, shape (faults).
    Faults(Vec<Fault>),
    /// The checkpoint belongs to another model or another scheme, or its step lies beyond the end.
    Foreign,
}

impl Checkpoint {
    /// Steps of the given size completed.
    pub fn step(&self) -> usize {
        self.state.step
    }

    /// Time reached \[s\].
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Rows recorded so far.
    pub fn rows(&self) -> usize {
        self.rows.count
    }

    /// Whether it was taken beyond the end of a run.
    fn is_beyond(&self, run: &Simulation<'_>) -> bool {
        match self.step_size {
            Some(_) => self.state.time > run.settings.end * (1.0 + SAME_INSTANT),
            None => self.step() > run.step_count(),
        }
    }

    /// Whether all that belongs to nodes, elements, pairs, supports, ... is there, once for each.
    fn fits(&self, fresh: &Simulation<'_>) -> bool {
        let same = self.state.fits(&fresh.state, fresh.model)
            && self.monitor.fits(&fresh.monitor, fresh.model)
            && self.search.fits(fresh.model)
            && self.rows.fits(fresh.model)
            && self.paced_like(fresh);
        let nodes = fresh.model.node_count();
        let effort = [self.effort.iterations, self.effort.factorizations, self.solver_steps];
        let counts = [self.step_cuts, self.accumulated_steps, self.rows.count];
        let counted = effort.iter().chain(&counts).all(|n| *n < MOST_COUNTED)
            && self.rows.iterations <= self.effort.iterations;
        let tied = self.ties.iter().all(|(a, b)| *a < nodes && *b < nodes);
        let lengths = [
            (self.given.len(), fresh.given.len()),
            (self.struck_masses.len(), fresh.struck_masses.len()),
        ];
        same && tied && counted && lengths.iter().all(|(a, b)| a == b)
    }
}

impl Checkpoint {
    /// Whether steps are chosen in it as they are in a run.
    fn paced_like(&self, fresh: &Simulation<'_>) -> bool {
        match (&self.step_size, &fresh.step_size) {
            (Some(own), Some(other)) => own.fits(other),
            (own, other) => own.is_none() && other.is_none(),
        }
    }
}

impl<'m> Simulation<'m> {
    /// Takes a checkpoint. It tells of the run as it is, between two steps.
    pub fn checkpoint(&self) -> Checkpoint {
        // Every field is named, so that none is forgotten when one is added.
        let Self {
            state,
            step_size,
            monitor,
            effort,
            solver_steps,
            step_cuts,
            accumulated_steps,
            measures,
            rows,
            given,
            search,
            work,
            struck_masses,
            shared_blows,
            // These follow from model and settings ...
            model: _,
            settings: _,
            damping: _,
            cuts: _,
            pressed: _,
            size: _,
            positions: _,
            // ... and these are set anew in every part of a step.
            forcing: _,
            encounters: _,
            frames: _,
        } = self;
        Checkpoint {
            state: state.clone(),
            step_size: step_size.clone(),
            monitor: monitor.clone(),
            effort: *effort,
            solver_steps: *solver_steps,
            step_cuts: *step_cuts,
            accumulated_steps: *accumulated_steps,
            measures: *measures,
            rows: rows.clone(),
            given: given.clone(),
            search: search.clone(),
            struck_masses: struck_masses.clone(),
            shared_blows: *shared_blows,
            ties: work.tangent.ties(),
        }
    }

    /// A run that goes on from a checkpoint, to the end of the settings, which may lie later than when it was taken: rows and
    /// summary are those of a run that was never interrupted, bit for bit. All else in the settings must be as it was.
    ///
    /// # Errors
    /// Every fault of the settings; a checkpoint that does not belong to the model.
    pub fn resume(
        model: &'m Model,
        settings: &Settings,
        checkpoint: Checkpoint,
    ) -> Result<Self, ResumeError> {
        let mut run = Self::new(model, settings).map_err(ResumeError::Faults)?;
        if !checkpoint.fits(&run) || checkpoint.is_beyond(&run) {
            return Err(ResumeError::Foreign);
        }
        run.state = checkpoint.state;
        run.step_size = checkpoint.step_size;
        run.work.beams.sweep.end();
        run.monitor = checkpoint.monitor;
        run.effort = checkpoint.effort;
        run.solver_steps = checkpoint.solver_steps;
        run.step_cuts = checkpoint.step_cuts;
        run.accumulated_steps = checkpoint.accumulated_steps;
        run.measures = checkpoint.measures;
        run.rows = checkpoint.rows;
        run.given = checkpoint.given;
        run.search = checkpoint.search;
        run.struck_masses = checkpoint.struck_masses;
        run.shared_blows = checkpoint.shared_blows;
        run.work.tangent.tie(model, &checkpoint.ties);
        Ok(run)
    }
}
