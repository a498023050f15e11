//! Ctrl-C: the first ends the run after its step, the second ends the program.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use percuss_output::RunDirectory;

use crate::outcome::{Failure, Status};

/// Set by the first signal.
static REQUESTED: AtomicBool = AtomicBool::new(false);
/// Directory to remove if the program ends at once; locked while results are put in place.
static STAGING: Mutex<Option<PathBuf>> = Mutex::new(None);

/// Takes over Ctrl-C, and the signals that ask to terminate or hang up.
///
/// # Errors
/// If the system does not allow it.
pub fn install() -> Result<(), Failure> {
    ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::Relaxed) {
            abort();
        }
    })
    .map_err(|error| Failure::System(format!("cannot take over Ctrl-C: {error}")))
}

/// Whether the user has asked to stop.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// The directory to remove on a second Ctrl-C.
pub fn protect(staging: &Path) {
    *lock() = Some(staging.to_owned());
}

/// Puts the results in place; no signal comes in between.
///
/// # Errors
/// If something cannot be moved.
pub fn commit(directory: RunDirectory) -> Result<PathBuf, percuss_output::Error> {
    let mut staging = lock();
    *staging = None;
    directory.commit()
}

fn abort() -> ! {
    let mut staging = lock();
    if let Some(directory) = staging.take() {
        // The run may be writing into it still: what comes after a first try goes with a second.
        let _ = fs::remove_dir_all(&directory).or_else(|_| fs::remove_dir_all(&directory));
    }
    std::process::exit(i32::from(Status::Interrupted.code()))
}

fn lock() -> MutexGuard<'static, Option<PathBuf>> {
    STAGING.lock().unwrap_or_else(PoisonError::into_inner)
}
