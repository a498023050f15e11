//! Covariance of the parameters from the Jacobian.

use nalgebra::{DMatrix, SymmetricEigen};

/// Eigenvalues below this share of the largest one are round-off.
const ROUND_OFF: f64 = 1e-13;
/// A direction concerns a parameter whose component exceeds this.
const COMPONENT: f64 = 1e-3;

/// Covariance of coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Covariance {
    /// The inverse of J' J, infinite variance where data say nothing, shape (n, n) \[-\].
    pub matrix: Vec<Vec<f64>>,
    /// Coefficients of correlation, shape (n, n) \[-\].
    pub correlation: Vec<Vec<f64>>,
    /// Condition number of J with columns of length one.
    pub condition: f64,
    /// Coordinates that the residuals do not depend on, or that others can replace, shape (n).
    pub unresolved: Vec<bool>,
}

/// Covariance of least squares with unit variance of the residuals: (J' J)^-1.
pub(crate) fn covariance(jacobian: &[Vec<f64>], n: usize) -> Covariance {
    let column = |j: usize| jacobian.iter().map(|row| row[j] * row[j]).sum::<f64>().sqrt();
    let lengths: Vec<f64> = (0..n).map(column).collect();
    let blind = |j: usize| !(lengths[j] > 0.0 && lengths[j].is_finite());
    let scale = |j: usize| if blind(j) { 1.0 } else { lengths[j] };
    let normal = DMatrix::from_fn(n, n, |i, j| {
        jacobian.iter().map(|row| row[i] * row[j]).sum::<f64>() / (scale(i) * scale(j))
    });
    let SymmetricEigen { eigenvectors, eigenvalues } = SymmetricEigen::new(normal);
    let largest = eigenvalues.iter().copied().fold(0.0, f64::max);
    let smallest = eigenvalues.iter().copied().fold(f64::INFINITY, f64::min);
    let lost = |k: usize| eigenvalues[k] <= ROUND_OFF * largest;
    let mut unresolved: Vec<bool> = (0..n).map(blind).collect();
    for k in (0..n).filter(|k| lost(*k)) {
        for (i, one) in unresolved.iter_mut().enumerate() {
            *one |= eigenvectors[(i, k)].abs() > COMPONENT;
        }
    }
    let entry = |i: usize, j: usize| -> f64 {
        let known = (0..n).filter(|k| !lost(*k));
        let sum: f64 =
            known.map(|k| eigenvectors[(i, k)] * eigenvectors[(j, k)] / eigenvalues[k]).sum();
        sum / (scale(i) * scale(j))
    };
    let value = |i: usize, j: usize| match (i == j, unresolved[i] || unresolved[j]) {
        (true, true) => f64::INFINITY,
        (false, true) => f64::NAN,
        _ => entry(i, j),
    };
    let matrix: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| value(i, j)).collect()).collect();
    let ratio = |i: usize, j: usize| match i == j {
        true => 1.0,
        false => matrix[i][j] / (matrix[i][i] * matrix[j][j]).sqrt(),
    };
    let correlation = (0..n).map(|i| (0..n).map(|j| ratio(i, j)).collect()).collect();
    let condition = match smallest > 0.0 {
        true => (largest / smallest).sqrt(),
        false => f64::INFINITY,
    };
    Covariance { matrix, correlation, condition, unresolved }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_has_the_variances_of_the_textbook() {
        // y = a + b t at t = 0, 1, 2, 3: var b = 1 / sum (t - mean)^2, var a = 1/n + mean^2 / that sum.
        let jacobian: Vec<Vec<f64>> = (0..4).map(|t| vec![1.0, f64::from(t)]).collect();
        let found = covariance(&jacobian, 2);
        assert!((found.matrix[1][1] - 0.2).abs() < 1e-14);
        assert!((found.matrix[0][0] - (0.25 + 2.25 * 0.2)).abs() < 1e-14);
        assert!((found.matrix[0][1] + 1.5 * 0.2).abs() < 1e-14);
        let expected = -0.3 / (0.7_f64 * 0.2).sqrt();
        assert!((found.correlation[0][1] - expected).abs() < 1e-14);
        assert!(found.unresolved == [false, false] && found.condition < 10.0);
    }

    #[test]
    fn parameters_that_data_cannot_tell_apart_have_no_variance() {
        let jacobian: Vec<Vec<f64>> =
            (0..5).map(f64::from).map(|t| vec![t, 2.0 * t, 1.0, 0.0]).collect();
        let found = covariance(&jacobian, 4);
        assert_eq!(found.unresolved, [true, true, false, true]);
        assert!(found.matrix[0][0].is_infinite() && found.matrix[2][2].is_finite());
    }
}
