//! Accelerations as test laboratories report them: filtered in a channel frequency class, and as shock response spectra. Numbers in,
//! numbers out; no files.

mod filter;
mod picture;
mod recorded;
mod signal;
mod spectrum;

use std::fmt;

pub use filter::{Cfc, filtered};
pub use recorded::{Acceleration, Frame, accelerations};
pub use signal::Signal;
pub use spectrum::{Band, Extremes, SPECTRUM_HEADER, ShockSpectrum, shock_spectrum};

/// Why a signal cannot be filtered, or has no spectrum.
#[derive(Clone, Debug, PartialEq)]
pub enum ShockError {
    /// Fewer than three rows, times that do not grow, or values that are no numbers.
    Signal(String),
    /// The sampling does not resolve what was asked for.
    Coarse {
        /// What was asked for.
        what: String,
        /// Samples a second that this needs \[Hz\].
        needed: f64,
        /// Those of the signal \[Hz\].
        rate: f64,
    },
    /// A damping ratio or a band of frequencies that makes no sense.
    Request(String),
}

impl fmt::Display for ShockError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Signal(text) | Self::Request(text) => f.write_str(text),
            Self::Coarse { what, needed, rate } => write!(
                f,
                "{what} needs {needed:.0} samples per second ({rate:.0} available): reduce time.step and record.every"
            ),
        }
    }
}

impl std::error::Error for ShockError {}
