//! Records of tests: their times, and their channels in SI units, filtered.

use std::path::Path;

use percuss::{Channel as HistoryColumn, Fault};
use percuss_output::shock::{Cfc, ShockError};
use percuss_scenario::fit::{FitChannel, FitTest, Record};
use percuss_scenario::{Named, one_of};

use crate::channel::{Channel, Column};
use crate::curve::Curve;
use crate::spikes::without_spikes;

/// Share of the range of a channel that stands for its standard deviation while that is not known.
const UNKNOWN: f64 = 0.01;

/// A record as it was read.
#[derive(Debug)]
pub(super) struct Read {
    /// Its times, shape (n_row) \[s\].
    pub all: Vec<f64>,
    /// The same, as they are compared at first, shape (n_row) \[s\].
    pub time: Vec<f64>,
    /// Values of its first channel without spikes, filtered, shape (n_row) \[unit of the channel\].
    pub first: Vec<f64>,
}

/// Reads the record of a test; nothing where it has faults, which are reported.
pub(super) fn record(
    folder: &Path,
    (named, columns): (&Named<FitTest>, &[HistoryColumn]),
    supplied: Option<&Record>,
    faults: &mut Vec<Fault>,
) -> Option<(Read, Vec<Channel>)> {
    let Named { name, table } = named;
    let header = format!("test.{name}");
    let read = match supplied {
        Some(record) => Ok(record.clone()),
        None => Record::read(&folder.join(&table.data)),
    };
    let mut tell = |key: &str, (found, expected): (String, String)| {
        faults.push(Fault::new(format!("{header}.{key}"), found, expected));
    };
    let record = read.map_err(|fault| tell("data", fault)).ok()?;
    let time = values(&record, &table.time, "s").map_err(|fault| tell("time", fault)).ok()?;
    if let Some(k) = time.windows(2).position(|pair| pair[1] <= pair[0]) {
        let (row, before, at) = (k + 2, time[k], time[k + 1]);
        let found = format!(
            "times that do not increase: {at:e} s behind {before:e} s, row {row} below the header"
        );
        tell("time", (found, "times that increase from row to row".into()));
        return None;
    }
    if time.len() < 3 {
        let rows = if time.len() == 1 { "row" } else { "rows" };
        let found = format!("a record of {} {rows}", time.len());
        tell("data", (found, "three rows or more".into()));
        return None;
    }
    if table.channel.is_empty() {
        let expected = format!("at least one [{header}.channel.NAME]");
        tell("channel", ("no channel".into(), expected));
        return None;
    }
    let mut channels = Vec::new();
    let mut first = None;
    for one in &table.channel {
        let key = format!("channel.{}", one.name);
        match channel(one, &time, &record, columns) {
            Ok((channel, robust)) => {
                channels.push(channel);
                first.get_or_insert(robust);
            }
            Err((inner, fault)) => tell(&format!("{key}.{inner}"), fault),
        }
    }
    let first = first?;
    let complete = channels.len() == table.channel.len();
    complete.then(|| (Read { all: time.clone(), time, first }, channels))
}

/// Values of a column of a record, in an SI unit. What another program supplies may contain anything.
fn values(record: &Record, name: &str, unit: &str) -> Result<Vec<f64>, (String, String)> {
    let column = record.column(name)?;
    let values = column.in_unit(unit)?;
    let header = &column.header;
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(values),
        Some(k) => {
            let found = format!("{} in row {} of `{header}`", values[k], k + 1);
            let expected =
                "a finite number in every row: those in which one is missing have to be left out";
            Err((found, expected.into()))
        }
    }
}

/// Key at fault, what was found and what would be right.
type Wrong = (&'static str, (String, String));

/// A channel, and its values without spikes.
fn channel(
    named: &Named<FitChannel>,
    time: &[f64],
    record: &Record,
    columns: &[HistoryColumn],
) -> Result<(Channel, Vec<f64>), Wrong> {
    let given = &named.table;
    let column = Column::of(&given.column);
    let Some(recorded) = columns.iter().find(|one| one.name == column.recorded) else {
        let found = format!("`{}`, which is no column of the run", given.column);
        let expected = one_of(&given.column, columns.iter().map(|one| one.name.as_str()));
        return Err(("column", (found, expected)));
    };
    let absolute = column.recorded.replace(".velocity_", ".absolute_velocity_");
    if column.differentiated
        && columns.iter().any(|one| one.name == absolute && absolute != column.recorded)
    {
        let found = format!("`{}`, which is relative to the accelerated base", given.column);
        let instead = given.column.replace(".acceleration_", ".absolute_acceleration_");
        let expected = format!("what an accelerometer measures, `{instead}`");
        return Err(("column", (found, expected)));
    }
    let unit = match (column.differentiated, recorded.unit) {
        (true, "m/s") => "m/s^2",
        (_, unit) => unit,
    };
    if given.factor == 0.0 {
        return Err(("factor", ("0".into(), "a factor other than zero".into())));
    }
    let data = given.data.as_deref().unwrap_or(&named.name);
    let measured = values(record, data, unit).map_err(|fault| ("data", fault))?;
    if measured.len() != time.len() {
        let found = format!("{} values of `{data}` beside {} times", measured.len(), time.len());
        return Err(("data", (found, "as many values as times".into())));
    }
    let values: Vec<f64> = measured.iter().map(|x| given.factor * x).collect();
    let class = given.cfc.map(|number| {
        let class = u32::try_from(number).ok().and_then(Cfc::of);
        class.ok_or_else(|| ("cfc", (number.to_string(), "60, 180, 600 or 1000".to_owned())))
    });
    let class = class.transpose()?;
    let robust = shaped(time, without_spikes(&values), class)?;
    let values = shaped(time, values, class)?;
    let sigma = match &given.sigma {
        Some(sigma) => sigma.in_unit(unit).map_err(|fault| ("sigma", fault))?,
        None => {
            let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let low = values.iter().copied().fold(f64::INFINITY, f64::min);
            UNKNOWN * if high > low { high - low } else { 1.0 }
        }
    };
    if sigma <= 0.0 {
        let expected = "a standard deviation above zero".to_owned();
        return Err(("sigma", (sigma.to_string(), expected)));
    }
    let channel = Channel {
        name: named.name.clone(),
        column_name: given.column.clone(),
        column,
        unit: unit.into(),
        sigma,
        class,
        measured: values,
    };
    Ok((channel, robust))
}

/// Measured values in a channel frequency class, if there is one.
fn shaped(time: &[f64], values: Vec<f64>, class: Option<Cfc>) -> Result<Vec<f64>, Wrong> {
    let Some(class) = class else { return Ok(values) };
    let curve = Curve { time: time.to_vec(), values };
    let filtered = curve.filtered(class).map_err(|error| {
        let why = match error {
            ShockError::Coarse { what, needed, rate } => format!(
                "a record with {rate:.0} samples per second, where {what} needs {needed:.0}"
            ),
            other => format!("a record that cannot be filtered ({other})"),
        };
        ("cfc", (why, "a record with more samples per second, or a lower class".to_owned()))
    })?;
    Ok(filtered.sampled(time, 0.0))
}
