//! The size of steps for a requested accuracy in place of a step.
//!
//! The schemes advance a motion `u` as the trapezoidal rule does, whose error over a step is `h^3 u''' / 12` (Hairer, Norsett, Wanner 1993, II.9).
//! Here `u'''` comes from second divided differences of mean velocities `d / h` of the last three parts of steps. An unresolved oscillation has a
//! small share of the displacements and so of these, though it may have most of the accelerations. The error is relative to the largest deflection
//! so far. A contact force is treated likewise: the error of its mean in the impulse, `h^3 F'' / 12`, times the largest velocity of approach,
//! relative to the largest energy; and `h^2 F'' / 12` relative to the largest force. A step with a larger error in any of them is rejected before
//! it is accepted, as one that does not converge is.
//!
//! Errors of single steps are of order `h^3`, those of a motion over a given time of order `h^2`: steps may have errors of the power 3/2 of the
//! accuracy, so that the error of a run is proportional to the accuracy.

use serde::{Deserialize, Serialize};

use super::first_step::contact_steps;
use crate::math::vec2::norm;
use crate::model::Model;
use crate::model::frozen::{BeamData, ContactData};
use crate::run::solving::trial::{Accepted, PartKind, PartSolution, PartStart, Solved};
use crate::settings::Settings;
use crate::state::{PairState, State};
use crate::step::workspace::Workspace;
use crate::summary::StepControl;

/// Factor of the accepted error of a step relative to the accuracy to the power 3/2. Calibrated with runs and converged references.
const ADMITTED: f64 = 0.5;
/// Factor of the accepted error of a force, relative to the largest one, to the accuracy.
const FORCE: f64 = 1.0;
/// Largest accepted error of a force, whatever the accuracy: an error of a tenth admits two steps in a contact, of which second differences know
/// nothing, and a peak that is twice the right one.
const FORCE_MOST: f64 = 0.04;
/// At the start of a contact force the error is relative to this share of the force at which the spring of the contact would store the total
/// energy: only a small mass of a beam participates in a short impact.
const ONSET: f64 = 0.1;
/// Accuracy for which the first steps follow a rigid impact, ...
const BOUNCES: f64 = 2.5e-3;
/// ... if another one may come within this number of steps.
const SOON: f64 = 40.0;
/// Part of the step that the estimate admits that is taken.
const SAFETY: f64 = 0.9;
/// Bounds of the size of a step relative to the previous one, and of a repeated one relative to the rejected one.
const SHRINKS: f64 = 0.2;
const GROWS: f64 = 2.0;
const REPEATED: f64 = 0.7;
/// Smallest and largest steps relative to the first.
const SMALLEST: f64 = 1e-2;
const LARGEST: f64 = 1e3;
/// Deflections that are none, relative to the scale of positions and to the displacements at the start: what is left of an equilibrium by round-off
/// vibrates with all frequencies of the mesh.
const NO_DEFLECTION: [f64; 2] = [1e-9, 1e-4];
/// A part shorter than this share of the previous one contains no information on the motion.
const SHORT: f64 = 0.05;

/// Result of a part of a step.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Means {
    /// Its size \[s\].
    size: f64,
    /// Mean velocities of observed nodes, shape (nodes watched, 2) \[m/s\].
    velocity: Vec<[f64; 2]>,
    /// Mean forces, shape (contacts) \[N\].
    force: Vec<f64>,
}

/// The size of the next steps, and its data.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StepSizeControl {
    /// Error of a step that is admitted.
    admitted: f64,
    /// Accepted error of a force relative to the largest one.
    force: f64,
    /// Largest step after an impact, during which another one may follow \[s\].
    soon: f64,
    /// First step \[s\].
    first: f64,
    /// Size of the next step \[s\].
    pub next: f64,
    /// Size that the parts of this step admit \[s\].
    admits: f64,
    /// The last two parts, the latest first, shape (2).
    past: [Means; 2],
    /// Number of these that belong to the motion: zero after an impact.
    known: usize,
    /// Velocities at the start of free bodies, shape (nodes watched, 2) \[m/s\].
    start: Vec<[f64; 2]>,
    /// Displacements relative to a continued initial motion, shape (nodes watched, 2) \[m\].
    moved: Vec<[f64; 2]>,
    /// Whether they are deflections, not of bodies that moved from the start while others were at rest; shape (nodes watched).
    deflects: Vec<bool>,
    /// The largest of them \[m\].
    deflection: f64,
    /// Largest steps during contact of a guided projectile, infinite for other contacts; shape (contacts) \[s\].
    contact_step: Vec<f64>,
    /// Masses that a driven obstacle strikes, zero of all other contacts; shape (contacts) \[kg\].
    driven: Vec<f64>,
    /// Largest velocities of approach, shape (contacts) \[m/s\].
    approach: Vec<f64>,
    /// Largest forces, shape (contacts) \[N\].
    peak: Vec<f64>,
    /// Largest error of an accepted step so far.
    error: f64,
    /// Whether the end has determined the size of a step, also of one that was refused: a run with a later end would have had another one.
    pub(in crate::run) ends: bool,
    /// Data of the summary.
    control: StepControl,
}

/// Nodes of the beams, or of the bodies where there are no beams.
fn watched(model: &Model) -> std::ops::Range<usize> {
    let beams = model.beam_node_count();
    if beams > 0 { 0..beams } else { 0..model.node_count() }
}

fn plane(v: &[f64; 4]) -> [f64; 2] {
    [v[0], v[1]]
}

/// Masses of beams and bodies in the contacts of driven obstacles, zero of all other contacts; shape (contacts) \[kg\].
fn driven_masses(model: &Model) -> Vec<f64> {
    let beams = model.beams.len();
    let of_beams: Vec<f64> = model.beams.iter().map(|beam| beam_mass(model, beam)).collect();
    let driven = |mover: usize| {
        let mut own = model.obstacles.iter().filter(|one| one.body + beams == mover);
        own.any(|one| model.supports[one.support].motion.is_some())
    };
    let mass = |mover: usize| match mover.checked_sub(beams) {
        Some(body) => model.bodies[body].mass,
        None => of_beams[mover],
    };
    let struck = |contact: &ContactData| {
        let pairs = model.pairs[contact.pairs.clone()].iter().map(|pair| pair.movers);
        let pairs = pairs.filter(|movers| movers.iter().any(|one| driven(*one)));
        pairs.map(|movers| movers.map(mass).iter().sum()).fold(0.0, f64::max)
    };
    model.contacts.iter().map(struck).collect()
}

/// Mass of a beam by the sections in the middle of its elements \[kg\].
fn beam_mass(model: &Model, beam: &BeamData) -> f64 {
    let spans = model.spans[beam.spans.clone()].iter();
    let masses = spans.flat_map(|span| {
        let each = 0..span.elements.len();
        each.map(move |k| span.section_at(k, 0.5).mass * span.table(k).length)
    });
    masses.sum()
}

/// Deflection at the start relative to which errors of a structure at rest are none \[m\].
fn no_deflection(model: &Model, state: &State) -> f64 {
    let displaced = state.displacement[watched(model)].iter().map(|u| norm(plane(u)));
    let [of_positions, of_displacements] = NO_DEFLECTION;
    let displaced = of_displacements * displaced.fold(0.0, f64::max);
    displaced.max(of_positions * model.position_scale())
}

impl StepSizeControl {
    /// State before the first step, if an accuracy is requested.
    pub fn new(model: &Model, settings: &Settings, state: &State) -> Option<Self> {
        let accuracy = settings.accuracy?;
        let nodes = watched(model);
        let mut start: Vec<[f64; 2]> = state.velocity[nodes.clone()].iter().map(plane).collect();
        let mut deflects = vec![true; nodes.len()];
        for beam in &model.beams {
            let own = beam.nodes.clone();
            let flies = start[own.clone()].iter().any(|v| norm(*v) > 0.0)
                && own.clone().all(|node| model.dofs_at(node).is_none());
            match flies {
                true => deflects[own].fill(false),
                false => start[own].fill([0.0; 2]),
            }
        }
        if deflects.iter().all(|deflects| !deflects) {
            deflects.fill(true);
        }
        let speed = state.velocity.iter().map(|v| norm(plane(v))).fold(0.0, f64::max);
        let first = settings.step;
        let force = (FORCE * accuracy).min(FORCE_MOST);
        let none = Means {
            size: first,
            velocity: vec![[0.0; 2]; nodes.len()],
            force: vec![0.0; model.contacts.len()],
        };
        Some(Self {
            admitted: (ADMITTED * accuracy).powf(1.5),
            force,
            soon: (accuracy / BOUNCES).sqrt() * first,
            first,
            next: first,
            admits: f64::INFINITY,
            past: [none.clone(), none],
            known: 0,
            moved: vec![[0.0; 2]; start.len()],
            start,
            deflects,
            deflection: (speed * first).max(no_deflection(model, state)),
            contact_step: contact_steps(model, (12.0 * force).sqrt()),
            driven: driven_masses(model),
            approach: vec![0.0; model.contacts.len()],
            peak: vec![0.0; model.contacts.len()],
            error: 0.0,
            ends: false,
            control: StepControl::new(accuracy),
        })
    }

    /// Whether it is one of another run of the model.
    pub fn fits(&self, other: &Self) -> bool {
        let lengths = |one: &Self| {
            let past = one.past.each_ref().map(|p| (p.velocity.len(), p.force.len()));
            let others = [one.start.len(), one.moved.len(), one.deflects.len()];
            let contacts = [one.contact_step.len(), one.approach.len(), one.peak.len()];
            (past, others, contacts, one.driven.len())
        };
        let valid = self.next > 0.0 && self.next.is_finite();
        valid && lengths(self) == lengths(other) && self.first == other.first
    }

    /// Data of the summary on the steps.
    pub fn control(&self) -> StepControl {
        StepControl { estimate: self.error.powf(2.0 / 3.0) / ADMITTED, ..self.control }
    }

    /// Size of the step from `time` on: the remaining time if that is hardly more.
    pub fn target(&self, left: f64) -> f64 {
        if self.is_last(left) { left } else { self.next }
    }

    /// Whether the end, at the distance `left`, influences the size of the next step.
    pub fn is_last(&self, left: f64) -> bool {
        left <= 1.1 * self.next
    }

    /// Size of the parts after a jump of velocities, where the motion is still unknown \[s\].
    pub fn restart_size(&self) -> Option<f64> {
        (self.known == 0).then_some(self.first)
    }

    /// Counts a completed step, and sets the size of the next one. A body after a rigid impact may strike again: the result depends on waves that
    /// are hardly visible in the deflections.
    pub fn close(&mut self, size: f64, pairs: &[PairState]) {
        self.control.count(size);
        let most = (GROWS * size).min(LARGEST * self.first);
        self.next = self.admits.min(most).max(SHRINKS * size).max(SMALLEST * self.first);
        if self.known < 2 {
            self.next = self.next.min(self.first);
        }
        let bounced = pairs.iter().filter(|pair| pair.approach_max > 0.0 && !pair.closed);
        let time = bounced.map(|pair| pair.gap / pair.approach_max).fold(f64::INFINITY, f64::min);
        self.next = self.next.min(self.soon.max(time / SOON));
        self.admits = f64::INFINITY;
    }

    /// Records a rejection.
    pub fn refuse(&mut self) {
        self.control.refused += 1;
    }

    /// Whether a part of so small a size is never refused.
    fn is_smallest(&self, size: f64) -> bool {
        size <= SMALLEST * self.first * (1.0 + 1e-9)
    }

    /// Whether a part of such a small size relative to the previous one contains no information on the motion; parts before an impact are ignored.
    fn is_short(&self, size: f64) -> bool {
        self.known > 0 && size < SHORT * self.past[0].size
    }

    /// Size that an error over a part of size `h` admits \[s\].
    fn size_for(&self, error: f64, h: f64) -> f64 {
        SAFETY * h * (self.admitted / error).cbrt()
    }

    /// Forgets the motion so far: velocities have jumped.
    fn restart(&mut self) {
        self.known = 0;
    }

    /// Error over the last solved part, relative to deflection and energy.
    fn error(&self, part: &SolvedPart<'_>) -> f64 {
        let (mut error, mut deflection) = (0.0_f64, self.deflection.max(self.onset(part)));
        let h = part.h;
        let bend = |now: f64, before: [f64; 2]| self.second_difference(h, now, before);
        let third = h * h * h / 12.0;
        let increments = &part.work.increment[watched(part.model)];
        if self.known == 2 {
            let [last, former] = &self.past;
            for (k, d) in increments.iter().enumerate() {
                let each =
                    [0, 1].map(|i| bend(d[i] / h, [last.velocity[k][i], former.velocity[k][i]]));
                error = error.max(third * norm(each));
                if self.deflects[k] {
                    deflection = deflection.max(norm(self.moved_by(k, d, h)));
                }
            }
            error = if error > 0.0 { error / deflection } else { 0.0 };
        }
        for (c, now) in part.forces().into_iter().enumerate() {
            let lost = third * bend(now, [self.past[0].force[c], self.past[1].force[c]]).abs();
            let approach = part.approach(c, self.approach[c]);
            // A driven obstacle has no energy: what it strikes receives it in the impact.
            let given = 0.5 * self.driven[c] * approach * approach;
            let energy = part.start.energy_scale.max(given);
            if now > 0.0 {
                error = error.max(self.admitted * (h / self.contact_step[c]).powi(3));
            }
            if lost > 0.0 && approach > 0.0 {
                error = error.max(lost * approach / energy * self.stricter());
                // The force of all the energy on a spring as stiff as this one.
                let stiffness = (now - self.past[0].force[c]).abs() / (approach * h);
                let rises = ONSET * (2.0 * energy * stiffness).sqrt();
                let largest = self.peak[c].max(rises).max(now.abs());
                error = error.max(self.admitted * (lost / (h * largest * self.force)).powf(1.5));
            }
        }
        error
    }

    /// Admitted error of a step relative to that of a contact's impulse: more than one for an accuracy with which it would be followed in two steps.
    fn stricter(&self) -> f64 {
        (self.admitted / (ADMITTED * FORCE_MOST).powf(1.5)).max(1.0)
    }

    /// Deflection relative to which the first errors of a structure at rest are that a contact sets in motion: as that of a projectile at the start
    /// \[m\].
    fn onset(&self, part: &SolvedPart<'_>) -> f64 {
        let forces = part.forces().into_iter().enumerate().filter(|(_, force)| *force > 0.0);
        let approach = forces.map(|(c, _)| part.approach(c, self.approach[c]));
        self.first * approach.fold(0.0, f64::max)
    }

    /// Displacement relative to the initial motion after an increment.
    fn moved_by(&self, k: usize, d: &[f64; 4], h: f64) -> [f64; 2] {
        [0, 1].map(|i| self.moved[k][i] + d[i] - h * self.start[k][i])
    }

    /// Second derivative of a quantity with these means over three parts, the last of size `h`.
    fn second_difference(&self, h: f64, now: f64, [last, former]: [f64; 2]) -> f64 {
        let [a, b] = [self.past[0].size, self.past[1].size];
        let slopes = [2.0 * (now - last) / (h + a), 2.0 * (last - former) / (a + b)];
        4.0 * (slopes[0] - slopes[1]) / (h + 2.0 * a + b)
    }

    /// The size that a part should have had, if it is too long for the requested accuracy \[s\].
    pub fn too_long(&self, model: &Model, solved: &Solved) -> Option<f64> {
        let (free, h) = (matches!(solved.trial.kind, PartKind::Free { .. }), solved.trial.h);
        if !free || self.is_smallest(h) || self.is_short(h) {
            return None;
        }
        let error = self.error(&SolvedPart::of(model, solved));
        let size = self.size_for(error, h).min(REPEATED * h).max(SHRINKS * h);
        (error > self.admitted).then_some(size.max(SMALLEST * self.first))
    }

    /// Enters an accepted part.
    pub fn take(&mut self, accepted: &Accepted<'_>) {
        let part = &SolvedPart::of(accepted.model, accepted.solved);
        let h = part.h;
        let kind = match accepted.solved.trial.kind {
            PartKind::Free { .. } if self.is_short(h) => Taken::Short,
            PartKind::Free { .. } => Taken::Smooth { error: self.error(part) },
            _ => Taken::Jump,
        };
        let increments = &part.work.increment[watched(part.model)];
        for (k, d) in increments.iter().enumerate() {
            self.moved[k] = self.moved_by(k, d, h);
            if self.deflects[k] {
                self.deflection = self.deflection.max(norm(self.moved[k]));
            }
        }
        for (peak, force) in self.peak.iter_mut().zip(part.forces()) {
            *peak = peak.max(force.abs());
        }
        for c in 0..self.approach.len() {
            self.approach[c] = part.approach(c, self.approach[c]);
        }
        match kind {
            Taken::Jump => self.restart(),
            Taken::Short => {}
            Taken::Smooth { error } => {
                self.error = self.error.max(error);
                self.admits = self.admits.min(self.size_for(error, h));
                self.push(part);
            }
        }
    }

    /// The part is the last one now.
    fn push(&mut self, part: &SolvedPart<'_>) {
        self.past.swap(0, 1);
        let last = &mut self.past[0];
        last.size = part.h;
        for (v, d) in last.velocity.iter_mut().zip(&part.work.increment[watched(part.model)]) {
            *v = [d[0] / part.h, d[1] / part.h];
        }
        last.force = part.forces();
        self.known = (self.known + 1).min(2);
    }
}

/// Effect of an accepted part on the estimate.
enum Taken {
    /// Velocities jumped in it.
    Jump,
    /// It is too short to contain information.
    Short,
    /// A part of a motion without jumps.
    Smooth {
        /// Its error.
        error: f64,
    },
}

/// A solved part of a step.
struct SolvedPart<'a> {
    model: &'a Model,
    start: &'a PartStart,
    work: &'a Workspace,
    h: f64,
}

impl<'a> SolvedPart<'a> {
    fn of(model: &'a Model, solved: &'a Solved) -> Self {
        let PartSolution { work, start, .. } = &*solved.solution;
        Self { model, start, work, h: solved.trial.h }
    }

    /// Mean forces of the contacts with a force law \[N\].
    fn forces(&self) -> Vec<f64> {
        let mut forces = vec![0.0; self.model.contacts.len()];
        for contact in &self.work.smooth {
            forces[self.model.pairs[contact.pair].contact] += contact.force.force;
        }
        forces
    }

    /// Largest velocity of approach of a contact with a force law, at most `before` before.
    fn approach(&self, contact: usize, before: f64) -> f64 {
        let pairs = self.work.smooth.iter().zip(&self.start.smooth);
        let own = pairs.filter(|(c, _)| self.model.pairs[c.pair].contact == contact);
        own.map(|(_, seen)| seen.rate.abs()).fold(before, f64::max)
    }
}
