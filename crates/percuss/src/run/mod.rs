//! A transient run.
//!
//! [`step`] is one step: [`decider`] says what its parts are, told where contacts stand ([`contact_status`]); they are solved ([`solve`],
//! [`passage`]) up to the first contact ([`locate`]), at impact ([`strike`], [`sequence`]), accumulated ([`accumulated`]) or at a jump of prescribed
//! velocities ([`jumps`]), and accepted ([`trial`]). [`monitor`] gathers what the summary tells.

mod accumulated;
mod channels;
mod checkpoint;
mod connector_log;
pub mod contact_log;
mod contact_status;
#[allow(missing_docs)]
pub mod crest;
pub mod decider;
mod first_step;
mod first_touch;
mod frame;
mod given;
mod giving_up;
mod joint_log;
mod jumps;
pub mod locate;
mod monitor;
mod pace;
mod parting;
mod passage;
mod preview;
pub mod record;
mod rows;
mod sequence;
mod simulation;
mod solve;
mod start;
mod step;
mod step_size;
mod stop_log;
pub mod strike;
mod struck_mass;
mod summarize;
#[allow(missing_docs)]
pub mod trial;
pub mod yielding;

pub use checkpoint::{Checkpoint, ResumeError};
pub use first_step::first_step;
pub use first_touch::FirstTouches;
pub use pace::Pace;
pub use preview::{Preview, preview};
pub use record::{Channel, Flow, MemoryRecorder, NoRecorder, Recorder};
pub use simulation::{Simulation, simulate};
pub use start::{massless, reference_state};
pub use yielding::yielded_at_rest;
