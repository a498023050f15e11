//! Strains of a configuration, and their gradient coefficients.

pub use super::point::StrainMeasure;
use super::point::{Reference, Strains, b_of};
use crate::math::vec2::{add, cross, dot};
use crate::scalar::Real;

/// Strains of the configuration with displacement gradient `slope` = u' and second derivative `bend` = u''.
///
/// Green: `eps = X'.u' + u'.u'/2`, `kappa = kappa0 - b/r`. Engineering: `eps = r - 1`, `kappa = kappa0 - b/a`.
/// Written through u' and u'' ([`Reference::bending`]), so that small strains lose no digits.
#[inline(always)]
pub fn strains<S: Real>(
    measure: StrainMeasure,
    reference: &Reference<S>,
    slope: [S; 2],
    bend: [S; 2],
) -> Strains<S> {
    let g = add(reference.tangent, slope);
    let a = dot(g, g);
    let stretch = a.sqrt();
    let green = dot(reference.tangent, slope) + dot(slope, slope) * 0.5;
    let change = reference.b_change(slope, bend);
    let (membrane, inverse) = match measure {
        StrainMeasure::Green => (green, stretch.recip()),
        StrainMeasure::Engineering => ((green + green) / (stretch + a.constant(1.0)), a.recip()),
    };
    let bending = reference.bending(measure, green, (stretch, inverse), change);
    Strains { membrane, bending }
}

impl<S: Real> Reference<S> {
    /// Change of the numerator `b = x' x x''` of the bending strain, `x' x u'' + u' x X''` \[1/m\].
    #[inline(always)]
    pub fn b_change(&self, slope: [S; 2], bend: [S; 2]) -> S {
        cross(add(self.tangent, slope), bend) + cross(slope, self.bend)
    }

    /// Bending strain of a stretch r, whose square is `1 + 2 green`, and of a change of `b`: `(kappa0 (r - 1) - db)/r` in Green strains, `(kappa0 2
    /// green - db)/r^2` in engineering ones. Terms of the size of the reference curvature do not cancel, so that round-off in a curved beam is
    /// relative to its change of curvature.
    ///
    /// `inverse` is the reciprocal of the denominator. One step of Newton's method removes the rounding of the root from `r - 1`.
    #[inline(always)]
    pub fn bending(
        &self,
        measure: StrainMeasure,
        green: S,
        (stretch, inverse): (S, S),
        change: S,
    ) -> S {
        let twice = green + green;
        let grown = match measure {
            StrainMeasure::Green => {
                let rough = stretch - stretch.constant(1.0);
                let miss = (rough * (stretch + stretch.constant(1.0))) - twice;
                rough.sub_product(miss * 0.5, inverse)
            }
            StrainMeasure::Engineering => twice,
        };
        (self.curvature * grown - change) * inverse
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
