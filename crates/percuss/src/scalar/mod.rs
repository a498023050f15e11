//! The scalar that kernels and whole runs are written over: `f64`, several runs side by side ([`Lanes`]), or one run with its
//! derivatives ([`Dual`]).

mod dual;
mod lanes;
mod quotient;

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

pub use dual::Dual;
pub use lanes::Lanes;

/// A real number as the kernels need it.
///
/// Kernels hold no branch on a value of this type, so that a lane of several numbers can stand in for it.
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
    /// Square root of an ordinary number: positive, neither infinite nor subnormal.
    #[inline(always)]
    fn ordinary_sqrt(self) -> Self {
        self.sqrt()
    }
    /// Reciprocal of an ordinary number: neither it nor its reciprocal is zero, infinite or subnormal.
    #[inline(always)]
    fn ordinary_recip(self) -> Self {
        self.recip()
    }
    /// `self + a b`; lanes round once, which is what processors do fastest.
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

/// The reciprocals of three ordinary numbers by that of their product: divisions cost as much as a dozen products.
#[inline(always)]
pub fn reciprocals<S: Real>([x, y, z]: [S; 3]) -> [S; 3] {
    let xy = x * y;
    let all = (xy * z).ordinary_recip();
    let z_all = all * z;
    [z_all * y, z_all * x, all * xy]
}

/// An array by its index. A plain loop: what the library's `from_fn` and `map` become is not always inlined, and what is not
/// inlined does not know the registers it could use.
#[inline(always)]
pub fn array<S: Real, const N: usize>(f: impl Fn(usize) -> S) -> [S; N] {
    let mut out = [f(0); N];
    for i in 1..N {
        out[i] = f(i);
    }
    out
}

/// A real number that whole runs can be stepped with. Its decisions are those of its values, lane by lane.
pub trait Number: Real + std::fmt::Debug {
    /// Runs side by side.
    const LANES: usize;
    /// Whether it carries derivatives, which follow the values once these are found.
    const DERIVES: bool = false;
    /// Value in a lane.
    fn lane(self, lane: usize) -> f64;
    /// Puts the number of another lane into one of its own.
    fn set_lane(&mut self, lane: usize, from: Self, from_lane: usize);
    /// `if self < other { a } else { b }`, lane by lane.
    fn if_less(self, other: Self, a: Self, b: Self) -> Self;
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
    /// Whether any lane is less than that of another number.
    #[inline(always)]
    fn any_less(self, other: Self) -> bool {
        let one = self.if_less(other, self.constant(1.0), self.constant(0.0));
        (0..Self::LANES).any(|lane| one.lane(lane) != 0.0)
    }
    /// Constants of given values, lane by lane.
    fn constants(self, value: impl Fn(usize) -> f64) -> Self;
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

impl Number for f64 {
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
    fn if_less(self, other: Self, a: Self, b: Self) -> Self {
        if self < other { a } else { b }
    }
    #[inline(always)]
    fn constants(self, value: impl Fn(usize) -> f64) -> Self {
        value(0)
    }
}
