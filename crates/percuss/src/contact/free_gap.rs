//! Velocities of approach and separation, from the free motion of the gap.
//!
//! The rate at the end of a closing step is already changed by the contact, by an amount that depends on the step size. The rate at its start and
//! the acceleration of the previous step are independent of the contact.

use crate::scalar::Number;

/// Motion of a gap towards a contact; after a contact, with time and rate reversed.
#[derive(Clone, Copy, Debug)]
pub struct FreeGap<S> {
    /// Gap at the start of the step \[m\].
    pub gap: S,
    /// Its rate \[m/s\].
    pub rate: S,
    /// Change of the rate in the previous step without contact; zero if unknown \[m/s^2\].
    pub acceleration: S,
}

impl<S: Number> FreeGap<S> {
    /// Time until it closes, no later than `h`, and its rate then; a non-negative rate if it does not close by its free motion.
    #[inline(always)]
    pub fn closes(&self, h: S) -> [S; 2] {
        let zero = h.constant(0.0);
        let twice = self.gap + self.gap;
        let root = (self.rate * self.rate - self.acceleration * twice).sqrt();
        let time = twice / (root - self.rate);
        let rate = self.rate + self.acceleration * time;
        let found = rate.less(zero) & time.at_most(h);
        let straight = -(self.gap / self.rate);
        let in_time = self.rate.less(zero) & straight.at_most(h);
        // If it does not close by free motion, it closes within the step for another reason, at an unknown instant.
        let straight = S::choose(in_time, straight, h.underived());
        [S::choose(found, time, straight), S::choose(found, rate, self.rate)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_falling_body_touches_with_the_velocity_of_its_fall() {
        let falling = FreeGap { gap: 0.1, rate: -2.0, acceleration: -9.81 };
        let [time, rate] = falling.closes(0.1);
        assert!((0.1 - 2.0 * time - 0.5 * 9.81 * time * time).abs() < 1e-15);
        assert!((rate + (4.0_f64 + 2.0 * 9.81 * 0.1).sqrt()).abs() < 1e-14);
    }

    #[test]
    fn an_acceleration_that_would_keep_it_open_is_not_believed() {
        let braked = FreeGap { gap: 0.1, rate: -1.0, acceleration: 50.0 };
        assert_eq!(braked.closes(0.2), [0.1, -1.0]);
        assert_eq!(braked.closes(0.05), [0.05, -1.0]);
    }

    #[test]
    fn a_gap_that_opens_does_not_close_by_itself() {
        let opening = FreeGap { gap: 0.1, rate: 1.0, acceleration: 0.0 };
        assert!(opening.closes(0.1)[1] >= 0.0);
    }
}
