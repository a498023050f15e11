//! What takes long says that it goes on.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use crate::terminal;

/// Nothing is said before this time; then it doubles.
const PATIENCE: Duration = Duration::from_secs(5);

/// Says now and then what is being done, until it is dropped.
pub struct StageMessages {
    stage: Arc<Mutex<&'static str>>,
    /// Ends the thread when it is dropped.
    _end: Sender<()>,
}

impl StageMessages {
    /// From now on; `stage` is what is done first. Where no thread can be had nothing is said.
    pub fn new(stage: &'static str) -> Self {
        let (end, ended) = channel::<()>();
        let shared = Arc::new(Mutex::new(stage));
        let seen = Arc::clone(&shared);
        let say = move || {
            let (begun, mut wait) = (Instant::now(), PATIENCE);
            while ended.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                let stage = *seen.lock().unwrap_or_else(PoisonError::into_inner);
                let seconds = begun.elapsed().as_secs();
                terminal::tell(&format!("still checking after {seconds} s: {stage}"));
                wait = begun.elapsed();
            }
        };
        let _ = thread::Builder::new().spawn(say);
        Self { stage: shared, _end: end }
    }

    /// What is done from now on.
    pub fn stage(&self, stage: &'static str) {
        *self.stage.lock().unwrap_or_else(PoisonError::into_inner) = stage;
    }
}
