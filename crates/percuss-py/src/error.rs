//! Faults of the core as exceptions of the package.

use percuss::AnalysisCode;
use percuss_codes::{Code, FileCode, RequestCode};
use percuss_scenario::Diagnostics;
use pyo3::prelude::*;

/// Columns of an excerpt of a file.
const EXCERPT_WIDTH: usize = 100;

/// `percuss.ScenarioError` with every fault in it.
pub fn scenario_error(py: Python<'_>, diagnostics: &Diagnostics) -> PyErr {
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

/// The system refused.
pub fn system_error(text: &str) -> PyErr {
    coded("FileError", FileCode::System.into(), text)
}

/// What receives the rows of a run failed.
pub fn recorder_error(error: &percuss::Error) -> PyErr {
    coded("FileError", error.code().into(), &error.to_string())
}

/// A request that cannot be met.
pub fn request_error(code: RequestCode, text: &str) -> PyErr {
    coded("InputError", code.into(), text)
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
