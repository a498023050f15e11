//! `percuss sweep`.

use std::sync::OnceLock;

use percuss_codes::Caution;
use percuss_study::{Done, Folder, Study, sweep};

use crate::arguments::Sweep;
use crate::interrupt;
use crate::outcome::{Failure, Status};
use crate::progress::Progress;
use crate::{scenario, terminal};

mod cluster;
mod kept;
mod outcome;

/// Runs a study, or what is left of it.
pub fn run(arguments: &Sweep) -> Result<Status, Failure> {
    let study = Study::load_with(&arguments.study, scenario::access())?;
    let out = arguments.out.clone().unwrap_or_else(|| scenario::results(&arguments.study, ""));
    if let Some(scheduler) = &arguments.scheduler {
        return cluster::sweep(&arguments.study, scheduler, &out, arguments.quiet);
    }
    kept::refuse_missing(&study, &arguments.keep_run)?;
    let folder = Folder::open(&out, &study)?;
    interrupt::end_between_steps();
    let all = 0..study.shard_count();
    let shards: Vec<u64> = match arguments.shard {
        Some(share) => all.filter(|shard| shard % share.of == share.part - 1).collect(),
        None => all.collect(),
    };
    let bar = OnceLock::new();
    let tell = |progress: percuss_study::Progress| {
        let new = || Progress::of_runs(progress.wanted, progress.before, !arguments.quiet);
        bar.get_or_init(new).reach(progress.done);
        !interrupt::requested()
    };
    let jobs = arguments.jobs.map_or(0, |jobs| jobs as usize);
    let done = sweep(&study, &folder, &shards, jobs, &tell)?;
    drop(bar);
    match done {
        Done::Stopped => {
            let text = "interrupted; finished runs are kept, and the same command continues";
            terminal::warning(Caution::Interrupted, text);
            return Ok(Status::Interrupted);
        }
        Done::Part => {
            if !arguments.quiet {
                terminal::tell("this shard is finished; others are not");
            }
            return Ok(Status::Done);
        }
        Done::All => {}
    }
    folder.finish(&study)?;
    let table = folder.results(&study)?;
    let whole = kept::keep(&study, &out, &arguments.keep_run)?;
    let page = percuss_study::report(&study, &table, &folder.kept());
    folder.write(percuss_study::REPORT, page.as_bytes())?;
    let indices = percuss_study::indices(&study, &table);
    if study.has_sobol_indices() {
        let bytes = percuss_study::indices_parquet(&study, &indices)?;
        folder.write(percuss_study::INDICES, &bytes)?;
    }
    outcome::tell(&study, &table, &indices, arguments, &out)?;
    Ok(whole)
}
