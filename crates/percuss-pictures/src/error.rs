//! Why there is no picture.

use std::fmt;
use std::path::Path;

/// Why a picture could not be made.
#[derive(Debug)]
pub enum Error {
    /// What was asked for cannot be had.
    Input(String),
    /// The system refused.
    System(String),
}

impl Error {
    pub(crate) fn io(path: &Path, doing: &str, source: &std::io::Error) -> Self {
        Self::System(format!("{}: cannot {doing}: {source}", path.display()))
    }

    /// A fault of a library that well-formed input does not meet.
    pub(crate) fn drawing(reason: impl fmt::Display) -> Self {
        Self::System(format!("the picture cannot be drawn: {reason}"))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(text) | Self::System(text) => f.write_str(text),
        }
    }
}

impl std::error::Error for Error {}
