//! Choice of steps for a requested accuracy in place of a step.

use serde::{Deserialize, Serialize};

/// Sizes of the steps of a run, chosen for an accuracy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepControl {
    /// The requested accuracy.
    pub accuracy: f64,
    /// Largest estimate of the error of an accepted step, on the scale of the accuracy: above it only where steps were not made any
    /// smaller.
    pub estimate: f64,
    /// Smallest step; the last one of a run has the remaining time \[s\].
    pub smallest: f64,
    /// Largest step \[s\].
    pub largest: f64,
    /// Mean step \[s\].
    pub mean: f64,
    /// Steps completed.
    pub steps: usize,
    /// Parts of steps that were refused because their error was too large, and repeated smaller.
    pub refused: usize,
}

impl StepControl {
    /// Before the first step.
    pub(crate) fn new(accuracy: f64) -> Self {
        let nan = f64::NAN;
        Self {
            accuracy,
            estimate: 0.0,
            smallest: nan,
            largest: nan,
            mean: nan,
            steps: 0,
            refused: 0,
        }
    }

    /// Whether the accuracy is reached, so far.
    pub fn is_reached(&self) -> bool {
        self.estimate <= self.accuracy * (1.0 + 1e-9)
    }

    /// Counts a step \[s\].
    pub(crate) fn count(&mut self, size: f64) {
        let before = if self.steps > 0 { self.mean } else { 0.0 };
        self.steps += 1;
        self.smallest = self.smallest.min(size);
        self.largest = self.largest.max(size);
        self.mean = before + (size - before) / self.steps as f64;
    }
}
