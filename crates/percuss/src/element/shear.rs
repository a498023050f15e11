//! The shear-flexible element (Simo and Reissner, in the plane), with linear interpolation and one integration point.
//!
//! A node carries its position x and a unit vector d, the normal of its section, in the place of the tangent of a slender beam. The strains
//! `Gamma1 = x'.d - 1`, `Gamma2 = x'.(J d)`, `K = d'.(J d)`, less those of the reference, are bilinear in (x, d): with their means over a
//! step and their variations in its middle, energy and momenta are conserved for any step (theory, page 2). The unit length of d is a
//! constraint of each node.

use super::beam::{ElementSums, ElementTable, ElementValues, NodeFrame};
use super::gauss::SectionValues;
use crate::math::hermite::GAUSS;
use crate::math::vec2::{add, cross, dot, rot90, scale};
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
    /// EA, shear stiffness and EI, times the length, shape (3) \[N m, N m, N m^3\].
    stiffness: [f64; 3],
    /// Share of shear in its flexibility in shear; the rest is that of residual bending \[-\].
    shear_share: f64,
}

/// Forces at an evaluation of the element.
struct Evaluated<S> {
    /// Integrated stresses, shape (3) \[N m, N m, N m^2\].
    stress: [S; 3],
    /// Those that turn with the element in its tangent, shape (3) \[N m, N m, N m^2\].
    turning: [S; 3],
    /// Nodal values where the variations are taken.
    at: ElementValues<S>,
    /// Nodal values at the end of the step.
    end: ElementValues<S>,
    /// Derivative of the stresses with respect to the strains at the end, over the stiffness.
    weight: S,
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
            stiffness: [axial, shear, bending].map(|stiffness| stiffness * length),
            shear_share: shear / middle.shear,
        }
    }

    /// Share of shear in the energy of [`energies`](Self::energies) for it; the rest is energy of bending between the nodes.
    pub fn shear_share(&self) -> f64 {
        self.shear_share
    }

    /// The table that shares mass, loads and drawing with slender elements: mass, rotary inertia on d, and no stiffness, which is that of `self`.
    ///
    /// Its mass moves with positions that follow the turn of the sections, `x + l/2 xi (1 - xi) (d_a - d_b)` beside the straight line: that of an
    /// element bent without shear. The matrix is constant, as positions are linear in (x, d).
    pub fn carried_by(&self, table: ElementTable, middle: &SectionValues) -> ElementTable {
        let l = self.length;
        let (whole, half) = (l / 3.0, l / 6.0);
        let (arm, square) = (l * l / 24.0, l * l * l / 120.0);
        let mut mass = [
            [whole, arm, half, -arm],
            [arm, square, arm, -square],
            [half, arm, whole, -arm],
            [-arm, -square, -arm, square],
        ]
        .map(|row| row.map(|m| middle.mass * m));
        for a in 0..2 {
            for b in 0..2 {
                let share = if a == b { whole } else { half };
                mass[2 * a + 1][2 * b + 1] += middle.law.rotary * share;
            }
        }
        let mut rows = table.rows;
        for row in &mut rows {
            (row.weighed.axial, row.weighed.bending, row.weighed.rotary) = (0.0, 0.0, 0.0);
        }
        ElementTable { rows, mass, membrane: None, ..table }
    }

    /// Strains Gamma1, Gamma2 and K less those of the reference, shape (3) \[-, -, 1/m\]. Formed from displacements: small ones keep their digits.
    #[inline]
    pub fn strains<S: Real>(&self, u: &ElementValues<S>) -> [S; 3] {
        let wide = |x: [f64; 2]| x.map(|x| u.chord[0].constant(x));
        let (c0, [a0, b0]) = (wide(self.chord), self.directors.map(wide));
        let mean = |a: [S; 2], b: [S; 2]| add(a, b).map(|x| x * 0.5);
        let turned = mean(u.slope_a, u.slope_b);
        let d = add(mean(a0, b0), turned);
        let stretch = dot(c0, turned) + dot(u.chord, d);
        let shear = cross(d, u.chord) + cross(turned, c0);
        let bend = cross(add(a0, u.slope_a), u.slope_b) + cross(u.slope_a, b0);
        [stretch, shear, bend].map(|strain| strain * self.length.recip())
    }

    /// Forces of a step of a scheme with mean strains, and their tangent if `TANGENT`; `lag` is the retardation time over the step size.
    pub fn mean<S: Real, const TANGENT: bool>(
        &self,
        start: &ElementValues<S>,
        increment: &ElementValues<S>,
        lag: f64,
    ) -> ElementSums<S> {
        let end = moved(start, increment, 1.0);
        let (old, new) = (self.strains(start), self.strains(&end));
        let one = |k: usize| {
            let viscous = (new[k] - old[k]) * lag;
            ((old[k] + new[k]) * 0.5 + viscous) * self.stiffness[k]
        };
        let (stress, at) = ([one(0), one(1), one(2)], moved(start, increment, 0.5));
        let weight = start.chord[0].constant(0.5 + lag);
        let turning = stress;
        self.sums::<S, TANGENT>(&Evaluated { stress, turning, at, end, weight, share: 0.5 })
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
        let strains = self.strains(&end);
        let stress = [0, 1, 2].map(|k| strains[k] * self.stiffness[k]);
        let weight = start.chord[0].constant(1.0);
        let turning = foreseen.map_or(stress, |strains| self.stresses(weight, strains));
        self.sums::<S, TANGENT>(&Evaluated { stress, turning, at: end, end, weight, share: 1.0 })
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
        let weight = start.chord[0].constant(0.0); // constant stresses
        let stress = [stretch, 0.0, bend];
        let stress = [0, 1, 2].map(|k| weight.constant(-stress[k] * self.stiffness[k]));
        let turning = stress;
        self.sums::<S, TANGENT>(&Evaluated { stress, turning, at, end, weight, share })
    }

    /// What they add to the energies of stretching and of bending, shape (2) \[J\].
    pub fn energy_relieved(&self, at: &ElementValues<f64>, [stretch, bend]: [f64; 2]) -> [f64; 2] {
        let ([axial, _, bending], [own, _, bent]) = (self.stiffness, self.strains(at));
        [axial * stretch * (0.5 * stretch - own), bending * bend * (0.5 * bend - bent)]
    }

    /// Tangent at displacements with the geometric stiffness of given strains, in the order of [`strains`](Self::strains()).
    pub fn tangent<S: Real>(&self, at: &ElementValues<S>, strains: [f64; 3]) -> ElementSums<S> {
        let weight = at.chord[0].constant(1.0);
        let stress = self.stresses(weight, strains);
        let turning = stress;
        self.sums::<S, true>(&Evaluated { stress, turning, at: *at, end: *at, weight, share: 1.0 })
    }

    fn stresses<S: Real>(&self, one: S, strains: [f64; 3]) -> [S; 3] {
        [0, 1, 2].map(|k| one * (strains[k] * self.stiffness[k]))
    }

    /// Strains after a correction of displacements, to first order.
    pub fn foresee(&self, at: &ElementValues<f64>, correction: &ElementValues<f64>) -> [f64; 3] {
        let ElementValues { chord: [c1, c2], slope_a: [a1, a2], slope_b: [b1, b2] } = *correction;
        let (now, forms) = (self.strains(at), self.gradients(at));
        let moved = [c1, c2, a1, a2, b1, b2];
        [0, 1, 2].map(|k| now[k] + forms[k].iter().zip(moved).map(|(f, d)| f * d).sum::<f64>())
    }

    /// Twice the energies of stretching, of shear and of bending at displacements, or such sums of changes of strain, shape (3) \[J\].
    pub fn energies(&self, strains: &[f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| self.stiffness[k] * strains[k] * strains[k])
    }

    fn sums<S: Real, const TANGENT: bool>(&self, of: &Evaluated<S>) -> ElementSums<S> {
        let mut sums = ElementSums::zero(of.weight);
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
            let stiffness = of.weight * self.stiffness[k];
            for i in 0..6 {
                let left = at[k][i] * stiffness;
                for j in 0..6 {
                    sums.tangent[i][j] = sums.tangent[i][j].add_product(left, end[k][j]);
                }
            }
        }
        add_second(&of.turning.map(|s| s * (of.share / self.length)), &mut sums);
        sums
    }

    /// Derivatives of the strains with respect to the nodal values, shape (3, 6) \[1/m, -, -\] and, of the last, \[1/m^2, 1/m, 1/m\].
    fn gradients<S: Real>(&self, u: &ElementValues<S>) -> [[S; 6]; 3] {
        let wide = |x: [f64; 2]| x.map(|x| u.chord[0].constant(x));
        let per_length = u.chord[0].constant(self.length.recip());
        let [a0, b0] = self.directors.map(wide);
        let (c, a, b) = (add(wide(self.chord), u.chord), add(a0, u.slope_a), add(b0, u.slope_b));
        let d = scale(per_length * 0.5, add(a, b));
        let along = scale(per_length * 0.5, c);
        let ([s1, s2], [n1, n2]) = (along, rot90(d));
        let ([a1, a2], [b1, b2]) = (scale(per_length, a), scale(per_length, b));
        let zero = per_length.constant(0.0);
        [[d[0], d[1], s1, s2, s1, s2], [n1, n2, s2, -s1, s2, -s1], [zero, zero, b2, -b1, -a2, a1]]
    }
}

/// Adds second derivatives of the strains, times `stress`, the stresses over the length.
fn add_second<S: Real>(stress: &[S; 3], sums: &mut ElementSums<S>) {
    let [axial, shear, moment] = *stress;
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
    both(2, 5, moment);
    both(3, 4, -moment);
}

/// Strains as they are stored beside those of slender elements: Gamma1 and K, then Gamma2.
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
