//! The same scenario under other restitution coefficients: total energy over time.

use std::fmt::Write as _;
use std::path::Path;

use crate::csv_text;
use crate::error::Error;
use crate::files;
use crate::history::History;
use crate::report::decimate;

const COMPARISON: &str = "comparison.csv";
const HEADER: &str = "series,time,energy_total";
/// Bins of a series on disk; longer ones are kept as the extremes of so many bins.
const BINS: usize = 2000;

/// One run of a comparison.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ComparisonSeries {
    /// What distinguishes it, for instance `restitution 0.5`.
    pub label: String,
    /// Times, shape (rows) \[s\].
    pub time: Vec<f64>,
    /// Total energy at these times, shape (rows) \[J\].
    pub energy: Vec<f64>,
}

impl ComparisonSeries {
    /// The total energy of a run, or `None` if its history has no such column.
    pub fn from_history(label: impl Into<String>, history: &History) -> Option<Self> {
        Some(Self {
            label: label.into(),
            time: history.column("time")?.to_vec(),
            energy: history.column("energy.total")?.to_vec(),
        })
    }
}

/// Writes `comparison.csv` into `dir`; long series as the extremes of 2000 bins.
///
/// # Errors
/// If the file cannot be written.
pub fn write_comparison(dir: impl AsRef<Path>, series: &[ComparisonSeries]) -> Result<(), Error> {
    let mut text = format!("{HEADER}\n");
    for one in series {
        let label = csv_text::quote(&one.label);
        let mut numbers = (zmij::Buffer::new(), zmij::Buffer::new());
        for row in decimate::rows(&[&one.energy], one.time.len(), BINS) {
            let time = numbers.0.format(one.time[row]);
            let energy = numbers.1.format(one.energy[row]);
            let _ = writeln!(text, "{label},{time},{energy}"); // a String never fails
        }
    }
    files::write(&dir.as_ref().join(COMPARISON), text.as_bytes())
}

/// Reads `comparison.csv` in `dir`; nothing if there is none.
///
/// # Errors
/// If the file is damaged.
pub fn read_comparison(dir: impl AsRef<Path>) -> Result<Vec<ComparisonSeries>, Error> {
    let mut all: Vec<ComparisonSeries> = Vec::new();
    let path = dir.as_ref().join(COMPARISON);
    csv_text::for_each_named(&path, HEADER, |label, [time, energy]| {
        if all.last().is_none_or(|last| last.label != label) {
            all.push(ComparisonSeries { label: label.to_owned(), ..Default::default() });
        }
        if let Some(series) = all.last_mut() {
            series.time.push(time);
            series.energy.push(energy);
        }
    })?;
    Ok(all)
}
