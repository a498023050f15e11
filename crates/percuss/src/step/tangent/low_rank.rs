//! Modal damping in the tangent: a low-rank part (Woodbury).

use super::{Tangent, inner};
use crate::linalg::dense::DenseLu;
use crate::model::Model;

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

impl Tangent {
    /// Solutions for the vectors of modal damping; `false` if the system between them is singular.
    pub(super) fn factor_damping(&mut self, model: &Model, damping: Option<DampedVectors>) -> bool {
        let Some(damping) = damping.filter(|d| !d.vectors.is_empty()) else {
            self.low_rank.columns.clear();
            return true;
        };
        let n = damping.vectors.len();
        let mut low_rank = std::mem::take(&mut self.low_rank);
        // Kept: those of later increments turn with their bodies, and are not those of this tangent.
        low_rank.vectors.clear();
        low_rank.vectors.extend_from_slice(damping.vectors);
        low_rank.columns.resize(n, Vec::new());
        low_rank.multipliers.resize(n, Vec::new());
        let mut matrix = vec![0.0; n * n];
        for (j, vector) in damping.vectors.iter().enumerate() {
            low_rank.columns[j].clone_from(vector);
            low_rank.multipliers[j] = vec![0.0; model.constraints.len()];
            self.solve_plain(model, &mut low_rank.columns[j], &mut low_rank.multipliers[j]);
            for (i, other) in damping.vectors.iter().enumerate() {
                matrix[i * n + j] = inner(other, &low_rank.columns[j]);
            }
            matrix[j * n + j] += damping.h / damping.rates[j];
        }
        let regular = low_rank.lu.factor(n, &matrix);
        self.low_rank = low_rank;
        regular
    }

    /// Takes from a solution without modal damping what the damping takes.
    pub(super) fn correct_for_damping(&mut self, x: &mut [[f64; 4]], border: &mut [f64]) {
        let low_rank = &mut self.low_rank;
        if low_rank.columns.is_empty() {
            return;
        }
        low_rank.right.clear();
        low_rank.right.extend(low_rank.vectors.iter().map(|v| inner(v, x)));
        low_rank.lu.solve(&mut low_rank.right);
        for ((column, multipliers), share) in
            low_rank.columns.iter().zip(&low_rank.multipliers).zip(&low_rank.right)
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
