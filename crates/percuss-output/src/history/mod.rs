//! The history of a run: one row a recorded step, one column a channel.

mod channel;
mod csv;
mod parquet;
mod source;
mod writer;

use std::path::Path;

pub use channel::{Channel, History};
pub use source::{HistoryReader, HistorySource};
pub use writer::{HistoryFile, HistoryFormat, HistoryWriter};

use crate::error::Error;

/// Reads the whole history in `dir` into memory, from `history.parquet` or else from `history.csv`.
///
/// # Errors
/// If there is neither, or if the file is damaged.
pub fn read(dir: impl AsRef<Path>) -> Result<History, Error> {
    HistoryReader::open(dir)?.read()
}
