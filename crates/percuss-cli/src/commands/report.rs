//! `percuss report`.

use std::path::Path;

use percuss_output::RunUpdate;
use percuss_output::report::{ReportData, write, write_with_figures};

use crate::arguments::Report;
use crate::outcome::{Failure, Status};
use crate::terminal;

/// Rebuilds the report of a finished run.
pub fn run(arguments: &Report) -> Result<Status, Failure> {
    let dir = &arguments.dir;
    refuse_what_is_no_run(dir)?;
    let (data, page) = (ReportData::read(dir)?, dir.join("report.html"));
    let update = RunUpdate::open(dir)?;
    if arguments.figures {
        write_with_figures(update.path(), &data)?;
        update.commit()?;
        terminal::tell(&format!("{} and figures/ rebuilt", page.display()));
    } else {
        write(update.path(), &data)?;
        update.commit()?;
        terminal::tell(&format!("{} rebuilt", page.display()));
    }
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
