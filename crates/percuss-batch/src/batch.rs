//! Many runs of which only the summaries are recorded.

use super::detail::Detail;
use super::run::simulate_ensemble;
use percuss::NoRecorder;
use percuss::RunSummary;
use percuss::Settings;
use percuss::simulate;
use percuss::{Fault, Model};

/// Simulates every model with its settings and returns the summaries in the same order.
/// The summary of a run does not depend on the other runs, to the last bit.
///
/// # Errors
/// For each run all faults of its settings, as [`simulate`].
pub fn simulate_batch(
    runs: &[(&Model, &Settings)],
    detail: Detail,
) -> Vec<Result<RunSummary, Vec<Fault>>> {
    let known = match detail {
        Detail::Full => runs.iter().map(|_| None).collect(),
        _ => simulate_ensemble(runs, detail),
    };
    let single = |(model, settings): &(&Model, &Settings)| {
        let mut summary = simulate(model, settings, &mut NoRecorder)?;
        detail.leave_out(&mut summary);
        Ok(summary)
    };
    let each = known.into_iter().zip(runs);
    each.map(|(summary, run)| summary.map_or_else(|| single(run), Ok)).collect()
}
