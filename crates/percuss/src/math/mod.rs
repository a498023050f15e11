//! Mathematics that knows nothing of beams.

pub mod hermite;
pub mod roots;
pub mod vec2;
