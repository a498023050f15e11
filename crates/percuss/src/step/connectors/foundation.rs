//! Foundations along beams in a state: what their springs do.

use crate::element::fibre::FibreState;
use crate::math::vec2::{norm, scale};
use crate::model::frozen::{Connector, Coordinate, FoundationData, FoundationPlace};
use crate::model::{FoundationLaw, Model};
use crate::state::State;
use crate::step::convergence::ROUND_OFF;

impl FoundationData {
    /// Its places in a state, with the forces of its dampers.
    pub fn places<'a>(
        &'a self,
        model: &'a Model,
        state: &'a State,
    ) -> impl Iterator<Item = FoundationPlace> + 'a {
        let at_rest = self.places_at_rest(model, &state.coordinates, &state.memories);
        self.connectors.clone().zip(at_rest).map(|(i, place)| match &model.connectors[i] {
            damped if damped.damping > 0.0 => place.under(damped, damped.force_now(i, state)),
            _ => place,
        })
    }

    /// Its places, given by the connectors' coordinates and memories, without dampers.
    pub fn places_at_rest<'a>(
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
            // Where it lies without force it touches.
            let lifted = match &self.law {
                FoundationLaw::Compression { .. } => {
                    let digits = ROUND_OFF * (norm(point.position) + length);
                    force <= 0.0 && q < c.law.free() + memory.plastic - digits
                }
                FoundationLaw::Linear { .. } | FoundationLaw::Table { .. } => false,
            };
            Some(FoundationPlace {
                s: point.s,
                length: *length,
                pressure: force / length,
                force: scale(-force, *direction),
                stored: c.potential(q, memories),
                lifted,
                plastic: memory.plastic,
                flow: [memory.dissipated, c.hardening_energy(memories)],
            })
        })
    }
}

impl FoundationPlace {
    /// The same with another force of its spring.
    fn under(self, spring: &Connector, force: f64) -> Self {
        let Coordinate::Displacement { direction, .. } = &spring.coordinate else { return self };
        let force = force + 0.0;
        Self { pressure: force / self.length, force: scale(-force, *direction), ..self }
    }
}
