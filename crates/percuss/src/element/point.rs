//! Input and output at a Gauss point.
//!
//! Generalised forces are conjugate to the tangent `g = x'` and to `p = x''`: the virtual work per length of any
//! scheme is `force_g . dg + force_p . dp`.

use crate::math::vec2::{add, cross, dot, rot90};
use crate::scalar::Real;

/// Section constants of a beam.
#[derive(Clone, Copy, Debug)]
pub struct SectionLaw<S> {
    /// Axial stiffness EA \[N\].
    pub axial: S,
    /// Bending stiffness EI \[N m^2\].
    pub bending: S,
    /// Rotary inertia per length rhoI \[kg m\].
    pub rotary: S,
    /// Strain measure.
    pub measure: StrainMeasure,
}

impl SectionLaw<f64> {
    /// Radius of gyration, the root of bending over axial stiffness \[m\].
    pub fn gyration(&self) -> f64 {
        (self.bending / self.axial).sqrt()
    }
}

/// The reference configuration at a Gauss point.
#[derive(Clone, Copy, Debug)]
pub struct Reference<S = f64> {
    /// Tangent X', of unit length, shape (2) \[-\].
    pub tangent: [S; 2],
    /// Second derivative X'', shape (2) \[1/m\].
    pub bend: [S; 2],
    /// Curvature X' x X'' \[1/m\].
    pub curvature: S,
}

/// The two ends of a step at a Gauss point.
#[derive(Clone, Copy, Debug)]
pub struct StepPoint<S> {
    /// Reference configuration.
    pub reference: Reference<S>,
    /// Displacement gradient u' at the start of the step, shape (2) \[-\].
    pub slope_0: [S; 2],
    /// Second derivative u'' at the start of the step, shape (2) \[1/m\].
    pub bend_0: [S; 2],
    /// Increment of u' over the step, shape (2) \[-\].
    pub d_slope: [S; 2],
    /// Increment of u'' over the step, shape (2) \[1/m\].
    pub d_bend: [S; 2],
}

impl<S: Real> StepPoint<S> {
    /// Tangent x' and second derivative x'' a share of the way through the step.
    #[inline(always)]
    pub fn at(&self, theta: f64) -> [[S; 2]; 2] {
        let [slope, bend] = self.displaced(theta);
        [add(self.reference.tangent, slope), add(self.reference.bend, bend)]
    }

    /// Displacement gradient u' and second derivative u'' there.
    #[inline(always)]
    pub fn displaced(&self, theta: f64) -> [[S; 2]; 2] {
        let Self { slope_0, bend_0, d_slope, d_bend, .. } = self;
        [
            [slope_0[0] + d_slope[0] * theta, slope_0[1] + d_slope[1] * theta],
            [bend_0[0] + d_bend[0] * theta, bend_0[1] + d_bend[1] * theta],
        ]
    }
}

/// Membrane strain \[-\] and bending strain \[1/m\].
#[derive(Clone, Copy, Debug)]
pub struct Strains<S> {
    /// Membrane strain eps \[-\].
    pub membrane: S,
    /// Bending strain kappa \[1/m\].
    pub bending: S,
}

/// A linear form over `(dg, dp)`.
#[derive(Clone, Copy, Debug)]
pub struct Form<S> {
    /// Coefficients of dg, shape (2) \[unit of the form\].
    pub g: [S; 2],
    /// Coefficients of dp, shape (2) \[unit of the form times m\].
    pub p: [S; 2],
}

/// `d(a/2) = g . dg`.
#[inline(always)]
pub fn form_a<S: Real>(g: [S; 2]) -> Form<S> {
    let zero = g[0].constant(0.0);
    Form { g, p: [zero, zero] }
}

/// `db = dg x p + g x dp`.
#[inline(always)]
pub fn form_b<S: Real>(g: [S; 2], p: [S; 2]) -> Form<S> {
    Form { g: [p[1], -p[0]], p: rot90(g) }
}

impl<S: Real> Form<S> {
    /// `self + s other`.
    #[inline(always)]
    pub fn plus(self, s: S, other: Self) -> Self {
        Self {
            g: [self.g[0].add_product(s, other.g[0]), self.g[1].add_product(s, other.g[1])],
            p: [self.p[0].add_product(s, other.p[0]), self.p[1].add_product(s, other.p[1])],
        }
    }

    /// `a form_a(g) + s b`.
    #[inline(always)]
    pub fn along(a: S, g: [S; 2], s: S, b: &Self) -> Self {
        Self {
            g: [(a * g[0]).add_product(s, b.g[0]), (a * g[1]).add_product(s, b.g[1])],
            p: [s * b.p[0], s * b.p[1]],
        }
    }

    /// `s self`.
    #[inline(always)]
    pub fn times(self, s: S) -> Self {
        Self { g: [s * self.g[0], s * self.g[1]], p: [s * self.p[0], s * self.p[1]] }
    }

    /// Value on increments of g and p.
    #[inline(always)]
    pub fn on(&self, dg: [S; 2], dp: [S; 2]) -> S {
        dot(self.g, dg) + dot(self.p, dp)
    }
}

/// Generalised forces at a Gauss point and their derivatives with respect to (g, p) at the end of the step.
#[derive(Clone, Copy, Debug)]
pub struct PointResponse<S> {
    /// Force conjugate to g, shape (2) \[N; N m with section constants times the weight\].
    pub force_g: [S; 2],
    /// Force conjugate to p, shape (2) \[N m; N m^2 likewise\].
    pub force_p: [S; 2],
    /// Derivatives of (force_g, force_p), row by row, with respect to (g, p), shape (4, 4) \[N, N m, N m^2; times m likewise\].
    pub tangent: [[S; 4]; 4],
}

impl<S: Real> PointResponse<S> {
    /// Sum of two responses.
    #[inline(always)]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            force_g: add(self.force_g, other.force_g),
            force_p: add(self.force_p, other.force_p),
            tangent: std::array::from_fn(|i| {
                std::array::from_fn(|j| self.tangent[i][j] + other.tangent[i][j])
            }),
        }
    }
}

/// Generalised forces of `N deps + B dkappa` with `deps = alpha G`, `dkappa = c1 P + c2 G`, where `G = form_a(g)` and
/// `P = form_b(g, p)` at the configuration (g, p) of evaluation.
///
/// Every scheme has this shape; they differ in the coefficients and in how these depend on the end of the step.
#[derive(Clone, Copy, Debug)]
pub struct Stress<S> {
    /// Axial stress resultant conjugate to the membrane strain \[N\].
    pub axial: S,
    /// Moment conjugate to the bending strain \[N m\].
    pub moment: S,
    /// alpha.
    pub alpha: S,
    /// c1.
    pub c1: S,
    /// c2.
    pub c2: S,
}

/// Derivatives of [`Stress`] with respect to (g, p) at the end of the step.
#[derive(Clone, Copy, Debug)]
pub struct StressRate<S> {
    /// d axial.
    pub axial: Form<S>,
    /// d moment.
    pub moment: Form<S>,
    /// d alpha.
    pub alpha: Form<S>,
    /// d c1.
    pub c1: Form<S>,
    /// d c2.
    pub c2: Form<S>,
    /// Weight of the end of the step in the configuration of evaluation: 1/2 at the midpoint.
    pub theta: f64,
}

impl<S: Real> Stress<S> {
    /// Forces at the configuration (g, p) of evaluation.
    #[inline(always)]
    pub fn forces(&self, g: [S; 2], p: [S; 2]) -> PointResponse<S> {
        let on_g = (self.axial * self.alpha).add_product(self.moment, self.c2);
        let zero = on_g.constant(0.0);
        let Form { g: force_g, p: force_p } =
            Form::along(on_g, g, self.moment * self.c1, &form_b(g, p));
        PointResponse { force_g, force_p, tangent: [[zero; 4]; 4] }
    }

    /// Forces and tangent: `X = alpha dN + N dalpha + c2 dB + B dc2`, `Y = c1 dB + B dc1`.
    #[inline(always)]
    pub fn forces_and_tangent(
        &self,
        rate: &StressRate<S>,
        g: [S; 2],
        p: [S; 2],
    ) -> PointResponse<S> {
        let x = rate
            .axial
            .times(self.alpha)
            .plus(self.axial, rate.alpha)
            .plus(self.c2, rate.moment)
            .plus(self.moment, rate.c2);
        let y = rate.moment.times(self.c1).plus(self.moment, rate.c1);
        self.forces_with_tangent(x, y, rate.theta, g, p)
    }

    /// Forces and tangent, `H = G (x) X + P (x) Y + theta [(N alpha + B c2) dG + B c1 dP]`, with X and Y as in
    /// [`Stress::forces_and_tangent`] and theta the weight of the end of the step in the configuration of evaluation.
    #[inline(always)]
    pub fn forces_with_tangent(
        &self,
        x: Form<S>,
        y: Form<S>,
        theta: f64,
        g: [S; 2],
        p: [S; 2],
    ) -> PointResponse<S> {
        let mut response = self.forces(g, p);
        let b = form_b(g, p);
        let h = &mut response.tangent;
        for i in 0..2 {
            for j in 0..2 {
                h[i][j] = (g[i] * x.g[j]).add_product(b.g[i], y.g[j]);
                h[i][2 + j] = (g[i] * x.p[j]).add_product(b.g[i], y.p[j]);
                h[2 + i][j] = b.p[i] * y.g[j];
                h[2 + i][2 + j] = b.p[i] * y.p[j];
            }
        }
        let on_g = (self.axial * self.alpha).add_product(self.moment, self.c2) * theta;
        let on_p = (self.moment * self.c1) * theta;
        h[0][0] += on_g;
        h[1][1] += on_g;
        // dP = (-J dp, J dg)
        h[0][3] += on_p;
        h[1][2] += -on_p;
        h[2][1] += -on_p;
        h[3][0] += on_p;
        response
    }
}

/// `g x p`, the numerator of the bending strain.
#[inline(always)]
pub fn b_of<S: Real>(g: [S; 2], p: [S; 2]) -> S {
    cross(g, p)
}

/// Which strains the strain energy `EA eps^2 / 2 + EI kappa^2 / 2` is written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StrainMeasure {
    /// The paper's: `eps = (|x'|^2 - 1) / 2`, `kappa = n'.x' - N'.X'` (Green-type).
    #[default]
    Green,
    /// Reissner's: `eps = |x'| - 1`, `kappa = -(theta' - theta0')`; used by most other codes.
    Engineering,
}
