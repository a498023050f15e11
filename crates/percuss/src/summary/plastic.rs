//! What became of beams, springs and hinges that can yield.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::forces::SectionPeak;
use super::peak::Peak;

/// A stretch of a beam that has bent plastically to one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlasticHinge {
    /// Arc length from the start of the beam to its middle, weighed by the plastic curvature \[m\].
    pub s: f64,
    /// Its length, as far as Gauss points tell \[m\].
    pub length: f64,
    /// Length of the element at its middle \[m\]: a hinge no longer than that is as long as the mesh lets it be, and so are its strains.
    pub element_length: f64,
    /// Angle by which the beam stays bent, positive where it turns the tangent counter-clockwise along the beam \[rad\].
    pub rotation: f64,
    /// Energy dissipated in it \[J\].
    pub dissipated: f64,
}

/// Where and when a beam first yielded.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FirstYield {
    /// Arc length from the start of the beam \[m\], that of a Gauss point.
    pub s: f64,
    /// End of the step in which it did \[s\].
    pub time: f64,
}

/// What became of a beam that can yield.
#[derive(Clone, Debug, PartialEq)]
pub struct PlasticSummary {
    /// The beam's name.
    pub name: String,
    /// Plastic strain of largest magnitude, signed \[-\]; with softening or perfect plasticity it grows as elements shrink.
    pub strain_max: SectionPeak,
    /// Largest accumulated plastic strain \[-\].
    pub accumulated_max: SectionPeak,
    /// Where and when it first yielded, if it did.
    pub first_yield: Option<FirstYield>,
    /// Where it has bent plastically up to the end, in the order along it, shape (hinges).
    pub hinges: Vec<PlasticHinge>,
    /// Energy dissipated by plastic flow, by the preload of a static start and in the run \[J\].
    pub dissipated: f64,
    /// Of that what the preload dissipated, before the run \[J\].
    pub dissipated_by_preload: f64,
    /// Energy that hardening has stored \[J\].
    pub hardening: f64,
    /// The node that stays farthest from where it would be without plastic strains once the structure is unloaded and at rest, held
    /// by what still holds it; nowhere and zero where nothing has yielded, and why it is not told where it is not.
    pub permanent_set: Result<PermanentSet, NoPermanentSet>,
    /// Fibres that have failed.
    pub failed: usize,
    /// Where it has parted, in the order of time, shape (places).
    pub parted: Vec<Parting>,
}

/// A place at which a beam has parted: no fibre of a section is left, and so nothing of the element that it is in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parting {
    /// Arc length of the section from the start of the beam \[m\], that of a Gauss point.
    pub s: f64,
    /// Where the element that is gone begins and ends, shape (2) \[m\].
    pub stretch: [f64; 2],
    /// End of the step in which it did \[s\].
    pub time: f64,
    /// What was stored in it and is released at that instant \[J\].
    pub energy: f64,
}

/// What stays of a beam's displacements where most of them stays, once the structure is unloaded and at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PermanentSet {
    /// Arc length of the node from the start of the beam \[m\]; NaN where nothing has yielded.
    pub s: f64,
    /// How far it stays from where it would be without plastic strains, supports where they stand at the end, shape (2) \[m\].
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

/// Why no permanent set of a beam is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoPermanentSet {
    /// What holds at the end leaves the beam free to move without being strained.
    NotHeld,
    /// The beam has parted, and nothing holds a piece of it.
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

/// What became of a spring or an elastic hinge that can yield.
///
/// Extensions are positive where it is longer than without force. A rotation is positive where it goes along with a positive bending
/// moment in the first of the two beams that begins or ends there: where it turns the tangent counter-clockwise along that beam.
#[derive(Clone, Debug, PartialEq)]
pub struct YieldingSummary {
    /// What it is and its name, `spring.brace` or `joint.knee`.
    pub name: String,
    /// Whether it is a hinge: its extensions are rotations then.
    pub turns: bool,
    /// Plastic extension or rotation at the end, what stays of it without force \[m, rad\]; as it was then where it has failed.
    pub plastic: f64,
    /// The largest magnitude of that up to the end or its failure, signed, and when \[m, rad\].
    pub plastic_max: Peak,
    /// The sum of the magnitudes of its increments \[m, rad\].
    pub accumulated: f64,
    /// Extension from the length without force, or rotation, of largest magnitude up to the end or its failure, signed, and when
    /// \[m, rad\].
    pub extension_max: Peak,
    /// End of the step in which it first yielded, if it did \[s\].
    pub first_yield: Option<f64>,
    /// Energy dissipated by plastic flow, by the preload of a static start and in the run \[J\].
    pub dissipated: f64,
    /// Of that what the preload dissipated, before the run \[J\].
    pub dissipated_by_preload: f64,
    /// Energy that hardening has stored \[J\].
    pub hardening: f64,
    /// End of the step in which it failed, if it did \[s\].
    pub failed: Option<f64>,
    /// The largest permanent set of the beams that it acts on; why it is not told where it is told of none of them.
    pub permanent_set: Result<SetOfBeam, NoPermanentSet>,
}
