//! Sparse systems of fixed pattern: ordering and symbolic factorisation are done once.

mod factors;
mod pattern;

use self::factors::{LuFactors, SparseMatrix};
use self::pattern::ColumnPattern;
use super::ordering::{least_degree_of_unknowns, neighbours};

/// A sparse matrix of fixed pattern and, after [`SparseLu::factor`], its factors.
///
/// Factors depend on the matrix alone, not on previous factors: a resumed run continues with the same bits.
#[derive(Clone, Debug)]
pub struct SparseLu {
    pattern: ColumnPattern,
    /// Values, in the order of the pattern: column by column, rows ascending, shape (values) \[unit of the matrix\].
    pub values: Vec<f64>,
    /// Scales of rows and columns in the factors, shape (order of the matrix) \[reciprocal of the square root of the entries' unit\].
    scale: Vec<f64>,
    /// Columns in the order of their elimination, shape (order of the matrix) \[index of a column\].
    order: Vec<usize>,
    /// Factors with pivots on the diagonal, whose pattern is known beforehand.
    diagonal: LuFactors,
    /// Factors with pivots sought in each column, where those on the diagonal are too small.
    sought: Option<LuFactors>,
    singular: bool,
}

/// Sweeps of the scaling of rows and columns.
const SWEEPS: usize = 3;

impl SparseLu {
    /// A zero matrix of order `n` with entries at the given (row, column) pairs, which may repeat.
    pub fn new(n: usize, entries: &[(usize, usize)]) -> Self {
        let mut columns: Vec<Vec<usize>> = vec![Vec::new(); n];
        for (row, column) in entries {
            columns[*column].push(*row);
        }
        for column in &mut columns {
            column.sort_unstable();
            column.dedup();
        }
        let pattern = ColumnPattern::of(&columns);
        let order = least_degree_of_unknowns(&neighbours(n, entries.iter().copied()));
        Self {
            values: vec![0.0; pattern.rows.len()],
            scale: vec![1.0; n],
            diagonal: LuFactors::on_the_diagonal(&pattern, &order),
            pattern,
            order,
            sought: None,
            singular: true,
        }
    }

    /// Place of an entry of the pattern in [`SparseLu::values`].
    pub fn place(&self, row: usize, column: usize) -> usize {
        let range = self.pattern.range(column);
        let rows = &self.pattern.rows[range.clone()];
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
        let matrix = SparseMatrix { pattern: &self.pattern, values: &self.values };
        self.sought = None;
        self.singular = false;
        if !self.diagonal.factor_on_the_diagonal(matrix, &self.order) {
            self.sought = LuFactors::seeking_pivots(matrix, &self.order);
            self.singular = self.sought.is_none();
        }
        !self.singular
    }

    fn equilibrate(&mut self) {
        let mut most = vec![0.0_f64; self.scale.len()];
        for column in 0..most.len() {
            for k in self.pattern.range(column) {
                let (size, row) = (self.values[k].abs(), self.pattern.rows[k]);
                most[column] = most[column].max(size);
                most[row] = most[row].max(size);
            }
        }
        let factor = |m: f64| if m > 0.0 && m.is_finite() { 1.0 / m.sqrt() } else { 1.0 };
        most.iter_mut().for_each(|m| *m = factor(*m));
        for column in 0..most.len() {
            self.scale[column] *= most[column];
            for k in self.pattern.range(column) {
                self.values[k] *= most[column] * most[self.pattern.rows[k]];
            }
        }
    }

    /// Solves in place with the factors; not a number where there are none.
    pub fn solve(&self, x: &mut [f64]) {
        if self.singular {
            x.fill(f64::NAN);
            return;
        }
        let scale = |x: &mut [f64]| x.iter_mut().zip(&self.scale).for_each(|(x, s)| *x *= s);
        scale(x);
        self.sought.as_ref().unwrap_or(&self.diagonal).solve(x, &self.order);
        scale(x);
    }
}

#[cfg(test)]
mod tests;
