//! Runs of a study that are kept whole: run once more, alone, with all that a run leaves.

use std::path::Path;

use percuss_codes::RequestCode;
use percuss_study::{KEPT, Study};

use crate::commands::run;
use crate::outcome::{Failure, Status};
use crate::replacing;
use crate::run_arguments::{History, Run};

/// Runs that the study does not have.
pub fn refuse_missing(study: &Study, runs: &[u64]) -> Result<(), Failure> {
    let count = study.run_count();
    match runs.iter().find(|run| **run >= count) {
        None => Ok(()),
        Some(run) => Err(Failure::input(
            RequestCode::NoSuchRun,
            format!("--keep-run {run}: the study has runs 0 to {}", count.saturating_sub(1)),
        )),
    }
}

/// Runs them, each into a directory of its own, beside the scenario it follows from.
pub fn keep(study: &Study, out: &Path, runs: &[u64]) -> Result<Status, Failure> {
    let place = out.join(KEPT);
    let mut worst = Status::Done;
    for run in runs {
        let text = study.scenario_of(*run).map_err(|reason| {
            Failure::input(RequestCode::NoScenario, format!("run {run} has no scenario: {reason}"))
        })?;
        std::fs::create_dir_all(&place).map_err(|e| Failure::system(&place, "create", &e))?;
        let file = place.join(format!("run-{run}.toml"));
        replacing::put(&file, text.as_bytes(), &|_| true)?;
        let arguments = Run {
            file,
            out: Some(place.join(format!("run-{run}"))),
            set: Vec::new(),
            strict: false,
            json: false,
            history: History::Parquet,
            no_report: false,
            figures: false,
            open: false,
            checkpoint: None,
            resume: false,
            deny: Vec::new(),
            quiet: true,
        };
        match run::run(&arguments)? {
            Status::Done => {}
            Status::Interrupted => return Ok(Status::Interrupted),
            other => worst = other,
        }
    }
    Ok(worst)
}
