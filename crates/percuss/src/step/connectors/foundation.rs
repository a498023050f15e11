//! Foundations along beams in a state: what their springs do.

use crate::element::fibre::FibreState;
use crate::math::vec2::scale;
use crate::model::frozen::{Coordinate, FoundationData, FoundationPlace};
use crate::model::{FoundationLaw, Model};

impl FoundationData {
    /// Its places in a state given by the connectors' coordinates and memories.
    pub fn places<'a>(
        &'a self,
        model: &'a Model,
        coordinates: &'a [f64],
        memories: &'a [FibreState],
    ) -> impl Iterator<Item = FoundationPlace> + 'a {
        self.connectors.clone().zip(&self.lengths).filter_map(move |(i, length)| {
            let (c, q) = (&model.connectors[i], coordinates[i]);
            let Coordinate::Displacement { point, direction, .. } = &c.coordinate else {
                return None;
            };
            let force = c.reached_force(q, memories) + 0.0;
            let memory = c.memory(memories).map(|(_, memory)| *memory).unwrap_or_default();
            let acts = match (&c.yielding, &self.law) {
                (_, FoundationLaw::Compression { .. }) => force > 0.0,
                _ => c.law.acts_at(q),
            };
            Some(FoundationPlace {
                s: point.s,
                length: *length,
                pressure: force / length,
                force: scale(-force, *direction),
                stored: c.potential(q, memories),
                acts,
                plastic: memory.plastic,
                flow: [memory.dissipated, c.hardening_energy(memories)],
            })
        })
    }
}
