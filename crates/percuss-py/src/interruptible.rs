//! Work that Ctrl-C stops.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use percuss::AnalysisCode;
use pyo3::prelude::*;

use crate::error::{analysis_error, system_error};

/// Python is asked for signals this often.
const LOOK: Duration = Duration::from_millis(50);
/// Stack of the thread \[bytes\]: that of threads that compute runs.
const STACK: usize = 64 << 20;

/// Does some work on another thread, since Python hears signals on its main one only; the work asks whether to go on.
///
/// # Errors
/// What a handler of a signal raised, such as `KeyboardInterrupt`.
pub fn interruptible<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T + Send,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    let goes_on = || !stop.load(Ordering::Relaxed);
    let (done, raised) = py.detach(|| {
        thread::scope(|scope| {
            let (end, ended) = channel::<()>();
            let work = || {
                // Dropped when the work ends, also by a panic.
                let _end = end;
                work(&goes_on)
            };
            let thread = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work);
            let thread = match thread {
                Ok(thread) => thread,
                Err(error) => return (None, Some(system_error(&error.to_string()))),
            };
            let mut raised = None;
            while ended.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
                if raised.is_none()
                    && let Err(error) = Python::attach(|py| py.check_signals())
                {
                    raised = Some(error);
                    stop.store(true, Ordering::Relaxed);
                }
            }
            (thread.join().ok(), raised)
        })
    });
    match (raised, done) {
        (Some(error), _) => Err(error),
        (None, Some(done)) => Ok(done),
        (None, None) => Err(analysis_error(AnalysisCode::Broken, "a thread broke down")),
    }
}
