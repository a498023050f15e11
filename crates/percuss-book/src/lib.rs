//! Writes the book of Percuss: references from the declarations that read the files, pages whose commands were run.

mod book;
mod bounds;
mod code_pages;
mod excerpts;
mod fences;
mod gallery;
mod links;
mod maths;
mod measured;
mod running;
mod sandbox;
mod scenario_pages;

pub use book::{Sources, authored, build};
pub use bounds::{Bounds, bounds};
pub use code_pages::{Provocations, Provoked};
pub use excerpts::{Excerpt, Sample, TableUse, samples, table_uses};
pub use fences::{Fence, Part, parts};
pub use gallery::{GallerySection, Scene, is_shown, left_out, sections};
pub use links::broken;
pub use maths::set;
pub use running::{Effort, run};
pub use sandbox::{Outcome, Sandbox};
pub use scenario_pages::{Page, missing_examples, reference_pages};
