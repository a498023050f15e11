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
    let slope_1 = add(point.slope_0, point.d_slope);
    let g0 = add(point.tangent, point.slope_0);
    let g1 = add(point.tangent, slope_1);
    let p1 = add(point.bend_0, point.d_bend);
    let g_mid = [g0[0] + point.d_slope[0] * 0.5, g0[1] + point.d_slope[1] * 0.5];
    let p_mid = [point.bend_0[0] + point.d_bend[0] * 0.5, point.bend_0[1] + point.d_bend[1] * 0.5];
    let green = |u: [S; 2]| dot(point.tangent, u) + dot(u, u) * 0.5;
    let ends = Ends {
        a0: dot(g0, g0),
        a1: dot(g1, g1),
        b0: b_of(g0, point.bend_0),
        b1: b_of(g1, p1),
        eps0: green(point.slope_0),
        eps1: green(slope_1),
        kappa_ref: point.curvature,
        weights: [0.5 - lag, 0.5 + lag],
    };
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
    let b_form = form_b(g1, p1);
    let along = |a: S, b: S| Form {
        g: [a * g1[0] + b * b_form.g[0], a * g1[1] + b * b_form.g[1]],
        p: [b * b_form.p[0], b * b_form.p[1]],
    };
    let x = along(
        axial_a * alpha + axial * alpha_a + c2 * moment_a + moment * c2_a,
        c2 * moment_b + moment * c2_b,
    );
    let y = along(c1 * moment_a + moment * c1_a, c1 * moment_b);
    stress.forces_with_tangent(x, y, 0.5, g_mid, p_mid)
}

/// Invariants and Green membrane strain at both ends of the step.
struct Ends<S> {
    a0: S,
    a1: S,
    b0: S,
    b1: S,
    eps0: S,
    eps1: S,
    kappa_ref: S,
    /// Weights of the ends in the stresses.
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

impl<S: Real> Ends<S> {
    #[inline(always)]
    fn green(&self, law: &SectionLaw<S>) -> (Stress<S>, Slopes<S>) {
        let (r0, r1) = (self.a0.sqrt(), self.a1.sqrt());
        let (q0, q1, q) = (r0.recip(), r1.recip(), (r0 + r1).recip());
        let q1_cubed = q1 * q1 * q1;
        let [w0, w1] = self.weights;
        let (end_ea, end_ei) = (law.axial * w1, law.bending * w1);
        let kappa = (self.kappa_ref - self.b0 * q0) * w0 + (self.kappa_ref - self.b1 * q1) * w1;
        let c2_b = q0 * q1 * q;
        let c2 = (self.b0 + self.b1) * c2_b;
        let stress = Stress {
            axial: law.axial * (self.eps0 * w0 + self.eps1 * w1),
            moment: law.bending * kappa,
            alpha: S::constant(1.0),
            c1: (q0 + q1) * -0.5,
            c2,
        };
        let slopes = Slopes {
            axial_a: end_ea,
            moment_a: end_ei * self.b1 * q1_cubed,
            moment_b: -(end_ei * q1),
            alpha_a: S::constant(0.0),
            c1_a: q1_cubed * 0.5,
            c2_a: -(c2 * (q1 + q) * q1),
            c2_b,
        };
        (stress, slopes)
    }

    #[inline(always)]
    fn engineering(&self, law: &SectionLaw<S>) -> (Stress<S>, Slopes<S>) {
        let (r0, r1) = (self.a0.sqrt(), self.a1.sqrt());
        let (q0, q1, q) = (self.a0.recip(), self.a1.recip(), (r0 + r1).recip());
        let [w0, w1] = self.weights;
        let (end_ea, end_ei) = (law.axial * w1, law.bending * w1);
        let one = S::constant(1.0);
        let eps = |green: S, r: S| (green + green) / (r + one);
        let kappa = (self.kappa_ref - self.b0 * q0) * w0 + (self.kappa_ref - self.b1 * q1) * w1;
        let c2_b = q0 * q1;
        let c2 = (self.b0 + self.b1) * c2_b;
        let inv_r1 = r1 * q1;
        let stress = Stress {
            axial: law.axial * (eps(self.eps0, r0) * w0 + eps(self.eps1, r1) * w1),
            moment: law.bending * kappa,
            alpha: q + q,
            c1: (q0 + q1) * -0.5,
            c2,
        };
        let slopes = Slopes {
            axial_a: end_ea * inv_r1,
            moment_a: end_ei * self.b1 * q1 * q1 * 2.0,
            moment_b: -(end_ei * q1),
            alpha_a: q * q * inv_r1 * -2.0,
            c1_a: q1 * q1,
            c2_a: c2 * q1 * -2.0,
            c2_b,
        };
        (stress, slopes)
    }
}
