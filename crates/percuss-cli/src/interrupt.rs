//! Ctrl-C: the first ends the run after its step, the second ends the program.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use percuss_output::{Extent, RunDirectory};

use crate::outcome::{Failure, Status};

/// Tries to remove what a run is still writing into.
const TRIES: usize = 200;

/// Set by the first signal.
static REQUESTED: AtomicBool = AtomicBool::new(false);
/// Directory to remove if the program ends at once, and the file that keeps others out; locked while results are put in place.
static STAGING: Mutex<Option<[PathBuf; 2]>> = Mutex::new(None);

/// Takes over Ctrl-C and the signal that asks to terminate, which batch systems send when time is up.
/// A hang-up is left alone, so that `nohup` works.
///
/// # Errors
/// If the system does not allow it.
pub fn install() -> Result<(), Failure> {
    listen().map_err(|error| {
        let text = format!("cannot take over Ctrl-C: {error}");
        Failure::System(percuss_codes::FileCode::System.into(), text)
    })
}

#[cfg(unix)]
fn listen() -> Result<(), std::io::Error> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    let mut signals = signal_hook::iterator::Signals::new([SIGINT, SIGTERM])?;
    std::thread::Builder::new()
        .name("signals".into())
        .spawn(move || signals.forever().for_each(|_| request()))
        .map(drop)
}

#[cfg(not(unix))]
fn listen() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(request)
}

/// What a signal does.
fn request() {
    if REQUESTED.swap(true, Ordering::Relaxed) {
        abort();
    }
}

/// Whether the user has asked to stop.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// What is to be removed on a second Ctrl-C.
pub fn protect(directory: &RunDirectory) {
    *lock() = Some([directory.path().to_owned(), directory.lock_file().to_owned()]);
}

/// The same of a file that is not finished.
pub fn protect_file(file: &Path) {
    // Nothing stands where a directory would, and the file goes as the one that keeps others out does.
    *lock() = Some([file.to_owned(), file.to_owned()]);
}

/// Puts the results in place; no signal comes in between. Returns where they are.
///
/// # Errors
/// If something cannot be moved.
pub fn commit(directory: RunDirectory, extent: Extent) -> Result<PathBuf, percuss_output::Error> {
    let mut staging = lock();
    *staging = None;
    directory.commit_as(extent)
}

fn abort() -> ! {
    let mut staging = lock();
    if let Some([directory, lock_file]) = staging.take() {
        // The run may be writing into it still; what it adds while one try is at work goes with the next.
        for _ in 0..TRIES {
            if fs::remove_dir_all(&directory).is_ok() || !directory.exists() {
                break;
            }
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        let _ = fs::remove_file(lock_file);
    }
    std::process::exit(i32::from(Status::Interrupted.code()))
}

fn lock() -> MutexGuard<'static, Option<[PathBuf; 2]>> {
    STAGING.lock().unwrap_or_else(PoisonError::into_inner)
}
