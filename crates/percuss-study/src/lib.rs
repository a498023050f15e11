//! Studies: many runs of one scenario, some of whose values change from run to run.
//!
//! A [`Study`] says everything: the base scenario's text, what varies, which combinations are run and which results are
//! wanted. Its runs are numbered, and run `i` depends on the study and on `i` alone. Runs are done in shards:
//! [`Study::run_shard`] is a pure function of the study and the shard's number, with the same bits on any number of threads and
//! on any machine of one kind, so whoever runs shards, threads here or a cluster elsewhere, gets the same table.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let text = r#"
//!     scenario = """
//! [material.m]
//! preset = "steel"
//! [section.s]
//! shape = "rectangle"
//! width = 0.1
//! depth = 0.1
//! [beam.b]
//! points = [[0, 0], [1, 0]]
//! elements = 2
//! material = "m"
//! section = "s"
//! [support.left]
//! at = "b.start"
//! kind = "clamp"
//! [projectile.p]
//! kind = "elastic"
//! mass = 1
//! stiffness = 1e5
//! velocity = [0, 1]
//! strikes = "b.end"
//! [time]
//! end = 1e-3
//! step = 1e-4
//! """
//!     [parameter.speed]
//!     path = "projectile.p.velocity[1]"
//!     range = { from = "1 m/s", to = "2 m/s", count = 3 }
//!     [design]
//!     kind = "grid"
//!     [results]
//!     peak_force = "contact.p.peak_force.value"
//! "#;
//! let study = percuss_study::Study::from_toml(text, "study.toml")?;
//! assert_eq!(study.run_count(), 3);
//!
//! // On a worker: the study as one text, the shard's number; back come bytes.
//! let remote = percuss_study::Study::from_toml(&study.to_toml(), "study.toml")?;
//! let bytes = remote.run_shard(0).to_parquet(&remote)?;
//!
//! // At home: shards in the order of their numbers make the table of the study.
//! let shard = percuss_study::Shard::from_parquet(&bytes, &study)?;
//! let mut table = Vec::new();
//! percuss_study::merge(&study, [Ok(shard)], &mut table)?;
//! # Ok(())
//! # }
//! ```
//!
//! [`Folder`] keeps shards on disk so that a study goes on where it was, [`sweep()`] fills it on all cores, [`analysis`] and
//! [`report()`] say what came out. The crate knows no terminal.

pub mod analysis;
mod column;
mod columns;
mod converge;
mod design;
mod detail;
mod distribution;
mod error;
mod folder;
mod function;
mod history_columns;
mod indices;
mod jacobian;
mod means;
mod merge;
mod parameter;
mod parquet;
mod prepare;
mod report;
mod resolve;
mod result_path;
mod seal;
mod sensitivity;
mod shard;
mod study;
mod sweep;
mod workers;

pub use column::{Column, Role, Table, Values};
pub use columns::{ColumnJacobian, column_jacobian, column_values};
pub use converge::{
    Cheapest, ConvergeError, Converged, Convergence, Extrapolation, Ladder, Refined, Sequence,
    converge, extrapolate,
};
pub use design::latin_hypercube;
pub use distribution::{Distribution, Gauss, Truncation};
pub use error::Error;
pub use folder::{Folder, KEPT, REPORT, RESULTS};
pub use function::{Evaluated, Function};
pub use indices::{INDICES, indices, indices_parquet};
pub use jacobian::Jacobian;
pub use means::Means;
pub use merge::merge;
pub use parameter::{Input, Parameter, Variation};
pub use parquet::read_table;
pub use percuss_batch::{ColumnSample, ColumnValue};
pub use prepare::{Invalid, in_one_line};
pub use report::report;
pub use result_path::{ColumnPath, ResultPath};
pub use sensitivity::{
    Differentiated, OneSided, Sensitivity, SensitivityError, Without, beyond, sensitivity,
};
pub use shard::Shard;
pub use study::{ResultColumn, Study};
pub use sweep::{Done, Progress, sweep};
pub use workers::Workers;
