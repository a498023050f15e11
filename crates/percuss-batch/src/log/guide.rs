//! The record of a guided projectile: contact intervals, impulse and transferred energy.

use percuss::internals::contact::free_gap::FreeGap;
use percuss::internals::scalar::{Mask, Number};

/// A largest value and when it occurred.
#[derive(Clone, Copy, Debug)]
pub struct Top<S> {
    pub value: S,
    pub time: S,
}

/// A contact interval of one lane.
#[derive(Clone, Copy, Debug)]
pub struct Closed<S> {
    pub start: S,
    pub end: S,
    pub impulse: S,
    /// Work on beam and projectile, shape (2) \[J\].
    pub given: [S; 2],
    /// Potential at its end, if the contact is still closed there \[J\].
    pub stored: S,
    /// Deepest penetration \[m\].
    pub deepest: Top<S>,
    pub approach: S,
    pub separation: S,
    /// Number of steps with a closed contact.
    pub steps: S,
    /// Change of the gap's rate in the step before it and in the step after it, shape (2) \[m/s\].
    pub changes: [S; 2],
    /// Position at which the contact closed, shape (2) \[m\].
    pub place: [S; 2],
    /// Last position of the contact, shape (2) \[m\].
    pub place_end: [S; 2],
}

/// The record of a guided projectile.
#[derive(Clone, Debug)]
pub struct GuideLog<S: Number> {
    /// The current contact interval of each lane.
    pub open: Closed<S>,
    /// Whether a lane has a current interval, shape (lanes).
    pub is_open: Vec<bool>,
    /// Intervals that have ended, for each lane, shape (lanes, intervals of one).
    pub closed: Vec<Vec<Closed<S>>>,
    /// Deepest penetration of the run \[m\].
    pub deepest: Top<S>,
    /// Impulse and energy transferred by the projectile, and work on the struck body, shape (3) \[N s, J, J\].
    pub given: [S; 3],
    /// Acceleration of the gap in the last step with an open gap \[m/s^2\].
    pub free: S,
    /// Lanes whose last interval ended in the previous step.
    pub released: S::Mask,
    /// Gap and rate at the end of that step.
    pub parted: FreeGap<S>,
    /// Its start and size, shape (2) \[s\].
    pub parted_at: [S; 2],
}

impl<S: Number> Closed<S> {
    pub fn none(like: S) -> Self {
        let (nan, zero) = (like.constant(f64::NAN), like.constant(0.0));
        Self {
            start: nan,
            end: nan,
            impulse: zero,
            given: [zero; 2],
            stored: zero,
            deepest: Top { value: zero, time: nan },
            approach: nan,
            separation: nan,
            steps: zero,
            changes: [zero; 2],
            place: [nan; 2],
            place_end: [nan; 2],
        }
    }

    /// Ends the interval at the instant that follows from the motion of the gap, traced back from the end of the step that began at `start` with
    /// size `h`; returns the time from that instant to the end of the step.
    pub fn part(&mut self, back: &FreeGap<S>, [start, h]: [S; 2]) -> S {
        let [since, rate] = back.closes(h);
        self.end = start + (h - since);
        self.separation = -rate;
        self.changes[1] = back.acceleration * h;
        since
    }

    /// All its numbers.
    fn numbers(&mut self) -> [&mut S; 17] {
        let ([c0, c1], [g0, g1]) = (&mut self.changes, &mut self.given);
        let ([x, y], [x_end, y_end]) = (&mut self.place, &mut self.place_end);
        let Top { value, time } = &mut self.deepest;
        let Self { start, end, impulse, stored, approach, separation, steps, .. } = self;
        [
            start, end, impulse, stored, value, time, approach, separation, steps, c0, c1, g0, g1,
            x, y, x_end, y_end,
        ]
    }

    /// Copies a lane of another record.
    pub fn set_lane(&mut self, lane: usize, from: &Self, from_lane: usize) {
        for (mine, other) in self.numbers().into_iter().zip({ *from }.numbers()) {
            mine.set_lane(lane, *other, from_lane);
        }
    }
}

impl<S: Number> GuideLog<S> {
    /// All its numbers except those of intervals that have ended.
    pub fn numbers(&mut self) -> impl Iterator<Item = &mut S> {
        let FreeGap { gap, rate, acceleration } = &mut self.parted;
        let Top { value, time } = &mut self.deepest;
        let others = [value, time, &mut self.free, gap, rate, acceleration];
        let others = others.into_iter().chain(&mut self.given).chain(&mut self.parted_at);
        self.open.numbers().into_iter().chain(others)
    }

    /// Lanes with an open gap over a step: its acceleration gives the separation velocity in the previous step.
    #[inline(always)]
    pub fn open_throughout(&mut self, taken: S::Mask, open: S::Mask, acceleration: S) {
        let zero = acceleration.constant(0.0);
        self.free = S::choose(open, acceleration, zero);
        let (freed, released) = (self.released & open & taken, self.released & taken);
        if !released.any() {
            return;
        }
        self.released = zero.less(zero);
        // A contact that closes again at once has no free motion over a step.
        for lane in (0..S::LANES).filter(|i| released.lane(*i) && !freed.lane(*i)) {
            if let Some(last) = self.closed[lane].last_mut() {
                last.changes[1] = zero.constant(f64::NAN);
            }
        }
        let parted = FreeGap { acceleration, ..self.parted };
        for lane in 0..S::LANES {
            if let Some(last) = self.closed[lane].last_mut().filter(|_| freed.lane(lane)) {
                last.part(&parted, self.parted_at);
            }
        }
    }
}
