//! Materials.

pub use crate::element::fibre::{Hardening, Inelasticity, Overstress, Plasticity, Slack};
pub use crate::element::strain::StrainMeasure;

/// Material of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The user's name for it.
    pub name: String,
    /// Young's modulus E \[Pa\].
    pub young: f64,
    /// Density rho \[kg/m^3\].
    pub density: f64,
    /// Strain measure of its strain energy.
    pub strain: StrainMeasure,
    /// Retardation time of Kelvin-Voigt damping \[s\]: stresses grow by this time the rate of strains' share.
    pub retardation: f64,
    /// Mass-proportional damping, force per mass and velocity \[1/s\].
    pub mass_damping: f64,
    /// What it does beyond Hooke's law; beams of such a material are made of fibres.
    pub inelasticity: Option<Inelasticity>,
}

impl Material {
    /// An undamped material in the paper's strain measure.
    pub fn new(name: impl Into<String>, young: f64, density: f64) -> Self {
        Self {
            name: name.into(),
            young,
            density,
            strain: StrainMeasure::Green,
            retardation: 0.0,
            mass_damping: 0.0,
            inelasticity: None,
        }
    }
}
