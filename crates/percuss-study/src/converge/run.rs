//! A run of a convergence study, with the largest magnitudes of columns.

use percuss::{Channel, Flow, Recorder, RecorderError};

/// Listens for the wish to stop, and keeps the values of largest magnitude of columns.
pub(super) struct Ear<'a> {
    goes_on: &'a dyn Fn() -> bool,
    /// Names of the columns, shape (columns).
    names: &'a [&'a str],
    /// Their numbers among all, shape (columns) \[index of a channel\].
    columns: Vec<usize>,
    /// The values, shape (columns) \[unit of the column\]; NaN before the first row.
    pub largest: Vec<f64>,
}

impl<'a> Ear<'a> {
    /// Before a run.
    pub fn new(goes_on: &'a dyn Fn() -> bool, names: &'a [&'a str]) -> Self {
        Self { goes_on, names, columns: Vec::new(), largest: vec![f64::NAN; names.len()] }
    }
}

impl Recorder for Ear<'_> {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        let number = |name: &&str| -> Result<usize, RecorderError> {
            let found = channels.iter().position(|channel| channel.name == *name);
            found.ok_or_else(|| format!("no column `{name}`").into())
        };
        self.columns = self.names.iter().map(number).collect::<Result<_, _>>()?;
        Ok(())
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        for (largest, column) in self.largest.iter_mut().zip(&self.columns) {
            let value = values[*column];
            if largest.is_nan() || value.abs() > largest.abs() {
                *largest = value;
            }
        }
        Ok(())
    }

    fn wants_rows(&self) -> bool {
        !self.names.is_empty()
    }

    fn progress(&mut self, _time: f64) -> Flow {
        if (self.goes_on)() { Flow::Continue } else { Flow::Stop }
    }
}
