//! The `percuss` command, for the wheel to bring along.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Does what a command line asks for.
///
/// Parameters
/// ----------
/// line : list of str
///     Its words, the first of them the name of the program.
///
/// Returns
/// -------
/// int
///     Its exit status.
///
/// Examples
/// --------
/// >>> percuss._percuss.command(["percuss", "check", "plank.toml"])
/// 0
#[pyfunction]
pub fn command(py: Python<'_>, line: Vec<OsString>) -> u8 {
    // From here on signals are the command's, as in a process of its own.
    py.detach(|| percuss_cli::command(line))
}
