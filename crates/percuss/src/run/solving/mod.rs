//! Solution of parts of steps, which reads the state and does not write it.
//!
//! The [`decider`] sets the parts of a step from the status of contacts ([`contact_status`]); a [`solver`] has the data for their solution. Each is
//! solved ([`solve`], [`passage`]) up to the first contact ([`locate`]), at impact ([`strike`], [`sequence`]), accumulated ([`accumulated`]) or at
//! a jump of prescribed velocities ([`jumps`]). Its results belong to it ([`trial`]), until it is accepted ([`accept`], [`parting`]): only there
//! the state is written.

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
