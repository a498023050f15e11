//! Tests and their channels: what is measured, and what it is compared with.

use percuss_output::shock::{Cfc, ShockError};
use percuss_scenario::fit::Alignment;
use percuss_scenario::{Field, Scenario};

use crate::curve::Curve;

/// A column of the history, or the derivative of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Column {
    /// The column that the run records.
    pub recorded: String,
    /// Whether its rate of change is compared: an acceleration, of a velocity.
    pub differentiated: bool,
}

impl Column {
    /// The column with a name; `point.tip.acceleration_2` is the rate of change of `point.tip.velocity_2`, and so with `absolute_`.
    pub fn of(name: &str) -> Self {
        for what in ["", "absolute_"] {
            if let Some((owner, axis)) = name.rsplit_once(&format!(".{what}acceleration_")) {
                let recorded = format!("{owner}.{what}velocity_{axis}");
                return Self { recorded, differentiated: true };
            }
        }
        Self { recorded: name.into(), differentiated: false }
    }
}

/// A channel.
#[derive(Clone, Debug)]
pub(crate) struct Channel {
    pub name: String,
    /// Name of the column as given.
    pub column_name: String,
    pub column: Column,
    /// SI unit.
    pub unit: String,
    /// Standard deviation of the measured values \[unit of the channel\].
    pub sigma: f64,
    pub class: Option<Cfc>,
    /// Measured values at the times of the test, filtered, shape (n_sample) \[unit of the channel\].
    pub measured: Vec<f64>,
}

impl Channel {
    /// What is compared, from what was recorded; linear in it.
    ///
    /// # Errors
    /// If the rows of the run are too far apart.
    pub fn shaped(&self, recorded: &Curve) -> Result<Curve, ShockError> {
        let differentiated =
            self.column.differentiated.then(|| recorded.derivative()).transpose()?;
        let curve = differentiated.as_ref().unwrap_or(recorded);
        match self.class {
            Some(class) => curve.filtered(class),
            None => Ok(curve.clone()),
        }
    }
}

/// A test.
#[derive(Clone, Debug)]
pub(crate) struct Test {
    pub name: String,
    pub scenario: Scenario,
    /// Adjustable numbers and where they stand, shape (numbers) \[index of a number\].
    pub fields: Vec<(usize, Field)>,
    /// Times of the record that are compared, shape (n_sample) \[s\].
    pub time: Vec<f64>,
    /// Its channels, shape (channels).
    pub channels: Vec<Channel>,
    pub align: Alignment,
    /// Time of the record at which the run starts, where it is given.
    pub offset: f64,
    /// Which adjustable number is the offset, where it is fitted.
    pub fitted_offset: Option<usize>,
    /// Onset of the first channel in the record, where records are aligned by it \[s\].
    pub onset: Option<f64>,
    pub hold_out: bool,
}

impl Test {
    /// Columns that its run records, each once.
    pub fn recorded(&self) -> Vec<String> {
        let mut all: Vec<String> = Vec::new();
        for channel in &self.channels {
            if !all.contains(&channel.column.recorded) {
                all.push(channel.column.recorded.clone());
            }
        }
        all
    }

    /// Number of values that are compared.
    pub fn samples(&self) -> usize {
        self.time.len() * self.channels.len()
    }
}
