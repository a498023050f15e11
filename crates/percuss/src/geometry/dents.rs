//! Permanent indentations along a face, by a round body at its points of contact.
//!
//! A circle of radius R with the penetration m leaves an indentation with half the width `a(m) = sqrt(m (2 R + m))`, its chord. At a distance x
//! along the face the same circle fits between the rims to the depth `a^-1(a(m) - |x|)`: m at the bottom, zero beyond a(m). The depth is therefore
//! continuous along the face, and a motion by more than half the chord leads to an undamaged part of the face.

use serde::{Deserialize, Serialize};

/// A motion by less than this share of half the width continues the same indentation.
const SAME: f64 = 1.0 / 16.0;

/// A dent, where it is deepest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Dent {
    /// Where along the face \[m\].
    pub place: f64,
    /// Which face: 1 or -1, zero beyond an end.
    pub side: f64,
    /// How deep \[m\].
    pub depth: f64,
}

impl Dent {
    /// Half the width that a circle of the given radius gives it \[m\].
    pub fn half_width(&self, radius: f64) -> f64 {
        (self.depth * (2.0 * radius + self.depth)).sqrt()
    }

    /// How deep the same circle fits into it where another one is \[m\].
    fn depth_at(&self, other: &Self, radius: f64) -> f64 {
        let away = (other.place - self.place).abs();
        if self.side != other.side || self.depth <= 0.0 {
            return 0.0;
        }
        if away == 0.0 {
            return self.depth;
        }
        let left = self.half_width(radius) - away;
        if left <= 0.0 { 0.0 } else { left * left / (left.hypot(radius) + radius) }
    }
}

/// An indentation carried along by a loaded contact: elsewhere it would have to be produced again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CarriedCrush {
    /// How far along the face, from where it was made \[m\].
    pub distance: f64,
    /// How much of the permanent penetration is of that place and not of the one where it presses \[m\].
    pub depth: f64,
}

impl CarriedCrush {
    /// Merges another one if it is deeper.
    pub(crate) fn most(&mut self, other: Self) {
        if other.depth > self.depth {
            *self = other;
        }
    }
}

/// The dents of a pair, and how its deepest one was carried.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Dents {
    /// The one made last.
    last: Dent,
    /// Where it was begun \[m\].
    begun: f64,
    /// The others, in their order along the face, shape (others).
    others: Vec<Dent>,
    /// Depth of the deepest \[m\].
    deepest: f64,
    /// The most that was carried.
    pub carried: CarriedCrush,
}

impl Dents {
    /// Depth to which the circle fits in at a place, without the depth of `at` \[m\].
    pub fn depth_at(&self, at: &Dent, radius: f64) -> f64 {
        let others = self.others[self.around(at.place, radius)].iter();
        others.map(|d| d.depth_at(at, radius)).fold(self.last.depth_at(at, radius), f64::max)
    }

    /// The deepest of all \[m\].
    pub fn deepest(&self) -> f64 {
        self.deepest
    }

    /// Whether a place lies beside the dent made last.
    pub fn has_left(&self, at: &Dent, radius: f64) -> bool {
        self.last.depth_at(at, radius) == 0.0
    }

    /// Moves part of the depth of the last indentation to another place.
    pub fn carry(&mut self, to: &Dent, depth: f64) {
        let distance = (to.place - self.last.place).abs();
        self.carried.most(CarriedCrush { distance, depth });
    }

    /// Indentation at a place without an equally deep one.
    pub fn deepen(&mut self, new: Dent, radius: f64) {
        self.deepest = self.deepest.max(new.depth);
        let beyond = (new.place - self.begun).abs() > SAME * new.half_width(radius);
        if beyond || new.side != self.last.side {
            let before = std::mem::replace(&mut self.last, new);
            self.begun = new.place;
            self.keep(before, radius);
        } else if new.depth > self.last.depth {
            self.last = new;
        } else {
            self.pass(new, radius);
        }
    }

    /// Pressed in somewhere by less than it is carried with.
    pub fn pass(&mut self, new: Dent, radius: f64) {
        let nearly = new.depth * (1.0 - SAME).powi(2);
        if self.depth_at(&new, radius) < nearly {
            self.keep(new, radius);
        }
    }

    /// Adds a dent to the others, in place of those that lie within it.
    fn keep(&mut self, new: Dent, radius: f64) {
        if new.depth <= 0.0 {
            return;
        }
        let around = self.around(new.place, radius);
        let mut kept: Vec<Dent> = self.others[around.clone()].to_vec();
        kept.retain(|dent| new.depth_at(dent, radius) < dent.depth);
        kept.insert(kept.partition_point(|dent| dent.place < new.place), new);
        self.others.splice(around, kept);
    }

    /// The others that may reach a place.
    fn around(&self, place: f64, radius: f64) -> std::ops::Range<usize> {
        let widest = Dent { depth: self.deepest, ..self.last }.half_width(radius);
        let first = self.others.partition_point(|dent| dent.place < place - widest);
        first..self.others.partition_point(|dent| dent.place <= place + widest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RADIUS: f64 = 0.05;

    fn at(place: f64, depth: f64) -> Dent {
        Dent { place, side: 1.0, depth }
    }

    #[test]
    fn a_circle_fits_into_its_own_dent_and_not_beside_it() {
        let mut dents = Dents::default();
        dents.deepen(at(1.0, 2e-3), RADIUS);
        let half = (2e-3_f64 * (2.0 * RADIUS + 2e-3)).sqrt();
        assert_eq!(dents.depth_at(&at(1.0, 0.0), RADIUS), 2e-3);
        assert_eq!(dents.depth_at(&at(1.0 + 1.0001 * half, 0.0), RADIUS), 0.0);
        assert_eq!(dents.depth_at(&Dent { side: -1.0, ..at(1.0, 0.0) }, RADIUS), 0.0);
        // Beside the bottom, both rims at half a distance from each other: the circle that rests on one of them.
        for x in [0.1, 0.5, 0.9] {
            let deep = dents.depth_at(&at(1.0 - x * half, 0.0), RADIUS);
            let rim = RADIUS.hypot((1.0 - x) * half) - RADIUS;
            assert!((deep - rim).abs() < 1e-15, "{x}: {deep} {rim}");
        }
    }

    #[test]
    fn dents_are_found_again_and_their_number_follows_the_way_not_the_steps() {
        for steps in [300, 30_000] {
            let mut dents = Dents::default();
            let mut deepest = 0.0;
            for k in 0..=steps {
                let s = f64::from(k) / f64::from(steps);
                // It is pressed in twice, slides on lightly, and less and less.
                let depth = 1e-3 * (1.0 + (12.0 * s).sin()) * (1.1 - s);
                let here = at(0.3 * s, depth);
                if depth > deepest {
                    deepest = depth;
                    dents.deepen(here, RADIUS);
                } else {
                    dents.pass(here, RADIUS);
                }
            }
            assert!(dents.others.is_sorted_by(|a, b| a.place <= b.place));
            assert!(dents.others.len() < 2000, "{}", dents.others.len());
            for k in 0..=300 {
                let s = f64::from(k) / 300.0;
                let depth = 1e-3 * (1.0 + (12.0 * s).sin()) * (1.1 - s);
                let found = dents.depth_at(&at(0.3 * s, 0.0), RADIUS);
                assert!(found >= depth * (1.0 - 2.1 * SAME), "{steps} {s}: {found} for {depth}");
            }
        }
    }
}
