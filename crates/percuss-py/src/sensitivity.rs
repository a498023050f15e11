//! Derivatives of results for Python.

use percuss_study::Differentiated;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::ready::Source;
use crate::structure::{array, shaped};

/// Values of parameters and results, and the derivatives.
///
/// Parameters
/// ----------
/// source : tuple
///     What `Scenario._source` gives.
/// parameters : list of str
///     Paths in the scenario.
/// results : list of str
///     Paths in the summary; none for those of its own choice.
///
/// Returns
/// -------
/// dict
///     `parameters` and `results` (lists of path, value, unit), `derivatives` and `uncertainties` (n_result, n_parameter), `one_sided`
///     (sentences), `without` (list of result, parameter, why), `horizon` (time [s] and why, or None).
///
/// Raises
/// ------
/// ScenarioError
///     If the scenario has faults, or a path leads nowhere.
/// AnalysisError
///     If something cannot be differentiated.
///
/// Examples
/// --------
/// >>> source = percuss.load("plank.toml")._source()
/// >>> percuss._percuss.sensitivity(source, ["projectile.bag.mass"], [])["parameters"]
/// [('projectile.bag.mass', 10.0, 'kg')]
#[pyfunction]
pub fn sensitivity<'py>(
    py: Python<'py>,
    source: Source,
    parameters: Vec<String>,
    results: Vec<String>,
) -> PyResult<Bound<'py, PyDict>> {
    let found = source.attend(py, move |ready, _| {
        Ok(percuss_study::sensitivity(&ready.scenario, &parameters, &results)?)
    })?;
    let list = |all: &[Differentiated]| -> Vec<(String, f64, String)> {
        all.iter().map(|x| (x.path.clone(), x.value, x.unit.clone())).collect()
    };
    let result = PyDict::new(py);
    result.set_item("parameters", list(&found.parameters))?;
    result.set_item("results", list(&found.results))?;
    let shape = [found.results.len(), found.parameters.len()];
    let derivatives = found.derivatives.into_iter().flatten().collect();
    result.set_item("derivatives", shaped(py, derivatives, &shape)?)?;
    let uncertainties = found.uncertainties.into_iter().flatten().collect();
    result.set_item("uncertainties", shaped(py, uncertainties, &shape)?)?;
    let texts: Vec<String> = found.one_sided.iter().map(percuss_study::OneSided::text).collect();
    result.set_item("one_sided", texts)?;
    let without: Vec<_> =
        found.without.into_iter().map(|one| (one.result, one.parameter, one.why)).collect();
    result.set_item("without", without)?;
    result.set_item("horizon", found.horizon.map(|h| (h.time, h.why)))?;
    Ok(result)
}

/// Values of columns at times, linear between the rows of the history.
///
/// Parameters
/// ----------
/// source : tuple
///     What `Scenario._source` gives.
/// columns : list of str
///     Names of columns.
/// times : list of float
///     A time for each of them [s].
///
/// Returns
/// -------
/// ndarray
///     The values [units of the columns]; NaN for times outside the run.
///
/// Raises
/// ------
/// ScenarioError
///     If the scenario has faults, or there is no such column.
/// AnalysisError
///     If the run fails.
///
/// Examples
/// --------
/// >>> source = percuss.load("plank.toml")._source()
/// >>> percuss._percuss.column_values(source, ["projectile.bag.velocity_2"], [0.0])
/// array([-5.])
#[pyfunction]
pub fn column_values<'py>(
    py: Python<'py>,
    source: Source,
    columns: Vec<String>,
    times: Vec<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let samples = samples(columns, &times)?;
    let found = source
        .attend(py, move |ready, _| Ok(percuss_study::column_values(&ready.scenario, &samples)?))?;
    Ok(array(py, found).into_any())
}

/// What `column_jacobian` gives: values, derivatives, how they were found, and sentences about one-sided ones.
type ColumnDerivatives<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>, String, Vec<String>);

/// Values of columns at times and their derivatives.
///
/// Parameters
/// ----------
/// source : tuple
///     What `Scenario._source` gives.
/// parameters : list of str
///     Paths in the scenario.
/// columns : list of str
///     Names of columns.
/// times : list of float
///     A time for each of them [s].
/// jobs : int
///     Threads for differences of runs; 0 for one a core.
///
/// Returns
/// -------
/// tuple
///     Values, derivatives (n_value, n_parameter), "exact" or "differences: " and why, and sentences about derivatives that are one-sided.
///
/// Raises
/// ------
/// ScenarioError
///     If the scenario has faults, or there is no such column.
/// AnalysisError
///     If the run fails.
///
/// Examples
/// --------
/// >>> source = percuss.load("plank.toml")._source()
/// >>> by = ["projectile.bag.velocity[1]"]
/// >>> percuss._percuss.column_jacobian(source, by, ["projectile.bag.velocity_2"], [0.0])
/// (array([-5.]), array([[1.]]), 'exact', [])
#[pyfunction]
#[pyo3(signature = (source, parameters, columns, times, jobs = 1))]
pub fn column_jacobian<'py>(
    py: Python<'py>,
    source: Source,
    parameters: Vec<String>,
    columns: Vec<String>,
    times: Vec<f64>,
    jobs: usize,
) -> PyResult<ColumnDerivatives<'py>> {
    let samples = samples(columns, &times)?;
    let shape = [samples.len(), parameters.len()];
    let found = source.attend(py, move |ready, _| {
        Ok(percuss_study::column_jacobian(&ready.scenario, &parameters, &samples, jobs)?)
    })?;
    let derivatives = found.derivatives.into_iter().flatten().collect();
    let notes = found.one_sided.iter().map(percuss_study::OneSided::text).collect();
    let values = array(py, found.values).into_any();
    Ok((values, shaped(py, derivatives, &shape)?.into_any(), found.means.to_string(), notes))
}

/// A column for each time.
fn samples(columns: Vec<String>, times: &[f64]) -> PyResult<Vec<percuss_study::ColumnSample>> {
    if columns.len() != times.len() {
        let text =
            format!("{} columns and {} times: one time a column", columns.len(), times.len());
        return Err(pyo3::exceptions::PyValueError::new_err(text));
    }
    let both = columns.into_iter().zip(times);
    Ok(both.map(|(column, time)| percuss_study::ColumnSample::at(column, *time)).collect())
}

/// Order, limit and uncertainty of a number on finer and finer steps or meshes.
///
/// Parameters
/// ----------
/// values : list of float
///     The number, each time twice as fine.
///
/// Returns
/// -------
/// tuple
///     Observed order [1] or None, limit and its uncertainty, in the unit of the number.
///
/// Examples
/// --------
/// >>> order, limit, uncertainty = percuss._percuss.extrapolated([1.16, 1.04, 1.01])
/// >>> round(order, 3), round(limit, 3)
/// (2.0, 1.0)
#[pyfunction]
pub fn extrapolated(values: Vec<f64>) -> (Option<f64>, f64, f64) {
    let found = percuss_study::extrapolate(&values);
    (found.order, found.limit, found.uncertainty)
}
