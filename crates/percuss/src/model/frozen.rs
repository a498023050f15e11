//! The frozen model: what is simulated. Never changes once built.

use std::ops::Range;

use super::definition::{InitialMotion, StrainMeasure};
pub(crate) use super::striking::*;
use super::time_function::PreparedFunction;
use crate::element::beam::{ElementTable, NodeFrame, SectionValues};
use crate::geometry::Axes;
use crate::geometry::axis::AxisElements;
use crate::geometry::pair::Pair;
use crate::linalg::block::{Block, IDENTITY};
use crate::math::vec2::norm;

/// What is simulated; made by [`ModelBuilder`](super::ModelBuilder).
///
/// Nodes and elements of all beams stand in one row, beam after beam, span after span. Behind them stand rigid bodies, a node
/// each, whose degrees of freedom are (u1, u2, angle, nothing).
#[derive(Clone, Debug)]
pub struct Model {
    /// Nodes in the reference configuration, shape (n_node).
    pub(crate) nodes: Vec<NodeFrame>,
    /// Beams, in the order they were defined.
    pub(crate) beams: Vec<BeamData>,
    /// Spans of all beams, in the order of their nodes.
    pub(crate) spans: Vec<Span>,
    /// Components held at nodes, in the order of the nodes.
    pub(crate) prescribed: Vec<PrescribedDofs>,
    /// Constraints that a node's own components cannot express: joints, supports between nodes or for a time.
    pub(crate) constraints: Vec<Constraint>,
    /// Springs and dampers.
    pub(crate) connectors: Vec<Connector>,
    /// Masses at points.
    pub(crate) masses: Vec<MassData>,
    /// Supports, in the order they were defined.
    pub(crate) supports: Vec<SupportData>,
    /// Prescribed motions.
    pub(crate) motions: Vec<PreparedFunction>,
    /// Rigid bodies: guided projectiles, discs, obstacles, in the order of their nodes.
    pub(crate) bodies: Vec<Body>,
    /// Obstacles, in the order they were defined.
    pub(crate) obstacles: Vec<ObstacleData>,
    /// Guided projectiles, in the order they were defined.
    pub(crate) projectiles: Vec<ProjectileData>,
    /// Contacts: those of guided projectiles, then those defined.
    pub(crate) contacts: Vec<ContactData>,
    /// Pairs that can touch, contact after contact.
    pub(crate) pairs: Vec<Pair>,
    /// Loads, in the order they were defined.
    pub(crate) loads: Vec<LoadData>,
    /// Ratios of damping of the flexible modes, from the lowest on.
    pub(crate) modal_damping: Vec<f64>,
    /// Motion at the start.
    pub(crate) initial_motion: InitialMotion,
    /// Motions at the start of nodes that have one of their own; later ones count.
    pub(crate) own_motions: Vec<(Range<usize>, InitialMotion)>,
    /// Recorded points, each once.
    pub(crate) points: Vec<MaterialPoint>,
    /// Mass of beams, point masses and projectiles, a scale \[kg\].
    pub(crate) total_mass: f64,
}

/// A beam: what its spans have in common.
#[derive(Clone, Debug)]
pub(crate) struct BeamData {
    pub name: String,
    pub spans: Range<usize>,
    pub nodes: Range<usize>,
    pub elements: Range<usize>,
    /// Arc length \[m\].
    pub length: f64,
    /// Its elements as contact sees them.
    pub axis: AxisElements,
}

/// A part of a beam without corner, of one material and one section.
#[derive(Clone, Debug)]
pub(crate) struct Span {
    pub nodes: Range<usize>,
    pub elements: Range<usize>,
    /// One table for all elements, or one for each.
    pub tables: Vec<ElementTable>,
    /// Sections at the start, in the middle and at the end of the elements, as many as tables.
    pub sections: Vec<[SectionValues; 3]>,
    /// Arc length from the start of the beam at the nodes, shape (n_node of the span) \[m\].
    pub stations: Vec<f64>,
    pub measure: StrainMeasure,
    /// Retardation time of Kelvin-Voigt damping \[s\].
    pub retardation: f64,
    /// Mass-proportional damping \[1/s\].
    pub mass_damping: f64,
}

impl Span {
    /// Table of the element of number `k` in the span.
    #[inline(always)]
    pub fn table(&self, k: usize) -> &ElementTable {
        &self.tables[if self.tables.len() == 1 { 0 } else { k }]
    }

    /// Sections of the element of number `k` in the span at its start, in its middle and at its end.
    pub fn sections(&self, k: usize) -> &[SectionValues; 3] {
        &self.sections[if self.sections.len() == 1 { 0 } else { k }]
    }

    /// Whether anything in it is damped by its material.
    pub fn is_damped(&self) -> bool {
        self.retardation > 0.0 || self.mass_damping > 0.0
    }
}

/// Components of a node's displacement that are held, or moved as prescribed.
#[derive(Clone, Debug)]
pub(crate) struct PrescribedDofs {
    pub node: usize,
    /// The support that holds them, the first one where several do; `None` for the guide of a projectile
    /// and for obstacles, whose reactions are those of their contacts.
    pub support: Option<usize>,
    /// Held directions in (u1, u2, u1', u2'), orthonormal; at most four.
    pub normals: Vec<[f64; 4]>,
    /// Motion along each of them.
    pub drives: Vec<Drive>,
    /// What they leave free: `I - N N^T` with the held directions as columns of N.
    pub free: Block,
}

impl PrescribedDofs {
    /// Nothing held yet.
    pub fn new(node: usize, support: Option<usize>) -> Self {
        Self { node, support, normals: Vec::new(), drives: Vec::new(), free: IDENTITY }
    }

    /// Whether nothing is left free.
    pub fn is_whole(&self) -> bool {
        self.normals.len() == 4
    }

    /// Holds one more direction, of unit length and across those held already.
    pub fn hold(&mut self, normal: [f64; 4], drive: Drive) {
        for r in 0..4 {
            for c in 0..4 {
                self.free[r][c] -= normal[r] * normal[c];
            }
        }
        self.normals.push(normal);
        self.drives.push(drive);
    }
}

/// A prescribed value: amplitudes times time functions of [`Model::motions`].
pub(crate) type Drive = Vec<(usize, f64)>;

/// A support, for its reactions.
#[derive(Clone, Debug)]
pub(crate) struct SupportData {
    pub name: String,
    /// Its point; an obstacle has none.
    pub point: Option<MaterialPoint>,
    /// Holds until this time \[s\].
    pub until: f64,
    /// Its time function among [`Model::motions`].
    pub motion: Option<usize>,
    /// Whether it is a stop, which presses only when its gap is closed.
    pub stops: bool,
}

/// A material point: where it lies in the mesh and how it follows the nodes.
#[derive(Clone, Debug)]
pub(crate) struct MaterialPoint {
    pub label: String,
    pub beam: usize,
    /// Node `a` of the element; node `b` is the next one.
    pub node: usize,
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Shape functions (u_a, u_a', u_b, u_b').
    pub shape: [f64; 4],
    /// Derivatives of the shape functions.
    pub slope: [f64; 4],
    /// Reference position \[m\].
    pub position: [f64; 2],
    /// Reference tangent.
    pub tangent: [f64; 2],
}

impl MaterialPoint {
    /// Interpolates nodal values with the shape functions.
    #[inline]
    pub fn value(&self, nodal: &[[f64; 4]]) -> [f64; 2] {
        self.combine(nodal, &self.shape)
    }

    /// Interpolates nodal values with the derivatives of the shape functions.
    #[inline]
    pub fn gradient(&self, nodal: &[[f64; 4]]) -> [f64; 2] {
        self.combine(nodal, &self.slope)
    }

    #[inline]
    fn combine(&self, nodal: &[[f64; 4]], n: &[f64; 4]) -> [f64; 2] {
        let (a, b) = (&nodal[self.node], &nodal[self.node + 1]);
        [
            n[0] * a[0] + n[1] * a[2] + n[2] * b[0] + n[3] * b[2],
            n[0] * a[1] + n[1] * a[3] + n[2] * b[1] + n[3] * b[3],
        ]
    }

    /// Adds `shape^T f` to nodal forces.
    #[inline]
    pub fn spread(&self, force: [f64; 2], nodal: &mut [[f64; 4]]) {
        spread(&self.shape, self.node, force, nodal);
    }

    /// Adds `shape^T f` to the forces on the two nodes of its element.
    pub fn spread_over(&self, force: [f64; 2], nodes: &mut [[f64; 4]; 2]) {
        spread(&self.shape, 0, force, nodes);
    }

    /// Adds `slope^T f` to the forces on the two nodes of its element.
    pub fn spread_gradient_over(&self, force: [f64; 2], nodes: &mut [[f64; 4]; 2]) {
        spread(&self.slope, 0, force, nodes);
    }

    /// Adds `slope^T f` to nodal forces.
    #[inline]
    pub fn spread_gradient(&self, force: [f64; 2], nodal: &mut [[f64; 4]]) {
        spread(&self.slope, self.node, force, nodal);
    }
}

#[inline]
fn spread(n: &[f64; 4], node: usize, force: [f64; 2], nodal: &mut [[f64; 4]]) {
    for i in 0..2 {
        nodal[node][i] += n[0] * force[i];
        nodal[node][2 + i] += n[1] * force[i];
        nodal[node + 1][i] += n[2] * force[i];
        nodal[node + 1][2 + i] += n[3] * force[i];
    }
}

/// A scalar constraint on material points, kept by a multiplier.
#[derive(Clone, Debug)]
pub(crate) struct Constraint {
    pub kind: ConstraintKind,
    /// The support it belongs to; a joint's belong to none.
    pub support: Option<usize>,
    /// Prescribed value.
    pub drive: Drive,
    /// Holds until this time \[s\].
    pub until: f64,
}

/// What is constrained.
#[derive(Clone, Debug)]
pub(crate) enum ConstraintKind {
    /// `direction . u(point) = value`, or of its gradient: a support between nodes.
    Held { point: MaterialPoint, direction: [f64; 2], gradient: bool },
    /// `J t . g(point) = 0` with t the reference tangent turned by the prescribed angle.
    Turned { point: MaterialPoint },
    /// `direction . (u(a) - u(b)) = 0`: positions shared.
    Shared { points: Box<[MaterialPoint; 2]>, direction: [f64; 2] },
    /// `g_a x R g_b = 0` with R the rotation from the reference tangent of b to that of a: the angle is kept.
    Angle { points: Box<[MaterialPoint; 2]>, cosine: f64, sine: f64 },
}

impl Constraint {
    /// The points it ties.
    pub fn points(&self) -> &[MaterialPoint] {
        match &self.kind {
            ConstraintKind::Held { point, .. } | ConstraintKind::Turned { point } => {
                std::slice::from_ref(point)
            }
            ConstraintKind::Shared { points, .. } | ConstraintKind::Angle { points, .. } => {
                points.as_slice()
            }
        }
    }
}

/// A spring and damper on one coordinate.
#[derive(Clone, Debug)]
pub(crate) struct Connector {
    pub coordinate: Coordinate,
    pub law: ConnectorLaw,
    /// Viscous damping of the coordinate, force per rate.
    pub damping: f64,
    /// The support it belongs to, if any.
    pub support: Option<usize>,
    /// Acts until this time \[s\].
    pub until: f64,
}

/// A scalar coordinate of the configuration, zero or its natural value in the reference configuration.
#[derive(Clone, Debug)]
pub(crate) enum Coordinate {
    /// `direction . u(point)` less a prescribed motion.
    Displacement { point: MaterialPoint, direction: [f64; 2], drive: Drive },
    /// Distance between two places.
    Distance { ends: Box<[ConnectorEnd; 2]> },
    /// Angle from the tangent at b, or its reference, to that at a, less that in the reference configuration; the rotation R
    /// takes the reference tangent of b to that of a.
    Angle { a: Box<MaterialPoint>, b: Option<Box<MaterialPoint>>, cosine: f64, sine: f64 },
}

/// A place on a beam or in space.
#[derive(Clone, Debug)]
pub(crate) enum ConnectorEnd {
    Point(MaterialPoint),
    Ground([f64; 2]),
}

/// Potential of a connector.
#[derive(Clone, Copy, Debug)]
pub enum ConnectorLaw {
    /// `k (q - rest)^2 / 2`.
    Linear {
        /// Stiffness k, force per unit of the coordinate.
        stiffness: f64,
        /// Coordinate without force.
        rest: f64,
    },
    /// `k <q - gap>^2 / 2`: no force before the gap is closed.
    OneSided {
        /// Stiffness k, force per unit of the coordinate.
        stiffness: f64,
        /// Coordinate from which on it presses.
        gap: f64,
    },
}

impl ConnectorLaw {
    /// A value of the coordinate without force and energy.
    pub fn free(self) -> f64 {
        match self {
            Self::Linear { rest, .. } => rest,
            Self::OneSided { gap, .. } => gap,
        }
    }
}

/// A mass at a point.
#[derive(Clone, Debug)]
pub(crate) struct MassData {
    pub point: MaterialPoint,
    pub mass: f64,
    pub rotary_inertia: f64,
}

/// A load and its time function.
#[derive(Clone, Debug)]
pub(crate) struct LoadData {
    pub kind: LoadAction,
    pub function: PreparedFunction,
    pub from: f64,
    pub until: f64,
}

/// What a load applies, for a factor of one.
#[derive(Clone, Debug)]
pub(crate) enum LoadAction {
    /// Acceleration of everything that has mass.
    Gravity { acceleration: [f64; 2] },
    /// A force, dead or along (tangent, normal), and a moment.
    Point { point: MaterialPoint, force: [f64; 2], moment: f64, follower: bool },
    /// Nodal forces of a dead distributed load, and each element's share of them, by its node a.
    Dead { nodal: Vec<(usize, [f64; 4])>, shares: Vec<(usize, [[f64; 4]; 2])> },
    /// Forces per length along (tangent, normal) at quadrature points.
    Follower { points: Vec<FollowerPoint> },
}

/// A quadrature point of a follower load.
#[derive(Clone, Debug)]
pub(crate) struct FollowerPoint {
    pub point: MaterialPoint,
    /// Force per length times the weight of the point, along (tangent, normal) \[N\].
    pub force: [f64; 2],
}

impl LoadData {
    /// Whether it acts throughout, as it is.
    pub fn is_steady(&self) -> bool {
        self.function.is_constant() && self.from <= 0.0 && self.until == f64::INFINITY
    }

    /// Mean factor over the step `[start, start + h]`: its impulse is exact.
    pub fn factor(&self, start: f64, h: f64) -> f64 {
        let share = share(self.from, self.until, start, h);
        if share == 0.0 {
            return 0.0;
        }
        let (lo, hi) = (self.from.max(start), self.until.min(start + h));
        let (lo, length) = if share == 1.0 { (start, h) } else { (lo, hi - lo) };
        share * self.function.mean(lo - self.from, length)
    }
}

/// Share of the step `[start, start + h]` in which a load that acts in `[from, until]` acts.
pub(crate) fn share(from: f64, until: f64, start: f64, h: f64) -> f64 {
    // Ends of steps are sums of steps: a difference of some ulps is the same instant.
    let slack = 1e-9 * h;
    let lo = from.max(start);
    let hi = until.min(start + h);
    let share = (hi - lo) / h;
    if from <= start + slack && until >= start + h - slack { 1.0 } else { share.clamp(0.0, 1.0) }
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
    pub(crate) fn each_element(&self) -> impl Iterator<Item = (&Span, usize, usize, usize)> {
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

    /// What is held at a node.
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
    pub(crate) fn extent(&self) -> f64 {
        let from = self.nodes.first().map_or([0.0; 2], |n| n.position);
        let away = |x: [f64; 2]| norm([x[0] - from[0], x[1] - from[1]]);
        let lengths = self.beams.iter().map(|b| b.length);
        lengths.chain(self.nodes.iter().map(|n| away(n.position))).fold(0.0, f64::max)
    }

    /// The beams with all that holds them, without bodies and contacts: what statics and vibrations know.
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
        structure
    }

    /// Whether no part of the structure moves at the start.
    pub(crate) fn is_still(&self) -> bool {
        self.initial_motion == InitialMotion::default() && self.own_motions.is_empty()
    }

    /// Strain measure of the beam called `name`, at its start.
    pub fn strain_measure(&self, name: &str) -> Option<StrainMeasure> {
        let beam = self.beams.iter().find(|b| b.name == name)?;
        Some(self.spans[beam.spans.start].measure)
    }

    /// Whether any force depends on a rate: such forces know the midpoint family of schemes only.
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
                .any(|b| matches!(b.kind, BodyKind::Rear { damping, .. } if damping > 0.0))
            || !self.modal_damping.is_empty()
    }

    /// Acceleration of gravity, for factors of one \[m/s^2\].
    pub(crate) fn gravity(&self) -> f64 {
        let each = self.loads.iter().map(|load| match load.kind {
            LoadAction::Gravity { acceleration: [x, y] } => x.hypot(y),
            _ => 0.0,
        });
        each.sum()
    }

    /// Times at which a support lets go \[s\].
    pub(crate) fn releases(&self) -> impl Iterator<Item = f64> {
        self.supports.iter().map(|s| s.until).filter(|t| t.is_finite())
    }

    /// Whether supports can give impulses: by rigid contacts, or where prescribed velocities jump.
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
