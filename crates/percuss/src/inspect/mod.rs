//! Read access to a frozen model: beams with their sections, supports and joints, bodies, contacts, loads.
//!
//! Views borrow the [`Model`] and cannot change it. They serve checks of a model before a run (the advisor) and contain only the data for these;
//! numbers of beams, nodes, bodies and contacts are those of the order of definition.

mod beams;
mod contacts;
mod loose;
mod ties;

pub use beams::*;
pub use contacts::*;
pub use loose::*;
pub use ties::*;

use crate::math::vec2::{add, rot90, scale, sub};
use crate::model::frozen::{Constraint, ConstraintKind};
pub use crate::model::striking::{Body, BodyKind};
pub use crate::model::ties::{ActsFrom, ConnectorLaw, ForceTable};
use crate::model::{InitialMotion, Model, PreparedFunction, TimeFunction};

impl Model {
    /// Number of beams.
    pub fn beam_count(&self) -> usize {
        self.beams.len()
    }

    /// The beam of number `index`.
    pub fn beam(&self, index: usize) -> BeamView<'_> {
        BeamView { model: self, data: &self.beams[index] }
    }

    /// Position of a node in the reference configuration \[m\].
    pub fn node_position(&self, node: usize) -> [f64; 2] {
        self.nodes[node].position
    }

    /// Position of the centre of the body of number `body` in the reference configuration \[m\].
    pub fn body_position(&self, body: usize) -> [f64; 2] {
        self.nodes[self.body_node(body)].position
    }

    /// Prescribed degrees of freedom, in the order of the nodes.
    pub fn prescribed(&self) -> impl Iterator<Item = PrescribedView<'_>> {
        self.prescribed.iter().map(PrescribedView::of)
    }

    /// Prescribed degrees of freedom of a node.
    pub fn prescribed_at(&self, node: usize) -> Option<PrescribedView<'_>> {
        self.dofs_at(node).map(PrescribedView::of)
    }

    /// Prescribed degrees of freedom of the body of number `body`.
    pub fn prescribed_of_body(&self, body: usize) -> Option<PrescribedView<'_>> {
        self.prescribed_at(self.body_node(body))
    }

    /// Supports, in the order of definition.
    pub fn supports(&self) -> impl ExactSizeIterator<Item = SupportView> {
        self.supports.iter().map(|s| SupportView {
            until: s.until,
            moves: s.motion.is_some(),
            jump: s.motion.map_or(0.0, |motion| self.motions[motion].largest_jump()),
        })
    }

    /// Constraints.
    pub fn constraints(&self) -> impl Iterator<Item = ConstraintView<'_>> {
        // The unit length of a node's vector ties nothing.
        let ties = |c: &&Constraint| !matches!(c.kind, ConstraintKind::Length { .. });
        self.constraints.iter().filter(ties).map(ConstraintView)
    }

    /// Springs and dampers, those of foundations left out.
    pub fn connectors(&self) -> impl Iterator<Item = ConnectorView<'_>> {
        self.single_connectors().map(ConnectorView)
    }

    /// Foundations along beams, in the order of definition.
    pub fn foundations(&self) -> impl ExactSizeIterator<Item = FoundationView<'_>> {
        self.foundations.iter().map(FoundationView)
    }

    /// Point masses.
    pub fn point_masses(&self) -> impl Iterator<Item = PointMassView<'_>> {
        self.masses.iter().map(|m| PointMassView { point: PointView::of(&m.point), mass: m.mass })
    }

    /// Rigid bodies: guided projectiles, discs, obstacles.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Guided projectiles, in the order of definition; their contacts are the first ones.
    pub fn guided(&self) -> impl ExactSizeIterator<Item = GuidedView<'_>> {
        self.projectiles.iter().map(|data| GuidedView {
            body: &self.bodies[data.body],
            rear: self.bodies.get(data.body + 1).filter(|_| data.has_rear),
            direction: data.direction,
            point: PointView::of(&data.point),
        })
    }

    /// Contacts: those of guided projectiles, then those defined.
    pub fn contacts(&self) -> impl ExactSizeIterator<Item = ContactView<'_>> {
        self.contacts.iter().map(|data| ContactView { model: self, data })
    }

    /// The contact of number `index`.
    pub fn contact(&self, index: usize) -> Option<ContactView<'_>> {
        self.contacts.get(index).map(|data| ContactView { model: self, data })
    }

    /// Loads, in the order of definition.
    pub fn loads(&self) -> impl ExactSizeIterator<Item = LoadView<'_>> {
        self.loads.iter().map(LoadView)
    }

    /// The same model under steady loads: those of this one with the given factors, shape (loads) \[-\].
    pub fn under_steady_loads(&self, factors: &[f64]) -> Self {
        let mut steady = self.clone();
        for (load, factor) in steady.loads.iter_mut().zip(factors) {
            let factor = *factor;
            load.function = PreparedFunction::new(&TimeFunction::function(move |_| factor));
            (load.from, load.until) = (f64::NEG_INFINITY, f64::INFINITY);
        }
        steady
    }

    /// Motion in which the beam of number `beam` starts.
    pub fn initial_motion_of(&self, beam: usize) -> &InitialMotion {
        let nodes = &self.beams[beam].nodes;
        let own = self.own_motions.iter().find(|(range, _)| range == nodes);
        own.map_or(&self.initial_motion, |(_, motion)| motion)
    }

    /// Velocity of the degrees of freedom of a beam's node at the start: velocity \[m/s\] and rate of the tangent \[1/s\].
    pub fn initial_velocity(&self, node: usize) -> [f64; 4] {
        let own = self.own_motions.iter().rev().find(|(range, _)| range.contains(&node));
        let motion = own.map_or(&self.initial_motion, |(_, motion)| motion);
        let frame = &self.nodes[node];
        let away = sub(frame.position, motion.about);
        let v = add(motion.velocity, scale(motion.spin, rot90(away)));
        let g = scale(motion.spin, rot90(frame.tangent));
        [v[0], v[1], g[0], g[1]]
    }
}
