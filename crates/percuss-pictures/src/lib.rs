//! Pictures of a finished run without a browser: films of its scene, stills, figures for print.
//!
//! The scene is drawn by the scripts of the page themselves, run by a JavaScript engine in this process, so that it looks the same
//! everywhere and is written once. They give SVG; from there on everything is Rust: pixels, GIF, animated PNG, PDF, and raw frames
//! for ffmpeg.

mod animation;
mod apng;
mod error;
mod film;
mod font;
mod gif;
mod mark;
mod mp4;
mod pdf;
mod pixels;
mod print;

pub use animation::{Format, Plan, Told, animate, no_ffmpeg};
pub use error::Error;
pub use film::{Film, Look};
pub use mark::{is_ours, marked, put, unfinished};
pub use mp4::ffmpeg;
pub use print::{PrintFormat, picture};
