//! The scalar the element kernels are written over: `f64` today; lanes and dual numbers fit the same trait.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

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
    /// The constant `value`.
    fn constant(value: f64) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Reciprocal.
    #[inline(always)]
    fn recip(self) -> Self {
        Self::constant(1.0) / self
    }
}

impl Real for f64 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
}
