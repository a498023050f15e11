//! Natural modes and static equilibrium for Python.

use percuss::{
    AnalysisCode, Start, buckling_in_contact, equilibrium, equilibrium_path, modes_about,
    modes_about_equilibrium, reference_state,
};
use percuss_output::{ModesInfo, equilibrium_value, modes_value, path_value};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::analysis_error;
use crate::ready::Source;
use crate::structure::{beams, shaped};

/// The lowest natural modes.
///
/// Parameters
/// ----------
/// source : tuple
///     What `Scenario._source` gives: text, name, changes, functions, whether files may lie outside.
/// count : int
///     How many.
/// about : {"reference", "static"} or None
///     Of which configuration; None for the one that the scenario starts from.
///
/// Returns
/// -------
/// dict
///     `summary` (JSON), `displacement` (n_node, 4) [m, 1], `shapes` (n_mode, n_node, 4) [kg^(-1/2)], `beams`.
///
/// Examples
/// --------
/// >>> percuss._percuss.modes(percuss.load("plank.toml")._source(), 2, None)["shapes"].shape
/// (2, 9, 4)
#[pyfunction]
#[pyo3(signature = (source, count, about))]
pub fn modes<'py>(
    py: Python<'py>,
    source: Source,
    count: usize,
    about: Option<&str>,
) -> PyResult<Bound<'py, PyDict>> {
    let ready = source.ready(py)?;
    let (compiled, model) = (&ready.compiled, &ready.compiled.model);
    let loaded = about.map_or(compiled.settings.start == Start::Static, |word| word == "static");
    let (modes, state) = if loaded {
        ready.refuse_mechanism(py)?;
        let found = py.detach(|| {
            equilibrium(model).map(|e| (modes_about_equilibrium(model, &e, count), e.state))
        });
        found.map_err(|error| analysis_error(error.code(), &error.to_string()))?
    } else {
        let state = reference_state(model).map_err(|faults| ready.refuse(py, faults))?;
        (py.detach(|| modes_about(model, &state, count)), state)
    };
    source.raised().map_or(Ok(()), Err)?;
    if modes.is_empty() {
        let text = "no modes: nothing has mass, or the tangent is singular";
        return Err(analysis_error(AnalysisCode::NoModes, text));
    }
    let info = ModesInfo {
        title: &compiled.title,
        about: if loaded { "static" } else { "reference" },
        model,
        displacement: &state.displacement,
        modes: &modes,
    };
    let result = PyDict::new(py);
    result.set_item("summary", modes_value(&info).to_string())?;
    let displacement = state.displacement.as_flattened().to_vec();
    result.set_item("displacement", shaped(py, displacement, &[state.displacement.len(), 4])?)?;
    let nodes = modes[0].shape.len();
    let shapes = modes.iter().flat_map(|mode| mode.shape.as_flattened()).copied().collect();
    result.set_item("shapes", shaped(py, shapes, &[modes.len(), nodes, 4])?)?;
    result.set_item("beams", beams(py, model)?)?;
    Ok(result)
}

/// Static equilibrium, or the path to it by arc length.
///
/// Parameters
/// ----------
/// source : tuple
///     What `Scenario._source` gives.
/// path : bool
///     Whether to follow the path.
///
/// Returns
/// -------
/// dict
///     `summary` (JSON), `displacement` (n_node, 4) [m, 1], `beams`.
///
/// Examples
/// --------
/// >>> percuss._percuss.static(percuss.load("plank.toml")._source(), False)["displacement"].shape
/// (10, 4)
#[pyfunction]
#[pyo3(name = "static", signature = (source, path))]
pub fn statics<'py>(py: Python<'py>, source: Source, path: bool) -> PyResult<Bound<'py, PyDict>> {
    let ready = source.ready(py)?;
    ready.refuse_mechanism(py)?;
    let model = &ready.compiled.model;
    let solved = py.detach(|| {
        if !path {
            let found = equilibrium(model)?;
            let value = equilibrium_value(model, &found, &buckling_in_contact(model, &found, 1));
            return Ok((value, found.state));
        }
        let followed = equilibrium_path(model, &ready.compiled.path)?;
        let mut value =
            equilibrium_value(model, &followed.end, &buckling_in_contact(model, &followed.end, 1));
        value["path"] = path_value(&followed);
        Ok((value, followed.end.state))
    });
    source.raised().map_or(Ok(()), Err)?;
    let raised = |error: percuss::Error| analysis_error(error.code(), &error.to_string());
    let (value, state) = solved.map_err(raised)?;
    let result = PyDict::new(py);
    result.set_item("summary", value.to_string())?;
    let displacement = state.displacement.as_flattened().to_vec();
    result.set_item("displacement", shaped(py, displacement, &[state.displacement.len(), 4])?)?;
    result.set_item("beams", beams(py, model)?)?;
    Ok(result)
}
