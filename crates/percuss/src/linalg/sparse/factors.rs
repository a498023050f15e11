//! Triangular factors of a sparse matrix, column by column.

use super::pattern::ColumnPattern;

/// A pivot on the diagonal is good if it is at least this share of the largest entry of its column, so that no entry of the lower factor is
/// larger than a hundred.
const GOOD: f64 = 0.01;

/// A matrix by its pattern and its values.
#[derive(Clone, Copy)]
pub struct SparseMatrix<'a> {
    pub pattern: &'a ColumnPattern,
    /// In the order of the pattern, shape (entries) \[unit of the matrix\].
    pub values: &'a [f64],
}

/// `L U` of a matrix whose columns were eliminated in some order; their rows and columns are numbered by that.
#[derive(Clone, Debug)]
pub struct LuFactors {
    /// Rows of the matrix in the order of their elimination, shape (order of the matrix) \[index of a row\].
    rows: Vec<usize>,
    /// Order of elimination of each row, shape (order of the matrix) \[index of a column\].
    places: Vec<usize>,
    /// The lower factor below its diagonal of ones.
    lower: ColumnPattern,
    /// Its values, shape (entries) \[-\].
    lower_values: Vec<f64>,
    /// The upper factor above its diagonal.
    upper: ColumnPattern,
    /// Its values, shape (entries) \[unit of the matrix\].
    upper_values: Vec<f64>,
    /// Pivots, shape (order of the matrix) \[unit of the matrix\].
    pivots: Vec<f64>,
    /// A column in the making, zero between columns, shape (order of the matrix) \[unit of the matrix\].
    column: Vec<f64>,
}

impl LuFactors {
    /// The pattern of factors with pivots on the diagonal: that of the factors of the matrix and its transpose together.
    pub fn on_the_diagonal(pattern: &ColumnPattern, order: &[usize]) -> Self {
        let n = order.len();
        let mut places = vec![0; n];
        order.iter().enumerate().for_each(|(k, unknown)| places[*unknown] = k);
        let mut below: Vec<Vec<usize>> = vec![Vec::new(); n];
        for column in 0..n {
            for row in &pattern.rows[pattern.range(column)] {
                let (a, b) = (places[*row], places[column]);
                if a != b {
                    below[a.min(b)].push(a.max(b));
                }
            }
        }
        for k in 0..n {
            below[k].sort_unstable();
            below[k].dedup();
            // Contributions of a column to others enter the first of them, and through it the rest.
            if let Some((first, rest)) = below[k].split_first() {
                let (first, rest) = (*first, rest.to_vec());
                below[first].extend(rest);
            }
        }
        let mut above: Vec<Vec<usize>> = vec![Vec::new(); n];
        for (k, rows) in below.iter().enumerate() {
            rows.iter().for_each(|row| above[*row].push(k));
        }
        let (lower, upper) = (ColumnPattern::of(&below), ColumnPattern::of(&above));
        Self {
            rows: order.to_vec(),
            places,
            lower_values: vec![0.0; lower.rows.len()],
            upper_values: vec![0.0; upper.rows.len()],
            lower,
            upper,
            pivots: vec![0.0; n],
            column: vec![0.0; n],
        }
    }

    /// LuFactors a matrix of the pattern they were made for; `false` where a pivot is not [`GOOD`].
    pub fn factor_on_the_diagonal(&mut self, matrix: SparseMatrix, order: &[usize]) -> bool {
        let x = &mut self.column;
        for k in 0..order.len() {
            for entry in matrix.pattern.range(order[k]) {
                x[self.places[matrix.pattern.rows[entry]]] = matrix.values[entry];
            }
            for entry in self.upper.range(k) {
                let j = self.upper.rows[entry];
                let u = std::mem::take(&mut x[j]);
                self.upper_values[entry] = u;
                for below in self.lower.range(j) {
                    x[self.lower.rows[below]] -= self.lower_values[below] * u;
                }
            }
            let pivot = std::mem::take(&mut x[k]);
            let mut most = 0.0_f64;
            for below in self.lower.range(k) {
                let value = std::mem::take(&mut x[self.lower.rows[below]]);
                most = most.max(value.abs());
                self.lower_values[below] = value / pivot;
            }
            self.pivots[k] = pivot;
            // NaN is not good either.
            let good = pivot.abs() > 0.0 && pivot.abs() >= GOOD * most;
            if !good || pivot.is_infinite() {
                return false;
            }
        }
        true
    }

    /// LuFactors of a matrix with the largest entry of each column as its pivot (Gilbert and Peierls 1988); `None` if it is singular.
    pub fn seeking_pivots(matrix: SparseMatrix, order: &[usize]) -> Option<Self> {
        let n = order.len();
        let (mut rows, mut places) = (Vec::with_capacity(n), vec![ABSENT; n]);
        let mut pivots = Vec::with_capacity(n);
        let mut lower = ColumnPattern { starts: vec![0], rows: Vec::new() };
        let mut upper = lower.clone();
        let (mut lower_values, mut upper_values) = (Vec::new(), Vec::new());
        let (mut x, mut seen) = (vec![0.0; n], vec![ABSENT; n]);
        for k in 0..n {
            let own = matrix.pattern.range(order[k]);
            let from = &matrix.pattern.rows[own.clone()];
            // Until all is done rows of the lower factor are those of the matrix.
            let reached = reached(from, (&lower, &places), &mut seen, k);
            for entry in own {
                x[matrix.pattern.rows[entry]] = matrix.values[entry];
            }
            let (mut most, mut pivot_row) = (0.0, None);
            for row in &reached {
                let (value, j) = (x[*row], places[*row]);
                if j != ABSENT {
                    upper.rows.push(j);
                    upper_values.push(value);
                    for below in lower.range(j) {
                        x[lower.rows[below]] -= lower_values[below] * value;
                    }
                } else if value.abs() > most || value.is_nan() {
                    (most, pivot_row) = (value.abs(), Some(*row));
                }
            }
            let pivot_row = pivot_row.filter(|_| most.is_finite())?;
            let pivot = x[pivot_row];
            for row in reached {
                let value = std::mem::take(&mut x[row]);
                if places[row] == ABSENT && row != pivot_row {
                    lower.rows.push(row);
                    lower_values.push(value / pivot);
                }
            }
            places[pivot_row] = k;
            rows.push(pivot_row);
            pivots.push(pivot);
            lower.starts.push(lower.rows.len());
            upper.starts.push(upper.rows.len());
        }
        lower.rows.iter_mut().for_each(|row| *row = places[*row]);
        Some(Self { rows, places, lower, lower_values, upper, upper_values, pivots, column: x })
    }

    /// Solves in place.
    pub fn solve(&self, x: &mut [f64], order: &[usize]) {
        let mut y: Vec<f64> = self.rows.iter().map(|row| x[*row]).collect();
        for k in 0..y.len() {
            let known = y[k];
            for entry in self.lower.range(k) {
                y[self.lower.rows[entry]] -= self.lower_values[entry] * known;
            }
        }
        for k in (0..y.len()).rev() {
            y[k] /= self.pivots[k];
            let known = y[k];
            for entry in self.upper.range(k) {
                y[self.upper.rows[entry]] -= self.upper_values[entry] * known;
            }
        }
        order.iter().zip(y).for_each(|(unknown, value)| x[*unknown] = value);
    }
}

/// Of a row that is not eliminated yet.
const ABSENT: usize = usize::MAX;

/// The rows in which column `k` of the factors has entries, given those in the previous rows `from`: every row after those whose elimination
/// changes it.
fn reached(
    from: &[usize],
    (lower, places): (&ColumnPattern, &[usize]),
    seen: &mut [usize],
    k: usize,
) -> Vec<usize> {
    let below = |row: usize| match places[row] {
        ABSENT => 0..0,
        j => lower.range(j),
    };
    let (mut order, mut open) = (Vec::new(), Vec::new());
    for first in from {
        if seen[*first] == k {
            continue;
        }
        seen[*first] = k;
        open.push((*first, below(*first)));
        while let Some((row, rest)) = open.last_mut() {
            let Some(entry) = rest.next() else {
                order.push(*row);
                open.pop();
                continue;
            };
            let next = lower.rows[entry];
            if seen[next] != k {
                seen[next] = k;
                open.push((next, below(next)));
            }
        }
    }
    order.reverse();
    order
}
