//! `percuss sweep --scheduler`: the Python package speaks with Dask.

use std::env;
use std::ffi::OsString;
use std::path::Path;
use std::process::{Child, Command, ExitStatus};
use std::thread;
use std::time::Duration;

use percuss_codes::RequestCode;
use percuss_scenario::FileAccess;
use percuss_study::{Folder, Study};

use crate::interrupt;
use crate::outcome::{Failure, Status};

/// Names another interpreter than `python3`.
const INTERPRETER: &str = "PERCUSS_PYTHON";
/// Python looks for modules in the working directory first, where someone else's files may lie: not here. (`-P` does the same, from
/// Python 3.11 on.)
const AWAY: &str = "import sys; sys.path[:] = [p for p in sys.path if p not in ('', '.')]\n";
/// How often a sweep is looked at.
const POLL: Duration = Duration::from_millis(20);
/// What such a sweep needs.
const PROBE: &str = "import percuss, distributed";
/// `python3 -m percuss`, which takes the arguments that follow.
const MODULE: &str =
    "import runpy; runpy.run_module('percuss', run_name='__main__', alter_sys=True)";

/// Runs a study, or what is left of it, on a Dask cluster: `python3 -m percuss sweep`.
///
/// # Errors
/// Python is not there, or not what it needs.
pub fn sweep(study: &Path, scheduler: &str, out: &Path, quiet: bool) -> Result<Status, Failure> {
    let python = env::var_os(INTERPRETER).unwrap_or_else(|| OsString::from("python3"));
    let name = python.to_string_lossy().into_owned();
    probe(&python, &name)?;
    let mut command = python_away(&python, MODULE);
    command.arg("sweep").arg(study);
    command.args(["--scheduler", scheduler]).arg("--out").arg(out);
    if quiet {
        command.arg("--quiet");
    }
    if crate::scenario::access() == FileAccess::Anywhere {
        command.arg("--allow-outside");
    }
    let ended = wait(command).map_err(|error| missing(&name, &error.to_string()))?;
    Ok(match ended.code() {
        Some(0) => {
            refuse_missing(study, out)?;
            Status::Done
        }
        Some(2) => Status::Input,
        Some(130) | None => Status::Interrupted,
        Some(_) => Status::System,
    })
}

/// How a command ends; a signal that asks this process to end is handed on to it.
fn wait(mut command: Command) -> std::io::Result<ExitStatus> {
    interrupt::end_between_steps();
    let mut child = command.spawn()?;
    let mut announced = false;
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(status);
        }
        if interrupt::requested() && !announced {
            announced = true;
            end(&mut child)?;
        }
        thread::sleep(POLL);
    }
}

#[cfg(unix)]
fn end(child: &mut Child) -> std::io::Result<()> {
    use rustix::process::{Pid, Signal, kill_process};
    Ok(kill_process(Pid::from_child(child), Signal::INT)?)
}

#[cfg(not(unix))]
fn end(child: &mut Child) -> std::io::Result<()> {
    child.kill()
}

/// Python with a program, which finds no modules in the working directory, nor do the processes it starts.
fn python_away(python: &OsString, program: &str) -> Command {
    let mut command = Command::new(python);
    command.env("PYTHONSAFEPATH", "1").arg("-c").arg(format!("{AWAY}{program}"));
    command
}

/// What ended as if it were done has left a whole table, where that can be looked at.
fn refuse_missing(study: &Path, out: &Path) -> Result<(), Failure> {
    if out.to_string_lossy().contains("://") {
        return Ok(());
    }
    let study = Study::load_with(study, crate::scenario::access())?;
    let table = Folder::open(out, &study).and_then(|folder| folder.results(&study));
    match table {
        Ok(_) => Ok(()),
        Err(error) => {
            let text = format!("the sweep on the cluster ended without results: {error}");
            Err(Failure::System(RequestCode::ClusterFailed.into(), text))
        }
    }
}

/// Whether Python has what it takes.
fn probe(python: &OsString, name: &str) -> Result<(), Failure> {
    let tried = python_away(python, PROBE).output();
    let tried = tried.map_err(|error| missing(name, &error.to_string()))?;
    if tried.status.success() {
        return Ok(());
    }
    let said =
        String::from_utf8_lossy(&tried.stderr).trim().lines().last().unwrap_or_default().to_owned();
    Err(missing(name, &said))
}

fn missing(name: &str, why: &str) -> Failure {
    Failure::input(
        RequestCode::Cluster,
        format!(
            "a sweep on a cluster needs Python with percuss and Dask, and `{name}` has not both: {why}; \
         `pip install \".[dask]\"` in the sources of percuss installs them, {INTERPRETER} names another interpreter"
        ),
    )
}
