//! The frozen model, which never changes once built.

use std::ops::Range;

pub use super::acting::*;
use super::definition::InitialMotion;
pub use super::founded::*;
pub use super::point::*;
pub use super::section_line::SectionLine;
pub use super::span_fibres::*;
pub use super::spans::*;
pub use super::striking::*;
pub use super::ties::*;
use super::time_function::PreparedFunction;
use crate::element::beam::NodeFrame;
use crate::geometry::Axes;
use crate::geometry::axis::AxisElements;
use crate::geometry::pair::Pair;
use crate::math::vec2::norm;

/// The simulated model; made by [`ModelBuilder`](super::ModelBuilder).
///
/// Nodes and elements of all beams form one row, beam after beam, span after span. They are followed by rigid bodies, a node each, whose degrees of
/// freedom are (u1, u2, angle, unused).
#[derive(Clone, Debug)]
pub struct Model {
    /// Nodes in the reference configuration, shape (nodes).
    #[doc(hidden)]
    pub nodes: Vec<NodeFrame>,
    /// Beams, in the order they were defined, shape (beams).
    #[doc(hidden)]
    pub beams: Vec<BeamData>,
    /// Spans of all beams, in the order of their nodes, shape (spans).
    #[doc(hidden)]
    pub spans: Vec<Span>,
    /// Fixed components of nodes, in the order of the nodes, shape (nodes held).
    #[doc(hidden)]
    pub prescribed: Vec<PrescribedDofs>,
    /// Constraints that a node's own components cannot express: joints, supports between nodes or for a time, shape (constraints).
    #[doc(hidden)]
    pub constraints: Vec<Constraint>,
    /// Joints that part beyond a strength, in the order they were defined, shape (such joints).
    pub(crate) joints: Vec<JointData>,
    /// Springs and dampers, shape (connectors).
    #[doc(hidden)]
    pub connectors: Vec<Connector>,
    /// Foundations along beams, in the order they were defined, shape (foundations); their springs are the last connectors.
    #[doc(hidden)]
    pub foundations: Vec<FoundationData>,
    /// Masses at points, shape (point masses).
    #[doc(hidden)]
    pub masses: Vec<MassData>,
    /// Supports, in the order they were defined, shape (supports).
    pub(crate) supports: Vec<SupportData>,
    /// Prescribed motions, shape (motions).
    #[doc(hidden)]
    pub motions: Vec<PreparedFunction>,
    /// Rigid bodies: guided projectiles, discs, obstacles, in the order of their nodes, shape (bodies).
    #[doc(hidden)]
    pub bodies: Vec<Body>,
    /// Obstacles, in the order they were defined, shape (obstacles).
    #[doc(hidden)]
    pub obstacles: Vec<ObstacleData>,
    /// Guided projectiles, in the order they were defined, shape (guided projectiles).
    #[doc(hidden)]
    pub projectiles: Vec<ProjectileData>,
    /// Contacts: those of guided projectiles, then those defined, shape (contacts).
    #[doc(hidden)]
    pub contacts: Vec<ContactData>,
    /// Pairs that can touch, contact after contact, shape (pairs).
    #[doc(hidden)]
    pub pairs: Vec<Pair>,
    /// Loads, in the order they were defined, shape (loads).
    #[doc(hidden)]
    pub loads: Vec<LoadData>,
    /// Ratios of damping of the flexible modes, from the lowest on, shape (modes) \[-\].
    #[doc(hidden)]
    pub modal_damping: Vec<f64>,
    /// Motion at the start.
    pub(crate) initial_motion: InitialMotion,
    /// Motions at the start of nodes that have one of their own, shape (such motions) \[indices of nodes\]; later ones count.
    pub(crate) own_motions: Vec<(Range<usize>, InitialMotion)>,
    /// Recorded points, each once, shape (recorded points).
    #[doc(hidden)]
    pub points: Vec<MaterialPoint>,
    /// Mass of beams, point masses and projectiles, a scale \[kg\].
    #[doc(hidden)]
    pub total_mass: f64,
}

impl Axes for Model {
    fn frames(&self) -> &[NodeFrame] {
        &self.nodes
    }

    fn axis(&self, beam: usize) -> &AxisElements {
        &self.beams[beam].axis
    }
}

impl Model {
    /// Number of fibres of all beams.
    pub(crate) fn fibre_count(&self) -> usize {
        let last = self.spans.iter().rev().find_map(|s| s.fibres.as_ref().map(|f| (s, f)));
        last.map_or(0, |(span, fibres)| fibres.first + fibres.count * span.elements.len())
    }

    /// Whether any beam has a fibre section: it can yield, carries no stress of one sign, or its section is given by fibres.
    pub(crate) fn has_fibres(&self) -> bool {
        self.spans.iter().any(|s| s.fibres.is_some())
    }

    /// Whether any beam has a fibre section, since it can yield, carries no stress of one sign or has a section given by fibres, or any spring or
    /// joint can yield.
    pub fn is_inelastic(&self) -> bool {
        self.has_fibres() || self.memory_count() > 0
    }

    /// Whether any beam has a fibre section, or any spring or joint yields; up to a strength alone these are elastic.
    pub(crate) fn has_inelastic_laws(&self) -> bool {
        self.has_fibres()
            || self
                .connectors
                .iter()
                .filter_map(|c| c.yielding.as_ref())
                .any(|own| own.law.is_some())
    }

    /// Whether any beam is shear-flexible.
    #[doc(hidden)]
    pub fn has_shear(&self) -> bool {
        self.spans.iter().any(|s| s.shear.is_some())
    }

    /// Whether the law of any contact crushes.
    pub fn crushes(&self) -> bool {
        self.contacts.iter().any(|c| c.law.crushes())
    }

    /// Number of nodes of all beams.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// Number of elements of all beams.
    pub fn element_count(&self) -> usize {
        self.spans.last().map_or(0, |span| span.elements.end)
    }

    /// Names of the beams, in their order.
    pub fn beam_names(&self) -> impl Iterator<Item = &str> {
        self.beams.iter().map(|b| b.name.as_str())
    }

    /// Reference positions of the nodes of the beam called `name` \[m\], start to end.
    pub fn beam_nodes(&self, name: &str) -> Option<Vec<[f64; 2]>> {
        let beam = self.beams.iter().find(|b| b.name == name)?;
        Some(self.nodes[beam.nodes.clone()].iter().map(|n| n.position).collect())
    }

    /// Elements of the beam called `name`, start to end: the node where each begins in the row of all nodes, its arc length \[m\],
    /// and position and tangent of the reference at both ends, laid out as a node's degrees of freedom.
    pub fn beam_elements(&self, name: &str) -> impl Iterator<Item = (usize, f64, [[f64; 4]; 2])> {
        let beam = self.beams.iter().find(|b| b.name == name);
        let spans = beam.map_or(0..0, |b| b.spans.clone());
        let frame = |n: &NodeFrame| [n.position[0], n.position[1], n.tangent[0], n.tangent[1]];
        self.spans[spans].iter().flat_map(move |span| {
            (0..span.elements.len()).map(move |k| {
                let a = span.nodes.start + k;
                let ends = [frame(&self.nodes[a]), frame(&self.nodes[a + 1])];
                (a, span.stations[k + 1] - span.stations[k], ends)
            })
        })
    }

    /// Elements with their spans: (span, number in the span, node a, element).
    #[doc(hidden)]
    pub fn each_element(&self) -> impl Iterator<Item = (&Span, usize, usize, usize)> {
        self.spans.iter().flat_map(|span| {
            let place = move |k| (span, k, span.nodes.start + k, span.elements.start + k);
            (0..span.elements.len()).map(place)
        })
    }

    /// The span and the number in it of the element that starts at a node.
    pub(crate) fn element_of(&self, node: usize) -> (&Span, usize) {
        let span = &self.spans[self.spans.partition_point(|s| s.nodes.end <= node)];
        (span, (node - span.nodes.start).min(span.elements.len() - 1))
    }

    /// The element that starts at a node.
    pub(crate) fn element_at(&self, node: usize) -> usize {
        let (span, k) = self.element_of(node);
        span.elements.start + k
    }

    /// Fixed components of a node.
    pub(crate) fn dofs_at(&self, node: usize) -> Option<&PrescribedDofs> {
        self.prescribed.binary_search_by_key(&node, |h| h.node).ok().map(|i| &self.prescribed[i])
    }

    /// Names of the supports, in their order.
    pub fn support_names(&self) -> impl Iterator<Item = &str> {
        self.supports.iter().map(|s| s.name.as_str())
    }

    /// Length of the element at a beam's node \[m\].
    pub(crate) fn node_length(&self, node: usize) -> f64 {
        let (span, k) = self.element_of(node);
        span.table(k).length
    }

    /// Size of the structure: its longest beam, or the largest distance of a node from the first one \[m\].
    #[doc(hidden)]
    pub fn extent(&self) -> f64 {
        let from = self.nodes.first().map_or([0.0; 2], |n| n.position);
        let away = |x: [f64; 2]| norm([x[0] - from[0], x[1] - from[1]]);
        let lengths = self.beams.iter().map(|b| b.length);
        lengths.chain(self.nodes.iter().map(|n| away(n.position))).fold(0.0, f64::max)
    }

    /// Scale of positions, which determines the rounding of gaps: the size of the structure, or its distance from the origin \[m\].
    #[doc(hidden)]
    pub fn position_scale(&self) -> f64 {
        self.nodes.iter().map(|n| norm(n.position)).fold(self.extent(), f64::max)
    }

    /// The beams with their supports and joints, without bodies and contacts, as used in statics and vibrations.
    pub(crate) fn structure(&self) -> Self {
        let nodes = self.beam_node_count();
        let mut structure = self.clone();
        structure.nodes.truncate(nodes);
        structure.prescribed.retain(|h| h.node < nodes);
        structure.bodies.clear();
        structure.projectiles.clear();
        structure.obstacles.clear();
        structure.contacts.clear();
        structure.pairs.clear();
        structure.connectors.iter_mut().for_each(Connector::without_bodies);
        structure
    }

    /// Whether the whole structure is at rest at the start.
    #[doc(hidden)]
    pub fn is_still(&self) -> bool {
        self.initial_motion == InitialMotion::default() && self.own_motions.is_empty()
    }

    /// Whether any force depends on a rate: only the midpoint family of schemes supports such forces.
    pub fn has_viscous_parts(&self) -> bool {
        self.has_viscous_structure() || self.contacts.iter().any(|c| c.law.dissipates())
    }

    /// The same, contacts left out.
    pub fn has_viscous_structure(&self) -> bool {
        self.spans.iter().any(|s| s.retardation > 0.0)
            || self.connectors.iter().any(|c| c.damping > 0.0)
            || self
                .bodies
                .iter()
                .any(|b| b.kind.behind().is_some_and(|spring| spring.damping > 0.0))
            || !self.modal_damping.is_empty()
    }

    /// Acceleration of gravity, for factors of one \[m/s^2\].
    #[doc(hidden)]
    pub fn gravity(&self) -> f64 {
        let each = self.loads.iter().map(|load| match load.kind {
            LoadAction::Gravity { acceleration: [x, y] } => x.hypot(y),
            _ => 0.0,
        });
        each.sum()
    }

    /// Whether the base is accelerated, so that the motion is relative to it.
    pub fn has_accelerated_base(&self) -> bool {
        self.loads.iter().any(|load| load.base)
    }

    /// Whether any load gives strains to elements.
    pub(crate) fn gives_strains(&self) -> bool {
        self.loads.iter().any(|load| matches!(load.kind, LoadAction::Strain { .. }))
    }

    /// Times at which a support is released \[s\].
    pub(crate) fn releases(&self) -> impl Iterator<Item = f64> {
        self.supports.iter().map(|s| s.until).filter(|t| t.is_finite())
    }

    /// Whether supports can have impulses: by rigid contacts, or by jumps of prescribed velocities.
    pub(crate) fn has_impulses(&self) -> bool {
        self.has_rigid_contact() || self.structural_drives().any(|drive| !drive.is_empty())
    }

    /// Prescribed values of the structure itself, as nodes or constraints hold it; those of obstacles and of the ground of springs
    /// are others.
    pub(crate) fn structural_drives(&self) -> impl Iterator<Item = &Drive> {
        let beams = self.beam_node_count();
        let held = self.prescribed.iter().filter(move |h| h.node < beams).flat_map(|h| &h.drives);
        held.chain(self.constraints.iter().map(|c| &c.drive))
    }
}

impl Model {
    /// Number of nodes that belong to beams; those of bodies follow.
    #[doc(hidden)]
    pub fn beam_node_count(&self) -> usize {
        self.nodes.len() - self.bodies.len()
    }

    /// Node of a body.
    #[doc(hidden)]
    pub fn body_node(&self, body: usize) -> usize {
        self.beam_node_count() + body
    }

    /// Nodes of a mover: beams first, then bodies.
    pub(crate) fn nodes_of_mover(&self, mover: usize) -> Range<usize> {
        match self.beams.get(mover) {
            Some(beam) => beam.nodes.clone(),
            None => {
                let node = self.body_node(mover - self.beams.len());
                node..node + 1
            }
        }
    }

    /// Bodies that strike: those of guided projectiles, then discs.
    pub(crate) fn striking_bodies(&self) -> impl Iterator<Item = usize> {
        (0..self.bodies.len()).filter(|i| self.bodies[*i].kind.strikes())
    }

    /// Names of the contacts, those of guided projectiles first, and whether each is set-valued.
    pub fn contact_names(&self) -> impl Iterator<Item = (&str, bool)> {
        self.contacts.iter().map(|c| (c.name.as_str(), c.law.is_rigid()))
    }

    /// Whether any contact is set-valued, so that impacts with impulses can occur.
    pub fn has_rigid_contact(&self) -> bool {
        self.contact_names().any(|(_, rigid)| rigid)
    }
}
