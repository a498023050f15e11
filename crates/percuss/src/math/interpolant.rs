//! A cubic over a step through values and rates at its ends, in every lane.

use super::hermite::Cubic;
use super::roots;
use crate::scalar::Number;

/// Between the ends of a step of size `h`.
#[derive(Clone, Copy, Debug)]
pub struct Interpolant<S> {
    /// Size of the step \[s\].
    pub h: S,
    /// Value and rate at its start, shape (2) \[unit of the value, and that by s\].
    pub start: [S; 2],
    /// Value and rate at its end, shape (2) \[unit of the value, and that by s\].
    pub end: [S; 2],
}

impl<S: Number> Interpolant<S> {
    /// The one of a lane.
    pub fn lane(&self, i: usize) -> Cubic {
        let both = |x: [S; 2]| [x[0].lane(i), x[1].lane(i)];
        Cubic { h: self.h.lane(i), start: both(self.start), end: both(self.end) }
    }

    /// Value at a time from the start of the step.
    pub fn value(&self, t: S) -> S {
        let xi = t / self.h;
        let (x2, x3) = (xi * xi, xi * xi * xi);
        let (twist, one) = (x2 * 3.0 - x3 * 2.0, x2.constant(1.0));
        self.start[0] * (one - twist)
            + self.end[0] * twist
            + self.h * (self.start[1] * (xi - x2 * 2.0 + x3) + self.end[1] * (x3 - x2))
    }

    /// Its rate.
    pub fn slope(&self, t: S) -> S {
        let xi = t / self.h;
        let x2 = xi * xi;
        let rise = (self.end[0] - self.start[0]) / self.h * (xi - x2) * 6.0;
        let one = xi.constant(1.0);
        rise + self.start[1] * (one - xi * 4.0 + x2 * 3.0) + self.end[1] * (x2 * 3.0 - xi * 2.0)
    }

    /// The rate of its rate.
    fn bend(&self, t: S) -> S {
        let (xi, rate) = (t / self.h, self.h.recip());
        let rise = (self.end[0] - self.start[0]) * rate;
        let one = xi.constant(1.0);
        let slopes = self.start[1] * (xi * 6.0 - one * 4.0) + self.end[1] * (xi * 6.0 - one * 2.0);
        (rise * (one - xi * 2.0) * 6.0 + slopes) * rate
    }

    /// The instant at which a lane's path first changes sign, in all lanes.
    pub fn crossing(&self, lane: usize) -> S {
        let path = self.lane(lane);
        let sign = if path.start[0] > 0.0 { 1.0 } else { -1.0 };
        let f = |t: f64| sign * path.value(t);
        let ends = [f(0.0), f(path.h)];
        if ends[0] <= 0.0 {
            return self.h.constant(0.0);
        }
        let guess = path.h * ends[0] / (ends[0] - ends[1]);
        let search = roots::bracketed((0.0, ends[0]), (path.h, ends[1]), guess, 0.0, 0.0, |t| {
            Ok::<f64, std::convert::Infallible>(f(t))
        });
        let Ok(root) = search;
        let root = self.h.constant(root);
        // The root moves with the ends of the path.
        if S::DERIVES { root - self.value(root) / self.slope(root) } else { root }
    }

    /// An instant at which it is stationary in a lane, which moves with the ends of the path so that it stays stationary.
    pub fn crest(&self, t: f64) -> S {
        let t = self.h.constant(t);
        if S::DERIVES { t - self.slope(t) / self.bend(t) } else { t }
    }

    /// Time of a maximum at the end of a step: an event if the step, or the next one, is as impulsive as an impact. Otherwise the instant belongs
    /// to the grid, not to the motion, and its dependence on parameters is unknown.
    pub fn at_end(&self, from: S, impulsive: S::Mask) -> S {
        let end = from + self.h;
        if S::DERIVES { S::choose(impulsive, end, end.underived()) } else { end }
    }

    /// The same for a current step that is known to be impulsive: it begins with an event at `from`.
    pub fn at_event(from: S, impulsive: S::Mask, time: S) -> S {
        if S::DERIVES { S::choose(impulsive & time.equals(from), from, time) } else { time }
    }
}
