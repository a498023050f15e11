//! Many runs, nothing recorded but their summaries.

use super::detail::Detail;
use super::run::simulate_ensemble;
use percuss::NoRecorder;
use percuss::RunSummary;
use percuss::Settings;
use percuss::simulate;
use percuss::{Fault, Model};

/// Simulates every model under its settings and keeps the summaries, in their order.
///
/// A run's summary is the same to the last bit whatever runs stand beside it.
///
/// # Errors
/// Per run every fault of its settings, as [`simulate`].
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
