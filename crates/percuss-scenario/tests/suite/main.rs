//! All integration tests of the crate in one program: linking one for each file took gigabytes and minutes.

mod actions;
mod allow;
mod at_rest;
mod checkpoints;
mod codes;
mod common;
mod contacts;
mod everything;
mod faults;
mod files_at_fault;
mod heeded;
mod hints;
mod laws;
mod overrides;
mod profiles;
mod robustness;
mod schema;
mod structures;
mod tables;
mod templates;
mod units;
mod vary;
mod violent;
mod yielding;
