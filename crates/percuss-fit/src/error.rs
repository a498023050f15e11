//! Why there is no fit.

use percuss_codes::{AnalysisCode, Code};
use percuss_scenario::Diagnostics;

/// Why a run has no curves.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// The user asked to stop.
    Interrupted,
    /// The parameters make no valid scenario, or its run fails: in one line with its code.
    Failed(String),
}

impl Stop {
    /// A run that fails with a code.
    pub(crate) fn failed(code: impl Into<Code>, text: impl std::fmt::Display) -> Self {
        Self::Failed(code.into().behind(text))
    }
}

impl std::fmt::Display for Stop {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Interrupted => f.write_str("interrupted"),
            Self::Failed(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for Stop {}

/// Why there is no fit.
#[derive(Debug)]
pub enum FitError {
    /// Faults of the file, of its scenarios or records.
    Faults(Box<Diagnostics>),
    /// The runs do not lead to a minimum: as what, and why.
    Run(AnalysisCode, String),
    /// The user asked to stop.
    Interrupted,
    /// The system gives no threads, or a file cannot be written.
    System(percuss_study::Error),
}

impl From<Diagnostics> for FitError {
    fn from(faults: Diagnostics) -> Self {
        Self::Faults(Box::new(faults))
    }
}

impl From<percuss_study::Error> for FitError {
    fn from(error: percuss_study::Error) -> Self {
        Self::System(error)
    }
}

impl From<Stop> for FitError {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Interrupted => Self::Interrupted,
            Stop::Failed(why) => Self::Run(AnalysisCode::NoFit, why),
        }
    }
}
