//! Numbers side by side, one a run: what the processor works on at once.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use pulp::{Simd, bytemuck};

use super::{Number, Real, quotient};

/// As many numbers side by side as a vector register of the processor family `P` holds.
///
/// Each lane sees the same operations whatever the registers, products fused with sums where a kernel says so: its bits depend
/// neither on its neighbours nor on how wide the registers are.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))] // a load never straddles two cache lines
pub struct Lanes<P: Simd> {
    /// Proof that the processor has the registers.
    family: P,
    value: P::f64s,
}

impl<P: Simd> Lanes<P> {
    /// The same number in every lane.
    #[inline(always)]
    pub fn new(family: P, value: f64) -> Self {
        Self { family, value: family.splat_f64s(value) }
    }

    #[inline(always)]
    fn with(self, value: P::f64s) -> Self {
        Self { family: self.family, value }
    }

    #[inline(always)]
    fn values(&mut self) -> &mut [f64] {
        bytemuck::cast_slice_mut(std::slice::from_mut(&mut self.value))
    }
}

impl<P: Simd> Add for Lanes<P> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(self.family.add_f64s(self.value, other.value))
    }
}

impl<P: Simd> AddAssign for Lanes<P> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<P: Simd> Sub for Lanes<P> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(self.family.sub_f64s(self.value, other.value))
    }
}

impl<P: Simd> Mul for Lanes<P> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(self.family.mul_f64s(self.value, other.value))
    }
}

impl<P: Simd> Mul<f64> for Lanes<P> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self.with(self.family.mul_f64s(self.value, self.family.splat_f64s(other)))
    }
}

impl<P: Simd> Div for Lanes<P> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.with(self.family.div_f64s(self.value, other.value))
    }
}

impl<P: Simd> Neg for Lanes<P> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self * -1.0 // the same bits, and inlined
    }
}

impl<P: Simd> Real for Lanes<P> {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        Self::new(self.family, value)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.with(self.family.sqrt_f64s(self.value))
    }
    #[inline(always)]
    fn ordinary_sqrt(self) -> Self {
        self.with(quotient::root(self.family, self.value))
    }
    #[inline(always)]
    fn ordinary_recip(self) -> Self {
        self.with(quotient::reciprocal(self.family, self.value))
    }
    #[inline(always)]
    fn add_product(self, a: Self, b: Self) -> Self {
        self.with(self.family.mul_add_f64s(a.value, b.value, self.value))
    }
    #[inline(always)]
    fn sub_product(self, a: Self, b: Self) -> Self {
        self.add_product(-a, b)
    }
}

impl<P: Simd> Number for Lanes<P> {
    const LANES: usize = P::F64_LANES;
    #[inline(always)]
    fn lane(mut self, lane: usize) -> f64 {
        self.values()[lane]
    }
    #[inline(always)]
    fn set_lane(&mut self, lane: usize, from: Self, from_lane: usize) {
        self.values()[lane] = from.lane(from_lane);
    }
    #[inline(always)]
    fn if_less(self, other: Self, a: Self, b: Self) -> Self {
        let less = self.family.less_than_f64s(self.value, other.value);
        self.with(self.family.select_f64s(less, a.value, b.value))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        let magnitude = self.family.splat_f64s(f64::from_bits(u64::MAX >> 1));
        self.with(self.family.and_f64s(self.value, magnitude))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.with(self.family.max_f64s(other.value, self.value))
    }
    #[inline(always)]
    fn constants(self, value: impl Fn(usize) -> f64) -> Self {
        let mut out = self;
        for (lane, x) in out.values().iter_mut().enumerate() {
            *x = value(lane);
        }
        out
    }
}
