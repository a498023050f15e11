//! What hand formulas look at, and how they answer.

use crate::advice::Comparison;
use crate::case::{Case, Struck};
use crate::structure::gravity;
use crate::surroundings::Surroundings;
use crate::words::{digits, quantity};
use percuss::Model;
use percuss::inspect::MovingPartner;
use percuss::math::vec2::{dot, norm};
use percuss::{
    ContactInterval, ContactPlace, ContactRecord, ContactSummary, Impact, Peak, RunSummary,
};
use percuss::{Settings, Start};

/// The first closing of a contact.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Touch<'a> {
    Interval(&'a ContactInterval),
    Impact(&'a Impact),
}

impl<'a> Touch<'a> {
    pub(super) fn first(record: &'a ContactRecord) -> Option<Self> {
        match record {
            ContactRecord::Smooth { intervals, .. } => intervals.first().map(Self::Interval),
            ContactRecord::Nonsmooth { impacts, intervals, .. } => {
                match (impacts.first(), intervals.first()) {
                    (Some(impact), Some(interval)) if interval.start < impact.time => {
                        Some(Self::Interval(interval))
                    }
                    (Some(impact), _) => Some(Self::Impact(impact)),
                    (None, interval) => interval.map(Self::Interval),
                }
            }
        }
    }

    pub(super) fn place(&self) -> ContactPlace {
        match self {
            Self::Interval(interval) => interval.place,
            Self::Impact(impact) => impact.place,
        }
    }

    pub(super) fn approach(&self) -> f64 {
        match self {
            Self::Interval(interval) => interval.approach_velocity,
            Self::Impact(impact) => impact.approach_velocity,
        }
    }

    pub(super) fn time(&self) -> f64 {
        match self {
            Self::Interval(interval) => interval.start,
            Self::Impact(impact) => impact.time,
        }
    }
}

/// A contact, what became of it, and the hand formulas' view of it.
pub(crate) struct ObservedContact<'a> {
    pub model: &'a Model,
    pub settings: &'a Settings,
    pub run: &'a RunSummary,
    /// Number of the contact.
    pub index: usize,
    pub contact: &'a ContactSummary,
    pub case: &'a Case<'a>,
    pub touch: Touch<'a>,
    /// Speed of approach at the first touch \[m/s\].
    pub speed: f64,
}

/// A formula with its source and its assumptions.
pub(crate) struct Formula {
    pub name: &'static str,
    pub source: &'static str,
    /// Whether it gives an upper bound.
    pub bound: bool,
    pub assumptions: Assumptions,
}

/// A quantity under comparison.
pub(crate) struct Quantity {
    pub name: &'static str,
    pub unit: &'static str,
    pub by_hand: f64,
    pub simulated: f64,
    /// Whether it is of the whole run, not of the first touch alone.
    pub of_run: bool,
}

/// Assumptions, and whether each is met, shape (assumptions). Their text is divided at semicolons, so that none contains one.
#[derive(Clone, Default)]
pub(crate) struct Assumptions(Vec<String>);

impl Assumptions {
    /// Adds one.
    pub fn and(mut self, what: impl Into<String>, met: bool) -> Self {
        let verdict = if met { "met" } else { "not met" };
        self.0.push(format!("{} ({verdict})", what.into()));
        self
    }

    /// Adds one that is not checked.
    pub fn and_unchecked(mut self, what: impl Into<String>) -> Self {
        self.0.push(format!("{} (not checked)", what.into()));
        self
    }

    pub(super) fn text(&self) -> String {
        self.0.join("; ")
    }

    /// Whether none is known not to be met.
    pub fn hold(&self) -> bool {
        !self.0.iter().any(|one| one.ends_with("(not met)"))
    }
}

impl ObservedContact<'_> {
    /// One row a quantity that both sides know, of a formula of linear elasticity.
    pub fn rows(&self, formula: &Formula, quantities: Vec<Quantity>) -> Vec<Comparison> {
        let elastic = |q: &Quantity| self.elastic(formula.assumptions.clone(), q.of_run);
        self.rows_that_hold_if(formula, quantities, elastic)
    }

    /// The same of a formula of anything.
    pub fn rows_of_anything(
        &self,
        formula: &Formula,
        quantities: Vec<Quantity>,
    ) -> Vec<Comparison> {
        self.rows_that_hold_if(formula, quantities, |_| formula.assumptions.clone())
    }

    pub(super) fn rows_that_hold_if(
        &self,
        formula: &Formula,
        quantities: Vec<Quantity>,
        holds_if: impl Fn(&Quantity) -> Assumptions,
    ) -> Vec<Comparison> {
        let known =
            |q: &Quantity| q.by_hand.is_finite() && q.by_hand != 0.0 && q.simulated.is_finite();
        let row = |q: Quantity| Comparison {
            contact: self.contact.name.clone(),
            formula: formula.name,
            source: formula.source,
            quantity: q.name,
            unit: q.unit,
            by_hand: q.by_hand,
            simulated: q.simulated,
            difference_percent: 100.0 * (q.simulated - q.by_hand) / q.by_hand,
            bound: formula.bound,
            holds_if: holds_if(&q).text(),
        };
        quantities.into_iter().filter(known).map(row).collect()
    }

    /// The largest force of all smooth intervals \[N\], and when \[s\]; none under a set-valued law.
    pub fn largest_force(&self) -> Option<Peak> {
        match &self.contact.record {
            ContactRecord::Smooth { peak_force, .. } => Some(*peak_force),
            ContactRecord::Nonsmooth { .. } => None,
        }
    }

    /// The interval of the first touch under a smooth law.
    pub fn interval(&self) -> Option<&ContactInterval> {
        match self.touch {
            Touch::Interval(interval) => Some(interval),
            Touch::Impact(_) => None,
        }
    }

    /// The closed intervals.
    pub fn intervals(&self) -> &[ContactInterval] {
        match &self.contact.record {
            ContactRecord::Smooth { intervals, .. }
            | ContactRecord::Nonsmooth { intervals, .. } => intervals,
        }
    }

    /// Assumptions common to all formulas of a beam at rest without losses: nothing but this contact acts.
    pub fn undisturbed(&self, struck: &Struck<'_>) -> Assumptions {
        let damped = self.is_damped() || self.model.has_viscous_parts();
        self.at_rest(struck).and("no damping", !damped)
    }

    /// The same where the formula knows the losses of the contact itself.
    pub fn undisturbed_but_for_contact(&self, struck: &Struck<'_>) -> Assumptions {
        self.at_rest(struck).and("no damping except in the contact", !self.is_damped())
    }

    pub(super) fn is_damped(&self) -> bool {
        let mut beams = (0..self.model.beam_count()).map(|index| self.model.beam(index));
        self.model.has_viscous_structure()
            || beams.any(|beam| beam.spans().any(|span| span.is_damped()))
    }

    /// Whether no load but gravity acts and nothing is damped but by the contact.
    pub fn is_bare(&self) -> bool {
        !gravity(self.model).1 && !self.is_damped()
    }

    /// That the beam rests, or flies without turning, and that nothing else acts until the contact ends.
    pub fn at_rest(&self, struck: &Struck<'_>) -> Assumptions {
        let (_, loads) = gravity(self.model);
        let around = Surroundings::of(self.model, struck.place.index);
        let rests = match around.start(self.model) {
            Some(v) => norm(v) == 0.0 || !around.held,
            None => false,
        };
        let driven = self.model.supports().any(|support| support.moves);
        let still = rests && !loads && !driven && self.is_alone();
        Assumptions::default().and(
            "beam initially at rest, or unsupported and in pure translation, with only weights and this contact acting until the \
             contact ends",
            still,
        )
    }

    /// Adds that the beam carries its own weight before the touch, where it has any across the impact.
    pub fn carried(&self, struck: &Struck<'_>, mut all: Assumptions, duration: f64) -> Assumptions {
        let pull = struck.pull();
        if pull == 0.0 {
            return all;
        }
        let share = (pull * duration / self.speed).abs();
        let sags = self.settings.start == Start::Static;
        let what = if sags {
            "beam in equilibrium under its own weight before the contact".to_owned()
        } else {
            format!(
                "beam in equilibrium under its own weight before the contact (start = \"static\"), or negligible gravity: it adds {} % \
                 to the approach speed during the contact",
                digits(100.0 * share)
            )
        };
        all = all.and(what, sags || share < WEIGHTLESS);
        all
    }

    /// Velocity along the impact with which the struck beam starts, and flies on where nothing holds it \[m/s\].
    pub(super) fn frame(&self, struck: &Struck<'_>) -> Option<f64> {
        let start = Surroundings::of(self.model, struck.place.index).start(self.model)?;
        Some(dot(start, struck.direction))
    }

    /// The other contacts of what meets here; beams may be joined, so that all of them count as one.
    pub(super) fn others(&self) -> impl Iterator<Item = &ContactRecord> {
        let partners = |k: usize| -> Vec<MovingPartner> {
            let pairs = self.model.contacts().skip(k).take(1).flat_map(|contact| contact.pairs());
            let partners = pairs.take(1).flat_map(|(partners, _)| partners);
            let as_one = |partner| match partner {
                MovingPartner::Beam(_) => MovingPartner::Beam(0),
                body => body,
            };
            partners.map(as_one).collect()
        };
        let own = partners(self.index);
        let shares = move |k: &usize| partners(*k).iter().any(|partner| own.contains(partner));
        let all = (0..self.run.contacts.len()).filter(|k| *k != self.index);
        all.filter(shares).map(|k| &self.run.contacts[k].record)
    }

    /// Whether no other contact of the two was closed before the first touch ended.
    pub fn is_alone(&self) -> bool {
        self.is_alone_until(self.interval().map_or(self.touch.time(), |i| i.end))
    }

    /// Whether no other contact of the two was closed before a time \[s\].
    pub fn is_alone_until(&self, time: f64) -> bool {
        self.others().filter_map(Touch::first).all(|touch| touch.time() > time)
    }

    /// Acceleration of gravity along a direction \[m/s^2\].
    pub fn gravity_along(&self, direction: [f64; 2]) -> f64 {
        dot(gravity(self.model).0, direction)
    }

    /// Largest deflection of the struck point in the direction of the impact, and its time, if the point is recorded and went
    /// farthest that way.
    pub fn deflection(&self, struck: &Struck<'_>) -> Option<[f64; 2]> {
        self.case.guided?;
        let label = &self.contact.between[0];
        let point = self.run.points.iter().find(|p| p.name == *label)?;
        let direction = struck.direction;
        let i = usize::from(direction[1].abs() > direction[0].abs());
        let peak = point.displacement_max[i];
        let value = peak.value / direction[i];
        (value > 0.0).then_some([value, peak.time])
    }

    /// Largest bending moment in the struck beam \[N m\].
    pub fn moment(&self, struck: &Struck<'_>) -> f64 {
        let name = struck.place.beam.name();
        let forces = self.run.section_forces.iter().find(|f| f.name == name);
        forces.map_or(f64::NAN, |f| f.moment.largest().value.abs())
    }

    /// Velocity of a guided projectile at the end, along its line of motion \[m/s\].
    pub fn final_velocity(&self, struck: &Struck<'_>) -> Option<f64> {
        self.case.guided?;
        let projectile = self.run.projectiles.iter().find(|p| p.name == self.contact.name)?;
        Some(dot(projectile.velocity_final, struck.direction))
    }

    /// Velocity of the projectile at release against the beam's own before the touch, where the first contact is the only one, has
    /// ended, and nothing acts afterwards \[m/s\].
    pub fn release_velocity(&self, struck: &Struck<'_>) -> Option<f64> {
        let only = self.intervals().len() == 1 && self.intervals()[0].end.is_finite();
        let falls = self.model.loads().any(|load| load.gravity().is_some());
        let free = !falls && struck.rear.is_none();
        let frame = self.frame(struck)?;
        self.final_velocity(struck).filter(|_| only && free).map(|v| v - frame)
    }

    /// Coefficient of restitution of a set-valued law.
    pub fn restitution(&self) -> Option<f64> {
        self.case.law.rigid().map(|law| law.restitution)
    }

    /// Whether the contact has friction.
    pub fn rubs(&self) -> bool {
        self.case.law.rigid().is_some_and(|law| law.friction > 0.0)
    }

    /// The rows every smooth contact has: largest force, duration.
    pub fn force_and_duration(&self, force: f64, duration: f64) -> Vec<Quantity> {
        let Some(interval) = self.interval() else { return Vec::new() };
        // Formulas hold for one contact.
        let [largest, lasts] = match self.intervals().len() {
            1 => ["largest contact force", "contact duration"],
            _ => ["largest force of the first contact", "duration of the first contact"],
        };
        vec![
            Quantity {
                name: largest,
                unit: "N",
                by_hand: force,
                simulated: interval.peak_force.value,
                of_run: false,
            },
            Quantity {
                name: lasts,
                unit: "s",
                by_hand: duration,
                simulated: interval.end - interval.start,
                of_run: false,
            },
        ]
    }
}

/// Gravity that makes less than this share of the speed of approach within a contact does not matter.
pub(super) const WEIGHTLESS: f64 = 0.01;

/// `a` against `b` in words.
pub(crate) fn against(a: f64, b: f64, unit: &str) -> String {
    format!("{} against {}", quantity(a, unit), quantity(b, unit))
}
