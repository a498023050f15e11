//! Beams, their lines and meshes, and places on them.

use super::{BeamId, MaterialId, SectionId};

/// Connection of the points of a beam to a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Curve {
    /// Straight from point to point, with rigid corners.
    #[default]
    Polyline,
    /// A circular arc through three points: start, a point between, end.
    Arc,
    /// A smooth curve through all points: cubic spline over the length along the points, natural ends.
    Spline,
}

/// Size of the finite elements of a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ElementSize {
    /// Total number of elements, distributed by length over the straight parts.
    Number(usize),
    /// Elements no longer than this \[m\].
    Length(f64),
}

/// Elements smaller towards a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grading {
    /// End with the smallest elements.
    pub towards: Along,
    /// Ratio of the sizes of the elements at the far end and there; above one.
    pub ratio: f64,
}

/// Division of a beam into finite elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mesh {
    /// Size of the elements.
    pub size: ElementSize,
    /// Grading; even if there is none, but for hinges.
    pub grading: Option<Grading>,
    /// Whether a beam that can yield, without other grading, has a short element on either side of each place at which a plastic hinge may form.
    pub hinges: bool,
}

impl Mesh {
    /// Number of elements of equal length.
    pub fn even(elements: usize) -> Self {
        Self { size: ElementSize::Number(elements), grading: None, hinges: false }
    }
}

/// From a point on, a beam has another material or section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Start of the part.
    pub at: Along,
    /// Material from there on; the one before if none is given.
    pub material: Option<MaterialId>,
    /// Section from there on; the one before if none is given.
    pub section: Option<SectionId>,
}

/// Closure of the outline of a beam at its ends, for contact. In either case the outline ends at the end of the beam.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ends {
    /// A straight edge across the axis, between two corners.
    #[default]
    Flat,
    /// A half circle from face to face.
    Round,
}

/// Theory of a beam: what its sections do when it bends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theory {
    /// Sections stay normal to the axis (Euler and Bernoulli, Kirchhoff).
    #[default]
    Slender,
    /// Sections turn by themselves: flexible in shear (Timoshenko; Simo and Reissner).
    Shear,
}

/// A beam: a centre line with material, section and mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// The user's name for it.
    pub name: String,
    /// Points the centre line runs through, shape (points, 2) \[m\].
    pub points: Vec<[f64; 2]>,
    /// Connection of the points.
    pub curve: Curve,
    /// Its finite elements.
    pub mesh: Mesh,
    /// Its material, up to the first change.
    pub material: MaterialId,
    /// Its section, up to the first change.
    pub section: SectionId,
    /// Changes of material and section, in the order of their places, shape (changes).
    pub changes: Vec<Change>,
    /// Closure of its outline at its ends.
    pub ends: Ends,
    /// What its sections do when it bends.
    pub theory: Theory,
}

impl Beam {
    /// A uniform beam through `points`, straight between them, of `elements` elements.
    pub fn new(
        name: impl Into<String>,
        points: &[[f64; 2]],
        elements: usize,
        material: MaterialId,
        section: SectionId,
    ) -> Self {
        Self {
            name: name.into(),
            points: points.to_vec(),
            curve: Curve::Polyline,
            mesh: Mesh::even(elements),
            material,
            section,
            changes: Vec::new(),
            ends: Ends::Flat,
            theory: Theory::Slender,
        }
    }
}

/// Position along a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Along {
    /// Fraction of the arc length, 0 at the start, 1 at the end.
    Fraction(f64),
    /// Arc length from the start \[m\].
    Distance(f64),
}

/// A material point of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct PointRef {
    /// The user's words for it, as they appear in names of results: `girder.mid`, `girder@0.25`.
    pub label: String,
    /// The beam.
    pub beam: BeamId,
    /// Position along it.
    pub along: Along,
}
