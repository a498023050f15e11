//! Natural modes and static equilibrium for Python.

use percuss::{
    AnalysisCode, Start, buckling_in_contact, equilibrium, equilibrium_path, modes_about,
    modes_about_equilibrium, reference_state,
};
use percuss_output::{ModesInfo, equilibrium_value, modes_value, path_value};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::Refusal;
use crate::ready::Source;
use crate::structure::{Beams, shaped};

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
    let static_wanted = about.map(|word| word == "static");
    let (summary, displacement, shapes, beams) = source.attend(py, move |ready, _| {
        let (compiled, model) = (&ready.compiled, &ready.compiled.model);
        let loaded = static_wanted.unwrap_or(compiled.settings.start == Start::Static);
        let (modes, state) = if loaded {
            ready.refuse_mechanism()?;
            let found = equilibrium(model)?;
            (modes_about_equilibrium(model, &found, count), found.state)
        } else {
            let state = reference_state(model).map_err(|faults| ready.refuse(faults))?;
            (modes_about(model, &state, count), state)
        };
        if modes.is_empty() {
            let text = "no modes: nothing has mass, or the tangent is singular";
            return Err(Refusal::Analysis(AnalysisCode::NoModes, text.to_owned()));
        }
        let info = ModesInfo {
            title: &compiled.title,
            about: if loaded { "static" } else { "reference" },
            model,
            displacement: &state.displacement,
            modes: &modes,
        };
        let summary = modes_value(&info).to_string();
        let shapes: Vec<Nodes> = modes.into_iter().map(|mode| mode.shape).collect();
        Ok((summary, state.displacement, shapes, Beams::of(model)))
    })?;
    let result = PyDict::new(py);
    result.set_item("summary", summary)?;
    result.set_item("displacement", nodes(py, &displacement)?)?;
    let sizes = [shapes.len(), shapes[0].len(), 4];
    let shapes = shapes.iter().flat_map(|shape| shape.as_flattened()).copied().collect();
    result.set_item("shapes", shaped(py, shapes, &sizes)?)?;
    result.set_item("beams", beams.into_python(py)?)?;
    Ok(result)
}

/// Displacements and slopes of nodes, shape (nodes, 4) \[m, -\].
type Nodes = Vec<[f64; 4]>;

/// The same as an array.
fn nodes<'py>(py: Python<'py>, of: &[[f64; 4]]) -> PyResult<Bound<'py, PyAny>> {
    shaped(py, of.as_flattened().to_vec(), &[of.len(), 4])
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
///     `summary` (JSON), `displacement` (n_node, 4) [m, 1], `beams`, `warnings` (contact, topic, text, code).
///
/// Examples
/// --------
/// >>> percuss._percuss.static(percuss.load("plank.toml")._source(), False)["displacement"].shape
/// (10, 4)
#[pyfunction]
#[pyo3(name = "static", signature = (source, path))]
pub fn statics<'py>(py: Python<'py>, source: Source, path: bool) -> PyResult<Bound<'py, PyDict>> {
    let (summary, displacement, beams, warnings) = source.attend(py, move |ready, _| {
        ready.refuse_mechanism()?;
        let model = &ready.compiled.model;
        let (value, end) = if path {
            let followed = equilibrium_path(model, &ready.compiled.path)?;
            let buckling = buckling_in_contact(model, &followed.end, 1);
            let mut value = equilibrium_value(model, &followed.end, &buckling);
            value["path"] = path_value(&followed);
            (value, followed.end)
        } else {
            let found = equilibrium(model)?;
            let buckling = buckling_in_contact(model, &found, 1);
            (equilibrium_value(model, &found, &buckling), found)
        };
        let warnings = ready.warnings(percuss_advice::at_rest(model, &end));
        Ok((value.to_string(), end.state.displacement, Beams::of(model), warnings))
    })?;
    let result = PyDict::new(py);
    result.set_item("summary", summary)?;
    result.set_item("displacement", nodes(py, &displacement)?)?;
    result.set_item("warnings", warnings)?;
    result.set_item("beams", beams.into_python(py)?)?;
    Ok(result)
}
