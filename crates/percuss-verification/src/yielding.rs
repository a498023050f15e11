//! Common parts of the cases of beams that yield.

use percuss::*;

use crate::check::Checks;

/// A material that yields, perfectly plastic: Young's modulus \[Pa\], density \[kg/m^3\], yield stress \[Pa\].
/// It uses engineering strains, as the closed forms of the literature.
pub fn perfect(young: f64, density: f64, stress: f64) -> Material {
    yields(young, density, vec![Hardening { from: 0.0, stress, modulus: 0.0 }], |_| {})
}

/// A material with a hardening curve; `change` modifies it.
pub fn yields(
    young: f64,
    density: f64,
    curve: Vec<Hardening>,
    change: impl FnOnce(&mut Plasticity),
) -> Material {
    let mut plasticity =
        Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain: None };
    change(&mut plasticity);
    Material {
        strain: StrainMeasure::Engineering,
        inelasticity: Some(Inelasticity::Plastic(plasticity)),
        ..Material::new("metal", young, density)
    }
}

/// Checks that the run is complete, and its energy balance.
pub fn balances(c: &mut Checks, name: &str, summary: &RunSummary) {
    let residual = match summary.termination {
        Termination::Completed => summary.energy.residual_max,
        _ => f64::NAN,
    };
    c.at_most(format!("{name}: energy residual"), residual, 1e-10);
}
