//! Many runs, nothing recorded but their summaries.

use super::simulation::simulate;
use crate::model::{Fault, Model};
use crate::record::NoRecorder;
use crate::settings::Settings;
use crate::summary::RunSummary;

/// Simulates every model under its settings and keeps the summaries, in their order.
///
/// # Errors
/// Per run every fault of its settings, as [`simulate`].
pub fn simulate_batch(runs: &[(&Model, &Settings)]) -> Vec<Result<RunSummary, Vec<Fault>>> {
    runs.iter().map(|(model, settings)| simulate(model, settings, &mut NoRecorder)).collect()
}
