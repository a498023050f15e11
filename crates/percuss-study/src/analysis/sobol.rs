//! Sobol indices: which share of the variance of a result is whose.
//!
//! Estimators of Saltelli et al. (2010), Variance based sensitivity analysis of model output, Comput. Phys. Commun. 181,
//! table 2: (b) for first-order indices, (f), Jansen's, for total ones.

use super::bootstrap::{Estimate, bootstrap};
use crate::column::Table;
use crate::study::Study;

/// Sobol indices of a result.
#[derive(Clone, Debug, PartialEq)]
pub struct SobolIndices {
    /// Share of the variance that vanishes if the parameter alone is known, one entry a parameter, shape (parameters).
    pub first: Vec<Estimate>,
    /// Share of the variance that remains if all but the parameter are known, one entry a parameter, shape (parameters).
    pub total: Vec<Estimate>,
    /// Variance of the result, in its unit squared.
    pub variance: f64,
    /// Points of the design that count: all of their runs have the result.
    pub points: usize,
}

/// Points without a value in any of their runs may be this share of all: without more of them the rest is no longer a sample of
/// the parameters, and their parameters are no longer independent.
const MOST_LOST: f64 = 0.2;

/// Why a result has no Sobol indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoIndices {
    /// The study was not arranged for them, or has no such result.
    NotArranged,
    /// No run has a value.
    NoValues,
    /// Too few points have a value in all of their runs.
    TooFew {
        /// These.
        points: usize,
        /// Points of the design.
        of: usize,
    },
    /// All values are equal, but for round-off.
    Constant,
}

impl std::fmt::Display for NoIndices {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NotArranged => f.write_str("the study is not arranged for them"),
            Self::NoValues => f.write_str("no run has a value"),
            Self::TooFew { points, of } => write!(
                f,
                "only {points} of {of} points have a value in all of their runs, and those are no sample of the parameters"
            ),
            Self::Constant => f.write_str("its values are all the same"),
        }
    }
}

/// Sobol indices from results at the points A, B, and A with one column of B, `mixed[i]` with the i-th.
///
/// `None` for fewer than two points and for results that do not vary. The seed is that of the resampling.
pub fn sobol_indices(a: &[f64], b: &[f64], mixed: &[Vec<f64>], seed: u64) -> Option<SobolIndices> {
    let n = a.len();
    let parameters = mixed.len();
    let mean = a.iter().chain(b).sum::<f64>() / (2 * n).max(1) as f64;
    // Deviations from the mean: the estimator of first-order indices errs less with them.
    let centred = |values: &[f64]| values.iter().map(|f| f - mean).collect::<Vec<f64>>();
    let (a, b) = (centred(a), centred(b));
    let mixed: Vec<Vec<f64>> = mixed.iter().map(|values| centred(values)).collect();
    let variance = a.iter().chain(&b).map(|f| f * f).sum::<f64>() / (2 * n).max(1) as f64;
    if n < 2 || variance.is_nan() || variance <= 1e-28 * mean * mean {
        return None;
    }
    let indices = |points: &[u32]| {
        let (mut sum, mut squares) = (0.0, 0.0);
        let (mut first, mut total) = (vec![0.0; parameters], vec![0.0; parameters]);
        for point in points.iter().map(|point| *point as usize) {
            sum += a[point] + b[point];
            squares += a[point] * a[point] + b[point] * b[point];
            for (i, mixed) in mixed.iter().enumerate() {
                let change = mixed[point] - a[point];
                first[i] += b[point] * change;
                total[i] += 0.5 * change * change;
            }
        }
        let n = points.len() as f64;
        let variance = squares / (2.0 * n) - (sum / (2.0 * n)).powi(2);
        first.into_iter().chain(total).map(|sum| sum / n / variance).collect()
    };
    let mut first = bootstrap(n, n * (parameters + 2), seed, indices);
    let total = first.split_off(parameters);
    Some(SobolIndices { first, total, variance, points: n })
}

/// Sobol indices of a result of a study that was arranged for them.
///
/// Points without a value in one of their runs do not count.
///
/// # Errors
/// Why there are none.
pub fn sobol_indices_of(
    study: &Study,
    table: &Table,
    result: &str,
) -> Result<SobolIndices, NoIndices> {
    let values = table.numbers(result).filter(|_| study.has_sobol_indices());
    let values = values.ok_or(NoIndices::NotArranged)?;
    let parameters = study.parameters().len();
    let (mut a, mut b, mut mixed) = (Vec::new(), Vec::new(), vec![Vec::new(); parameters]);
    for point in values.chunks_exact(parameters + 2).filter(|p| p.iter().all(|f| f.is_finite())) {
        a.push(point[0]);
        b.push(point[1]);
        mixed.iter_mut().zip(&point[2..]).for_each(|(all, f)| all.push(*f));
    }
    if values.iter().all(|f| !f.is_finite()) {
        return Err(NoIndices::NoValues);
    }
    let (points, of) = (a.len(), values.len() / (parameters + 2));
    if points < 2 || ((of - points) as f64) > MOST_LOST * of as f64 {
        return Err(NoIndices::TooFew { points, of });
    }
    sobol_indices(&a, &b, &mixed, study.seed()).ok_or(NoIndices::Constant)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::design::{Design, Kind};

    /// Ishigami and Homma (1990), with the usual coefficients.
    const A: f64 = 7.0;
    const B: f64 = 0.1;

    fn ishigami(u: &[f64]) -> f64 {
        let x: Vec<f64> = u.iter().map(|u| PI * (2.0 * u - 1.0)).collect();
        x[0].sin() + A * x[1].sin().powi(2) + B * x[2].powi(4) * x[0].sin()
    }

    fn estimated(kind: Kind, points: u64) -> SobolIndices {
        let mut design = Design::new(kind, points, 3, 1);
        design.sobol_indices = true;
        let run = |k: u64| (0..points).map(|j| ishigami(&design.point(5 * j + k))).collect();
        let mixed: Vec<Vec<f64>> = (2..5).map(run).collect();
        sobol_indices(&run(0), &run(1), &mixed, 3).expect("indices")
    }

    /// First-order and total indices from the closed form of the variance's parts.
    fn exact() -> ([f64; 3], [f64; 3]) {
        let alone_1 = 0.5 * (1.0 + B * PI.powi(4) / 5.0).powi(2);
        let alone_2 = A * A / 8.0;
        let both_13 = B * B * PI.powi(8) * (1.0 / 18.0 - 1.0 / 50.0);
        let all = alone_1 + alone_2 + both_13;
        let first = [alone_1, alone_2, 0.0].map(|part| part / all);
        let total = [alone_1 + both_13, alone_2, both_13].map(|part| part / all);
        (first, total)
    }

    #[test]
    fn indices_of_the_ishigami_function_are_those_of_its_closed_form() {
        let (first, total) = exact();
        assert!((first[0] - 0.3139).abs() < 1e-4 && (total[2] - 0.2437).abs() < 1e-4);
        let found = estimated(Kind::Sobol, 1 << 14);
        for i in 0..3 {
            // A Sobol sequence of 2^14 points errs by some 1e-3.
            assert!((found.first[i].value - first[i]).abs() < 3e-3, "{i}: {:?}", found.first[i]);
            assert!((found.total[i].value - total[i]).abs() < 3e-3, "{i}: {:?}", found.total[i]);
        }
    }

    #[test]
    fn intervals_hold_the_exact_indices_and_shrink_with_the_sample() {
        let (first, total) = exact();
        let (few, many) = (estimated(Kind::MonteCarlo, 1000), estimated(Kind::MonteCarlo, 16_000));
        let width = |e: &Estimate| e.high - e.low;
        for i in 0..3 {
            for (few, many, exact) in [
                (&few.first[i], &many.first[i], first[i]),
                (&few.total[i], &many.total[i], total[i]),
            ] {
                // 95 % of the intervals hold the value; half as wide again, nearly all of them do.
                let slack = 0.25 * width(many);
                assert!(
                    (many.low - slack..=many.high + slack).contains(&exact),
                    "{many:?} {exact}"
                );
                // Sixteen times the points, a quarter of the width, give or take.
                assert!((2.5..6.5).contains(&(width(few) / width(many))), "{few:?} {many:?}");
            }
        }
    }

    #[test]
    fn a_result_that_does_not_vary_has_no_indices() {
        assert_eq!(sobol_indices(&[1.0; 8], &[1.0; 8], &[vec![1.0; 8]], 1), None);
        assert_eq!(sobol_indices(&[], &[], &[Vec::new()], 1), None);
    }
}
