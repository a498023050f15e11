//! All runs of a study on the cores of one machine.

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use crate::error::Error;
use crate::folder::Folder;
use crate::study::Study;
use crate::workers::Workers;

/// How far a sweep is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Runs that are done, those of earlier calls included.
    pub done: u64,
    /// Runs that were done when this call began.
    pub before: u64,
    /// Runs that this call is to see done.
    pub wanted: u64,
}

/// How a sweep ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Done {
    /// Every run of the study is done.
    All,
    /// The runs asked for are done, others are not.
    Part,
    /// It was stopped; what is done is kept.
    Stopped,
}

/// Does what is left of the shards `wanted`, on `jobs` threads; 0 stands for one a core.
///
/// `tell` hears of the progress, from any thread; when it says no, the sweep stops.
///
/// # Errors
/// If a shard cannot be written.
pub fn sweep(
    study: &Study,
    folder: &Folder,
    wanted: &[u64],
    jobs: usize,
    tell: &(dyn Fn(Progress) -> bool + Sync),
) -> Result<Done, Error> {
    Workers::new(jobs)?.install(|| in_pool(study, folder, wanted, tell))
}

fn in_pool(
    study: &Study,
    folder: &Folder,
    wanted: &[u64],
    tell: &(dyn Fn(Progress) -> bool + Sync),
) -> Result<Done, Error> {
    let runs = |shards: &[u64]| -> u64 {
        shards.iter().map(|&shard| study.runs_of(shard)).map(|runs| runs.end - runs.start).sum()
    };
    let left: Vec<u64> =
        wanted.par_iter().copied().filter(|&shard| !folder.has(study, shard)).collect();
    let all = runs(wanted);
    let before = all - runs(&left);
    let done = AtomicU64::new(before);
    let progress = || Progress { done: done.load(Ordering::Relaxed), before, wanted: all };
    let goes_on = || tell(progress());
    // Shards are taken in their order by whichever thread is free.
    let next = Mutex::new(left.into_iter());
    let take = || next.lock().ok().and_then(|mut next| next.next());
    let work = || -> Result<bool, Error> {
        while let Some(index) = take() {
            let Some(shard) = study.run_shard_while(index, &goes_on) else { return Ok(false) };
            folder.keep(study, &shard)?;
            done.fetch_add(shard.table.rows() as u64, Ordering::Relaxed);
            if !goes_on() {
                return Ok(take().is_none());
            }
        }
        Ok(true)
    };
    let threads: Vec<usize> = (0..rayon::current_num_threads()).collect();
    let ends: Vec<bool> = threads.par_iter().map(|_| work()).collect::<Result<_, Error>>()?;
    if ends.contains(&false) {
        return Ok(Done::Stopped);
    }
    let others = (0..study.shard_count()).into_par_iter().filter(|shard| !wanted.contains(shard));
    let complete = others.all(|shard| folder.has(study, shard));
    Ok(if complete { Done::All } else { Done::Part })
}
