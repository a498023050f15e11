//! Definitions of a user: plain structs for the [`ModelBuilder`](super::ModelBuilder).
//!
//! Names are those of the scenario file. All quantities are SI.

mod beam;
mod contact;
mod foundation;
mod line_point;
mod load;
mod material;
mod profile;
mod projectile;
mod rounding;
mod section;
mod shear;
mod support;
mod walls;

pub use beam::*;
pub use contact::*;
pub use foundation::*;
pub use line_point::*;
pub use load::*;
pub use material::*;
pub use profile::*;
pub use projectile::*;
pub use section::*;
pub use support::*;
pub use walls::*;

/// Index of a material, given by [`ModelBuilder::material`](super::ModelBuilder::material).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MaterialId(pub(crate) u32);

/// Index of a section, given by [`ModelBuilder::section`](super::ModelBuilder::section).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SectionId(pub(crate) u32);

/// Index of a beam, given by [`ModelBuilder::beam`](super::ModelBuilder::beam).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct BeamId(pub(crate) u32);
