//! A number with its derivatives: forward differentiation.

use std::array::from_fn;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use super::lanes::Apart;
use super::{Number, Real, Task};

/// A value and its derivatives with respect to `P` parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const P: usize> {
    /// Value.
    pub value: f64,
    /// Derivatives, shape (P) \[unit of the value by that of the parameter\].
    pub slope: [f64; P],
}

impl<const P: usize> Dual<P> {
    #[inline(always)]
    fn new(value: f64, slope: impl Fn(usize) -> f64) -> Self {
        Self { value, slope: from_fn(slope) }
    }
}

impl<const P: usize> Add for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self::new(self.value + o.value, |i| self.slope[i] + o.slope[i])
    }
}

impl<const P: usize> AddAssign for Dual<P> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl<const P: usize> Sub for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self::new(self.value - o.value, |i| self.slope[i] - o.slope[i])
    }
}

#[expect(clippy::suspicious_arithmetic_impl, reason = "the product rule")]
impl<const P: usize> Mul for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: Self) -> Self {
        Self::new(self.value * o.value, |i| self.slope[i] * o.value + self.value * o.slope[i])
    }
}

impl<const P: usize> Mul<f64> for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, o: f64) -> Self {
        Self::new(self.value * o, |i| self.slope[i] * o)
    }
}

#[expect(clippy::suspicious_arithmetic_impl, reason = "the quotient rule")]
impl<const P: usize> Div for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn div(self, o: Self) -> Self {
        let quotient = self.value / o.value;
        Self::new(quotient, |i| (self.slope[i] - quotient * o.slope[i]) / o.value)
    }
}

impl<const P: usize> Neg for Dual<P> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.value, |i| -self.slope[i])
    }
}

impl<const P: usize> Real for Dual<P> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self { value, slope: [0.0; P] }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        // Of a constant zero, too.
        Self::new(root, |i| if self.slope[i] == 0.0 { 0.0 } else { self.slope[i] / (2.0 * root) })
    }
}

impl<const P: usize> Number for Dual<P> {
    type Mask = bool;
    const LANES: usize = 1;
    const DERIVES: bool = true;
    #[inline(always)]
    fn underived(self) -> Self {
        Self { slope: [f64::NAN; P], ..self }
    }
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self.value
    }
    #[inline(always)]
    fn set_lane(&mut self, _: usize, from: Self, _: usize) {
        *self = from;
    }
    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self.value < other.value
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> bool {
        self.value <= other.value
    }
    #[inline(always)]
    fn choose(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    #[inline(always)]
    fn either(mask: bool, a: impl FnOnce() -> Self, b: impl FnOnce() -> Self) -> Self {
        if mask { a() } else { b() }
    }
    #[inline(always)]
    fn powf(self, exponent: Self) -> Self {
        let power = self.value.powf(exponent.value);
        let (base, log) = (exponent.value * power / self.value, power * self.value.ln());
        Self::new(power, |i| base * self.slope[i] + log * exponent.slope[i])
    }
    #[inline(always)]
    fn constants(self, value: impl Fn(usize) -> f64) -> Self {
        self.constant(value(0))
    }
    /// In registers of four numbers where the processor has them: those of the derivatives by three parameters and the step.
    #[inline(never)]
    fn apart<T: Task>(self, task: T) -> T::Output {
        #[cfg(target_arch = "x86_64")]
        if let Some(family) = pulp::x86::V3::try_new() {
            return pulp::Simd::vectorize(family, Apart(task));
        }
        pulp::Simd::vectorize(pulp::Scalar::new(), Apart(task))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_difference_quotients() {
        fn f<S: Number>(x: S, y: S) -> S {
            (x * x / (y + y.constant(2.0)) - y * 3.0).sqrt() * x.recip() + -x.powf(y)
        }
        let (x, y, e) = (3.0, -0.4, 1e-6);
        let d = f(Dual { value: x, slope: [1.0, 0.0] }, Dual { value: y, slope: [0.0, 1.0] });
        assert_eq!(d.value, f(x, y));
        let [dx, dy] =
            [[e, 0.0], [0.0, e]].map(|[a, b]| (f(x + a, y + b) - f(x - a, y - b)) / (2.0 * e));
        assert!((d.slope[0] - dx).abs() < 1e-9 && (d.slope[1] - dy).abs() < 1e-9);
    }
}
