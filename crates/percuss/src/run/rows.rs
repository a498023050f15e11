//! Rows of the history: values where the state stands, and what was summed up since the row before.

use serde::{Deserialize, Serialize};

use super::channels::{self, SinceLast};
use super::given::RowReactions;
use super::record::Recorder;
use super::simulation::Simulation;
use super::trial::Trial;
use crate::error::Error;
use crate::model::Model;

/// The row to come.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Rows {
    /// Rows recorded.
    pub count: usize,
    /// Time of the last one \[s\].
    pub time: f64,
    /// Newton iterations up to it.
    pub iterations: usize,
    /// Impulses since then along normal and tangent, shape (contacts, 2) \[N s\].
    pub impulse: Vec<[f64; 2]>,
    /// What supports gave since then.
    pub reactions: RowReactions,
    /// Values of a row, shape (channels) \[unit of the channel\].
    #[serde(skip)]
    values: Vec<f64>,
}

impl Rows {
    /// None yet; the run starts with the given reactions.
    pub fn new(model: &Model, reactions: Vec<[f64; 3]>) -> Self {
        Self {
            count: 0,
            time: f64::NEG_INFINITY,
            iterations: 0,
            impulse: vec![[0.0; 2]; model.contacts.len()],
            reactions: RowReactions::new(model, reactions),
            values: Vec::new(),
        }
    }

    /// Whether they belong to a model.
    pub fn fits(&self, model: &Model) -> bool {
        self.impulse.len() == model.contacts.len() && self.reactions.fits(model.supports.len())
    }
}

impl Simulation<'_> {
    /// Hands a row to the recorder, unless this instant has one: an impact at the very end of a step has left it already.
    pub(super) fn record(&mut self, recorder: &mut dyn Recorder) -> Result<(), Error> {
        if self.state.time <= self.rows.time {
            return Ok(());
        }
        let iterations = self.effort.iterations - self.rows.iterations;
        self.rows.iterations = self.effort.iterations;
        self.rows.count += 1;
        self.rows.time = self.state.time;
        self.settle_reactions();
        self.rows.reactions.close();
        recorder.state(&self.state);
        self.show(recorder);
        if recorder.wants_rows() {
            let since = SinceLast {
                impulse: &self.rows.impulse,
                search: &self.search,
                reactions: self.rows.reactions.mean(),
                reaction_impulses: self.rows.reactions.impulses(),
                lines: self.monitor.lines(),
                iterations,
            };
            channels::values(
                self.model,
                &self.state,
                &self.measures,
                &since,
                &mut self.rows.values,
            );
            recorder.row(&self.rows.values).map_err(Error::recorder)?;
        }
        self.rows.impulse.fill([0.0; 2]);
        Ok(())
    }

    /// Tells forces and impulses of supports apart, up to where the state stands.
    pub(super) fn settle_reactions(&mut self) {
        self.rows.reactions.settle(&self.state, &mut self.monitor.supports);
    }

    /// Adds what supports and contacts gave in an accepted part of a step; reactions in one that `carries_impulses` are no forces.
    pub(super) fn gather_row(&mut self, trial: &Trial, impulsive: bool) {
        self.rows.reactions.gather(&self.state, trial.h, impulsive);
        let contact_of = |pair: usize| self.model.pairs[pair].contact;
        for contact in &self.work.smooth {
            self.rows.impulse[contact_of(contact.pair)][0] += trial.h * contact.force.force;
        }
        for (contact, found) in trial.active.iter().zip(&self.work.rigid) {
            let sum = &mut self.rows.impulse[contact_of(contact.pair)];
            (0..2).for_each(|i| sum[i] += found.impulse[i]);
        }
    }

    /// Adds what striking bodies gave through their contacts in the part of a step that stands solved, before it is accepted.
    pub(super) fn gather_given(&mut self, h: f64) {
        for (i, given) in self.model.striking_bodies().zip(&mut self.given) {
            given.gather(&self.work, self.model.body_node(i), h);
        }
    }
}
