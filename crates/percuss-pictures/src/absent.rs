//! Substitutes for the drawing functions in a build without graphics support: each returns an error.

use std::path::Path;

use percuss_output::fields::Fields;

use crate::error::Error;
use crate::request::{FilmOutcome, Look, Plan, PrintFormat};

/// A scene that can be drawn at any time; cannot be created in this build.
pub struct Film {
    /// Width and height, even numbers, shape (2) \[pixels\].
    pub size: [u32; 2],
    /// First and last time, shape (2) \[s\].
    pub whole: [f64; 2],
    /// Interval of time with a closed contact, with a margin; `None` without contact or with permanent contact, shape (2) \[s\].
    pub impact: Option<[f64; 2]>,
    /// Duration of the animation on the page \[s\].
    pub seconds: f64,
}

impl Film {
    /// # Errors
    /// Always: this build does not draw.
    pub fn open(_: &Fields, _: &Look) -> Result<Self, Error> {
        Err(Error::not_built())
    }

    /// # Errors
    /// Always: this build does not draw.
    pub fn svg(&self, _: f64, _: f64) -> Result<String, Error> {
        Err(Error::not_built())
    }

    /// # Errors
    /// Always: this build does not draw.
    pub fn png(&self, _: &str) -> Result<Vec<u8>, Error> {
        Err(Error::not_built())
    }
}

/// # Errors
/// Always: this build does not draw.
pub fn picture(_: &str, _: PrintFormat, _: f64) -> Result<Vec<u8>, Error> {
    Err(Error::not_built())
}

/// # Errors
/// Always: this build does not draw.
pub fn animate(
    _: &Film,
    _: &Plan,
    _: (&Path, &dyn Fn(&Path) -> bool),
    _: &mut dyn FnMut(usize) -> bool,
) -> Result<FilmOutcome, Error> {
    Err(Error::not_built())
}
