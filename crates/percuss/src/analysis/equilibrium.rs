//! Results of statics.

use super::balance::StaticBalance;
use super::course::StaticFirstYield;
use super::failure::StaticFailure;
use super::foundations::StaticFoundation;
use super::largest_displacement::LargestDisplacement;
use super::spectrum::Held;
use super::static_contacts::StaticContact;
use super::yields::StaticYielding;
use crate::frame::{Frame, FrameForce, SectionPoint};
use crate::state::State;
use crate::step::contacts::PressingPair;
use crate::summary::{PointForces, SectionForceSummary};

/// A static equilibrium.
#[derive(Clone, Debug)]
pub struct Equilibrium {
    /// The state of equilibrium, at rest.
    pub state: State,
    /// Displacements of the recorded points, with their names, shape (points, 2) \[m\].
    pub points: Vec<(String, [f64; 2])>,
    /// Rotations of the recorded points, counter-clockwise, continuous along each beam from within half a turn at its start, shape (points) \[rad\].
    pub rotations: Vec<f64>,
    /// The largest displacement of all beams, recorded or not.
    pub largest_displacement: Option<LargestDisplacement>,
    /// Section forces of largest magnitude, one entry a beam, shape (beams).
    pub section_forces: Vec<SectionForceSummary>,
    /// Section forces and stresses at the recorded points, as at the columns of a history, shape (points).
    pub point_forces: Vec<PointForces>,
    /// Axial force, shear force and moment at the start and the end of every element, shape (elements, 2, 3) \[N, N, N m\].
    pub element_forces: Vec<[[f64; 3]; 2]>,
    /// The same along all elements as polylines, in the order of elements, shape (vertices).
    pub element_points: Vec<SectionPoint>,
    /// Forces of all active contacts, on the second of their partners, shape (places where something presses).
    pub contact_forces: Vec<FrameForce>,
    /// Factors of the loads, in the model's order, shape (loads) \[-\].
    pub load_factors: Vec<f64>,
    /// Forces (1, 2) and moment of each support on the structure, with their names, shape (supports, 3) \[N, N m\].
    pub reactions: Vec<(String, [f64; 3])>,
    /// Contacts in the equilibrium, in the model's order, shape (contacts).
    pub contacts: Vec<StaticContact>,
    /// Contacts that press, with their forces, shape (pairs that press) \[N\].
    pub(crate) pressed: Vec<PressingPair>,
    /// Active contacts of beams, which remain closed in small motions, shape (pairs that press).
    pub(crate) held: Vec<Held>,
    /// Springs and hinges that can yield, in the model's order, shape (such springs and hinges).
    pub yielding: Vec<StaticYielding>,
    /// Foundations, in the model's order, shape (foundations).
    pub foundations: Vec<StaticFoundation>,
    /// Failures during loading, in their order, shape (such failures).
    pub failures: Vec<StaticFailure>,
    /// Resultant of all external forces.
    pub balance: StaticBalance,
    /// Place and share of the loads of the first yield of beams, shape (beams); empty at the end of a path.
    pub first_yields: Vec<Option<StaticFirstYield>>,
    /// Largest growth rate of displacements with the loads, relative to that in the first load step: about one for an elastic structure, and large
    /// for one that passes a plastic mechanism; NaN at the end of a path \[-\].
    pub softening: f64,
    /// Whether it is stable: no motion about it grows.
    pub stable: bool,
    /// Beams that only contacts support and that can slide along all of them, by name: statics has no friction, shape (such beams).
    pub sliding: Vec<String>,
    /// Load steps taken.
    pub load_steps: usize,
    /// Newton iterations.
    pub newton_iterations: usize,
}

impl Equilibrium {
    /// The equilibrium as a frame, for drawings.
    pub fn frame(&self) -> Frame<'_> {
        Frame {
            time: 0.0,
            displacement: &self.state.displacement,
            velocity: &self.state.velocity,
            spin: &self.state.spin,
            section_forces: &self.element_forces,
            section_points: &self.element_points,
            contact_forces: &self.contact_forces,
            load_factors: &self.load_factors,
        }
    }
}
