//! Numbers in lanes, one per run or per element, on which the processor operates at once.

use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
use std::sync::atomic::{AtomicUsize, Ordering};

use pulp::{Simd, WithSimd, bytemuck};

use super::{Mask, Number, Real, Task, quotient};

/// Numbers in the widest registers that may be used.
static MOST_LANES: AtomicUsize = AtomicUsize::new(usize::MAX);

/// Limits the registers of the process to this number of lanes from now on: for tests, which compare them.
pub fn use_at_most(lanes: usize) {
    MOST_LANES.store(lanes, Ordering::Relaxed);
}

/// Executes a task in the widest registers of the processor.
pub fn in_lanes<W: WithSimd>(what: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    {
        use pulp::x86::{V3, V4};
        let most = MOST_LANES.load(Ordering::Relaxed);
        if let Some(family) = V4::try_new().filter(|_| most >= V4::F64_LANES) {
            return Simd::vectorize(family, what);
        }
        if let Some(family) = V3::try_new().filter(|_| most >= V3::F64_LANES) {
            return Simd::vectorize(family, what);
        }
    }
    what.with_simd(pulp::Scalar::new())
}

/// As many lanes as a vector register of the processor family `P` has.
///
/// Each lane has the same operations for any registers, products fused with sums where a kernel requires it: its bits depend neither on its
/// neighbours nor on the width of the registers.
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

    /// The first numbers of a slice, which has as many at least.
    #[inline(always)]
    pub fn load(self, from: &[f64]) -> Self {
        let bytes = bytemuck::cast_slice(&from[..P::F64_LANES]);
        self.with(bytemuck::pod_read_unaligned(bytes))
    }

    /// Writes them to the beginning of a slice.
    #[inline(always)]
    pub fn store(self, to: &mut [f64]) {
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut to[..P::F64_LANES]);
        bytes.copy_from_slice(bytemuck::bytes_of(&self.value));
    }

    /// The number in a lane.
    #[inline(always)]
    pub fn at(&self, lane: usize) -> f64 {
        bytemuck::cast_slice::<P::f64s, f64>(std::slice::from_ref(&self.value))[lane]
    }

    #[inline(always)]
    fn with(self, value: P::f64s) -> Self {
        Self { family: self.family, value }
    }

    /// Registers of several numbers.
    #[inline(always)]
    fn unwrapped<const N: usize>(x: [Self; N], family: P) -> [P::f64s; N] {
        let mut values = [family.splat_f64s(0.0); N];
        for i in 0..N {
            values[i] = x[i].value;
        }
        values
    }

    #[inline(always)]
    fn wrapped<const N: usize>(family: P, values: [P::f64s; N]) -> [Self; N] {
        let mut x = [Self::new(family, 0.0); N];
        for i in 0..N {
            x[i].value = values[i];
        }
        x
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
    fn ordinary_sqrts<const N: usize>(x: [Self; N]) -> [Self; N] {
        let Some(&Self { family, .. }) = x.first() else { return x };
        Self::wrapped(family, quotient::roots(family, Self::unwrapped(x, family)))
    }
    #[inline(always)]
    fn ordinary_recips<const N: usize>(x: [Self; N]) -> [Self; N] {
        let Some(&Self { family, .. }) = x.first() else { return x };
        Self::wrapped(family, quotient::reciprocals(family, Self::unwrapped(x, family)))
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
    type Mask = LanesMask<P>;
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
    fn less(self, other: Self) -> LanesMask<P> {
        let family = self.family;
        LanesMask { family, mask: family.less_than_f64s(self.value, other.value) }
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> LanesMask<P> {
        let family = self.family;
        LanesMask { family, mask: family.less_than_or_equal_f64s(self.value, other.value) }
    }
    #[inline(always)]
    fn choose(mask: LanesMask<P>, a: Self, b: Self) -> Self {
        a.with(a.family.select_f64s(mask.mask, a.value, b.value))
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
    fn powf(self, exponent: Self) -> Self {
        self.constants(|lane| self.lane(lane).powf(exponent.lane(lane)))
    }
    #[inline(always)]
    fn constants(self, value: impl Fn(usize) -> f64) -> Self {
        let mut out = self;
        for (lane, x) in out.values().iter_mut().enumerate() {
            *x = value(lane);
        }
        out
    }
    #[inline(always)]
    fn apart<T: Task>(self, task: T) -> T::Output {
        self.family.vectorize(Apart(task))
    }
}

/// See [`Number::apart`].
pub struct Apart<T>(pub T);

impl<T: Task> WithSimd for Apart<T> {
    type Output = T::Output;
    #[inline(always)]
    fn with_simd<P: Simd>(self, _: P) -> T::Output {
        self.0.run()
    }
}

/// A yes or no for each of [`Lanes`].
#[derive(Clone, Copy, Debug)]
pub struct LanesMask<P: Simd> {
    family: P,
    mask: P::m64s,
}

impl<P: Simd> LanesMask<P> {
    #[inline(always)]
    fn with(self, mask: P::m64s) -> Self {
        Self { family: self.family, mask }
    }
}

impl<P: Simd> BitAnd for LanesMask<P> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        self.with(self.family.and_m64s(self.mask, other.mask))
    }
}

impl<P: Simd> BitOr for LanesMask<P> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        self.with(self.family.or_m64s(self.mask, other.mask))
    }
}

impl<P: Simd> Not for LanesMask<P> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        self.with(self.family.not_m64s(self.mask))
    }
}

impl<P: Simd> Mask for LanesMask<P> {
    #[inline(always)]
    fn any(self) -> bool {
        self.family.first_true_m64s(self.mask) < P::F64_LANES
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> bool {
        let yes = Lanes::new(self.family, 1.0);
        Lanes::choose(self, yes, yes.constant(0.0)).lane(lane) > 0.0
    }
}
