//! The one error type of files.

use std::fmt;
use std::path::{Path, PathBuf};

use percuss_codes::FileCode;

/// Why a file or directory could not be written or read.
#[derive(Debug)]
pub struct Error {
    path: PathBuf,
    reason: String,
    code: FileCode,
}

impl Error {
    /// The system said no while `doing` something (`write`, `rename`).
    pub(crate) fn io(path: impl AsRef<Path>, doing: &str, source: impl fmt::Display) -> Self {
        Self {
            path: path.as_ref().to_owned(),
            reason: format!("cannot {doing}: {source}"),
            code: FileCode::System,
        }
    }

    /// The file is not what it should be.
    pub(crate) fn content(path: impl AsRef<Path>, reason: impl Into<String>) -> Self {
        Self::of(FileCode::Content, path, reason)
    }

    /// Going on would destroy something.
    pub(crate) fn refused(path: impl AsRef<Path>, reason: impl Into<String>) -> Self {
        Self::of(FileCode::Foreign, path, reason)
    }

    /// Anything else of the catalogue.
    pub(crate) fn of(code: FileCode, path: impl AsRef<Path>, reason: impl Into<String>) -> Self {
        Self { path: path.as_ref().to_owned(), reason: reason.into(), code }
    }

    /// The file or directory concerned.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Its code in the catalogue.
    pub fn code(&self) -> FileCode {
        self.code
    }

    /// Whether an output directory was refused: it holds something else than a run, or another process writes into it.
    pub fn is_refused(&self) -> bool {
        self.code.is_refused()
    }

    /// Whether a file was read but is not what it should be.
    pub fn is_content(&self) -> bool {
        self.code.is_content()
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path.display(), self.reason)
    }
}

impl std::error::Error for Error {}
