//! A transient run.
//!
//! [`step`] is one step: its parts are solved and accepted ([`solving`]), passed to the observers of the summary ([`observing`]), and recorded
//! ([`recording`]). [`simulation`] connects these, and none of them depends on it.

mod first_touch;
mod giving_up;
mod observing;
mod preview;
mod recording;
mod simulation;
mod solving;
mod start;
pub mod step;
mod summarize;

pub use first_touch::FirstTouches;
pub use observing::first_step::first_step;
pub use observing::status::RunStatus;
pub use observing::yielding::yielded_at_rest;
pub use observing::{contact_log, crest, yielding};
pub use preview::{Preview, preview};
pub use recording::channels::Channel;
pub use recording::checkpoint::{Checkpoint, ResumeError};
pub use recording::record::{Flow, MemoryRecorder, NoRecorder, Recorder};
pub use simulation::{Simulation, reference_state, simulate};
pub use solving::{decider, locate, strike};
pub use start::massless;
