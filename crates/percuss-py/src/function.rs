//! A study as a function, for Python.

use percuss_study::{Jacobian, Study};
use pyo3::prelude::*;

use crate::error::study_error;
use crate::structure::array;

/// What goes in, or comes out: (name, unit, path).
type Named = (String, String, String);

/// Rows of numbers and, for those that have none, why.
type Rows<'py> = (Bound<'py, PyAny>, Vec<(usize, String)>);

/// A number's smallest and largest value, or None where it has no bounds.
type Bounds = Option<(f64, f64)>;

/// Parameters, their bounds, their medians, and results.
type Layout = (Vec<Named>, Vec<Bounds>, Vec<f64>, Vec<Named>);

/// Parameters with their bounds and medians, and results.
#[pyfunction]
pub fn function_layout(study: &Bound<'_, crate::study::Study>) -> PyResult<Layout> {
    let study = study.get().inner();
    let function = study.function().map_err(|error| study_error(&error))?;
    let parameters = function.parameters();
    let inputs = parameters
        .iter()
        .map(|p| (p.name.clone(), p.unit.clone(), p.field.path().to_string()))
        .collect();
    let bounds = parameters.iter().map(|p| p.variation.bounds()).collect();
    let results = function.results().iter();
    let outputs = results
        .map(|r| (r.name.clone(), r.path.unit().to_string(), r.path.path().to_string()))
        .collect();
    Ok((inputs, bounds, function.middle(), outputs))
}

/// Results at points, one after the other as (n_point * n_result) numbers, and (point, why) of those that have none.
#[pyfunction]
pub fn function_values<'py>(
    py: Python<'py>,
    study: &Bound<'py, crate::study::Study>,
    points: Vec<Vec<f64>>,
) -> PyResult<Rows<'py>> {
    let study: &Study = study.get().inner();
    let (numbers, failures) = py.detach(|| -> PyResult<_> {
        let mut function = study.function().map_err(|error| study_error(&error))?;
        let (mut numbers, mut failures) = (Vec::new(), Vec::new());
        for (first, group) in points.chunks(GROUP).enumerate() {
            Python::attach(|py| py.check_signals())?;
            for (k, row) in function.values(group).into_iter().enumerate() {
                match row {
                    Ok(row) => numbers.extend(row),
                    Err(why) => {
                        failures.push((first * GROUP + k, why));
                        numbers.extend(study.results().iter().map(|_| f64::NAN));
                    }
                }
            }
        }
        Ok((numbers, failures))
    })?;
    Ok((array(py, numbers).into_any(), failures))
}

/// Python is asked for signals after so many points.
const GROUP: usize = 64;

/// Results at a point, derivatives as (n_result * n_parameter) numbers row by row, and nothing more; or why there are none.
#[pyfunction]
pub fn function_jacobian<'py>(
    py: Python<'py>,
    study: &Bound<'py, crate::study::Study>,
    point: Vec<f64>,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>, Option<String>)> {
    let study: &Study = study.get().inner();
    let found = py.detach(|| {
        let mut function = study.function().map_err(|error| study_error(&error))?;
        Ok::<_, PyErr>(function.jacobian(&point))
    })?;
    let (found, why) = match found {
        Ok(found) => (found, None),
        Err(why) => (Jacobian { values: Vec::new(), derivatives: Vec::new() }, Some(why)),
    };
    let derivatives = found.derivatives.into_iter().flatten().collect::<Vec<f64>>();
    Ok((array(py, found.values).into_any(), array(py, derivatives).into_any(), why))
}
