//! Follows a run and gathers what its summary tells: peaks, contact intervals, impacts, largest residuals.
//!
//! Between the ends of a step, gap and displacements are cubics through values and velocities: peaks and instants of contact
//! are resolved within the step, those of displacements where steps resolve them.

use serde::{Deserialize, Serialize};

use super::connector_log::{self, ConnectorRecord};
use super::contact_log::ContactLog;
use super::crest::Crest;
use super::joint_log::JointRecord;
use super::stop_log;
use super::trial::Trial;
use super::yielding::{self, YieldRecord};
use crate::analysis::section_forces::{self, Acting, Lines};
use crate::geometry::row::Row;
use crate::ledger::{Audit, Ledger, Measures};
use crate::math::interpolant::Interpolant;
use crate::model::Model;
use crate::model::frozen::SupportData;
use crate::state::State;
use crate::step::contacts::{ActiveContact, Phase, RigidContact};
use crate::step::fibres::PartedElement;
use crate::step::forcing::Forcing;
use crate::step::integration::Integration;
use crate::step::workspace::Workspace;
use crate::summary::{Range, SectionForceSummary, SupportSummary};

/// A trial that was accepted.
#[derive(Clone, Copy, Debug)]
pub(super) struct PartEnd<'a> {
    /// The trial.
    pub trial: &'a Trial,
    /// Whether it is as short as an impact, so that quotients over it are impulsive.
    pub impulsive: bool,
    /// Pairs that were looked at at its end, shape (such pairs) \[index of a pair\].
    pub awake: &'a [usize],
    /// Elements that part at its end, shape (such elements).
    pub parted: &'a [PartedElement],
}

/// A trial that is about to be accepted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solved<'a> {
    /// The trial.
    pub trial: &'a Trial,
    /// Scheme and size.
    pub rule: Integration,
    /// Loads over it.
    pub forcing: &'a Forcing,
    /// As in [`PartEnd`].
    pub impulsive: bool,
}

impl Solved<'_> {
    /// Whether something strikes in it: whether a contact that was not at rest gives an impulse.
    fn strikes(&self, state: &State, work: &Workspace) -> bool {
        let persistent = self.trial.persistent();
        let rests = |i: usize, contact: &ActiveContact| match contact.phase {
            Phase::Resting { .. } => state.pairs[contact.pair].closed,
            Phase::Impact { .. } => persistent.get(i).is_some_and(|rests| *rests),
            Phase::PlasticPostStep { .. } => false,
        };
        let given = |found: &RigidContact| found.impulse != [0.0; 2];
        let mut found = self.trial.active.iter().zip(&work.rigid).enumerate();
        found.any(|(i, (contact, found))| given(found) && !rests(i, contact))
    }
}

/// Forms of the contacts in a step of size `h`, and the forces along them.
fn contact_forces(work: &Workspace, h: f64) -> impl Iterator<Item = ([&Row; 2], [f64; 2])> {
    let smooth = work.smooth.iter().map(|c| ([&c.row; 2], [c.force.force, 0.0]));
    let rigid = work.rigid.iter().map(move |c| ([&c.normal, &c.tangent], c.impulse.map(|l| l / h)));
    smooth.chain(rigid)
}

/// Values at the start of a step that the monitor compares with those at its end.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct StepStart {
    time: f64,
    /// Displacements and velocities of the recorded points, shape (recorded points, 2, 2) \[m, m/s\].
    points: Vec<[[f64; 2]; 2]>,
}

/// Follows one run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Monitor {
    start: StepStart,
    /// What happens at contacts.
    pub contacts: ContactLog,
    /// Extremes of the recorded points, by component, shape (recorded points, 2).
    pub points: Vec<[Crest<f64>; 2]>,
    /// Extremes of the section forces, one entry a beam, shape (beams).
    pub section_forces: Vec<SectionForceSummary>,
    /// Extremes of the reactions, one entry a support, those of the start among them, shape (supports).
    pub supports: Vec<SupportSummary>,
    /// The supports that reacted last, shape (such supports) \[index of a support\]; nothing if all are to be looked at.
    reacted: Option<Vec<usize>>,
    /// Section forces of the last step without impact, and whether the step in hand is one with.
    lines: Lines,
    jumps: bool,
    /// What is noted of beams that can yield, one entry a beam, shape (beams); empty if none can.
    pub yielded: Vec<YieldRecord>,
    /// What is noted of springs and hinges that can yield, shape (such springs and hinges).
    pub connectors: Vec<ConnectorRecord>,
    /// What is noted of joints of a given strength, shape (such joints).
    pub joints: Vec<JointRecord>,
    /// Largest residuals and drifts.
    pub audit: Audit,
    /// Largest sum of the energy at the start and the works so far, all by their magnitudes \[J\].
    pub energy_came: f64,
}

impl Monitor {
    /// Opens the record at the initial state, an equilibrium in which contacts press with the forces given.
    pub fn new(model: &Model, state: &State, pressed: &[(Row, f64)]) -> Self {
        let points = model
            .points
            .iter()
            .map(|p| p.value(&state.displacement).map(|value| Crest::new(value, state.time)));
        let inelastic = model.has_fibres();
        let mut monitor = Self {
            start: StepStart::default(),
            contacts: ContactLog::new(model, state),
            points: points.collect(),
            section_forces: section_forces::unset(model),
            supports: model.supports.iter().map(unset_support).collect(),
            reacted: None,
            lines: Lines::at_rest(model, state, pressed),
            jumps: false,
            yielded: vec![YieldRecord::default(); if inelastic { model.beams.len() } else { 0 }],
            connectors: vec![ConnectorRecord::default(); model.memory_count()],
            joints: state
                .joints_parted
                .iter()
                .map(|torn| JointRecord::starting(*torn, state.time))
                .collect(),
            audit: Audit::default(),
            energy_came: 0.0,
        };
        monitor.start.points.resize(model.points.len(), [[0.0; 2]; 2]);
        section_forces::update(model, &monitor.lines, state, &mut monitor.section_forces);
        yielding::note(model, state, &mut monitor.yielded);
        connector_log::note(model, state, &mut monitor.connectors);
        yielding::note_preload(model, state, &mut monitor.yielded);
        connector_log::note_preload(model, state, &mut monitor.connectors);
        monitor.note_start(model, state);
        monitor
    }

    /// Whether it has the shape of another monitor of the same model, and points at nothing that is not there.
    pub fn fits(&self, other: &Self, model: &Model) -> bool {
        let shape = |m: &Self| {
            let points = [m.start.points.len(), m.points.len()];
            (points, m.supports.len(), [m.yielded.len(), m.connectors.len(), m.joints.len()])
        };
        let reacted = self.reacted.iter().flatten().all(|support| *support < self.supports.len());
        let stop = |m: &Self| m.supports.iter().map(|s| s.touches.is_some()).collect::<Vec<_>>();
        shape(self) == shape(other)
            && reacted
            && stop(self) == stop(other)
            && section_forces::fit(&self.section_forces, &other.section_forces)
            && self.lines.fits(model.element_count())
            && self.contacts.fits(&other.contacts, model)
    }

    /// Notes the start of a step that stands solved in `work`.
    pub(super) fn begin_step(
        &mut self,
        model: &Model,
        state: &State,
        work: &Workspace,
        step: &Solved,
    ) {
        self.note_start(model, state);
        self.contacts.begin_step(state, work);
        self.jumps = step.impulsive || step.strikes(state, work);
        if !self.jumps {
            let Solved { rule, forcing, .. } = *step;
            let acting = Acting {
                state,
                increment: &work.increment,
                rule: &rule,
                beams: &work.beams,
                forcing,
            };
            self.lines.set(model, &acting, contact_forces(work, rule.h));
        }
    }

    fn note_start(&mut self, model: &Model, state: &State) {
        self.start.time = state.time;
        for (start, p) in self.start.points.iter_mut().zip(&model.points) {
            *start = [p.value(&state.displacement), p.value(&state.velocity)];
        }
    }

    /// Section forces of the last step without impact: impulses are no forces, and a step in which something strikes has none
    /// but impulses over its length.
    pub fn lines(&self) -> &Lines {
        &self.lines
    }

    /// Takes in the end of a step.
    pub(super) fn end_step(
        &mut self,
        model: &Model,
        state: &State,
        work: &Workspace,
        part: &PartEnd,
    ) {
        let h = part.trial.h;
        if !part.impulsive {
            self.reactions(state, h);
        }
        if !self.jumps {
            section_forces::update(model, &self.lines, state, &mut self.section_forces);
        }
        yielding::note(model, state, &mut self.yielded);
        yielding::note_parted(model, state.time, part.parted, &mut self.yielded);
        connector_log::note(model, state, &mut self.connectors);
        self.contacts.end_step(model, state, work, part);
        for (k, p) in model.points.iter().enumerate() {
            let (u, v) = (p.value(&state.displacement), p.value(&state.velocity));
            let [u0, v0] = self.start.points[k];
            for c in 0..2 {
                let from = self.start.time;
                let path = Interpolant { h, start: [u0[c], v0[c]], end: [u[c], v[c]] };
                self.points[k][c].take(&path, from, part.impulsive);
            }
        }
    }

    /// Takes the reactions at the start into the extremes.
    pub fn open_reactions(&mut self, reactions: &[[f64; 3]], time: f64) {
        for (summary, [f1, f2, moment]) in self.supports.iter_mut().zip(reactions) {
            summary.force[0].take(*f1, time);
            summary.force[1].take(*f2, time);
            summary.moment.take(*moment, time);
        }
    }

    fn reactions(&mut self, state: &State, h: f64) {
        let list = state.reacting.list();
        let mut take = |support: usize, mean: [f64; 3]| {
            let summary = &mut self.supports[support];
            summary.force[0].take(mean[0], state.time);
            summary.force[1].take(mean[1], state.time);
            summary.moment.take(mean[2], state.time);
            if let Some(touches) = &mut summary.touches {
                stop_log::take(touches, f64::hypot(mean[0], mean[1]), h, state.time);
            }
        };
        for (support, before) in list {
            let now = &state.reactions[*support];
            take(*support, std::array::from_fn(|i| (now[i] - before[i]) / h));
        }
        // A support that goes on to give nothing has taken its zero already.
        let reacted = self.reacted.get_or_insert_with(|| (0..state.reactions.len()).collect());
        for support in reacted.iter().filter(|s| !state.reacting.contains(**s)) {
            take(*support, [0.0; 3]);
        }
        reacted.clear();
        reacted.extend(list.iter().map(|(support, _)| *support));
    }

    /// Takes the measures of a new state into the largest residuals.
    pub fn audit(&mut self, ledger: &Ledger, m: &Measures) {
        let came =
            ledger.energy_initial.abs() + ledger.work_loads.abs() + ledger.work_supports.abs();
        self.energy_came = self.energy_came.max(came);
        self.audit.take(ledger, m);
    }
}

fn unset_support(support: &SupportData) -> SupportSummary {
    let (name, none) = (support.name.clone(), Range::default());
    let touches = support.stops.then(Vec::new);
    SupportSummary { name, force: [none; 2], moment: none, impulse: [0.0; 3], touches }
}
