//! Mathematics, independent of beams.

pub mod hermite;
#[doc(hidden)]
pub mod interpolant;
#[doc(hidden)]
pub mod roots;
pub(crate) mod spline;
pub mod vec2;
