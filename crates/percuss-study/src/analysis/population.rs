//! A result over the runs of a study, with the counts that its shares are of.

use super::spread::Spread;
use crate::column::Table;
use crate::study::{OPEN, Study};

/// The values of a result, and the runs that they come from.
///
/// Where a study is arranged for Sobol indices only the two runs of each point that are drawn independently count: the others
/// share values with them.
#[derive(Clone, Debug, PartialEq)]
pub struct Population {
    /// Runs looked at.
    pub runs: usize,
    /// Those that completed.
    pub completed: usize,
    /// How the values of those are spread that completed and have one; `None` if none has.
    pub spread: Option<Spread>,
    /// Of those that completed with a contact closed that leaves the result open: what it has come to by the end, in ascending order, shape
    /// (runs left open) \[SI unit of the result\].
    pub open: Vec<f64>,
    /// How the least values are spread: those of runs that settle it, and of those that leave open how far it grows; `None` if there is none.
    pub least: Option<Spread>,
}

impl Population {
    /// The values of a result; `None` if the table has no such column of numbers.
    pub fn of(study: &Study, table: &Table, result: &str) -> Option<Self> {
        let values = table.numbers(result)?;
        let status = table.texts("status").unwrap_or_default();
        let group = study.parameters().len() + 2;
        let counts = |row: &usize| !study.has_sobol_indices() || row % group < 2;
        let rows: Vec<usize> = (0..values.len()).filter(counts).collect();
        let done = |row: &&usize| status.get(**row).is_none_or(|status| status == "completed");
        let completed: Vec<f64> = rows.iter().filter(done).map(|row| values[*row]).collect();
        let open = table.numbers(&format!("{OPEN}{result}")).unwrap_or_default();
        let open_at = |row: &usize| open.get(*row).copied().unwrap_or(f64::NAN);
        let least: Vec<f64> = (rows.iter().filter(done).zip(&completed))
            .map(|(row, value)| if value.is_nan() { open_at(row) } else { *value })
            .collect();
        let open: Vec<f64> = rows.iter().filter(done).map(open_at).collect();
        let mut open: Vec<f64> = open.into_iter().filter(|value| value.is_finite()).collect();
        open.sort_by(f64::total_cmp);
        let (runs, spread) = (rows.len(), Spread::of(&completed));
        let least = Spread::of(&least);
        Some(Self { runs, completed: completed.len(), spread, open, least })
    }

    /// Runs that completed and have a value.
    pub fn with_value(&self) -> usize {
        self.spread.as_ref().map_or(0, |spread| spread.count)
    }

    /// How many completed runs have the result above `x`: at least, and at most. They differ by the runs that leave it open and have not come so
    /// far by their end.
    pub fn above(&self, x: f64) -> [usize; 2] {
        let least = self.least.as_ref().map_or(0, |spread| spread.above(x));
        [least, least + self.open.partition_point(|value| *value <= x)]
    }

    /// The three counts in words; empty where they are the same.
    pub fn counts(&self) -> String {
        let (runs, completed, valued) = (self.runs, self.completed, self.with_value());
        if valued == runs && self.open.is_empty() {
            return String::new();
        }
        let open = match self.open.len() {
            0 => String::new(),
            n => format!(", {n} in contact at their end"),
        };
        format!("{runs} runs, {completed} completed, {valued} of them with a value{open}")
    }
}
