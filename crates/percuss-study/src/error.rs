//! What can go wrong with the files of a study.

use std::fmt;
use std::path::Path;

/// A file of a study that cannot be read, written or used.
#[derive(Debug)]
pub struct Error {
    message: String,
    unfit: bool,
}

impl Error {
    /// The system refused.
    pub(crate) fn io(path: &Path, what: &str, source: impl fmt::Display) -> Self {
        let message = format!("cannot {what} {}: {source}", path.display());
        Self { message, unfit: false }
    }

    /// What is there is not what it should be; says what to do.
    pub(crate) fn unfit(message: impl Into<String>) -> Self {
        Self { message: message.into(), unfit: true }
    }

    /// Whether the user gave something that does not fit, such as the directory of another study.
    pub fn is_unfit(&self) -> bool {
        self.unfit
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}
