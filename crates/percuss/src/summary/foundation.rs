//! Results of foundations along beams.

use serde::{Deserialize, Serialize};

use super::forces::{Range, SectionPeak, SectionRange};
use super::peak::Peak;

/// Kind of the law of a foundation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum FoundationKind {
    /// In proportion to the deflection.
    Linear,
    /// Of compression alone.
    Compression,
    /// Along straight lines between given values.
    Table,
}

impl FoundationKind {
    /// Its name in scenarios: `linear`, `compression`, `table`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Compression => "compression",
            Self::Table => "table",
        }
    }
}

/// Place and law of a foundation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoundationProperties {
    /// Name of its beam.
    pub beam: String,
    /// Arc lengths of its ends from the start of the beam, shape (2) \[m\].
    pub stretch: [f64; 2],
    /// Kind of its law.
    pub kind: FoundationKind,
    /// Stiffness per length \[N/m^2\]; of a table none.
    pub stiffness: Option<f64>,
}

/// Results of a foundation, at ends of steps; forces and reactions are those of springs and dampers together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FoundationSummary {
    /// The user's name for it.
    pub name: String,
    /// Its place and law.
    pub properties: FoundationProperties,
    /// Components of its resultant force on the beam, shape (2) \[N\].
    pub force: [Range; 2],
    /// Its reaction per length, positive where it pushes the beam, at the Gauss points of the elements \[N/m\].
    pub pressure: SectionRange,
    /// Largest length over which the beam has lifted off, of a foundation of compression alone; zero of all others \[m\].
    pub lifted: Peak,
    /// Largest energy stored in it \[J\].
    pub energy_max: Peak,
    /// Energy stored in it at the end, without that stored by hardening \[J\].
    pub energy: f64,
    /// Plastic deflection of largest magnitude at the end of the run, signed \[m\]; zero without yielding.
    pub plastic: SectionPeak,
    /// End of the step in which it first yields \[s\], if it does.
    pub first_yield: Option<f64>,
    /// Energy dissipated by yielding, by the preload of a static start and in the run \[J\].
    pub dissipated: f64,
    /// Its part in the static start, before the run \[J\].
    pub dissipated_by_preload: f64,
    /// Energy that hardening has stored \[J\].
    pub hardening: f64,
}
