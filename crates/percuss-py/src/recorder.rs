//! What receives a run: columns, shapes, and Python's wish to know and to stop.

use std::time::{Duration, Instant};

use percuss::{Channel, Flow, Recorder, RecorderError, State};
use percuss_output::HistoryWriter;
use pyo3::prelude::*;

use crate::given::Given;

/// Python is asked this often.
const LOOK: Duration = Duration::from_millis(50);

/// Rows as columns, each in memory of its own.
#[derive(Debug, Default)]
pub struct Columns {
    pub channels: Vec<Channel>,
    pub values: Vec<Vec<f64>>,
}

/// Displacements of all nodes at some of the rows: every so many, so that memory does not grow with the run.
#[derive(Debug)]
pub struct Shapes {
    /// Times \[s\].
    pub times: Vec<f64>,
    /// Displacements, shape (n_shape, n_node, 4).
    pub values: Vec<f64>,
    most: usize,
    stride: usize,
    row: usize,
    last: (f64, Vec<f64>),
}

impl Shapes {
    /// At most so many, two or more; none if zero.
    pub fn new(most: usize) -> Self {
        let most = if most == 0 { 0 } else { most.max(2) };
        let (times, values) = (Vec::new(), Vec::new());
        Self { times, values, most, stride: 1, row: 0, last: (f64::NAN, Vec::new()) }
    }

    fn see(&mut self, state: &State) {
        if self.most == 0 {
            return;
        }
        let now = state.displacement.as_flattened();
        if self.row.is_multiple_of(self.stride) {
            if self.times.len() == self.most {
                self.thin(now.len());
            }
            if self.row.is_multiple_of(self.stride) {
                self.times.push(state.time);
                self.values.extend_from_slice(now);
            }
        }
        self.row += 1;
        self.last.0 = state.time;
        self.last.1.clear();
        self.last.1.extend_from_slice(now);
    }

    /// Drops every second one.
    fn thin(&mut self, size: usize) {
        let kept = self.times.len().div_ceil(2);
        for k in 0..kept {
            self.times[k] = self.times[2 * k];
            self.values.copy_within(2 * k * size..(2 * k + 1) * size, k * size);
        }
        self.times.truncate(kept);
        self.values.truncate(kept * size);
        self.stride *= 2;
    }

    /// The last row belongs to it, whatever the stride.
    pub fn close(&mut self) {
        if self.times.last().is_some_and(|t| *t < self.last.0) {
            self.times.push(self.last.0);
            self.values.append(&mut self.last.1);
        }
    }
}

/// Receives a run for Python.
pub struct RunRecorder<'a> {
    pub columns: Columns,
    pub shapes: Shapes,
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
    rows: usize,
}

impl<'a> RunRecorder<'a> {
    /// A recorder that makes room for so many rows of a run up to an end.
    pub fn new(
        shapes: usize,
        history: Option<HistoryWriter>,
        listener: Option<&'a Py<PyAny>>,
        given: &'a Given,
        (rows, end): (usize, f64),
    ) -> Self {
        Self {
            columns: Columns::default(),
            shapes: Shapes::new(shapes),
            history,
            listener,
            end,
            given,
            raised: None,
            next_look: Instant::now() + LOOK,
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

    fn state(&mut self, state: &State) {
        self.shapes.see(state);
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        for (column, value) in self.columns.values.iter_mut().zip(values) {
            column.push(*value);
        }
        self.history.as_mut().map_or(Ok(()), |history| history.row(values))
    }

    fn progress(&mut self, time: f64) -> Flow {
        if !self.given.is_empty() && self.given.has_raised() {
            return Flow::Stop;
        }
        if Instant::now() < self.next_look { Flow::Continue } else { self.look(time) }
    }
}
