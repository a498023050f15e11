//! Newton's impact law for several contacts at once, by the paper's proximal-point iteration (eqs. 14 to 16).

/// A linear complementarity problem `0 <= z(L) - bound  perp  L >= 0` with `z(L) = free + W L`.
///
/// L are the impulses, z the gap rates after the impact, `bound = -alpha z0` (Newton's law), and W is the Delassus operator.
#[derive(Clone, Debug, Default)]
pub struct ImpactProblem {
    /// Delassus operator, shape (n, n), row by row \[1/kg\].
    pub delassus: Vec<f64>,
    /// Gap rates without impulses \[m/s\].
    pub free: Vec<f64>,
    /// Least gap rates after the impact \[m/s\].
    pub bound: Vec<f64>,
}

/// The iteration stalled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stalled;

impl ImpactProblem {
    const ITERATIONS: usize = 20_000;
    const TOLERANCE: f64 = 4e-16;

    /// Number of contacts.
    pub fn len(&self) -> usize {
        self.free.len()
    }

    /// Solves for the impulses in place, starting from what stands there.
    ///
    /// `L_i <- max(0, L_i - (z_i(L) - bound_i) / W_ii)`, contact after contact, until no impulse moves; the projection on
    /// the non-negative numbers is the proximal point of the paper's eq. (15) with R = 1 / W_ii. For a single contact
    /// the first sweep is the closed form.
    ///
    /// # Errors
    /// [`Stalled`] if the impulses still move after many sweeps.
    pub fn solve(&self, impulses: &mut [f64]) -> Result<(), Stalled> {
        let n = self.len();
        for _ in 0..Self::ITERATIONS {
            let (mut change, mut size) = (0.0_f64, 0.0_f64);
            for i in 0..n {
                let row = &self.delassus[i * n..(i + 1) * n];
                let rate: f64 =
                    self.free[i] + row.iter().zip(impulses.iter()).map(|(w, l)| w * l).sum::<f64>();
                let next = (impulses[i] - (rate - self.bound[i]) / row[i]).max(0.0);
                change = change.max((next - impulses[i]).abs());
                size = size.max(next);
                impulses[i] = next;
            }
            if change <= Self::TOLERANCE * size || n == 1 {
                return Ok(());
            }
        }
        // The last digits may alternate for ever; what counts is whether the law is met.
        let scale = self.free.iter().chain(&self.bound).fold(0.0_f64, |m, x| m.max(x.abs()));
        if self.residual(impulses) <= 1e-12 * scale { Ok(()) } else { Err(Stalled) }
    }

    /// Largest violation of `0 <= z - bound  perp  L >= 0`, as a velocity \[m/s\].
    pub fn residual(&self, impulses: &[f64]) -> f64 {
        let n = self.len();
        let mut worst = 0.0_f64;
        for i in 0..n {
            let row = &self.delassus[i * n..(i + 1) * n];
            let slack = self.free[i] - self.bound[i]
                + row.iter().zip(impulses).map(|(w, l)| w * l).sum::<f64>();
            worst = worst.max((-slack).max(slack.min(row[i] * impulses[i])));
        }
        worst
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn one_contact_has_the_closed_form() {
        let problem = ImpactProblem { delassus: vec![0.02], free: vec![-40.0], bound: vec![20.0] };
        let mut impulse = [0.0];
        problem.solve(&mut impulse).unwrap();
        assert!((impulse[0] - 3000.0).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn solutions_meet_the_law(
            factor in prop::array::uniform32(-1.0..1.0_f64),
            free in prop::array::uniform4(-10.0..10.0_f64),
            bound in prop::array::uniform4(0.0..10.0_f64),
        ) {
            // W = B B^T + 0.3 I is symmetric and positive definite.
            let mut delassus = vec![0.0; 16];
            for i in 0..4 {
                for j in 0..4 {
                    delassus[4 * i + j] = (0..8).map(|k| factor[8 * i + k] * factor[8 * j + k]).sum();
                }
                delassus[5 * i] += 0.3;
            }
            let problem = ImpactProblem { delassus, free: free.to_vec(), bound: bound.to_vec() };
            let mut impulses = [0.0; 4];
            problem.solve(&mut impulses).unwrap();
            prop_assert!(impulses.iter().all(|l| *l >= 0.0));
            prop_assert!(problem.residual(&impulses) < 1e-11);
        }
    }
}
