//! Writes the book of Percuss: references from the declarations that read the files, pages whose commands were run.

mod bounds;
mod excerpts;
mod scenario_pages;

pub use bounds::{Bounds, bounds};
pub use excerpts::{Excerpt, Sample, Standing, samples, standings};
pub use scenario_pages::{Page, missing_examples, reference_pages};
