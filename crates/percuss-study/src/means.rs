//! How derivatives were found.

/// Change of a parameter over which runs are differenced, as a share of its size: the errors of truncation and round-off of a central difference
/// are then both of some 1e-6.
pub(crate) const SHARE: f64 = 1e-4;

/// How derivatives were found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Means {
    /// As derivatives of the steps of the run.
    Exact,
    /// As central differences of runs, all of them or those that have no exact ones.
    Differences {
        /// Why there are no exact ones.
        why: String,
    },
}

impl std::fmt::Display for Means {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Exact => f.write_str("exact"),
            Self::Differences { why } => write!(f, "differences: {why}"),
        }
    }
}
