//! Mathematics that knows nothing of beams.

pub mod hermite;
pub mod path;
pub mod roots;
pub mod spline;
pub mod vec2;
