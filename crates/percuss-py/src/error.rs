//! Faults of the core as exceptions of the package.

use percuss_scenario::Diagnostics;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;

/// `percuss.ScenarioError` with every fault in it.
pub fn scenario_error(py: Python<'_>, diagnostics: &Diagnostics) -> PyErr {
    let faults: Vec<_> = diagnostics
        .all()
        .iter()
        .map(|d| {
            let place = |number: usize| (number > 0).then_some(number);
            (&d.message, &d.help, &d.path, place(d.line), place(d.column))
        })
        .collect();
    let made = py.import("percuss._errors").and_then(|module| {
        module.getattr("ScenarioError")?.call1((diagnostics.to_string(), faults))
    });
    made.map_or_else(|error| error, PyErr::from_value)
}

/// `percuss.AnalysisError`: the solver gave up.
pub fn analysis_error(py: Python<'_>, text: String) -> PyErr {
    let made = py
        .import("percuss._errors")
        .and_then(|module| module.getattr("AnalysisError")?.call1((text,)));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// What the results' files met.
pub fn output_error(error: &percuss_output::Error) -> PyErr {
    let text = error.to_string();
    if error.is_refused() || error.is_content() {
        PyValueError::new_err(text)
    } else {
        PyOSError::new_err(text)
    }
}
