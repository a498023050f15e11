//! From definitions to the frozen [`Model`].

mod builder;
mod check;
mod constrain;
mod definition;
mod fault;
pub(crate) mod frozen;
mod time_function;

pub use builder::ModelBuilder;
pub use definition::*;
pub use fault::Fault;
pub use frozen::Model;
pub use time_function::{Function, TimeFunction};
