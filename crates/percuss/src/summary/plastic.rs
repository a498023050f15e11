//! Results of beams, springs and hinges that can yield.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::forces::SectionPeak;
use super::peak::Peak;

/// A stretch of a beam that has bent plastically to one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlasticHinge {
    /// Arc length from the start of the beam to its middle, weighed by the plastic curvature \[m\].
    pub s: f64,
    /// Its length, within the resolution of Gauss points \[m\].
    pub length: f64,
    /// Length of the element at its middle \[m\]: a hinge no longer than that has a mesh-dependent length, and so are its strains.
    pub element_length: f64,
    /// Permanent rotation, positive counter-clockwise along the beam \[rad\].
    pub rotation: f64,
    /// Energy dissipated in it \[J\].
    pub dissipated: f64,
}

/// Place and time of first yield of a beam.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FirstYield {
    /// Arc length from the start of the beam \[m\], that of a Gauss point.
    pub s: f64,
    /// End of the step of first yield \[s\].
    pub time: f64,
}

/// Results of a beam that can yield.
#[derive(Clone, Debug, PartialEq)]
pub struct PlasticSummary {
    /// The beam's name.
    pub name: String,
    /// Plastic strain of largest magnitude, signed \[-\]; with softening or perfect plasticity it increases with mesh refinement.
    pub strain_max: SectionPeak,
    /// Largest accumulated plastic strain \[-\].
    pub accumulated_max: SectionPeak,
    /// Place and time of first yield, if any.
    pub first_yield: Option<FirstYield>,
    /// Plastic hinges at the end, in the order along it, shape (hinges).
    pub hinges: Vec<PlasticHinge>,
    /// Energy dissipated by plastic flow, by the preload of a static start and in the run \[J\].
    pub dissipated: f64,
    /// Its part in the static start, before the run \[J\].
    pub dissipated_by_preload: f64,
    /// Energy that hardening has stored \[J\].
    pub hardening: f64,
    /// Largest permanent deflection of a node after unloading, relative to its position without plastic strains, with the connections of the end of
    /// the run; zero without a place if there was no yielding, and the reason if it is not available.
    pub permanent_set: Result<PermanentSet, NoPermanentSet>,
    /// Fibres that have failed.
    pub failed: usize,
    /// Fractures, in the order of time, shape (places).
    pub parted: Vec<Parting>,
}

/// Place of a fracture of a beam: a section has no fibres left, and the element that contains it has no forces.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parting {
    /// Arc length of the section from the start of the beam \[m\], that of a Gauss point.
    pub s: f64,
    /// Start and end of the removed element, shape (2) \[m\].
    pub stretch: [f64; 2],
    /// End of the step of fracture \[s\].
    pub time: f64,
    /// Energy stored in it, which is released at that instant \[J\].
    pub energy: f64,
}

/// Largest permanent deflection of a beam, once the structure is unloaded and at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PermanentSet {
    /// Arc length of the node from the start of the beam \[m\]; NaN without yielding.
    pub s: f64,
    /// Distance from its position without plastic strains, with supports at their final position, shape (2) \[m\].
    pub displacement: [f64; 2],
}

/// A permanent set and the beam that it is of.
#[derive(Clone, Debug, PartialEq)]
pub struct SetOfBeam {
    /// The beam's name.
    pub beam: String,
    /// Its permanent set.
    pub set: PermanentSet,
}

/// Reason why the permanent deflection of a beam is not available.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoPermanentSet {
    /// The connections at the end do not prevent strain-free motions of the beam.
    NotHeld,
    /// The beam is fractured, and a piece of it is unsupported.
    Parted,
    /// No equilibrium without loads was found near the last configuration.
    NoEquilibrium,
}

impl fmt::Display for NoPermanentSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotHeld => "it can move without strain at the end",
            Self::Parted => "a piece of it is not supported",
            Self::NoEquilibrium => "no equilibrium without loads near its last configuration",
        })
    }
}

impl PermanentSet {
    /// Magnitude of the displacement \[m\].
    pub fn size(&self) -> f64 {
        self.displacement[0].hypot(self.displacement[1])
    }
}

impl PlasticSummary {
    /// The hinge of largest rotation.
    pub fn rotation(&self) -> f64 {
        let larger = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
        self.hinges.iter().map(|hinge| hinge.rotation).fold(0.0, larger)
    }
}

/// Results of a spring or an elastic hinge that can yield.
///
/// Extensions are positive if it is longer than its force-free length. A rotation is positive in the direction of a positive bending moment in the
/// first of the two beams that begins or ends there: it rotates the tangent counter-clockwise along that beam.
#[derive(Clone, Debug, PartialEq)]
pub struct YieldingSummary {
    /// Kind and name, `spring.brace` or `joint.knee`.
    pub name: String,
    /// Whether it is a hinge: its extensions are rotations then.
    pub turns: bool,
    /// Plastic extension or rotation at the end, which remains without force \[m, rad\]; after a failure that at the failure.
    pub plastic: f64,
    /// The largest magnitude of that up to the end or its failure, signed, and when \[m, rad\].
    pub plastic_max: Peak,
    /// The sum of the magnitudes of its increments \[m, rad\].
    pub accumulated: f64,
    /// Extension from the length without force, or rotation, of largest magnitude up to the end or its failure, signed, and when
    /// \[m, rad\]; of a tension- or compression-only spring from its slack or gap, while it acts.
    pub extension_max: Peak,
    /// Force, positive in tension, or moment of largest magnitude at the ends of steps before its failure, signed, that of its damper included, and
    /// when \[N, N m\].
    pub force_max: Peak,
    /// End of the step of first yield, if any \[s\].
    pub first_yield: Option<f64>,
    /// Energy dissipated by plastic flow, by the preload of a static start and in the run \[J\].
    pub dissipated: f64,
    /// Its part in the static start, before the run \[J\].
    pub dissipated_by_preload: f64,
    /// Energy that hardening has stored \[J\].
    pub hardening: f64,
    /// End of the step of failure, if any \[s\].
    pub failed: Option<f64>,
    /// Largest permanent deflection of the connected beams; the reason if none is available.
    pub permanent_set: Result<SetOfBeam, NoPermanentSet>,
}
