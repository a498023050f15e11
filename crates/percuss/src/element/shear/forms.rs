//! Forces of a shear-flexible element along the gradients of its strains, and their tangent.

use super::{Evaluated, ShearTable};
use crate::element::beam::{ElementSums, ElementValues};
use crate::math::vec2::{add, rot90, scale, sub};
use crate::scalar::{Real, array};

impl ShearTable {
    pub(super) fn sums<S: Real, const TANGENT: bool>(&self, of: &Evaluated<S>) -> ElementSums<S> {
        let mut sums = ElementSums::zero(of.slopes[0]);
        let [across, across_end] = of.across;
        let at = self.gradients(&of.at, across);
        for (form, stress) in at.iter().zip(of.stress) {
            for i in 0..6 {
                sums.force[i] = sums.force[i].add_product(stress, form[i]);
            }
        }
        if !TANGENT {
            return sums;
        }
        let end = self.gradients(&of.end, across_end);
        let turning = of.turning.map(|stress| stress * of.share);
        let [axial, shear, bend] = of.slopes;
        let slopes = [axial, self.leant(shear, turning[0]), bend];
        for k in 0..3 {
            for i in 0..6 {
                let left = at[k][i] * slopes[k];
                for j in 0..6 {
                    sums.tangent[i][j] = sums.tangent[i][j].add_product(left, end[k][j]);
                }
            }
        }
        if self.coupling != 0.0 {
            for (k, other) in [(1, 2), (2, 1)] {
                for i in 0..6 {
                    let left = at[k][i] * of.coupled;
                    for j in 0..6 {
                        sums.tangent[i][j] = sums.tangent[i][j].add_product(left, end[other][j]);
                    }
                }
            }
        }
        self.add_second(&turning, across, &mut sums);
        sums
    }

    /// A stiffness against Gamma2 with what an axial force adds to it: the axial strain contains the square of Gamma2.
    pub(super) fn leant<S: Real>(&self, stiffness: S, axial: S) -> S {
        stiffness + axial * self.leaning
    }

    /// Derivatives of the linear strains, where Gamma2 is `across`, and of the square of turning with respect to the nodal values, shape (4, 6)
    /// \[1/m, -, -\], of the third \[1/m^2, 1/m, 1/m\] and of the last \[-, 1/m^2, 1/m^2\], those with respect to the chord being zero.
    pub(super) fn gradients<S: Real>(&self, u: &ElementValues<S>, across: S) -> [[S; 6]; 4] {
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
        let sheared = [n1, n2, s2, -s1, s2, -s1];
        let stretched = [d[0], d[1], to_a1, to_a2, to_b1, to_b2];
        let leant = across * self.leaning;
        let axial = array(|i| (stretched[i] * self.per_stretch).add_product(leant, sheared[i]));
        [axial, sheared, [zero, zero, b2, -b1, -a2, a1], [zero, zero, w1, w2, -v1, -v2]]
    }

    /// Adds the second derivatives of the strains, times the stresses, where Gamma2 is `across`, but for the product of its own derivatives.
    pub(super) fn add_second<S: Real>(
        &self,
        stress: &[S; 4],
        across: S,
        sums: &mut ElementSums<S>,
    ) {
        let per_length = self.length.recip();
        let [cosine, sine] = self.back;
        let stretching = stress[0] * self.per_stretch;
        let shearing = stress[1].add_product(stress[0] * self.leaning, across);
        let [axial, shear, moment] = [stretching, shearing, stress[2]].map(|s| s * per_length);
        let curved = stretching * (1.0 / 3.0);
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
