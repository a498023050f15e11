//! Records of contacts: intervals, impacts, forces, impulses, energies.
//!
//! A contact consists of pairs, and its resultant is reported: its force is the sum over all of them at one instant, an interval lasts from the
//! closing of the first until the opening of the last, and simultaneous impacts of several pairs are one impact.

mod gap_over_step;
mod rigid;
mod sliding;
mod smooth;

use serde::{Deserialize, Serialize};

use crate::geometry::configuration::Configuration;
use crate::geometry::pair::Pair;
use crate::geometry::row::Row;
use crate::geometry::touch::{SearchRegion, Touch};
use crate::model::frozen::ContactData;
use crate::model::{Model, SmoothLaw};
use crate::run::solving::trial::{Accepted, Separated, Solved};
use crate::state::{PairState, State};
use crate::step::workspace::Workspace;
use crate::summary::{
    ContactInterval, ContactPlace, ContactRecord, EnergySplit, Peak, PressedIn, Sliding,
};
use gap_over_step::GapOverStep;
use sliding::Slides;

/// The record of all contacts.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ContactLog {
    /// One record a contact, shape (contacts).
    pub records: Vec<ContactRecord>,
    /// Largest violation of the conditions of impulses, relative to the largest rate.
    pub residual: f64,
    /// Time of the largest penetration of each smooth contact, shape (contacts).
    pub pressed: Vec<Option<PressedIn>>,
    /// Sliding distances and friction works of the contacts with friction, shape (contacts).
    slides: Vec<Option<Slides>>,
    /// Number of the open interval of each smooth contact in its record, shape (contacts) \[index of an interval\].
    open: Vec<Option<usize>>,
    /// The pair that touched first in the last interval of each smooth contact, shape (contacts) \[index of a pair\].
    first: Vec<usize>,
    /// Motion of each smooth pair in the last step with an open gap, shape (pairs).
    free: Vec<Free>,
    /// Intervals that ended in the step before, shape (such intervals).
    released: Vec<Released>,
    /// Gaps of the current contact that are closed over the step, shape (such pairs).
    #[serde(skip)]
    gaps: Vec<GapOverStep>,
    /// Persistent contact, one entry a contact, shape (contacts).
    rests: Vec<Resting>,
    /// Those that have any, shape (such contacts) \[index of a contact\].
    resting: Vec<usize>,
    /// Number of the current part of a step.
    part: u64,
    /// Number of the part of a step in which each contact last had an impact, shape (contacts) \[number of a part\].
    struck: Vec<u64>,
}

/// Time and size of a step.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct StepTime {
    start: f64,
    h: f64,
    /// Whether it is as short as an impact, in which rates jump.
    impulsive: bool,
}

/// An interval that has ended in a step, and the gap at its end of the point that separated last.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Released {
    pair: usize,
    contact: usize,
    /// Its number in the contact's record.
    interval: usize,
    gap: f64,
    rate: f64,
    span: StepTime,
}

/// The free motion of a gap.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Free {
    /// Acceleration of the gap \[m/s^2\].
    acceleration: f64,
    /// Until when \[s\].
    until: f64,
}

/// The persistent contact of two partners.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Resting {
    /// Number of its interval in the contact's record, if it is open.
    interval: Option<usize>,
    /// Number of the part of a step in which a pair last pressed, and that pair.
    pressed: u64,
    pair: usize,
    /// Number of the part of a step in which pairs ceased to press.
    ceased: u64,
    /// Times, and the rate of the last of them, shape (2) \[s, m/s\].
    end: [f64; 2],
    /// Whether a fracture has separated that pair since.
    torn: bool,
}

impl Default for Free {
    fn default() -> Self {
        Self { acceleration: 0.0, until: f64::NAN }
    }
}

/// A step from all sides.
#[derive(Clone, Copy)]
struct StepViews<'a> {
    model: &'a Model,
    state: &'a State,
    work: &'a Workspace,
    /// Smooth pairs as they were at its start, shape (such pairs).
    before: &'a [PairState],
    /// Pairs that a fracture at its end has separated, as they were before it, in their order, shape (such pairs).
    separated: &'a [Separated],
    span: StepTime,
}

impl StepViews<'_> {
    /// Pair `i` at the end of the step, before a fracture there.
    fn after(&self, i: usize) -> &PairState {
        self.separation(i).map_or(&self.state.pairs[i], |separated| &separated.before)
    }

    /// How a fracture at the end of the step has separated pair `i`.
    fn separation(&self, i: usize) -> Option<&Separated> {
        let found = self.separated.binary_search_by_key(&i, |separated| separated.pair);
        found.ok().map(|k| &self.separated[k])
    }

    /// Law of the smooth contact `k` of the step.
    fn law(&self, k: usize) -> Option<&SmoothLaw> {
        self.model.contacts[self.model.pairs[self.work.smooth[k].pair].contact].law.smooth()
    }
}

impl ContactLog {
    /// Empty records.
    pub fn new(model: &Model, state: &State) -> Self {
        let record = |contact: &ContactData| match contact.law.smooth() {
            Some(law) => {
                let each = state.pairs[contact.pairs.clone()].iter();
                let value: f64 = each.map(|p| law.force(-p.gap, p.deepest)).sum();
                // A contact that has not closed has no peak force, not one of zero at some instant.
                let start = Peak { value, time: state.time };
                let peak_force = if value > 0.0 { start } else { Peak::default() };
                ContactRecord::Smooth { peak_force, intervals: Vec::new() }
            }
            None => ContactRecord::Nonsmooth {
                impacts: Vec::new(),
                impact_count: 0,
                fallback_count: 0,
                impulse_total: 0.0,
                impulse_resting: 0.0,
                intervals: Vec::new(),
                penetration: Peak { value: 0.0, time: f64::NAN },
            },
        };
        let contacts = model.contacts.len();
        Self {
            records: model.contacts.iter().map(record).collect(),
            residual: 0.0,
            pressed: vec![None; contacts],
            slides: (model.contacts.iter())
                .map(|contact| contact.law.has_friction().then(Slides::default))
                .collect(),
            open: vec![None; contacts],
            first: vec![0; contacts],
            free: vec![Free::default(); model.pairs.len()],
            released: Vec::new(),
            gaps: Vec::new(),
            rests: vec![Resting::default(); contacts],
            resting: Vec::new(),
            part: 0,
            struck: vec![0; contacts],
        }
    }

    /// Whether it has the shape of another record of the same model, with valid indices.
    pub fn fits(&self, other: &Self, model: &Model) -> bool {
        let shape = |log: &Self| {
            let contacts = [log.records.len(), log.open.len(), log.first.len(), log.rests.len()];
            let others = [log.struck.len(), log.pressed.len(), log.slides.len()];
            (contacts, others, log.free.len())
        };
        let smooth = |log: &Self| {
            let kinds = log.records.iter().map(|r| matches!(r, ContactRecord::Smooth { .. }));
            kinds.collect::<Vec<_>>()
        };
        let (contacts, pairs) = (self.records.len(), model.pairs.len());
        shape(self) == shape(other)
            && smooth(self) == smooth(other)
            && self.resting.iter().all(|contact| *contact < contacts)
            && self.first.iter().all(|pair| *pair < pairs.max(1))
            && self.released.iter().all(|released| {
                released.contact < contacts
                    && released.pair < pairs
                    && released.interval < self.records[released.contact].intervals().len()
            })
            && self.records.iter().zip(&self.open).zip(&self.rests).all(|((record, open), rest)| {
                let known = |i: &usize| *i < record.intervals().len();
                open.iter().all(known)
                    && rest.interval.iter().all(known)
                    && rest.pair < pairs.max(1)
            })
    }

    /// Sliding distance and friction work of a contact; `None` without friction.
    pub fn sliding(&self, contact: usize) -> Option<Sliding> {
        self.slides[contact].map(|slides| slides.total)
    }

    /// Enters a part of a step.
    pub fn take(&mut self, part: &Accepted<'_>) {
        let (model, state, work, start) = (part.model, part.after, part.work(), part.before());
        let Solved { trial, impulsive, .. } = part.solved;
        let span = StepTime { start: start.time, h: trial.h, impulsive: *impulsive };
        let (before, separated) = (&start.smooth[..], part.separated);
        let seen = StepViews { model, state, work, before, separated, span };
        self.part += 1;
        self.smooth_contacts(seen);
        if !trial.active.is_empty() {
            self.residual = self.residual.max(work.impact_residual);
        }
        self.rigid_contacts(seen, trial);
        self.tear_rests(part.separated);
        for &i in part.awake {
            let depth = -state.pairs[i].gap;
            if let ContactRecord::Nonsmooth { penetration, .. } =
                &mut self.records[model.pairs[i].contact]
                && depth > penetration.value
            {
                *penetration = Peak { value: depth, time: state.time };
            }
        }
    }
}

impl StepViews<'_> {
    /// Closest point of pair `i`, at a share of the step back from its end.
    fn place(&self, i: usize, back: f64) -> ContactPlace {
        let (model, state) = (self.model, self.state);
        let now = state.configuration();
        let at = Configuration { increment: &self.work.increment, share: -back, ..now };
        let pair = &model.pairs[i];
        let Some(touch) = pair.touch(model, &at, &state.pairs[i].memory, SearchRegion::Near) else {
            return ContactPlace::default();
        };
        let position = [0, 1].map(|i| touch.closest_place[i] + touch.radius * touch.normal[i]);
        ContactPlace { s: pair.along(&touch), position }
    }

    /// Adds the work of a force along a row on either partner of a pair.
    fn add_energy(&self, energy: &mut EnergySplit, pair: &Pair, row: &Row, force: f64) {
        if force == 0.0 {
            return;
        }
        let source = self.model.nodes_of_mover(pair.movers[0]);
        let on_source = force * row.on_some(&self.work.increment, |n| source.contains(&n));
        energy.given[pair.source_partner] += on_source;
        energy.given[1 - pair.source_partner] += force * row.on(&self.work.increment) - on_source;
    }
}

/// An interval that opens.
pub fn opened(start: f64, approach_velocity: f64, place: ContactPlace) -> ContactInterval {
    ContactInterval {
        start,
        end: f64::NAN,
        impulse: 0.0,
        tangential_impulse: f64::NAN,
        peak_force: Peak::default(),
        approach_velocity,
        separation_velocity: f64::NAN,
        steps: 0,
        steady: true,
        one_point: true,
        torn: false,
        place,
        place_end: place,
        energy: EnergySplit::default(),
    }
}

/// Separation velocity of a resting contact, from the rates of its gap at start and end of the part of a step without contact force. The midpoint
/// rule keeps the mean gap over a step, so that its rate oscillates about zero from step to step: only a mean is meaningful.
pub fn rate_of_rest(before: f64, after: f64) -> f64 {
    (0.5 * (before + after)).max(0.0)
}

/// Pair `i` in the current state.
pub fn touch(model: &Model, state: &State, i: usize, reach: SearchRegion) -> Option<Touch> {
    let at = state.configuration();
    model.pairs[i].touch(model, &at, &state.pairs[i].memory, reach)
}
