//! The rows of a run up to a checkpoint.

use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use percuss::RecorderError;
use percuss_codes::FileCode;
use sha2::{Digest, Sha256};

use super::format::{RowsMark, damaged};
use crate::error::Error;
use crate::history::{HistoryReader, read as read_history};
use crate::place::Place;

/// Rows appended to a file of plain doubles, in the order of bytes of all machines Percuss runs on (little-endian).
#[derive(Debug)]
pub(super) struct RowsFile {
    path: PathBuf,
    file: BufWriter<File>,
    bytes: u64,
    hash: Sha256,
    columns: usize,
}

impl RowsFile {
    /// An empty one.
    pub fn create(path: &Path) -> Result<Self, Error> {
        let created = Place::of(path).and_then(|place| place.create_new());
        let file = created.map_err(|e| Error::io(path, "create", e))?;
        Ok(Self::of(path, file, 0, Sha256::new(), 0))
    }

    /// The one of a checkpoint; rows behind it are cut off.
    pub fn go_on(path: &Path, mark: &RowsMark) -> Result<Self, Error> {
        let (bytes, expected) = mark.bytes.ok_or_else(|| damaged(path))?;
        let mut hash = Sha256::new();
        let opened = Place::of(path).and_then(|place| place.open(true));
        let mut file = opened.map_err(|e| Error::io(path, "open", e))?;
        let read = std::io::copy(&mut Read::by_ref(&mut file).take(bytes), &mut hash);
        let read = read.map_err(|e| Error::io(path, "read", e))?;
        if read != bytes || hash.clone().finalize().as_slice() != expected {
            return Err(damaged(path));
        }
        // Where it is read to, it is written on.
        file.set_len(bytes).map_err(|e| Error::io(path, "shorten", e))?;
        Ok(Self::of(path, file, bytes, hash, mark.columns))
    }

    fn of(path: &Path, file: File, bytes: u64, hash: Sha256, columns: usize) -> Self {
        Self { path: path.to_owned(), file: BufWriter::new(file), bytes, hash, columns }
    }

    pub fn append(&mut self, values: &[f64]) -> Result<(), Error> {
        self.columns = values.len();
        for value in values {
            let bytes = value.to_le_bytes();
            self.hash.update(bytes);
            self.file.write_all(&bytes).map_err(|e| Error::io(&self.path, "write", e))?;
        }
        self.bytes += 8 * values.len() as u64;
        Ok(())
    }

    /// Puts all on the disk; how far it goes now.
    pub fn settle(&mut self) -> Result<RowsMark, Error> {
        let settled = self.file.flush().and_then(|()| self.file.get_ref().sync_data());
        settled.map_err(|e| Error::io(&self.path, "write", e))?;
        let hash = self.hash.clone().finalize().into();
        Ok(RowsMark { columns: self.columns, bytes: Some((self.bytes, hash)) })
    }
}

/// The rows of a run up to a checkpoint, to be recorded once more.
#[derive(Debug)]
pub struct Rows(Source);

#[derive(Debug)]
enum Source {
    File { path: PathBuf, bytes: u64, columns: usize },
    History { dir: PathBuf, rows: usize },
}

impl Rows {
    pub(super) fn of_file(path: &Path, mark: &RowsMark) -> Self {
        let bytes = mark.bytes.map_or(0, |(bytes, _)| bytes);
        Self(Source::File { path: path.to_owned(), bytes, columns: mark.columns })
    }

    pub(super) fn of_history(dir: &Path, rows: usize) -> Self {
        Self(Source::History { dir: dir.to_owned(), rows })
    }

    /// Whether they stand in the history of a complete run, not beside a checkpoint.
    pub fn are_of_history(&self) -> bool {
        matches!(self.0, Source::History { .. })
    }

    /// Hands them to `row`, in their order; there are `columns` of them each.
    ///
    /// # Errors
    /// If they cannot be read or are not those of the run; what `row` says.
    pub fn replay(
        &self,
        columns: usize,
        row: &mut dyn FnMut(&[f64]) -> Result<(), RecorderError>,
    ) -> Result<(), RecorderError> {
        match &self.0 {
            Source::File { path, bytes, columns: written } => {
                let whole = *written == columns && bytes.is_multiple_of(8 * columns.max(1) as u64);
                if !whole {
                    return Err(damaged(path).into());
                }
                let file = File::open(path).map_err(|e| Error::io(path, "read", e))?;
                let mut file = BufReader::new(file);
                let (mut raw, mut values) = (vec![0; 8 * columns], vec![0.0; columns]);
                for _ in 0..bytes / (8 * columns.max(1) as u64) {
                    file.read_exact(&mut raw).map_err(|e| Error::io(path, "read", e))?;
                    for (value, bytes) in values.iter_mut().zip(raw.as_chunks().0) {
                        *value = f64::from_le_bytes(*bytes);
                    }
                    row(&values)?;
                }
                Ok(())
            }
            Source::History { dir, rows } => {
                let history = read_history(dir)?;
                if history.columns.len() != columns || history.rows() < *rows {
                    return Err(Error::of(
                        FileCode::Checkpoint,
                        dir,
                        "its history is not that of its checkpoint",
                    )
                    .into());
                }
                let mut values = vec![0.0; columns];
                for k in 0..*rows {
                    values.iter_mut().zip(&history.columns).for_each(|(v, column)| *v = column[k]);
                    row(&values)?;
                }
                Ok(())
            }
        }
    }

    /// Whether a history that may have been read is there at all.
    pub(super) fn has_history(dir: &Path) -> Result<(), Error> {
        HistoryReader::open(dir).map(|_| ())
    }
}
