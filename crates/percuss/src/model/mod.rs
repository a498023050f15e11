//! From definitions to the frozen [`Model`].

#[allow(missing_docs)]
pub(crate) mod acting;
mod bodies;
mod build;
mod builder;
mod centre_line;
mod check;
mod connect;
mod constrain;
mod definition;
mod draw;
mod extent;
mod fault;
mod fibres;
mod foundation;
#[allow(missing_docs)]
pub(crate) mod founded;
#[allow(missing_docs)]
pub(crate) mod frozen;
mod hinge_mesh;
mod initial;
mod loads;
mod material_points;
mod mesh;
mod outline;
mod overlaps;
mod pairs;
mod path_steps;
mod places;
#[allow(missing_docs)]
pub(crate) mod point;
mod prescribed;
pub(crate) mod rotations;
pub mod scene;
mod section_line;
mod span_fibres;
#[allow(missing_docs)]
pub(crate) mod spans;
#[allow(missing_docs)]
pub(crate) mod striking;
#[allow(missing_docs)]
pub(crate) mod ties;
mod time_function;

pub use builder::ModelBuilder;
pub use definition::*;
pub use extent::ModelExtent;
pub use fault::Fault;
pub use frozen::Model;
pub use path_steps::{is_index, path_steps};
pub use time_function::{Function, TimeFunction};
#[doc(hidden)]
pub use time_function::{PreparedFunction, SAME_INSTANT};
