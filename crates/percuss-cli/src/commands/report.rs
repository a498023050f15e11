//! `percuss report`.

use std::path::Path;

use percuss_output::report::{ReportData, write};

use crate::arguments::Report;
use crate::outcome::{Failure, Status};
use crate::terminal;

/// Rebuilds the report of a finished run.
pub fn run(arguments: &Report) -> Result<Status, Failure> {
    let dir = &arguments.dir;
    refuse_what_is_no_run(dir)?;
    write(dir, &ReportData::read(dir)?)?;
    terminal::tell(&format!("{} and figures/ rebuilt", dir.join("report.html").display()));
    Ok(Status::Done)
}

fn refuse_what_is_no_run(dir: &Path) -> Result<(), Failure> {
    let what = if !dir.exists() {
        "no such directory"
    } else if !dir.is_dir() {
        "not a directory"
    } else if !dir.join("summary.json").is_file() {
        "not the directory of a run (it has no summary.json)"
    } else {
        return Ok(());
    };
    let expected = "give the directory that `percuss run` has written";
    Err(Failure::Input(format!("{}: {what}; {expected}", dir.display())))
}
