//! Failure in a structure at rest: fibres at their failure strain, springs and hinges at their failure extension, joints at their strength.

use std::fmt;

use super::static_search::StaticSearch;
use crate::element::beam::ElementValues;
use crate::element::fibre::StressLaw;
use crate::math::hermite::gauss_points;
use crate::model::Model;
use crate::state::State;
use crate::step::fibres::{fibre_strains, part_at_rest};

/// Uses of strengths within this difference are equal: parts that reach their limit at the same load fail at the same load.
pub(super) const SIMULTANEOUS: f64 = 1e-8;

/// A failure during the growth of loads on a structure at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticFailure {
    /// Factor on the loads at which it failed \[-\].
    pub factor: f64,
    /// Kind and name: `beam.girder`, `spring.brace`, `joint.knee`.
    pub name: String,
    /// Kind of failure.
    pub kind: FailureKind,
    /// Arc length of the section of a beam; NaN for other parts \[m\].
    pub s: f64,
}

/// Kind of a failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FailureKind {
    /// Fibres of a section reached their failure strain.
    Fibres,
    /// All fibres of a section of a beam have failed: the beam fractured.
    Parted,
    /// A spring or a hinge reached its failure extension or rotation, or a spring its strength.
    Extension,
    /// A joint carried its strength, and tore.
    Torn,
}

impl fmt::Display for StaticFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, s) = (&self.name, self.s);
        match self.kind {
            FailureKind::Fibres => write!(f, "fibres of `{name}` fail at s = {s:.6} m"),
            FailureKind::Parted => write!(f, "`{name}` fractures at s = {s:.6} m"),
            FailureKind::Extension | FailureKind::Torn => write!(f, "`{name}` fails"),
        }
    }
}

/// Failures in words, the first of them one by one; with `factors` the load factors too.
pub(super) fn in_words<'a>(
    failures: impl Iterator<Item = &'a StaticFailure>,
    factors: bool,
) -> String {
    const LISTED: usize = 4;
    let one = |f: &StaticFailure| match factors {
        true => format!("{f} at the load factor {:.6}", f.factor),
        false => f.to_string(),
    };
    // If a beam fractures, its fibres need not be reported.
    let all: Vec<&StaticFailure> = failures.collect();
    let parts = |f: &StaticFailure| {
        let same = |g: &&&StaticFailure| g.name == f.name && g.factor == f.factor;
        f.kind == FailureKind::Fibres
            && all.iter().filter(same).any(|g| g.kind == FailureKind::Parted)
    };
    let all: Vec<String> = all.iter().filter(|f| !parts(f)).map(|f| one(f)).collect();
    let mut text = all[..all.len().min(LISTED)].join(", ");
    if all.len() > LISTED {
        text.push_str(&format!(" and {} more", all.len() - LISTED));
    }
    text
}

/// Part that can fail.
#[derive(Clone, Copy, Debug)]
enum Breakable {
    /// A fibre: its number in the state, first node and Gauss point of its element.
    Fibre(usize, usize, usize),
    /// A connector: the number of its memory.
    Connector(usize),
    /// A joint of a given strength.
    Joint(usize),
}

/// Search for the failure point; it ends when the strength is reached to within this share, or its position is known to within it.
const MOST_LOOKS: usize = 60;
const ON_STRENGTH: f64 = 1e-11;
const ON_THE_WAY: f64 = 1e-14;

/// Point on a loading path at which the largest use of a strength equals one, just beyond it: within `range`, where the uses exceed one by
/// `excess`, which is below zero only at the start. `excess_at` goes to a point and returns the excess there; `None` without equilibrium.
pub(super) fn first_failure(
    range: [f64; 2],
    excess: [f64; 2],
    mut excess_at: impl FnMut(f64) -> Option<f64>,
) -> Option<f64> {
    let ([mut low, mut high], [mut below, mut above]) = (range, excess);
    let (mut there, mut last_low, whole) = (above, false, high - low);
    for look in 0..MOST_LOOKS {
        if there <= ON_STRENGTH || high - low <= ON_THE_WAY * whole {
            break;
        }
        // Regula falsi, with weights for an unchanged end (Illinois); with occasional bisection, for uses may jump.
        let share = if look % 6 == 5 { 0.5 } else { -below / (above - below) };
        let middle = low + share.clamp(1e-3, 1.0 - 1e-9) * (high - low);
        let here = excess_at(middle)?;
        if here < 0.0 {
            (low, below) = (middle, here);
            above *= if last_low { 0.5 } else { 1.0 };
        } else {
            (high, above, there) = (middle, here, here);
            below *= if last_low { 1.0 } else { 0.5 };
        }
        last_low = here < 0.0;
    }
    Some(high)
}

impl StaticSearch<'_> {
    /// The largest use of strength at the current point of the search: one means failure.
    pub fn largest_use(&self) -> f64 {
        let mut most = 0.0_f64;
        self.each_use(|_, share| most = most.max(share));
        most
    }

    /// The name of the part that fails first at the current point of the search: the one at its full strength.
    pub fn first_to_fail(&self) -> Option<String> {
        let (mut most, mut first) = (1.0 - SIMULTANEOUS, None);
        self.each_use(|part, share| {
            if share > most {
                (most, first) = (share, Some(part));
            }
        });
        first.map(|part| self.failure(part, f64::NAN).name)
    }

    /// Lets all parts at their full strength fail at the current equilibrium of the search, which then is none. Returns the failures, in the
    /// model's order, by sections.
    pub fn fail(&mut self, factor: f64) -> Vec<StaticFailure> {
        let mut failing = Vec::new();
        self.each_use(|part, share| {
            if share >= 1.0 - SIMULTANEOUS {
                failing.push(part);
            }
        });
        let model = self.model;
        let mut out: Vec<StaticFailure> = Vec::new();
        for part in failing {
            match part {
                Breakable::Fibre(fibre, ..) => self.base.fibres[fibre].failed = true,
                Breakable::Connector(memory) => self.base.memories[memory].failed = true,
                Breakable::Joint(joint) => self.tear(joint),
            }
            let failure = self.failure(part, factor);
            // Fibres of a section come one after the other.
            let known = |one: &StaticFailure| one.name == failure.name && one.s == failure.s;
            if !out.last().is_some_and(known) {
                out.push(failure);
            }
        }
        let State { fibres, parted, .. } = &mut self.base;
        let known = |node: usize| parted.get(node).is_some_and(|parted| *parted);
        for place in part_at_rest(model, known, fibres) {
            self.part_beam(place.0);
            out.push(of_section(model, place, factor, FailureKind::Parted));
        }
        out
    }

    fn failure(&self, part: Breakable, factor: f64) -> StaticFailure {
        let model = self.model;
        match part {
            Breakable::Fibre(_, node, gauss) => {
                of_section(model, (node, gauss), factor, FailureKind::Fibres)
            }
            Breakable::Connector(memory) => {
                let own = model.yielding().find(|(.., own)| own.memory == memory);
                let name = own.map_or_else(String::new, |(.., own)| own.name.clone());
                StaticFailure { factor, name, kind: FailureKind::Extension, s: f64::NAN }
            }
            Breakable::Joint(joint) => {
                let name = format!("joint.{}", model.joints[joint].name);
                StaticFailure { factor, name, kind: FailureKind::Torn, s: f64::NAN }
            }
        }
    }

    /// Reports the use of strength of every part that can fail and has not failed.
    fn each_use(&self, mut each: impl FnMut(Breakable, f64)) {
        let model = self.model;
        if !model.joints.is_empty() {
            for (joint, load) in self.joint_loads().enumerate() {
                if !self.base.joints_parted[joint] {
                    each(Breakable::Joint(joint), model.joints[joint].use_under(&load));
                }
            }
        }
        if !model.is_inelastic() {
            return;
        }
        let displacement = self.displacement();
        for (i, c, own) in model.yielding().filter(|(.., c)| !self.base.memories[c.memory].failed) {
            let q = c.value(&displacement, self.base.coordinates[i]);
            let strained = |law: &StressLaw| law.use_of_failure_strain(q - c.law.free());
            let strained = own.law.as_ref().map_or(0.0, strained);
            let pulled = c.reached_force(q, &self.base.memories).abs() / own.strength;
            each(Breakable::Connector(own.memory), strained.max(pulled));
        }
        for (span, k, a, _) in model.each_element() {
            let Some(fibres) = &span.fibres else { continue };
            let u = ElementValues::new(&displacement[a], &displacement[a + 1]);
            let strains = fibre_strains(span, k, &u);
            let mut numbers = fibres.range(k);
            for (gauss, points) in fibres.of(k).iter().enumerate() {
                let [membrane, bending] = strains[gauss];
                for (fibre, number) in points.iter().zip(&mut numbers) {
                    if !fibre.carries_force || self.base.fibres[number].failed {
                        continue;
                    }
                    let strain = membrane + fibre.height * bending;
                    let share = fibres.laws[fibre.law].use_of_failure_strain(strain);
                    each(Breakable::Fibre(number, a, gauss), share);
                }
            }
        }
    }
}

/// A failure at a Gauss point of the element that starts at a node.
fn of_section(
    model: &Model,
    (node, gauss): (usize, usize),
    factor: f64,
    kind: FailureKind,
) -> StaticFailure {
    let (span, k) = model.element_of(node);
    let (from, to) = (span.stations[k], span.stations[k + 1]);
    let beam = model.beams.iter().find(|beam| beam.nodes.contains(&node));
    let name = beam.map_or_else(String::new, |beam| format!("beam.{}", beam.name));
    StaticFailure { factor, name, kind, s: from + gauss_points()[gauss] * (to - from) }
}
