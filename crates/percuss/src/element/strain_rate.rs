//! The paper's energy-momentum scheme (eq. 5): strains are history, advanced by their midpoint rates.

use super::point::{
    PointResponse, SectionLaw, StepPoint, Strains, Stress, StressRate, form_a, form_b,
};
use super::strain::gradient;
use crate::scalar::Real;

/// Stored strains at the end of a step that starts with the stored strains `old`:
/// `eps1 = eps0 + deps_m(Dx)`, `kappa1 = kappa0 + dkappa_m(Dx)`, the gradients taken at the midpoint.
#[inline(always)]
pub fn advance<S: Real>(law: &SectionLaw<S>, point: &StepPoint<S>, old: Strains<S>) -> Strains<S> {
    let [g_mid, p_mid] = point.at(0.5);
    let c = gradient(law.measure, g_mid, p_mid);
    let da = form_a(g_mid).on(point.d_slope, point.d_bend);
    let db = form_b(g_mid, p_mid).on(point.d_slope, point.d_bend);
    Strains { membrane: old.membrane + c.alpha * da, bending: old.bending + c.c1 * db + c.c2 * da }
}

/// Stress power with `N = EA (eps0 + eps1)/2`, `B = EI (kappa0 + kappa1)/2` and variations at the midpoint; `lag` is the
/// retardation time of Kelvin-Voigt damping over the step size.
#[inline(always)]
pub fn response<S: Real, const TANGENT: bool>(
    law: &SectionLaw<S>,
    point: &StepPoint<S>,
    old: Strains<S>,
    lag: f64,
) -> PointResponse<S> {
    let end = 0.5 + lag;
    let [g_mid, p_mid] = point.at(0.5);
    let c = gradient(law.measure, g_mid, p_mid);
    let (a_mid, b_mid) = (form_a(g_mid), form_b(g_mid, p_mid));
    let da = a_mid.on(point.d_slope, point.d_bend);
    let db = b_mid.on(point.d_slope, point.d_bend);
    let eps = old.membrane + c.alpha * da * end;
    let kappa = old.bending + (c.c1 * db + c.c2 * da) * end;
    let stress = Stress {
        axial: law.axial * eps,
        moment: law.bending * kappa,
        alpha: c.alpha,
        c1: c.c1,
        c2: c.c2,
    };
    if !TANGENT {
        return stress.forces(g_mid, p_mid);
    }
    let [g1, p1] = point.at(1.0);
    // d(da) = g1.dg and d(db) = db at the end of the step, exactly; coefficients move with the midpoint.
    let (a_end, b_end) = (form_a(g1), form_b(g1, p1));
    let weight = old.membrane.constant(end);
    let alpha = a_mid.times(c.alpha_a * 0.5);
    let c1 = a_mid.times(c.c1_a * 0.5);
    let c2 = a_mid.times(c.c2_a * 0.5).plus(c.c2_b * 0.5, b_mid);
    let d_eps = a_end.times(c.alpha).plus(da, alpha);
    let d_kappa = b_end.times(c.c1).plus(db, c1).plus(c.c2, a_end).plus(da, c2);
    let rate = StressRate {
        axial: d_eps.times(law.axial * weight),
        moment: d_kappa.times(law.bending * weight),
        alpha,
        c1,
        c2,
        theta: 0.5,
    };
    stress.forces_and_tangent(&rate, g_mid, p_mid)
}
