//! Ctrl-C, and the signals that ask to terminate.
//!
//! A command ends at once and takes what it has not finished with it. One that works in steps says so
//! ([`end_between_steps`]): then the first signal is only noted, so that it ends after its step with what it has, and the second one
//! ends it at once.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use percuss_output::{Extent, Results, RunDirectory, RunUpdate};

use crate::modified_files;
use crate::outcome::{Failure, Status};

/// Tries to remove what a command is still writing into.
const TRIES: usize = 200;

/// A signal so soon after the first one is that one once more: `timeout` sends it to the program and then to its group.
const REPEATED: Duration = Duration::from_millis(200);

/// Set by the first signal.
static REQUESTED: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
/// Whether a signal ends the program: the command does not look at [`requested`] itself, or was asked before.
static AT_ONCE: LazyLock<Arc<AtomicBool>> = LazyLock::new(|| Arc::new(AtomicBool::new(true)));
/// Files and directories to remove if the program ends at once; locked while results are put in place.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Takes over Ctrl-C and the signals that ask to terminate: those that batch systems send when time is up, and a hang-up unless it is
/// ignored, so that `nohup` works.
///
/// # Errors
/// If the system does not allow it.
pub fn install() -> Result<(), Failure> {
    listen().map_err(|error| {
        let text = format!("cannot handle Ctrl-C: {error}");
        Failure::System(percuss_codes::FileCode::System.into(), text)
    })
}

/// From here on the first signal is only noted: the command asks [`requested`] between its steps.
pub fn end_between_steps() {
    if !requested() {
        AT_ONCE.store(false, Ordering::Relaxed);
    }
}

#[cfg(unix)]
fn listen() -> Result<(), std::io::Error> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU};
    let mut all = vec![SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU];
    if !is_ignored(SIGHUP) {
        all.push(SIGHUP);
    }
    let mut signals = signal_hook::iterator::Signals::new(&all)?;
    let handle = signals.handle();
    let thread = std::thread::Builder::new().name("signals".into());
    if thread.spawn(move || signals.forever().for_each(|_| request())).is_err() {
        // No thread to be had: a run needs none, and neither does its end.
        handle.close();
        drop(handle);
        return listen_without_a_thread(&all);
    }
    Ok(())
}

/// The first signal is noted where the command looks at it; else, and from the second one on, it ends the program. What the command
/// has not finished is then left to the next one that writes there.
#[cfg(unix)]
fn listen_without_a_thread(signals: &[i32]) -> Result<(), std::io::Error> {
    use signal_hook::flag;
    for signal in signals {
        let status = i32::from(Status::Interrupted.code());
        flag::register_conditional_shutdown(*signal, status, Arc::clone(&AT_ONCE))?;
        flag::register(*signal, Arc::clone(&REQUESTED))?;
        flag::register(*signal, Arc::clone(&AT_ONCE))?;
    }
    Ok(())
}

/// Whether whoever started the program has it ignore a signal. Where the system does not tell, a hang-up is left alone.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let Ok(status) = fs::read_to_string("/proc/self/status") else { return true };
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_none_or(|mask| mask >> (signal - 1) & 1 == 1)
}

#[cfg(not(unix))]
fn listen() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(request)
}

/// What a signal does.
fn request() {
    static FIRST: OnceLock<Instant> = OnceLock::new();
    let repeated = FIRST.get().is_some_and(|first| first.elapsed() < REPEATED);
    FIRST.get_or_init(Instant::now);
    REQUESTED.store(true, Ordering::Relaxed);
    if AT_ONCE.swap(true, Ordering::Relaxed) && !repeated {
        abort();
    }
}

/// Whether the user has asked to stop.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// A directory of results to fill, removed if the program ends at once.
///
/// # Errors
/// As [`RunDirectory::create_for`].
pub fn directory(results: Results, out: &Path) -> Result<RunDirectory, percuss_output::Error> {
    // No signal comes between its appearance and the note of it, or it would stay behind.
    let mut unfinished = lock();
    let directory = RunDirectory::create_for(results, out)?;
    *unfinished = [directory.path(), directory.lock_file()].map(Path::to_owned).into();
    Ok(directory)
}

/// New files for the directory of a finished run, removed likewise.
///
/// # Errors
/// As [`RunUpdate::open`].
pub fn update(dir: &Path) -> Result<RunUpdate, percuss_output::Error> {
    let mut unfinished = lock();
    let update = RunUpdate::open(dir)?;
    *unfinished = [update.path(), update.lock_file()].map(Path::to_owned).into();
    Ok(update)
}

/// Says what is to be removed if the program ends at once.
pub fn protect<const N: usize>(unfinished: [&Path; N]) {
    *lock() = unfinished.map(Path::to_owned).into();
}

/// Puts results in place; no signal comes in between. Returns where they are; what was changed meanwhile is reported.
///
/// # Errors
/// If something cannot be moved.
pub fn commit(directory: RunDirectory, extent: Extent) -> Result<PathBuf, percuss_output::Error> {
    let placed = undisturbed(|| directory.commit_as(extent))?;
    modified_files::tell_all(&placed.kept);
    Ok(placed.place)
}

/// The same for new files of a finished run.
///
/// # Errors
/// If something cannot be moved.
pub fn commit_update(update: RunUpdate) -> Result<(), percuss_output::Error> {
    modified_files::tell_all(&undisturbed(|| update.commit())?);
    Ok(())
}

fn undisturbed<T>(put: impl FnOnce() -> T) -> T {
    let mut unfinished = lock();
    unfinished.clear();
    put()
}

fn abort() -> ! {
    for path in lock().drain(..) {
        remove(&path);
    }
    std::process::exit(i32::from(Status::Interrupted.code()))
}

/// Removes a file or directory. The command may be writing into it still; what it adds while one try is at work goes with the next.
fn remove(path: &Path) {
    for _ in 0..TRIES {
        let removed = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
        if removed.is_ok() || !path.exists() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
}

fn lock() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}
