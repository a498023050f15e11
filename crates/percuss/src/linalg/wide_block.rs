//! Small dense blocks of [`Wide`] numbers, row by row.

use super::gauss_jordan::{eliminate_largest, restore};
use crate::scalar::Wide;

/// `c -= a b` with a of shape (rows, inner) and b of shape (inner, columns); rows of c are `stride` apart.
#[inline]
pub fn sub_product(
    c: &mut [Wide],
    stride: usize,
    a: &[Wide],
    b: &[Wide],
    rows: usize,
    inner: usize,
    columns: usize,
) {
    for i in 0..rows {
        let (row, left) =
            (&mut c[i * stride..i * stride + columns], &a[i * inner..(i + 1) * inner]);
        for (k, l) in left.iter().enumerate() {
            if l.round() == 0.0 {
                continue;
            }
            for (c, b) in row.iter_mut().zip(&b[k * columns..(k + 1) * columns]) {
                *c -= *l * *b;
            }
        }
    }
}

/// Inverts in place; `false` if a pivot vanishes or is not finite.
pub fn inverse(m: &mut [Wide], n: usize) -> bool {
    let mut exchanged = vec![0; n];
    for k in 0..n {
        let row = eliminate_largest(m, n, k, Wide::round, |factor| factor.round() == 0.0);
        let Some(row) = row else { return false };
        exchanged[k] = row;
    }
    restore(m, n, &exchanged);
    true
}

/// Number of negative eigenvalues of a symmetric matrix: signs of the pivots of its factors `L D L^T`, with pivots of order one or two in the
/// remainder (Bunch, Parlett 1971); `None` if it is singular to the last digit.
pub fn negatives(matrix: &[Wide], n: usize, m: &mut Vec<Wide>) -> Option<usize> {
    // Largest share of a diagonal entry that still makes it the pivot.
    const ALPHA: f64 = 0.64;
    m.clear();
    m.extend_from_slice(matrix);
    equilibrate(m, n);
    let (mut negative, mut k) = (0, 0);
    while k < n {
        let (mut diagonal, mut beside) = ((0.0, k), (0.0, k, k));
        for i in k..n {
            let size = m[i * n + i].round().abs();
            if size > diagonal.0 {
                diagonal = (size, i);
            }
            for j in k..i {
                let size = m[i * n + j].round().abs();
                if size > beside.0 {
                    beside = (size, i, j);
                }
            }
        }
        if diagonal.0 == 0.0 && beside.0 == 0.0 {
            return None;
        }
        if diagonal.0 >= ALPHA * beside.0 {
            exchange(m, n, k, diagonal.1);
            negative += usize::from(m[k * n + k].round() < 0.0);
            let reciprocal = Wide::ONE / m[k * n + k];
            for i in k + 1..n {
                let factor = m[i * n + k] * reciprocal;
                for j in k + 1..n {
                    let product = factor * m[k * n + j];
                    m[i * n + j] -= product;
                }
            }
            k += 1;
        } else {
            // Of a pair without a diagonal to speak of, one is negative.
            exchange(m, n, k, beside.2);
            exchange(m, n, k + 1, beside.1);
            negative += 1;
            let (a, b, c) = (m[k * n + k], m[k * n + k + 1], m[(k + 1) * n + k + 1]);
            let reciprocal = Wide::ONE / (a * c - b * b);
            for i in k + 2..n {
                let (x, y) = (m[i * n + k], m[i * n + k + 1]);
                let (u, v) = ((x * c - y * b) * reciprocal, (y * a - x * b) * reciprocal);
                for j in k + 2..n {
                    let product = u * m[k * n + j] + v * m[(k + 1) * n + j];
                    m[i * n + j] -= product;
                }
            }
            k += 2;
        }
    }
    Some(negative)
}

/// Scales rows and columns alike: displacements, slopes and multipliers differ by many orders.
fn equilibrate(m: &mut [Wide], n: usize) {
    for _ in 0..2 {
        for i in 0..n {
            let most = (0..n).fold(0.0_f64, |most, j| most.max(m[i * n + j].round().abs()));
            if most == 0.0 || !most.is_finite() {
                continue;
            }
            let factor = 1.0 / most.sqrt();
            for j in 0..n {
                m[i * n + j] = m[i * n + j] * factor;
                m[j * n + i] = m[j * n + i] * factor;
            }
        }
    }
}

fn exchange(m: &mut [Wide], n: usize, a: usize, b: usize) {
    if a != b {
        (0..n).for_each(|j| m.swap(a * n + j, b * n + j));
        (0..n).for_each(|i| m.swap(i * n + a, i * n + b));
    }
}
