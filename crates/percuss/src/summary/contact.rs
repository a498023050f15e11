//! What the summary tells of contacts.

use serde::{Deserialize, Serialize};

use super::peak::Peak;
use crate::geometry::dents::CarriedCrush;

use crate::model::Model;
use crate::state::PairState;
use crate::step::effective_mass::EffectiveMass;

/// Where two things touch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactPlace {
    /// Arc length along the first partner, if it is a beam; else NaN \[m\].
    pub s: f64,
    /// Position in the plane, shape (2) \[m\].
    pub position: [f64; 2],
}

impl Default for ContactPlace {
    fn default() -> Self {
        Self { s: f64::NAN, position: [f64::NAN; 2] }
    }
}

/// What a contact did to the energies of the two that touch, over an interval or in an impact.
///
/// `given[0] + given[1] + lost + stored + scheme` is zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergySplit {
    /// Work of the contact on either partner, shape (2) \[J\]: what goes into a beam runs on as waves.
    pub given: [f64; 2],
    /// Energy lost in the contact \[J\].
    pub lost: f64,
    /// Energy that the contact's own spring holds more than at the start; zero once it is open again \[J\].
    pub stored: f64,
    /// What the force of a scheme without exact energies takes out of the contact (negative: brings in); round-off of the others \[J\].
    pub scheme: f64,
}

impl EnergySplit {
    /// Leaves to the scheme what is missing.
    #[doc(hidden)]
    pub fn balance(&mut self) {
        self.scheme = 0.0 - (self.given[0] + self.given[1] + self.lost + self.stored);
    }
}

/// One closed interval of a contact, resolved within the step: from when the first of its points closes until the last opens.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactInterval {
    /// Start \[s\].
    pub start: f64,
    /// End \[s\]; NaN if still closed at the end of the run.
    pub end: f64,
    /// Impulse handed over in it by all points, along their normals \[N s\].
    pub impulse: f64,
    /// Impulse of friction in it, along the tangent; NaN under a smooth law, which knows none \[N s\].
    pub tangential_impulse: f64,
    /// Largest force of a smooth contact in it, summed over its points; unset for persistent contact of rigid bodies, which has
    /// none but means over steps.
    pub peak_force: Peak,
    /// Relative velocity at the start, of the point that touches first, positive when approaching \[m/s\].
    pub approach_velocity: f64,
    /// Relative velocity at the end, of the point that leaves last, positive when separating; NaN if still closed, or if the step
    /// does not resolve how it parted \[m/s\].
    pub separation_velocity: f64,
    /// Steps in which it was closed, in part or throughout.
    pub steps: usize,
    /// Whether the gap moved steadily before and after: its rate changed by less than itself within a step.
    pub steady: bool,
    /// Whether the point that touched first is the one that left last: velocities of two points make no coefficient.
    pub one_point: bool,
    /// Where it closed first.
    pub place: ContactPlace,
    /// Where it opened last, or was last closed.
    pub place_end: ContactPlace,
    /// Energies.
    pub energy: EnergySplit,
}

/// Why a touch has no coefficient of restitution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum NoRestitution {
    /// It is still closed at the end of the run.
    Closed,
    /// Persistent contact, to which rigid things come by being at rest against each other.
    Persistent,
    /// Nothing approached.
    NoApproach,
    /// It lasted for this number of steps, too few to follow it.
    Steps(usize),
    /// Within a step the gap's rate changes by more than itself.
    Unsteady,
    /// One point touched first, another one left last.
    Points,
}

impl std::fmt::Display for NoRestitution {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Closed => f.write_str("still closed"),
            Self::Persistent => f.write_str("persistent contact"),
            Self::NoApproach => f.write_str("nothing approached"),
            Self::Steps(1) => f.write_str("not resolved: 1 step in contact"),
            Self::Steps(n) => write!(f, "not resolved: {n} steps in contact"),
            Self::Unsteady => f.write_str(
                "not resolved: the gap's velocity changes by more than itself in a step",
            ),
            Self::Points => f.write_str("touched first and left last at different points"),
        }
    }
}

impl ContactInterval {
    /// An interval of fewer steps than this is not resolved: its beginning and its end are half of what is known of it.
    pub const RESOLVED: usize = 4;

    /// Apparent coefficient of restitution: velocity of separation over that of approach.
    ///
    /// # Errors
    /// Why there is none.
    pub fn restitution(&self) -> Result<f64, NoRestitution> {
        if !self.tangential_impulse.is_nan() {
            return Err(NoRestitution::Persistent);
        }
        if self.end.is_nan() {
            return Err(NoRestitution::Closed);
        }
        if self.steps < Self::RESOLVED {
            return Err(NoRestitution::Steps(self.steps));
        }
        if !self.steady || self.separation_velocity.is_nan() {
            return Err(NoRestitution::Unsteady);
        }
        if !self.one_point {
            return Err(NoRestitution::Points);
        }
        quotient(self.approach_velocity, self.separation_velocity)
    }

    /// Its derivative, from those of the velocities.
    ///
    /// # Errors
    /// Why there is no coefficient.
    pub fn restitution_derivative(&self, derivative: &Self) -> Result<f64, NoRestitution> {
        let by = [derivative.approach_velocity, derivative.separation_velocity];
        Ok(quotient_derivative(self.restitution()?, self.approach_velocity, by))
    }
}

/// Derivative of a coefficient of restitution by those of approach and separation.
fn quotient_derivative(coefficient: f64, approach: f64, by: [f64; 2]) -> f64 {
    (by[1] - coefficient * by[0]) / approach
}

/// Separation over approach, where something approached; what is left of a plastic impact by round-off is none.
fn quotient(approach: f64, separation: f64) -> Result<f64, NoRestitution> {
    // What comes to rest and is thrown off later has approached by round-off.
    let approached = approach > 1e-9 * separation.abs();
    let coefficient = separation / approach;
    let plain = if coefficient.abs() < 1e-8 { 0.0 } else { coefficient };
    if approached { Ok(plain) } else { Err(NoRestitution::NoApproach) }
}

/// One impact of rigid bodies: all points of a contact that strike at one instant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Impact {
    /// Time \[s\].
    pub time: f64,
    /// Impulse along the normal, of all points that struck \[N s\].
    pub impulse: f64,
    /// Impulse of friction, along the tangent: the normal turned by -90 degrees \[N s\].
    pub tangential_impulse: f64,
    /// Points of the contact that struck at this instant.
    pub points: usize,
    /// Relative velocity before, of the point that struck fastest, positive when approaching \[m/s\].
    pub approach_velocity: f64,
    /// Relative velocity of the same point after, positive when separating \[m/s\].
    pub separation_velocity: f64,
    /// Where that point struck.
    pub place: ContactPlace,
    /// Energies.
    pub energy: EnergySplit,
    /// Whether Newton's law would have given energy, so that Moreau's was used.
    pub fallback_law: bool,
}

impl Impact {
    /// Apparent coefficient of restitution: velocity of separation over that of approach.
    ///
    /// # Errors
    /// Why there is none.
    pub fn restitution(&self) -> Result<f64, NoRestitution> {
        quotient(self.approach_velocity, self.separation_velocity)
    }

    /// Its derivative, from those of the velocities.
    ///
    /// # Errors
    /// Why there is no coefficient.
    pub fn restitution_derivative(&self, derivative: &Self) -> Result<f64, NoRestitution> {
        let by = [derivative.approach_velocity, derivative.separation_velocity];
        Ok(quotient_derivative(self.restitution()?, self.approach_velocity, by))
    }
}

/// What happened between two things that can touch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ContactRecord {
    /// Under a smooth law.
    Smooth {
        /// Largest force, summed over all points at one instant; unset if the contact never closed.
        peak_force: Peak,
        /// Closed intervals, in the order they began, shape (intervals); the first [`ContactRecord::IMPACTS_KEPT`] of them.
        intervals: Vec<ContactInterval>,
    },
    /// Under a set-valued law.
    Nonsmooth {
        /// Impacts, in order, shape (impacts); the first [`ContactRecord::IMPACTS_KEPT`] of them.
        impacts: Vec<Impact>,
        /// Number of impacts, kept or not.
        impact_count: usize,
        /// Impacts in which Newton's law would have given energy, so that Moreau's was used.
        fallback_count: usize,
        /// Impulse of all impacts and of persistent contact \[N s\].
        impulse_total: f64,
        /// Impulse of persistent contact alone \[N s\].
        impulse_resting: f64,
        /// Intervals in which the contact stayed closed (persistent contact), shape (intervals); impulse included.
        intervals: Vec<ContactInterval>,
        /// How deep one thing was inside the other at most \[m\]: next to nothing where impacts are located, the way of a step
        /// where time steps over them, or what impulses could not hold. Zero has no time.
        penetration: Peak,
    },
}

impl ContactRecord {
    /// So many impacts (or intervals) of one contact are kept in the summary, so that memory does not grow with the run.
    pub const IMPACTS_KEPT: usize = 10_000;

    /// Times in which it stayed closed, in the order they began.
    pub fn intervals(&self) -> &[ContactInterval] {
        match self {
            Self::Smooth { intervals, .. } | Self::Nonsmooth { intervals, .. } => intervals,
        }
    }

    pub(crate) fn intervals_mut(&mut self) -> &mut [ContactInterval] {
        match self {
            Self::Smooth { intervals, .. } | Self::Nonsmooth { intervals, .. } => intervals,
        }
    }
}

/// A contact: that of a guided projectile with the point it strikes, or one between two things that can touch.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSummary {
    /// The projectile's or the contact's name.
    pub name: String,
    /// Names of the two partners, shape (2); of a guided projectile's contact, the label of the struck point and the projectile.
    pub between: [String; 2],
    /// Effective mass of what a guided projectile strikes; under a rigid law, of the beams of any other contact where and when it
    /// first struck.
    pub effective_mass: Option<EffectiveMass>,
    /// What stays pushed in at the end where it is deepest, of a law that crushes \[m\].
    pub permanent_penetration: Option<f64>,
    /// What a source of it, while it pressed, took along from where it had pushed a face in to where that is whole, if its force was
    /// more than a tenth too small for it.
    pub carried_crush: Option<CarriedCrush>,
    /// When a compliant contact was pressed in deepest, held against what touches; none of guided projectiles and of half-planes.
    pub pressed_in: Option<PressedIn>,
    /// How far the two slid on each other, of a contact with friction.
    pub sliding: Option<Sliding>,
    /// Static force that does what the impacts did at most, where nothing but a weight at rest acts on the structure as well.
    pub equivalent_force: Option<EquivalentForce>,
    /// Why there is none, of a guided projectile.
    pub no_equivalent_force: Option<&'static str>,
    /// What happened.
    pub record: ContactRecord,
}

/// How far the surfaces of a contact slid on each other while it pressed, and what friction took: what wear goes by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sliding {
    /// Sum of the sizes of the tangential displacements of one surface against the other, where several points press at once their mean,
    /// weighted by the normal impulses \[m\].
    pub distance: f64,
    /// Energy that friction dissipated, a part of what impacts and persistent contact lost \[J\].
    pub work: f64,
}

/// How deep one thing was pressed into another under a compliant law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PressedIn {
    /// Penetration at the end of a step, less what stays pushed in of a law that crushes \[m\].
    pub penetration: f64,
    /// The penetration at which the middle of what touches, its centre or axis, would meet that of what it touches \[m\]: radii and half depths
    /// of both.
    pub through: f64,
    /// Time \[s\].
    pub time: f64,
}

impl PressedIn {
    /// Share of the way to the middle from which on it is deep: the half depth, where two beams of one depth touch.
    const DEEP: f64 = 0.5;

    /// Of a pair that is seen so at a time; `None` if it is open, or touches what has no middle.
    pub(crate) fn of(model: &Model, i: usize, seen: &PairState, time: f64) -> Option<Self> {
        let pair = &model.pairs[i];
        let law = model.contacts[pair.contact].law.smooth()?;
        if !(pair.target.is_outline() || pair.target.is_round()) {
            return None;
        }
        let through = pair.thickness(model, &seen.memory);
        let pressed = Self { penetration: -law.free_gap(seen), through, time };
        (pressed.penetration > 0.0 && through > 0.0).then_some(pressed)
    }

    /// Share of the way to the middle.
    pub fn share(&self) -> f64 {
        self.penetration / self.through
    }

    /// Whether it is so deep that the outlines that touch mean little: force and place are those of lines that go through each other.
    pub fn is_deep(&self) -> bool {
        self.share() > Self::DEEP
    }
}

/// Static force at the struck point along the line of flight, beside the weight if there is any, that does by linear elasticity to the
/// structure what a run did at most.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EquivalentForce {
    /// The one that bends the struck beam by the same largest moment \[N\].
    pub moment: f64,
    /// The one that deflects the struck point as far along the line of flight \[N\]; none where that is not recorded.
    pub deflection: Option<f64>,
    /// Whether something yielded in the run: then it is the force on the same structure as if that stayed elastic.
    pub as_if_elastic: bool,
}

/// Impacts at which several touching bodies were struck at once, so that the impact law shared the blow among them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SharedBlows {
    /// Their number.
    pub count: usize,
    /// Time of the first \[s\]; NaN if there was none.
    pub first: f64,
    /// Numbers of two of its contacts, as in [`RunSummary::contacts`](super::RunSummary::contacts), shape (2) \[index of a contact\].
    pub contacts: [usize; 2],
}

impl SharedBlows {
    /// Counts another one.
    pub(crate) fn take(&mut self, time: f64, contacts: [usize; 2]) {
        if self.count == 0 {
            (self.first, self.contacts) = (time, contacts);
        }
        self.count += 1;
    }
}

impl Default for SharedBlows {
    fn default() -> Self {
        Self { count: 0, first: f64::NAN, contacts: [0; 2] }
    }
}

impl ContactSummary {
    /// When it closed for the last time \[s\], if it is still closed at the end of the run: its duration is not known then, its impulse goes on,
    /// and velocities of what it touches are not yet those after it.
    pub fn closed_since(&self) -> Option<f64> {
        let open_ended = self.record.intervals().iter().rev().find(|one| one.end.is_nan());
        open_ended.map(|one| one.start)
    }
}
