//! Faults of the core as exceptions of the package.

use percuss::AnalysisCode;
use percuss_codes::{Code, FileCode, RequestCode};
use percuss_scenario::Diagnostics;
use percuss_study::SensitivityError;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

/// Columns of an excerpt of a file.
const EXCERPT_WIDTH: usize = 100;

/// Why work has no result: what another thread tells, which makes no exceptions.
#[derive(Debug)]
pub enum Refusal {
    /// The scenario has faults.
    Faults(Diagnostics),
    /// An analysis found nothing.
    Analysis(AnalysisCode, String),
    /// A request cannot be met.
    Request(RequestCode, String),
    /// Files of results.
    Output(percuss_output::Error),
    /// Files of a study.
    Study(percuss_study::Error),
    /// What receives the rows of a run failed.
    Recorder(AnalysisCode, String),
    /// The system refused.
    System(String),
    /// It was asked to end.
    Stopped,
}

impl Refusal {
    /// The exception for it.
    pub fn exception(self, py: Python<'_>) -> PyErr {
        match self {
            Self::Faults(faults) => scenario_error(py, &faults),
            Self::Analysis(code, text) => analysis_error(code, &text),
            Self::Request(code, text) => coded("InputError", code.into(), &text),
            Self::Output(error) => output_error(&error),
            Self::Study(error) => study_error(&error),
            Self::Recorder(code, text) => coded("FileError", code.into(), &text),
            Self::System(text) => coded("FileError", FileCode::System.into(), &text),
            Self::Stopped => PyKeyboardInterrupt::new_err(()),
        }
    }
}

impl From<Diagnostics> for Refusal {
    fn from(faults: Diagnostics) -> Self {
        Self::Faults(faults)
    }
}

impl From<percuss_output::Error> for Refusal {
    fn from(error: percuss_output::Error) -> Self {
        Self::Output(error)
    }
}

impl From<SensitivityError> for Refusal {
    fn from(error: SensitivityError) -> Self {
        match error {
            SensitivityError::Faults(faults) => Self::Faults(faults),
            SensitivityError::Refused(reason) => Self::Analysis(AnalysisCode::NoDerivative, reason),
            SensitivityError::Run(code, reason) => Self::Analysis(code, reason),
        }
    }
}

impl From<percuss_study::Error> for Refusal {
    fn from(error: percuss_study::Error) -> Self {
        Self::Study(error)
    }
}

impl From<percuss::Error> for Refusal {
    fn from(error: percuss::Error) -> Self {
        Self::Analysis(error.code(), error.to_string())
    }
}

/// `percuss.ScenarioError` with every fault in it.
fn scenario_error(py: Python<'_>, diagnostics: &Diagnostics) -> PyErr {
    of_scenario(py, "ScenarioError", diagnostics)
}

/// `percuss.PathError` with every path that leads nowhere.
pub fn path_error(py: Python<'_>, diagnostics: &Diagnostics) -> PyErr {
    of_scenario(py, "PathError", diagnostics)
}

fn of_scenario(py: Python<'_>, kind: &str, diagnostics: &Diagnostics) -> PyErr {
    let faults: Vec<_> = diagnostics
        .all()
        .iter()
        .map(|d| {
            let place = |number: usize| (number > 0).then_some(number);
            (&d.message, &d.help, &d.path, place(d.line), place(d.column), d.code.code())
        })
        .collect();
    let made = py.import("percuss._errors").and_then(|module| {
        let excerpt = diagnostics.fancy(false, EXCERPT_WIDTH);
        module.getattr(kind)?.call1((diagnostics.coded(), faults, excerpt))
    });
    made.map_or_else(|error| error, PyErr::from_value)
}

/// `percuss.AnalysisError`: an analysis without a result.
pub fn analysis_error(code: AnalysisCode, text: &str) -> PyErr {
    coded("AnalysisError", code.into(), text)
}

/// What the results' files met: `percuss.InputError` or `percuss.FileError`.
pub fn output_error(error: &percuss_output::Error) -> PyErr {
    let kind = kind(error.is_refused() || error.is_content());
    coded(kind, error.code().into(), &error.to_string())
}

/// What the files of a study met.
pub fn study_error(error: &percuss_study::Error) -> PyErr {
    coded(kind(error.is_unfit()), error.code(), &error.to_string())
}

/// Runs of a study are missing.
pub fn incomplete(text: &str) -> PyErr {
    coded("StudyError", RequestCode::MissingShard.into(), text)
}

fn kind(input: bool) -> &'static str {
    if input { "InputError" } else { "FileError" }
}

/// An exception of the package by its name, with its code.
fn coded(kind: &str, code: Code, text: &str) -> PyErr {
    Python::attach(|py| {
        let made = py.import("percuss._errors").and_then(|module| {
            module.getattr("coded")?.call1((module.getattr(kind)?, text, code.code))
        });
        made.map_or_else(|error| error, PyErr::from_value)
    })
}
