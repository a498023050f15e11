//! Verification of Percuss: results compared with closed forms, published values and independently computed references.
//!
//! A case is a function that returns its [`Report`]; its documentation names the source of every expected number. The same
//! cases run in the test suite and in `percuss verify`.

mod beams;
mod catalogue;
mod check;
mod conservation;
mod cradle;
mod elastic;
mod ends;
mod foundation;
mod heat;
mod interaction;
mod layered;
mod motion;
mod plastic_bars;
mod plastic_bending;
mod published_motion;
mod published_statics;
mod rigid;
mod rigid_plastic;
mod scene;
mod section_forces;
mod shear;
mod shear_impact;
mod shear_reissner;
mod sliding;
mod stability;
mod statics;
mod stops;
mod strength;
mod structure;
mod structures;
mod surface;
mod thrust;
mod vibration;
mod waves;
mod yielding;
mod yielding_joints;

pub use catalogue::CASES;
pub use check::{Check, Curve, Figure, Report, Tolerance, observed_order};

/// A verification case.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Short name, unique.
    pub id: &'static str,
    /// Title: the verified property.
    pub title: &'static str,
    /// Source of the expected numbers.
    pub source: &'static str,
    /// Function that runs the case.
    pub run: fn() -> Report,
}
