//! All data that change during a run, taken between two steps: a run continues from them as if it had never stopped.

use serde::{Deserialize, Serialize};

use super::frame::Frames;
use super::rows::Rows;
use crate::contact::search::Search;
use crate::ledger::Measures;
use crate::model::{Fault, Model};
use crate::run::observing::monitor::Monitor;
use crate::run::observing::step_size::StepSizeControl;
use crate::run::solving::solver::Counts;
use crate::state::State;

/// A run between two steps, of its model and settings; [`Simulation::resume`](crate::Simulation::resume) continues it.
///
/// Scratch data of the solver are omitted except for the pattern of its tangent: the rest may be dropped without changing a bit of the results.
/// Data that follow from model and settings are omitted too.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Checkpoint {
    pub(in crate::run) state: State,
    pub(in crate::run) measures: Measures,
    pub(in crate::run) step_size: Option<StepSizeControl>,
    pub(in crate::run) counts: Counts,
    pub(in crate::run) search: Search,
    /// Nodes tied together by contacts in the pattern of the tangent, shape (pairs of nodes) \[index of a node, index of a node\].
    pub(in crate::run) ties: Vec<(usize, usize)>,
    pub(in crate::run) monitor: Monitor,
    pub(in crate::run) rows: Rows,
    pub(in crate::run) frames: Frames,
}

/// No run counts further.
const MOST_COUNTED: usize = 1 << 48;

/// Reason why a run cannot continue from a checkpoint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ResumeError {
    /// Faults of the settings, shape (faults).
    Faults(Vec<Fault>),
    /// The checkpoint belongs to another model or another scheme, or its step is after the end.
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

    /// Whether all that belongs to nodes, elements, pairs, supports, ... is there, once for each, as in one of a fresh run.
    pub(in crate::run) fn fits(&self, fresh: &Self, model: &Model) -> bool {
        let nodes = model.node_count();
        let mut counts = self.counts.all().into_iter().chain([self.rows.count]);
        let paced = match (&self.step_size, &fresh.step_size) {
            (Some(own), Some(other)) => own.fits(other),
            (own, other) => own.is_none() && other.is_none(),
        };
        self.state.fits(&fresh.state, model)
            && self.monitor.fits(&fresh.monitor, model)
            && self.search.fits(model)
            && self.rows.fits(model)
            && self.frames.fits(model)
            && paced
            && counts.all(|n| n < MOST_COUNTED)
            && self.rows.iterations <= self.counts.effort.iterations
            && self.ties.iter().all(|(a, b)| *a < nodes && *b < nodes)
    }
}
