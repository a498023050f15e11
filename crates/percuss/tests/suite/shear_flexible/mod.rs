//! Shear-flexible beams: closed forms, balances, and what they share with slender ones.

mod axial_force;
mod impacts;
mod inside;
mod motion;
mod statics;
mod vibrations;

use crate::common;

use common::*;
use percuss::*;

/// A beam along the first axis.
fn shear(length: f64, elements: usize, material: MaterialId, section: SectionId) -> Beam {
    let slender = beam("arm", [0.0, 0.0], [length, 0.0], elements, material, section);
    Beam { theory: Theory::Shear, ..slender }
}

fn isotropic(young: f64, density: f64, poisson: f64) -> Material {
    Material { poisson: Some(poisson), ..Material::new("m", young, density) }
}

fn worst(summary: &RunSummary) -> f64 {
    let m = &summary.momentum;
    summary.energy.residual_max.max(m.linear_residual_max).max(m.angular_residual_max)
}

fn run(model: &Model, settings: &Settings) -> RunSummary {
    let summary = simulate(model, settings, &mut NoRecorder).unwrap();
    assert!(matches!(summary.termination, Termination::Completed), "{summary:?}");
    summary
}
