//! How well steps resolve the largest force of contacts under a smooth law, and of stops and springs that can be open or slack.
//!
//! A half wave of N steps has at its top the second difference `4 sin^2(pi / 2N)`, as a share of its height. The force over the steps about the
//! largest one is compared with it. A force may begin or end suddenly (a plateau, a failure): it is resolved if it is straight on one side.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::model::Model;
use crate::model::frozen::Connector;
use crate::run::solving::trial::Accepted;
use crate::state::State;
use crate::summary::{Peak, PulseOf, PulseSummary};

/// Steps on either side of the largest force.
const BESIDE: usize = 3;
/// All of them.
const STEPS: usize = 2 * BESIDE + 1;

/// A force at the end of a step.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Sample {
    time: f64,
    force: f64,
}

/// A force over the last steps, and its bend about the largest value.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Sharpness {
    /// The last steps, the latest last, shape (steps).
    last: [Sample; STEPS],
    /// Steps since the largest force.
    since: usize,
    peak: Peak,
    /// Steps of the half wave there, and their size, shape (2) \[-, s\].
    half_wave: [f64; 2],
}

/// A closed interval: impulse \[N s\] and closing velocity \[m/s\].
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct ClosedSpell {
    impulse: f64,
    speed: f64,
}

/// Record of a connector that can be open or slack.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct ConnectorPulse {
    sharpness: Sharpness,
    /// Its coordinate and its force at the end of the last step, shape (2) \[m, N\].
    at: [f64; 2],
    /// Rate of its coordinate in the last step without force \[m/s\]; NaN before the first.
    open: f64,
    /// The current closed interval, and whether the largest force is in it.
    now: ClosedSpell,
    has_peak: bool,
    /// The closed interval of the largest force, and the deformation then \[m\].
    hardest: ClosedSpell,
    deformed: f64,
}

/// The record of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Pulses {
    /// One entry a contact, shape (contacts).
    contacts: Vec<Sharpness>,
    /// Mean forces over the current part, shape (contacts) \[N\].
    #[serde(skip)]
    forces: Vec<f64>,
    /// One entry a connector that can be open or slack, shape (such connectors).
    connectors: Vec<ConnectorPulse>,
}

/// Connectors that can be open or slack, with their numbers; those of foundations, which are one force, are left out.
fn followed(model: &Model) -> impl Iterator<Item = (usize, &Connector)> {
    let open = |c: &Connector| c.law.may_give_way() && c.foundation.is_none();
    model.connectors.iter().enumerate().filter(move |(_, c)| open(c))
}

impl Pulses {
    /// At the start.
    pub fn new(model: &Model, state: &State) -> Self {
        let unset = Sharpness::new();
        let connector = |(i, c): (usize, &Connector)| {
            let q = state.coordinates[i];
            let force = c.force_now(i, state).abs();
            let none = ClosedSpell { impulse: 0.0, speed: f64::NAN };
            let mut sharpness = unset;
            sharpness.take(Sample { time: state.time, force });
            let deformed = (q - c.law.free()).abs();
            let (now, hardest, has_peak) = (none, none, force > 0.0);
            let (at, open) = ([q, force], f64::NAN);
            ConnectorPulse { sharpness, at, open, now, has_peak, hardest, deformed }
        };
        Self {
            contacts: vec![unset; model.contacts.len()],
            forces: Vec::new(),
            connectors: followed(model).map(connector).collect(),
        }
    }

    /// Whether it has the shape of another one.
    pub fn fits(&self, other: &Self) -> bool {
        let shape = |one: &Self| (one.contacts.len(), one.connectors.len());
        let steps = |one: &Self| one.contacts.iter().all(|contact| contact.since <= STEPS);
        shape(self) == shape(other) && steps(self)
    }

    /// Enters a part of a step; in one as short as an impact no force is known.
    pub fn take(&mut self, part: &Accepted<'_>) {
        if part.solved.impulsive {
            return;
        }
        let (model, state, h) = (part.model, part.after, part.solved.trial.h);
        self.forces.clear();
        self.forces.resize(self.contacts.len(), 0.0);
        for contact in &part.work().smooth {
            self.forces[model.pairs[contact.pair].contact] += contact.force.force;
        }
        for (sharpness, force) in self.contacts.iter_mut().zip(&self.forces) {
            sharpness.take(Sample { time: state.time, force: *force });
        }
        for ((i, c), own) in followed(model).zip(&mut self.connectors) {
            let q = state.coordinates[i];
            let acts = state.time <= c.until;
            let force = if acts { c.force_now(i, state).abs() } else { 0.0 };
            own.take([q, force], h, state.time, (q - c.law.free()).abs());
        }
    }

    /// Results of a run.
    pub fn summaries(&self, model: &Model) -> Vec<PulseSummary> {
        let smooth = model.contacts.iter().enumerate().zip(&self.contacts);
        let smooth = smooth.filter(|((_, contact), _)| contact.law.smooth().is_some());
        let contact = |((k, _), own): ((usize, _), &Sharpness)| PulseSummary {
            of: PulseOf::Contact(k),
            force: own.peak,
            energy: f64::NAN,
            steps: own.half_wave[0],
            step: own.half_wave[1],
            lasts: f64::NAN,
        };
        let connector = |((_, c), own): ((usize, &Connector), &ConnectorPulse)| PulseSummary {
            of: match c.support {
                Some(_) => PulseOf::Stop(c.name.clone()),
                None => PulseOf::Spring(c.name.clone()),
            },
            force: own.sharpness.peak,
            energy: 0.5 * own.sharpness.peak.value * own.deformed,
            steps: own.sharpness.half_wave[0],
            step: own.sharpness.half_wave[1],
            lasts: own.lasts(),
        };
        let connectors = followed(model).zip(&self.connectors).map(connector);
        smooth.map(contact).chain(connectors).collect()
    }
}

impl ConnectorPulse {
    fn take(&mut self, now: [f64; 2], h: f64, time: f64, deformed: f64) {
        let [q, force] = now;
        let before = std::mem::replace(&mut self.at, now);
        let closed = force > 0.0 || before[1] > 0.0;
        if closed {
            if before[1] == 0.0 {
                self.now = ClosedSpell { impulse: 0.0, speed: self.open };
            }
            self.now.impulse += 0.5 * h * (force + before[1]);
        } else {
            self.open = ((q - before[0]) / h).abs();
        }
        if self.sharpness.take(Sample { time, force }) {
            (self.has_peak, self.deformed) = (true, deformed);
        }
        self.has_peak &= closed;
        if self.has_peak {
            self.hardest = self.now;
        }
    }

    fn lasts(&self) -> f64 {
        let ClosedSpell { impulse, speed } = self.hardest;
        let mass = impulse / (2.0 * speed);
        PI * (mass * self.deformed / self.sharpness.peak.value).sqrt()
    }
}

impl Sharpness {
    fn new() -> Self {
        let none = Sample { time: f64::NAN, force: f64::NAN };
        Self { last: [none; STEPS], since: STEPS, peak: Peak::default(), half_wave: [f64::NAN; 2] }
    }

    /// Enters the force at the end of a step; whether it is the largest so far.
    fn take(&mut self, now: Sample) -> bool {
        if now.force == 0.0 && self.since >= STEPS && self.last.iter().all(|s| s.force == 0.0) {
            self.last[STEPS - 2].time = self.last[STEPS - 1].time;
            self.last[STEPS - 1].time = now.time;
            return false;
        }
        self.last.rotate_left(1);
        self.last[STEPS - 1] = now;
        let largest = now.force > 0.0 && (self.peak.value.is_nan() || now.force > self.peak.value);
        if largest {
            self.peak = Peak { value: now.force, time: now.time };
            (self.since, self.half_wave) = (0, [f64::NAN; 2]);
        } else if self.since < BESIDE {
            self.since += 1;
            if self.since == BESIDE {
                let size = 0.5 * (self.last[BESIDE + 1].time - self.last[BESIDE - 1].time);
                self.half_wave = [self.steps(), size];
            }
        } else {
            self.since = STEPS;
        }
        largest
    }

    /// Steps of the half wave about the step in the middle.
    fn steps(&self) -> f64 {
        let top = self.last[BESIDE].force;
        let at = |k: usize| {
            let [a, b, c] = [self.last[k - 1], self.last[k], self.last[k + 1]];
            let sizes = [b.time - a.time, c.time - b.time];
            let slopes = [(b.force - a.force) / sizes[0], (c.force - b.force) / sizes[1]];
            let bend = 0.5 * (slopes[1] - slopes[0]).abs() * (sizes[0] + sizes[1]) / top;
            PI / (2.0 * (0.5 * bend.sqrt()).min(1.0).asin())
        };
        let straighter =
            |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { a.min(b) };
        let before = straighter(at(BESIDE - 2), at(BESIDE - 1));
        let after = straighter(at(BESIDE + 1), at(BESIDE + 2));
        // The larger one that is known.
        at(BESIDE).max(before).max(after)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(forces: &[f64]) -> f64 {
        let mut own = Sharpness::new();
        for (k, force) in forces.iter().enumerate() {
            own.take(Sample { time: 1e-3 * k as f64, force: *force });
        }
        own.half_wave[0]
    }

    /// A half wave of so many steps that begins at a share of a step.
    fn wave(length: f64, early: f64) -> Vec<f64> {
        let at = |k: usize| (k as f64 - 5.0 + early) / length;
        let force = |k| if (0.0..1.0).contains(&at(k)) { (PI * at(k)).sin() } else { 0.0 };
        (0..(length as usize + 12)).map(force).collect()
    }

    #[test]
    fn a_half_wave_has_its_number_of_steps() {
        for length in [8.0, 12.5, 20.0, 100.0] {
            for early in [0.0, 0.3, 0.5, 0.9] {
                let found = steps(&wave(length, early));
                // The steps beside the largest force bend less, as shares of it.
                assert!((0.999..1.1).contains(&(found / length)), "{length} {early}: {found}");
            }
        }
        for early in [0.1, 0.3, 0.5, 0.9] {
            let found = steps(&wave(1.5, early));
            // Far fewer than are enough, 12.
            assert!((1.9..5.0).contains(&found), "{early}: {found}");
        }
    }

    #[test]
    fn plateaus_and_sudden_ends_are_resolved_and_spikes_are_not() {
        let plateau = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
        assert!(steps(&plateau) > 1e6, "{}", steps(&plateau));
        let breaks = [0.0, 0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.0, 0.0, 0.0, 0.0];
        assert!(steps(&breaks) > 1e3, "{}", steps(&breaks));
        for spike in [
            vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
            vec![0.0, 0.0, 0.5, 1.0, 0.5, 0.0, 0.0, 0.0],
            vec![0.0, 1.0, 0.0, 1.1, 0.0, 1.0, 0.0, 1.0],
        ] {
            assert!(steps(&spike) < 5.0, "{spike:?}: {}", steps(&spike));
        }
    }
}
