//! What can be asked for.

use std::path::{Path, PathBuf};

/// How the scene is to be drawn.
#[derive(Clone, Debug)]
pub struct Look {
    /// Width \[pixels\]; the height follows from the scene.
    pub width: u32,
    /// A line above the scene; may be empty.
    pub title: String,
    /// What colours stand for, as on the page.
    pub colour: String,
    /// Diagram along the beams, as on the page.
    pub diagram: String,
    /// Displacements are drawn so many times as large.
    pub exaggeration: f64,
    /// Light on dark.
    pub dark: bool,
}

/// File format of a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// 255 colours, shown anywhere.
    Gif,
    /// All colours, shown by browsers.
    Apng,
    /// For slides; made by ffmpeg.
    Mp4,
}

impl Format {
    /// By the ending of a file's name.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "gif" => Some(Self::Gif),
            "apng" | "png" => Some(Self::Apng),
            "mp4" => Some(Self::Mp4),
            _ => None,
        }
    }
}

/// What is shown, and how fast.
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
    /// Letters are outlines, so that it looks the same anywhere.
    Svg,
    /// The same for LaTeX and word processors.
    Pdf,
    /// Pixels.
    Png,
}

impl PrintFormat {
    /// Its name, which files end with.
    pub fn name(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Pdf => "pdf",
            Self::Png => "png",
        }
    }
}
