//! Foundations along beams.

use super::{Along, BeamId, Plasticity};

/// How the reaction of a foundation, a force per length, follows from the deflection of the beam into it.
#[derive(Clone, Debug, PartialEq)]
pub enum FoundationLaw {
    /// In proportion to it (Winkler): it pushes the beam that is pressed in and pulls the one that lifts.
    Linear {
        /// Stiffness per length \[N/m^2\].
        stiffness: f64,
    },
    /// It pushes beyond a gap and never pulls: the beam lifts off.
    Compression {
        /// Stiffness per length \[N/m^2\].
        stiffness: f64,
        /// Deflection up to which there is no contact \[m\].
        gap: f64,
    },
    /// Along straight lines between given values (a p-y curve); beyond the first and the last one the reaction keeps its value there.
    Table {
        /// Deflections into the foundation, increasing; those of a beam that lifts are negative, shape (points) \[m\].
        deflection: Vec<f64>,
        /// Reactions per length there, positive where they push the beam out, zero without deflection, shape (points) \[N/m\].
        reaction: Vec<f64>,
    },
}

impl FoundationLaw {
    /// Stiffness per length of a law that has one; of a table zero \[N/m^2\].
    pub fn stiffness(&self) -> f64 {
        match *self {
            Self::Linear { stiffness } | Self::Compression { stiffness, .. } => stiffness,
            Self::Table { .. } => 0.0,
        }
    }
}

/// A foundation along a stretch of a beam, without shear between its places (Winkler): at every point of the axis the ground reacts along a direction
/// that is fixed in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Foundation {
    /// The user's name for it.
    pub name: String,
    /// The beam.
    pub beam: BeamId,
    /// Ends of the stretch, shape (2).
    pub stretch: [Along; 2],
    /// Direction in which it pushes the beam, shape (2) \[-\]; need not be of unit length. If none is given, the normal to the left of the
    /// beam's direction in the reference configuration, place by place.
    pub direction: Option<[f64; 2]>,
    /// Its reaction over the deflection.
    pub law: FoundationLaw,
    /// Damping per length, of a law of compression where that acts \[N s/m^2\].
    pub damping: f64,
    /// Yield law, if any: reactions per length \[N/m\] and deflections \[m\] in place of stresses and strains. A law of compression that yields
    /// leaves a gap behind.
    pub yielding: Option<Plasticity>,
}
