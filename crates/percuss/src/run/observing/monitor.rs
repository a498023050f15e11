//! Observer of a run for its summary: peaks, contact intervals, impacts, largest residuals.
//!
//! Between the ends of a step, gap and displacements are cubics through values and velocities: peaks and instants of contact
//! are resolved within the step, those of displacements where steps resolve them.

use serde::{Deserialize, Serialize};

use super::connector_log::{self, ConnectorRecord};
use super::contact_log::ContactLog;
use super::crest::Crest;
use super::foundation_log;
use super::given::{Given, RowReactions};
use super::joint_log::{self, JointRecord};
use super::pulses::Pulses;
use super::stop_log;
use super::struck_mass;
use super::yielding::{self, YieldRecord};
use crate::analysis::section_forces::{self, Acting, Lines};
use crate::geometry::row::Row;
use crate::ledger::{Audit, Ledger, Measures};
use crate::math::interpolant::Interpolant;
use crate::model::Model;
use crate::model::frozen::{LoadAction, SupportData};
use crate::run::solving::trial::{Accepted, PartSolution, Solved};
use crate::state::State;
use crate::step::contacts::PressingPair;
use crate::step::effective_mass::EffectiveMass;
use crate::step::workspace::Workspace;
use crate::summary::{
    FoundationSummary, MultipleImpactSummary, Range, SectionForceSummary, SupportSummary,
};

/// Forms of the contacts in a step of size `h`, and the forces along them.
fn contact_forces(work: &Workspace, h: f64) -> impl Iterator<Item = ([&Row; 2], [f64; 2])> {
    let smooth = work.smooth.iter().map(|c| ([&c.row; 2], [c.force.force, 0.0]));
    let rigid = work.rigid.iter().map(move |c| ([&c.normal, &c.tangent], c.impulse.map(|l| l / h)));
    smooth.chain(rigid)
}

/// Follows one run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Monitor {
    /// Records of contacts.
    pub contacts: ContactLog,
    /// Extremes of the recorded points, by component, shape (recorded points, 2).
    pub points: Vec<[Crest<f64>; 2]>,
    /// Extremes of the section forces, one entry a beam, shape (beams).
    pub section_forces: Vec<SectionForceSummary>,
    /// Extremes of the reactions, one entry a support, those of the start among them, shape (supports).
    pub supports: Vec<SupportSummary>,
    /// The supports with reactions in the last part in which these were forces, shape (such supports) \[index of a support\]; `None` if all are to
    /// be evaluated.
    reacted: Option<Vec<usize>>,
    /// Impulses of supports.
    pub reactions: RowReactions,
    /// Impulse and energy transferred by projectiles through contacts, shape (striking bodies).
    pub given: Vec<Given>,
    /// Effective masses of the beams of each contact, once it has struck under a rigid law, shape (contacts).
    pub struck_masses: Vec<Option<EffectiveMass>>,
    /// Impacts that several touching bodies shared.
    pub multiple_impacts: MultipleImpactSummary,
    /// Section forces of the last part of a step without impact.
    lines: Lines,
    /// Records of beams that can yield, one per beam, shape (beams); empty if none can.
    pub yielded: Vec<YieldRecord>,
    /// Records of springs and hinges that can yield, shape (such springs and hinges).
    pub connectors: Vec<ConnectorRecord>,
    /// Records of foundations, shape (foundations).
    pub foundations: Vec<FoundationSummary>,
    /// Records of joints of a given strength, shape (such joints).
    pub joints: Vec<JointRecord>,
    /// Velocity of the accelerated base, the integral of its acceleration since the start, shape (2) \[m/s\].
    pub base_velocity: [f64; 2],
    /// Steps about the largest forces of contacts, stops and springs.
    pub pulses: Pulses,
    /// Largest residuals and drifts.
    pub audit: Audit,
    /// Largest sum of the energy at the start and the works so far, all by their magnitudes \[J\].
    pub energy_came: f64,
}

impl Monitor {
    /// Not open yet; the reactions of supports at the start.
    pub fn new(model: &Model, state: &State, reactions: &[[f64; 3]]) -> Self {
        let points = model.points.iter().map(|p| {
            p.displacement(&state.displacement).map(|value| Crest::new(value, state.time))
        });
        let inelastic = model.has_fibres();
        Self {
            contacts: ContactLog::new(model, state),
            points: points.collect(),
            section_forces: Vec::new(),
            supports: model.supports.iter().map(unset_support).collect(),
            reacted: None,
            lines: Lines::default(),
            reactions: RowReactions::new(state, reactions),
            given: vec![Given::default(); model.striking_bodies().count()],
            struck_masses: vec![None; model.contacts.len()],
            multiple_impacts: MultipleImpactSummary::default(),
            yielded: vec![YieldRecord::default(); if inelastic { model.beams.len() } else { 0 }],
            connectors: vec![ConnectorRecord::default(); model.yielding().count()],
            foundations: foundation_log::unset(model),
            joints: state
                .joints_parted
                .iter()
                .map(|torn| JointRecord::starting(*torn, state.time))
                .collect(),
            base_velocity: [0.0; 2],
            pulses: Pulses::new(model, state),
            audit: Audit::default(),
            energy_came: 0.0,
        }
    }

    /// Opens the record at the initial state, an equilibrium with the given contact forces. Its previous content is dropped first: for a long beam
    /// both would need too much memory.
    pub fn open(&mut self, model: &Model, state: &State, pressed: &[PressingPair]) {
        let reactions = self.reactions.mean().to_vec();
        (self.lines, self.section_forces) = Default::default();
        *self = Self::new(model, state, &reactions);
        self.lines = Lines::at_rest(model, state, pressed);
        self.section_forces = section_forces::unset(model);
        section_forces::update(model, &self.lines, state, &mut self.section_forces);
        yielding::note(model, state, &mut self.yielded);
        connector_log::note(model, state, &mut self.connectors);
        foundation_log::note(model, state, &mut self.foundations);
        foundation_log::note_preload(&mut self.foundations);
        yielding::note_preload(model, state, &mut self.yielded);
        connector_log::note_preload(model, state, &mut self.connectors);
        self.open_reactions(&reactions, state.time);
    }

    /// Whether it has the shape of another monitor of the same model, with valid indices.
    pub fn fits(&self, other: &Self, model: &Model) -> bool {
        let shape = |m: &Self| {
            let bodies = [m.given.len(), m.struck_masses.len(), m.foundations.len()];
            let yielding = [m.yielded.len(), m.connectors.len(), m.joints.len()];
            (m.points.len(), m.supports.len(), bodies, yielding)
        };
        let reacted = self.reactions.fits(model.supports.len())
            && self.reacted.iter().flatten().all(|support| *support < self.supports.len());
        let stop = |m: &Self| m.supports.iter().map(|s| s.touches.is_some()).collect::<Vec<_>>();
        shape(self) == shape(other)
            && reacted
            && stop(self) == stop(other)
            && section_forces::fit(&self.section_forces, &other.section_forces)
            && self.lines.fits(model.element_count())
            && self.contacts.fits(&other.contacts, model)
            && self.pulses.fits(&other.pulses)
    }

    /// Enters the section forces over a solved part, at whose start the state is.
    pub fn measure_lines(&mut self, model: &Model, state: &State, solved: &Solved) {
        if !solved.jumps {
            let PartSolution { work, forcing, .. } = &*solved.solution;
            let (rule, beams) = (&solved.rule, &work.beams);
            let acting = Acting { state, increment: &work.increment, rule, beams, forcing };
            self.lines.set(model, &acting, contact_forces(work, rule.h));
        }
    }

    /// Section forces of the last step without impact: impulses are no forces, and a step with an impact has only impulses over its length.
    pub fn lines(&self) -> &Lines {
        &self.lines
    }

    /// Enters a part of a step.
    pub fn take(&mut self, part: &Accepted<'_>) {
        let (model, state, solved) = (part.model, part.after, part.solved);
        self.take_reactions(part);
        if !solved.jumps {
            section_forces::update(model, &self.lines, state, &mut self.section_forces);
        }
        if part.yielded {
            yielding::note(model, state, &mut self.yielded);
        }
        yielding::note_parted(model, state.time, part.parted, &mut self.yielded);
        connector_log::note(model, state, &mut self.connectors);
        foundation_log::note(model, state, &mut self.foundations);
        joint_log::note(model, state.time, &solved.joint_loads, &mut self.joints);
        struck_mass::weigh(&mut self.struck_masses, part);
        self.contacts.take(part);
        self.pulses.take(part);
        self.reactions.take(part);
        for (body, given) in model.striking_bodies().zip(&mut self.given) {
            given.take(model.body_node(body), part);
        }
        if let Some(contacts) = solved.shared {
            self.multiple_impacts.take(part.before().time, contacts);
        }
        self.take_points(part);
        self.take_base(part);
        self.audit(&state.ledger, part.measures);
    }

    fn take_points(&mut self, part: &Accepted<'_>) {
        let (state, start) = (part.after, part.before());
        let h = part.solved.trial.h;
        for (k, p) in part.model.points.iter().enumerate() {
            let u = p.displacement(&state.displacement);
            let v = p.velocity(&state.displacement, &state.velocity);
            let [u0, v0] = start.points[k];
            for c in 0..2 {
                let path = Interpolant { h, start: [u0[c], v0[c]], end: [u[c], v[c]] };
                self.points[k][c].take(&path, start.time, part.solved.impulsive);
            }
        }
    }

    /// Adds the acceleration of the base over a part.
    fn take_base(&mut self, part: &Accepted<'_>) {
        let PartSolution { forcing, .. } = &*part.solved.solution;
        for (load, factor) in part.model.loads.iter().zip(&forcing.factors) {
            if let (true, LoadAction::Gravity { acceleration }) = (load.base, &load.kind) {
                let h = part.solved.trial.h;
                (0..2).for_each(|i| self.base_velocity[i] -= h * factor * acceleration[i]);
            }
        }
    }

    /// Separates forces and impulses of supports, up to the current state.
    pub fn settle(&mut self, model: &Model, state: &State) {
        self.reactions.settle(model, state, &mut self.supports);
    }

    /// Enters the reactions at the start into the extremes.
    fn open_reactions(&mut self, reactions: &[[f64; 3]], time: f64) {
        for (summary, [f1, f2, moment]) in self.supports.iter_mut().zip(reactions) {
            summary.force[0].take(*f1, time);
            summary.force[1].take(*f2, time);
            summary.moment.take(*moment, time);
        }
    }

    /// Enters the reactions that are forces into the extremes.
    fn take_reactions(&mut self, part: &Accepted<'_>) {
        let (state, solved) = (part.after, part.solved);
        let (list, h) = (state.reacting.list(), solved.trial.h);
        let gives_force =
            |support: usize| !solved.reacts_by_impulses(part.model.supports[support].rigid);
        let mut take = |support: usize, mean: [f64; 3]| {
            let summary = &mut self.supports[support];
            summary.force[0].take(mean[0], state.time);
            summary.force[1].take(mean[1], state.time);
            summary.moment.take(mean[2], state.time);
            if let Some(touches) = &mut summary.touches {
                stop_log::take(touches, f64::hypot(mean[0], mean[1]), h, state.time);
            }
        };
        for (support, before) in list.iter().filter(|(support, _)| gives_force(*support)) {
            let now = &state.reactions[*support];
            take(*support, std::array::from_fn(|i| (now[i] - before[i]) / h));
        }
        // A support that still has no reaction has entered its zero already.
        let reacted = self.reacted.get_or_insert_with(|| (0..state.reactions.len()).collect());
        for support in reacted.iter().filter(|s| gives_force(**s) && !state.reacting.contains(**s))
        {
            take(*support, [0.0; 3]);
        }
        reacted.retain(|support| !gives_force(*support));
        reacted.extend(list.iter().map(|(s, _)| *s).filter(|s| gives_force(*s)));
    }

    /// Enters the measures of a new state into the largest residuals.
    fn audit(&mut self, ledger: &Ledger, m: &Measures) {
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
