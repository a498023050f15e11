//! Sparse systems of fixed pattern: ordering and symbolic factorisation are done once (faer).

use faer::MatMut;
use faer::linalg::solvers::SolveCore;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};

/// A sparse matrix of fixed pattern and, after [`SparseLu::factor`], its factors.
#[derive(Clone, Debug)]
pub struct SparseLu {
    pattern: SymbolicSparseColMat<usize>,
    symbolic: SymbolicLu<usize>,
    factors: Option<Lu<usize, f64>>,
    /// Values, in the order of the pattern: column by column, rows ascending, shape (values) \[unit of the matrix\].
    pub values: Vec<f64>,
    /// Scales of rows and columns in the factors, shape (order of the matrix) \[reciprocal of the square root of the entries' unit\].
    scale: Vec<f64>,
}

/// Sweeps of the scaling of rows and columns.
const SWEEPS: usize = 3;

impl SparseLu {
    /// A zero matrix of order `n` with entries at the given (row, column) pairs, which may repeat; `None` if the pattern
    /// cannot be factored.
    pub fn new(n: usize, entries: &[(usize, usize)]) -> Option<Self> {
        let mut columns: Vec<Vec<usize>> = vec![Vec::new(); n];
        for (row, column) in entries {
            columns[*column].push(*row);
        }
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for column in &mut columns {
            column.sort_unstable();
            column.dedup();
            rows.extend_from_slice(column);
            starts.push(rows.len());
        }
        let values = vec![0.0; rows.len()];
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        let symbolic = SymbolicLu::try_new(pattern.as_ref()).ok()?;
        Some(Self { pattern, symbolic, factors: None, values, scale: vec![1.0; n] })
    }

    /// Place of an entry of the pattern in [`SparseLu::values`].
    pub fn place(&self, row: usize, column: usize) -> usize {
        let range = self.pattern.col_range(column);
        let rows = &self.pattern.row_idx()[range.clone()];
        range.start + rows.partition_point(|r| *r < row)
    }

    /// Factors the matrix, scaled in place; `false` if it is singular.
    ///
    /// Inertia of a very short step and the ones of constraints differ by 20 orders: pivots are sought among scaled entries
    /// (Ruiz 2001: rows and columns alike by the square root of their largest entries, repeatedly).
    pub fn factor(&mut self) -> bool {
        self.scale.fill(1.0);
        for _ in 0..SWEEPS {
            self.equilibrate();
        }
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), &self.values);
        self.factors = Lu::try_new_with_symbolic(self.symbolic.clone(), matrix).ok();
        self.factors.is_some()
    }

    fn equilibrate(&mut self) {
        let mut most = vec![0.0_f64; self.scale.len()];
        let (starts, rows) = (self.pattern.col_ptr(), self.pattern.row_idx());
        for column in 0..most.len() {
            for k in starts[column]..starts[column + 1] {
                let size = self.values[k].abs();
                most[column] = most[column].max(size);
                most[rows[k]] = most[rows[k]].max(size);
            }
        }
        let factor = |m: f64| if m > 0.0 && m.is_finite() { 1.0 / m.sqrt() } else { 1.0 };
        most.iter_mut().for_each(|m| *m = factor(*m));
        for column in 0..most.len() {
            self.scale[column] *= most[column];
            for k in starts[column]..starts[column + 1] {
                self.values[k] *= most[column] * most[rows[k]];
            }
        }
    }

    /// Solves in place with the factors.
    pub fn solve(&self, x: &mut [f64]) {
        let n = x.len();
        let scale = |x: &mut [f64]| x.iter_mut().zip(&self.scale).for_each(|(x, s)| *x *= s);
        scale(x);
        match &self.factors {
            Some(lu) => {
                let rhs = MatMut::from_column_major_slice_mut(x, n, 1);
                lu.solve_in_place_with_conj(faer::Conj::No, rhs);
            }
            None => x.fill(f64::NAN),
        }
        scale(x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_saddle_with_zeros_on_its_diagonal() {
        let a = [[2.0, 0.0, 1.0], [0.0, 3.0, 1.0], [1.0, 1.0, 0.0]];
        let entries: Vec<(usize, usize)> =
            (0..3).flat_map(|i| (0..3).map(move |j| (i, j))).collect();
        let mut lu = SparseLu::new(3, &entries).unwrap();
        for (i, row) in a.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                let place = lu.place(i, j);
                lu.values[place] = *value;
            }
        }
        assert!(lu.factor());
        let mut x = [1.0, 2.0, 3.0];
        lu.solve(&mut x);
        for (row, b) in a.iter().zip([1.0, 2.0, 3.0]) {
            let left: f64 = row.iter().zip(&x).map(|(a, x)| a * x).sum();
            assert!((left - b).abs() < 1e-14);
        }
    }
}
