//! Analyses: what is done with steps.

mod channels;
mod impacts;
mod modes;
mod monitor;
mod section_forces;
mod simulation;
mod statics;

pub use modes::natural_frequencies;
pub use simulation::{Simulation, simulate};
pub use statics::{Equilibrium, equilibrium, mechanism};
