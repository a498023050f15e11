//! Histories that are looked at piece by piece, so that memory does not grow with their length.

use std::path::{Path, PathBuf};

use super::channel::{CSV, Channel, History, PARQUET};
use super::writer::HistoryFormat;
use super::{csv, parquet};
use crate::error::Error;

/// Where a report finds its rows.
#[derive(Clone, Debug)]
pub enum HistorySource {
    /// In memory.
    Memory(History),
    /// In a file, read piece by piece.
    File(HistoryReader),
}

impl Default for HistorySource {
    fn default() -> Self {
        Self::Memory(History::default())
    }
}

impl From<History> for HistorySource {
    fn from(history: History) -> Self {
        Self::Memory(history)
    }
}

impl HistorySource {
    /// The columns' names and units.
    pub fn channels(&self) -> &[Channel] {
        match self {
            Self::Memory(history) => &history.channels,
            Self::File(file) => &file.channels,
        }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        match self {
            Self::Memory(history) => history.columns.iter().map(Vec::len).min().unwrap_or(0),
            Self::File(file) => file.rows,
        }
    }

    /// Name of the file; empty if there is none.
    pub(crate) fn name(&self) -> &str {
        match self {
            Self::Memory(history) => &history.source,
            Self::File(file) => file.name(),
        }
    }

    /// Index of the channel called `name`.
    pub(crate) fn position(&self, name: &str) -> Option<usize> {
        self.channels().iter().position(|c| c.name == name)
    }

    /// Hands the `wanted` columns to `visit`, some thousand rows at a time, in order.
    pub(crate) fn scan(
        &self,
        wanted: &[usize],
        visit: &mut dyn FnMut(&[&[f64]]),
    ) -> Result<(), Error> {
        match self {
            Self::Memory(history) => {
                let rows = self.rows();
                let columns: Vec<&[f64]> =
                    wanted.iter().map(|&k| &history.columns[k][..rows]).collect();
                visit(&columns);
                Ok(())
            }
            Self::File(file) => file.scan(wanted, visit),
        }
    }
}

/// A history file: its columns and its length are known, its rows are on disk.
#[derive(Clone, Debug)]
pub struct HistoryReader {
    path: PathBuf,
    format: HistoryFormat,
    /// The columns' names and units, shape (channels).
    pub(super) channels: Vec<Channel>,
    rows: usize,
}

impl HistoryReader {
    /// Opens the history in `dir`, `history.parquet` or else `history.csv`.
    ///
    /// # Errors
    /// If there is neither, or if what says the columns and the length is damaged.
    pub fn open(dir: impl AsRef<Path>) -> Result<Self, Error> {
        let dir = dir.as_ref();
        let (parquet, csv) = (dir.join(PARQUET), dir.join(CSV));
        let (path, format) = if parquet.is_file() {
            (parquet, HistoryFormat::Parquet)
        } else if csv.is_file() {
            (csv, HistoryFormat::Csv)
        } else {
            let reason = "contains no history (neither history.parquet nor history.csv)";
            return Err(Error::content(dir, reason));
        };
        let (channels, rows) = match format {
            HistoryFormat::Parquet => parquet::open(&path)?,
            HistoryFormat::Csv => csv::open(&path)?,
        };
        Ok(Self { path, format, channels, rows })
    }

    /// Columns by their names, shape (n_names, n_rows); no other is read.
    ///
    /// # Errors
    /// If there is no such column, or the file is damaged.
    pub fn columns(&self, names: &[&str]) -> Result<Vec<Vec<f64>>, Error> {
        let position = |name: &&str| {
            let found = self.channels.iter().position(|channel| channel.name == *name);
            found.ok_or_else(|| Error::content(&self.path, format!("has no column {name}")))
        };
        self.gather(&names.iter().map(position).collect::<Result<Vec<_>, _>>()?)
    }

    /// Columns by their numbers, shape (numbers, rows).
    fn gather(&self, wanted: &[usize]) -> Result<Vec<Vec<f64>>, Error> {
        let mut columns: Vec<Vec<f64>> = vec![Vec::with_capacity(self.rows); wanted.len()];
        self.scan(wanted, &mut |piece| {
            columns.iter_mut().zip(piece).for_each(|(all, some)| all.extend_from_slice(some));
        })?;
        Ok(columns)
    }

    /// The columns' names and units.
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn name(&self) -> &'static str {
        match self.format {
            HistoryFormat::Parquet => PARQUET,
            HistoryFormat::Csv => CSV,
        }
    }

    fn scan(&self, wanted: &[usize], visit: &mut dyn FnMut(&[&[f64]])) -> Result<(), Error> {
        match self.format {
            HistoryFormat::Parquet => parquet::scan(&self.path, wanted, visit),
            HistoryFormat::Csv => csv::scan(&self.path, wanted, visit),
        }
    }

    /// All rows of all columns.
    pub(super) fn read(self) -> Result<History, Error> {
        let columns = self.gather(&(0..self.channels.len()).collect::<Vec<_>>())?;
        let source = self.name().to_owned();
        Ok(History { channels: self.channels, columns, source })
    }
}
