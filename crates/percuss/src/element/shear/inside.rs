//! The field inside a shear-flexible element: its axis and its sections between the nodes, from the values of these.
//!
//! It is that of a straight element in equilibrium without loads between its nodes. With the mean m and the difference n of the vectors d, the chord
//! over the length D, and `z = D - m`,
//!
//! ```text
//! x(xi) = x_m + (xi - 1/2) l D - l/2 xi (1 - xi) n - c l (xi - 3 xi^2 + 2 xi^3) z
//! d(xi) = m + (xi - 1/2) n + 6 c xi (1 - xi) z
//! ```
//!
//! where `c = 1 / (1 + 12 EI / (kappa G A l^2))` is the share of bending in z; the rest is shear. The axis is the cubic whose derivatives at both ends
//! are d and the shear there: `x' = d + (1 - c) z`. One without shear is that of a slender element.
//!
//! The part of z along m is stretch, which moves places evenly: for displacements that are reported, [`StretchedPlace`] takes it out of the cubic term.
//! Forces do without, or it would not be linear.

use crate::math::hermite;
use crate::math::vec2::{add, dot, scale, sub};

/// The field inside an element: coefficients of the values x_a, d_a, x_b and d_b of its nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InsideField {
    /// Length \[m\].
    pub length: f64,
    /// Share of bending in the difference of chord and mean vector d, c above: one of a slender element \[-\].
    pub bent: f64,
}

impl InsideField {
    /// That of a slender element, whose vectors d are the derivatives of its axis.
    pub fn slender(length: f64) -> Self {
        Self { length, bent: 1.0 }
    }

    /// Coefficients of the axis x at a share of the length, shape (4) \[-, m, -, m\].
    pub fn axis(&self, xi: f64) -> [f64; 4] {
        if self.bent == 1.0 {
            return hermite::shape(xi, self.length);
        }
        let cubic = self.bent * (xi - 3.0 * xi * xi + 2.0 * xi * xi * xi);
        let half = 0.5 * self.length;
        let parabola = xi * (1.0 - xi);
        [1.0 - xi + cubic, half * (cubic + parabola), xi - cubic, half * (cubic - parabola)]
    }

    /// Coefficients of the derivative x' of the axis with respect to the length, shape (4) \[1/m, -, 1/m, -\].
    pub fn along(&self, xi: f64) -> [f64; 4] {
        if self.bent == 1.0 {
            return hermite::slope(xi, self.length);
        }
        let cubic = self.bent * (1.0 - 6.0 * xi + 6.0 * xi * xi);
        let chord = (1.0 - cubic) / self.length;
        let bend = xi - 0.5;
        [-chord, 0.5 * cubic - bend, chord, 0.5 * cubic + bend]
    }

    /// Coefficients of the vector d of the section, shape (4) \[1/m, -, 1/m, -\].
    pub fn section(&self, xi: f64) -> [f64; 4] {
        if self.bent == 1.0 {
            return hermite::slope(xi, self.length);
        }
        let turned = 3.0 * self.bent * xi * (1.0 - xi);
        let chord = 2.0 * turned / self.length;
        [-chord, 1.0 - xi - turned, chord, xi - turned]
    }

    /// Share of the length at which the second node has this share of a force.
    pub fn place_of(&self, share: f64) -> f64 {
        // It grows with xi between nodes: the shares 0, 1/2 and 1 are at themselves, the others between 0 and 1/2 or 1/2 and 1.
        let [mut low, mut high] = if share < 0.5 { [0.0, 0.5] } else { [0.5, 1.0] };
        while high - low > 1e-15 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if self.axis(middle)[2] < share { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// The shear in the derivatives of the axis at both ends, `(1 - c) z`, from places and vectors d of the nodes, shape (2) \[-\].
    pub fn sheared(&self, places: [[f64; 2]; 2], directors: [[f64; 2]; 2]) -> [f64; 2] {
        let (chord, both) = (sub(places[1], places[0]), add(directors[0], directors[1]));
        [0, 1].map(|i| (1.0 - self.bent) * (chord[i] / self.length - 0.5 * both[i]))
    }
}

/// A place inside an element, for its displacement along the axis.
#[derive(Clone, Copy, Debug)]
pub struct StretchedPlace {
    /// Factor of the cubic term, `c l (xi - 3 xi^2 + 2 xi^3)` \[m\].
    factor: f64,
    /// Length of the element \[m\].
    length: f64,
    /// Chord over the length and mean vector d in the reference, shape (2, 2) \[-\].
    reference: [[f64; 2]; 2],
}

impl StretchedPlace {
    /// A place at a share of the length between nodes at places with vectors d; none in a slender element, and at nodes.
    pub fn new(
        inside: &InsideField,
        xi: f64,
        places: [[f64; 2]; 2],
        directors: [[f64; 2]; 2],
    ) -> Option<Self> {
        let factor = inside.bent * inside.length * (xi - 3.0 * xi * xi + 2.0 * xi * xi * xi);
        if inside.bent == 1.0 || factor == 0.0 {
            return None;
        }
        let chord = scale(1.0 / inside.length, sub(places[1], places[0]));
        let mean = scale(0.5, add(directors[0], directors[1]));
        Some(Self { factor, length: inside.length, reference: [chord, mean] })
    }

    /// Chord over the length and mean vector d of nodal values.
    fn means(&self, [a, b]: [&[f64; 4]; 2]) -> [[f64; 2]; 2] {
        let chord = [0, 1].map(|i| (b[i] - a[i]) / self.length);
        [chord, [0, 1].map(|i| 0.5 * (a[2 + i] + b[2 + i]))]
    }

    /// What it adds to the displacement, from displacements of both nodes \[m\].
    pub fn displacement(&self, nodes: [&[f64; 4]; 2]) -> [f64; 2] {
        let [moved, turned] = self.means(nodes);
        let [chord, mean] = self.reference;
        let along = |chord: [f64; 2], mean: [f64; 2]| {
            scale(dot(sub(chord, mean), mean) / dot(mean, mean), mean)
        };
        let change = sub(along(add(chord, moved), add(mean, turned)), along(chord, mean));
        scale(self.factor, change)
    }

    /// What it adds to the velocity, from displacements and velocities of both nodes \[m/s\].
    pub fn velocity(&self, nodes: [&[f64; 4]; 2], rates: [&[f64; 4]; 2]) -> [f64; 2] {
        let ([moved, turned], [faster, turning]) = (self.means(nodes), self.means(rates));
        let (chord, mean) = (add(self.reference[0], moved), add(self.reference[1], turned));
        let (difference, square) = (sub(chord, mean), dot(mean, mean));
        let share = dot(difference, mean) / square;
        let rate = dot(sub(faster, turning), mean) + dot(difference, turning)
            - 2.0 * share * dot(mean, turning);
        scale(self.factor, add(scale(rate / square, mean), scale(share, turning)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec2::norm;

    const LENGTH: f64 = 0.7;

    fn at(n: [f64; 4], values: [f64; 4]) -> f64 {
        (0..4).map(|i| n[i] * values[i]).sum()
    }

    /// A cantilever of unit EI under a unit force across its end: closed form of Timoshenko's theory.
    #[test]
    fn it_is_that_of_a_beam_in_equilibrium() {
        for shear in [0.1, 4.0, 1e3] {
            let length = 2.0;
            let deflection = |s: f64| s * s * (3.0 * length - s) / 6.0 + s / shear;
            let rotation = |s: f64| s * (length - 0.5 * s);
            let bent = 1.0 / (1.0 + 12.0 / (shear * LENGTH * LENGTH));
            let field = InsideField { length: LENGTH, bent };
            let from = 0.4;
            let nodes = [from, from + LENGTH];
            let [[wa, ta], [wb, tb]] = nodes.map(|s| [deflection(s), rotation(s)]);
            let values = [wa, ta, wb, tb];
            for xi in [0.0, 0.2, 0.5, 0.9, 1.0] {
                let s = from + xi * LENGTH;
                let slope = rotation(s) + 1.0 / shear;
                assert!((at(field.axis(xi), values) - deflection(s)).abs() < 1e-12, "{xi}");
                assert!((at(field.section(xi), values) - rotation(s)).abs() < 1e-12, "{xi}");
                assert!((at(field.along(xi), values) - slope).abs() < 1e-12, "{xi}");
            }
            let slope = field.sheared([[0.0, wa], [LENGTH, wb]], [[1.0, ta], [1.0, tb]]);
            assert!((slope[1] - 1.0 / shear).abs() < 1e-12 && slope[0].abs() < 1e-15);
        }
    }

    #[test]
    fn that_of_a_slender_element_is_the_cubic_with_its_slopes() {
        let nearly = InsideField { length: LENGTH, bent: 1.0 - 1e-15 };
        let slender = InsideField::slender(LENGTH);
        for xi in [0.0, 0.3, 0.8, 1.0] {
            for of in [InsideField::axis, InsideField::along, InsideField::section] {
                let (a, b) = (of(&nearly, xi), of(&slender, xi));
                (0..4).for_each(|i| assert!((a[i] - b[i]).abs() < 1e-13, "{a:?} {b:?}"));
            }
        }
    }

    #[test]
    fn places_follow_from_shares_of_forces() {
        for bent in [1.0, 0.6, 0.0] {
            let field = InsideField { length: LENGTH, bent };
            for xi in [0.01, 0.3, 0.5, 0.77] {
                assert!((field.place_of(field.axis(xi)[2]) - xi).abs() < 1e-13, "{bent} {xi}");
            }
        }
    }

    /// A bar that is stretched evenly and turned, at any rates.
    #[test]
    fn stretched_bars_move_evenly_along_their_axis() {
        let inside = InsideField { length: LENGTH, bent: 0.6 };
        let (xi, directors) = (0.3, [[1.0, 0.0]; 2]);
        let place =
            StretchedPlace::new(&inside, xi, [[0.0, 0.0], [LENGTH, 0.0]], directors).unwrap();
        let at = |t: f64| {
            let ((sin, cos), strain) = ((0.4 + 2.0 * t).sin_cos(), 0.02 + 0.3 * t);
            let reach = LENGTH * (1.0 + strain);
            let d = [cos - 1.0, sin];
            let nodes = [[0.0, 0.0, d[0], d[1]], [reach * cos - LENGTH, reach * sin, d[0], d[1]]];
            (nodes, [xi * reach * cos - xi * LENGTH, xi * reach * sin])
        };
        let moved = |t: f64| {
            let ([a, b], _) = at(t);
            let n = inside.axis(xi);
            let linear =
                [0, 1].map(|i| n[0] * a[i] + n[1] * a[2 + i] + n[2] * b[i] + n[3] * b[2 + i]);
            add(linear, place.displacement([&a, &b]))
        };
        let exact = at(0.0).1;
        assert!(norm(sub(moved(0.0), exact)) < 1e-15, "{:?} {exact:?}", moved(0.0));
        // The rate, by central differences.
        let e = 1e-5;
        let [before, after] = [at(-e).0, at(e).0];
        let rates: [[f64; 4]; 2] = std::array::from_fn(|n| {
            std::array::from_fn(|i| (after[n][i] - before[n][i]) / (2.0 * e))
        });
        let now = at(0.0).0;
        let found = place.velocity([&now[0], &now[1]], [&rates[0], &rates[1]]);
        let [back, on] = [-e, e].map(|t| {
            let [a, b] = at(t).0;
            place.displacement([&a, &b])
        });
        let expected = scale(0.5 / e, sub(on, back));
        assert!(norm(sub(found, expected)) < 1e-8, "{found:?} {expected:?}");
    }

    #[test]
    fn nodes_are_exact() {
        let field = InsideField { length: LENGTH, bent: 0.3 };
        assert_eq!(field.axis(0.0), [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(field.axis(1.0), [0.0, 0.0, 1.0, 0.0]);
        assert_eq!(field.section(0.0), [0.0, 1.0, 0.0, 0.0]);
        assert_eq!(field.section(1.0), [0.0, 0.0, 0.0, 1.0]);
    }
}
