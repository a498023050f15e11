//! A fault in a definition, with its place and its cure.

use std::fmt;

/// One fault: place, value found, valid value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Place as a dotted path in the words of the scenario file: `projectile.hammer.mass`.
    pub path: String,
    /// The value found, in a form fit for the middle of a message: `a mass of -5 kg`.
    pub found: String,
    /// A valid value: `a mass above zero`.
    pub expected: String,
}

impl Fault {
    /// Text for an obstacle that no contact names. (Readers of files, which know the intended contacts, have a more precise one.)
    pub const UNTOUCHED: &str = "no contact";

    /// A fault at `path`.
    pub fn new(
        path: impl Into<String>,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self { path: path.into(), found: found.into(), expected: expected.into() }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: found {}, expected {}", self.path, self.found, self.expected)
    }
}
