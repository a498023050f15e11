//! Shear stiffness of slender beams, which their mechanics does without.

use super::formulas::{SHEAR_AREA, shear_stiffness};
use super::structure::BeamPlace;

/// Shear stiffness that a slender beam would have at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeglectedShear {
    /// Shear stiffness kappa G A \[N\].
    pub stiffness: f64,
    /// Whether it is that of its material and its section; else that of a solid rectangle, without a given shear modulus with Poisson's ratio 0.3.
    pub known: bool,
}

impl NeglectedShear {
    /// Of a place of a beam.
    pub fn at(place: &BeamPlace<'_>) -> Self {
        let span = place.beam.span_at(place.s);
        let section = span.section_at(place.s);
        let known = section.shear.is_finite();
        let stiffness = match span.shear_modulus() {
            _ if known => section.shear,
            Some(modulus) => SHEAR_AREA * modulus * section.area,
            None => shear_stiffness(section.axial),
        };
        Self { stiffness, known }
    }

    /// What it is based on, in brackets.
    pub fn basis(self) -> &'static str {
        match self.known {
            true => "(with the shear stiffness of its material and section)",
            false => {
                "(for a solid rectangle; about twice as much for a tube, two to three times for an I-section)"
            }
        }
    }
}
