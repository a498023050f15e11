//! How far the surfaces of a contact with friction slide on each other, and what that dissipates.

use serde::{Deserialize, Serialize};

use crate::summary::Sliding;

/// The sliding of one contact.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Slides {
    /// All of it so far.
    pub(super) total: Sliding,
    /// Number of the part of a step in which it last pressed.
    part: u64,
    /// Impulse of its points in that part along their normals \[N s\].
    pressed: f64,
    /// How far they slid in that part, in the mean weighted by these impulses \[m\].
    slid: f64,
}

impl Slides {
    /// Takes in a point that pressed with this impulse in a part of a step, slid by so much, and on which friction did this work.
    pub(super) fn take(&mut self, part: u64, pressed: f64, slip: f64, work: f64) {
        self.total.work -= work;
        if pressed <= 0.0 {
            return;
        }
        if self.part != part {
            (self.part, self.pressed, self.slid) = (part, 0.0, 0.0);
        }
        self.pressed += pressed;
        let more = (slip.abs() - self.slid) * (pressed / self.pressed);
        self.slid += more;
        self.total.distance += more;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_slide_together_count_by_what_they_press() {
        let mut slides = Slides::default();
        // Two points that press alike and slide alike are one; then one of them presses three times as much and stands still.
        for (part, points) in [(1, [[1.0, 0.2], [1.0, -0.2]]), (2, [[1.0, 0.4], [3.0, 0.0]])] {
            for [pressed, slip] in points {
                slides.take(part, pressed, slip, -0.5);
            }
        }
        slides.take(3, 0.0, 9.0, 0.0);
        assert!((slides.total.distance - 0.3).abs() < 1e-15, "{slides:?}");
        assert!((slides.total.work - 2.0).abs() < 1e-15, "{slides:?}");
    }
}
