//! Mathematics that knows nothing of beams.

pub mod hermite;
pub(crate) mod interpolant;
pub(crate) mod roots;
pub(crate) mod spline;
pub mod vec2;
