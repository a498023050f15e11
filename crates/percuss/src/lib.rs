//! Percuss: impact on geometrically exact beams, with an energy and momentum balance after every step.
//!
//! Define beams, supports, projectiles and loads with a [`ModelBuilder`], freeze them into a [`Model`], and [`simulate`] it under [`Settings`]:
//! rows go to a [`Recorder`], the result is a [`RunSummary`]. [`Simulation`] advances a run in single steps. The library has no file or terminal
//! output; all quantities are SI.
//!
//! Conventions: primes are derivatives with respect to arc length of the reference, J turns by +90 degrees,
//! `a x b = a1 b2 - a2 b1`, `g = x'`, `p = x''`. A node's degrees of freedom are (u1, u2, u1', u2').

mod analysis;
#[allow(missing_docs)] // used only by `internals`
mod contact;
mod element;
mod error;
mod frame;
#[allow(missing_docs)] // used only by `internals`
mod geometry;
pub mod inspect;
mod ledger;
#[allow(missing_docs)] // used only by `internals`
mod linalg;
pub mod math;
mod measures;
mod model;
mod run;
#[allow(missing_docs)] // used only by `internals`
mod scalar;
mod settings;
mod state;
mod step;
mod summary;

/// Version and a hash of the sources of this crate, which distinguishes builds of the same version.
pub const BUILD: &str = env!("PERCUSS_BUILD");

pub use analysis::{
    BucklingMode, BucklingOutcome, Equilibrium, FailureKind, FollowerStability, JustTouching,
    LargestDisplacement, LinearBuckling, Mode, ModeKind, Path, PathPoint, PathRecorder, PathYield,
    SlackMember, StaticBalance, StaticContact, StaticFailure, StaticFirstYield, StaticFoundation,
    StaticYielding, StopState, buckling, buckling_in_contact, equilibrium, equilibrium_in,
    equilibrium_path, equilibrium_path_recorded, mechanisms, modes_about, modes_about_equilibrium,
    natural_frequencies, slack_members, stops,
};
pub use error::{Error, RecorderError};
pub use frame::{Frame, FrameForce, SectionPoint};
pub use geometry::dents::CarriedCrush;
pub use ledger::{Ledger, Measures};
pub use model::*;
pub use percuss_codes::{AnalysisCode, Caution};
pub use run::{
    Channel, Checkpoint, FirstTouches, Flow, MemoryRecorder, NoRecorder, Preview, Recorder,
    ResumeError, RunStatus, Simulation, first_step, massless, preview, reference_state, simulate,
    yielded_at_rest,
};
pub use settings::{
    ImpactResolution, MultipleImpacts, PathEnd, PathSettings, Scheme, Settings, Start,
};
pub use state::{PairState, ProjectileState, State};
pub use step::effective_mass::EffectiveMass;
pub use step::newton::Effort;
pub use summary::*;

/// Functions used by `percuss-batch` and tests, by the modules of this crate: not part of the interface, and subject to change.
#[doc(hidden)]
pub mod internals {
    /// The names of modules of this crate.
    macro_rules! open {
        ($($name:ident)*) => {
            $(pub mod $name {
                pub use crate::$name::*;
            })*
        };
    }
    open!(contact element geometry ledger linalg run scalar settings state step);
    pub mod section_forces {
        pub use crate::analysis::section_forces::*;
    }
    pub mod model {
        pub mod frozen {
            pub use crate::model::frozen::*;
        }
    }
}

#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct ReadmeExamples;
