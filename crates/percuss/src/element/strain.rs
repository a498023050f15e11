//! Strains of a configuration, and their gradient coefficients.

use super::point::{SectionLaw, Strains, b_of};
use crate::math::vec2::{add, dot};
use crate::model::StrainMeasure;
use crate::scalar::Real;

/// Strains of the configuration with displacement gradient `slope` = u' and second derivative `bend` = x''.
///
/// Green: `eps = X'.u' + u'.u'/2`, `kappa = kappa0 - b/r`. Engineering: `eps = r - 1`, `kappa = kappa0 - b/a`.
/// Written through u', so that small strains lose no digits.
#[inline(always)]
pub fn strains<S: Real>(
    measure: StrainMeasure,
    tangent: [S; 2],
    curvature: S,
    slope: [S; 2],
    bend: [S; 2],
) -> Strains<S> {
    let g = add(tangent, slope);
    let (a, b) = (dot(g, g), b_of(g, bend));
    let green = dot(tangent, slope) + dot(slope, slope) * 0.5;
    match measure {
        StrainMeasure::Green => Strains { membrane: green, bending: curvature - b / a.sqrt() },
        StrainMeasure::Engineering => Strains {
            membrane: (green + green) / (a.sqrt() + a.constant(1.0)),
            bending: curvature - b / a,
        },
    }
}

/// Axial force of strains at a configuration (g, p), positive in tension \[N\]: the derivative of the strain energy with respect to
/// the stretch nu, with the rotation theta of the tangent.
///
/// Green: `N = EA eps nu - EI kappa theta'`, and the moment `M = -EI kappa nu`, not `EA eps` and `EI kappa`.
pub fn axial_force(law: &SectionLaw<f64>, strain: &Strains<f64>, g: [f64; 2], p: [f64; 2]) -> f64 {
    let force = law.axial * strain.membrane;
    match law.measure {
        StrainMeasure::Green => {
            let a = dot(g, g);
            force * a.sqrt() - law.bending * strain.bending * b_of(g, p) / a
        }
        StrainMeasure::Engineering => force,
    }
}

/// Coefficients of the strain gradient at one configuration, `deps = alpha g.dg`, `dkappa = c1 db + c2 g.dg`, and their
/// derivatives in the directions `g.dg` (suffix `_a`) and `db` (suffix `_b`).
#[derive(Clone, Copy, Debug)]
pub struct Gradient<S> {
    pub alpha: S,
    pub c1: S,
    pub c2: S,
    pub alpha_a: S,
    pub c1_a: S,
    pub c2_a: S,
    pub c2_b: S,
}

/// Gradient of the strains at the configuration (g, p).
#[inline(always)]
pub fn gradient<S: Real>(measure: StrainMeasure, g: [S; 2], p: [S; 2]) -> Gradient<S> {
    let (a, b) = (dot(g, g), b_of(g, p));
    let zero = a.constant(0.0);
    match measure {
        StrainMeasure::Green => {
            let inv_r = a.sqrt().recip();
            let inv_r2 = inv_r * inv_r;
            let inv_r3 = inv_r2 * inv_r;
            Gradient {
                alpha: a.constant(1.0),
                c1: -inv_r,
                c2: b * inv_r3,
                alpha_a: zero,
                c1_a: inv_r3,
                c2_a: b * inv_r3 * inv_r2 * -3.0,
                c2_b: inv_r3,
            }
        }
        StrainMeasure::Engineering => {
            let inv_r = a.sqrt().recip();
            let inv_a = inv_r * inv_r;
            let inv_a2 = inv_a * inv_a;
            Gradient {
                alpha: inv_r,
                c1: -inv_a,
                c2: b * inv_a2 * 2.0,
                alpha_a: -(inv_a * inv_r),
                c1_a: inv_a2 * 2.0,
                c2_a: b * inv_a2 * inv_a * -8.0,
                c2_b: inv_a2 * 2.0,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axial_force_is_the_derivative_of_the_strain_energy() {
        // A configuration given by stretch nu and turn theta' of a tangent along e1.
        let energy = |law: &SectionLaw<f64>, nu: f64, turn: f64| {
            let s = strains(law.measure, [1.0, 0.0], 0.3, [nu - 1.0, 0.0], [0.1, nu * turn]);
            0.5 * law.axial * s.membrane.powi(2) + 0.5 * law.bending * s.bending.powi(2)
        };
        for measure in [StrainMeasure::Green, StrainMeasure::Engineering] {
            let law = SectionLaw { axial: 500.0, bending: 40.0, rotary: 0.0, measure };
            for (nu, turn) in [(1.0, 0.0), (1.2, 0.7), (0.9, -0.4)] {
                let (g, p) = ([nu, 0.0], [0.1, nu * turn]);
                let strain = strains(measure, [1.0, 0.0], 0.3, [nu - 1.0, 0.0], p);
                let found = axial_force(&law, &strain, g, p);
                let h = 1e-5;
                let axial = (energy(&law, nu + h, turn) - energy(&law, nu - h, turn)) / (2.0 * h);
                assert!((found - axial).abs() < 1e-6, "{measure:?} {found} {axial}");
            }
        }
    }
}
