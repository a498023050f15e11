//! Parts of steps: what solves them sees the state and writes none of it.
//!
//! A [`solver`] has what parts are solved with. Each is solved ([`solve`], [`passage`]) as its contacts ask for ([`contact_status`]), up to
//! the first contact ([`locate`]), at impact ([`strike`], [`sequence`]), accumulated ([`accumulated`]) or at a jump of prescribed velocities
//! ([`jumps`]). What it came to goes with it ([`trial`]), until it is accepted ([`accept`], [`parting`]): only there the state is written.

pub mod accept;
mod accumulated;
pub mod budget;
pub mod contact_status;
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
