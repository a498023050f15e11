//! The small system that remains of tied chains, dense or sparse.

use super::dense::DenseLu;
use super::sparse::SparseLu;

/// Systems of up to this order are solved densely.
const DENSE: usize = 36;

/// The reduced interface system.
#[derive(Clone, Debug)]
pub enum SchurComplement {
    Empty,
    Dense {
        order: usize,
        /// The matrix, row by row, shape (order, order) \[N/m, N, N m; of the border's rows and columns those of the constraints\].
        matrix: Vec<f64>,
        lu: DenseLu,
    },
    Sparse {
        lu: Box<SparseLu>,
    },
}

impl SchurComplement {
    /// A zero system of order `n` with entries at the given (row, column) pairs.
    pub fn new(n: usize, entries: impl FnOnce() -> Vec<(usize, usize)>) -> Self {
        match n {
            0 => Self::Empty,
            _ if n <= DENSE => {
                Self::Dense { order: n, matrix: vec![0.0; n * n], lu: DenseLu::default() }
            }
            _ => Self::Sparse { lu: Box::new(SparseLu::new(n, &entries())) },
        }
    }

    /// Clears it.
    pub fn clear(&mut self) {
        match self {
            Self::Empty => {}
            Self::Dense { matrix, .. } => matrix.fill(0.0),
            Self::Sparse { lu } => lu.values.fill(0.0),
        }
    }

    /// Adds `count` values of a column, from `row` on.
    pub fn add_column(
        &mut self,
        row: usize,
        column: usize,
        count: usize,
        value: impl Fn(usize) -> f64,
    ) {
        match self {
            Self::Empty => {}
            Self::Dense { order, matrix, .. } => {
                (0..count).for_each(|i| matrix[(row + i) * *order + column] += value(i));
            }
            Self::Sparse { lu } => {
                // Rows of a cluster follow each other in the pattern of a column.
                let place = lu.place(row, column);
                (0..count).for_each(|i| lu.values[place + i] += value(i));
            }
        }
    }

    /// Factors it; `false` if it is singular.
    pub fn factor(&mut self) -> bool {
        match self {
            Self::Empty => true,
            Self::Dense { order, matrix, lu } => lu.factor(*order, matrix),
            Self::Sparse { lu } => lu.factor(),
        }
    }

    /// Solves in place.
    pub fn solve(&self, x: &mut [f64]) {
        match self {
            Self::Empty => {}
            Self::Dense { lu, .. } => lu.solve(x),
            Self::Sparse { lu } => lu.solve(x),
        }
    }
}
