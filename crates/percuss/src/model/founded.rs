//! Foundations of a frozen model.

use std::ops::Range;

use super::definition::FoundationLaw;

/// A foundation: which of the connectors are its springs.
#[derive(Clone, Debug)]
pub struct FoundationData {
    pub name: String,
    pub beam: usize,
    /// Arc lengths of its ends, shape (2) \[m\].
    pub stretch: [f64; 2],
    /// Its springs among the connectors of the model.
    pub connectors: Range<usize>,
    /// Length that each of its springs stands for, shape (springs) \[m\].
    pub lengths: Vec<f64>,
    /// Its law as given.
    pub law: FoundationLaw,
    /// Whether it can yield.
    pub yields: bool,
}

/// A place of a foundation in a state.
#[derive(Clone, Copy, Debug)]
pub struct FoundationPlace {
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Length that it stands for \[m\].
    pub length: f64,
    /// Reaction per length, positive where it pushes the beam \[N/m\].
    pub pressure: f64,
    /// Force on the beam, shape (2) \[N\].
    pub force: [f64; 2],
    /// Energy stored in the length \[J\].
    pub stored: f64,
    /// Whether the beam has lifted off: it is farther from the foundation than where it touches without force.
    pub lifted: bool,
    /// Plastic deflection \[m\].
    pub plastic: f64,
    /// Energy that the length has dissipated by yielding, and that hardening has stored in it, shape (2) \[J\].
    pub flow: [f64; 2],
}
