//! A transient run.
//!
//! [`step`] is one step: its parts are solved ([`solve`], [`passage`]) as their contacts ask for ([`contact_status`]), up to the
//! first contact ([`locate`]), at impact ([`strike`], [`sequence`]), accumulated ([`accumulated`]) or at a jump of prescribed
//! velocities ([`jumps`]), and accepted ([`trial`]). [`monitor`] gathers what the summary tells.

mod accept;
mod accumulated;
mod budget;
mod channels;
mod checkpoint;
mod connector_log;
pub mod contact_log;
pub mod contact_status;
#[allow(missing_docs)]
pub mod crest;
mod first_step;
mod first_touch;
mod frame;
mod given;
mod giving_up;
mod joint_log;
mod jumps;
pub mod locate;
mod monitor;
mod parting;
mod passage;
mod preview;
pub mod record;
mod rows;
mod sequence;
mod simulation;
mod solve;
mod solver;
mod start;
mod status;
pub mod step;
mod step_size;
mod stop_log;
pub mod strike;
mod struck_mass;
mod summarize;
#[allow(missing_docs)]
pub mod trial;
pub mod yielding;

pub use channels::Channel;
pub use checkpoint::{Checkpoint, ResumeError};
pub use first_step::first_step;
pub use first_touch::FirstTouches;
pub use preview::{Preview, preview};
pub use record::{Flow, MemoryRecorder, NoRecorder, Recorder};
pub use simulation::{Simulation, reference_state, simulate};
pub use start::massless;
pub use status::RunStatus;
pub use yielding::yielded_at_rest;
