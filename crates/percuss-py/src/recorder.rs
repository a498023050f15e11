//! What receives a run: columns, frames, and Python's wish to know and to stop.

use std::time::{Duration, Instant};

use percuss::{Channel, Flow, Frame, Recorder, RecorderError, RunStatus};
use percuss_output::fields::FrameStore;
use percuss_output::{HistoryWriter, TimeEstimate};
use pyo3::prelude::*;

use crate::given::Given;

/// Python is asked this often.
const LOOK: Duration = Duration::from_millis(50);

/// Rows as columns, each in memory of its own.
#[derive(Debug, Default)]
pub struct Columns {
    /// The columns' names and units, shape (channels).
    pub channels: Vec<Channel>,
    /// Values, column by column, shape (channels, rows) \[unit of the channel\].
    pub values: Vec<Vec<f64>>,
}

/// Receives a run for Python.
pub struct RunRecorder<'a> {
    /// What is recorded, shape (channels, rows) \[unit of the channel\].
    pub columns: Columns,
    /// How the scene moves.
    pub frames: FrameStore,
    /// The history on disk, where one is wanted.
    pub history: Option<HistoryWriter>,
    /// Called with the time reached and that of the end.
    pub listener: Option<&'a Py<PyAny>>,
    /// When the run ends \[s\].
    pub end: f64,
    pub given: &'a Given,
    /// Why Python wants the run to stop.
    pub raised: Option<PyErr>,
    next_look: Instant,
    estimate: TimeEstimate,
    rows: usize,
}

impl<'a> RunRecorder<'a> {
    /// A recorder that makes room for so many rows of a run up to an end.
    pub fn new(
        frames: FrameStore,
        history: Option<HistoryWriter>,
        listener: Option<&'a Py<PyAny>>,
        given: &'a Given,
        (rows, end): (usize, f64),
    ) -> Self {
        Self {
            columns: Columns::default(),
            frames,
            history,
            listener,
            end,
            given,
            raised: None,
            next_look: Instant::now() + LOOK,
            estimate: TimeEstimate::default(),
            rows: rows.min(1 << 16),
        }
    }

    /// Lets Python handle its signals, and tells how far the run is.
    fn look(&mut self, time: f64) -> Flow {
        let asked = Python::attach(|py| {
            py.check_signals()?;
            self.listener.map_or(Ok(()), |listener| listener.call1(py, (time, self.end)).map(drop))
        });
        self.next_look = Instant::now() + LOOK;
        match asked {
            Ok(()) => Flow::Continue,
            Err(error) => {
                self.raised = Some(error);
                Flow::Stop
            }
        }
    }
}

impl Recorder for RunRecorder<'_> {
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
        self.estimate.wants()
    }

    /// Goes to the logger `percuss`, which says it on standard error unless the user has other plans for it.
    fn status(&mut self, status: &RunStatus<'_>) {
        let Some(text) = self.estimate.look(status) else { return };
        let logged = Python::attach(|py| {
            let logger = py.import("logging")?.call_method1("getLogger", ("percuss",))?;
            logger.call_method1("warning", (text,)).map(drop)
        });
        if let Err(error) = logged {
            self.raised.get_or_insert(error);
        }
    }

    fn progress(&mut self, time: f64) -> Flow {
        if self.raised.is_some() {
            return Flow::Stop;
        }
        if !self.given.is_empty() && self.given.has_raised() {
            return Flow::Stop;
        }
        if Instant::now() < self.next_look { Flow::Continue } else { self.look(time) }
    }
}
