//! A fault in a definition, with its place and its cure.

use std::fmt;

/// One fault: where, what was found, what would be right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Place as a dotted path in the words of the scenario file: `projectile.hammer.mass`.
    pub path: String,
    /// What was found there, in a form fit for the middle of a message: `a mass of -5 kg`.
    pub found: String,
    /// What would be right: `a mass above zero`.
    pub expected: String,
}

impl Fault {
    /// What is found at an obstacle that no contact names. (Readers of files, who know which contacts were meant, say it better.)
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
