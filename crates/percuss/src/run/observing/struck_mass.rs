//! Effective mass of the beams of a contact, where and when it first strikes.

use super::contact_log;
use crate::geometry::touch::SearchRegion;
use crate::run::solving::trial::Accepted;
use crate::step::contacts::Phase;
use crate::step::effective_mass::{EffectiveMass, mass_matrix};

/// Evaluates the contacts with a first impact in a part of a step; for guided projectiles a run is not needed.
pub fn weigh(known: &mut [Option<EffectiveMass>], part: &Accepted<'_>) {
    let mut mass = None;
    let (model, state) = (part.model, part.after);
    for (contact, found) in part.solved.trial.active.iter().zip(&part.work().rigid) {
        let pair = &model.pairs[contact.pair];
        let strikes = matches!(contact.phase, Phase::Impact { .. }) && found.impulse[0] > 0.0;
        let guided = pair.contact < model.projectiles.len();
        let beams = pair.movers.iter().any(|m| *m < model.beams.len());
        if !strikes || known[pair.contact].is_some() || guided || !beams {
            continue;
        }
        let Some(touch) = contact_log::touch(model, state, contact.pair, SearchRegion::Near) else {
            continue;
        };
        let u = &state.displacement;
        let matrix = mass.get_or_insert_with(|| mass_matrix(model, u));
        known[pair.contact] = match matrix {
            Ok(matrix) => EffectiveMass::of_pair(model, matrix, u, pair, &touch),
            Err(_) => None,
        };
    }
}
