//! Output of a run during its steps: rows of channels, for a [`Recorder`].

use super::channels::Channel;
use super::checkpoint::Checkpoint;
use crate::error::RecorderError;
use crate::frame::Frame;
use crate::run::observing::status::RunStatus;
use crate::state::State;

/// Whether a run continues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// Continue.
    Continue,
    /// Stop after this row; the run ends as interrupted.
    Stop,
}

/// Receives the rows of a run.
pub trait Recorder {
    /// Called once before the first row, and again when a run continues from a checkpoint.
    ///
    /// # Errors
    /// Whatever keeps the recorder from recording; the run then ends as failed.
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        let _ = channels;
        Ok(())
    }

    /// Called for the initial state and for every recorded step, `values[k]` belonging to `channels[k]`;
    /// `values[0]` is the time.
    ///
    /// # Errors
    /// Whatever keeps the recorder from recording; the run then ends as failed.
    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        let _ = values;
        Ok(())
    }

    /// Whether rows are requested; if not, [`Recorder::row`] is not called and their values are not computed.
    fn wants_rows(&self) -> bool {
        true
    }

    /// Called right before every row, with the state the row is taken from: for shapes of the whole structure.
    fn state(&mut self, state: &State) {
        let _ = state;
    }

    /// Whether the frame of a row at `time` is requested; if not, [`Recorder::frame`] is not called. `force` and `impulse` are the sums of the
    /// magnitudes of its contact forces \[N\] and of its impulses \[N s\].
    fn wants_frame(&mut self, time: f64, force: f64, impulse: f64) -> bool {
        let _ = (time, force, impulse);
        false
    }

    /// Called before a row whose frame is requested.
    fn frame(&mut self, frame: &Frame<'_>) {
        let _ = frame;
    }

    /// Whether the status of the run is requested, before the first step and after each; if not, [`Recorder::status`] is not called.
    fn wants_status(&mut self) -> bool {
        false
    }

    /// Called with a requested status.
    fn status(&mut self, status: &RunStatus<'_>) {
        let _ = status;
    }

    /// Whether a checkpoint is requested before the next step, with `last` for the last one; if not, [`Recorder::checkpoint`] is not called. Called
    /// before every step, and after a whole step in which the run was stopped; of steps chosen for an accuracy, up to the first one whose size the end
    /// of the run determines.
    fn wants_checkpoint(&mut self, last: bool) -> bool {
        let _ = last;
        false
    }

    /// Called with a requested checkpoint.
    ///
    /// # Errors
    /// Whatever keeps the recorder from keeping it; the run then ends as failed.
    fn checkpoint(&mut self, checkpoint: &Checkpoint) -> Result<(), RecorderError> {
        let _ = checkpoint;
        Ok(())
    }

    /// Called after every step, recorded or not, with the time reached \[s\].
    fn progress(&mut self, time: f64) -> Flow {
        let _ = time;
        Flow::Continue
    }
}

/// Records nothing and requests nothing: for runs of which only the summary is used.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoRecorder;

impl Recorder for NoRecorder {
    fn wants_rows(&self) -> bool {
        false
    }
}

/// Stores every row in memory.
#[derive(Clone, Debug, Default)]
pub struct MemoryRecorder {
    /// The columns, shape (channels).
    pub channels: Vec<Channel>,
    /// Values, shape (rows, channels), row by row \[unit of the channel\].
    pub values: Vec<f64>,
}

impl MemoryRecorder {
    /// The column called `name`, if there is one.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let k = self.channels.iter().position(|c| c.name == name)?;
        Some(self.values.chunks_exact(self.channels.len()).map(|row| row[k]).collect())
    }
}

impl Recorder for MemoryRecorder {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        self.channels = channels.to_vec();
        Ok(())
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        self.values.extend_from_slice(values);
        Ok(())
    }
}
