//! Errors of the balances.

use percuss::RunSummary;

use crate::number::small;

/// Largest error of a balance under `--strict`, relative to the largest amount.
const CLOSED: f64 = 1e-10;

/// The errors above it, in words.
pub fn open(run: &RunSummary) -> Vec<String> {
    let residuals = [
        ("energy", run.energy.residual_max),
        ("linear momentum", run.momentum.linear_residual_max),
        ("angular momentum", run.momentum.angular_residual_max),
    ];
    let closed = |residual: f64| residual.abs() <= CLOSED; // NaN is not closed
    let open = residuals.into_iter().filter(|(_, residual)| !closed(*residual));
    open.map(|(what, residual)| {
        format!("{what} balance error {} exceeds {CLOSED:e} (--strict)", small(residual))
    })
    .collect()
}
