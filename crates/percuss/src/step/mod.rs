//! One step: predict, iterate, commit, measure.
//!
//! [`integration`] evaluates an increment in a scheme, [`assemble`] sums residual and tangent ([`sweep`]: elements in lanes), [`tangent`] factors
//! and solves them with the connections of beams ([`constraint`], [`connectors`]), [`newton`] iterates ([`contacts`] couples projectiles,
//! [`convergence`] decides when to stop), [`commit`] is the only writer of [`State`](crate::state::State).

// Items that only `internals` re-exports have no documentation.
#[allow(missing_docs)]
pub mod assemble;
#[allow(missing_docs)]
pub mod bodies;
#[allow(missing_docs)]
pub mod columns;
#[allow(missing_docs)]
pub mod commit;
#[allow(missing_docs)]
pub mod condensed_bodies;
#[allow(missing_docs)]
pub mod connectors;
#[allow(missing_docs)]
pub mod constraint;
#[allow(missing_docs)]
pub mod contacts;
#[allow(missing_docs)]
pub mod convergence;
#[allow(missing_docs)]
pub mod damping;
pub mod effective_mass;
#[allow(missing_docs)]
pub mod end_forces;
#[allow(missing_docs)]
pub mod external;
#[allow(missing_docs)]
pub mod fibres;
#[allow(missing_docs)]
pub mod flows;
#[allow(missing_docs)]
pub mod forcing;
pub mod given_strains;
mod impulses;
#[allow(missing_docs)]
pub mod integration;
#[allow(missing_docs)]
pub mod joints;
#[allow(missing_docs)]
pub mod lead;
#[allow(missing_docs)]
pub mod masses;
#[allow(missing_docs)]
pub mod modal_damping;
pub mod newton;
#[allow(missing_docs)]
pub mod projection;
#[allow(missing_docs)]
pub mod sweep;
#[allow(missing_docs)]
pub mod tangent;
#[allow(missing_docs)]
pub mod workspace;
