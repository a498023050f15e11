//! A result over the runs of a study, with the counts that its shares are of.

use super::spread::Spread;
use crate::column::Table;
use crate::study::Study;

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
        let (runs, spread) = (rows.len(), Spread::of(&completed));
        Some(Self { runs, completed: completed.len(), spread })
    }

    /// Runs that completed and have a value.
    pub fn with_value(&self) -> usize {
        self.spread.as_ref().map_or(0, |spread| spread.count)
    }

    /// The three counts in words; empty where they are the same.
    pub fn counts(&self) -> String {
        let (runs, completed, valued) = (self.runs, self.completed, self.with_value());
        if valued == runs {
            return String::new();
        }
        format!("{runs} runs, {completed} completed, {valued} of them with a value")
    }
}
