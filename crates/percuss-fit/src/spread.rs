//! How far residuals spread.

use crate::loss::Loss;
use crate::spikes::{NORMAL, median};

/// Mean square of residuals per degree of freedom, the reduced chi-square; where the loss is robust, that of normal ones of the same median
/// magnitude, which wrong values that count less do not change much. Residuals of zero, as of a signal that has not begun, say nothing of it.
pub(crate) fn spread(residuals: &[f64], freedom: usize, loss: &Loss) -> f64 {
    let freedom = freedom.max(1) as f64;
    let magnitudes: Vec<f64> = residuals.iter().map(|r| r.abs()).filter(|r| *r > 0.0).collect();
    let squares = match loss.is_robust() && !magnitudes.is_empty() {
        true => residuals.len() as f64 * (NORMAL * median(magnitudes)).powi(2),
        false => residuals.iter().map(|r| r * r).sum(),
    };
    squares / freedom
}

#[cfg(test)]
mod tests {
    use percuss_scenario::fit::{FitJacobian, FitLoss, FitOptions};

    use super::*;

    #[test]
    fn wrong_values_count_little_where_the_loss_is_robust() {
        let of = |loss: FitLoss, residuals: &[f64]| {
            let options = FitOptions {
                loss,
                loss_scale: 1.0,
                starts: 1,
                seed: 0,
                jacobian: FitJacobian::Auto,
                iterations: 100,
            };
            spread(residuals, residuals.len() - 1, &Loss::of(&options))
        };
        let mut residuals = vec![0.5, -1.0, 0.0, 1.5, -0.5, 1.0, 0.0, -1.0, 0.5, 0.5];
        assert!((of(FitLoss::Linear, &residuals) - 6.25 / 9.0).abs() < 1e-14);
        let clean = of(FitLoss::SoftL1, &residuals);
        // The median of eight magnitudes, the upper one of the two in the middle.
        assert!((clean - 10.0 / 9.0 * NORMAL.powi(2)).abs() < 1e-14, "{clean}");
        residuals[3] = 1e3;
        assert!((of(FitLoss::Huber, &residuals) - clean).abs() < 1e-14);
        assert!(of(FitLoss::Linear, &residuals) > 1e5);
        assert_eq!(of(FitLoss::Huber, &[0.0; 3]).to_bits(), 0.0_f64.to_bits());
    }
}
