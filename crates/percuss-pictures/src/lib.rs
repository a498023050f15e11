//! Pictures of a finished run without a browser: films of its scene, stills, figures for print.
//!
//! The scene is drawn by the scripts of the page themselves, run by a JavaScript engine in this process, so that it looks the same everywhere and
//! has one implementation. The scripts produce SVG; all further steps are in Rust: pixels, GIF, animated PNG, PDF, and raw frames for ffmpeg.
//! Without the feature `drawing` all drawing functions return an error, and the crate compiles in seconds.

#[cfg(not(feature = "drawing"))]
mod absent;
#[cfg(feature = "drawing")]
mod animation;
#[cfg(feature = "drawing")]
mod apng;
mod error;
mod ffmpeg;
#[cfg(feature = "drawing")]
mod film;
#[cfg(feature = "drawing")]
mod font;
#[cfg(feature = "drawing")]
mod gif;
mod mark;
#[cfg(feature = "drawing")]
mod mp4;
#[cfg(feature = "drawing")]
mod pdf;
#[cfg(feature = "drawing")]
mod pixels;
#[cfg(feature = "drawing")]
mod print;
mod request;

#[cfg(not(feature = "drawing"))]
pub use absent::{Film, animate, picture};
#[cfg(feature = "drawing")]
pub use animation::animate;
pub use error::Error;
pub use ffmpeg::{ffmpeg, no_ffmpeg};
#[cfg(feature = "drawing")]
pub use film::Film;
pub use mark::{is_ours, marked, put};
pub use percuss_output::unfinished;
#[cfg(feature = "drawing")]
pub use print::picture;
pub use request::{FilmOutcome, Format, Look, Plan, PrintFormat};
