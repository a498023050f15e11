//! Equivalent static forces of impacts, or why there are none.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Static force at the struck point along the line of motion, in addition to permanent loads, with the same peak effect as the run in nonlinear
/// statics.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EquivalentForce {
    /// Force with the same largest moment in the struck beam, or why there is none \[N\].
    pub moment: Result<f64, NoEquivalentForce>,
    /// Force with the same deflection of the struck point along the line of motion, or why there is none \[N\].
    pub deflection: Result<f64, NoEquivalentForce>,
    /// Whether the largest deflection is one on rebound: the force for it then acts against the impact.
    pub on_rebound: bool,
    /// Whether permanent loads act beside it.
    pub beside_loads: bool,
    /// Whether the structure yielded in the run: then it is the force on the same structure, assumed elastic.
    pub as_if_elastic: bool,
}

/// Reason why no static force has the effect of an impact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum NoEquivalentForce {
    /// The struck point is not recorded.
    NotRecorded,
    /// The largest displacement along the line of motion is not recorded: the line is oblique, and displacements are recorded along x and y.
    Oblique,
    /// The impact increases the effect by round-off at most.
    NoIncrease,
    /// The structure has no stiffness against such a force.
    NotSupported,
    /// The force turns: a structure under a larger one snaps through or collapses.
    LimitPoint {
        /// The largest force \[N\].
        force: f64,
    },
    /// The equilibrium with this effect is not stable.
    Unstable,
    /// A part of the structure fails before.
    Fails {
        /// The force at which it does \[N\].
        force: f64,
    },
    /// The search found no equilibrium beyond a force.
    NotFound {
        /// This force \[N\].
        force: f64,
    },
}

impl NoEquivalentForce {
    /// Whether it is reported: without a recorded point there is no question.
    pub fn is_reported(&self) -> bool {
        !matches!(self, Self::NotRecorded)
    }
}

impl fmt::Display for NoEquivalentForce {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotRecorded => f.write_str("the struck point is not recorded"),
            Self::Oblique => f.write_str(
                "not determined: the largest deflections are known along x and y, not along the oblique line of motion",
            ),
            Self::NoIncrease => f.write_str("the impact does not increase it"),
            Self::NotSupported => f.write_str("the structure is not supported in this direction"),
            Self::LimitPoint { force } => write!(
                f,
                "no static force has this effect: beyond {} the structure snaps through or collapses",
                newtons(*force)
            ),
            Self::Unstable => {
                f.write_str("the equilibrium with this effect is not stable: the structure buckles")
            }
            Self::Fails { force } => {
                write!(
                    f,
                    "a part of the structure fails under a static force of {}",
                    newtons(*force)
                )
            }
            Self::NotFound { force } if *force == 0.0 => {
                f.write_str("not determined: no equilibrium was found under such a force")
            }
            Self::NotFound { force } => {
                write!(f, "not determined: no equilibrium was found beyond {}", newtons(*force))
            }
        }
    }
}

/// A force with four digits, in N, kN or MN.
fn newtons(force: f64) -> String {
    let (scaled, unit) = match force.abs() {
        size if size >= 1e6 => (force / 1e6, "MN"),
        size if size >= 1e4 => (force / 1e3, "kN"),
        _ => (force, "N"),
    };
    let digits = (3.0 - scaled.abs().max(1e-3).log10().floor()).max(0.0) as usize;
    format!("{scaled:.digits$} {unit}")
}
