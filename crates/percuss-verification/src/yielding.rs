//! What the cases of beams that yield share.

use percuss::*;

use crate::check::Checks;

/// A material that yields, perfectly plastic: Young's modulus \[Pa\], density \[kg/m^3\], yield stress \[Pa\].
///
/// Its strains are those of engineering, in which closed forms of the literature are written.
pub fn perfect(young: f64, density: f64, stress: f64) -> Material {
    yields(young, density, vec![Hardening { from: 0.0, stress, modulus: 0.0 }], |_| {})
}

/// A material that yields along a hardening curve; `change` may add to it.
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

/// The run ended, and its balance of energy closes.
pub fn balances(c: &mut Checks, name: &str, summary: &RunSummary) {
    let residual = match summary.termination {
        Termination::Completed => summary.energy.residual_max,
        _ => f64::NAN,
    };
    c.at_most(format!("{name}: energy residual"), residual, 1e-10);
}
