//! Work that signals end: it is done on a thread of its own, and the calling one looks for Python's signals meanwhile.
//!
//! Python handles signals on its main thread only, and most of the work has no place where it could ask. Every entry of the module that may take
//! longer than a tenth of a second goes through [`Watch`]: Ctrl-C raises `KeyboardInterrupt` soon, whatever the work is at. Work that does not
//! notice [`Stop`] in time is left alone: it ends by itself, and its result is dropped.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use percuss::AnalysisCode;
use pyo3::prelude::*;

use crate::error::analysis_error;

/// Signals are looked for this often.
const LOOK: Duration = Duration::from_millis(50);
/// Time that the work has to end by itself after a signal.
const PATIENCE: Duration = Duration::from_millis(50);
/// Stack of the thread \[bytes\]: that of the threads of a sweep. What is not used costs nothing.
const STACK: usize = 64 << 20;

/// Whether work is to end, known to both threads.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<Flags>);

#[derive(Debug, Default)]
struct Flags {
    wanted: AtomicBool,
    writing: AtomicBool,
    left: AtomicBool,
}

impl Stop {
    /// Whether the work is to end.
    pub fn is_wanted(&self) -> bool {
        self.0.wanted.load(Ordering::Relaxed)
    }

    /// Asks the work to end.
    pub fn want(&self) {
        self.0.wanted.store(true, Ordering::Relaxed);
    }

    /// From here on the work writes files and soon notices that it is to end: it is waited for, unless a second signal comes.
    pub fn writes(&self) {
        self.0.writing.store(true, Ordering::Relaxed);
    }

    fn is_waited_for(&self) -> bool {
        self.0.writing.load(Ordering::Relaxed)
    }
}

/// How work is watched.
#[derive(Clone, Debug, Default)]
pub struct Watch {
    /// Asks the work to end.
    pub stop: Stop,
    /// Whether the work calls functions of Python.
    pub calls_python: bool,
}

/// What came of the work: its result, or what it panicked with.
type Outcome<T> = Result<T, Box<dyn Any + Send>>;

impl Watch {
    /// Does the work while signals are looked for.
    ///
    /// # Errors
    /// What the handler of a signal raised, `KeyboardInterrupt` as a rule; `AnalysisError` if the work panicked.
    pub fn run<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&Stop) -> T + Send + 'static,
    ) -> PyResult<T> {
        self.run_reporting(py, work, |_| Ok(()))
    }

    /// The same; `tell` is called as often as signals are looked for and once when the work is done, and what it raises ends the work, too.
    ///
    /// # Errors
    /// As [`Watch::run`], and what `tell` raised.
    pub fn run_reporting<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&Stop) -> T + Send + 'static,
        mut tell: impl FnMut(Python<'_>) -> PyResult<()> + Send,
    ) -> PyResult<T> {
        let (sender, receiver) = sync_channel(1);
        let watch = self.clone();
        py.detach(|| on_a_thread(move || watch.perform(work, &sender)));
        let outcome = py.detach(|| self.wait(receiver, &mut tell))?;
        // A signal that came at the end is raised here, and not within what is made of the result.
        py.check_signals()?;
        outcome.map_err(|panic| {
            let text = format!("internal error: {}", text_of(panic.as_ref()));
            analysis_error(AnalysisCode::Broken, &text)
        })
    }

    /// The work on its thread.
    fn perform<T: Send>(
        self,
        work: impl FnOnce(&Stop) -> T + Send,
        sender: &SyncSender<Outcome<T>>,
    ) {
        let done = || {
            let outcome = catch_unwind(AssertUnwindSafe(|| work(&self.stop)));
            drop(sender.send(outcome));
            // The interpreter may have ended meanwhile, and there is no way back into it.
            while self.calls_python && self.stop.0.left.load(Ordering::Acquire) {
                std::thread::park();
            }
        };
        if self.calls_python {
            // A thread with a state in the interpreter, without which every call would make one.
            Python::attach(|py| py.detach(done));
        } else {
            done();
        }
    }

    /// Waits for the end of the work, or for something raised.
    fn wait<T>(
        &self,
        receiver: Receiver<Outcome<T>>,
        tell: &mut (dyn FnMut(Python<'_>) -> PyResult<()> + Send),
    ) -> PyResult<Outcome<T>> {
        let mut raised: Option<(PyErr, Instant)> = None;
        loop {
            match (receiver.recv_timeout(LOOK), raised.take()) {
                (Ok(outcome), None) => {
                    // Work that ends before signals are looked for the first time is reported, too.
                    if outcome.is_ok() {
                        Python::attach(&mut *tell)?;
                    }
                    return Ok(outcome);
                }
                (Err(RecvTimeoutError::Disconnected), None) => {
                    return Ok(Err(Box::new("a thread ended without a result")));
                }
                (Ok(_) | Err(RecvTimeoutError::Disconnected), Some((error, _))) => {
                    return Err(error);
                }
                (Err(RecvTimeoutError::Timeout), None) => {
                    let asked = Python::attach(|py| {
                        py.check_signals()?;
                        tell(py)
                    });
                    if let Err(error) = asked {
                        self.stop.want();
                        raised = Some((error, Instant::now()));
                    }
                }
                (Err(RecvTimeoutError::Timeout), Some((error, since))) => {
                    let again = Python::attach(|py| py.check_signals()).is_err();
                    if again || !self.stop.is_waited_for() && since.elapsed() >= PATIENCE {
                        self.stop.0.left.store(true, Ordering::Release);
                        return Err(error);
                    }
                    raised = Some((error, since));
                }
            }
        }
    }
}

/// Starts a thread; where there is no other to be had, the work is done on this one, and signals are seen at its end.
fn on_a_thread(work: impl FnOnce() + Send + 'static) {
    let shared = Arc::new(Mutex::new(Some(work)));
    let take = |of: &Mutex<Option<_>>| of.lock().unwrap_or_else(PoisonError::into_inner).take();
    let own = Arc::clone(&shared);
    let thread = std::thread::Builder::new().name("percuss".into()).stack_size(STACK);
    let spawned = thread.spawn(move || take(&own).map_or((), |work| work()));
    if spawned.is_err()
        && let Some(work) = take(&shared)
    {
        work();
    }
}

/// What a panic said.
fn text_of(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("panic")
}
