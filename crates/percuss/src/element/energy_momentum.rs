//! The invariant energy-momentum scheme: a discrete gradient written through the invariants
//! `a = g.g` and `b = g x p`, with no strain history.

mod bending;

use super::beam::{ElementValues, GaussRow};
use super::point::{Form, PointResponse, Reference, SectionLaw, Stress, form_b};
use super::rotary::Turn;
use super::strain::StrainMeasure;
use crate::math::vec2::{add, cross, dot, middle};
use crate::scalar::{Real, reciprocals};

/// One end of a step at a Gauss point.
#[derive(Clone, Copy, Debug)]
pub struct End<S> {
    /// Displacement gradient u', shape (2) \[-\].
    pub slope: [S; 2],
    /// Second derivative u'', shape (2) \[1/m\].
    pub bend: [S; 2],
    /// Stretch |x'|.
    pub stretch: S,
    /// Its reciprocal, in engineering strains that of its square: `kappa = kappa0 - b inverse`.
    pub inverse: S,
    /// Membrane strain \[-\].
    pub membrane: S,
}

/// Terms of the bending strain.
#[derive(Clone, Copy, Debug)]
pub struct Bent<S> {
    /// Its numerator, `b = x' x x''` \[1/m\].
    pub b: S,
    /// Bending strain \[1/m\].
    pub strain: S,
}

impl<S: Real> End<S> {
    /// From the reference tangent, and the displacement's first and second derivative.
    #[inline(always)]
    pub fn new(measure: StrainMeasure, tangent: [S; 2], slope: [S; 2], bend: [S; 2]) -> Self {
        let g = add(tangent, slope);
        let a = dot(g, g);
        let [stretch] = S::ordinary_sqrts([a]);
        let [inverse] = S::ordinary_recips([divisor(measure, a, stretch)]);
        Self::with(measure, tangent, (slope, bend), (stretch, inverse))
    }

    /// Those of several Gauss points together, from nodal displacements; faster, see [`Quotients::of`].
    #[inline(always)]
    pub fn all<const N: usize>(
        measure: StrainMeasure,
        rows: &[GaussRow<S>; N],
        displacement: &ElementValues<S>,
    ) -> [Self; N] {
        let like = rows[0].weight;
        let mut a = [like; N];
        for i in 0..N {
            let g = add(rows[i].reference.tangent, displacement.at(&rows[i].first));
            a[i] = dot(g, g);
        }
        let stretch = S::ordinary_sqrts(a);
        let mut divisors = stretch;
        for i in 0..N {
            divisors[i] = divisor(measure, a[i], stretch[i]);
        }
        let inverse = S::ordinary_recips(divisors);
        let zero = [like; 2];
        let mut ends =
            [Self { slope: zero, bend: zero, stretch: like, inverse: like, membrane: like }; N];
        for i in 0..N {
            let row = &rows[i];
            let shape = (displacement.at(&row.first), displacement.at(&row.second));
            ends[i] = Self::with(measure, row.reference.tangent, shape, (stretch[i], inverse[i]));
        }
        ends
    }

    /// Moves them to the end of a step of size `1 / rate`, with the angular rates of their tangents, from displacements there and their
    /// increments.
    #[inline(always)]
    pub fn arrive<const N: usize>(
        (measure, rows): (StrainMeasure, &[GaussRow<S>; N]),
        (ends, spin): (&mut [Self; N], &mut [S; N]),
        displacement: &ElementValues<S>,
        step: &ElementValues<S>,
        rate: S,
    ) {
        let like = rows[0].weight;
        let mut turns = [Turn { g0: [like; 2], d_g: [like; 2], g: [like; 2], inv_a: like }; N];
        let mut squared = [like; N];
        for i in 0..N {
            let (g0, d_g) =
                (add(rows[i].reference.tangent, ends[i].slope), step.at(&rows[i].first));
            let g = middle(g0, d_g);
            squared[i] = dot(g, g);
            turns[i] = Turn { g0, d_g, g, inv_a: like };
        }
        let inverse = S::ordinary_recips(squared);
        for i in 0..N {
            spin[i] = Turn { inv_a: inverse[i], ..turns[i] }.end_spin(rate, spin[i]);
        }
        *ends = Self::all(measure, rows, displacement);
    }

    /// The same where the stretch is known, and the reciprocal.
    #[inline(always)]
    fn with(
        measure: StrainMeasure,
        tangent: [S; 2],
        (slope, bend): ([S; 2], [S; 2]),
        (stretch, inverse): (S, S),
    ) -> Self {
        let green = dot(middle(tangent, slope), slope);
        let membrane = match measure {
            StrainMeasure::Green => green,
            StrainMeasure::Engineering => (green + green) / (stretch + stretch.constant(1.0)),
        };
        Self { slope, bend, stretch, inverse, membrane }
    }

    /// Its bending, which costs less than keeping it from step to step.
    #[inline(always)]
    pub fn bent(&self, measure: StrainMeasure, reference: &Reference<S>) -> Bent<S> {
        let change = reference.b_change(self.slope, self.bend);
        let green = match measure {
            StrainMeasure::Green => self.membrane,
            StrainMeasure::Engineering => dot(middle(reference.tangent, self.slope), self.slope),
        };
        let quotient = (self.stretch, self.inverse);
        let strain = reference.bending(measure, green, quotient, change);
        Bent { b: reference.curvature + change, strain }
    }
}

/// Denominator of the bending strain, from the square of the stretch and the stretch.
#[inline(always)]
fn divisor<S: Real>(measure: StrainMeasure, a: S, stretch: S) -> S {
    match measure {
        StrainMeasure::Green => stretch,
        StrainMeasure::Engineering => a,
    }
}

/// A Gauss point over a step.
#[derive(Clone, Copy, Debug)]
pub struct PointStep<'a, S> {
    /// Reference configuration.
    pub reference: &'a Reference<S>,
    /// Start of the step.
    pub start: &'a End<S>,
    /// Increment of u', shape (2) \[-\].
    pub d_slope: [S; 2],
    /// Increment of u'', shape (2) \[1/m\].
    pub d_bend: [S; 2],
}

impl<'a, S: Real> PointStep<'a, S> {
    /// From nodal increments.
    #[inline(always)]
    pub fn new(row: &'a GaussRow<S>, start: &'a End<S>, step: &ElementValues<S>) -> Self {
        let (d_slope, d_bend) = (step.at(&row.first), step.at(&row.second));
        Self { reference: &row.reference, start, d_slope, d_bend }
    }

    /// Tangent x' at the start, in the middle and at the end.
    #[inline(always)]
    fn tangents(&self) -> [[S; 2]; 3] {
        let (tangent, slope) = (self.reference.tangent, self.start.slope);
        let start = add(tangent, slope);
        [start, middle(start, self.d_slope), add(tangent, add(slope, self.d_slope))]
    }
}

/// The stretch at the end of a step, and the denominator.
#[derive(Clone, Copy, Debug)]
pub struct Quotients<S> {
    stretch: S,
    /// [`End::inverse`] at the end.
    inverse: S,
    /// Reciprocal of the sum of the stretches of both ends.
    q: S,
    /// Reciprocal of the square of the tangent in the middle.
    inv_a: S,
}

impl<S: Real> Quotients<S> {
    /// Those of several Gauss points together: a root and a reciprocal are long chains of operations, each waiting for the one
    /// before, and the points' chains run side by side.
    #[inline(always)]
    pub fn of<const N: usize>(measure: StrainMeasure, ways: &[PointStep<S>; N]) -> [Self; N] {
        let like = ways[0].reference.curvature;
        let (mut a, mut middle) = ([like; N], [like; N]);
        for i in 0..N {
            let [_, g_mid, g] = ways[i].tangents();
            (a[i], middle[i]) = (dot(g, g), dot(g_mid, g_mid));
        }
        let stretch = S::ordinary_sqrts(a);
        let mut divisors = [[like; 3]; N];
        for i in 0..N {
            let sum = ways[i].start.stretch + stretch[i];
            divisors[i] = [divisor(measure, a[i], stretch[i]), sum, middle[i]];
        }
        let quotients = reciprocals(divisors);
        let mut out = [Self { stretch: like, inverse: like, q: like, inv_a: like }; N];
        for i in 0..N {
            let [inverse, q, inv_a] = quotients[i];
            out[i] = Self { stretch: stretch[i], inverse, q, inv_a };
        }
        out
    }
}

/// The end of a step at a Gauss point, and its middle.
#[derive(Clone, Copy, Debug)]
pub struct Step<S> {
    /// The end.
    end: End<S>,
    /// Bending at the start and at the end, shape (2).
    bent: [Bent<S>; 2],
    /// Tangent x' at the end, shape (2) \[-\].
    g: [S; 2],
    /// x'' at the end, shape (2) \[1/m\].
    p: [S; 2],
    /// x'' in the middle, shape (2) \[1/m\].
    p_mid: [S; 2],
    /// Increment of u'', shape (2) \[1/m\].
    d_bend: [S; 2],
    /// How the tangent turns.
    pub turn: Turn<S>,
    /// Reciprocal of the sum of the stretches of both ends.
    q: S,
}

impl<S: Real> Step<S> {
    /// A way with its quotients.
    #[inline(always)]
    pub fn new(measure: StrainMeasure, way: &PointStep<S>, quotients: &Quotients<S>) -> Self {
        let PointStep { reference, start, d_slope, d_bend } = *way;
        let Quotients { stretch, inverse, q, inv_a } = *quotients;
        let [g0, g_mid, g] = way.tangents();
        let shape = (add(start.slope, d_slope), add(start.bend, d_bend));
        let end = End::with(measure, reference.tangent, shape, (stretch, inverse));
        let bent = [start.bent(measure, reference), end.bent(measure, reference)];
        let turn = Turn { g0, d_g: d_slope, g: g_mid, inv_a };
        let p_mid = add(reference.bend, middle(start.bend, d_bend));
        Self { end, bent, g, p: add(reference.bend, end.bend), p_mid, d_bend, turn, q }
    }

    /// `g_m . dg` and `db` over the step.
    #[inline(always)]
    fn changes(&self) -> (S, S) {
        let Turn { d_g, g, .. } = self.turn;
        (dot(g, d_g), cross(d_g, self.p_mid) + cross(g, self.d_bend))
    }

    /// Forces of the section, and their tangent if `TANGENT`.
    ///
    /// Stress power of a step from (g0, p0) to (g1, p1):
    ///
    /// `N = EA (eps0 + eps1)/2`, `deps = alpha g_m.dg`, `B = EI (kappa0 + kappa1)/2`,
    /// `dkappa = c1 (dg x p_m + g_m x dp) + c2 g_m.dg`; on the increment of the step itself `deps` and `dkappa` are exactly
    /// `eps1 - eps0` and `kappa1 - kappa0`.
    ///
    /// `lag` is the retardation time of Kelvin-Voigt damping over the step size, of an undamped material none: stresses
    /// `EA tau deps/h` and `EI tau dkappa/h` are added. They are made of the increment, not of a difference of strains, so that of a beam
    /// that moves as a rigid body they round at the size of the increment, however short the step.
    #[inline(always)]
    pub fn response<const TANGENT: bool>(
        &self,
        law: &SectionLaw<S>,
        start: &End<S>,
        lag: Option<S>,
    ) -> PointResponse<S> {
        let (g_mid, p_mid) = (self.turn.g, self.p_mid);
        let half = law.axial.constant(0.5);
        let weight = lag.map_or(half, |lag| half + lag);
        let ends = StepStates { start, end: &self.end, bent: &self.bent, q: self.q, weight };
        let (mut stress, slopes) = match law.measure {
            StrainMeasure::Green => ends.green(law),
            StrainMeasure::Engineering => ends.engineering(law),
        };
        if let Some(lag) = lag {
            let (change_a, change_b) = self.changes();
            let bent = (stress.c1 * change_b).add_product(stress.c2, change_a);
            stress.axial = stress.axial.add_product(law.axial * lag, stress.alpha * change_a);
            stress.moment = stress.moment.add_product(law.bending * lag, bent);
        }
        if !TANGENT {
            return stress.forces(g_mid, p_mid);
        }
        // Every derivative runs along g1.dg and db1: sums of scalars first, forms last.
        let Stress { axial, moment, alpha, c1, c2 } = stress;
        let StretchSlopes { axial_a, moment_a, moment_b, alpha_a, c1_a, c2_a, c2_b } = slopes;
        let b_form = form_b(self.g, self.p);
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
struct StepStates<'a, S> {
    start: &'a End<S>,
    end: &'a End<S>,
    /// Bending at the start and at the end, shape (2).
    bent: &'a [Bent<S>; 2],
    /// Reciprocal of the sum of their stretches.
    q: S,
    /// Weight of the end in the tangent of the stresses \[-\].
    weight: S,
}

/// Derivatives along `g1.dg` (`_a`) and `db1` (`_b`).
struct StretchSlopes<S> {
    axial_a: S,
    moment_a: S,
    moment_b: S,
    alpha_a: S,
    c1_a: S,
    c2_a: S,
    c2_b: S,
}

impl<S: Real> StepStates<'_, S> {
    /// Axial force and moment from the mean strains.
    #[inline(always)]
    fn resultants(&self, law: &SectionLaw<S>) -> (S, S) {
        (
            law.axial * 0.5 * (self.start.membrane + self.end.membrane),
            law.bending * 0.5 * (self.bent[0].strain + self.bent[1].strain),
        )
    }

    #[inline(always)]
    fn green(&self, law: &SectionLaw<S>) -> (Stress<S>, StretchSlopes<S>) {
        let (q0, q1, q) = (self.start.inverse, self.end.inverse, self.q);
        let q1_cubed = q1 * q1 * q1;
        let (end_ea, end_ei) = (law.axial * self.weight, law.bending * self.weight);
        let (axial, moment) = self.resultants(law);
        let c2_b = q0 * q1 * q;
        let c2 = (self.bent[0].b + self.bent[1].b) * c2_b;
        let stress = Stress { axial, moment, alpha: c2.constant(1.0), c1: (q0 + q1) * -0.5, c2 };
        let slopes = StretchSlopes {
            axial_a: end_ea,
            moment_a: end_ei * self.bent[1].b * q1_cubed,
            moment_b: -(end_ei * q1),
            alpha_a: c2.constant(0.0),
            c1_a: q1_cubed * 0.5,
            c2_a: -(c2 * (q1 + q) * q1),
            c2_b,
        };
        (stress, slopes)
    }

    #[inline(always)]
    fn engineering(&self, law: &SectionLaw<S>) -> (Stress<S>, StretchSlopes<S>) {
        let (q0, q1, q) = (self.start.inverse, self.end.inverse, self.q);
        let (end_ea, end_ei) = (law.axial * self.weight, law.bending * self.weight);
        let (axial, moment) = self.resultants(law);
        let c2_b = q0 * q1;
        let c2 = (self.bent[0].b + self.bent[1].b) * c2_b;
        let inv_r1 = self.end.stretch * q1;
        let stress = Stress { axial, moment, alpha: q + q, c1: (q0 + q1) * -0.5, c2 };
        let slopes = StretchSlopes {
            axial_a: end_ea * inv_r1,
            moment_a: end_ei * self.bent[1].b * q1 * q1 * 2.0,
            moment_b: -(end_ei * q1),
            alpha_a: q * q * inv_r1 * -2.0,
            c1_a: q1 * q1,
            c2_a: c2 * q1 * -2.0,
            c2_b,
        };
        (stress, slopes)
    }
}
