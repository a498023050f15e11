//! Rows to a file while the run steps.

use std::io::BufWriter;
use std::path::{Path, PathBuf};

use percuss::{Channel, Recorder, RecorderError};

use super::channel::{CSV, PARQUET};
use super::csv::CsvSink;
use super::parquet::{self, ParquetSink};
use crate::error::Error;
use crate::files::Growing;

/// File format of a history.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HistoryFormat {
    /// `history.parquet`: compact, typed, units inside.
    #[default]
    Parquet,
    /// `history.csv` with `history.units.json` beside it.
    Csv,
}

/// A finished history file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HistoryFile {
    /// The file.
    pub path: PathBuf,
    /// Rows in it.
    pub rows: usize,
}

/// Writes a history row by row; memory does not grow with the number of rows.
///
/// The file has a temporary name until [`HistoryWriter::finish`]. Dropped without it, what was
/// recorded so far is still finished if the disk allows, errors being lost.
#[derive(Debug)]
pub struct HistoryWriter {
    path: PathBuf,
    format: HistoryFormat,
    scenario: String,
    sink: Option<(Sink, Growing)>,
    rows: usize,
}

#[derive(Debug)]
enum Sink {
    Parquet(ParquetSink),
    Csv(CsvSink),
}

impl HistoryWriter {
    /// A writer of a history in `dir`; `scenario` is the text stored beside the numbers (Parquet).
    pub fn new(dir: impl AsRef<Path>, format: HistoryFormat, scenario: impl Into<String>) -> Self {
        let name = match format {
            HistoryFormat::Parquet => PARQUET,
            HistoryFormat::Csv => CSV,
        };
        let path = dir.as_ref().join(name);
        Self { path, format, scenario: scenario.into(), sink: None, rows: 0 }
    }

    /// Completes the file and gives it its name. Without any row there is no file, and `None`.
    ///
    /// # Errors
    /// If the last rows cannot be written or the file not renamed.
    pub fn finish(mut self) -> Result<Option<HistoryFile>, Error> {
        self.close()
    }

    fn close(&mut self) -> Result<Option<HistoryFile>, Error> {
        let Some((sink, growing)) = self.sink.take() else { return Ok(None) };
        if self.rows == 0 {
            drop(sink);
            growing.remove();
            return Ok(None);
        }
        let closed = match sink {
            Sink::Parquet(sink) => sink.close().map_err(|e| parquet::reason(&e)),
            Sink::Csv(sink) => sink.close().map_err(|e| e.to_string()),
        };
        closed.map_err(|source| Error::io(&self.path, "write", source))?;
        growing.put()?;
        Ok(Some(HistoryFile { path: self.path.clone(), rows: self.rows }))
    }

    fn open(&mut self, channels: &[Channel]) -> Result<(), Error> {
        let fault = |source: &dyn std::fmt::Display| Error::io(&self.path, "create", source);
        let (growing, file) = Growing::new(&self.path).map_err(|e| fault(&e))?;
        let channels: Vec<super::Channel> = channels.iter().map(Into::into).collect();
        let sink = match self.format {
            HistoryFormat::Parquet => Sink::Parquet(
                ParquetSink::new(file, &channels, &self.scenario)
                    .map_err(|e| fault(&parquet::reason(&e)))?,
            ),
            HistoryFormat::Csv => {
                super::csv::write_units(&self.path, &channels)?;
                Sink::Csv(CsvSink::new(BufWriter::new(file), &channels).map_err(|e| fault(&e))?)
            }
        };
        self.sink = Some((sink, growing));
        self.rows = 0;
        Ok(())
    }
}

impl Recorder for HistoryWriter {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        Ok(self.open(channels)?)
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        let written = match &mut self.sink {
            Some((Sink::Parquet(sink), _)) => sink.row(values).map_err(|e| parquet::reason(&e)),
            Some((Sink::Csv(sink), _)) => sink.row(values).map_err(|e| e.to_string()),
            None => Err("a row came before the channels".to_owned()),
        };
        written.map_err(|source| Error::io(&self.path, "write", source))?;
        self.rows += 1;
        Ok(())
    }
}

impl Drop for HistoryWriter {
    fn drop(&mut self) {
        let _ = self.close();
    }
}
