//! The shear-flexible element (Simo and Reissner, in the plane), with linear interpolation and one integration point.
//!
//! A node carries its position x and a unit vector d, the normal of its section, in the place of the tangent of a slender beam. The strains
//! `Gamma1 = x'.d - 1`, `Gamma2 = x'.(J d)`, `K = d'.(J d)`, less those of the reference, are bilinear in (x, d): with their means over a
//! step and their variations in its middle, energy and momenta are conserved for any step (theory, page 2). The unit length of d is a
//! constraint of each node.
//!
//! In an element whose sections turn by the angle t from end to end the strains of a straight chord are wrong by `t^2`. Two terms that are quadratic
//! in (x, d) as well correct them: `|d_b - d_a|^2 / 6` in Gamma1, and the square of turning `(1 - cos t) / l^2` in the energy of bending. With t less
//! that of the reference, `EI l (4/3 (1 - cos t) - 1/6 sin^2 t) / l^2` is `EI t^2 / 2 l` to sixth order.
//!
//! Gamma2 of the chord contains a part by bending between the nodes. The axial force acts along the axis, not along d, where this part leans, and
//! it tightens the axis: the axial strain is that of the field inside the element (`inside`) to second order, `Gamma1 + c Gamma2^2 / 2` with
//! `c = 1 - f^2 + (1 - f)^2 / 5`, f the share of shear. Gamma2^2 is a square of a quadratic form: its change is twice the mean times the change.

#[cfg(test)]
mod examples;
mod fibres;
mod forms;
mod inertia;
mod inside;
mod relieved;

pub use inertia::spread_linearly;
pub use inside::{InsideField, StretchedPlace};

use super::beam::{ElementSums, ElementTable, ElementValues, NodeFrame};
use super::gauss::SectionValues;
use crate::math::hermite::{GAUSS, GAUSS_WEIGHTS, gauss_points};
use crate::math::vec2::{add, cross, dot, sub};
use crate::scalar::{Real, array};

/// A shear-flexible element: its reference and stiffnesses.
#[derive(Clone, Copy, Debug)]
pub struct ShearTable {
    /// Arc length between its nodes \[m\].
    length: f64,
    /// From the first node to the second in the reference, shape (2) \[m\].
    chord: [f64; 2],
    /// Vectors d of both nodes in the reference, shape (2, 2) \[-\].
    directors: [[f64; 2]; 2],
    /// Cosine and sine of the rotation Q that takes the second vector d of the reference to the first, shape (2) \[-\].
    back: [f64; 2],
    /// EA, shear stiffness and EI, times the length, shape (3) \[N m, N m, N m^3\].
    stiffness: [f64; 3],
    /// Stiffness that couples Gamma2 and the bend, times the length: none of a uniform section \[N m^2\].
    coupling: f64,
    /// Share of shear in its flexibility in shear; the rest is that of residual bending \[-\].
    shear_share: f64,
    /// Axial strain by half the square of Gamma2 \[-\].
    leaning: f64,
    /// Even stretch over the Gamma1 of the chord that it causes: one of a straight element \[-\].
    per_stretch: f64,
}

/// Strains of an element less those of the reference.
#[derive(Clone, Copy, Debug)]
pub struct ShearStrains<S> {
    /// Axial strain, Gamma2 and the sine of the angle of turning over the length, shape (3) \[-, -, 1/m\].
    linear: [S; 3],
    /// One less the cosine of that angle, over the square of the length \[1/m^2\].
    square: S,
}

/// Number of the Gauss point in the middle of an element.
pub const MIDDLE: usize = GAUSS / 2;

/// Share of EI that acts on the square of turning, twice that of its energy, and share that acts on its sine.
const BENDING: [f64; 2] = [4.0 / 3.0, -1.0 / 3.0];

/// Forces at an evaluation of the element.
struct Evaluated<S> {
    /// Integrated stresses on the three linear strains and on the square of turning, shape (4) \[N m, N m, N m^2, N m^3\].
    stress: [S; 4],
    /// Those that turn with the element in its tangent, shape (4) \[N m, N m, N m^2, N m^3\].
    turning: [S; 4],
    /// Nodal values where the variations are taken.
    at: ElementValues<S>,
    /// Nodal values at the end of the step.
    end: ElementValues<S>,
    /// Gamma2 that its variations are multiplied by in that of the axial strain: its mean over the step, and that at its end, shape (2) \[-\].
    across: [S; 2],
    /// Derivatives of the first three with respect to the strains at the end, shape (3) \[N m, N m, N m^3\].
    slopes: [S; 3],
    /// Derivative of the second with respect to the bend, and of the third with respect to Gamma2 \[N m^2\].
    coupled: S,
    /// Share of the step at which the variations are taken.
    share: f64,
}

/// Least Gamma1 of the chord by a unit of even stretch that is counted: it is smaller in elements that turn by more than 110 degrees in the reference,
/// and zero in a half circle.
const LEAST_STRETCH: f64 = 0.5;

impl ShearTable {
    /// Table of an element between two nodes, with the sections at its Gauss points.
    ///
    /// Linear elements with one point cannot bend between their nodes: the flexibility missed, `L^2 / (12 EI)` per unit of shear, is added to that
    /// of shear (MacNeal's residual bending flexibility). Nodal displacements of a straight beam in equilibrium are then exact, for any slenderness and
    /// any number of elements; that of a section which varies has the flexibility of the element under a moment in its middle and a shear force.
    pub fn new(length: f64, ends: [NodeFrame; 2], sections: &[SectionValues; GAUSS]) -> Self {
        let [a, b] = ends;
        let middle = &sections[MIDDLE];
        let (axial, [bending, coupling, shear]) = stiffness(length, sections);
        let chord = sub(b.position, a.position);
        let share = 1.0 - Self::bent_share(length, middle);
        let bent = 1.0 - share;
        let even = 0.5 * dot(chord, add(a.tangent, b.tangent));
        Self {
            length,
            chord,
            directors: [a.tangent, b.tangent],
            back: [dot(a.tangent, b.tangent), cross(b.tangent, a.tangent)],
            stiffness: [axial, shear, bending].map(|stiffness| stiffness * length),
            coupling: coupling * length,
            shear_share: share,
            leaning: 1.0 - share * share + 0.2 * bent * bent,
            per_stretch: 1.0 / (even / length).max(LEAST_STRETCH),
        }
    }

    /// Share of bending in the flexibility in shear of an element of a length and a section.
    pub fn bent_share(length: f64, section: &SectionValues) -> f64 {
        1.0 / (1.0 + 12.0 * section.law.bending / (section.shear * length * length))
    }

    /// The field inside it.
    pub fn inside(&self) -> InsideField {
        InsideField { length: self.length, bent: 1.0 - self.shear_share }
    }

    /// Share of shear in the energy of [`energies`](Self::energies) for it; the rest is energy of bending between the nodes.
    pub fn shear_share(&self) -> f64 {
        self.shear_share
    }

    /// The table that shares mass, loads and drawing with slender elements: mass, rotary inertia on d, and no stiffness, which is that of `self`.
    /// All of the length is at the middle, where its fibres are if it has some.
    pub fn carried_by(
        &self,
        table: ElementTable,
        sections: &[SectionValues; GAUSS],
    ) -> ElementTable {
        let mut rows = table.rows;
        for (j, row) in rows.iter_mut().enumerate() {
            (row.weighed.axial, row.weighed.bending, row.weighed.rotary) = (0.0, 0.0, 0.0);
            row.weight = if j == MIDDLE { self.length } else { 0.0 };
        }
        ElementTable {
            rows,
            mass: inertia::mass(&self.inside(), sections),
            membrane: None,
            ..table
        }
    }

    /// Strains less those of the reference. Formed from displacements: small ones keep their digits.
    #[inline]
    pub fn strains<S: Real>(&self, u: &ElementValues<S>) -> ShearStrains<S> {
        let wide = |x: [f64; 2]| x.map(|x| u.chord[0].constant(x));
        let (c0, [a0, b0]) = (wide(self.chord), self.directors.map(wide));
        let mean = |a: [S; 2], b: [S; 2]| add(a, b).map(|x| x * 0.5);
        let turned = mean(u.slope_a, u.slope_b);
        let d = add(mean(a0, b0), turned);
        let (apart, change) = (sub(b0, a0), sub(u.slope_b, u.slope_a));
        let away = self.away(u);
        let stretch = dot(c0, turned) + dot(u.chord, d);
        let shear = cross(d, u.chord) + cross(turned, c0);
        let bend = cross(away, add(a0, u.slope_a));
        let per_length = self.length.recip();
        let [stretch, shear, bend] = [stretch, shear, bend].map(|strain| strain * per_length);
        let curved = dot(add(apart, change.map(|x| x * 0.5)), change) * (1.0 / 3.0);
        let square = dot(away, away) * (0.5 * per_length * per_length);
        let axial = (stretch + curved) * self.per_stretch + shear * shear * (0.5 * self.leaning);
        ShearStrains { linear: [axial, shear, bend], square }
    }

    /// The first vector d less the second turned back by Q, which in the reference are the same, shape (2) \[-\].
    #[inline]
    fn away<S: Real>(&self, u: &ElementValues<S>) -> [S; 2] {
        sub(u.slope_a, self.turned_back(u.slope_b))
    }

    /// A vector turned by Q.
    #[inline]
    fn turned_back<S: Real>(&self, [x, y]: [S; 2]) -> [S; 2] {
        let [cosine, sine] = self.back;
        [x * cosine - y * sine, x * sine + y * cosine]
    }

    /// A vector turned by the inverse of Q.
    #[inline]
    fn turned_on<S: Real>(&self, [x, y]: [S; 2]) -> [S; 2] {
        let [cosine, sine] = self.back;
        [x * cosine + y * sine, y * cosine - x * sine]
    }

    /// Forces of a step of a scheme with mean strains, and their tangent if `TANGENT`; `lag` is the retardation time over the step size.
    pub fn mean<S: Real, const TANGENT: bool>(
        &self,
        start: &ElementValues<S>,
        increment: &ElementValues<S>,
        lag: f64,
    ) -> ElementSums<S> {
        let end = moved(start, increment, 1.0);
        let (old, new) = (self.strains(start).linear, self.strains(&end).linear);
        let one = start.chord[0].constant(1.0);
        let stress = self.stresses(one, [0, 1, 2].map(|k| (old[k] + new[k]) * 0.5));
        let viscous = self.viscous(array(|k| (new[k] - old[k]) * lag));
        let [axial, shear, moment, square] = stress;
        let stress = [axial + viscous[0], shear + viscous[1], moment + viscous[2], square];
        let at = moved(start, increment, 0.5);
        let elastic = self.acting();
        let slopes = [0, 1, 2].map(|k| one * (0.5 * elastic[k] + lag * self.stiffness[k]));
        let coupled = one * ((0.5 + lag) * self.coupling);
        let (turning, across) = (stress, [(old[1] + new[1]) * 0.5, new[1]]);
        self.sums::<S, TANGENT>(&Evaluated {
            stress,
            turning,
            at,
            end,
            across,
            slopes,
            coupled,
            share: 0.5,
        })
    }

    /// Forces at the end of a step, as in an equilibrium, and their tangent if `TANGENT`. Its geometric stiffness is that of the strains
    /// `foreseen` by the last correction: an iteration for large displacements of a slender beam then takes a few corrections, not dozens.
    pub fn at_end<S: Real, const TANGENT: bool>(
        &self,
        start: &ElementValues<S>,
        increment: &ElementValues<S>,
        foreseen: Option<[f64; 3]>,
    ) -> ElementSums<S> {
        let end = moved(start, increment, 1.0);
        let one = start.chord[0].constant(1.0);
        let strains = self.strains(&end).linear;
        let stress = self.stresses(one, strains);
        let turning =
            foreseen.map_or(stress, |strains| self.stresses(one, strains.map(|e| one * e)));
        let slopes = self.acting().map(|k| one * k);
        let (at, across, coupled) = (end, [strains[1]; 2], one * self.coupling);
        self.sums::<S, TANGENT>(&Evaluated {
            stress,
            turning,
            at,
            end,
            across,
            slopes,
            coupled,
            share: 1.0,
        })
    }

    /// Tangent at displacements with the geometric stiffness of given strains, stored as [`stored`] does; without any if there are none, so that
    /// rigid motions of a bent element have no stiffness.
    pub fn tangent<S: Real>(
        &self,
        at: &ElementValues<S>,
        strains: Option<[f64; 3]>,
    ) -> ElementSums<S> {
        let one = at.chord[0].constant(1.0);
        let (stress, slopes) = match strains {
            Some(strains) => (self.stresses(one, strains.map(|e| one * e)), self.acting()),
            None => ([one.constant(0.0); 4], self.stiffness),
        };
        let (turning, slopes) = (stress, slopes.map(|k| one * k));
        let (end, across) = (*at, [self.strains(at).linear[1]; 2]);
        self.sums::<S, true>(&Evaluated {
            stress,
            turning,
            at: end,
            end,
            across,
            slopes,
            coupled: one * self.coupling,
            share: 1.0,
        })
    }

    /// Stiffnesses that act on the linear strains, shape (3) \[N m, N m, N m^3\].
    fn acting(&self) -> [f64; 3] {
        let [axial, shear, bending] = self.stiffness;
        [axial, shear, BENDING[1] * bending]
    }

    /// Stresses on the linear strains and on the square of turning, which is constant.
    #[inline]
    fn stresses<S: Real>(&self, one: S, strains: [S; 3]) -> [S; 4] {
        let elastic = self.acting();
        let [axial, shear, moment] = [0, 1, 2].map(|k| strains[k] * elastic[k]);
        let [shear, moment] =
            [shear + strains[2] * self.coupling, moment + strains[1] * self.coupling];
        [axial, shear, moment, one * (BENDING[0] * self.stiffness[2])]
    }

    /// Stresses in proportion to changes of the linear strains.
    #[inline]
    fn viscous<S: Real>(&self, change: [S; 3]) -> [S; 3] {
        let [axial, shear, moment] = array(|k| change[k] * self.stiffness[k]);
        [axial, shear + change[2] * self.coupling, moment + change[1] * self.coupling]
    }

    /// Linear strains after a correction of displacements, to first order, shape (3) \[-, -, 1/m\].
    pub fn foresee(&self, at: &ElementValues<f64>, correction: &ElementValues<f64>) -> [f64; 3] {
        let ElementValues { chord: [c1, c2], slope_a: [a1, a2], slope_b: [b1, b2] } = *correction;
        let now = self.strains(at).linear;
        let forms = self.gradients(at, now[1]);
        let moved = [c1, c2, a1, a2, b1, b2];
        [0, 1, 2].map(|k| now[k] + forms[k].iter().zip(moved).map(|(f, d)| f * d).sum::<f64>())
    }

    /// Twice the energies of stretching, of shear and of bending at displacements, shape (3) \[J\].
    pub fn energies(&self, u: &ElementValues<f64>) -> [f64; 3] {
        let ([axial, shear, bending], strains) = (self.stiffness, self.strains(u));
        let [stretch, across, bend] = strains.linear;
        let bent = 2.0 * BENDING[0] * strains.square + BENDING[1] * bend * bend;
        let coupled = 2.0 * self.coupling * across * bend;
        [axial * stretch * stretch, shear * across * across, bending * bent + coupled]
    }

    /// What viscous stresses lose in a step, without the factor of retardation time over step size \[J\].
    pub fn viscous_loss(&self, start: &ElementValues<f64>, end: &ElementValues<f64>) -> f64 {
        let (old, new) = (self.strains(start).linear, self.strains(end).linear);
        let change: [f64; 3] = array(|k| new[k] - old[k]);
        self.viscous(change).iter().zip(change).map(|(stress, change)| stress * change).sum()
    }

    /// What viscous stresses of shear alone lose in a step, likewise \[J\].
    pub fn viscous_loss_across(&self, start: &ElementValues<f64>, end: &ElementValues<f64>) -> f64 {
        let [old, new] = [start, end].map(|u| self.strains(u).linear[1]);
        self.stiffness[1] * (new - old).powi(2)
    }
}

/// EA, and the stiffnesses of bend, of both, and of Gamma2, shape (3) \[N, N m^2, N m, N\]: the inverse of the flexibility under a moment M in the
/// middle and a shear force V, with which the moment is `M - V x` along the element.
fn stiffness(length: f64, sections: &[SectionValues; GAUSS]) -> (f64, [f64; 3]) {
    let SectionValues { law, shear, .. } = sections[MIDDLE];
    let constants = |of: &SectionValues| [of.law.axial, of.law.bending, of.shear];
    if sections.iter().all(|of| constants(of) == constants(&sections[MIDDLE])) {
        let across = (1.0 / shear + length * length / (12.0 * law.bending)).recip();
        return (law.axial, [law.bending, 0.0, across]);
    }
    let mean = |of: &dyn Fn(f64, &SectionValues) -> f64| -> f64 {
        let points = gauss_points().into_iter().zip(sections).zip(GAUSS_WEIGHTS);
        points.map(|((xi, section), weight)| weight * of((xi - 0.5) * length, section)).sum()
    };
    let axial = mean(&|_, section| section.law.axial.recip()).recip();
    let even = mean(&|_, section| section.law.bending.recip());
    let mixed = mean(&|x, section| x / section.law.bending);
    let across = mean(&|x, section| x * x / section.law.bending + section.shear.recip());
    let determinant = even * across - mixed * mixed;
    (axial, [across, mixed, even].map(|flexibility| flexibility / determinant))
}

/// Linear strains as they are stored beside those of slender elements: Gamma1 and the bend, then Gamma2.
pub fn stored([stretch, shear, bend]: [f64; 3]) -> [[f64; 2]; GAUSS] {
    [[stretch, bend], [shear, 0.0], [0.0; 2]]
}

/// The strains stored.
pub fn from_stored([[stretch, bend], [shear, _], _]: &[[f64; 2]; GAUSS]) -> [f64; 3] {
    [*stretch, *shear, *bend]
}

/// Nodal values after a share of a step.
pub fn moved<S: Real>(
    start: &ElementValues<S>,
    increment: &ElementValues<S>,
    share: f64,
) -> ElementValues<S> {
    let after = |from: [S; 2], by: [S; 2]| add(from, by.map(|x| x * share));
    ElementValues {
        chord: after(start.chord, increment.chord),
        slope_a: after(start.slope_a, increment.slope_a),
        slope_b: after(start.slope_b, increment.slope_b),
    }
}

#[cfg(test)]
mod tests;
