//! All integration tests of the crate in one program, with the definitions that those of the mechanics use.

mod advice;
mod advice_depth;
mod advice_resolution;
#[path = "../../../percuss/tests/suite/common/mod.rs"]
mod common;
mod hand_formulas;
mod shear_flexible;
