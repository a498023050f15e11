//! Effective mass of the beams of a contact, where and when it first strikes.

use super::contact_log;
use super::simulation::Simulation;
use super::trial::Trial;
use crate::geometry::touch::Reach;
use crate::step::contacts::Phase;
use crate::step::effective_mass::{EffectiveMass, mass_matrix};

impl Simulation<'_> {
    /// Looks at the contacts that struck for the first time in the step accepted last; guided projectiles are known without a run.
    pub(super) fn weigh_struck(&mut self, trial: &Trial) {
        let mut mass = None;
        let (model, beams) = (self.model, self.model.beams.len());
        for (k, contact) in trial.active.iter().enumerate() {
            let pair = &model.pairs[contact.pair];
            let impulse = self.work.rigid[k].impulse[0];
            let strikes = matches!(contact.phase, Phase::Impact { .. }) && impulse > 0.0;
            let known = self.struck_masses[pair.contact].is_some();
            let guided = pair.contact < model.projectiles.len();
            if !strikes || known || guided || pair.movers.iter().all(|m| *m >= beams) {
                continue;
            }
            let Some(touch) = contact_log::touch(model, &self.state, contact.pair, Reach::Near)
            else {
                continue;
            };
            let u = &self.state.displacement;
            let matrix = mass.get_or_insert_with(|| mass_matrix(model, u));
            self.struck_masses[pair.contact] = match matrix {
                Ok(matrix) => EffectiveMass::of_pair(model, matrix, u, pair, &touch),
                Err(_) => None,
            };
        }
    }
}
