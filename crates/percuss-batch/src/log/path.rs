//! Closing instant and largest value of a path over a step.

use super::guide::Top;
use percuss::internals::contact::free_gap::FreeGap;
use percuss::internals::scalar::{Mask, Number};
use percuss::math::interpolant::Interpolant;

/// Time from the start of the step at which a lane's contact closes, and the velocity of approach.
pub(super) fn touch_down<S: Number>(
    path: &Interpolant<S>,
    free: &FreeGap<S>,
    lane: usize,
) -> [S; 2] {
    if free.gap.lane(lane) >= 0.0 {
        let [time, rate] = free.closes(path.h);
        if rate.lane(lane) < 0.0 {
            return [time, -rate];
        }
    }
    let time = path.crossing(lane);
    [time, path.slope(time)]
}

impl<S: Number> Top<S> {
    /// Updates the largest positive value with a step; lanes with an open gap do not change it.
    #[inline(always)]
    pub(super) fn take(&mut self, path: &Interpolant<S>, start: S, impulsive: S::Mask) {
        let ([u0, v0], [u1, v1]) = (path.start, path.end);
        self.time = Interpolant::at_event(start, impulsive, self.time);
        self.time = self.value.if_less(u1, path.at_end(start, impulsive), self.time);
        self.value = self.value.if_less(u1, u1, self.value);
        // Values in between lie within the control points of the cubic.
        let third = path.h * (1.0 / 3.0);
        let (c0, c1) = (u0 + v0 * third, u1 - v1 * third);
        let inside = self.value.less(c0.max(c1));
        if inside.any() {
            for lane in 0..S::LANES {
                if inside.lane(lane) {
                    self.look_inside(path, start, lane);
                }
            }
        }
    }

    fn look_inside(&mut self, path: &Interpolant<S>, start: S, lane: usize) {
        let own = path.lane(lane);
        for t in own.stationary() {
            if own.value(t) > self.value.lane(lane) {
                self.value.set_lane(lane, path.value(start.constant(t)), lane);
                self.time.set_lane(lane, start + path.crest(t), lane);
            }
        }
    }
}
