//! Where the runs of an ensemble stand, kept while those go on whose part of a step is accepted.

use super::engine::Engine;
use super::fibres::FibreStates;
use super::ledger::LaneLedger;
use percuss::internals::element::energy_momentum::End;
use percuss::internals::scalar::{Number, array};
use percuss::math::hermite::GAUSS;

/// A state and its ledger.
#[derive(Clone, Debug)]
pub struct Stand<S: Number> {
    /// Displacements of the nodes, shape (beam nodes, 4) \[m, -\].
    displacement: Vec<[S; 4]>,
    /// Their velocities, shape (beam nodes, 4) \[m/s, 1/s\].
    velocity: Vec<[S; 4]>,
    /// Gauss points, shape (elements, Gauss points).
    start: Vec<[End<S>; GAUSS]>,
    /// Angular rates of their tangents, shape (elements, Gauss points) \[rad/s\].
    spin: Vec<[S; GAUSS]>,
    /// Ways, velocities, gaps and their rates of the projectiles, shape (guided projectiles, 4) \[m, m/s, m, m/s\].
    guides: Vec<[S; 4]>,
    /// Multipliers that the next steps start from, shape (constraints) \[N, N m\].
    multipliers: Vec<S>,
    fibres: FibreStates<S>,
    ledger: LaneLedger<S>,
}

impl<S: Number> Stand<S> {
    /// Of an ensemble.
    pub fn of(engine: &mut Engine<S>, ledger: &LaneLedger<S>) -> Self {
        let multipliers = engine.constraints.accepted().map(|x| *x).collect();
        let guides = engine.guides.iter().map(|g| [g.way, g.velocity, g.gap, g.rate]);
        Self {
            displacement: engine.displacement.clone(),
            velocity: engine.velocity.clone(),
            start: engine.start.clone(),
            spin: engine.spin.clone(),
            guides: guides.collect(),
            multipliers,
            fibres: engine.fibres.clone(),
            ledger: *ledger,
        }
    }

    /// Keeps it.
    #[inline(always)]
    pub fn keep(&mut self, engine: &mut Engine<S>, ledger: &LaneLedger<S>) {
        self.displacement.copy_from_slice(&engine.displacement);
        self.velocity.copy_from_slice(&engine.velocity);
        self.start.copy_from_slice(&engine.start);
        self.spin.copy_from_slice(&engine.spin);
        for (mine, g) in self.guides.iter_mut().zip(&engine.guides) {
            *mine = [g.way, g.velocity, g.gap, g.rate];
        }
        for (mine, now) in self.multipliers.iter_mut().zip(engine.constraints.accepted()) {
            *mine = *now;
        }
        self.fibres.copy_from(&engine.fibres);
        self.ledger = *ledger;
    }

    /// Puts all lanes but those that `go` back to where they stood.
    #[inline(always)]
    pub fn put_back(&self, engine: &mut Engine<S>, ledger: &mut LaneLedger<S>, go: S::Mask) {
        for (now, kept) in
            [(&mut engine.displacement, &self.displacement), (&mut engine.velocity, &self.velocity)]
        {
            for (now, kept) in now.iter_mut().zip(kept) {
                *now = array(|i| S::choose(go, now[i], kept[i]));
            }
        }
        for (now, kept) in engine.spin.iter_mut().zip(&self.spin) {
            *now = array(|i| S::choose(go, now[i], kept[i]));
        }
        for (now, kept) in engine.start.iter_mut().zip(&self.start) {
            for (now, kept) in now.iter_mut().zip(kept) {
                *now = End {
                    slope: array(|i| S::choose(go, now.slope[i], kept.slope[i])),
                    bend: array(|i| S::choose(go, now.bend[i], kept.bend[i])),
                    stretch: S::choose(go, now.stretch, kept.stretch),
                    inverse: S::choose(go, now.inverse, kept.inverse),
                    membrane: S::choose(go, now.membrane, kept.membrane),
                };
            }
        }
        for (g, [way, velocity, gap, rate]) in engine.guides.iter_mut().zip(&self.guides) {
            g.way = S::choose(go, g.way, *way);
            g.velocity = S::choose(go, g.velocity, *velocity);
            g.gap = S::choose(go, g.gap, *gap);
            g.rate = S::choose(go, g.rate, *rate);
        }
        for (now, kept) in engine.constraints.accepted().zip(&self.multipliers) {
            *now = S::choose(go, *now, *kept);
        }
        engine.fibres.put_back(&self.fibres, go);
        for (now, kept) in ledger.numbers().zip({ self.ledger }.numbers()) {
            *now = S::choose(go, *now, *kept);
        }
    }
}
