//! What can go wrong with the files of a study.

use std::fmt;
use std::path::Path;

use percuss_codes::{Code, FileCode, RequestCode};

/// A file of a study that cannot be read, written or used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    message: String,
    code: Code,
    unfit: bool,
}

impl Error {
    /// The system refused.
    pub(crate) fn io(path: &Path, what: &str, source: impl fmt::Display) -> Self {
        Self::system(format!("cannot {what} {}: {source}", path.display()))
    }

    /// The same for errors of the operating system.
    pub(crate) fn system(message: impl Into<String>) -> Self {
        Self { message: message.into(), code: FileCode::System.into(), unfit: false }
    }

    /// What is there is not what it should be; says what to do.
    pub(crate) fn unfit(code: RequestCode, message: impl Into<String>) -> Self {
        Self { message: message.into(), code: code.into(), unfit: true }
    }

    /// The same fault, of something at a place.
    pub(crate) fn at(self, place: &Path) -> Self {
        Self { message: format!("{}: {}", place.display(), self.message), ..self }
    }

    /// Its code in the catalogue.
    pub fn code(&self) -> Code {
        self.code
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
