//! From definitions to the frozen [`Model`].

mod builder;
mod definition;
mod fault;

pub use builder::ModelBuilder;
pub use definition::*;
pub use fault::Fault;

/// What is simulated; never changes once built.
#[derive(Clone, Debug)]
pub struct Model {}
