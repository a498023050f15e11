//! Inverses in place by Gauss-Jordan elimination, in any numbers; matrices are stored row by row.

use crate::scalar::Real;

/// Inverts a matrix of `n` rows with pivots on the diagonal: lanes cannot search for pivots, each its own.
///
/// Where a pivot fails, the inverse is not finite.
#[inline(always)]
pub fn invert<S: Real>(m: &mut [S], n: usize) {
    for k in 0..n {
        let [reciprocal] = S::ordinary_recips([m[k * n + k]]);
        eliminate(m, n, k, reciprocal, |_| false);
    }
}

/// Eliminates column `k` with the largest entry in or below row `k` as its pivot; returns the row of the pivot, `None` if it vanishes or is not
/// finite. `round` is a number in f64.
///
/// The remaining columns are in the order of the pivots: see [`restore`].
#[inline(always)]
pub fn eliminate_largest<S: Real>(
    m: &mut [S],
    n: usize,
    k: usize,
    round: impl Fn(S) -> f64,
    vanishes: impl Fn(S) -> bool,
) -> Option<usize> {
    let mut p = k;
    for i in k + 1..n {
        if round(m[i * n + k]).abs() > round(m[p * n + k]).abs() {
            p = i;
        }
    }
    if p != k {
        for j in 0..n {
            m.swap(k * n + j, p * n + j);
        }
    }
    let pivot = round(m[k * n + k]);
    if pivot == 0.0 || !pivot.is_finite() {
        return None;
    }
    let reciprocal = m[k * n + k].recip();
    eliminate(m, n, k, reciprocal, vanishes);
    Some(p)
}

/// Puts the columns of an inverse in the order of the matrix, whose row `k` was exchanged with row `exchanged[k]`.
#[inline(always)]
pub fn restore<S>(m: &mut [S], n: usize, exchanged: &[usize]) {
    for k in (0..n).rev() {
        if exchanged[k] != k {
            for i in 0..n {
                m.swap(i * n + k, i * n + exchanged[k]);
            }
        }
    }
}

/// Eliminates column `k`, whose pivot on the diagonal has the given reciprocal; rows whose entry `vanishes` do not change.
#[inline(always)]
fn eliminate<S: Real>(
    m: &mut [S],
    n: usize,
    k: usize,
    reciprocal: S,
    vanishes: impl Fn(S) -> bool,
) {
    m[k * n + k] = reciprocal.constant(1.0);
    for j in 0..n {
        m[k * n + j] = m[k * n + j] * reciprocal;
    }
    for i in 0..n {
        if i == k || vanishes(m[i * n + k]) {
            continue;
        }
        let factor = m[i * n + k];
        m[i * n + k] = factor.constant(0.0);
        for j in 0..n {
            m[i * n + j] = m[i * n + j].sub_product(factor, m[k * n + j]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Wide;

    /// Largest entry of `a b - 1`.
    fn distance_from_one(a: &[f64], b: &[f64], n: usize) -> f64 {
        let entry = |i: usize, j: usize| (0..n).map(|k| a[i * n + k] * b[k * n + j]).sum::<f64>();
        let error = |i: usize, j: usize| (entry(i, j) - f64::from(u8::from(i == j))).abs();
        (0..n * n).map(|e| error(e / n, e % n)).fold(0.0, f64::max)
    }

    fn all_columns<S: Real>(m: &mut [S], n: usize, round: impl Fn(S) -> f64) -> bool {
        let mut exchanged = vec![0; n];
        for k in 0..n {
            match eliminate_largest(m, n, k, &round, |x| round(x) == 0.0) {
                Some(row) => exchanged[k] = row,
                None => return false,
            }
        }
        restore(m, n, &exchanged);
        true
    }

    #[test]
    fn a_matrix_times_its_inverse_is_one_in_any_numbers() {
        let needs_exchanges = [0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 3.0, 0.0, 1.0];
        let mut m = needs_exchanges;
        assert!(all_columns(&mut m, 3, |x| x));
        assert!(distance_from_one(&needs_exchanges, &m, 3) < 1e-15);
        let mut wide = needs_exchanges.map(Wide::from);
        assert!(all_columns(&mut wide, 3, Wide::round));
        assert!(distance_from_one(&needs_exchanges, &wide.map(Wide::round), 3) < 1e-15);

        let dominant = [4.0, 1.0, -0.5, 0.3, -5.0, 1.0, 0.2, 0.7, 3.0];
        let mut m = dominant;
        invert(&mut m, 3);
        assert!(distance_from_one(&dominant, &m, 3) < 1e-15);
        assert!(!all_columns(&mut [1.0, 2.0, 2.0, 4.0], 2, |x| x));
    }
}
