//! One step: predict, iterate, commit, measure.
//!
//! [`integration`] says what a scheme makes of an increment, [`assemble`] sums residual and tangent, [`tangent`]
//! factors and solves them with their border of constraints, [`newton`] iterates
//! ([`contacts`] couples projectiles in, [`watch`] says when to stop), [`commit`] is the only writer of
//! [`State`](crate::state::State).

pub mod assemble;
pub mod commit;
pub mod constraint;
pub mod contacts;
pub mod external;
pub mod integration;
pub mod newton;
pub mod tangent;
pub mod watch;
pub mod workspace;
