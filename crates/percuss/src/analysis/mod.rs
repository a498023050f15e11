//! Analyses: what is done with steps.

mod accumulation;
mod batch;
mod buckling;
mod channels;
mod contact_log;
pub(crate) mod crest;
mod flutter;
mod frame;
mod given;
mod giving_up;
mod impacts;
mod jumps;
mod modes;
mod monitor;
mod multiple_impacts;
mod path;
mod preview;
mod section_forces;
mod simulation;
mod spectrum;
mod start;
mod static_contacts;
mod static_search;
mod statics;
mod struck_mass;
mod trial;

pub use batch::{Detail, simulate_batch};
pub use buckling::{BucklingMode, BucklingOutcome, LinearBuckling, buckling, buckling_in_contact};
pub use flutter::FollowerStability;
pub use modes::{Mode, ModeKind, modes_about, modes_about_equilibrium, natural_frequencies};
pub use path::{Path, PathPoint, equilibrium_path};
pub(crate) use preview::{Preview, preview};
pub use simulation::{Simulation, simulate};
pub use start::{massless, reference_state};
pub use static_contacts::StaticContact;
pub use statics::{Equilibrium, equilibrium, equilibrium_in, mechanisms};
