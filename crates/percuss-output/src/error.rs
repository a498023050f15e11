//! The one error type of files.

use std::fmt;
use std::path::{Path, PathBuf};

/// Why a file or directory could not be written or read.
#[derive(Debug)]
pub struct Error {
    path: PathBuf,
    reason: String,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Io,
    Content,
    Refused,
}

impl Error {
    /// The system said no while `doing` something (`write`, `rename`).
    pub(crate) fn io(path: impl AsRef<Path>, doing: &str, source: impl fmt::Display) -> Self {
        Self {
            path: path.as_ref().to_owned(),
            reason: format!("cannot {doing}: {source}"),
            kind: Kind::Io,
        }
    }

    /// The file is not what it should be.
    pub(crate) fn content(path: impl AsRef<Path>, reason: impl Into<String>) -> Self {
        Self { path: path.as_ref().to_owned(), reason: reason.into(), kind: Kind::Content }
    }

    /// Going on would destroy something.
    pub(crate) fn refused(path: impl AsRef<Path>, reason: impl Into<String>) -> Self {
        Self { path: path.as_ref().to_owned(), reason: reason.into(), kind: Kind::Refused }
    }

    /// The file or directory concerned.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether an output directory was refused because it holds something else than a run.
    pub fn is_refused(&self) -> bool {
        self.kind == Kind::Refused
    }

    /// Whether a file was read but is not what it should be.
    pub fn is_content(&self) -> bool {
        self.kind == Kind::Content
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path.display(), self.reason)
    }
}

impl std::error::Error for Error {}
