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
    /// Thermal expansion, strain per change of temperature \[1/K\].
    pub expansion: f64,
    /// Behaviour beyond Hooke's law; beams of such a material have fibre sections.
    pub inelasticity: Option<Inelasticity>,
    /// Usual yield stresses, if known. They have no effect on the mechanics: larger stresses of an elastic material are reported.
    pub strength: Option<Strength>,
    /// Strain at the largest force of a tension test (uniform strain), if known \[-\]. It has no effect on the mechanics: larger plastic strains of a
    /// material without failure strain are reported.
    pub uniform_strain: Option<f64>,
    /// Poisson's ratio, of which only shear-flexible beams make use.
    pub poisson: Option<f64>,
    /// Shear modulus G, if it is not that of an isotropic material \[Pa\]. Beside a Poisson's ratio it must be that of an isotropic material
    /// within 2 %, and acts.
    pub shear_modulus: Option<f64>,
}

/// Stresses up to which a material is elastic, or whole; infinite where unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strength {
    /// In tension \[Pa\].
    pub tension: f64,
    /// In compression, its magnitude \[Pa\].
    pub compression: f64,
}

impl Strength {
    /// Whether a stress exceeds it.
    pub fn is_passed(&self, stress: f64) -> bool {
        stress > self.tension || stress < -self.compression
    }
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
            expansion: 0.0,
            inelasticity: None,
            strength: None,
            uniform_strain: None,
            poisson: None,
            shear_modulus: None,
        }
    }
}
