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

#[cfg(test)]
mod examples;
mod fibres;
mod inertia;

pub use inertia::spread_linearly;

use super::beam::{ElementSums, ElementTable, ElementValues, NodeFrame};
use super::gauss::SectionValues;
use crate::math::hermite::GAUSS;
use crate::math::vec2::{add, cross, dot, rot90, scale, sub};
use crate::scalar::Real;

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
    /// Share of shear in its flexibility in shear; the rest is that of residual bending \[-\].
    shear_share: f64,
}

/// Strains of an element less those of the reference.
#[derive(Clone, Copy, Debug)]
pub struct ShearStrains<S> {
    /// Gamma1, Gamma2 and the sine of the angle of turning over the length, shape (3) \[-, -, 1/m\].
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
    /// Derivatives of the first three with respect to the strains at the end, shape (3) \[N m, N m, N m^3\].
    slopes: [S; 3],
    /// Share of the step at which the variations are taken.
    share: f64,
}

impl ShearTable {
    /// Table of an element between two nodes, with the section in its middle.
    ///
    /// Linear elements with one point cannot bend between their nodes: the flexibility missed, `L^2 / (12 EI)` per unit of shear, is added to that
    /// of shear (MacNeal's residual bending flexibility). Nodal displacements of a straight uniform beam in equilibrium are then exact, for any
    /// slenderness and any number of elements.
    pub fn new(length: f64, ends: [NodeFrame; 2], middle: &SectionValues) -> Self {
        let [a, b] = ends;
        let (axial, bending) = (middle.law.axial, middle.law.bending);
        let shear = (1.0 / middle.shear + length * length / (12.0 * bending)).recip();
        Self {
            length,
            chord: [0, 1].map(|i| b.position[i] - a.position[i]),
            directors: [a.tangent, b.tangent],
            back: [dot(a.tangent, b.tangent), cross(b.tangent, a.tangent)],
            stiffness: [axial, shear, bending].map(|stiffness| stiffness * length),
            shear_share: shear / middle.shear,
        }
    }

    /// Share of shear in the energy of [`energies`](Self::energies) for it; the rest is energy of bending between the nodes.
    pub fn shear_share(&self) -> f64 {
        self.shear_share
    }

    /// The table that shares mass, loads and drawing with slender elements: mass, rotary inertia on d, and no stiffness, which is that of `self`.
    /// All of the length is at the middle, where its fibres are if it has some.
    pub fn carried_by(&self, table: ElementTable, middle: &SectionValues) -> ElementTable {
        let mut rows = table.rows;
        for (j, row) in rows.iter_mut().enumerate() {
            (row.weighed.axial, row.weighed.bending, row.weighed.rotary) = (0.0, 0.0, 0.0);
            row.weight = if j == MIDDLE { self.length } else { 0.0 };
        }
        ElementTable { rows, mass: inertia::mass(self.length, middle), membrane: None, ..table }
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
        ShearStrains { linear: [stretch + curved, shear, bend], square }
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
        let viscous = |k: usize| (new[k] - old[k]) * (lag * self.stiffness[k]);
        let [axial, shear, moment, square] = stress;
        let stress = [axial + viscous(0), shear + viscous(1), moment + viscous(2), square];
        let at = moved(start, increment, 0.5);
        let elastic = self.acting();
        let slopes = [0, 1, 2].map(|k| one * (0.5 * elastic[k] + lag * self.stiffness[k]));
        let turning = stress;
        self.sums::<S, TANGENT>(&Evaluated { stress, turning, at, end, slopes, share: 0.5 })
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
        let stress = self.stresses(one, self.strains(&end).linear);
        let turning =
            foreseen.map_or(stress, |strains| self.stresses(one, strains.map(|e| one * e)));
        let slopes = self.acting().map(|k| one * k);
        self.sums::<S, TANGENT>(&Evaluated { stress, turning, at: end, end, slopes, share: 1.0 })
    }

    /// What stretch and bend that need no force add to the forces, with the gradient at a share of the step, and to their tangent if `TANGENT`. The
    /// strains are quadratic: with the gradient in the middle, the work is exact for any step.
    pub fn relieved<S: Real, const TANGENT: bool>(
        &self,
        start: &ElementValues<S>,
        increment: &ElementValues<S>,
        share: f64,
        [stretch, bend]: [f64; 2],
    ) -> ElementSums<S> {
        let (end, at) = (moved(start, increment, 1.0), moved(start, increment, share));
        let zero = start.chord[0].constant(0.0);
        let [axial, _, bending] = self.stiffness;
        let stress = [zero.constant(-stretch * axial), zero, zero.constant(-bend * bending), zero];
        let (turning, slopes) = (stress, [zero; 3]); // constant stresses
        self.sums::<S, TANGENT>(&Evaluated { stress, turning, at, end, slopes, share })
    }

    /// What they add to the energies of stretching and of bending, shape (2) \[J\].
    pub fn energy_relieved(&self, at: &ElementValues<f64>, [stretch, bend]: [f64; 2]) -> [f64; 2] {
        let ([axial, _, bending], [own, _, bent]) = (self.stiffness, self.strains(at).linear);
        [axial * stretch * (0.5 * stretch - own), bending * bend * (0.5 * bend - bent)]
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
        self.sums::<S, true>(&Evaluated { stress, turning, at: *at, end: *at, slopes, share: 1.0 })
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
        [axial, shear, moment, one * (BENDING[0] * self.stiffness[2])]
    }

    /// Linear strains after a correction of displacements, to first order, shape (3) \[-, -, 1/m\].
    pub fn foresee(&self, at: &ElementValues<f64>, correction: &ElementValues<f64>) -> [f64; 3] {
        let ElementValues { chord: [c1, c2], slope_a: [a1, a2], slope_b: [b1, b2] } = *correction;
        let (now, forms) = (self.strains(at).linear, self.gradients(at));
        let moved = [c1, c2, a1, a2, b1, b2];
        [0, 1, 2].map(|k| now[k] + forms[k].iter().zip(moved).map(|(f, d)| f * d).sum::<f64>())
    }

    /// Twice the energies of stretching, of shear and of bending at displacements, shape (3) \[J\].
    pub fn energies(&self, u: &ElementValues<f64>) -> [f64; 3] {
        let ([axial, shear, bending], strains) = (self.stiffness, self.strains(u));
        let [stretch, across, bend] = strains.linear;
        let bent = 2.0 * BENDING[0] * strains.square + BENDING[1] * bend * bend;
        [axial * stretch * stretch, shear * across * across, bending * bent]
    }

    /// What viscous stresses lose in a step, without the factor of retardation time over step size \[J\].
    pub fn viscous_loss(&self, start: &ElementValues<f64>, end: &ElementValues<f64>) -> f64 {
        let (old, new) = (self.strains(start).linear, self.strains(end).linear);
        (0..3).map(|k| self.stiffness[k] * (new[k] - old[k]).powi(2)).sum()
    }

    /// What viscous stresses of shear alone lose in a step, likewise \[J\].
    pub fn viscous_loss_across(&self, start: &ElementValues<f64>, end: &ElementValues<f64>) -> f64 {
        let [old, new] = [start, end].map(|u| self.strains(u).linear[1]);
        self.stiffness[1] * (new - old).powi(2)
    }

    fn sums<S: Real, const TANGENT: bool>(&self, of: &Evaluated<S>) -> ElementSums<S> {
        let mut sums = ElementSums::zero(of.slopes[0]);
        let at = self.gradients(&of.at);
        for (form, stress) in at.iter().zip(of.stress) {
            for i in 0..6 {
                sums.force[i] = sums.force[i].add_product(stress, form[i]);
            }
        }
        if !TANGENT {
            return sums;
        }
        let end = self.gradients(&of.end);
        for k in 0..3 {
            for i in 0..6 {
                let left = at[k][i] * of.slopes[k];
                for j in 0..6 {
                    sums.tangent[i][j] = sums.tangent[i][j].add_product(left, end[k][j]);
                }
            }
        }
        self.add_second(&of.turning.map(|stress| stress * of.share), &mut sums);
        sums
    }

    /// Derivatives of the linear strains and of the square of turning with respect to the nodal values, shape (4, 6) \[1/m, -, -\], of the third
    /// \[1/m^2, 1/m, 1/m\] and of the last \[-, 1/m^2, 1/m^2\], those with respect to the chord being zero.
    fn gradients<S: Real>(&self, u: &ElementValues<S>) -> [[S; 6]; 4] {
        let wide = |x: [f64; 2]| x.map(|x| u.chord[0].constant(x));
        let per_length = u.chord[0].constant(self.length.recip());
        let [a0, b0] = self.directors.map(wide);
        let (c, a, b) = (add(wide(self.chord), u.chord), add(a0, u.slope_a), add(b0, u.slope_b));
        let d = scale(per_length * 0.5, add(a, b));
        let along = scale(per_length * 0.5, c);
        let apart = sub(b, a).map(|x| x * (1.0 / 3.0));
        let ([s1, s2], [n1, n2]) = (along, rot90(d));
        let ([to_a1, to_a2], [to_b1, to_b2]) = (sub(along, apart), add(along, apart));
        let [a1, a2] = scale(per_length, self.turned_on(a));
        let [b1, b2] = scale(per_length, self.turned_back(b));
        let away = scale(per_length * per_length, self.away(u));
        let ([w1, w2], [v1, v2]) = (away, self.turned_on(away));
        let zero = per_length.constant(0.0);
        [
            [d[0], d[1], to_a1, to_a2, to_b1, to_b2],
            [n1, n2, s2, -s1, s2, -s1],
            [zero, zero, b2, -b1, -a2, a1],
            [zero, zero, w1, w2, -v1, -v2],
        ]
    }

    /// Adds the second derivatives of the strains, times the stresses.
    fn add_second<S: Real>(&self, stress: &[S; 4], sums: &mut ElementSums<S>) {
        let per_length = self.length.recip();
        let [cosine, sine] = self.back;
        let [axial, shear, moment] = [0, 1, 2].map(|k| stress[k] * per_length);
        let curved = stress[0] * (1.0 / 3.0);
        let square = stress[3] * (per_length * per_length);
        for i in 2..6 {
            sums.tangent[i][i] += curved + square;
        }
        let mut both = |i: usize, j: usize, value: S| {
            sums.tangent[i][j] += value;
            sums.tangent[j][i] += value;
        };
        for d in [2, 4] {
            both(0, d, axial * 0.5);
            both(1, d + 1, axial * 0.5);
            both(0, d + 1, shear * -0.5);
            both(1, d, shear * 0.5);
        }
        let (same, other) = (moment * sine - square * cosine, moment * cosine + square * sine);
        both(2, 4, same - curved);
        both(3, 5, same - curved);
        both(2, 5, other);
        both(3, 4, -other);
    }
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
