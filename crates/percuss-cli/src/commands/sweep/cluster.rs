//! `percuss sweep --scheduler`: the Python package speaks with Dask.

use std::env;
use std::ffi::OsString;
use std::path::Path;
use std::process::Command;

use crate::outcome::{Failure, Status};

/// Names another interpreter than `python3`.
const INTERPRETER: &str = "PERCUSS_PYTHON";
/// What such a sweep needs.
const PROBE: &str = "import percuss, distributed";

/// Runs a study, or what is left of it, on a Dask cluster: `python3 -m percuss sweep`.
///
/// # Errors
/// Python is not there, or not what it needs.
pub fn sweep(study: &Path, scheduler: &str, out: &Path, quiet: bool) -> Result<Status, Failure> {
    let python = env::var_os(INTERPRETER).unwrap_or_else(|| OsString::from("python3"));
    let name = python.to_string_lossy().into_owned();
    probe(&python, &name)?;
    let mut command = Command::new(&python);
    command.args(["-m", "percuss", "sweep"]).arg(study);
    command.args(["--scheduler", scheduler]).arg("--out").arg(out);
    if quiet {
        command.arg("--quiet");
    }
    let ended = command.status().map_err(|error| missing(&name, &error.to_string()))?;
    Ok(match ended.code() {
        Some(0) => Status::Done,
        Some(2) => Status::Input,
        Some(130) | None => Status::Interrupted,
        Some(_) => Status::System,
    })
}

/// Whether Python has what it takes.
fn probe(python: &OsString, name: &str) -> Result<(), Failure> {
    let tried = Command::new(python).args(["-c", PROBE]).output();
    let tried = tried.map_err(|error| missing(name, &error.to_string()))?;
    if tried.status.success() {
        return Ok(());
    }
    let said =
        String::from_utf8_lossy(&tried.stderr).trim().lines().last().unwrap_or_default().to_owned();
    Err(missing(name, &said))
}

fn missing(name: &str, why: &str) -> Failure {
    Failure::Input(format!(
        "a sweep on a cluster needs Python with percuss and Dask, and `{name}` has not both: {why}; \
         `pip install \".[dask]\"` in the sources of percuss installs them, {INTERPRETER} names another interpreter"
    ))
}
