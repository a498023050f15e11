//! Mathematics that knows nothing of beams.

pub mod hermite;
pub mod roots;
pub mod spline;
pub mod vec2;
