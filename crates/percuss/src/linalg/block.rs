//! 4 x 4 blocks on the stack.

use super::gauss_jordan;
use crate::math::vec2::dot4;
use crate::scalar::Real;

/// A 4 x 4 matrix, row by row.
pub type Block<S = f64> = [[S; 4]; 4];

/// The zero block.
pub const ZERO: Block = [[0.0; 4]; 4];

/// One.
pub const IDENTITY: Block =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// Inner product of nodal values.
pub fn inner(a: &[[f64; 4]], b: &[[f64; 4]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}

/// `a b`.
#[inline(always)]
pub fn mul<S: Real>(a: &Block<S>, b: &Block<S>) -> Block<S> {
    let mut c = [[a[0][0].constant(0.0); 4]; 4];
    for i in 0..4 {
        for k in 0..4 {
            for j in 0..4 {
                c[i][j] = c[i][j].add_product(a[i][k], b[k][j]);
            }
        }
    }
    c
}

/// Rows as columns.
#[inline(always)]
pub fn transpose(a: &Block) -> Block {
    let mut t = ZERO;
    for i in 0..4 {
        for j in 0..4 {
            t[j][i] = a[i][j];
        }
    }
    t
}

/// `c -= a b`.
#[inline(always)]
pub fn sub_mul<S: Real>(c: &mut Block<S>, a: &Block<S>, b: &Block<S>) {
    for i in 0..4 {
        for k in 0..4 {
            for j in 0..4 {
                c[i][j] = c[i][j].sub_product(a[i][k], b[k][j]);
            }
        }
    }
}

/// `a x`.
#[inline(always)]
pub fn apply<S: Real>(a: &Block<S>, x: &[S; 4]) -> [S; 4] {
    let mut y = *x;
    for i in 0..4 {
        y[i] = dot4(&a[i], x);
    }
    y
}

/// `x + a y`.
#[inline(always)]
pub fn add_applied<S: Real>(mut x: [S; 4], a: &Block<S>, y: &[S; 4]) -> [S; 4] {
    for k in 0..4 {
        for i in 0..4 {
            x[i] = x[i].add_product(a[i][k], y[k]);
        }
    }
    x
}

/// `x - a y`.
#[inline(always)]
pub fn less_applied<S: Real>(mut x: [S; 4], a: &Block<S>, y: &[S; 4]) -> [S; 4] {
    for k in 0..4 {
        for i in 0..4 {
            x[i] = x[i].sub_product(a[i][k], y[k]);
        }
    }
    x
}

/// Inverse; `None` if a pivot vanishes or is not finite.
#[inline(always)]
pub fn inverse(a: &Block) -> Option<Block> {
    let (mut m, mut exchanged) = (*a, [0; 4]);
    // Column by column, each known when this is compiled: rows stay in registers.
    exchanged[0] = eliminate::<0>(&mut m)?;
    exchanged[1] = eliminate::<1>(&mut m)?;
    exchanged[2] = eliminate::<2>(&mut m)?;
    exchanged[3] = eliminate::<3>(&mut m)?;
    gauss_jordan::restore(m.as_flattened_mut(), 4, &exchanged);
    Some(m)
}

/// Eliminates column `K`; returns the row of the pivot.
#[inline(always)]
fn eliminate<const K: usize>(m: &mut Block) -> Option<usize> {
    gauss_jordan::eliminate_largest(m.as_flattened_mut(), 4, K, |x| x, |_| false)
}

/// The inverse of the block of a node on its own, which as a rule is diagonal.
pub fn inverse_alone(a: &Block) -> Option<Block> {
    let diagonal = (0..4).all(|r| (0..4).all(|c| r == c || a[r][c] == 0.0));
    if !diagonal {
        return inverse(a);
    }
    let mut out = ZERO;
    for k in 0..4 {
        if a[k][k] == 0.0 || !a[k][k].is_finite() {
            return None;
        }
        out[k][k] = 1.0 / a[k][k];
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_needs_a_pivot_search_and_finds_it() {
        let a = [
            [0.0, 2.0, 0.5, 1.0],
            [1.0, 0.0, -0.3, 0.2],
            [0.0, 0.0, 0.0, 4.0],
            [0.1, 0.2, 3.0, 0.0],
        ];
        let unit = mul(&a, &inverse(&a).unwrap());
        for i in 0..4 {
            for j in 0..4 {
                assert!((unit[i][j] - f64::from(u8::from(i == j))).abs() < 1e-15);
            }
        }
        assert!(inverse(&ZERO).is_none());
    }
}
