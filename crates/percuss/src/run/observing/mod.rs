//! Observers of accepted parts of steps, independent of each other: each uses the start, the solution and the end of a part.
//!
//! [`monitor`] collects the data of the summary, [`step_size`] determines the length of the next step.

pub mod connector_log;
pub mod contact_log;
#[allow(missing_docs)]
pub mod crest;
pub mod first_step;
pub mod foundation_log;
pub mod given;
pub mod joint_log;
pub mod monitor;
mod pulses;
pub mod status;
pub mod step_size;
mod stop_log;
mod struck_mass;
pub mod yielding;
