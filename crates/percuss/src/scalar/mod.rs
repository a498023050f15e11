//! The scalar that kernels and whole runs are written over: `f64`, several runs side by side ([`Lanes`]), or one run with its
//! derivatives ([`Dual`]). Kernels of linear problems also in some 32 digits ([`Wide`]).

mod dual;
mod lanes;
mod quotient;
mod wide;

use std::fmt::Debug;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

pub use dual::Dual;
pub use lanes::{Lanes, in_lanes, use_at_most};
pub use wide::Wide;

/// A real number as the kernels need it.
///
/// Kernels have no branch on a value of this type, so that several lanes can replace it.
pub trait Real:
    Copy
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The constant `value`, in as many lanes as `self` has.
    fn constant(self, value: f64) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Reciprocal.
    #[inline(always)]
    fn recip(self) -> Self {
        self.constant(1.0) / self
    }
    /// Square roots of ordinary numbers: positive, neither infinite nor subnormal.
    #[inline(always)]
    fn ordinary_sqrts<const N: usize>(x: [Self; N]) -> [Self; N] {
        each(x, Self::sqrt)
    }
    /// Reciprocals of ordinary numbers: neither they nor their reciprocals are zero, infinite or subnormal.
    #[inline(always)]
    fn ordinary_recips<const N: usize>(x: [Self; N]) -> [Self; N] {
        each(x, Self::recip)
    }
    /// `self + a b`; lanes round once, which is the fastest operation of processors.
    #[inline(always)]
    fn add_product(self, a: Self, b: Self) -> Self {
        self + a * b
    }
    /// `self + factor a`, likewise.
    #[inline(always)]
    fn add_scaled(self, a: Self, factor: f64) -> Self {
        self.add_product(a, a.constant(factor))
    }
    /// `self - a b`, likewise.
    #[inline(always)]
    fn sub_product(self, a: Self, b: Self) -> Self {
        self - a * b
    }
}

/// The reciprocals of ordinary numbers, three by three by that of their product: divisions cost as much as a dozen products.
#[inline(always)]
pub fn reciprocals<S: Real, const N: usize>(mut x: [[S; 3]; N]) -> [[S; 3]; N] {
    let Some(first) = x.first() else { return x };
    let mut pairs = [first[0]; N];
    let mut products = pairs;
    for i in 0..N {
        pairs[i] = x[i][0] * x[i][1];
        products[i] = pairs[i] * x[i][2];
    }
    let all = S::ordinary_recips(products);
    for i in 0..N {
        let [x0, x1, x2] = x[i];
        let without_last = all[i] * x2;
        x[i] = [without_last * x1, without_last * x0, all[i] * pairs[i]];
    }
    x
}

/// An array by its elements, always inlined.
#[inline(always)]
fn each<T: Copy, const N: usize>(mut x: [T; N], f: impl Fn(T) -> T) -> [T; N] {
    for x in &mut x {
        *x = f(*x);
    }
    x
}

/// An array by its index. A plain loop: the library's `from_fn` and `map` are not always inlined, and a function that is not inlined cannot use the
/// vector registers.
#[inline(always)]
pub fn array<S: Real, const N: usize>(f: impl Fn(usize) -> S) -> [S; N] {
    let mut out = [f(0); N];
    for i in 1..N {
        out[i] = f(i);
    }
    out
}

/// Yes or no, in each lane.
pub trait Mask:
    Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// Whether any lane is true.
    fn any(self) -> bool;
    /// Value of a lane.
    fn lane(self, lane: usize) -> bool;
}

/// A real number that whole runs can be stepped with. Its decisions are those of its values, lane by lane.
pub trait Number: Real + Debug {
    /// Decisions, lane by lane.
    type Mask: Mask;
    /// Runs side by side.
    const LANES: usize;
    /// Whether it carries derivatives, which follow the values once these are found.
    const DERIVES: bool = false;
    /// The same value without known derivatives.
    #[inline(always)]
    fn underived(self) -> Self {
        self
    }
    /// Value in a lane.
    fn lane(self, lane: usize) -> f64;
    /// Copies the number of another lane into one of its own.
    fn set_lane(&mut self, lane: usize, from: Self, from_lane: usize);
    /// `self < other`.
    fn less(self, other: Self) -> Self::Mask;
    /// `self <= other`.
    fn at_most(self, other: Self) -> Self::Mask;
    /// `a` where the mask is true, `b` elsewhere.
    fn choose(mask: Self::Mask, a: Self, b: Self) -> Self;
    /// Result of one of two functions: the first where the mask is true; a function that no lane needs may be skipped.
    #[inline(always)]
    fn either(mask: Self::Mask, a: impl FnOnce() -> Self, b: impl FnOnce() -> Self) -> Self {
        Self::choose(mask, a(), b())
    }
    /// Decisions of given values, lane by lane.
    #[inline(always)]
    fn mask(self, value: impl Fn(usize) -> bool) -> Self::Mask {
        self.constant(0.0).less(self.constants(|lane| f64::from(u8::from(value(lane)))))
    }
    /// `self == other`.
    #[inline(always)]
    fn equals(self, other: Self) -> Self::Mask {
        self.at_most(other) & other.at_most(self)
    }
    /// Whether it is neither infinite nor NaN.
    #[inline(always)]
    fn finite(self) -> Self::Mask {
        self.abs().less(self.constant(f64::INFINITY))
    }
    /// `if self < other { a } else { b }`, lane by lane.
    #[inline(always)]
    fn if_less(self, other: Self, a: Self, b: Self) -> Self {
        Self::choose(self.less(other), a, b)
    }
    /// Magnitude.
    #[inline(always)]
    fn abs(self) -> Self {
        self.if_less(self.constant(0.0), -self, self)
    }
    /// The larger of two.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.if_less(other, other, self)
    }
    /// Length of the vector of two numbers; of a vanishing one, without derivatives.
    #[inline(always)]
    fn hypot(self, other: Self) -> Self {
        (self * self + other * other).sqrt()
    }
    /// To a power; the base is positive.
    fn powf(self, exponent: Self) -> Self;
    /// Whether any lane is less than that of another number.
    #[inline(always)]
    fn any_less(self, other: Self) -> bool {
        self.less(other).any()
    }
    /// Constants of given values, lane by lane.
    fn constants(self, value: impl Fn(usize) -> f64) -> Self;
    /// Executes a task in a separate function with the same registers: code that is inlined at every call takes long to compile, and seldom used
    /// code displaces frequently used values from the registers.
    #[inline(never)]
    fn apart<T: Task>(self, task: T) -> T::Output {
        task.run()
    }
}

/// A task, inlined at its call.
pub trait Task {
    /// Its result.
    type Output;
    /// Executes it.
    fn run(self) -> Self::Output;
}

impl Real for f64 {
    #[inline(always)]
    fn constant(self, value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
}

impl Mask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn lane(self, _: usize) -> bool {
        self
    }
}

impl Number for f64 {
    type Mask = bool;
    const LANES: usize = 1;
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn set_lane(&mut self, _: usize, from: Self, _: usize) {
        *self = from;
    }
    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> bool {
        self <= other
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
    fn hypot(self, other: Self) -> Self {
        f64::hypot(self, other)
    }
    #[inline(always)]
    fn powf(self, exponent: Self) -> Self {
        f64::powf(self, exponent)
    }
    #[inline(always)]
    fn constants(self, value: impl Fn(usize) -> f64) -> Self {
        value(0)
    }
}
