//! Drift of strains and angular rates from the configuration, in the table at the end of a run.

use percuss::{AuditSummary, RunSummary};
use serde_json::Value;

use crate::number::{number, small};

/// Difference between the stored strains of the scheme that stores them and those of the configuration.
pub(super) fn drift(run: &RunSummary, summary: &Value) -> Option<(String, String)> {
    let audit = &run.audit;
    let text = format!(
        "curvature {} 1/m, membrane strain {}",
        small(audit.curvature_drift_max),
        small(audit.membrane_drift_max)
    );
    (summary["settings"]["scheme"] == "strain-rate").then(|| ("strain drift".to_owned(), text))
}

/// A row where the step does not resolve the motion.
pub(super) fn unresolved(run: &RunSummary) -> Option<(String, String)> {
    let drift = run.audit.angular_rate_drift_max;
    let text = format!(
        "the time step does not resolve the motion: the kinetic energies from nodal velocities and from section rotation rates differ by {} % of \
         the energy; use a smaller step",
        number(100.0 * drift)
    );
    (drift > AuditSummary::UNRESOLVED).then(|| ("resolution".to_owned(), text))
}
