//! A recorder that keeps all rows.

use percuss::*;

type Failed = Box<dyn std::error::Error + Send + Sync>;

/// Rows of a run, and its columns by name.
#[derive(Default)]
pub struct Rows {
    pub names: Vec<String>,
    pub rows: Vec<Vec<f64>>,
}

impl Recorder for Rows {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), Failed> {
        self.names = channels.iter().map(|c| c.name.clone()).collect();
        Ok(())
    }

    fn row(&mut self, row: &[f64]) -> Result<(), Failed> {
        self.rows.push(row.to_vec());
        Ok(())
    }
}

impl Rows {
    pub fn column(&self, name: &str) -> Vec<f64> {
        let k = self.names.iter().position(|n| n == name).unwrap_or_else(|| panic!("no {name}"));
        self.rows.iter().map(|r| r[k]).collect()
    }

    pub fn of(model: &Model, settings: &Settings) -> (Self, RunSummary) {
        let mut rows = Self::default();
        let summary = simulate(model, settings, &mut rows).unwrap();
        assert!(matches!(summary.termination, Termination::Completed), "{:?}", summary.termination);
        (rows, summary)
    }
}
