//! Modal damping in the tangent: a low-rank part (Woodbury).

use super::{Tangent, inner};
use crate::linalg::dense::DenseLu;
use crate::model::Model;
use crate::step::modal_damping::ModalDamping;

/// Solutions for the vectors of modal damping, and the small system between them (Woodbury).
#[derive(Clone, Debug, Default)]
pub(super) struct LowRank {
    /// Nodal values of the solutions, shape (modes, nodes, 4) \[kg^(1/2) m/N, kg^(1/2)/N\].
    columns: Vec<Vec<[f64; 4]>>,
    /// Multipliers of the solutions, shape (modes, constraints) \[kg^(1/2), kg^(1/2) m\].
    multipliers: Vec<Vec<f64>>,
    lu: DenseLu,
    /// Right side and solution of the small system, shape (modes) \[kg^(1/2) m, then N/kg^(1/2)\].
    right: Vec<f64>,
}

impl Tangent {
    /// Solutions for the vectors of modal damping; `false` if the system between them is singular.
    pub(super) fn factor_damping(
        &mut self,
        model: &Model,
        damping: Option<(&ModalDamping, f64)>,
    ) -> bool {
        let Some((damping, h)) = damping.filter(|(d, _)| !d.is_empty()) else {
            self.low_rank.columns.clear();
            return true;
        };
        let n = damping.vectors.len();
        let mut low_rank = std::mem::take(&mut self.low_rank);
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
            matrix[j * n + j] += h / damping.rates[j];
        }
        let regular = low_rank.lu.factor(n, &matrix);
        self.low_rank = low_rank;
        regular
    }

    /// Takes from a solution without modal damping what the damping takes.
    pub(super) fn correct_for_damping(
        &mut self,
        damping: &ModalDamping,
        x: &mut [[f64; 4]],
        border: &mut [f64],
    ) {
        let low_rank = &mut self.low_rank;
        if low_rank.columns.is_empty() {
            return;
        }
        low_rank.right.clear();
        low_rank.right.extend(damping.vectors.iter().map(|v| inner(v, x)));
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
