//! Threads for runs.

use crate::error::Error;

/// Stack of a thread \[bytes\]: runs side by side lie on it, and programs that are not optimised keep every number in between. What is
/// not used costs nothing.
const STACK: usize = 64 << 20;

/// Threads that compute runs.
#[derive(Debug)]
pub struct Workers(rayon::ThreadPool);

impl Workers {
    /// So many threads, 0 for one a core. Where so many are not to be had one is enough, and in the end the caller's own.
    ///
    /// # Errors
    /// If the system gives none.
    pub fn new(jobs: usize) -> Result<Self, Error> {
        let of = |jobs| rayon::ThreadPoolBuilder::new().num_threads(jobs).stack_size(STACK);
        let pool = of(jobs).build().or_else(|_| of(1).build());
        let pool = pool.or_else(|_| of(1).use_current_thread().build());
        pool.map(Self).map_err(|e| Error::system(format!("no threads can be started: {e}")))
    }

    /// Number of threads.
    pub fn count(&self) -> usize {
        self.0.current_num_threads()
    }

    /// Does some work, whose parallel parts use these threads.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.0.install(work)
    }
}
