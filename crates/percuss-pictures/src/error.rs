//! Why there is no picture.

use std::fmt;
use std::path::Path;

#[cfg(feature = "drawing")]
use percuss_codes::RequestCode;
use percuss_codes::{Code, FileCode};

/// Why a picture could not be made.
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

    /// What makes the picture gave up on what well-formed input does not bring.
    #[cfg(feature = "drawing")]
    pub(crate) fn drawing(reason: impl fmt::Display) -> Self {
        Self::gave_up(format!("the picture cannot be drawn: {reason}"))
    }

    /// The same, told by what gave up.
    #[cfg(feature = "drawing")]
    pub(crate) fn gave_up(text: String) -> Self {
        Self { text, code: FileCode::Drawing.into(), input: false }
    }

    /// The shapes of the run are not what they should be.
    #[cfg(feature = "drawing")]
    pub(crate) fn content(text: impl Into<String>) -> Self {
        Self { text: text.into(), code: FileCode::Content.into(), input: true }
    }

    /// What was asked for is beyond what its format can hold.
    #[cfg(feature = "drawing")]
    pub(crate) fn beyond(text: impl Into<String>) -> Self {
        Self { text: text.into(), code: RequestCode::PictureBounds.into(), input: true }
    }

    /// MP4 was asked for.
    pub(crate) fn no_ffmpeg() -> Self {
        let text = "MP4 is made by ffmpeg, which is not on the PATH; install it, or give a name that ends with .gif or .apng, which need \
                    nothing else";
        Self { text: text.into(), code: FileCode::Ffmpeg.into(), input: true }
    }

    /// This build does not draw.
    #[cfg(not(feature = "drawing"))]
    pub(crate) fn not_built() -> Self {
        let text = "this build has no graphics support; install with cargo install --path crates/percuss-cli";
        Self { text: text.into(), code: FileCode::Drawing.into(), input: true }
    }

    /// The same fault, of something at a place.
    pub fn at(self, place: &Path) -> Self {
        Self { text: format!("{}: {}", place.display(), self.text), ..self }
    }

    /// Its code in the catalogue.
    pub fn code(&self) -> Code {
        self.code
    }

    /// Whether what was asked for cannot be had; else the system refused, or what draws gave up.
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
