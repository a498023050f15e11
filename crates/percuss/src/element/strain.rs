//! Strains of a configuration, and their gradient coefficients.

use super::point::{Strains, b_of};
use crate::math::vec2::{add, dot};
use crate::scalar::Real;

/// Which strains the strain energy `EA eps^2 / 2 + EI kappa^2 / 2` is written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StrainMeasure {
    /// The paper's: `eps = (|x'|^2 - 1) / 2`, `kappa = n'.x' - N'.X'` (Green-type).
    #[default]
    Green,
    /// Reissner's: `eps = |x'| - 1`, `kappa = -(theta' - theta0')`; what most other codes use.
    Engineering,
}

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

/// Coefficients of the strain gradient at one configuration, `deps = alpha g.dg`, `dkappa = c1 db + c2 g.dg`, and their
/// derivatives in the directions `g.dg` (suffix `_a`) and `db` (suffix `_b`).
#[allow(missing_docs)]
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
