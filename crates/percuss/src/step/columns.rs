//! Values of nodes or elements, one column per component: a vector register holds several consecutive values.

use pulp::Simd;
use serde::{Deserialize, Serialize};

use crate::scalar::Lanes;

/// More than the lanes of any vector register: columns are longer than their values by this number, so that the last values fill a register, too.
const PADDING: usize = 8;

/// Columns of equal length.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Columns {
    length: usize,
    /// Columns one after another, shape (columns, length) \[unit of the stored values\].
    values: Vec<f64>,
}

impl Columns {
    /// The given number of columns of `count` values each, all zero.
    pub fn zeros(columns: usize, count: usize) -> Self {
        let length = count + PADDING;
        Self { length, values: vec![0.0; columns * length] }
    }

    /// Whether there are this number of columns of `count` values each.
    pub fn fit(&self, columns: usize, count: usize) -> bool {
        self.length == count + PADDING && self.values.len() == columns * self.length
    }

    /// Copies rows, the first as row `first`.
    #[inline(always)]
    pub fn gather<const N: usize>(&mut self, first: usize, rows: &[[f64; N]]) {
        let mut columns = self.values.chunks_exact_mut(self.length);
        let own = first..first + rows.len();
        let columns: [&mut [f64]; N] = std::array::from_fn(|_| match columns.next() {
            Some(column) => &mut column[own.clone()],
            None => &mut [],
        });
        for (k, row) in rows.iter().enumerate() {
            for i in 0..N {
                columns[i][k] = row[i];
            }
        }
    }

    /// Row `k`.
    #[inline(always)]
    pub fn row<const N: usize>(&self, k: usize) -> [f64; N] {
        let mut row = [0.0; N];
        for i in 0..N {
            row[i] = self.values[i * self.length + k];
        }
        row
    }

    /// The values of one column from row `k` on.
    #[inline(always)]
    pub fn load<P: Simd>(&self, like: Lanes<P>, column: usize, k: usize) -> Lanes<P> {
        like.load(&self.values[column * self.length + k..])
    }

    /// The values of the first columns from row `k` on.
    #[inline(always)]
    pub fn load_row<P: Simd, const N: usize>(&self, like: Lanes<P>, k: usize) -> [Lanes<P>; N] {
        let mut row = [like; N];
        for i in 0..N {
            row[i] = self.load(like, i, k);
        }
        row
    }

    /// Sets the values of one column from row `k` on.
    #[inline(always)]
    pub fn store<P: Simd>(&mut self, column: usize, k: usize, values: Lanes<P>) {
        values.store(&mut self.values[column * self.length + k..]);
    }

    /// Sets one value.
    pub fn set(&mut self, column: usize, k: usize, value: f64) {
        self.values[column * self.length + k] = value;
    }
}
