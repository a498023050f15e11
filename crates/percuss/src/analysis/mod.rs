//! Analyses: what is done with steps.

mod channels;
mod impacts;
mod modes;
mod monitor;
mod simulation;

pub use modes::natural_frequencies;
pub use simulation::{Simulation, simulate};
