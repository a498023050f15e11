//! Errors of pictures.

use std::fmt;
use std::path::Path;

#[cfg(feature = "drawing")]
use percuss_codes::RequestCode;
use percuss_codes::{Code, FileCode};

/// Error in the production of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    text: String,
    code: Code,
    input: bool,
}

impl Error {
    #[cfg(feature = "drawing")]
    pub(crate) fn io(path: &Path, doing: &str, source: &std::io::Error) -> Self {
        let text = format!("{}: cannot {doing}: {source}", path.display());
        Self { text, code: FileCode::System.into(), input: false }
    }

    /// The drawing library failed on content that well-formed input does not produce.
    #[cfg(feature = "drawing")]
    pub(crate) fn drawing(reason: impl fmt::Display) -> Self {
        Self::failed(format!("the picture cannot be drawn: {reason}"))
    }

    /// The same with the text of the program that failed.
    #[cfg(feature = "drawing")]
    pub(crate) fn failed(text: String) -> Self {
        Self { text, code: FileCode::Drawing.into(), input: false }
    }

    /// The shapes of the run are invalid.
    #[cfg(feature = "drawing")]
    pub(crate) fn content(text: impl Into<String>) -> Self {
        Self { text: text.into(), code: FileCode::Content.into(), input: true }
    }

    /// The request exceeds the limits of the file format.
    #[cfg(feature = "drawing")]
    pub(crate) fn beyond(text: impl Into<String>) -> Self {
        Self { text: text.into(), code: RequestCode::PictureBounds.into(), input: true }
    }

    /// MP4 was requested without ffmpeg.
    pub(crate) fn no_ffmpeg() -> Self {
        let text = "MP4 is made by ffmpeg, which is not on the PATH; install it, or give a name that ends with .gif or .apng, which need \
                    nothing else";
        Self { text: text.into(), code: FileCode::Ffmpeg.into(), input: true }
    }

    /// This build has no graphics support.
    #[cfg(not(feature = "drawing"))]
    pub(crate) fn not_built() -> Self {
        let text = "this build has no graphics support; install with cargo install --path crates/percuss-cli";
        Self { text: text.into(), code: FileCode::Drawing.into(), input: true }
    }

    /// The same error with its place.
    pub fn at(self, place: &Path) -> Self {
        Self { text: format!("{}: {}", place.display(), self.text), ..self }
    }

    /// Its code in the catalogue.
    pub fn code(&self) -> Code {
        self.code
    }

    /// Whether the request or its input is invalid; otherwise an I/O error occurred, or drawing failed.
    pub fn is_input(&self) -> bool {
        self.input
    }
}

impl From<percuss_output::Error> for Error {
    fn from(error: percuss_output::Error) -> Self {
        let input = error.is_refused() || error.is_content();
        Self { text: error.to_string(), code: error.code().into(), input }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl std::error::Error for Error {}
