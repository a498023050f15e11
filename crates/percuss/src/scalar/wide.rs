//! Numbers of some 32 digits, for linear systems whose condition leaves f64 none.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use super::Real;

/// The unevaluated sum of two f64, the second below half a unit in the last place of the first.
///
/// Error-free sums and products: Dekker 1971, A floating-point technique for extending the available precision; Knuth, The Art
/// of Computer Programming, volume 2, 4.2.2. Relative error of an operation below 1e-31; no better range than f64.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wide {
    high: f64,
    low: f64,
}

/// Splits 53 bits into halves: 2^27 + 1.
const SPLIT: f64 = 134_217_729.0;

/// Sum and its rounding error.
#[inline(always)]
fn two_sum(a: f64, b: f64) -> Wide {
    let high = a + b;
    let part = high - a;
    Wide { high, low: (a - (high - part)) + (b - part) }
}

/// The same where `a` is the larger one.
#[inline(always)]
fn fast_sum(a: f64, b: f64) -> Wide {
    let high = a + b;
    Wide { high, low: b - (high - a) }
}

#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    let scaled = SPLIT * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}

/// Product and its rounding error; without fused products, which not every processor has.
#[inline(always)]
fn two_product(a: f64, b: f64) -> Wide {
    let high = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    Wide { high, low: ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2 }
}

impl Wide {
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };
    pub const ONE: Self = Self { high: 1.0, low: 0.0 };

    /// Rounded to f64.
    #[inline(always)]
    pub fn round(self) -> f64 {
        self.high
    }
}

impl From<f64> for Wide {
    #[inline(always)]
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for Wide {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        let (s, t) = (two_sum(self.high, b.high), two_sum(self.low, b.low));
        let sum = fast_sum(s.high, s.low + t.high);
        fast_sum(sum.high, sum.low + t.low)
    }
}

impl AddAssign for Wide {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl Neg for Wide {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for Wide {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl SubAssign for Wide {
    #[inline(always)]
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}

impl Mul for Wide {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let p = two_product(self.high, b.high);
        fast_sum(p.high, p.low + (self.high * b.low + self.low * b.high))
    }
}

impl Mul<f64> for Wide {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: f64) -> Self {
        let p = two_product(self.high, b);
        fast_sum(p.high, p.low + self.low * b)
    }
}

impl Div for Wide {
    type Output = Self;
    #[inline(always)]
    fn div(self, b: Self) -> Self {
        let first = self.high / b.high;
        let rest = self - b * first;
        let second = rest.high / b.high;
        let rest = rest - b * second;
        fast_sum(first, second) + Self::from(rest.high / b.high)
    }
}

impl Real for Wide {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::from(value)
    }

    /// One step of Newton's iteration from the root in f64.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.high.sqrt();
        if root == 0.0 || !root.is_finite() {
            return Self::from(root);
        }
        let rest = self - two_product(root, root);
        two_sum(root, rest.high / (2.0 * root))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirty_digits_hold_through_sums_products_quotients_and_roots() {
        let third = Wide::ONE / Wide::from(3.0);
        let rest = third + third + third - Wide::ONE;
        assert!(rest.round().abs() < 1e-31);
        let two = Wide::from(2.0).sqrt();
        assert!((two * two - Wide::from(2.0)).round().abs() < 1e-30);
        // (1 + e)^2 - 1 - 2 e = e^2, far below the last digit of f64.
        let e = Wide::from(1e-12);
        let square = (Wide::ONE + e) * (Wide::ONE + e) - Wide::ONE - e * 2.0;
        assert!((square.round() / 1e-24 - 1.0).abs() < 1e-6);
    }
}
