//! What convergence is asked of, and what is found.

use super::sequence::Extrapolation;
use percuss_codes::AnalysisCode;
use percuss_scenario::Diagnostics;

/// What is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refined {
    /// The step of time.
    Step,
    /// The elements of every beam.
    Mesh,
    /// The fibres through the depth of every section.
    Fibres,
    /// All of these at once.
    Together,
}

/// A result on finer steps, meshes, fibres, or all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence {
    /// Values as the runs gave them, coarsest first; NaN where a run lacks the result, shape (levels) \[unit of the result\].
    pub values: Vec<f64>,
    /// Values as they are compared: what is largest in magnitude is given the sign of the limit, shape (levels) \[unit of the result\].
    pub(super) compared: Vec<f64>,
    /// Order, limit and uncertainty.
    pub found: Extrapolation,
    /// What it means, in plain words.
    pub words: String,
    /// Why there can be no limit, where that is known.
    pub no_limit: bool,
}

/// A result and what it converges to.
#[derive(Clone, Debug, PartialEq)]
pub struct Converged {
    /// Path in the summary.
    pub path: String,
    /// SI unit.
    pub unit: String,
    /// Value under the given settings.
    pub value: f64,
    /// Limit in step, mesh and fibres together, from `together`; NaN where there is none.
    pub limit: f64,
    /// Its uncertainty; more than nine of ten limits lie within it, see [`Extrapolation::uncertainty`].
    pub uncertainty: f64,
    /// On finer steps.
    pub step: Sequence,
    /// On finer meshes.
    pub mesh: Sequence,
    /// On more fibres, where sections yield.
    pub fibres: Sequence,
    /// With all of them refined at once, which leaves no term out that mixes them.
    pub together: Sequence,
}

/// Why there is no answer.
#[derive(Debug)]
pub enum ConvergeError {
    /// The scenario, or a path.
    Faults(Diagnostics),
    /// What was asked for cannot be done.
    Refused(String),
    /// A run did not reach its end: as what, and why.
    Run(AnalysisCode, String),
    /// Somebody asked to stop.
    Interrupted,
}

impl From<Diagnostics> for ConvergeError {
    fn from(faults: Diagnostics) -> Self {
        Self::Faults(faults)
    }
}

impl Sequence {
    /// Values as they are compared, coarsest first: what is largest in magnitude has the sign of the limit, shape (levels)
    /// \[unit of the result\].
    pub fn compared(&self) -> &[f64] {
        &self.compared
    }
}

impl Converged {
    /// Why there is no limit, in words.
    pub(super) fn unknown(&self) -> &str {
        let alone = [&self.step, &self.mesh, &self.fibres];
        let reason = alone.iter().find(|one| one.no_limit || one.found.limit.is_nan());
        reason.map_or(&self.together.words, |one| &one.words)
    }
}
