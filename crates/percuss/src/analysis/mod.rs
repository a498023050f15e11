//! Analyses at rest: equilibria and load paths, modes, buckling, section forces.

mod balance;
mod buckling;
mod course;
pub(crate) mod damped_modes;
mod ends;
mod equilibrium;
pub(crate) mod equivalent;
mod failure;
mod flutter;
pub(crate) mod foundations;
mod largest_displacement;
mod lost;
pub(crate) mod modes;
mod path;
pub mod section_forces;
mod slack;
mod spectrum;
mod stability;
pub(crate) mod static_contacts;
mod static_loading;
pub(crate) mod static_search;
mod statics;
mod unloading;
mod yields;

pub use balance::StaticBalance;
pub use buckling::{
    BucklingMode, BucklingOutcome, JustTouching, LinearBuckling, buckling, buckling_in_contact,
};
pub use course::StaticFirstYield;
pub use equilibrium::Equilibrium;
pub use failure::{FailureKind, StaticFailure};
pub use flutter::FollowerStability;
pub use foundations::StaticFoundation;
pub use largest_displacement::LargestDisplacement;
pub use modes::{Mode, ModeKind, modes_about, modes_about_equilibrium, natural_frequencies};
pub use path::{Path, PathPoint, PathRecorder, equilibrium_path, equilibrium_path_recorded};
pub use slack::{SlackMember, StopState, slack_members, stops};
pub use static_contacts::StaticContact;
pub use statics::{equilibrium, equilibrium_in, mechanisms};
pub(crate) use unloading::{permanent_sets, set_beside};
pub use yields::{PathYield, StaticYielding};
