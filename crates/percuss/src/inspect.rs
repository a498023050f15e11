//! A frozen model as others may read it: beams with their sections, what holds and ties them, bodies, contacts, loads.
//!
//! Views borrow the [`Model`] and can change nothing. They are for whoever judges a model before a run (the advisor) and say no
//! more than that needs; numbers of beams, nodes, bodies and contacts are those of the order of definition.

use std::ops::Range;

use crate::element::beam::{GaussRow, SectionValues};
use crate::geometry::pair::Target;
use crate::math::vec2::{add, norm, rot90, scale, sub};
pub use crate::model::frozen::ConnectorLaw;
use crate::model::frozen::{
    BeamData, Connector, ConnectorEnd, Constraint, ContactData, Coordinate, LoadAction, LoadData,
    MaterialPoint, PrescribedDofs, Span,
};
pub use crate::model::striking::{Body, BodyKind};
use crate::model::{InitialMotion, Model, StrainMeasure, TouchLaw};

/// A beam.
#[derive(Clone, Copy, Debug)]
pub struct BeamView<'m> {
    model: &'m Model,
    data: &'m BeamData,
}

impl<'m> BeamView<'m> {
    /// Its name.
    pub fn name(&self) -> &'m str {
        &self.data.name
    }

    /// Arc length \[m\].
    pub fn length(&self) -> f64 {
        self.data.length
    }

    /// Its nodes in the row of all nodes.
    pub fn nodes(&self) -> Range<usize> {
        self.data.nodes.clone()
    }

    /// Its spans, start to end.
    pub fn spans(&self) -> impl Iterator<Item = SpanView<'m>> + Clone + use<'m> {
        self.model.spans[self.data.spans.clone()].iter().map(|data| SpanView { data })
    }
}

/// A span: a part of a beam without corner, of one material and one section.
#[derive(Clone, Copy, Debug)]
pub struct SpanView<'m> {
    data: &'m Span,
}

impl<'m> SpanView<'m> {
    /// Its nodes in the row of all nodes.
    pub fn nodes(&self) -> Range<usize> {
        self.data.nodes.clone()
    }

    /// Number of its elements.
    pub fn element_count(&self) -> usize {
        self.data.elements.len()
    }

    /// Arc length from the start of the beam at its nodes, shape (number of nodes) \[m\].
    pub fn stations(&self) -> &'m [f64] {
        &self.data.stations
    }

    /// Strain measure.
    pub fn measure(&self) -> StrainMeasure {
        self.data.measure
    }

    /// Whether its material damps.
    pub fn is_damped(&self) -> bool {
        self.data.is_damped()
    }

    /// Whether its section varies from element to element.
    pub fn varies(&self) -> bool {
        self.data.sections.len() > 1
    }

    /// Length of the element of number `k` in the span \[m\].
    pub fn element_length(&self, k: usize) -> f64 {
        self.data.table(k).length
    }

    /// The beam at the Gauss points of the element of number `k` in the span; the second one is its middle.
    pub fn gauss_points(&self, k: usize) -> [GaussPointView; 3] {
        self.data.table(k).rows.each_ref().map(GaussPointView::of)
    }

    /// Constants of the section at both ends of the element of number `k` in the span.
    pub fn end_sections(&self, k: usize) -> [SectionConstants; 2] {
        let [start, _, end] = self.data.sections(k);
        [start, end].map(SectionConstants::of)
    }
}

/// Constants of a section, per length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionConstants {
    /// Axial stiffness EA \[N\].
    pub axial: f64,
    /// Bending stiffness EI \[N m^2\].
    pub bending: f64,
    /// Rotary inertia rhoI \[kg m\].
    pub rotary: f64,
    /// Mass rhoA \[kg/m\].
    pub mass: f64,
    /// Area \[m^2\].
    pub area: f64,
    /// Distance of the extreme fibres from the centre line \[m\]; NaN if unknown.
    pub half_depth: f64,
}

impl SectionConstants {
    fn of(values: &SectionValues) -> Self {
        let SectionValues { law, mass, area, half_depth } = *values;
        Self { axial: law.axial, bending: law.bending, rotary: law.rotary, mass, area, half_depth }
    }
}

/// A Gauss point of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussPointView {
    /// Integration weight \[m\].
    pub weight: f64,
    /// Tangent of the reference.
    pub tangent: [f64; 2],
    /// The section there.
    pub section: SectionConstants,
}

impl GaussPointView {
    fn of(row: &GaussRow) -> Self {
        let GaussRow { weight, tangent, section: law, mass, area, half_depth, .. } = *row;
        let section = SectionValues { law, mass, area, half_depth };
        Self { weight, tangent, section: SectionConstants::of(&section) }
    }
}

/// A material point of a beam.
#[derive(Clone, Copy, Debug)]
pub struct PointView<'m> {
    /// What the user calls it.
    pub label: &'m str,
    /// Its beam.
    pub beam: usize,
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Position in the reference configuration \[m\].
    pub position: [f64; 2],
}

impl<'m> PointView<'m> {
    fn of(point: &'m MaterialPoint) -> Self {
        Self { label: &point.label, beam: point.beam, s: point.s, position: point.position }
    }
}

/// Prescribed degrees of freedom of a node.
#[derive(Clone, Copy, Debug)]
pub struct PrescribedView<'m> {
    /// The node.
    pub node: usize,
    /// The support that prescribes them; none for a guide or an obstacle.
    pub support: Option<usize>,
    /// Prescribed directions in (u1, u2, u1', u2'), orthonormal, shape (at most 4).
    pub directions: &'m [[f64; 4]],
    /// Whether a motion is prescribed along any of them.
    pub moves: bool,
}

impl<'m> PrescribedView<'m> {
    fn of(dofs: &'m PrescribedDofs) -> Self {
        let moves = dofs.drives.iter().any(|drive| !drive.is_empty());
        Self { node: dofs.node, support: dofs.support, directions: &dofs.normals, moves }
    }
}

/// A support.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupportView {
    /// Acts until this time \[s\].
    pub until: f64,
    /// Whether it moves as prescribed.
    pub moves: bool,
}

/// A constraint: a joint, or a support between nodes or for a time.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintView<'m>(&'m Constraint);

impl<'m> ConstraintView<'m> {
    /// The points it ties.
    pub fn points(&self) -> impl ExactSizeIterator<Item = PointView<'m>> + use<'m> {
        self.0.points().iter().map(PointView::of)
    }
}

/// A spring or damper on one coordinate.
#[derive(Clone, Copy, Debug)]
pub struct ConnectorView<'m>(&'m Connector);

/// The coordinate that a connector acts on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConnectorCoordinate {
    /// Displacement of its point in a direction.
    Displacement,
    /// Distance between two places.
    Distance {
        /// In the reference configuration \[m\].
        reference: f64,
    },
    /// Angle between two tangents, or of one.
    Angle,
}

impl<'m> ConnectorView<'m> {
    /// Its material points, one or two.
    pub fn points(&self) -> impl Iterator<Item = PointView<'m>> + use<'m> {
        let points: [Option<&'m MaterialPoint>; 2] = match &self.0.coordinate {
            Coordinate::Displacement { point, .. } => [Some(point), None],
            Coordinate::Distance { ends } => ends.each_ref().map(|end| match end {
                ConnectorEnd::Point(point) => Some(point),
                ConnectorEnd::Ground(_) => None,
            }),
            Coordinate::Angle { a, b, .. } => [Some(a), b.as_deref()],
        };
        points.into_iter().flatten().map(PointView::of)
    }

    /// Its potential.
    pub fn law(&self) -> ConnectorLaw {
        self.0.law
    }

    /// What it acts on.
    pub fn coordinate(&self) -> ConnectorCoordinate {
        match &self.0.coordinate {
            Coordinate::Displacement { .. } => ConnectorCoordinate::Displacement,
            Coordinate::Distance { ends } => {
                let [a, b] = ends.each_ref().map(|end| match end {
                    ConnectorEnd::Point(point) => point.position,
                    ConnectorEnd::Ground(position) => *position,
                });
                ConnectorCoordinate::Distance { reference: norm(sub(a, b)) }
            }
            Coordinate::Angle { .. } => ConnectorCoordinate::Angle,
        }
    }
}

/// A point mass.
#[derive(Clone, Copy, Debug)]
pub struct PointMassView<'m> {
    /// Where it sits.
    pub point: PointView<'m>,
    /// Mass \[kg\].
    pub mass: f64,
}

/// A guided projectile.
#[derive(Clone, Copy, Debug)]
pub struct GuidedView<'m> {
    /// Its body that strikes.
    pub body: &'m Body,
    /// The mass behind it, if it has one.
    pub rear: Option<&'m Body>,
    /// Unit vector of the line of flight, from projectile to beam.
    pub direction: [f64; 2],
    /// The point struck.
    pub point: PointView<'m>,
}

/// What takes part in a contact and moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MovingPartner {
    /// The beam of this number.
    Beam(usize),
    /// The body of this number.
    Body(usize),
}

/// What the gap of a pair is measured to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TargetShape {
    /// The struck point of a guided projectile, with the gap in the reference configuration \[m\].
    Guided {
        /// The gap.
        standoff: f64,
    },
    /// The rim of a disc.
    Round,
    /// A straight line with its normal.
    Line {
        /// Unit normal, away from what lies behind the line.
        normal: [f64; 2],
    },
    /// A wall between two points.
    Segment,
    /// The outline of a beam.
    Outline,
}

/// A contact.
#[derive(Clone, Copy, Debug)]
pub struct ContactView<'m> {
    model: &'m Model,
    data: &'m ContactData,
}

impl<'m> ContactView<'m> {
    /// Its name.
    pub fn name(&self) -> &'m str {
        &self.data.name
    }

    /// Its law.
    pub fn law(&self) -> &'m TouchLaw {
        &self.data.law
    }

    /// Its pairs of one round thing and one target: the partners, and the shape of the target.
    pub fn pairs(
        &self,
    ) -> impl ExactSizeIterator<Item = ([MovingPartner; 2], TargetShape)> + use<'m> {
        let beams = self.model.beams.len();
        let partner = move |mover: usize| match mover.checked_sub(beams) {
            None => MovingPartner::Beam(mover),
            Some(body) => MovingPartner::Body(body),
        };
        let pairs = self.model.pairs[self.data.pairs.clone()].iter();
        pairs.map(move |pair| (pair.movers.map(partner), shape(&pair.target)))
    }
}

fn shape(target: &Target) -> TargetShape {
    match target {
        Target::Guided { standoff, .. } => TargetShape::Guided { standoff: *standoff },
        Target::Round { .. } => TargetShape::Round,
        Target::Line { normal, .. } => TargetShape::Line { normal: *normal },
        Target::Segment { .. } => TargetShape::Segment,
        Target::Axis { .. } => TargetShape::Outline,
    }
}

/// A load.
#[derive(Clone, Copy, Debug)]
pub struct LoadView<'m>(&'m LoadData);

impl LoadView<'_> {
    /// The acceleration that it gives everything that has mass, for a factor of one, if it is gravity \[m/s^2\].
    pub fn gravity(&self) -> Option<[f64; 2]> {
        match self.0.kind {
            LoadAction::Gravity { acceleration } => Some(acceleration),
            _ => None,
        }
    }

    /// Mean factor over the interval `[start, start + h]` \[s\].
    pub fn factor(&self, start: f64, h: f64) -> f64 {
        self.0.factor(start, h)
    }
}

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
        self.supports.iter().map(|s| SupportView { until: s.until, moves: s.motion.is_some() })
    }

    /// Constraints.
    pub fn constraints(&self) -> impl Iterator<Item = ConstraintView<'_>> {
        self.constraints.iter().map(ConstraintView)
    }

    /// Springs and dampers.
    pub fn connectors(&self) -> impl Iterator<Item = ConnectorView<'_>> {
        self.connectors.iter().map(ConnectorView)
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

    /// Loads, in the order of definition.
    pub fn loads(&self) -> impl ExactSizeIterator<Item = LoadView<'_>> {
        self.loads.iter().map(LoadView)
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
