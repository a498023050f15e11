//! Energies and momenta.

use serde::{Deserialize, Serialize};

use super::numbers::of_numbers;
use crate::element::motion::ElementMeasures;
use crate::math::vec2::{add, cross};
use crate::scalar::Number;

/// Energies and momenta of a state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measures<S = f64> {
    /// Kinetic energy of the beams \[J\].
    pub kinetic_beams: S,
    /// Kinetic energy of the projectiles \[J\].
    pub kinetic_projectiles: S,
    /// Axial strain energy \[J\].
    pub strain_axial: S,
    /// Bending strain energy, of shear-flexible beams with that of shear \[J\].
    pub strain_bending: S,
    /// Shear strain energy of shear-flexible beams, a part of `strain_bending` \[J\].
    pub strain_shear: S,
    /// Energy that hardening has stored \[J\].
    pub hardening: S,
    /// Energy of the contact springs \[J\].
    pub contact: S,
    /// Energy of springs, elastic supports, stops and foundations \[J\].
    pub springs: S,
    /// Linear momentum, shape (2) \[kg m/s\].
    pub linear: [S; 2],
    /// Angular momentum about the origin \[kg m^2/s\].
    pub angular: S,
    /// Largest distance of a stored bending strain from that of the configuration \[1/m\].
    pub curvature_drift: S,
    /// Largest distance of a stored membrane strain from that of the configuration \[-\].
    pub membrane_drift: S,
    /// Kinetic energy with the angular rates that follow from the slopes' velocities, less that with the sections' own rates, which is
    /// conserved \[J\].
    pub angular_rate_drift: S,
    /// Sum of the magnitudes of the bodies' linear momenta and of the elements', these by components \[kg m/s\], a scale: for opposite motions the
    /// total momentum vanishes although its parts do not.
    pub linear_size: S,
    /// Sum of the distances from the origin times momenta, and of couples, all by their components' magnitudes \[kg m^2/s\], a scale: a body that
    /// moves straight towards the origin has no angular momentum although its components have.
    pub angular_size: S,
}

impl<S: Number> Measures<S> {
    /// Total energy \[J\].
    #[inline(always)]
    pub fn total(&self) -> S {
        self.kinetic_beams
            + self.kinetic_projectiles
            + self.strain_axial
            + self.strain_bending
            + self.hardening
            + self.contact
            + self.springs
    }

    /// Adds sums over elements.
    #[doc(hidden)]
    #[inline(always)]
    pub fn add_beams(&mut self, sums: &ElementMeasures<S>) {
        self.kinetic_beams += (sums.translation + sums.rotation) * 0.5;
        self.angular_rate_drift += sums.rate_drift * 0.5;
        self.strain_axial += sums.axial * 0.5;
        self.strain_bending += sums.bending * 0.5;
        self.linear = add(self.linear, sums.linear);
        self.angular += sums.angular;
        self.linear_size += sums.linear_size;
        self.angular_size += sums.angular_size;
    }

    /// Adds the momentum of a body at `x`, and the angular momentum of its rotation.
    #[doc(hidden)]
    #[inline(always)]
    pub fn add_momentum(&mut self, x: [S; 2], linear: [S; 2], turning: S) {
        self.linear = add(self.linear, linear);
        self.angular += cross(x, linear) + turning;
        self.linear_size += linear[0].hypot(linear[1]);
        self.angular_size += size(x) * size(linear) + turning.abs();
    }
}

of_numbers! {
    Measures: kinetic_beams kinetic_projectiles strain_axial strain_bending strain_shear hardening contact springs angular curvature_drift
        membrane_drift angular_rate_drift linear_size angular_size;
    linear
}

/// Sum of the components' magnitudes.
#[inline(always)]
fn size<S: Number>(v: [S; 2]) -> S {
    v[0].abs() + v[1].abs()
}
