//! Block-tridiagonal matrices of 4 x 4 blocks: the band of beams meshed node by node.

use super::block::{self, Block, ZERO};

/// A block-tridiagonal matrix, or, after [`Chain::factor`], its block LU factors in place.
///
/// Where one beam ends and the next begins the coupling blocks are zero. From some node on there may be nothing but nodes on their
/// own; their coupling blocks are not looked at.
#[derive(Clone, Debug, Default)]
pub struct Chain {
    /// First node from which on all are on their own.
    pub isolated: usize,
    /// Diagonal blocks, shape (n); after factorisation the inverses of the pivots.
    pub diag: Vec<Block>,
    /// Block in row i, column i + 1, shape (n); the last one is unused. After factorisation `pivot^-1 upper`.
    pub upper: Vec<Block>,
    /// Block in row i + 1, column i, shape (n); the last one is unused.
    pub lower: Vec<Block>,
}

/// A pivot block could not be inverted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SingularPivot {
    /// Index of the block.
    pub node: usize,
}

impl Chain {
    /// A zero matrix of `n` block rows.
    pub fn zeros(n: usize) -> Self {
        Self { isolated: n, diag: vec![ZERO; n], upper: vec![ZERO; n], lower: vec![ZERO; n] }
    }

    /// Adds `left^T k right` on the nodes `a` and `a + 1`: a 2 x 2 matrix between interpolated values, whose weights are
    /// ordered (value at a, slope at a, value at a + 1, slope at a + 1).
    pub fn add_outer(&mut self, a: usize, left: &[f64; 4], right: &[f64; 4], k: &[[f64; 2]; 2]) {
        let add = |block: &mut Block, l: &[f64], r: &[f64]| {
            for (p, lp) in l.iter().enumerate() {
                for (q, rq) in r.iter().enumerate() {
                    for i in 0..2 {
                        for j in 0..2 {
                            block[2 * p + i][2 * q + j] += lp * rq * k[i][j];
                        }
                    }
                }
            }
        };
        add(&mut self.diag[a], &left[..2], &right[..2]);
        add(&mut self.upper[a], &left[..2], &right[2..]);
        add(&mut self.lower[a], &left[2..], &right[..2]);
        add(&mut self.diag[a + 1], &left[2..], &right[2..]);
    }

    /// Adds `factor` times another matrix, before factorisation.
    pub fn add_scaled(&mut self, other: &Self, factor: f64) {
        let add = |blocks: &mut [Block], more: &[Block]| {
            let both = blocks.as_flattened_mut().as_flattened_mut().iter_mut();
            both.zip(more.as_flattened().as_flattened()).for_each(|(t, s)| *t += factor * s);
        };
        add(&mut self.diag, &other.diag);
        add(&mut self.upper, &other.upper);
        add(&mut self.lower, &other.lower);
    }

    /// Product with a vector, before factorisation.
    pub fn multiply(&self, x: &[[f64; 4]]) -> Vec<[f64; 4]> {
        let mut y: Vec<[f64; 4]> =
            self.diag.iter().zip(x).map(|(d, x)| block::apply(d, x)).collect();
        for i in 0..self.isolated.saturating_sub(1) {
            let (up, low) =
                (block::apply(&self.upper[i], &x[i + 1]), block::apply(&self.lower[i], &x[i]));
            for k in 0..4 {
                y[i][k] += up[k];
                y[i + 1][k] += low[k];
            }
        }
        y
    }

    /// Block LU factorisation in place, pivoting inside the blocks.
    ///
    /// # Errors
    /// [`SingularPivot`] names the block that cannot be inverted.
    pub fn factor(&mut self) -> Result<(), SingularPivot> {
        let n = self.isolated;
        for i in n..self.diag.len() {
            self.diag[i] = block::inverse_alone(&self.diag[i]).ok_or(SingularPivot { node: i })?;
        }
        for i in 0..n {
            let inverse = block::inverse(&self.diag[i]).ok_or(SingularPivot { node: i })?;
            self.diag[i] = inverse;
            if i + 1 < n {
                let gain = block::mul(&inverse, &self.upper[i]);
                block::sub_mul(&mut self.diag[i + 1], &self.lower[i], &gain);
                self.upper[i] = gain;
            }
        }
        Ok(())
    }

    /// Solves in place with the factors.
    pub fn solve(&self, x: &mut [[f64; 4]]) {
        let n = self.isolated;
        debug_assert_eq!(x.len(), self.diag.len());
        for i in n..x.len() {
            x[i] = block::apply(&self.diag[i], &x[i]);
        }
        let mut previous = [0.0; 4];
        for i in 0..n {
            let mut y = x[i];
            if i > 0 {
                let carry = block::apply(&self.lower[i - 1], &previous);
                for k in 0..4 {
                    y[k] -= carry[k];
                }
            }
            previous = block::apply(&self.diag[i], &y);
            x[i] = previous;
        }
        for i in (0..n.saturating_sub(1)).rev() {
            let carry = block::apply(&self.upper[i], &previous);
            for k in 0..4 {
                x[i][k] -= carry[k];
            }
            previous = x[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(n: usize) -> Chain {
        let mut seed = 1_u64;
        let mut next = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
        };
        let mut chain = Chain::zeros(n);
        for i in 0..n {
            for r in 0..4 {
                for c in 0..4 {
                    chain.diag[i][r][c] = next() + if r == c { 5.0 } else { 0.0 };
                    chain.upper[i][r][c] = next();
                    chain.lower[i][r][c] = next();
                }
            }
        }
        chain
    }

    #[test]
    fn solution_satisfies_the_system() {
        let n = 40;
        let a = sample(n);
        let b: Vec<[f64; 4]> = (0..n).map(|i| [1.0, i as f64, -2.0, 0.5]).collect();
        let mut x = b.clone();
        let mut lu = a.clone();
        lu.factor().unwrap();
        lu.solve(&mut x);
        for (r, b) in a.multiply(&x).iter().zip(&b) {
            (0..4).for_each(|k| assert!((r[k] - b[k]).abs() < 1e-12 * n as f64));
        }
    }

    #[test]
    fn a_singular_block_is_named() {
        let mut a = sample(3);
        a.diag[0] = ZERO;
        assert_eq!(a.factor(), Err(SingularPivot { node: 0 }));
    }
}
