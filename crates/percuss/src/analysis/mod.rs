//! Analyses: what is done with steps.

mod channels;
mod impacts;
mod modes;
mod monitor;
mod section_forces;
mod simulation;

pub use modes::natural_frequencies;
pub use simulation::{Simulation, simulate};
