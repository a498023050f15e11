//! Rounded corners of rolled and hollow sections: areas that fillets add and rounded edges take away.

use std::f64::consts::PI;

use super::profile::Strip;

/// Moments of an area above the centre line.
#[derive(Clone, Copy)]
pub(super) struct Moments {
    /// Area \[m^2\].
    pub area: f64,
    /// Integral of the height over the area \[m^3\].
    pub first: f64,
    /// Integral of the squared height over the area \[m^4\].
    pub second: f64,
}

impl Moments {
    /// A rectangle between two heights.
    pub fn rectangle(width: f64, from: f64, to: f64) -> Self {
        Self {
            area: width * (to - from),
            first: width * (to.powi(2) - from.powi(2)) / 2.0,
            second: width * (to.powi(3) - from.powi(3)) / 3.0,
        }
    }

    /// What lies between the two sides of a right angle and the quarter of a circle that touches both: a square less a quarter of a
    /// circle. One side is horizontal, `height` above the centre line, and the corner lies below it.
    pub fn corner(height: f64, radius: f64) -> Self {
        // Integrals of 1, x and x^2 with x the distance from the horizontal side.
        let area = (1.0 - PI / 4.0) * radius.powi(2);
        let (one, two) =
            ((5.0 / 6.0 - PI / 4.0) * radius.powi(3), (1.0 - 5.0 * PI / 16.0) * radius.powi(4));
        Self {
            area,
            first: area * height - one,
            second: area * height.powi(2) - 2.0 * height * one + two,
        }
    }

    /// These with `count` times those of another area.
    pub fn with(self, count: f64, other: Self) -> Self {
        Self {
            area: self.area + count * other.area,
            first: self.first + count * other.first,
            second: self.second + count * other.second,
        }
    }

    /// The strip of uniform width that has these moments: same area, fully plastic moment and second moment of area.
    pub fn strip(self) -> Strip {
        let middle = self.first / self.area;
        let half = (3.0 * (self.second / self.area - middle * middle)).sqrt();
        let (from, to) = (middle - half, middle + half);
        Strip { from, to, width: self.area / (2.0 * half) }
    }
}
