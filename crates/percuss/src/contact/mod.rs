//! Contact between projectiles and the points they strike.

pub mod effective_mass;
pub mod impact;
pub mod law;
