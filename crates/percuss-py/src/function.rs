//! A study as a function, for Python.

use percuss_study::{Jacobian, Means, Study};
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

/// What goes into a study as a function, and what comes out.
///
/// Parameters
/// ----------
/// study : Study
///     The study.
///
/// Returns
/// -------
/// tuple
///     Parameters (name, unit, path), their bounds or None, their medians, and results (name, unit, path).
///
/// Raises
/// ------
/// InputError
///     If something else than a number varies.
///
/// Examples
/// --------
/// >>> study = percuss.function("speed.toml").study
/// >>> percuss._percuss.function_layout(study)[0]
/// [('speed', 'm/s', 'projectile.bag.velocity[1]')]
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

/// Results at points.
///
/// Parameters
/// ----------
/// study : Study
///     The study.
/// points : list of list of float
///     Points, in SI units.
///
/// Returns
/// -------
/// tuple
///     n_point * n_result numbers, point after point, and (point, why) of those that have none.
///
/// Examples
/// --------
/// >>> study = percuss.function("speed.toml").study
/// >>> values, failures = percuss._percuss.function_values(study, [[-5.0], [-1.0]])
/// >>> values.round()[::3], failures
/// (array([2561.,  512.]), [])
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

/// Results, derivatives, how these were found, and why there are none.
type Found<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>, String, Option<String>);

/// Results at a point and their derivatives, or why there are none.
///
/// Parameters
/// ----------
/// study : Study
///     The study.
/// point : list of float
///     The point, in SI units.
///
/// Returns
/// -------
/// tuple
///     Results, n_result * n_parameter derivatives row by row, "exact" or "differences: " and why, and None; or what is missing and why.
///
/// Examples
/// --------
/// >>> study = percuss.function("speed-and-mass.toml").study
/// >>> values, slopes, means, why = percuss._percuss.function_jacobian(study, [20.0, 500.0, 2e9])
/// >>> len(values), len(slopes), means, why
/// (3, 9, 'exact', None)
#[pyfunction]
pub fn function_jacobian<'py>(
    py: Python<'py>,
    study: &Bound<'py, crate::study::Study>,
    point: Vec<f64>,
) -> PyResult<Found<'py>> {
    let study: &Study = study.get().inner();
    let found = py.detach(|| {
        let mut function = study.function().map_err(|error| study_error(&error))?;
        Ok::<_, PyErr>(function.jacobian(&point))
    })?;
    let (found, why) = match found {
        Ok(found) => (found, None),
        Err(why) => (
            Jacobian { values: Vec::new(), derivatives: Vec::new(), means: Means::Exact },
            Some(why),
        ),
    };
    let derivatives = found.derivatives.into_iter().flatten().collect::<Vec<f64>>();
    let means = found.means.to_string();
    Ok((array(py, found.values).into_any(), array(py, derivatives).into_any(), means, why))
}
