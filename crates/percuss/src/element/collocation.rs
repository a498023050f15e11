//! Forces of the strain energy at one configuration between the ends of the step: implicit midpoint (`theta = 1/2`),
//! Newmark (`theta = 1`), generalized-alpha (`theta = 1 - alpha_f`), statics (`theta = 1`).

use super::point::{
    Form, PointResponse, SectionLaw, StepPoint, Strains, Stress, StressRate, form_a, form_b,
};
use super::strain::{gradient, strains};
use super::strain_rate;
use crate::scalar::Real;

/// Gradient of the strain energy at `x_0 + theta Dx`.
#[inline(always)]
pub fn response<S: Real, const TANGENT: bool>(
    law: &SectionLaw<S>,
    point: &StepPoint<S>,
    theta: f64,
) -> PointResponse<S> {
    evaluate::<S, TANGENT>(law, point, theta, None)
}

/// The same at the midpoint, with Kelvin-Voigt stresses of the strain rates there; `lag` is the retardation time over the
/// step size.
#[inline(always)]
pub fn damped<S: Real, const TANGENT: bool>(
    law: &SectionLaw<S>,
    point: &StepPoint<S>,
    lag: f64,
) -> PointResponse<S> {
    let elastic = response::<S, TANGENT>(law, point, 0.5);
    if lag == 0.0 {
        return elastic;
    }
    // Without strains at the start, the strain-rate scheme is all rate.
    let none = point.reference.curvature.constant(0.0);
    let zero = Strains { membrane: none, bending: none };
    let viscous = strain_rate::response::<S, TANGENT>(law, point, zero, lag - 0.5);
    elastic.plus(&viscous)
}

/// The same at the end of the step, with the geometric stiffness of the strains `foreseen` by the last correction.
///
/// Large rotations of slender beams cause spurious stretching within an iteration; linearly extrapolated stresses are not affected, and Newton's
/// iteration converges for any slenderness (Magisano, Leonetti, Garcea 2017, mixed integration points).
#[inline(always)]
pub fn foreseeing<S: Real, const TANGENT: bool>(
    law: &SectionLaw<S>,
    point: &StepPoint<S>,
    foreseen: Strains<S>,
) -> PointResponse<S> {
    evaluate::<S, TANGENT>(law, point, 1.0, Some(foreseen))
}

/// Strains after a correction (d_slope, d_bend) of the end of the step, to first order.
pub fn foresee(
    law: &SectionLaw<f64>,
    point: &StepPoint<f64>,
    d_slope: [f64; 2],
    d_bend: [f64; 2],
) -> Strains<f64> {
    let ([slope, bend], [g, p]) = (point.displaced(1.0), point.at(1.0));
    let now = strains(law.measure, &point.reference, slope, bend);
    let c = gradient(law.measure, g, p);
    let (da, db) = (form_a(g).on(d_slope, d_bend), form_b(g, p).on(d_slope, d_bend));
    Strains { membrane: now.membrane + c.alpha * da, bending: now.bending + c.c1 * db + c.c2 * da }
}

#[inline(always)]
fn evaluate<S: Real, const TANGENT: bool>(
    law: &SectionLaw<S>,
    point: &StepPoint<S>,
    theta: f64,
    foreseen: Option<Strains<S>>,
) -> PointResponse<S> {
    let ([slope, bend], [g, p]) = (point.displaced(theta), point.at(theta));
    let strain = strains(law.measure, &point.reference, slope, bend);
    let c = gradient(law.measure, g, p);
    let stress = Stress {
        axial: law.axial * strain.membrane,
        moment: law.bending * strain.bending,
        alpha: c.alpha,
        c1: c.c1,
        c2: c.c2,
    };
    if !TANGENT {
        return stress.forces(g, p);
    }
    let (a, b) = (form_a(g), form_b(g, p));
    let weight = point.reference.curvature.constant(theta);
    let rate = StressRate {
        axial: a.times(law.axial * c.alpha * weight),
        moment: b.times(law.bending * c.c1 * weight).plus(law.bending * c.c2 * weight, a),
        alpha: a.times(c.alpha_a * weight),
        c1: a.times(c.c1_a * weight),
        c2: a.times(c.c2_a * weight).plus(c.c2_b * weight, b),
        theta,
    };
    let Some(foreseen) = foreseen else { return stress.forces_and_tangent(&rate, g, p) };
    let geometric = Stress {
        axial: law.axial * foreseen.membrane,
        moment: law.bending * foreseen.bending,
        ..stress
    };
    let tangent = geometric.forces_and_tangent(&rate, g, p).tangent;
    PointResponse { tangent, ..stress.forces(g, p) }
}

/// The bending strain at the end of a step: its gradient there, and forces of a moment with the tangent of its lever arms.
pub struct BendingEnd {
    /// Gradient of the bending strain.
    pub gradient: Form<f64>,
    unit: Stress<f64>,
    rate: StressRate<f64>,
    /// Its configuration: tangent and second derivative x'', shape (2, 2) \[-, 1/m\].
    at: [[f64; 2]; 2],
}

/// That of a point.
pub fn bending_at_end(law: &SectionLaw<f64>, point: &StepPoint<f64>) -> BendingEnd {
    bending_at(law, point, 1.0)
}

/// The same at the share `theta` of a step.
pub fn bending_at(law: &SectionLaw<f64>, point: &StepPoint<f64>, theta: f64) -> BendingEnd {
    let [g, p] = point.at(theta);
    let c = gradient(law.measure, g, p);
    let (a, b) = (form_a(g), form_b(g, p));
    let none = a.times(0.0);
    BendingEnd {
        gradient: b.times(c.c1).plus(c.c2, a),
        unit: Stress { axial: 0.0, moment: 1.0, alpha: c.alpha, c1: c.c1, c2: c.c2 },
        rate: StressRate {
            axial: none,
            moment: none,
            alpha: none,
            c1: a.times(c.c1_a * theta),
            c2: a.times(c.c2_a * theta).plus(c.c2_b * theta, b),
            theta,
        },
        at: [g, p],
    }
}

impl BendingEnd {
    /// Force of a moment, with the tangent of its lever arms only.
    pub fn response(&self, moment: f64) -> PointResponse<f64> {
        let [g, p] = self.at;
        Stress { moment, ..self.unit }.forces_and_tangent(&self.rate, g, p)
    }
}
