//! When a run takes checkpoints, and where they go.

use std::path::{Path, PathBuf};
use std::time::Instant;

use percuss::Checkpoint;
use percuss_output::checkpoint::CheckpointFolder;
use percuss_output::fields::FrameStore;
use percuss_scenario::apply_overrides;

use crate::interrupt;
use crate::run_arguments::Every;

/// The checkpoints of a run under way.
#[derive(Debug)]
pub struct Checkpoints {
    folder: CheckpointFolder,
    /// How often they are written; where nothing is said, only the last one.
    every: Option<Every>,
    /// The directory of the results, which keeps the last one.
    results: PathBuf,
    /// Steps since the last one, and when it was.
    passed: usize,
    written: Instant,
    /// Seconds that the run took before this process, and when it began here.
    seconds: f64,
    begun: Instant,
    last: bool,
}

impl Checkpoints {
    /// Of a run whose results go to `results`, which took `seconds` before.
    pub fn new(
        folder: CheckpointFolder,
        every: Option<Every>,
        results: &Path,
        seconds: f64,
    ) -> Self {
        let now = Instant::now();
        let results = results.to_owned();
        Self { folder, every, results, passed: 0, written: now, seconds, begun: now, last: false }
    }

    /// Takes a row that was recorded.
    pub fn row(&mut self, values: &[f64]) -> Result<(), percuss_output::Error> {
        self.folder.row(values)
    }

    /// Whether one is due before the next step. So is one when the user stops the run.
    pub fn wanted(&mut self, last: bool) -> bool {
        self.last = last;
        let due = interrupt::requested()
            || match self.every {
                Some(Every::Steps(steps)) => self.passed >= steps,
                Some(Every::Seconds(seconds)) => self.written.elapsed().as_secs_f64() >= seconds,
                None => false,
            };
        self.passed = if due { 1 } else { self.passed + 1 };
        due || last
    }

    /// Writes one: beside the results, or before the last step among them.
    pub fn take(
        &mut self,
        checkpoint: &Checkpoint,
        frames: &FrameStore,
    ) -> Result<(), percuss_output::Error> {
        let seconds = self.seconds + self.begun.elapsed().as_secs_f64();
        if self.last {
            return self.folder.keep(&self.results, (checkpoint, frames), seconds);
        }
        self.folder.save((checkpoint, frames), seconds)?;
        self.written = Instant::now();
        Ok(())
    }

    /// Removes those beside the results: they are complete, or nothing can go on from where they end.
    pub fn remove(self) {
        self.folder.remove();
    }

    /// Where they are, and the time reached in the one that is there \[s\].
    pub fn place(&self) -> (&Path, Option<f64>) {
        (self.folder.path(), self.folder.time())
    }
}

/// A scenario without its end, which alone may change between a checkpoint and what goes on from it.
pub fn without_end(scenario: &str) -> String {
    let changes = ["time.end=1".to_owned()];
    apply_overrides(scenario, "", &changes).unwrap_or_else(|_| scenario.to_owned())
}
