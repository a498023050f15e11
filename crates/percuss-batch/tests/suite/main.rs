//! All integration tests of the crate in one program: linking one for each file takes gigabytes and minutes.

mod columns;
#[path = "../../../percuss/tests/suite/common/mod.rs"]
mod common;
mod crushing;
mod ensembles;
mod joined_ensembles;
mod rigid_ensembles;
mod scales;
mod section_forces;
mod sensitivities;
mod yielding_ensembles;
