//! Rows of the history: values in the current state, and sums since the previous row.

use serde::{Deserialize, Serialize};

use super::channels;
use super::now::Now;
use crate::contact::search::Search;
use crate::ledger::Measures;
use crate::model::Model;
use crate::model::rotations::continued;
use crate::run::observing::monitor::Monitor;
use crate::run::solving::trial::Accepted;
use crate::state::State;

/// The next row.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Rows {
    /// Rows recorded.
    pub count: usize,
    /// Time of the last one \[s\].
    pub time: f64,
    /// Newton iterations up to it.
    pub iterations: usize,
    /// Impulses since then along normal and tangent, shape (contacts, 2) \[N s\].
    impulse: Vec<[f64; 2]>,
    /// Rotations of the recorded points in the last one, shape (points) \[rad\].
    rotations: Vec<f64>,
    /// Values of a row, shape (channels) \[unit of the channel\].
    #[serde(skip)]
    values: Vec<f64>,
}

impl Rows {
    /// None yet.
    pub fn new(model: &Model) -> Self {
        Self {
            count: 0,
            time: f64::NEG_INFINITY,
            iterations: 0,
            impulse: vec![[0.0; 2]; model.contacts.len()],
            rotations: vec![0.0; model.points.len()],
            values: Vec::new(),
        }
    }

    /// Whether they belong to a model.
    pub fn fits(&self, model: &Model) -> bool {
        self.impulse.len() == model.contacts.len() && self.rotations.len() == model.points.len()
    }

    /// Adds contact impulses in an accepted part of a step.
    pub fn take(&mut self, part: &Accepted<'_>) {
        let (trial, work) = (&part.solved.trial, part.work());
        let contact_of = |pair: usize| part.model.pairs[pair].contact;
        for contact in &work.smooth {
            self.impulse[contact_of(contact.pair)][0] += trial.h * contact.force.force;
        }
        for (contact, found) in trial.active.iter().zip(&work.rigid) {
            let sum = &mut self.impulse[contact_of(contact.pair)];
            (0..2).for_each(|i| sum[i] += found.impulse[i]);
        }
    }

    /// Begins a row in the current state, after the given number of Newton iterations; returns their number since the previous row.
    pub fn begin(&mut self, time: f64, iterations: usize) -> usize {
        self.count += 1;
        self.time = time;
        iterations - std::mem::replace(&mut self.iterations, iterations)
    }

    /// Its values, shape (channels) \[unit of the channel\].
    pub fn values(
        &mut self,
        (model, state, measures): (&Model, &State, &Measures),
        search: &Search,
        monitor: &Monitor,
        iterations: usize,
    ) -> &[f64] {
        self.turn(model, state);
        let now = Now {
            state,
            measures,
            rotations: &self.rotations,
            impulse: &self.impulse,
            search,
            reactions: monitor.reactions.mean(),
            reaction_impulses: monitor.reactions.impulses(),
            lines: monitor.lines(),
            base_velocity: monitor.base_velocity,
            iterations,
        };
        channels::values(model, &now, &mut self.values);
        &self.values
    }

    /// Rotations of the recorded points in the current state: at first as along their beams, then with no more than half a turn since the
    /// row before.
    fn turn(&mut self, model: &Model, state: &State) {
        if self.count <= 1 {
            self.rotations = model.rotations(&state.displacement);
            return;
        }
        for (point, rotation) in model.points.iter().zip(&mut self.rotations) {
            *rotation = continued(point.rotation(&state.displacement), *rotation);
        }
    }

    /// Ends it.
    pub fn end(&mut self) {
        self.impulse.fill([0.0; 2]);
    }
}
