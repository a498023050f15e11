//! Analyses: what is done with steps.

mod channels;
mod impacts;
mod monitor;
mod simulation;

pub use simulation::{Simulation, simulate};
