//! The invariant energy-momentum scheme: a discrete gradient written through the invariants
//! `a = g.g` and `b = g x p`, with no strain history.

use super::point::{Form, PointResponse, SectionLaw, StepPoint, Stress, b_of, form_b};
use crate::math::vec2::{add, dot};
use crate::model::StrainMeasure;
use crate::scalar::Real;

/// Stress power of a step from (g0, p0) to (g1, p1):
///
/// `N = EA (eps0 + eps1)/2`, `deps = alpha g_m.dg`, `B = EI (kappa0 + kappa1)/2`,
/// `dkappa = c1 (dg x p_m + g_m x dp) + c2 g_m.dg`; on the increment of the step itself `deps` and `dkappa` are exactly
/// `eps1 - eps0` and `kappa1 - kappa0`.
///
/// `lag` is the retardation time of Kelvin-Voigt damping over the step size: the stresses `EA tau (eps1 - eps0)/h` weigh the
/// ends of the step `1/2 - lag` and `1/2 + lag`.
#[inline(always)]
pub fn response<S: Real, const TANGENT: bool>(
    law: &SectionLaw<S>,
    point: &StepPoint<S>,
    lag: f64,
) -> PointResponse<S> {
    let (tangent, curvature) = (point.tangent, point.curvature);
    let start = End::new(law.measure, tangent, curvature, point.slope_0, point.bend_0);
    let (slope, bend) = (add(point.slope_0, point.d_slope), add(point.bend_0, point.d_bend));
    let end = End::new(law.measure, tangent, curvature, slope, bend);
    between::<S, TANGENT>(law, &start, &end, point.d_slope, point.d_bend, lag)
}

/// The same from what is known of either end of the step; `d_slope` and `d_bend` are the increments of u' and x''.
#[inline(always)]
pub fn between<S: Real, const TANGENT: bool>(
    law: &SectionLaw<S>,
    start: &End<S>,
    end: &End<S>,
    d_slope: [S; 2],
    d_bend: [S; 2],
    lag: f64,
) -> PointResponse<S> {
    let middle = |x: [S; 2], d: [S; 2]| [x[0] + d[0] * 0.5, x[1] + d[1] * 0.5];
    let (g_mid, p_mid) = (middle(start.g, d_slope), middle(start.bend, d_bend));
    let ends = Ends { start, end, weights: [0.5 - lag, 0.5 + lag] };
    let (stress, slopes) = match law.measure {
        StrainMeasure::Green => ends.green(law),
        StrainMeasure::Engineering => ends.engineering(law),
    };
    if !TANGENT {
        return stress.forces(g_mid, p_mid);
    }
    // Every derivative runs along g1.dg and db1: sums of scalars first, forms last.
    let Stress { axial, moment, alpha, c1, c2 } = stress;
    let Slopes { axial_a, moment_a, moment_b, alpha_a, c1_a, c2_a, c2_b } = slopes;
    let b_form = form_b(end.g, end.bend);
    let x = Form::along(
        axial_a * alpha + axial * alpha_a + c2 * moment_a + moment * c2_a,
        end.g,
        c2 * moment_b + moment * c2_b,
        &b_form,
    );
    let y = Form::along(c1 * moment_a + moment * c1_a, end.g, c1 * moment_b, &b_form);
    stress.forces_with_tangent(x, y, 0.5, g_mid, p_mid)
}

/// One end of a step at a Gauss point.
#[derive(Clone, Copy, Debug)]
pub struct End<S> {
    /// Displacement gradient u' \[1\].
    pub slope: [S; 2],
    /// Second derivative x'' \[1/m\].
    pub bend: [S; 2],
    /// Tangent x'.
    pub g: [S; 2],
    /// Stretch |x'|.
    pub stretch: S,
    /// Its reciprocal, in engineering strains that of its square: `kappa = kappa0 - b inverse`.
    pub inverse: S,
    /// Numerator of the bending strain, `b = x' x x''` \[1/m\].
    pub b: S,
    /// Membrane strain \[1\].
    pub membrane: S,
    /// Bending strain \[1/m\].
    pub bending: S,
}

impl<S: Real> End<S> {
    /// From the reference tangent and curvature, and the displacement's first and second derivative.
    #[inline(always)]
    pub fn new(
        measure: StrainMeasure,
        tangent: [S; 2],
        curvature: S,
        slope: [S; 2],
        bend: [S; 2],
    ) -> Self {
        let g = add(tangent, slope);
        let (a, b) = (dot(g, g), b_of(g, bend));
        let stretch = a.sqrt();
        let green = dot(tangent, slope) + dot(slope, slope) * 0.5;
        let (inverse, membrane) = match measure {
            StrainMeasure::Green => (stretch.recip(), green),
            StrainMeasure::Engineering => {
                (a.recip(), (green + green) / (stretch + stretch.constant(1.0)))
            }
        };
        let bending = curvature - b * inverse;
        Self { slope, bend, g, stretch, inverse, b, membrane, bending }
    }
}

/// Both ends of the step, and their weights in the stresses.
struct Ends<'a, S> {
    start: &'a End<S>,
    end: &'a End<S>,
    weights: [f64; 2],
}

/// Derivatives along `g1.dg` (`_a`) and `db1` (`_b`).
struct Slopes<S> {
    axial_a: S,
    moment_a: S,
    moment_b: S,
    alpha_a: S,
    c1_a: S,
    c2_a: S,
    c2_b: S,
}

impl<S: Real> Ends<'_, S> {
    /// Axial force and moment from the weighed strains.
    #[inline(always)]
    fn resultants(&self, law: &SectionLaw<S>) -> (S, S) {
        let [w0, w1] = self.weights;
        let (start, end) = (self.start, self.end);
        (
            law.axial * (start.membrane * w0 + end.membrane * w1),
            law.bending * (start.bending * w0 + end.bending * w1),
        )
    }

    #[inline(always)]
    fn green(&self, law: &SectionLaw<S>) -> (Stress<S>, Slopes<S>) {
        let (q0, q1) = (self.start.inverse, self.end.inverse);
        let q = (self.start.stretch + self.end.stretch).recip();
        let q1_cubed = q1 * q1 * q1;
        let (end_ea, end_ei) = (law.axial * self.weights[1], law.bending * self.weights[1]);
        let (axial, moment) = self.resultants(law);
        let c2_b = q0 * q1 * q;
        let c2 = (self.start.b + self.end.b) * c2_b;
        let stress = Stress { axial, moment, alpha: c2.constant(1.0), c1: (q0 + q1) * -0.5, c2 };
        let slopes = Slopes {
            axial_a: end_ea,
            moment_a: end_ei * self.end.b * q1_cubed,
            moment_b: -(end_ei * q1),
            alpha_a: c2.constant(0.0),
            c1_a: q1_cubed * 0.5,
            c2_a: -(c2 * (q1 + q) * q1),
            c2_b,
        };
        (stress, slopes)
    }

    #[inline(always)]
    fn engineering(&self, law: &SectionLaw<S>) -> (Stress<S>, Slopes<S>) {
        let (q0, q1) = (self.start.inverse, self.end.inverse);
        let q = (self.start.stretch + self.end.stretch).recip();
        let (end_ea, end_ei) = (law.axial * self.weights[1], law.bending * self.weights[1]);
        let (axial, moment) = self.resultants(law);
        let c2_b = q0 * q1;
        let c2 = (self.start.b + self.end.b) * c2_b;
        let inv_r1 = self.end.stretch * q1;
        let stress = Stress { axial, moment, alpha: q + q, c1: (q0 + q1) * -0.5, c2 };
        let slopes = Slopes {
            axial_a: end_ea * inv_r1,
            moment_a: end_ei * self.end.b * q1 * q1 * 2.0,
            moment_b: -(end_ei * q1),
            alpha_a: q * q * inv_r1 * -2.0,
            c1_a: q1 * q1,
            c2_a: c2 * q1 * -2.0,
            c2_b,
        };
        (stress, slopes)
    }
}
