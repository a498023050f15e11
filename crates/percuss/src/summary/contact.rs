//! Results of contacts in the summary.

use serde::{Deserialize, Serialize};

use super::equivalent::EquivalentForce;
use super::peak::Peak;
use crate::geometry::dents::CarriedCrush;

use crate::model::Model;
use crate::state::PairState;
use crate::step::effective_mass::EffectiveMass;

/// Place of a contact.
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

/// Energy split of a contact between its partners, over an interval or in an impact.
///
/// `given[0] + given[1] + lost + stored + scheme` is zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergySplit {
    /// Work of the contact on either partner, shape (2) \[J\]: energy that enters a beam propagates as waves.
    pub given: [f64; 2],
    /// Energy lost in the contact \[J\].
    pub lost: f64,
    /// The part of it that was stored in the contact's own spring when the touching part of a beam fractured \[J\].
    pub failure: f64,
    /// Increase of the energy in the contact's own spring since the start; zero once it is open again \[J\].
    pub stored: f64,
    /// Energy taken from the contact by the force of a scheme without exact energies (negative: supplied); round-off of the others \[J\].
    pub scheme: f64,
}

impl EnergySplit {
    /// Assigns the missing energy to the scheme.
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
    /// Normal impulse of all points in it \[N s\].
    pub impulse: f64,
    /// Tangential impulse of friction in it; NaN under a smooth law, which has no friction \[N s\].
    pub tangential_impulse: f64,
    /// Largest force of a smooth contact in it, summed over its points; unset for persistent contact of rigid bodies, which has
    /// none but means over steps.
    pub peak_force: Peak,
    /// Relative velocity at the start, of the point that touches first, positive when approaching \[m/s\].
    pub approach_velocity: f64,
    /// Relative velocity at the end, of the last separating point, positive when separating; NaN if still closed, or if the step does not resolve
    /// the separation \[m/s\].
    pub separation_velocity: f64,
    /// Steps in which it was closed, in part or throughout.
    pub steps: usize,
    /// Whether the gap moved steadily before and after: its rate changed by less than itself within a step.
    pub steady: bool,
    /// Whether the point that touched first is the one that left last: velocities of two points make no coefficient.
    pub one_point: bool,
    /// Whether it ended with the fracture of the touching part of a beam: there was no separation.
    pub torn: bool,
    /// Place of the first closing.
    pub place: ContactPlace,
    /// Place of the last opening, or last closed place.
    pub place_end: ContactPlace,
    /// Energies.
    pub energy: EnergySplit,
}

/// Reason why an interval has no coefficient of restitution.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum NoRestitution {
    /// It is still closed at the end of the run.
    Closed,
    /// Persistent contact of rigid bodies at rest relative to each other.
    Persistent,
    /// There was no approach.
    NoApproach,
    /// It lasted for this number of steps, too few to follow it.
    Steps(usize),
    /// Within a step the gap's rate changes by more than itself.
    Unsteady,
    /// One point touched first, another one left last.
    Points,
    /// The touching part of a beam fractured.
    Torn,
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
            Self::Torn => f.write_str("the contact ended with the fracture of the beam"),
        }
    }
}

impl ContactInterval {
    /// An interval of fewer steps than this is not resolved: its start and its end are a large share of it.
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
        if self.torn {
            return Err(NoRestitution::Torn);
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

/// Ratio of separation to approach velocity, if there was an approach; round-off after a plastic impact counts as zero.
fn quotient(approach: f64, separation: f64) -> Result<f64, NoRestitution> {
    // The approach of a contact that rests first and separates later is round-off.
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
    /// Place of the impact of that point.
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

/// Results of the contact of two partners.
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
        /// Number of impacts, stored or not.
        impact_count: usize,
        /// Impacts in which Newton's law would have given energy, so that Moreau's was used.
        fallback_count: usize,
        /// Impulse of all impacts and of persistent contact \[N s\].
        impulse_total: f64,
        /// Impulse of persistent contact only \[N s\].
        impulse_resting: f64,
        /// Intervals in which the contact stayed closed (persistent contact), shape (intervals); impulse included.
        intervals: Vec<ContactInterval>,
        /// Largest penetration \[m\]: negligible for located impacts, the travel in a step for time stepping over impacts, or a remainder that
        /// impulses could not prevent. Zero has no time.
        penetration: Peak,
    },
}

impl ContactRecord {
    /// Limit of the impacts (or intervals) of one contact stored in the summary, so that memory does not grow with the run.
    pub const IMPACTS_KEPT: usize = 10_000;

    /// Times in which it stayed closed, in the order they began.
    pub fn intervals(&self) -> &[ContactInterval] {
        match self {
            Self::Smooth { intervals, .. } | Self::Nonsmooth { intervals, .. } => intervals,
        }
    }

    /// Whether the contact closed in the run.
    pub fn has_closed(&self) -> bool {
        let struck = matches!(self, Self::Nonsmooth { impact_count, .. } if *impact_count > 0);
        struck || !self.intervals().is_empty()
    }

    pub(crate) fn intervals_mut(&mut self) -> &mut [ContactInterval] {
        match self {
            Self::Smooth { intervals, .. } | Self::Nonsmooth { intervals, .. } => intervals,
        }
    }
}

/// A contact: that of a guided projectile with its struck point, or one between two partners.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSummary {
    /// The projectile's or the contact's name.
    pub name: String,
    /// Names of the two partners, shape (2); of a guided projectile's contact, the label of the struck point and the projectile.
    pub between: [String; 2],
    /// Effective mass of a guided projectile's struck point; under a rigid law, that of the beams of any other contact at the place and time of its
    /// first impact.
    pub effective_mass: Option<EffectiveMass>,
    /// Largest permanent indentation at the end, for a law with crushing \[m\].
    pub permanent_penetration: Option<f64>,
    /// Indentation carried along by a loaded body from an indented to an undamaged part of a face, if its force was too small by more than a tenth.
    pub carried_crush: Option<CarriedCrush>,
    /// Largest penetration of a compliant contact, compared with the size of its partners; `None` for guided projectiles and half-planes.
    pub pressed_in: Option<PressedIn>,
    /// Sliding distance and friction work of a contact with friction.
    pub sliding: Option<Sliding>,
    /// Equivalent static force of the impacts, if only permanent loads in equilibrium act on the structure as well.
    pub equivalent_force: Option<EquivalentForce>,
    /// Reason why there is none, for a guided projectile.
    pub no_equivalent_force: Option<String>,
    /// Record.
    pub record: ContactRecord,
}

/// Sliding distance of the surfaces of a contact under force, and dissipation by friction, which determine wear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sliding {
    /// Sum of the magnitudes of the relative tangential displacements of the surfaces; for several simultaneous points their mean,
    /// weighted by the normal impulses \[m\].
    pub distance: f64,
    /// Energy that friction dissipated, a part of the losses of impacts and persistent contact \[J\].
    pub work: f64,
}

impl Sliding {
    /// The same, with a negative work of no more than this magnitude, the round-off of points that stick \[J\], set to zero: friction supplies no
    /// energy.
    pub(crate) fn without_round_off(self, magnitude: f64) -> Self {
        let is_round_off = self.work < 0.0 && self.work >= -magnitude;
        Self { work: if is_round_off { 0.0 } else { self.work }, ..self }
    }
}

/// Penetration under a compliant law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PressedIn {
    /// Penetration at the end of a step, less the permanent indentation of a law with crushing \[m\].
    pub penetration: f64,
    /// Penetration at which the centre or axis of one partner would reach that of the other \[m\]: radii and half depths of both.
    pub through: f64,
    /// Time \[s\].
    pub time: f64,
}

impl PressedIn {
    /// Share of the distance to the middle from which on it is large: the half depth, for two beams of equal depth.
    const DEEP: f64 = 0.5;

    /// For a pair in this state at a time; `None` if it is open, or its target has no centre or axis.
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

    /// Share of the distance to the middle.
    pub fn share(&self) -> f64 {
        self.penetration / self.through
    }

    /// Whether it is so deep that the outlines that touch mean little: force and place are those of lines that go through each other.
    pub fn is_deep(&self) -> bool {
        self.share() > Self::DEEP
    }
}

/// Impacts on several touching bodies at once, for which the impact law determined all impulses together.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MultipleImpactSummary {
    /// Their number.
    pub count: usize,
    /// Time of the first \[s\]; NaN if there was none.
    pub first: f64,
    /// Numbers of two of its contacts, as in [`RunSummary::contacts`](super::RunSummary::contacts), shape (2) \[index of a contact\].
    pub contacts: [usize; 2],
}

impl MultipleImpactSummary {
    /// Counts another one.
    pub(crate) fn take(&mut self, time: f64, contacts: [usize; 2]) {
        if self.count == 0 {
            (self.first, self.contacts) = (time, contacts);
        }
        self.count += 1;
    }
}

impl Default for MultipleImpactSummary {
    fn default() -> Self {
        Self { count: 0, first: f64::NAN, contacts: [0; 2] }
    }
}

impl ContactSummary {
    /// The last interval, if it is cut short by the end of the run: the contact is still closed then, and the peak force of the interval and of the
    /// contact may follow. What lies on something from the start on, and stays there, is not cut short. This is the one rule of what may still
    /// grow, in runs (W016) as in studies.
    pub fn cut_short(&self) -> Option<&ContactInterval> {
        let last = self.record.intervals().iter().rev().find(|one| one.end.is_nan())?;
        let lies = last.start == 0.0 && last.approach_velocity == 0.0;
        (!lies).then_some(last)
    }

    /// Time of the last closing \[s\], if it is still closed at the end of the run: its duration is not known then, its impulse is incomplete, and
    /// velocities of its partners are not yet those after it.
    pub fn closed_since(&self) -> Option<f64> {
        let open_ended = self.record.intervals().iter().rev().find(|one| one.end.is_nan());
        open_ended.map(|one| one.start)
    }
}
