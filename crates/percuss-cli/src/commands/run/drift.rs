//! How far strains and angular rates have drifted from the configuration, in the table at the end of a run.

use percuss::{AuditSummary, RunSummary};

use crate::number::{number, small};

/// What the scheme carries beside the motion of the nodes, and how far both have come apart.
pub(super) fn drift(run: &RunSummary) -> String {
    let audit = &run.audit;
    format!(
        "curvature {} 1/m, membrane strain {}, angular rates {} (relative)",
        small(audit.curvature_drift_max),
        small(audit.membrane_drift_max),
        small(audit.angular_rate_drift_max)
    )
}

/// Said where the step does not resolve the motion.
pub(super) fn unresolved(run: &RunSummary) -> Option<(String, String)> {
    let drift = run.audit.angular_rate_drift_max;
    let said = format!(
        "the step does not resolve the motion: kinetic energy by the slopes' velocities and by the sections' angular rates, which is conserved, differ \
         by {} % of the energy; take a smaller step",
        number(100.0 * drift)
    );
    (drift > AuditSummary::UNRESOLVED).then(|| ("resolution".to_owned(), said))
}
