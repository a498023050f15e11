//! Views of contacts and loads.

use super::PointView;
use crate::geometry::pair::Target;
use crate::model::frozen::{ContactData, LoadAction, LoadData};
use crate::model::{Model, TouchLaw};

/// Movable partner of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MovingPartner {
    /// The beam of this number.
    Beam(usize),
    /// The body of this number.
    Body(usize),
}

/// Target of the gap of a pair.
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
        /// Unit normal, away from the half-plane behind the line, shape (2) \[-\].
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
    pub(super) model: &'m Model,
    pub(super) data: &'m ContactData,
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

    /// Its pairs of a round partner and a target: the partners, and the shape of the target.
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
    /// Whether both ends of a beam meet the other partner as half circles.
    pub fn has_round_ends(&self, beam: usize) -> bool {
        let round = |target: &Target| match target {
            Target::Axis { beam: own, ends, .. } => {
                *own == beam && ends.iter().all(|end| end.rounding > 0.0 && end.half_width == 0.0)
            }
            _ => false,
        };
        self.model.pairs[self.data.pairs.clone()].iter().any(|pair| round(&pair.target))
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
pub struct LoadView<'m>(pub(super) &'m LoadData);

impl<'m> LoadView<'m> {
    /// Name given by the user.
    pub fn name(&self) -> &'m str {
        &self.0.name
    }

    /// The membrane strain without forces of largest magnitude that it gives to an element, for a factor of one \[-\]; `None` unless it gives
    /// strains or temperatures.
    pub fn given_strain(&self) -> Option<f64> {
        let LoadAction::Strain { elements, .. } = &self.0.kind else { return None };
        elements.iter().map(|one| one.strain).max_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// The change of temperature, for a factor of one, if that is what it gives \[K\].
    pub fn temperature_change(&self) -> Option<f64> {
        match self.0.kind {
            LoadAction::Strain { change, .. } => change,
            _ => None,
        }
    }

    /// The acceleration of all masses, for a factor of one, if it is gravity or an acceleration of the base \[m/s^2\].
    pub fn gravity(&self) -> Option<[f64; 2]> {
        match self.0.kind {
            LoadAction::Gravity { acceleration } => Some(acceleration),
            _ => None,
        }
    }

    /// The point that it acts at, if it is one.
    pub fn point(&self) -> Option<PointView<'m>> {
        match &self.0.kind {
            LoadAction::Point { point, .. } => Some(PointView::of(point)),
            _ => None,
        }
    }

    /// Mean factor over the interval `[start, start + h]` \[s\].
    pub fn factor(&self, start: f64, h: f64) -> f64 {
        self.0.factor(start, h)
    }
}
