//! Modal damping in the tangent: a low-rank part (Woodbury).

use crate::linalg::block::inner;
use crate::linalg::dense::DenseLu;

/// Solutions for the vectors of modal damping, and the small system between them (Woodbury).
#[derive(Clone, Debug, Default)]
pub(super) struct LowRank {
    /// The vectors, shape (modes, nodes, 4) \[kg^(1/2), kg^(1/2) m\].
    vectors: Vec<Vec<[f64; 4]>>,
    /// Nodal values of the solutions, shape (modes, nodes, 4) \[kg^(1/2) m/N, kg^(1/2)/N\].
    columns: Vec<Vec<[f64; 4]>>,
    /// Multipliers of the solutions, shape (modes, constraints) \[kg^(1/2), kg^(1/2) m\].
    multipliers: Vec<Vec<f64>>,
    lu: DenseLu,
    /// Right side and solution of the small system, shape (modes) \[kg^(1/2) m, then N/kg^(1/2)\].
    right: Vec<f64>,
}

/// Vectors of modal damping in a step of a given size.
#[derive(Clone, Copy, Debug)]
pub struct DampedVectors<'a> {
    /// The vectors, shape (modes, nodes, 4) \[kg^(1/2), kg^(1/2) m\].
    pub vectors: &'a [Vec<[f64; 4]>],
    /// Their rates, shape (modes) \[1/s\].
    pub rates: &'a [f64],
    /// Size of the step \[s\].
    pub h: f64,
}

impl LowRank {
    /// Enters the vectors of modal damping, with their solutions by `solve`; `false` if the system between them is singular.
    pub(super) fn factor(
        &mut self,
        damping: Option<DampedVectors>,
        constraints: usize,
        mut solve: impl FnMut(&mut [[f64; 4]], &mut [f64]),
    ) -> bool {
        let Some(damping) = damping.filter(|d| !d.vectors.is_empty()) else {
            self.columns.clear();
            return true;
        };
        let n = damping.vectors.len();
        // Kept: those of later increments turn with their bodies, and are not those of this tangent.
        self.vectors.clear();
        self.vectors.extend_from_slice(damping.vectors);
        self.columns.resize(n, Vec::new());
        self.multipliers.resize(n, Vec::new());
        let mut matrix = vec![0.0; n * n];
        for (j, vector) in damping.vectors.iter().enumerate() {
            self.columns[j].clone_from(vector);
            self.multipliers[j] = vec![0.0; constraints];
            solve(&mut self.columns[j], &mut self.multipliers[j]);
            for (i, other) in damping.vectors.iter().enumerate() {
                matrix[i * n + j] = inner(other, &self.columns[j]);
            }
            matrix[j * n + j] += damping.h / damping.rates[j];
        }
        self.lu.factor(n, &matrix)
    }

    /// Subtracts the effect of the damping from a solution without modal damping.
    pub(super) fn correct(&mut self, x: &mut [[f64; 4]], border: &mut [f64]) {
        if self.columns.is_empty() {
            return;
        }
        self.right.clear();
        self.right.extend(self.vectors.iter().map(|v| inner(v, x)));
        self.lu.solve(&mut self.right);
        for ((column, multipliers), share) in
            self.columns.iter().zip(&self.multipliers).zip(&self.right)
        {
            for (target, c) in x.iter_mut().zip(column) {
                (0..4).for_each(|i| target[i] -= share * c[i]);
            }
            for (target, m) in border.iter_mut().zip(multipliers) {
                *target -= share * m;
            }
        }
    }
}
