//! A finished run, read from its directory.

use std::path::{Path, PathBuf};

use percuss_output::{fields, read_history, read_summary};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::error::Refusal;
use crate::fields::to_python;
use crate::structure::array;
use crate::watch::Watch;

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
    let read = Watch::default().run(py, move |_| {
        let whole =
            (read_summary(&directory)?, read_history(&directory)?, fields::read(&directory)?);
        Ok((whole, scenario_in(&directory)?))
    })?;
    let ((summary, history, fields), scenario) =
        read.map_err(|refusal: Refusal| refusal.exception(py))?;
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

/// The scenario of a run, if it is there.
fn scenario_in(directory: &Path) -> Result<String, Refusal> {
    let path = directory.join("scenario.toml");
    if !path.is_file() {
        return Ok(String::new());
    }
    let refused = |error| Refusal::System(format!("{}: cannot read: {error}", path.display()));
    std::fs::read_to_string(&path).map_err(refused)
}
