//! How much of its runs a study asks for.

use percuss_batch::Detail;
use percuss_output::SummaryPath;

use crate::result_path::ResultPath;

/// How much of a run results at these paths need.
pub(crate) fn detail_for(paths: &[ResultPath]) -> Detail {
    let any = |of: fn(&SummaryPath) -> bool| paths.iter().filter_map(ResultPath::summary).any(of);
    if paths.iter().any(is_known_alone) {
        Detail::Full
    } else if any(SummaryPath::is_of_stresses) {
        Detail::Stresses
    } else if any(SummaryPath::is_of_resultants) {
        Detail::Resultants
    } else {
        Detail::Motion
    }
}

/// Whether runs tell a result only alone.
pub(crate) fn is_known_alone(path: &ResultPath) -> bool {
    // Runs in SIMD batches have no history.
    let Some(path) = path.summary() else { return true };
    // What the solver counts of itself is that of a run alone, whatever stands beside it.
    let side_by_side = path.is_of_resultants() || path.is_of_stresses();
    path.is_of_effort() || path.is_of_forces() && !side_by_side
}
