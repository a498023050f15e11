//! Derivatives of results for Python.

use percuss::AnalysisCode;
use percuss_study::{Differentiated, SensitivityError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::Refusal;
use crate::ready::Source;
use crate::structure::shaped;

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
        percuss_study::sensitivity(&ready.scenario, &parameters, &results).map_err(
            |why| match why {
                SensitivityError::Faults(faults) => Refusal::Faults(faults),
                SensitivityError::Refused(reason) => {
                    Refusal::Analysis(AnalysisCode::NoDerivative, reason)
                }
                SensitivityError::Run(code, reason) => Refusal::Analysis(code, reason),
            },
        )
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
