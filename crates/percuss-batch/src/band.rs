//! Block-tridiagonal matrix of an ensemble, 4 x 4 blocks, factored without pivoting.
//!
//! Lanes cannot choose pivots independently. In a step of a transient the masses dominate the blocks, so pivoting is not needed; if a pivot fails
//! nevertheless, the residual of the run shows it and the run is repeated by the solver of single runs, which pivots.

use percuss::internals::linalg::block::{Block, apply, less_applied, mul, sub_mul};
use percuss::internals::linalg::gauss_jordan;
use percuss::internals::scalar::{Number, array};

/// A block-tridiagonal matrix, or its factors.
#[derive(Clone, Debug)]
pub struct Band<S> {
    /// Diagonal blocks, shape (beam nodes, 4, 4) \[N/m, N, N m\]; after factorisation the inverses of the pivots.
    pub diag: Vec<Block<S>>,
    /// Block in row i, column i + 1, shape (beam nodes, 4, 4) \[N/m, N, N m\]; after factorisation `pivot^-1 upper` \[-, m, 1/m\].
    pub upper: Vec<Block<S>>,
    /// Block in row i + 1, column i, shape (beam nodes, 4, 4) \[N/m, N, N m\]; after factorisation `lower pivot^-1` \[-, m, 1/m\].
    pub lower: Vec<Block<S>>,
}

impl<S: Number> Band<S> {
    /// A zero matrix of `n` block rows, with the lanes of `S`.
    pub fn zeros(n: usize, like: S) -> Self {
        let zero = vec![[[like.constant(0.0); 4]; 4]; n];
        Self { diag: zero.clone(), upper: zero.clone(), lower: zero }
    }

    /// Adds `k` times the square of a form on the nodes `a` and `a + 1`.
    #[inline(always)]
    pub fn add_square(&mut self, a: usize, row: &[S; 8], k: S) {
        for i in 0..8 {
            for j in 0..8 {
                let block = match (i / 4, j / 4) {
                    (0, 0) => &mut self.diag[a],
                    (0, _) => &mut self.upper[a],
                    (_, 0) => &mut self.lower[a],
                    _ => &mut self.diag[a + 1],
                };
                let entry = &mut block[i % 4][j % 4];
                *entry = entry.add_product(k * row[i], row[j]);
            }
        }
    }

    /// Factors in place.
    #[inline(always)]
    pub fn factor(&mut self) {
        let n = self.diag.len();
        for i in 0..n {
            let mut inverse = self.diag[i];
            gauss_jordan::invert(inverse.as_flattened_mut(), 4);
            self.diag[i] = inverse;
            if i + 1 < n {
                let gain = mul(&self.lower[i], &inverse);
                sub_mul(&mut self.diag[i + 1], &gain, &self.upper[i]);
                self.lower[i] = gain;
                self.upper[i] = mul(&inverse, &self.upper[i]);
            }
        }
    }

    /// Solves in place with the factors.
    #[inline(always)]
    pub fn solve(&self, x: &mut [[S; 4]]) {
        let Some(first) = x.first() else { return };
        let mut carried = *first;
        // Values that pass from one row to the next stay in registers.
        x[0] = factor_applied(&self.diag[0], &carried);
        for i in 1..x.len() {
            carried = less_factor_applied(x[i], &self.lower[i - 1], &carried);
            x[i] = factor_applied(&self.diag[i], &carried);
        }
        let last = x.len() - 1;
        carried = x[last];
        for i in (0..last).rev() {
            carried = less_factor_applied(x[i], &self.upper[i], &carried);
            x[i] = carried;
        }
    }

    /// Copies the given lanes of another matrix.
    #[inline(always)]
    pub fn take(&mut self, from: &Self, which: S::Mask) {
        for (mine, other) in [
            (&mut self.diag, &from.diag),
            (&mut self.upper, &from.upper),
            (&mut self.lower, &from.lower),
        ] {
            let mine = mine.as_flattened_mut().as_flattened_mut();
            for (mine, other) in mine.iter_mut().zip(other.as_flattened().as_flattened()) {
                *mine = S::choose(which, *other, *mine);
            }
        }
    }
}

/// `a x` for a block of the factors, which has no derivatives.
#[inline(always)]
fn factor_applied<S: Number>(a: &Block<S>, x: &[S; 4]) -> [S; 4] {
    if !S::DERIVES {
        return apply(a, x);
    }
    array(|i| {
        let [a0, a1, a2, a3] = a[i];
        x[0] * a0.lane(0) + x[1] * a1.lane(0) + x[2] * a2.lane(0) + x[3] * a3.lane(0)
    })
}

/// `x - a y`, likewise.
#[inline(always)]
fn less_factor_applied<S: Number>(mut x: [S; 4], a: &Block<S>, y: &[S; 4]) -> [S; 4] {
    if !S::DERIVES {
        return less_applied(x, a, y);
    }
    for k in 0..4 {
        for i in 0..4 {
            x[i] = x[i] - y[k] * a[i][k].lane(0);
        }
    }
    x
}
