//! Strains that a shear-flexible element would have without forces: their forces and energy.
//!
//! An element that is free of forces turns by the given curvature times its length. In the energy of bending, whose derivative by the angle t is
//! `t - t^5 / 30`, the given curvature therefore acts on `t - t^5 / 150`, to seventh order: with the sine of turning k and the square of turning q,
//! as in [`super::ShearStrains`], on `k (1 + l^2 q / 3 + 8 l^4 q^2 / 75)`. It is a product of quadratic forms: its change over a step is that of
//! each factor by the mean of the other, exactly.

use super::{Evaluated, ShearStrains, ShearTable, moved};
use crate::element::beam::{ElementSums, ElementValues};

/// Shares of the square of turning, and of its square.
const TURNED: [f64; 2] = [1.0 / 3.0, 8.0 / 75.0];

impl ShearTable {
    /// What stretch and bend that need no force add to the forces, with the gradient at a share of the step, and to their tangent if `TANGENT`. With
    /// the gradient in the middle, the work is exact for any step.
    pub fn relieved<const TANGENT: bool>(
        &self,
        start: &ElementValues<f64>,
        increment: &ElementValues<f64>,
        share: f64,
        [stretch, bend]: [f64; 2],
    ) -> ElementSums<f64> {
        let (end, at) = (moved(start, increment, 1.0), moved(start, increment, share));
        let (old, new) = (self.strains(start), self.strains(&end));
        let mean = |a: f64, b: f64| (1.0 - share) * a + share * b;
        let [axial, _, bending] = self.stiffness;
        let moment = -bend * bending;
        let sine = mean(old.linear[2], new.linear[2]);
        let factor = mean(self.by_sine(&old), self.by_sine(&new));
        let by_square = self.by_square(mean(old.square, new.square));
        let across = mean(old.linear[1], new.linear[1]);
        let shear = -bend * self.coupling;
        let stress = [-stretch * axial, shear, moment * factor, moment * sine * by_square];
        let mut sums = self.sums::<f64, TANGENT>(&Evaluated {
            stress,
            turning: stress,
            at,
            end,
            across: [across, new.linear[1]],
            slopes: [0.0; 3], // constant stresses
            coupled: 0.0,
            share,
        });
        if TANGENT && moment != 0.0 {
            // The factors vary as well.
            let varies = moment * share;
            let l2 = self.length * self.length;
            let (here, there) = (self.gradients(&at, across), self.gradients(&end, across));
            let each = 2.0 * TURNED[1] * l2 * l2 * sine;
            let sine_by_square = self.by_square(new.square);
            for i in 0..6 {
                let of_square = varies * sine_by_square * here[2][i] + varies * each * here[3][i];
                let of_sine = varies * by_square * here[3][i];
                for j in 0..6 {
                    sums.tangent[i][j] += of_square * there[3][j] + of_sine * there[2][j];
                }
            }
        }
        sums
    }

    /// What they add to the energies of stretching and of bending, shape (2) \[J\].
    pub fn energy_relieved(&self, at: &ElementValues<f64>, [stretch, bend]: [f64; 2]) -> [f64; 2] {
        let ([axial, _, bending], strains) = (self.stiffness, self.strains(at));
        let bent = strains.linear[2] * self.by_sine(&strains);
        [
            axial * stretch * (0.5 * stretch - strains.linear[0]),
            bending * bend * (0.5 * bend - bent) - self.coupling * bend * strains.linear[1],
        ]
    }

    /// The factor of the sine of turning.
    fn by_sine(&self, strains: &ShearStrains<f64>) -> f64 {
        let turned = self.length * self.length * strains.square;
        1.0 + turned * (TURNED[0] + TURNED[1] * turned)
    }

    /// Its change by that of the square of turning with a mean \[m^2\].
    fn by_square(&self, square: f64) -> f64 {
        let l2 = self.length * self.length;
        l2 * (TURNED[0] + 2.0 * TURNED[1] * l2 * square)
    }
}
