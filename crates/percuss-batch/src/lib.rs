//! Many runs of Percuss, and runs with their derivatives: [`simulate_batch`] and [`sensitivities`].
//!
//! Ensembles: runs of one shape in SIMD lanes, one run per lane, or one run with its derivatives.
//!
//! The mechanics, element kernels and convergence tests are those of [`Simulation`](percuss::Simulation), for the models of most studies: beams and
//! frames, elastic, damped or yielding, struck by guided projectiles and under dead loads ([`shape`] checks this). The code is generic over
//! [`Number`](percuss::internals::scalar::Number): lanes for speed, dual numbers for derivatives. Lanes are independent, so a run gives the same
//! bits alone and beside others.

#![allow(rustdoc::private_intra_doc_links)] // the crate's description links its private modules

mod band;
mod batch;
mod column;
mod commit;
mod constraints;
mod derivative_run;
mod detail;
mod drive;
mod engine;
mod fibres;
mod grazing;
mod ground_springs;
mod horizon;
mod impact;
mod known_columns;
mod lane;
mod law;
mod ledger;
mod loads;
mod log;
mod newton;
mod numbers;
mod reactions;
mod rigid_log;
mod run;
mod run_progress;
mod saved_lanes;
mod sections;
mod sensitivity;
mod shape;
mod slopes;
mod summary;
mod value_solver;
mod yield_log;

/// Version and a hash of the sources of this crate, as [`percuss::BUILD`] is of those that it builds on.
pub const BUILD: &str = env!("PERCUSS_BUILD");

pub use batch::simulate_batch;
pub use column::{ColumnSample, ColumnValue, simulate_with_columns};
pub use detail::Detail;
pub use grazing::{Grazing, Onset};
pub use horizon::Horizon;
pub use known_columns::has_derivatives;
pub use run::runs_alone;
pub use sensitivity::{
    SampleDerivatives, Sensitivities, Undifferentiated, sensitivities, sensitivities_with_columns,
};
pub use slopes::{Difference, Variation};
