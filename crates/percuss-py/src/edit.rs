//! Changes to the text of a scenario, its comments and the order of its lines kept.

use percuss_scenario::{Adds, apply_changes, known_steps, remove_value};
use pyo3::prelude::*;

use crate::error::path_error;

/// The text with values; tables on the way are made where they are missing.
///
/// Parameters
/// ----------
/// text : str
///     TOML.
/// name : str
///     Name of the scenario in messages.
/// changes : list of (str, str)
///     Paths and values in TOML; a table takes the place of the whole table before.
///
/// Returns
/// -------
/// str
///     TOML with all comments.
///
/// Raises
/// ------
/// PathError
///     If no scenario can have a value at a path, or a list has no such entry: all of them.
///
/// Examples
/// --------
/// >>> print(percuss._percuss.set("", "scenario", [("time.end", "0.1")]))
/// [time]
/// end = 0.1
#[pyfunction]
pub fn set(
    py: Python<'_>,
    text: &str,
    name: &str,
    changes: Vec<(String, String)>,
) -> PyResult<String> {
    let changed = apply_changes(text, [name, name], &changes, Adds::Named);
    changed.map_err(|faults| path_error(py, &faults))
}

/// The text without what stands at a path.
///
/// Parameters
/// ----------
/// text : str
///     TOML.
/// name : str
///     Name of the scenario in messages.
/// path : str
///     Path of a value or a table.
///
/// Returns
/// -------
/// str
///     TOML with all other comments.
///
/// Raises
/// ------
/// PathError
///     If nothing stands there.
///
/// Examples
/// --------
/// >>> percuss._percuss.remove('title = "a"', "scenario", "title")
/// ''
#[pyfunction]
pub fn remove(py: Python<'_>, text: &str, name: &str, path: &str) -> PyResult<String> {
    remove_value(text, name, path).map_err(|faults| path_error(py, &faults))
}

/// The names, keys and indices of a path.
///
/// Parameters
/// ----------
/// path : str
///     A path that a scenario can have.
/// name : str
///     Name of the scenario in messages.
/// text : str, optional
///     TOML in which something has to stand there.
///
/// Returns
/// -------
/// list of str
///     Its steps.
///
/// Raises
/// ------
/// PathError
///     If no scenario can have such a path, or nothing stands there.
///
/// Examples
/// --------
/// >>> percuss._percuss.steps("projectile.bag.velocity[1]", "scenario")
/// ['projectile', 'bag', 'velocity', '1']
#[pyfunction]
#[pyo3(signature = (path, name, text=None))]
pub fn steps(py: Python<'_>, path: &str, name: &str, text: Option<&str>) -> PyResult<Vec<String>> {
    known_steps(path, name, text).map_err(|faults| path_error(py, &faults))
}
