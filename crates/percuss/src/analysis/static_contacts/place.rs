//! A pair of a contact at rest: its gap, its force, its terms of the tangent.

use crate::geometry::configuration::Configuration;
use crate::geometry::pair::{Memory, Pair};
use crate::geometry::row::Row;
use crate::geometry::touch::Touch;
use crate::geometry::turning::Turning;
use crate::model::Model;
use crate::model::frozen::PrescribedDofs;
use crate::step::contacts::{add_tangent, add_turning};
use crate::step::tangent::Tangent;

/// A pair in the analysis.
#[derive(Clone, Copy, Debug)]
pub struct CandidatePair {
    pub pair: usize,
    /// Rigid, and not of a disc.
    pub is_exact: bool,
    /// Side and closest point in the last equilibrium, and the last closest point.
    pub accepted: Memory,
    pub seen: Memory,
    /// Deepest penetration in the equilibria so far, of a law that crushes \[m\].
    pub deepest: f64,
    /// Position of the closest point along the face of the target at the last check; NaN where it does not change with any motion \[m\].
    pub on_face: f64,
    /// Gap at the last check; infinite where contact is impossible \[m\].
    pub gap: f64,
    /// Force at the last check \[N\].
    pub force: f64,
    /// Slope of the force of a compliant pair \[N/m\].
    pub slope: f64,
    /// Multiplier of a rigid pair \[N\].
    pub multiplier: f64,
    /// Stiffness of a rigid pair \[N/m\]; zero for a compliant one.
    pub stiffness: f64,
    /// The one an iteration begins with, and the largest, shape (2) \[N/m\].
    pub stiffnesses: [f64; 2],
    /// Rigid and closed at the last check, and in the last assembled tangent.
    pub closed: bool,
    pub was_closed: bool,
    /// Force in the tangent assembled last \[N\].
    pub held: f64,
    /// Limit of the penetration of a disc in a correction \[m\].
    pub deep: f64,
    pub row: Row,
    /// Arc length along the beam \[m\].
    pub s: f64,
    /// Change of the multiplier by the last correction \[N\].
    pub change: f64,
}

impl CandidatePair {
    /// Whether the pair is compliant.
    pub fn is_compliant(&self) -> bool {
        self.stiffnesses[0] == 0.0
    }

    /// Whether it presses, and the load it presses with is followed: of rigid pairs by those whose forces corrections find.
    pub fn presses(&self) -> bool {
        if self.is_compliant() { self.force > 0.0 } else { self.is_exact && self.multiplier > 0.0 }
    }

    /// Gap and force where the pair is nearest.
    pub fn look(
        &mut self,
        model: &Model,
        pair: &Pair,
        touch: &Touch,
        size: f64,
        pressing: Pressing,
    ) {
        self.gap = touch.gap;
        self.s = pair.along(touch);
        match model.contacts[pair.contact].law.smooth() {
            Some(law) => {
                self.force = law.force(-touch.gap, self.deepest);
                self.slope = law.stiffness(-touch.gap, self.deepest);
                self.closed = false;
            }
            None if self.is_exact && pressing != Pressing::Following => {
                if touch.gap == f64::INFINITY {
                    self.multiplier = 0.0;
                }
                self.closed = self.multiplier > 0.0;
                self.force = self.multiplier;
            }
            None => {
                let round_off = ROUND_OFF * size;
                let gap = if touch.gap.abs() <= round_off { 0.0 } else { touch.gap };
                let pushed = self.multiplier - self.stiffness * gap;
                self.closed = pushed > 0.0;
                self.force = pushed.max(0.0);
            }
        }
    }

    pub fn add_tangent(
        &self,
        model: &Model,
        pair: &Pair,
        (touch, at): (&Touch, &Configuration),
        tangent: &mut Tangent,
        pressing: Pressing,
    ) {
        let (slope, bend) = match model.contacts[pair.contact].law.smooth() {
            Some(law) => (law.stiffness(-touch.gap, self.deepest), self.force),
            None if self.is_exact && pressing == Pressing::Exactly => (0.0, self.multiplier),
            None if self.is_exact && pressing == Pressing::Held => {
                (self.stiffnesses[1], self.multiplier)
            }
            // A closing contact has no force yet, whose rotation would contribute.
            None => (self.stiffness, self.multiplier.max(0.0)),
        };
        let row = moving(model, &self.row);
        let moving = |t: Turning| Turning { forms: t.forms.map(|form| moving(model, &form)), ..t };
        let turning = pair.turning(touch, at).map(moving);
        add_tangent(tangent, &row, &row, slope, bend, turning.as_ref());
        let of_sections = pair.section_turnings(touch, at);
        of_sections.into_iter().flatten().for_each(|t| add_turning(tangent, bend, &moving(t)));
    }
}

/// A form on the movable nodes: the others would only connect the bodies in contact.
pub fn moving(model: &Model, row: &Row) -> Row {
    let mut out = Row::default();
    for (node, c) in row.iter() {
        if !model.dofs_at(node).is_some_and(PrescribedDofs::is_whole) {
            out.add(node, *c);
        }
    }
    out
}

/// A disc at rest.
#[derive(Clone, Copy, Debug)]
pub struct RestingDisc {
    pub body: usize,
    pub node: usize,
    /// Weak spring \[N/m\].
    pub spring: f64,
}

/// Gaps and moves below this share of the largest coordinate are round-off.
pub(super) const ROUND_OFF: f64 = 8.0 * f64::EPSILON;

/// How the rigid contacts of a structure press that are not those of discs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::analysis) enum Pressing {
    /// As those of discs.
    #[default]
    Following,
    /// With multipliers that corrections find.
    Exactly,
    /// With their multipliers; closed contacts resist any motion.
    Held,
}
