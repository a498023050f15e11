//! Block-tridiagonal matrices of 4 x 4 blocks: the band of beams meshed node by node.

use super::block::{self, Block, ZERO};
use crate::scalar::{Real, in_lanes};
use pulp::{Simd, WithSimd};

/// A block-tridiagonal matrix, or, after [`Chain::factor`], its block LU factors in place.
///
/// Between two beams the coupling blocks are zero. From some node on all nodes may be uncoupled; their coupling blocks are not used.
#[derive(Clone, Debug, Default)]
pub struct Chain {
    /// First node from which on all are on their own.
    pub isolated: usize,
    /// Diagonal blocks, shape (nodes, 4, 4) \[N/m, N, N m of a stiffness, kg, kg m, kg m^2 of a mass\]; after factorisation the inverses of
    /// the pivots, transposed as all factors.
    pub diag: Vec<Block>,
    /// Block in row i, column i + 1, shape (nodes, 4, 4) \[as the diagonal\]; the last one is unused. After factorisation `pivot^-1 upper`
    /// before the middle, `upper pivot^-1` behind it \[-, m, 1/m\].
    pub upper: Vec<Block>,
    /// Block in row i + 1, column i, shape (nodes, 4, 4) \[as the diagonal\]; the last one is unused. After factorisation the other way round
    /// \[-, m, 1/m\].
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

    /// Block LU factorisation in place, from both ends towards the middle, pivoting inside the blocks.
    ///
    /// # Errors
    /// [`SingularPivot`] names the block that cannot be inverted.
    pub fn factor(&mut self) -> Result<(), SingularPivot> {
        for i in self.isolated..self.diag.len() {
            self.diag[i] = block::inverse_alone(&self.diag[i]).ok_or(SingularPivot { node: i })?;
        }
        in_lanes(Factor(self))
    }

    /// Solves in place with the factors.
    pub fn solve(&self, x: &mut [[f64; 4]]) {
        debug_assert_eq!(x.len(), self.diag.len());
        for i in self.isolated..x.len() {
            x[i] = block::apply(&self.diag[i], &x[i]);
        }
        in_lanes(Solve(self, x));
    }

    /// The row towards which both ends are eliminated. Two independent eliminations take hardly longer than one.
    fn middle(&self) -> usize {
        self.isolated / 2
    }

    /// Eliminates row `i` towards row `next`, a neighbour.
    #[inline(always)]
    fn eliminate(&mut self, i: usize, next: usize) -> Result<(), SingularPivot> {
        let inverse = block::inverse(&self.diag[i]).ok_or(SingularPivot { node: i })?;
        let between = i.min(next);
        let (own, other) = (&mut self.upper[between], &mut self.lower[between]);
        let (ahead, behind) = if i < next { (own, other) } else { (other, own) };
        let gain = fused::mul(&inverse, ahead);
        fused::sub_mul(&mut self.diag[next], behind, &gain);
        *ahead = gain;
        *behind = fused::mul(behind, &inverse);
        self.diag[i] = inverse;
        Ok(())
    }
}

/// Adds the tangent of the element from node `a` to a band, after the elements before it: diagonal, blocks above and below it. Blocks of this
/// element alone are set.
#[inline(always)]
pub fn add_element<S: Real>(
    [diag, upper, lower]: [&mut [Block<S>]; 3],
    a: usize,
    [aa, ab, ba, bb]: &[Block<S>; 4],
) {
    for i in 0..4 {
        for j in 0..4 {
            diag[a][i][j] += aa[i][j];
        }
    }
    (upper[a], lower[a], diag[a + 1]) = (*ab, *ba, *bb);
}

/// See [`Chain::factor`].
struct Factor<'a>(&'a mut Chain);

impl WithSimd for Factor<'_> {
    type Output = Result<(), SingularPivot>;
    #[inline(always)]
    fn with_simd<P: Simd>(self, _: P) -> Self::Output {
        let chain = self.0;
        let Some(last) = chain.isolated.checked_sub(1) else { return Ok(()) };
        let middle = chain.middle();
        for k in 0..middle {
            chain.eliminate(k, k + 1)?;
            if last - k > middle {
                chain.eliminate(last - k, last - k - 1)?;
            }
        }
        let pivot = &mut chain.diag[middle];
        *pivot = block::inverse(pivot).ok_or(SingularPivot { node: middle })?;
        // Apart from the products, which else are no longer taken row by row.
        for blocks in [&mut chain.diag[..=last], &mut chain.upper[..last], &mut chain.lower[..last]]
        {
            blocks.iter_mut().for_each(|b| *b = block::transpose(b));
        }
        Ok(())
    }
}

/// See [`Chain::solve`]; right side and solution, shape (nodes, 4) \[unit of either\].
struct Solve<'a>(&'a Chain, &'a mut [[f64; 4]]);

impl WithSimd for Solve<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<P: Simd>(self, _: P) {
        let Self(Chain { diag, upper, lower, isolated, .. }, x) = self;
        let Some(last) = isolated.checked_sub(1) else { return };
        let middle = self.0.middle();
        // Values that pass from one row to the next stay in registers.
        let (mut up, mut down) = (x[0], x[last]);
        for k in 0..middle {
            let (i, j) = (k, last - k);
            x[i] = fused::apply(&diag[i], &up);
            up = fused::less_applied(&x[i + 1], &lower[i], &up);
            if j > middle {
                x[j] = fused::apply(&diag[j], &down);
                down = fused::less_applied(&x[j - 1], &upper[j - 1], &down);
            }
        }
        // Both have ended in the middle.
        for c in 0..4 {
            up[c] += down[c] - x[middle][c];
        }
        up = fused::apply(&diag[middle], &up);
        (x[middle], down) = (up, up);
        for k in (0..middle).rev() {
            let (i, j) = (k, last - k);
            up = fused::less_applied(&x[i], &upper[i], &up);
            x[i] = up;
            if j > middle {
                down = fused::less_applied(&x[j], &lower[j - 1], &down);
                x[j] = down;
            }
        }
    }
}

/// Products of blocks that round once a term, as processors do fastest; for code compiled for such a processor.
mod fused {
    use super::Block;

    #[inline(always)]
    pub fn mul(a: &Block, b: &Block) -> Block {
        let mut c = [[0.0; 4]; 4];
        for i in 0..4 {
            for k in 0..4 {
                for j in 0..4 {
                    c[i][j] = a[i][k].mul_add(b[k][j], c[i][j]);
                }
            }
        }
        c
    }

    /// `c -= a b`.
    #[inline(always)]
    pub fn sub_mul(c: &mut Block, a: &Block, b: &Block) {
        for i in 0..4 {
            for k in 0..4 {
                for j in 0..4 {
                    c[i][j] = (-a[i][k]).mul_add(b[k][j], c[i][j]);
                }
            }
        }
    }

    /// The transposed block times `x`.
    #[inline(always)]
    pub fn apply(a: &Block, x: &[f64; 4]) -> [f64; 4] {
        let mut y = [0.0; 4];
        for k in 0..4 {
            for i in 0..4 {
                y[i] = a[k][i].mul_add(x[k], y[i]);
            }
        }
        y
    }

    /// `y` less the transposed block times `x`.
    #[inline(always)]
    pub fn less_applied(y: &[f64; 4], a: &Block, x: &[f64; 4]) -> [f64; 4] {
        let mut y = *y;
        for k in 0..4 {
            for i in 0..4 {
                y[i] = (-a[k][i]).mul_add(x[k], y[i]);
            }
        }
        y
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
        [0, 1, 2, 3, 4, 5, 40, 41].into_iter().for_each(satisfies);
    }

    fn satisfies(n: usize) {
        let a = sample(n);
        let b: Vec<[f64; 4]> = (0..n).map(|i| [1.0, i as f64, -2.0, 0.5]).collect();
        let mut x = b.clone();
        let mut lu = a.clone();
        lu.factor().unwrap();
        lu.solve(&mut x);
        for (r, b) in a.multiply(&x).iter().zip(&b) {
            (0..4).for_each(|k| assert!((r[k] - b[k]).abs() < 1e-12 * n as f64, "{n}"));
        }
    }

    #[test]
    fn a_singular_block_is_named() {
        let mut a = sample(3);
        a.diag[0] = ZERO;
        assert_eq!(a.factor(), Err(SingularPivot { node: 0 }));
    }
}
