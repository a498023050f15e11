//! Requests for pictures and films.

use std::path::{Path, PathBuf};

/// Appearance of the scene.
#[derive(Clone, Debug)]
pub struct Look {
    /// Width \[pixels\]; the height follows from the scene.
    pub width: u32,
    /// A line above the scene; may be empty.
    pub title: String,
    /// Quantity shown by colours, as on the page.
    pub colour: String,
    /// Diagram along the beams, as on the page.
    pub diagram: String,
    /// Deformation scale.
    pub exaggeration: f64,
    /// Whether to draw light lines on a dark page.
    pub dark: bool,
}

/// File format of a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// 255 colours, supported everywhere.
    Gif,
    /// All colours, supported by browsers.
    Apng,
    /// For slides; written by ffmpeg.
    Mp4,
}

impl Format {
    /// The format for the extension of a file name.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "gif" => Some(Self::Gif),
            "apng" | "png" => Some(Self::Apng),
            "mp4" => Some(Self::Mp4),
            _ => None,
        }
    }
}

/// Interval, number and rate of the frames of a film.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// File format.
    pub format: Format,
    /// First and last time of the run, shape (2) \[s\].
    pub span: [f64; 2],
    /// Number of frames, at least 2.
    pub frames: usize,
    /// Frames a second.
    pub fps: f64,
}

impl Plan {
    /// Times of the frames, evenly spaced.
    #[cfg(feature = "drawing")]
    pub(crate) fn times(&self) -> Vec<f64> {
        let [from, to] = self.span;
        let last = (self.frames.max(2) - 1) as f64;
        (0..self.frames.max(2)).map(|k| from + (to - from) * (k as f64 / last)).collect()
    }
}

/// Outcome of a film.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FilmOutcome {
    /// The film is written.
    Done {
        /// Path to which a file was moved that somebody else wrote at the same place meanwhile.
        kept: Option<PathBuf>,
    },
    /// Drawing was stopped; no file is left.
    Stopped,
}

/// File format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PrintFormat {
    /// SVG with letters as outlines, so that it looks the same everywhere.
    Svg,
    /// PDF with letters as outlines, for LaTeX and word processors.
    Pdf,
    /// Pixels.
    Png,
}

impl PrintFormat {
    /// Its name, the extension of file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Pdf => "pdf",
            Self::Png => "png",
        }
    }
}
