//! How well steps resolve the largest force of contacts under a smooth law, and of stops, springs and foundations that can be open or slack.
//!
//! A half wave of N steps has at its top the second difference `4 sin^2(pi / 2N)`, as a share of its height. The force over the steps about the
//! largest one is compared with it. A force may begin or end suddenly (a plateau, a failure): it is resolved if it is straight on one side.
//!
//! Where a damper begins to act with the approach velocity v, its force jumps to `c v` and then falls within `J / (c v)`, J the impulse of the closed
//! interval; steps longer than a small share of that do not show it.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::model::Model;
use crate::model::frozen::{Connector, FoundationData};
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

/// A closed interval: impulse \[N s\], closing velocity \[m/s\], its start \[s\], NaN if that was before the run, its largest force and the force of the
/// damper at its start \[N\].
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct ClosedSpell {
    impulse: f64,
    speed: f64,
    start: f64,
    peak: Peak,
    jump: f64,
}

/// Record of a connector that can be open or slack.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct ConnectorPulse {
    sharpness: Sharpness,
    /// Its coordinate and its force at the end of the last step, shape (2) \[m, N\].
    at: [f64; 2],
    /// Rate of its coordinate in the last step without force \[m/s\]; NaN before the first.
    open: f64,
    /// Whether its gap is open, or it is slack.
    is_apart: bool,
    /// The closed interval with the largest force of the damper at its start.
    onset: ClosedSpell,
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
    /// One entry a connector that can be open or slack, those of foundations among them, shape (such connectors).
    connectors: Vec<ConnectorPulse>,
}

/// Connectors that can be open or slack, with their numbers.
fn followed(model: &Model) -> impl Iterator<Item = (usize, &Connector)> {
    model.connectors.iter().enumerate().filter(|(_, c)| c.law.may_give_way())
}

/// A connector at the end of a part of a step.
struct EndOfPart {
    /// Its coordinate and its force, shape (2) \[m, N\].
    at: [f64; 2],
    /// Distance of the coordinate from that without force \[m\].
    deformed: f64,
    /// Whether its gap is open, or it is slack.
    is_apart: bool,
    /// Damping \[N s/m\] of a law of one side, whose damper acts from the closing on; zero of others.
    damping: f64,
}

impl EndOfPart {
    fn of(c: &Connector, i: usize, state: &State) -> Self {
        let q = state.coordinates[i];
        let force = if state.time <= c.until { c.force_now(i, state).abs() } else { 0.0 };
        let damping = if c.law.side().is_some() { c.damping } else { 0.0 };
        let deformed = (q - c.law.free()).abs();
        Self { at: [q, force], deformed, is_apart: c.is_apart(i, state), damping }
    }
}

impl Pulses {
    /// At the start.
    pub fn new(model: &Model, state: &State) -> Self {
        let unset = Sharpness::new();
        let connector = |(i, c): (usize, &Connector)| {
            let EndOfPart { at, deformed, is_apart, .. } = EndOfPart::of(c, i, state);
            let force = at[1];
            let mut sharpness = unset;
            sharpness.take(Sample { time: state.time, force });
            let (none, has_peak) = (ClosedSpell::NONE, force > 0.0);
            let (now, hardest, onset, open) = (none, none, none, f64::NAN);
            ConnectorPulse {
                sharpness,
                at,
                open,
                is_apart,
                onset,
                now,
                has_peak,
                hardest,
                deformed,
            }
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
            own.take(&EndOfPart::of(c, i, state), h, state.time);
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
            onset: Peak::default(),
            falls: f64::NAN,
            rises_since: f64::NAN,
        };
        let alone =
            followed(model).zip(&self.connectors).filter(|((_, c), _)| c.foundation.is_none());
        let alone = alone.map(|((_, c), own)| {
            let of = match c.support {
                Some(_) => PulseOf::Stop(c.name.clone()),
                None => PulseOf::Spring(c.name.clone()),
            };
            own.summary(of, c, 1.0)
        });
        let foundations = model.foundations.iter().filter_map(|one| self.foundation(model, one));
        smooth.map(contact).chain(alone).chain(foundations).collect()
    }

    /// Result of a foundation: of its place with the largest reaction per length, with the jump and the rise of those where they are largest.
    fn foundation(&self, model: &Model, foundation: &FoundationData) -> Option<PulseSummary> {
        let own = followed(model).zip(&self.connectors);
        let own = own.filter(|((i, _), _)| foundation.connectors.contains(i));
        let places: Vec<PulseSummary> = own
            .map(|((i, c), own)| {
                let of = PulseOf::Foundation(foundation.name.clone());
                own.summary(of, c, foundation.lengths[i - foundation.connectors.start])
            })
            .collect();
        let most = |value: fn(&PulseSummary) -> f64| {
            let known = places.iter().filter(|one| !value(one).is_nan());
            known.reduce(|a, b| if value(b) > value(a) { b } else { a })
        };
        let hardest = most(|one| one.force.value).or(places.first())?;
        let jumps = most(|one| one.onset.value).unwrap_or(hardest);
        // At the edge of a contact small forces rise while the others fall.
        let rises = most(|one| if one.rises_since.is_nan() { f64::NAN } else { one.force.value });
        let rises = rises.filter(|one| one.force.value > 0.5 * hardest.force.value);
        let rises_since = rises.map_or(f64::NAN, |one| one.rises_since);
        let (onset, falls) = (jumps.onset, jumps.falls);
        Some(PulseSummary { onset, falls, rises_since, ..hardest.clone() })
    }
}

impl ClosedSpell {
    const NONE: Self = Self {
        impulse: 0.0,
        speed: f64::NAN,
        start: f64::NAN,
        peak: Peak { value: f64::NAN, time: f64::NAN },
        jump: f64::NAN,
    };
}

impl ConnectorPulse {
    fn take(&mut self, reached: &EndOfPart, h: f64, time: f64) {
        let [q, force] = reached.at;
        let before = std::mem::replace(&mut self.at, reached.at);
        let closed = force > 0.0 || before[1] > 0.0;
        if closed {
            if before[1] == 0.0 {
                self.close(reached.damping, time - h);
            }
            self.now.impulse += 0.5 * h * (force + before[1]);
            if force > self.now.peak.value || self.now.peak.value.is_nan() {
                self.now.peak = Peak { value: force, time };
            }
            if self.onset.start == self.now.start {
                self.onset = self.now;
            }
        } else {
            self.open = ((q - before[0]) / h).abs();
        }
        self.is_apart = reached.is_apart;
        if self.sharpness.take(Sample { time, force }) {
            (self.has_peak, self.deformed) = (true, reached.deformed);
        }
        self.has_peak &= closed;
        if self.has_peak {
            self.hardest = self.now;
        }
    }

    /// Begins a closed interval. A damper that stops pulling while its spring is still deformed opens it for a while, and does not jump after that.
    fn close(&mut self, damping: f64, start: f64) {
        let jump = if damping > 0.0 && self.is_apart { damping * self.open } else { f64::NAN };
        self.now = ClosedSpell { speed: self.open, start, jump, ..ClosedSpell::NONE };
        if jump > self.onset.jump || (self.onset.jump.is_nan() && !jump.is_nan()) {
            self.onset = self.now;
        }
    }

    /// Result, the forces divided by the length of a place of a foundation, one of others.
    fn summary(&self, of: PulseOf, c: &Connector, length: f64) -> PulseSummary {
        let per_length = |peak: Peak| Peak { value: peak.value / length, time: peak.time };
        let ClosedSpell { impulse, jump, start, .. } = self.onset;
        PulseSummary {
            of,
            force: per_length(self.sharpness.peak),
            energy: 0.5 * self.sharpness.peak.value * self.deformed,
            steps: self.sharpness.half_wave[0],
            step: self.sharpness.half_wave[1],
            lasts: self.lasts(),
            onset: per_length(Peak {
                value: jump,
                time: if jump.is_nan() { f64::NAN } else { start },
            }),
            falls: impulse / jump,
            rises_since: self.rises_since(c),
        }
    }

    /// Start of the current closed interval, if its force is the largest of it now \[s\]. What has no range without force always bears.
    fn rises_since(&self, c: &Connector) -> f64 {
        let rises = c.law.has_gap() && self.at[1] > 0.0 && self.now.peak.value == self.at[1];
        if rises { self.now.start } else { f64::NAN }
    }

    fn lasts(&self) -> f64 {
        let ClosedSpell { impulse, speed, .. } = self.hardest;
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
