//! The invariant energy-momentum scheme: a discrete gradient written through the invariants
//! `a = g.g` and `b = g x p`, with no strain history.

use super::point::{Form, PointResponse, SectionLaw, StepPoint, Stress, b_of, form_b};
use super::rotary::Turn;
use crate::math::vec2::{add, dot, middle};
use crate::model::StrainMeasure;
use crate::scalar::{Real, reciprocals};

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
    let reference = (point.tangent, point.curvature);
    let start = End::new(law.measure, reference, point.slope_0, point.bend_0);
    Step::new(law.measure, reference, &start, point.d_slope, point.d_bend)
        .response::<TANGENT>(law, &start, lag)
}

/// One end of a step at a Gauss point.
#[derive(Clone, Copy, Debug)]
pub struct End<S> {
    /// Displacement gradient u' \[1\].
    pub slope: [S; 2],
    /// Second derivative x'' \[1/m\].
    pub bend: [S; 2],
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
        reference: ([S; 2], S),
        slope: [S; 2],
        bend: [S; 2],
    ) -> Self {
        let bare = Bare::new(reference.0, slope, bend);
        let inverse = bare.divisor(measure).recip();
        bare.end(measure, reference, inverse)
    }
}

/// An end whose reciprocal is still to be found.
struct Bare<S> {
    slope: [S; 2],
    bend: [S; 2],
    g: [S; 2],
    /// Square of the stretch, and the stretch.
    a: S,
    stretch: S,
}

impl<S: Real> Bare<S> {
    #[inline(always)]
    fn new(tangent: [S; 2], slope: [S; 2], bend: [S; 2]) -> Self {
        let g = add(tangent, slope);
        let a = dot(g, g);
        Self { slope, bend, g, a, stretch: a.ordinary_sqrt() }
    }

    /// What the bending strain divides by.
    #[inline(always)]
    fn divisor(&self, measure: StrainMeasure) -> S {
        match measure {
            StrainMeasure::Green => self.stretch,
            StrainMeasure::Engineering => self.a,
        }
    }

    #[inline(always)]
    fn end(self, measure: StrainMeasure, reference: ([S; 2], S), inverse: S) -> End<S> {
        let Self { slope, bend, g, stretch, .. } = self;
        let (tangent, curvature) = reference;
        let green = dot(middle(tangent, slope), slope);
        let membrane = match measure {
            StrainMeasure::Green => green,
            StrainMeasure::Engineering => (green + green) / (stretch + stretch.constant(1.0)),
        };
        let b = b_of(g, bend);
        let bending = curvature.sub_product(b, inverse);
        End { slope, bend, stretch, inverse, b, membrane, bending }
    }
}

/// The end of a step at a Gauss point, and its middle.
#[derive(Clone, Copy, Debug)]
pub struct Step<S> {
    /// The end.
    pub end: End<S>,
    /// Tangent x' at the end.
    g: [S; 2],
    /// Tangent and x'' in the middle.
    p_mid: [S; 2],
    /// How the tangent turns.
    pub turn: Turn<S>,
    /// Reciprocal of the sum of the stretches of both ends.
    q: S,
}

impl<S: Real> Step<S> {
    /// From the start of the step and the increments of u' and x''.
    #[inline(always)]
    pub fn new(
        measure: StrainMeasure,
        reference: ([S; 2], S),
        start: &End<S>,
        d_slope: [S; 2],
        d_bend: [S; 2],
    ) -> Self {
        let bare = Bare::new(reference.0, add(start.slope, d_slope), add(start.bend, d_bend));
        let g0 = add(reference.0, start.slope);
        let (g_mid, p_mid) = (middle(g0, d_slope), middle(start.bend, d_bend));
        let [inverse, q, inv_a] =
            reciprocals([bare.divisor(measure), start.stretch + bare.stretch, dot(g_mid, g_mid)]);
        let g = bare.g;
        let end = bare.end(measure, reference, inverse);
        Self { end, g, p_mid, turn: Turn { g0, d_g: d_slope, g: g_mid, inv_a }, q }
    }

    /// Forces of the section, and their tangent if `TANGENT`.
    #[inline(always)]
    pub fn response<const TANGENT: bool>(
        &self,
        law: &SectionLaw<S>,
        start: &End<S>,
        lag: f64,
    ) -> PointResponse<S> {
        let (g_mid, p_mid) = (self.turn.g, self.p_mid);
        let ends = Ends { start, end: &self.end, q: self.q, weights: [0.5 - lag, 0.5 + lag] };
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
        let b_form = form_b(self.g, self.end.bend);
        let x = Form::along(
            (axial_a * alpha)
                .add_product(axial, alpha_a)
                .add_product(c2, moment_a)
                .add_product(moment, c2_a),
            self.g,
            (c2 * moment_b).add_product(moment, c2_b),
            &b_form,
        );
        let on_a = (c1 * moment_a).add_product(moment, c1_a);
        let y = Form::along(on_a, self.g, c1 * moment_b, &b_form);
        stress.forces_with_tangent(x, y, 0.5, g_mid, p_mid)
    }
}

/// Both ends of the step, and their weights in the stresses.
struct Ends<'a, S> {
    start: &'a End<S>,
    end: &'a End<S>,
    /// Reciprocal of the sum of their stretches.
    q: S,
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
            law.axial * (start.membrane * w0).add_scaled(end.membrane, w1),
            law.bending * (start.bending * w0).add_scaled(end.bending, w1),
        )
    }

    #[inline(always)]
    fn green(&self, law: &SectionLaw<S>) -> (Stress<S>, Slopes<S>) {
        let (q0, q1, q) = (self.start.inverse, self.end.inverse, self.q);
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
        let (q0, q1, q) = (self.start.inverse, self.end.inverse, self.q);
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
