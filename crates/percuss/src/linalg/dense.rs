//! Small dense systems: the border of constraints, impulses of contacts.

/// A dense LU factorisation with partial pivoting; storage is reused from one factorisation to the next.
#[derive(Clone, Debug, Default)]
pub struct DenseLu {
    n: usize,
    /// The matrix, then its factors in place, row by row, shape (n, n) \[unit of the matrix\].
    lu: Vec<f64>,
    /// The row exchanged with each, shape (n) \[index of a row\].
    pivots: Vec<usize>,
}

impl DenseLu {
    /// Factors the `n` x `n` matrix `a`, row by row; `false` if it is singular.
    pub fn factor(&mut self, n: usize, a: &[f64]) -> bool {
        self.n = n;
        self.lu.clear();
        self.lu.extend_from_slice(a);
        self.pivots.clear();
        for k in 0..n {
            let mut p = k;
            for i in k + 1..n {
                if self.lu[i * n + k].abs() > self.lu[p * n + k].abs() {
                    p = i;
                }
            }
            self.pivots.push(p);
            for j in 0..n {
                self.lu.swap(k * n + j, p * n + j);
            }
            let pivot = self.lu[k * n + k];
            if pivot == 0.0 || !pivot.is_finite() {
                return false;
            }
            let (upper, below) = self.lu.split_at_mut((k + 1) * n);
            let along = &upper[k * n + k + 1..];
            for row in below.chunks_exact_mut(n) {
                let factor = row[k] / pivot;
                row[k] = factor;
                row[k + 1..].iter_mut().zip(along).for_each(|(a, p)| *a -= factor * p);
            }
        }
        true
    }

    /// Solves in place.
    pub fn solve(&self, x: &mut [f64]) {
        let n = self.n;
        for k in 0..n {
            x.swap(k, self.pivots[k]);
        }
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        for k in 0..n {
            x[k] -= product(&self.lu[k * n..k * n + k], &x[..k]);
        }
        for k in (0..n).rev() {
            x[k] -= product(&self.lu[k * n + k + 1..(k + 1) * n], &x[k + 1..]);
            x[k] /= self.lu[k * n + k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_with_row_exchanges() {
        let a = [0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 3.0, 0.0, 1.0];
        let mut lu = DenseLu::default();
        assert!(lu.factor(3, &a));
        let mut x = [7.0, 3.0, 6.0];
        lu.solve(&mut x);
        for (row, b) in a.chunks(3).zip([7.0, 3.0, 6.0]) {
            assert!((row[0] * x[0] + row[1] * x[1] + row[2] * x[2] - b).abs() < 1e-14);
        }
        assert!(!lu.factor(2, &[1.0, 2.0, 2.0, 4.0]));
    }
}
