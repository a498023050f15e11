//! What happens at the rigid contact of a run in a lane: impacts and intervals of rest, as a single run notes them.

use percuss::internals::run::contact_log::{opened, rate_of_rest};
use percuss::{ContactInterval, ContactPlace, ContactRecord, EnergySplit, Impact, Peak};

/// What the contact did in a part of a step.
#[derive(Clone, Copy, Debug)]
pub struct LaneDeed {
    /// Whether it was to stay closed; else it strikes.
    pub rests: bool,
    /// Whether the part is as short as an impact.
    pub impulsive: bool,
    /// Start and size of the part \[s\].
    pub start: f64,
    pub h: f64,
    /// Impulse \[N s\].
    pub impulse: f64,
    /// Rates of the gap \[m/s\].
    pub before: f64,
    pub after: f64,
    /// Work on beam and projectile, shape (2) \[J\].
    pub given: [f64; 2],
    /// The struck point at the start, in the middle and at the end, shape (3, 2) \[m\].
    pub places: [[f64; 2]; 3],
}

/// The record of one run.
#[derive(Clone, Debug, Default)]
pub struct RigidLog {
    /// Impacts that are kept, shape (impacts).
    impacts: Vec<Impact>,
    impact_count: usize,
    /// Impulse of all \[N s\].
    impulse_total: f64,
    /// Of it, that of rest \[N s\].
    impulse_resting: f64,
    /// Intervals of rest, shape (intervals).
    intervals: Vec<ContactInterval>,
    /// Number of the interval that is open.
    open: Option<usize>,
    /// Depth inside the beam, by errors of the instant.
    penetration: Peak,
    /// Largest violation of the conditions of impulses, relative to the largest rate.
    pub residual: f64,
}

impl RigidLog {
    /// Nothing has happened yet.
    pub fn new() -> Self {
        Self { penetration: Peak { value: 0.0, time: f64::NAN }, ..Self::default() }
    }

    /// Takes in the gap at an instant.
    pub fn see(&mut self, gap: f64, time: f64) {
        if -gap > self.penetration.value {
            self.penetration = Peak { value: -gap, time };
        }
    }

    /// Takes in a part in which it may have pressed.
    pub fn take(&mut self, deed: &LaneDeed) {
        self.impulse_total += deed.impulse;
        let work = deed.given;
        let energy = EnergySplit { given: work, lost: -work[0] - work[1], ..Default::default() };
        if deed.rests {
            self.impulse_resting += deed.impulse;
            self.rest(deed, &energy);
        } else if deed.impulse > 0.0 {
            self.impact_count += 1;
            if self.impacts.len() < ContactRecord::IMPACTS_KEPT {
                self.impacts.push(Impact {
                    time: deed.start + 0.5 * deed.h,
                    impulse: deed.impulse,
                    tangential_impulse: 0.0,
                    points: 1,
                    approach_velocity: -deed.before,
                    separation_velocity: deed.after,
                    place: at(deed.places[1]),
                    energy,
                    fallback_law: false,
                });
            }
        }
    }

    fn rest(&mut self, deed: &LaneDeed, energy: &EnergySplit) {
        if self.open.is_none()
            && deed.impulse > 0.0
            && self.intervals.len() < ContactRecord::IMPACTS_KEPT
        {
            self.open = Some(self.intervals.len());
            let approach = (-deed.before).max(0.0);
            let opened = opened(deed.start, approach, at(deed.places[0]));
            self.intervals.push(ContactInterval { tangential_impulse: 0.0, ..opened });
        }
        let Some(open) = self.open else { return };
        let interval = &mut self.intervals[open];
        interval.impulse += deed.impulse;
        (0..2).for_each(|p| interval.energy.given[p] += energy.given[p]);
        interval.energy.lost += energy.lost;
        if deed.impulse > 0.0 {
            interval.steps += usize::from(!deed.impulsive);
            interval.place_end = at(deed.places[2]);
        } else {
            self.end(deed.start, rate_of_rest(deed.before, deed.after));
        }
    }

    /// It presses no more since an instant at which the gap had the given rate.
    pub fn end(&mut self, time: f64, rate: f64) {
        if let Some(open) = self.open.take() {
            (self.intervals[open].end, self.intervals[open].separation_velocity) = (time, rate);
        }
    }

    /// The record of a contact at the given arc length.
    pub fn record(&self, s: f64) -> ContactRecord {
        let (mut impacts, mut intervals) = (self.impacts.clone(), self.intervals.clone());
        impacts.iter_mut().for_each(|impact| impact.place.s = s);
        for interval in &mut intervals {
            (interval.place.s, interval.place_end.s) = (s, s);
            interval.energy.balance();
        }
        ContactRecord::Nonsmooth {
            impacts,
            impact_count: self.impact_count,
            fallback_count: 0,
            impulse_total: self.impulse_total,
            impulse_resting: self.impulse_resting,
            intervals,
            penetration: self.penetration,
        }
    }
}

fn at(position: [f64; 2]) -> ContactPlace {
    ContactPlace { position, ..ContactPlace::default() }
}
