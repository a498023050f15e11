//! A run that has ended.

use std::path::{Path, PathBuf};

use percuss::RunSummary;
use percuss_advice::AuditWarning;
use serde_json::Value;

use super::checkpoints::Checkpoints;
use super::recorder::EnergySeries;

/// A run that has ended, one way or the other.
pub(super) struct Ended {
    pub(super) summary: RunSummary,
    pub(super) value: Value,
    /// Results beside hand formulas, shape (comparisons).
    pub(super) comparisons: Vec<percuss_advice::Comparison>,
    pub(super) energy: EnergySeries,
    pub(super) checkpoints: Option<Checkpoints>,
    /// What its audit warns of, shape (warnings).
    pub(super) warnings: Vec<AuditWarning>,
    /// What was found after it whose code is denied, shape (findings).
    pub(super) denied: Vec<String>,
}

/// A path as short as the working directory allows.
pub(super) fn shown(path: &Path) -> PathBuf {
    let here = std::env::current_dir().and_then(|dir| dir.canonicalize()).unwrap_or_default();
    path.strip_prefix(here).unwrap_or(path).to_owned()
}
