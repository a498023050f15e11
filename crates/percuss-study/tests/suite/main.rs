//! All integration tests of the crate in one program: linking one for each file took gigabytes and minutes.

mod common;
mod convergence;
mod error_bars;
mod functions;
mod listed_points;
mod open_contacts;
mod sensitivities;
mod studies;
mod tables;
mod yielding;
