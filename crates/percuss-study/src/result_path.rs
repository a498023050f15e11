//! Where a result of a study comes from: the summary of its run, or a column of its history.

use percuss::{Fault, Model, RunSummary, Settings};
use percuss_batch::{ColumnSample, ColumnValue, Detail, simulate_batch, simulate_with_columns};
use percuss_output::{SummaryPath, pick};

/// Where a result comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum ResultPath {
    /// A number of the summary.
    Summary(SummaryPath),
    /// A number taken from a column of the history.
    Column(ColumnPath),
}

/// A number taken from a column of the history.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnPath {
    /// The number.
    pub sample: ColumnSample,
    /// Unit of the column.
    pub unit: &'static str,
    /// The number in words.
    text: String,
}

impl ColumnPath {
    /// A number taken from a column with this unit.
    pub fn new(sample: ColumnSample, unit: &'static str) -> Self {
        let column = &sample.column;
        let text = match sample.taken {
            ColumnValue::At(time) => format!("{column} at {time} s"),
            ColumnValue::Largest { from, to } => {
                format!("largest {column} from {from} s to {to} s")
            }
            ColumnValue::Smallest { from, to } => {
                format!("smallest {column} from {from} s to {to} s")
            }
        };
        Self { sample, unit, text }
    }
}

impl ResultPath {
    /// The path in the summary as given, or the number of a column in words.
    pub fn path(&self) -> &str {
        match self {
            Self::Summary(path) => path.path(),
            Self::Column(column) => &column.text,
        }
    }

    /// SI unit.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Summary(path) => path.unit(),
            Self::Column(column) => column.unit,
        }
    }

    /// Its path in the summary, if it comes from there.
    pub fn summary(&self) -> Option<&SummaryPath> {
        match self {
            Self::Summary(path) => Some(path),
            Self::Column(_) => None,
        }
    }

    /// The number of a column, if it comes from there.
    pub fn column(&self) -> Option<&ColumnSample> {
        match self {
            Self::Summary(_) => None,
            Self::Column(column) => Some(&column.sample),
        }
    }

    /// Whether a contact that is still closed at the end leaves it open.
    pub(crate) fn may_stay_open(&self) -> bool {
        self.summary().is_some_and(SummaryPath::may_stay_open)
    }

    /// Whether it can only grow while a contact stays closed.
    pub(crate) fn only_grows(&self) -> bool {
        self.summary().is_some_and(SummaryPath::only_grows)
    }

    /// Its value at the end of a run that leaves it open.
    pub(crate) fn open_value(&self, run: &RunSummary) -> f64 {
        self.summary().map_or(f64::NAN, |path| path.open_value(run))
    }
}

/// A run and the numbers taken from columns of its history.
#[derive(Debug)]
pub(crate) struct Made {
    pub summary: RunSummary,
    /// Numbers taken from columns, shape (results that come from columns) \[SI unit of the column\].
    pub columns: Vec<f64>,
}

impl Made {
    /// The results at these paths, shape (results).
    pub fn pick(&self, paths: &[ResultPath]) -> Vec<f64> {
        let of_summary: Vec<SummaryPath> =
            paths.iter().filter_map(|path| path.summary().cloned()).collect();
        merged(paths, &pick(&of_summary, &self.summary), &self.columns)
    }
}

/// Results in the order of their paths, from those of the summary and those of columns, shape (results).
pub(crate) fn merged<T: Clone>(paths: &[ResultPath], summary: &[T], columns: &[T]) -> Vec<T> {
    let (mut summary, mut columns) = (summary.iter(), columns.iter());
    let next = |path: &ResultPath| match path {
        ResultPath::Summary(_) => summary.next().cloned(),
        ResultPath::Column(_) => columns.next().cloned(),
    };
    paths.iter().filter_map(next).collect()
}

/// The numbers of columns among results, shape (results that come from columns).
pub(crate) fn samples(paths: &[ResultPath]) -> Vec<ColumnSample> {
    paths.iter().filter_map(|path| path.column().cloned()).collect()
}

/// Simulates runs as far as results need: in SIMD batches, or each alone with the columns of its history.
pub(crate) fn make(
    runs: &[(&Model, &Settings)],
    detail: Detail,
    samples: &[ColumnSample],
) -> Vec<Result<Made, Vec<Fault>>> {
    if samples.is_empty() {
        let made = |summary| Made { summary, columns: Vec::new() };
        return simulate_batch(runs, detail).into_iter().map(|one| one.map(made)).collect();
    }
    let alone = |(model, settings): &(&Model, &Settings)| {
        let (summary, columns) = simulate_with_columns(model, settings, samples)?;
        Ok(Made { summary, columns })
    };
    runs.iter().map(alone).collect()
}
