//! Views of supports, joints and connectors of beams.

use super::Body;
use crate::math::vec2::{norm, sub};
use crate::model::frozen::{
    Connector, ConnectorEnd, ConnectorLaw, Constraint, Coordinate, FoundationData, MaterialPoint,
    PrescribedDofs,
};
use crate::model::{FoundationLaw, Model};

/// A material point of a beam.
#[derive(Clone, Copy, Debug)]
pub struct PointView<'m> {
    /// Name given by the user.
    pub label: &'m str,
    /// Its beam.
    pub beam: usize,
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Position in the reference configuration, shape (2) \[m\].
    pub position: [f64; 2],
}

impl<'m> PointView<'m> {
    pub(super) fn of(point: &'m MaterialPoint) -> Self {
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
    /// Prescribed directions in (u1, u2, u1', u2'), orthonormal, shape (at most 4, 4) \[-\].
    pub directions: &'m [[f64; 4]],
    /// Whether a motion is prescribed along any of them.
    pub moves: bool,
}

impl<'m> PrescribedView<'m> {
    pub(super) fn of(dofs: &'m PrescribedDofs) -> Self {
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
    /// Largest jump of its prescribed velocity, that from rest at the start included, as a share of the largest velocity \[-\].
    pub jump: f64,
}

/// A constraint: a joint, or a support between nodes or for a time.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintView<'m>(pub(super) &'m Constraint);

impl<'m> ConstraintView<'m> {
    /// The points it ties.
    pub fn points(&self) -> impl ExactSizeIterator<Item = PointView<'m>> + use<'m> {
        self.0.points().iter().map(PointView::of)
    }
}

/// A spring or damper on one coordinate.
#[derive(Clone, Copy, Debug)]
pub struct ConnectorView<'m>(pub(super) &'m Connector);

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

impl ConnectorCoordinate {
    /// Its value in the reference configuration \[m, rad\].
    pub fn reference(self) -> f64 {
        match self {
            Self::Distance { reference } => reference,
            Self::Displacement | Self::Angle => 0.0,
        }
    }
}

impl<'m> ConnectorView<'m> {
    /// Its material points on beams, two at most; a spring may end at a projectile or on the ground.
    pub fn points(&self) -> impl Iterator<Item = PointView<'m>> + use<'m> {
        let points: [Option<&'m MaterialPoint>; 2] = match &self.0.coordinate {
            Coordinate::Displacement { point, .. } => [Some(point), None],
            Coordinate::Distance { ends } => ends.each_ref().map(|end| match end {
                ConnectorEnd::Point(point) => Some(point),
                ConnectorEnd::Body(_) | ConnectorEnd::Ground(_) => None,
            }),
            Coordinate::Angle { a, b, .. } => [Some(a), b.as_deref()],
        };
        points.into_iter().flatten().map(PointView::of)
    }

    /// Names of the projectiles that it ends at.
    pub fn projectiles(&self) -> impl Iterator<Item = &'m str> + use<'m> {
        let ends: &'m [ConnectorEnd] = match &self.0.coordinate {
            Coordinate::Distance { ends } => ends.as_slice(),
            _ => &[],
        };
        ends.iter().filter_map(|end| match end {
            ConnectorEnd::Body(point) => Some(point.label.as_str()),
            _ => None,
        })
    }

    /// Its potential.
    pub fn law(&self) -> ConnectorLaw {
        self.0.law.clone()
    }

    /// Point of action.
    pub fn coordinate(&self) -> ConnectorCoordinate {
        match &self.0.coordinate {
            Coordinate::Displacement { .. } => ConnectorCoordinate::Displacement,
            Coordinate::Distance { ends } => {
                let [a, b] = ends.each_ref().map(|end| match end {
                    ConnectorEnd::Point(point) | ConnectorEnd::Body(point) => point.position,
                    ConnectorEnd::Ground(position) => *position,
                });
                ConnectorCoordinate::Distance { reference: norm(sub(a, b)) }
            }
            Coordinate::Angle { .. } => ConnectorCoordinate::Angle,
        }
    }
}

/// A foundation along a stretch of a beam.
#[derive(Clone, Copy, Debug)]
pub struct FoundationView<'m>(pub(super) &'m FoundationData);

impl<'m> FoundationView<'m> {
    /// Name given by the user.
    pub fn name(&self) -> &'m str {
        &self.0.name
    }

    /// Its beam.
    pub fn beam(&self) -> usize {
        self.0.beam
    }

    /// Arc lengths of its ends, shape (2) \[m\].
    pub fn stretch(&self) -> [f64; 2] {
        self.0.stretch
    }

    /// Its law.
    pub fn law(&self) -> &'m FoundationLaw {
        &self.0.law
    }

    /// Directions in which its places push the beam, unit vectors, and the length that each stands for, shape (places) \[-, m\].
    pub fn pushes(&self, model: &'m Model) -> impl Iterator<Item = ([f64; 2], f64)> + use<'m> {
        let own = &model.connectors[self.0.connectors.clone()];
        own.iter().zip(&self.0.lengths).filter_map(|(c, length)| match &c.coordinate {
            Coordinate::Displacement { direction, .. } => {
                Some((direction.map(|x| 0.0 - x), *length))
            }
            _ => None,
        })
    }
}

/// A point mass.
#[derive(Clone, Copy, Debug)]
pub struct PointMassView<'m> {
    /// Position.
    pub point: PointView<'m>,
    /// Mass \[kg\].
    pub mass: f64,
}

/// A guided projectile.
#[derive(Clone, Copy, Debug)]
pub struct GuidedView<'m> {
    /// Its body that strikes.
    pub body: &'m Body,
    /// Its rear mass, if any.
    pub rear: Option<&'m Body>,
    /// Unit vector of the line of motion, from projectile to beam, shape (2) \[-\].
    pub direction: [f64; 2],
    /// The point struck.
    pub point: PointView<'m>,
}
