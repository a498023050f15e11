//! Record of a rigid contact: impacts and intervals of resting contact, as in a single run.

use super::engine::Engine;
use percuss::internals::run::contact_log::{opened, rate_of_rest};
use percuss::internals::scalar::{Number, array};
use percuss::{ContactInterval, ContactPlace, ContactRecord, EnergySplit, Impact, Peak};

/// Impulse, rates and work of the contact in a part of a step.
#[derive(Clone, Copy, Debug)]
pub struct ContactPart<T> {
    /// Size of the part \[s\].
    pub h: T,
    /// Impulse \[N s\].
    pub impulse: T,
    /// Rates of the gap at its start and its end \[m/s\].
    pub before: T,
    pub after: T,
    /// Work on beam and projectile, shape (2) \[J\].
    pub given: [T; 2],
    /// The struck point at the start, in the middle and at the end, shape (3, 2) \[m\].
    pub places: [[T; 2]; 3],
}

impl<S: Number> ContactPart<S> {
    /// The values of one lane.
    pub fn lane(&self, lane: usize) -> ContactPart<f64> {
        let of = |x: S| x.lane(lane);
        ContactPart {
            h: of(self.h),
            impulse: of(self.impulse),
            before: of(self.before),
            after: of(self.after),
            given: self.given.map(of),
            places: self.places.map(|place| place.map(of)),
        }
    }
}

impl<S: Number> Engine<S> {
    /// Impulse, rates and work of a rigid projectile's contact in the last accepted part, at whose start the gap had the given rate.
    pub fn part(&self, k: usize, before: S) -> ContactPart<S> {
        let (guide, state, h) = (&self.numbers.guides[k], &self.guides[k], self.h);
        let force = state.impulse / h;
        let [start, middle] = [h, h * 0.5].map(|back| self.struck_before(k, back));
        ContactPart {
            h,
            impulse: state.impulse,
            before,
            after: state.rate,
            given: [force * guide.along(&self.increment), -(force * state.increment)],
            places: [start, middle, self.struck(k)],
        }
    }
}

/// An impact.
#[derive(Clone, Copy, Debug)]
pub struct Struck<T> {
    pub time: T,
    pub impulse: T,
    pub approach: T,
    separation: T,
    /// Work on beam and projectile, shape (2) \[J\].
    given: [T; 2],
    /// Position of the impact, shape (2) \[m\].
    place: [T; 2],
}

/// An interval of resting contact.
#[derive(Clone, Copy, Debug)]
struct Rest<T> {
    start: T,
    approach: T,
    /// Start of the first part without contact force, and the rate of the gap there, shape (2) \[s, m/s\]; NaN while the contact presses.
    end: [f64; 2],
    impulse: T,
    /// Work on beam and projectile, shape (2) \[J\].
    given: [T; 2],
    /// Dissipated energy \[J\].
    lost: T,
    /// Number of parts of steps, longer than an impact interval, with a contact force.
    steps: usize,
    /// Position at the start of resting contact, shape (2) \[m\].
    place: [T; 2],
    /// Last position of the contact, shape (2) \[m\].
    place_end: [T; 2],
}

/// The record of one contact.
#[derive(Clone, Debug)]
pub struct RigidLog<T> {
    /// Stored impacts, shape (impacts).
    pub impacts: Vec<Struck<T>>,
    impact_count: usize,
    /// Total impulse, and its part in resting contact \[N s\].
    impulse_total: T,
    impulse_resting: T,
    /// Intervals of resting contact, shape (intervals).
    rests: Vec<Rest<T>>,
    /// Number of the current interval.
    open: Option<usize>,
    /// Penetration of the beam, due to the error of located instants.
    penetration: Peak,
    /// Largest violation of the conditions of impulses, relative to the largest rate.
    pub residual: f64,
}

impl<T: Number> RigidLog<T> {
    /// An empty record.
    pub fn new(zero: T) -> Self {
        Self {
            impacts: Vec::new(),
            impact_count: 0,
            impulse_total: zero,
            impulse_resting: zero,
            rests: Vec::new(),
            open: None,
            penetration: Peak { value: 0.0, time: f64::NAN },
            residual: 0.0,
        }
    }

    /// Records the gap at an instant.
    pub fn see(&mut self, gap: f64, time: f64) {
        if -gap > self.penetration.value {
            self.penetration = Peak { value: -gap, time };
        }
    }

    /// Records a part that begins at `start` with an impact or with resting contact (`rests`); it may be as short as an impact interval.
    pub fn take(&mut self, part: &ContactPart<T>, start: T, rests: bool, impulsive: bool) {
        self.impulse_total += part.impulse;
        if rests {
            self.impulse_resting += part.impulse;
            self.rest(part, start, impulsive);
        } else if part.impulse.lane(0) > 0.0 {
            self.impact_count += 1;
            if self.impacts.len() < ContactRecord::IMPACTS_KEPT {
                self.impacts.push(Struck {
                    time: start + part.h * 0.5,
                    impulse: part.impulse,
                    approach: -part.before,
                    separation: part.after,
                    given: part.given,
                    place: part.places[1],
                });
            }
        }
    }

    fn rest(&mut self, part: &ContactPart<T>, start: T, impulsive: bool) {
        let (presses, zero) = (part.impulse.lane(0) > 0.0, start.constant(0.0));
        if self.open.is_none() && presses && self.rests.len() < ContactRecord::IMPACTS_KEPT {
            self.open = Some(self.rests.len());
            self.rests.push(Rest {
                start,
                approach: (zero - part.before).max(zero),
                end: [f64::NAN; 2],
                impulse: zero,
                given: [zero; 2],
                lost: zero,
                steps: 0,
                place: part.places[0],
                place_end: part.places[0],
            });
        }
        let Some(open) = self.open else { return };
        let rest = &mut self.rests[open];
        rest.impulse += part.impulse;
        rest.given = array(|p| rest.given[p] + part.given[p]);
        rest.lost += -part.given[0] - part.given[1];
        if presses {
            rest.steps += usize::from(!impulsive);
            rest.place_end = part.places[2];
        } else {
            let rate = rate_of_rest(part.before.lane(0), part.after.lane(0));
            (rest.end, self.open) = ([start.lane(0), rate], None);
        }
    }

    /// The record of a contact at the given arc length, with its numbers or their derivatives. The end of resting contact is not resolved within
    /// steps, and penetration is an error of located instants: neither has derivatives.
    pub fn record(&self, s: f64, read: &dyn Fn(T) -> f64, derivative: bool) -> ContactRecord {
        let at = |place: [T; 2]| ContactPlace { s, position: place.map(read) };
        let impact = |struck: &Struck<T>| Impact {
            time: read(struck.time),
            impulse: read(struck.impulse),
            tangential_impulse: 0.0,
            points: 1,
            approach_velocity: read(struck.approach),
            separation_velocity: read(struck.separation),
            place: at(struck.place),
            energy: split(struck.given.map(read), read(-struck.given[0] - struck.given[1])),
            fallback_law: false,
        };
        let interval = |rest: &Rest<T>| {
            let [end, rate] = if derivative { [f64::NAN; 2] } else { rest.end };
            let mut interval = ContactInterval {
                end,
                impulse: read(rest.impulse),
                tangential_impulse: 0.0,
                separation_velocity: rate,
                steps: rest.steps,
                place_end: at(rest.place_end),
                energy: split(rest.given.map(read), read(rest.lost)),
                ..opened(read(rest.start), read(rest.approach), at(rest.place))
            };
            interval.energy.balance();
            interval
        };
        ContactRecord::Nonsmooth {
            impacts: self.impacts.iter().map(impact).collect(),
            impact_count: self.impact_count,
            fallback_count: 0,
            impulse_total: read(self.impulse_total),
            impulse_resting: read(self.impulse_resting),
            intervals: self.rests.iter().map(interval).collect(),
            penetration: if derivative { Peak::default() } else { self.penetration },
        }
    }
}

fn split(given: [f64; 2], lost: f64) -> EnergySplit {
    EnergySplit { given, lost, ..EnergySplit::default() }
}
