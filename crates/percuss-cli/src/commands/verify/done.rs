//! A case that was run.

use percuss_verification::{Case, Check, Report};

use crate::number::count;

/// A case that was run.
pub(super) struct Done {
    pub(super) case: &'static Case,
    /// Its comparisons, shape (checks).
    pub(super) checks: Vec<Check>,
    /// What the manual shows beside them.
    pub(super) report: Report,
    pub(super) seconds: f64,
}

impl Done {
    /// Whether every check holds; a case that checks nothing shows nothing.
    pub(super) fn holds(&self) -> bool {
        !self.checks.is_empty() && self.checks.iter().all(Check::holds)
    }
}

pub(super) fn verdict(all: &[Done]) -> String {
    let checks = count(all.iter().map(|done| done.checks.len()).sum(), "check");
    let seconds: f64 = all.iter().map(|done| done.seconds).sum();
    let failing: Vec<&str> = all.iter().filter(|d| !d.holds()).map(|d| d.case.id).collect();
    let cases = count(all.len(), "case");
    match failing.as_slice() {
        [] => format!("{cases}, {checks}: all passed ({seconds:.1} s)"),
        _ => format!("{cases}, {checks}: failed: {} ({seconds:.1} s)", failing.join(", ")),
    }
}
