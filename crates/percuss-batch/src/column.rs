//! Numbers taken from columns of the history: a value at a time, the largest or smallest one in a window.

use percuss::internals::scalar::Number;
use percuss::{Channel, Fault, Model, Recorder, RecorderError, RunSummary, Settings, simulate};

/// A number taken from a column of the history.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnSample {
    /// Name of the column, such as `contact.bag.force`.
    pub column: String,
    /// The number.
    pub taken: ColumnValue,
}

/// A number taken from a column, which is linear between the rows of the history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ColumnValue {
    /// Value at a time \[s\].
    At(f64),
    /// Largest value in a window.
    Largest {
        /// Start of the window \[s\].
        from: f64,
        /// Its end \[s\].
        to: f64,
    },
    /// Smallest value in a window.
    Smallest {
        /// Start of the window \[s\].
        from: f64,
        /// Its end \[s\].
        to: f64,
    },
}

impl ColumnSample {
    /// The value of a column at a time \[s\].
    pub fn at(column: impl Into<String>, time: f64) -> Self {
        Self { column: column.into(), taken: ColumnValue::At(time) }
    }
}

/// A number with the time to which it belongs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<S> {
    pub value: S,
    /// Time \[s\].
    pub time: f64,
}

/// A number taken from a column, row after row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Taking<S> {
    taken: ColumnValue,
    /// Time and value of the last row, shape (2) \[s, unit of the column\].
    last: Option<[S; 2]>,
    pub found: Option<Found<S>>,
}

impl<S: Number> Taking<S> {
    /// Before the first row.
    pub fn new(taken: ColumnValue) -> Self {
        Self { taken, last: None, found: None }
    }

    /// Takes the next row: its time \[s\] and the value of the column.
    pub fn row(&mut self, time: S, value: S) {
        let last = self.last.replace([time, value]);
        match self.taken {
            ColumnValue::At(at) => {
                if self.found.is_none() {
                    self.found = at_time(last, [time, value], at);
                }
            }
            ColumnValue::Largest { from, to } => self.compare(last, [time, value], [from, to], 1.0),
            ColumnValue::Smallest { from, to } => {
                self.compare(last, [time, value], [from, to], -1.0)
            }
        }
    }

    /// Compares the number with the values of the part of the window between the last two rows; `sign` is negative for the smallest value.
    fn compare(&mut self, last: Option<[S; 2]>, now: [S; 2], window: [f64; 2], sign: f64) {
        let [from, to] = window;
        let time = now[0].lane(0);
        let row = (from <= time && time <= to).then_some(Found { value: now[1], time });
        let within = |at: f64| last.is_some_and(|[t, _]| t.lane(0) < at) && at < time;
        let ends = window.map(|at| within(at).then(|| at_time(last, now, at)).flatten());
        for new in [ends[0], row, ends[1]].into_iter().flatten() {
            let further = |old: Found<S>| sign * new.value.lane(0) > sign * old.value.lane(0);
            if self.found.is_none_or(further) {
                self.found = Some(new);
            }
        }
    }
}

/// The value at a time between two rows, or in the first row.
fn at_time<S: Number>(last: Option<[S; 2]>, [time, value]: [S; 2], at: f64) -> Option<Found<S>> {
    let found = |value| Some(Found { value, time: at });
    let behind = time.constant(at) - time;
    let Some([before, start]) = last else {
        return if behind.lane(0) == 0.0 { found(value) } else { None };
    };
    if behind.lane(0) > 0.0 || before.lane(0) >= at {
        return None;
    }
    // Rows move with the instants of impacts; at a row the value is that of the row.
    found(value + (value - start) / (time - before) * behind)
}

/// Takes numbers from the columns of a run.
struct ColumnRecorder<'a> {
    /// Numbers to take, shape (samples).
    samples: &'a [ColumnSample],
    /// Number of the column of each sample, shape (samples) \[index of a channel\].
    columns: Vec<usize>,
    /// The numbers, shape (samples).
    taking: Vec<Taking<f64>>,
}

impl Recorder for ColumnRecorder<'_> {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        let number = |sample: &ColumnSample| -> Result<usize, RecorderError> {
            let found = channels.iter().position(|channel| channel.name == sample.column);
            found.ok_or_else(|| format!("no column `{}`", sample.column).into())
        };
        self.columns = self.samples.iter().map(number).collect::<Result<_, _>>()?;
        Ok(())
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        for (taking, column) in self.taking.iter_mut().zip(&self.columns) {
            taking.row(values[0], values[*column]);
        }
        Ok(())
    }

    fn wants_rows(&self) -> bool {
        !self.samples.is_empty()
    }
}

/// Times and values of samples that a run has, shape (samples) \[s, unit of the column\].
pub(crate) type FoundSamples = Vec<Option<Found<f64>>>;

/// Simulates a model and takes numbers from the columns of its history.
pub(crate) fn simulate_found(
    model: &Model,
    settings: &Settings,
    samples: &[ColumnSample],
) -> Result<(RunSummary, FoundSamples), Vec<Fault>> {
    let taking = samples.iter().map(|sample| Taking::new(sample.taken)).collect();
    let mut recorder = ColumnRecorder { samples, columns: Vec::new(), taking };
    let summary = simulate(model, settings, &mut recorder)?;
    Ok((summary, recorder.taking.into_iter().map(|taking| taking.found).collect()))
}

/// Simulates a model and takes numbers from the columns of its history, shape (samples) \[unit of the column\]; NaN where the run has none. The run
/// fails if a column does not exist.
///
/// # Errors
/// All faults of the settings, as [`simulate`].
pub fn simulate_with_columns(
    model: &Model,
    settings: &Settings,
    samples: &[ColumnSample],
) -> Result<(RunSummary, Vec<f64>), Vec<Fault>> {
    let (summary, found) = simulate_found(model, settings, samples)?;
    Ok((summary, found.iter().map(|one| one.map_or(f64::NAN, |one| one.value)).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(taken: ColumnValue, rows: &[[f64; 2]]) -> Option<f64> {
        let mut taking = Taking::new(taken);
        rows.iter().for_each(|[time, value]| taking.row(*time, *value));
        taking.found.map(|found| found.value)
    }

    #[test]
    fn values_between_rows_lie_on_the_line_between_them() {
        let rows = [[0.0, 1.0], [1.0, 3.0], [1.5, 2.0]];
        for (at, value) in [(0.0, 1.0), (0.25, 1.5), (1.0, 3.0), (1.25, 2.5), (1.5, 2.0)] {
            assert_eq!(taken(ColumnValue::At(at), &rows), Some(value));
        }
        assert_eq!(taken(ColumnValue::At(1.6), &rows), None);
        assert_eq!(taken(ColumnValue::At(-0.1), &rows), None);
    }

    #[test]
    fn extremes_are_those_of_the_lines_within_the_window() {
        let rows = [[0.0, 1.0], [1.0, 3.0], [2.0, -1.0]];
        let largest = |from, to| taken(ColumnValue::Largest { from, to }, &rows);
        let smallest = |from, to| taken(ColumnValue::Smallest { from, to }, &rows);
        assert_eq!((largest(0.0, 2.0), smallest(0.0, 2.0)), (Some(3.0), Some(-1.0)));
        assert_eq!((largest(0.25, 0.5), smallest(0.25, 0.5)), (Some(2.0), Some(1.5)));
        assert_eq!((largest(1.5, 9.0), smallest(1.5, 9.0)), (Some(1.0), Some(-1.0)));
        assert_eq!(largest(3.0, 4.0), None);
    }
}
