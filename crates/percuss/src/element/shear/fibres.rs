//! A shear-flexible element whose section consists of fibres, at its one point.
//!
//! The fibres have the strains `e - y K`, e the axial strain of the element. With the sine of turning k and the square of turning q, as in [`ShearStrains`], K is
//! `k (1 + l^2 q / 3)`: the angle of turning over the length but for the share `t^4 / 30`. Both are quadratic in (x, d), so that over a step
//! `K_1 - K_0 = (1 + l^2 q_m / 3) (k_1 - k_0) + l^2 k_m / 3 (q_1 - q_0)` with the means of both ends, and the differences are the variations
//! in the middle of the step: the work of the fibres is exact for any step. The shear force is elastic.

use super::{MIDDLE, ShearStrains, ShearTable, moved};
use crate::element::beam::{ElementSums, ElementValues};
use crate::element::yielding::{ElementFibres, ElementForm, SectionResponse, add_section};
use crate::math::vec2::dot;
use crate::scalar::{Real, array};

/// A share of the square of turning, times that of the length.
const TURNING: f64 = 1.0 / 3.0;

/// Forces at an evaluation of the element.
struct FibreEvaluation<S> {
    /// Nodal values where the variations are taken, and at the end of the step, shape (2).
    values: [ElementValues<S>; 2],
    /// Strains by which the variation of K is that of its factors: the means over the step; and those at its end, shape (2).
    strains: [ShearStrains<S>; 2],
    /// Forces of the section and their derivatives with respect to membrane and bending strain at the end.
    response: SectionResponse<S>,
    /// Shear force and its derivative with respect to Gamma2 at the end, shape (2) \[N\].
    shear: [S; 2],
    /// Axial force, shear force and moment that turn with the element in its tangent, shape (3) \[N, N, N m\].
    turning: [S; 3],
    /// Share of the step at which the variations are taken.
    share: f64,
}

impl<S: Real> ShearStrains<S> {
    /// Means of two.
    fn mean(&self, other: &Self) -> Self {
        Self {
            linear: array(|k| (self.linear[k] + other.linear[k]) * 0.5),
            square: (self.square + other.square) * 0.5,
        }
    }
}

impl ShearTable {
    /// Membrane and bending strain of the fibres, shape (2) \[-, 1/m\]: the latter positive where sections turn clockwise, as that of slender
    /// elements.
    pub fn strains_of_fibres<S: Real>(&self, u: &ElementValues<S>) -> [S; 2] {
        self.of_fibres(&self.strains(u))
    }

    fn of_fibres<S: Real>(&self, strains: &ShearStrains<S>) -> [S; 2] {
        let [stretch, _, bend] = strains.linear;
        [stretch, -(bend * self.factors(strains)[0])]
    }

    /// Derivatives of K with respect to the sine and the square of turning, shape (2) \[-, m\].
    fn factors<S: Real>(&self, strains: &ShearStrains<S>) -> [S; 2] {
        let squared = self.length * self.length * TURNING;
        let one = strains.square.constant(1.0);
        [one + strains.square * squared, strains.linear[2] * squared]
    }

    /// Shear stiffness of the element, per length \[N\].
    fn shear_stiffness(&self) -> f64 {
        self.stiffness[1] / self.length
    }

    /// Forces of a step of a scheme with mean strains, and their tangent if `TANGENT`; `times` are the size of the step \[s\] and the retardation
    /// time over it.
    pub fn mean_with_fibres<const TANGENT: bool>(
        &self,
        fibres: &ElementFibres,
        start: &ElementValues<f64>,
        increment: &ElementValues<f64>,
        times: (f64, f64),
    ) -> ElementSums<f64> {
        let end = moved(start, increment, 1.0);
        let (old, new) = (self.strains(start), self.strains(&end));
        let (from, to) = (self.of_fibres(&old), self.of_fibres(&new));
        let change = [0, 1].map(|i| to[i] - from[i]);
        let response = fibres.mean(MIDDLE, [from, to, change], times);
        let (stiffness, lag) = (self.shear_stiffness(), times.1);
        let [before, after] = [old.linear[1], new.linear[1]];
        let across = stiffness * (0.5 * (before + after) + lag * (after - before));
        self.sums_with_fibres::<f64, TANGENT>(&FibreEvaluation {
            values: [moved(start, increment, 0.5), end],
            strains: [old.mean(&new), new],
            response,
            shear: [across, stiffness * (0.5 + lag)],
            turning: [response.axial, across, response.moment],
            share: 0.5,
        })
    }

    /// Forces at the end of a step, as in an equilibrium, and their tangent if `TANGENT`, of which the geometric stiffness is that of the strains
    /// `foreseen`.
    pub fn end_with_fibres<const TANGENT: bool>(
        &self,
        fibres: &ElementFibres,
        start: &ElementValues<f64>,
        increment: &ElementValues<f64>,
        foreseen: Option<[f64; 3]>,
    ) -> ElementSums<f64> {
        let end = moved(start, increment, 1.0);
        let strains = self.strains(&end);
        let stiffness = self.shear_stiffness();
        let forces = |of: &ShearStrains<f64>| {
            let response = fibres.end(MIDDLE, self.of_fibres(of));
            (response, [response.axial, stiffness * of.linear[1], response.moment])
        };
        let (response, own) = forces(&strains);
        let ahead = |linear: [f64; 3]| forces(&ShearStrains { linear, ..strains }).1;
        let turning = match foreseen {
            Some(linear) if TANGENT => ahead(linear),
            _ => own,
        };
        self.sums_with_fibres::<f64, TANGENT>(&FibreEvaluation {
            values: [end; 2],
            strains: [strains; 2],
            response,
            shear: [own[1], stiffness],
            turning,
            share: 1.0,
        })
    }

    /// Tangent at displacements of fibres that unload elastically, with the geometric stiffness of the forces that elastically go with the
    /// strains; without any if there are none.
    pub fn tangent_with_fibres<S: Real>(
        &self,
        at: &ElementValues<S>,
        strains: Option<[f64; 3]>,
    ) -> ElementSums<S> {
        let one = at.chord[0].constant(1.0);
        let zero = at.chord[0].constant(0.0);
        let [axial, shear, bending] = self.stiffness.map(|k| one * k * self.length.recip());
        let [stretch, across, bend] = strains.unwrap_or_default().map(|e| one * e);
        let (force, moment) = (axial * stretch, -(bending * bend));
        let tangent = [[axial, zero], [zero, bending]];
        let here = self.strains(at);
        self.sums_with_fibres::<S, true>(&FibreEvaluation {
            values: [*at; 2],
            strains: [here; 2],
            response: SectionResponse { axial: force, moment, tangent },
            shear: [shear * across, shear],
            turning: [force, shear * across, moment],
            share: 1.0,
        })
    }

    /// Forces of its fibres and its shear force over the elastic stiffnesses of its section, as strains, shape (3) \[-, -, 1/m\].
    pub fn elastic_strains(&self, fibres: &ElementFibres, u: &ElementValues<f64>) -> [f64; 3] {
        let strains = self.strains(u);
        let at = self.of_fibres(&strains);
        let (mut forces, mut stiffness) = ([0.0; 2], [0.0; 2]);
        for (fibre, memory) in fibres.at(MIDDLE) {
            let law = &fibres.laws[fibre.law];
            let arms = [1.0, fibre.height];
            let stress = law.stress(memory, dot(arms, at));
            for (i, arm) in arms.into_iter().enumerate() {
                forces[i] += fibre.area * arm * stress;
                stiffness[i] += fibre.area * arm * arm * law.young();
            }
        }
        [forces[0] / stiffness[0], strains.linear[1], -forces[1] / stiffness[1]]
    }

    fn sums_with_fibres<S: Real, const TANGENT: bool>(
        &self,
        of: &FibreEvaluation<S>,
    ) -> ElementSums<S> {
        let mut sums = ElementSums::zero(of.shear[0]);
        let weight = of.shear[0].constant(self.length);
        let [at, end] = [0, 1].map(|i| self.gradients(&of.values[i], of.strains[i].linear[1]));
        let factors = of.strains.each_ref().map(|strains| self.factors(strains));
        let bent = |g: &[ElementForm<S>; 4], [sine, square]: [S; 2]| -> ElementForm<S> {
            array(|i| -(g[2][i] * sine + g[3][i] * square))
        };
        let (bent_at, bent_end) = (bent(&at, factors[0]), bent(&end, factors[1]));
        let (gradients, ends) = ([&at[0], &bent_at], [&end[0], &bent_end]);
        add_section::<S, TANGENT>(&mut sums, weight, &of.response, gradients, ends);
        let [across, slope] = of.shear.map(|x| x * self.length);
        let moment = of.response.moment * self.length;
        for i in 0..6 {
            sums.force[i] =
                sums.force[i].add_product(across, at[1][i]).add_product(moment, bent_at[i]);
        }
        if !TANGENT {
            return sums;
        }
        let [force, shear, moment] = of.turning.map(|x| x * (self.length * of.share));
        let slope = self.leant(slope, force);
        // The factors of the variation of K vary as well.
        let varies = -moment * (self.length * self.length * TURNING);
        for i in 0..6 {
            let left = at[1][i] * slope;
            let (by_sine, by_square) = (at[2][i] * varies, at[3][i] * varies);
            for j in 0..6 {
                sums.tangent[i][j] = sums.tangent[i][j]
                    .add_product(left, end[1][j])
                    .add_product(by_sine, end[3][j])
                    .add_product(by_square, end[2][j]);
            }
        }
        let [sine, square] = factors[0];
        let stress = [force, shear, -(moment * sine), -(moment * square)];
        self.add_second(&stress, of.strains[0].linear[1], &mut sums);
        sums
    }
}

#[cfg(test)]
mod tests;
