//! Dimensions of quantities.

use std::fmt;

/// Exponents of metre, kilogram, second, radian and kelvin, which may be halves: Hertz stiffness is in N/m^1.5.
///
/// The angle counts as a dimension, so that `"1500 1/min"` is no angular velocity and `"17 deg"` no coefficient of friction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dimension {
    /// Twice the exponents, shape (5) \[-\].
    pub(super) doubled: [i32; 5],
}

impl Dimension {
    /// A dimension from its three exponents.
    pub const fn new(metre: i32, kilogram: i32, second: i32) -> Self {
        Self { doubled: [2 * metre, 2 * kilogram, 2 * second, 0, 0] }
    }

    /// A dimension from three exponents that may be halves.
    pub const fn halves(metre: f64, kilogram: f64, second: f64) -> Self {
        let [m, kg, s] = [(2.0 * metre) as i32, (2.0 * kilogram) as i32, (2.0 * second) as i32];
        Self { doubled: [m, kg, s, 0, 0] }
    }

    /// The same with an exponent of the radian.
    pub const fn with_radian(self, radian: i32) -> Self {
        let [metre, kilogram, second, _, kelvin] = self.doubled;
        Self { doubled: [metre, kilogram, second, 2 * radian, kelvin] }
    }

    /// The same with an exponent of the kelvin: of differences of temperature.
    pub const fn with_kelvin(self, kelvin: i32) -> Self {
        let [metre, kilogram, second, radian, _] = self.doubled;
        Self { doubled: [metre, kilogram, second, radian, 2 * kelvin] }
    }

    /// The same without angle: what a formula makes of it.
    pub const fn without_angle(self) -> Self {
        self.with_radian(0)
    }

    /// Dimension of a product.
    pub(super) fn times(self, other: Self) -> Self {
        let sum = |i: usize| self.doubled[i].saturating_add(other.doubled[i]);
        Self { doubled: [0, 1, 2, 3, 4].map(sum) }
    }

    /// Dimension of the reciprocal.
    pub(super) fn inverse(self) -> Self {
        Self { doubled: self.doubled.map(i32::saturating_neg) }
    }

    /// Dimension of the square root; `None` where an exponent would be a quarter.
    pub(super) fn root(self) -> Option<Self> {
        let whole = self.doubled.iter().all(|n| n % 2 == 0);
        whole.then_some(Self { doubled: self.doubled.map(|n| n / 2) })
    }
}

impl fmt::Display for Dimension {
    /// Writes the coherent SI unit, for instance `kg*m/s^2`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [metre, kilogram, second, radian, kelvin] = self.doubled;
        let bases = [("kg", kilogram), ("m", metre), ("rad", radian), ("s", second), ("K", kelvin)];
        let side = |above: bool| -> Vec<String> {
            let one = |&(name, doubled): &(&str, i32)| match doubled.abs() {
                2 => name.to_string(),
                n => format!("{name}^{}", f64::from(n) / 2.0),
            };
            bases.iter().filter(|b| b.1 != 0 && (b.1 > 0) == above).map(one).collect()
        };
        let (above, below) = (side(true), side(false));
        f.write_str(if above.is_empty() { "1" } else { "" })?;
        f.write_str(&above.join("*"))?;
        match below.len() {
            0 => Ok(()),
            1 => write!(f, "/{}", below[0]),
            _ => write!(f, "/({})", below.join("*")),
        }
    }
}
