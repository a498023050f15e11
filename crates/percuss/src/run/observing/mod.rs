//! What accepted parts of steps are shown to, in any order: each looks at how a part began, what it came to and where it ended.
//!
//! [`monitor`] gathers what the summary tells, [`step_size`] says how long the next step may be.

pub mod connector_log;
pub mod contact_log;
#[allow(missing_docs)]
pub mod crest;
pub mod first_step;
pub mod given;
pub mod joint_log;
pub mod monitor;
pub mod status;
pub mod step_size;
mod stop_log;
mod struck_mass;
pub mod yielding;
