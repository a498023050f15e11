//! One step: predict, iterate, commit, measure.
//!
//! [`integration`] says what a scheme makes of an increment, [`assemble`] sums residual and tangent ([`sweep`]: elements side by side), [`tangent`]
//! factors and solves them with what ties beams together ([`constraint`], [`connectors`]), [`newton`] iterates
//! ([`contacts`] couples projectiles in, [`convergence`] says when to stop), [`commit`] is the only writer of
//! [`State`](crate::state::State).

pub mod assemble;
pub mod bodies;
pub mod columns;
pub mod commit;
pub mod condensed_bodies;
pub mod connectors;
pub mod constraint;
pub mod contacts;
pub mod convergence;
pub mod effective_mass;
pub mod external;
pub mod fibres;
pub mod flows;
pub mod forcing;
mod impulses;
pub mod integration;
pub mod joints;
pub mod lead;
pub mod masses;
pub mod modal_damping;
pub mod newton;
pub mod projection;
pub mod sweep;
pub mod tangent;
pub mod workspace;
