//! Parts of steps: what solves them sees the state and writes none of it.
//!
//! The [`decider`] says what the parts of a step are, told where contacts stand ([`contact_status`]); a [`solver`] has what they are
//! solved with. Each is solved ([`solve`], [`passage`]) up to the first contact ([`locate`]), at impact ([`strike`], [`sequence`]), accumulated ([`accumulated`]) or at a jump of prescribed velocities
//! ([`jumps`]). What it came to goes with it ([`trial`]), until it is accepted ([`accept`], [`parting`]): only there the state is written.

pub mod accept;
mod accumulated;
mod contact_status;
pub mod decider;
pub mod jumps;
pub mod locate;
mod parting;
mod passage;
mod sequence;
mod solve;
pub mod solver;
pub mod strike;
#[allow(missing_docs)]
pub mod trial;
