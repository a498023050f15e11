//! Many runs, nothing recorded but their summaries.

use super::run::simulate_ensemble;
use percuss::NoRecorder;
use percuss::RunSummary;
use percuss::Settings;
use percuss::simulate;
use percuss::{Fault, Model};

/// How much the summaries of a batch tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detail {
    /// Everything.
    #[default]
    Full,
    /// All but section forces and reactions of supports, which are left out. Beams and frames, elastic, damped or
    /// yielding, that guided projectiles strike, at most one of them rigid, and dead loads act on then run side by side in vector
    /// registers, many times as fast ([`runs_alone`](crate::runs_alone) tells what keeps a run from it).
    Motion,
}

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
        Detail::Motion => simulate_ensemble(runs),
    };
    let single = |(model, settings): &(&Model, &Settings)| {
        let mut summary = simulate(model, settings, &mut NoRecorder)?;
        if detail == Detail::Motion {
            summary.supports.clear();
            summary.section_forces.clear();
            for contact in &mut summary.contacts {
                contact.equivalent_force = None;
                contact.no_equivalent_force = None;
            }
        }
        Ok(summary)
    };
    let each = known.into_iter().zip(runs);
    each.map(|(summary, run)| summary.map_or_else(|| single(run), Ok)).collect()
}
