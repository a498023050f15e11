//! The largest value of a quantity in a run, within steps if the steps resolve it.
//!
//! The cubic through values and rates at the ends of a step may have a maximum between them. It is a maximum of the run only if its acceleration
//! continues in an adjacent step: an oscillation that the step does not resolve, or a sudden motion, has a different acceleration in every step,
//! and then only values at the ends of steps are known.

use serde::{Deserialize, Serialize};

use crate::math::interpolant::Interpolant;
use crate::scalar::{Mask, Number};
use crate::settings::SAME_INSTANT;
use crate::summary::{SAME_SIZE, is_of_start};

/// Accelerations of neighbouring steps that differ by more than this share of the larger one are not those of a resolved motion:
/// about a sixth of a period per step.
const AGREES: f64 = 0.5;

/// Follows the value of largest magnitude of each lane.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Crest<S> {
    /// The value and its time \[s\].
    pub value: S,
    pub time: S,
    /// Acceleration in the step before.
    bend: S,
    /// A maximum within the previous step that the next step may confirm, and its time, shape (2) \[unit of the value, s\]; NaN if there is none.
    awaiting: [S; 2],
    /// The largest crest within a step that no neighbour confirmed.
    doubtful: S,
}

fn agree(a: f64, b: f64) -> bool {
    (a - b).abs() <= AGREES * a.abs().max(b.abs())
}

impl<S: Number> Crest<S> {
    /// At the start of a run.
    pub fn new(value: S, time: S) -> Self {
        let nan = value.constant(f64::NAN);
        Self { value, time, bend: nan, awaiting: [nan; 2], doubtful: value.constant(0.0) }
    }

    /// Begins a new run in a lane.
    pub fn reset(&mut self, lane: usize, value: S) {
        let fresh = Self::new(value, value.constant(0.0));
        self.value.set_lane(lane, fresh.value, 0);
        self.time.set_lane(lane, fresh.time, 0);
        self.bend.set_lane(lane, fresh.bend, 0);
        (0..2).for_each(|i| self.awaiting[i].set_lane(lane, fresh.awaiting[i], 0));
        self.doubtful.set_lane(lane, fresh.doubtful, 0);
    }

    /// Restores all lanes except those of the mask `go`.
    #[inline(always)]
    pub fn restore(&mut self, kept: &Self, go: S::Mask) {
        let choose = |now: &mut S, kept: S| *now = S::choose(go, *now, kept);
        choose(&mut self.value, kept.value);
        choose(&mut self.time, kept.time);
        choose(&mut self.bend, kept.bend);
        (0..2).for_each(|i| choose(&mut self.awaiting[i], kept.awaiting[i]));
        choose(&mut self.doubtful, kept.doubtful);
    }

    /// Whether steps resolve the value in a lane: no larger crest within a step was left out.
    pub fn is_resolved(&self, lane: usize) -> bool {
        self.doubtful.lane(lane) <= self.value.lane(lane).abs()
    }

    /// Enters a step that starts at `from`; rates of `impulsive` ones, as short as an impact interval, jump.
    #[inline(always)]
    pub fn take(&mut self, path: &Interpolant<S>, from: S, impulsive: S::Mask) {
        let ([u0, v0], [u1, v1]) = (path.start, path.end);
        let bend = (v1 - v0) / path.h;
        let waits = self.awaiting[0].finite();
        if waits.any() {
            self.confirm(bend, impulsive);
        }
        self.time = Interpolant::at_event(from, impulsive, self.time);
        let known = self.value.abs();
        self.value = known.if_less(u1.abs(), u1, self.value);
        // Round-off beside the value at the start does not change its instant.
        let later = known.constant(0.0).less(self.time);
        let bar = S::choose(later, known, known * (1.0 + SAME_SIZE));
        self.time = bar.if_less(u1.abs(), path.at_end(from, impulsive), self.time);
        // Values in between lie within the control points of the cubic.
        let third = path.h * (1.0 / 3.0);
        let (c0, c1) = ((u0 + v0 * third).abs(), (u1 - v1 * third).abs());
        let inside = self.value.abs().less(c0.max(c1));
        if inside.any() {
            for lane in 0..S::LANES {
                if inside.lane(lane) && !impulsive.lane(lane) {
                    self.look_inside(path, from, bend, lane);
                }
            }
        }
        self.bend = S::choose(impulsive, self.bend, bend);
    }

    /// Crests that awaited this step.
    fn confirm(&mut self, bend: S, impulsive: S::Mask) {
        for lane in 0..S::LANES {
            let value = self.awaiting[0].lane(lane).abs();
            if !value.is_finite() || impulsive.lane(lane) {
                continue;
            }
            if !agree(self.bend.lane(lane), bend.lane(lane)) {
                if value > self.doubtful.lane(lane) {
                    self.doubtful.set_lane(lane, self.awaiting[0].abs(), lane);
                }
            } else if value > self.value.lane(lane).abs() {
                let [value, time] = self.awaiting;
                self.raise(lane, value, time);
            }
            let nan = bend.constant(f64::NAN);
            (0..2).for_each(|i| self.awaiting[i].set_lane(lane, nan, lane));
        }
    }

    /// Enters a larger value of a lane.
    fn raise(&mut self, lane: usize, value: S, time: S) {
        let known = self.value.lane(lane).abs();
        let of_start = is_of_start(known, self.time.lane(lane), value.lane(lane).abs());
        self.value.set_lane(lane, value, lane);
        if !of_start {
            self.time.set_lane(lane, time, lane);
        }
    }

    fn look_inside(&mut self, path: &Interpolant<S>, from: S, bend: S, lane: usize) {
        let own = path.lane(lane);
        let confirmed = agree(self.bend.lane(lane), bend.lane(lane));
        for t in own.stationary() {
            let value = own.value(t).abs();
            if value <= self.value.lane(lane).abs() {
                continue;
            }
            // At a stationary point a shift of the instant does not change the value to first order.
            let (value, time) = (path.value(bend.constant(t)), from + path.crest(t));
            if confirmed {
                self.raise(lane, value, time);
            } else {
                self.awaiting[0].set_lane(lane, value, lane);
                self.awaiting[1].set_lane(lane, time, lane);
            }
        }
    }

    /// Ends the run of a lane at a time: a maximum that needs another step is not confirmed, and a maximum at the end moves with the end of the run.
    pub fn close(&mut self, lane: usize, end: S) {
        if S::DERIVES {
            self.time.set_lane(lane, at_last(self.time, end), lane);
        }
        let value = self.awaiting[0].abs();
        if value.lane(lane) > self.doubtful.lane(lane) {
            self.doubtful.set_lane(lane, value, lane);
        }
        // A constant quantity has no maximum within a step.
        let still = self.value.lane(lane) == 0.0;
        if S::DERIVES && (still || !self.is_resolved(lane)) {
            self.time.set_lane(lane, self.time.underived(), lane);
        }
    }
}

/// Time of a maximum; the end of the run for a maximum there, which moves with it. First lane only.
pub fn at_last<S: Number>(time: S, end: S) -> S {
    let same = (time.lane(0) - end.lane(0)).abs() <= SAME_INSTANT * end.lane(0);
    if S::DERIVES && same { end } else { time }
}
