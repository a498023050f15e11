//! State of a run at an instant, for drawings: configuration and forces.

use crate::math::hermite::GAUSS;

/// A force of one contact at one place, or an impulse of an impact there: a contact may have both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameForce {
    /// Number of the contact in the model.
    pub contact: usize,
    /// Point of contact, shape (2) \[m\].
    pub position: [f64; 2],
    /// On the second of its two partners, shape (2) \[N\] or \[N s\]: the mean force over the last step without an impact, that over the last
    /// step of a compliant contact, or the impulse of impacts since the previous row.
    pub force: [f64; 2],
    /// Whether it is an impulse.
    pub impulsive: bool,
}

/// Section forces at a place of an element, a vertex of the polyline that they are drawn as. Where they jump two vertices are at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionPoint {
    /// Number of the element in the model.
    pub element: usize,
    /// Arc length from the start of its beam \[m\].
    pub s: f64,
    /// Axial force, shear force and bending moment, shape (3) \[N, N, N m\].
    pub forces: [f64; 3],
}

/// The configuration at an instant, and the forces that belong to it.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// Time \[s\].
    pub time: f64,
    /// Displacements (u1, u2, u1', u2') of beams' nodes, (u1, u2, angle, 0) of bodies, shape (nodes, 4) \[m, -, rad\].
    pub displacement: &'a [[f64; 4]],
    /// Velocities of the same, shape (nodes, 4) \[m/s, 1/s, rad/s\].
    pub velocity: &'a [[f64; 4]],
    /// Angular rates of the sections at the Gauss points of every element, shape (elements, 3) \[rad/s\]: with `velocity` they determine the
    /// kinetic energy. Empty for a structure at rest.
    pub spin: &'a [[f64; GAUSS]],
    /// Axial force, shear force and bending moment at the start and the end of every element, of the last step without an impact,
    /// shape (elements, 2, 3) \[N, N, N m\].
    pub section_forces: &'a [[[f64; 3]; 2]],
    /// The same along all elements, as polylines that keep to the section forces, the jumps and corners at forces inside elements and the
    /// largest values included; in the order of elements, from the start to the end of each, shape (vertices).
    pub section_points: &'a [SectionPoint],
    /// Forces of everything that touches, and impulses, shape (such forces and impulses).
    pub contact_forces: &'a [FrameForce],
    /// Factors of the loads, means over the last step, shape (loads) \[-\].
    pub load_factors: &'a [f64],
}
