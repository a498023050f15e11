//! Whether the balances closed.

use percuss::RunSummary;

use crate::number::small;

/// Largest residual of closed balances, relative to the largest amount.
const CLOSED: f64 = 1e-10;

/// What did not close, in words.
pub fn open(run: &RunSummary) -> Vec<String> {
    let residuals = [
        ("energy", run.energy.residual_max),
        ("linear momentum", run.momentum.linear_residual_max),
        ("angular momentum", run.momentum.angular_residual_max),
    ];
    let closed = |residual: f64| residual.abs() <= CLOSED; // NaN is not closed
    let open = residuals.into_iter().filter(|(_, residual)| !closed(*residual));
    open.map(|(what, residual)| {
        format!("the balance of {what} does not close: relative residual {}, at most {CLOSED:e} with --strict", small(residual))
    })
    .collect()
}
