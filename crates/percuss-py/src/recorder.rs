//! What receives a run: columns, frames, and Python's wish to know and to stop.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use percuss::{Channel, Flow, Frame, Recorder, RecorderError, RunStatus};
use percuss_output::fields::FrameStore;
use percuss_output::{HistoryWriter, TimeEstimate};
use pyo3::prelude::*;

use crate::given::Raised;

/// How far a run is, known to both threads.
#[derive(Clone, Debug, Default)]
pub struct Reached(
    /// Bits of the time and of the end, shape (2) \[s\].
    Arc<[AtomicU64; 2]>,
);

impl Reached {
    /// A time of a run up to an end \[s\].
    fn set(&self, time: f64, end: f64) {
        for (to, value) in self.0.iter().zip([time, end]) {
            to.store(value.to_bits(), Ordering::Relaxed);
        }
    }

    /// The time reached and that of the end, once the run goes, shape (2) \[s\].
    pub fn get(&self) -> Option<[f64; 2]> {
        let [time, end] =
            self.0.each_ref().map(|bits| f64::from_bits(bits.load(Ordering::Relaxed)));
        (end > 0.0).then_some([time, end])
    }
}

/// Rows as columns, each in memory of its own.
#[derive(Debug, Default)]
pub struct Columns {
    /// The columns' names and units, shape (channels).
    pub channels: Vec<Channel>,
    /// Values, column by column, shape (channels, rows) \[unit of the channel\].
    pub values: Vec<Vec<f64>>,
}

/// Receives a run for Python.
pub struct RunRecorder {
    /// What is recorded, shape (channels, rows) \[unit of the channel\].
    pub columns: Columns,
    /// How the scene moves.
    pub frames: FrameStore,
    /// The history on disk, where one is wanted.
    pub history: Option<HistoryWriter>,
    /// How far the run is.
    pub reached: Reached,
    /// When the run ends \[s\].
    pub end: f64,
    /// What Python raised, and whether the run is to end.
    pub raised: Raised,
    /// Whether an estimate of the time left is logged: a line amid those of a progress bar would break them.
    pub says_estimate: bool,
    estimate: TimeEstimate,
    rows: usize,
}

impl RunRecorder {
    /// A recorder that makes room for so many rows of a run up to an end.
    pub fn new(
        frames: FrameStore,
        history: Option<HistoryWriter>,
        reached: Reached,
        raised: Raised,
        (rows, end): (usize, f64),
    ) -> Self {
        Self {
            columns: Columns::default(),
            frames,
            history,
            reached,
            end,
            raised,
            says_estimate: true,
            estimate: TimeEstimate::default(),
            rows: rows.min(1 << 16),
        }
    }
}

impl Recorder for RunRecorder {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        self.columns.channels = channels.to_vec();
        self.columns.values = channels.iter().map(|_| Vec::with_capacity(self.rows)).collect();
        self.history.as_mut().map_or(Ok(()), |history| history.begin(channels))
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        for (column, value) in self.columns.values.iter_mut().zip(values) {
            column.push(*value);
        }
        self.history.as_mut().map_or(Ok(()), |history| history.row(values))
    }

    fn wants_frame(&mut self, time: f64, force: f64, impulse: f64) -> bool {
        self.frames.wants(time, force, impulse)
    }

    fn frame(&mut self, frame: &Frame<'_>) {
        self.frames.take(frame);
    }

    fn wants_status(&mut self) -> bool {
        self.says_estimate && self.estimate.wants()
    }

    /// Goes to the logger `percuss`, which says it on standard error unless the user has other plans for it.
    fn status(&mut self, status: &RunStatus<'_>) {
        let Some(text) = self.estimate.look(status).filter(|_| !self.raised.stop.is_wanted())
        else {
            return;
        };
        let logged = Python::attach(|py| {
            let logger = py.import("logging")?.call_method1("getLogger", ("percuss",))?;
            logger.call_method1("warning", (text,)).map(drop)
        });
        if let Err(error) = logged {
            self.raised.put(error);
        }
    }

    fn progress(&mut self, time: f64) -> Flow {
        self.reached.set(time, self.end);
        if self.raised.stop.is_wanted() { Flow::Stop } else { Flow::Continue }
    }
}
