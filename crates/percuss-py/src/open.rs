//! A finished run, read from its directory.

use std::path::PathBuf;

use percuss_output::{fields, read_history, read_summary};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::error::output_error;
use crate::fields::to_python;
use crate::structure::array;

/// The same as `run` gives of a run, from what it left in a directory.
///
/// Parameters
/// ----------
/// directory : str or path
///     The directory of the run.
///
/// Returns
/// -------
/// dict
///     As of `run`.
///
/// Raises
/// ------
/// InputError, FileError
///     If its files cannot be read, or are not what they should be.
///
/// Examples
/// --------
/// >>> result = percuss.run("plank.toml", out="plank")
/// >>> percuss._percuss.open("plank")["names"] == list(result.columns)
/// True
#[pyfunction]
pub fn open(py: Python<'_>, directory: PathBuf) -> PyResult<Bound<'_, PyDict>> {
    let read = py.detach(|| -> Result<_, percuss_output::Error> {
        Ok((read_summary(&directory)?, read_history(&directory)?, fields::read(&directory)?))
    });
    let (summary, history, fields) = read.map_err(|error| output_error(&error))?;
    let scenario = directory.join("scenario.toml");
    let scenario =
        if scenario.is_file() { std::fs::read_to_string(scenario)? } else { String::new() };
    let result = PyDict::new(py);
    let channels = &history.channels;
    result.set_item("names", channels.iter().map(|c| c.name.as_str()).collect::<Vec<_>>())?;
    result.set_item("units", channels.iter().map(|c| c.unit.as_str()).collect::<Vec<_>>())?;
    let about: Vec<&str> = channels.iter().map(|c| c.description.as_str()).collect();
    result.set_item("descriptions", about)?;
    let columns = history.columns.into_iter().map(|values| array(py, values));
    result.set_item("columns", PyList::new(py, columns.collect::<Vec<_>>())?)?;
    result.set_item("seconds", summary["wall_seconds"].as_f64())?;
    result.set_item("summary", summary.to_string())?;
    result.set_item("scenario", scenario)?;
    let fields = fields.map(|fields| to_python(py, &fields)).transpose()?;
    result.set_item("fields", fields)?;
    Ok(result)
}
