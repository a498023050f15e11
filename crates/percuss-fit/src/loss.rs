//! How residuals count: squares, or a robust loss.

use basin::{HuberLoss, LossEvaluation, LossFunction, SoftL1Loss, SquaredLoss};
use percuss_scenario::fit::{FitLoss, FitOptions};

/// A loss, and the residual at which it leaves the square.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Loss {
    kind: FitLoss,
    scale: f64,
}

impl LossFunction for Loss {
    fn evaluate(&self, z: f64) -> LossEvaluation {
        match self.kind {
            FitLoss::Linear => SquaredLoss.evaluate(z),
            FitLoss::SoftL1 => SoftL1Loss.evaluate(z),
            FitLoss::Huber => HuberLoss.evaluate(z),
        }
    }
}

impl Loss {
    /// The loss of a fit.
    pub fn of(options: &FitOptions) -> Self {
        Self { kind: options.loss, scale: options.loss_scale }
    }

    /// Whether large residuals count less than by their square.
    pub fn is_robust(&self) -> bool {
        self.kind != FitLoss::Linear
    }

    /// Residual at which it leaves the square.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Factor on the row of the Jacobian of a residual, so that J' J is the Gauss-Newton approximation of the Hessian of the cost:
    /// sqrt(rho' + 2 z rho''), as in SciPy's `least_squares` (Triggs et al. 1999, Bundle adjustment).
    pub fn weight(&self, residual: f64) -> f64 {
        let z = (residual / self.scale).powi(2);
        let found = self.evaluate(z);
        (found.first_derivative + 2.0 * z * found.second_derivative).max(f64::EPSILON).sqrt()
    }
}
