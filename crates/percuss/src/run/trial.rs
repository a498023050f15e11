//! A part of a step that stands solved in the workspace, and its acceptance.

use super::monitor::{PartEnd, Solved};
use super::sequence::Sequence;
use super::simulation::Simulation;
use super::solve::Attempt;
use crate::geometry::configuration::Configuration;
use crate::geometry::dents::Dent;
use crate::geometry::touch::Reach;
use crate::model::TouchLaw;
use crate::model::frozen::BodyKind;
use crate::settings::ImpactResolution;
use crate::step::contacts::{ActiveContact, ImpulseLaw, Phase};
use crate::step::fibres::PartedElement;
use crate::step::integration::Integration;
use crate::step::newton::StepProblem;
use crate::step::workspace::Workspace;
use crate::step::{commit, flows};

/// What a part of a step is.
#[derive(Clone, Debug)]
pub enum PartKind {
    /// Nothing strikes; it may end at an instant of contact, that of the pair `located`.
    Free { located: Option<usize> },
    /// Prescribed velocities jump in it, which is as short as an impact.
    Jump,
    /// An impact interval.
    Impact,
    /// One of several impact intervals, one for each impact.
    InSequence(Sequence),
    /// The last of several, in which nothing bounces.
    EndOfSequence,
    /// Impacts have accumulated: what would end inside something was held.
    Held,
    /// What was held comes to rest.
    PlasticPostStep,
    /// A step of the paper's: impulses act over all of it.
    TimeStepping {
        /// Which of the active contacts rest, shape (active contacts).
        persistent: Vec<bool>,
    },
}

/// A part of a step that stands solved in the workspace.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Its size \[s\].
    pub h: f64,
    /// Rigid contacts that took part, in the order of the workspace's, shape (active contacts).
    pub active: Vec<ActiveContact>,
    /// Whether their impulses obey a law that stands in for their own, which would have given energy.
    pub fallback_law: bool,
    /// What it is.
    pub kind: PartKind,
}

impl Trial {
    /// What it was solved as, but for its law.
    fn attempt(&self) -> Attempt {
        Attempt { jumps: matches!(self.kind, PartKind::Jump), ..Attempt::free(self.h) }
    }

    /// Whether its impulses are no forces over its length.
    pub fn carries_impulses(&self) -> bool {
        let strikes = |c: &ActiveContact| !matches!(c.phase, Phase::Resting { .. });
        matches!(self.kind, PartKind::Jump) || self.active.iter().any(strikes)
    }

    /// Whether it counts among the events of a step.
    pub fn is_event(&self) -> bool {
        match self.kind {
            PartKind::Free { located } => located.is_some(),
            PartKind::Impact | PartKind::InSequence(_) | PartKind::EndOfSequence => true,
            _ => false,
        }
    }

    /// Whether it is an impact, at least one of whose contacts gave an impulse.
    pub fn strikes(&self, work: &Workspace) -> bool {
        let struck = |(contact, k): (&ActiveContact, usize)| {
            matches!(contact.phase, Phase::Impact { .. }) && work.rigid[k].impulse[0] > 0.0
        };
        match self.kind {
            PartKind::Impact => self.active.iter().zip(0..).any(struck),
            PartKind::InSequence(_) | PartKind::EndOfSequence => true,
            _ => false,
        }
    }

    /// In time-stepping, which of the active contacts rest; else empty.
    pub fn persistent(&self) -> &[bool] {
        match &self.kind {
            PartKind::TimeStepping { persistent } => persistent,
            _ => &[],
        }
    }
}

impl Simulation<'_> {
    /// Moves the state to the end of a trial: nothing else writes it.
    #[doc(hidden)]
    pub fn accept(&mut self, trial: &Trial) {
        let rule = self.integration(&trial.attempt());
        let impulsive = self.is_impulsive(trial.h);
        let solved = Solved { rule, forcing: &self.forcing, impulsive, trial };
        self.monitor.begin_step(self.model, &self.state, &self.work, &solved);
        self.note_shared_blow(trial);
        self.note_approach(trial);
        self.gather_given(trial.h);
        self.note_step_size(trial);
        self.note_start_reactions(&rule);
        self.remember_closest_points();
        let loads = self.joint_loads(&rule);
        let parted = self.commit(&rule, impulsive);
        if !impulsive && !trial.carries_impulses() {
            self.judge_joints(&loads);
        }
        let opened = self.part(&parted);
        let end = PartEnd { trial, impulsive, awake: self.search.awake(), parted: &parted };
        self.monitor.end_step(self.model, &self.state, &self.work, &end);
        // What rests in so short a part may give an impulse in disguise, too: no quotient by its length is a force.
        let carries_impulses = impulsive && (trial.carries_impulses() || !trial.active.is_empty());
        self.frames.part = (trial.h, carries_impulses);
        self.gather_row(trial, impulsive);
        self.measure();
        self.weigh_struck(trial);
        self.update_contacts(trial);
        self.open_parted(&opened);
    }

    /// Writes the end of the step solved last into the state, and looks at the pairs there; tells the elements that part.
    fn commit(&mut self, rule: &Integration, impulsive: bool) -> Vec<PartedElement> {
        let before = impulsive.then(|| self.state.multiplier.clone());
        let (state, forcing) = (&mut self.state, &self.forcing);
        let parted = commit::commit(self.model, state, *rule, forcing, &self.damping, &self.work);
        self.work.beams.sweep.end();
        state.offset += rule.h;
        if let Some(before) = before {
            // Multipliers of an impact are impulses over its time: no prediction for what follows.
            state.multiplier = before;
        }
        self.steer_obstacles();
        self.search.moved(self.model);
        self.search.see(self.model, &mut self.state, Reach::Near);
        self.remember_crushing();
        parted
    }

    /// How deep what crushes was pushed in, and where.
    fn remember_crushing(&mut self) {
        let (model, state) = (self.model, &mut self.state);
        if state.dents.is_empty() {
            return;
        }
        for contact in &self.work.smooth {
            let pair = &model.pairs[contact.pair];
            let TouchLaw::Smooth(law) = &model.contacts[pair.contact].law else { continue };
            if law.unloading.is_some() {
                let face = (&mut state.dents[contact.pair], pair.reach - pair.target_radius);
                let pressed = contact.force.force != 0.0;
                let seen = &mut state.pairs[contact.pair];
                let now = Dent { place: seen.place, side: seen.memory.side, depth: -seen.gap };
                law.remember(&mut seen.deepest, now, Some(face), pressed);
            }
        }
    }

    /// What approaches in an impact, or was held, has approached so fast.
    fn note_approach(&mut self, trial: &Trial) {
        let held = matches!(trial.kind, PartKind::Held);
        for contact in &trial.active {
            if held || matches!(contact.phase, Phase::Impact { .. }) {
                let pair = &mut self.state.pairs[contact.pair];
                pair.approach_max = pair.approach_max.max(-pair.rate);
            }
        }
    }

    /// Reactions at the start of the step solved last, where the step before does not tell them.
    fn note_start_reactions(&mut self, rule: &Integration) {
        // Whether or not velocities have jumped there.
        let of_run = self.state.step == 0;
        let found = rule.at_start(of_run).filter(|_| self.state.instant.is_none());
        let Some(at_start) = found else { return };
        let (model, state) = (self.model, &self.state);
        let mut forcing = self.forcing.clone();
        forcing.set_loads_at(model, state.time, rule.h);
        let forcing = &forcing;
        let mut work = self.work.clone();
        work.lead.set(model, state, &at_start, forcing);
        let problem = StepProblem {
            model,
            state,
            integration: at_start,
            forcing,
            damping: &self.damping,
            size: self.size,
            positions: self.positions,
            near: &self.encounters.near,
            active: &[],
            law: ImpulseLaw::Newton,
            feedback: 0.0,
            arcs: self.search.arcs(),
            reach: Reach::Near,
        };
        problem.unbalanced(&mut work);
        let found = flows::reactions_at_start(model, state, &at_start, forcing, &work);
        self.state.instant = Some(found);
    }

    /// Sides and closest points at the end of the step, as the step has seen them.
    fn remember_closest_points(&mut self) {
        let (model, state) = (self.model, &mut self.state);
        for &i in self.encounters.reached.iter().filter(|i| model.pairs[**i].target.has_sides()) {
            let seen = &mut state.pairs[i];
            let Workspace { increment, arcs, smooth, .. } = &self.work;
            let at = Configuration {
                start: &state.displacement,
                increment,
                share: 1.0,
                arcs,
                parted: &state.parted,
            };
            let known =
                smooth.binary_search_by_key(&i, |c| c.pair).ok().and_then(|k| smooth[k].end);
            let end = known.or_else(|| {
                model.pairs[i].at_end(model, &at, &seen.memory, seen.gap).map(|touch| touch.memory)
            });
            seen.memory = end.unwrap_or(seen.memory);
        }
        self.encounters.looked.clear();
    }

    /// Which rigid contacts are closed at the end of a trial, and which one was located there.
    fn update_contacts(&mut self, trial: &Trial) {
        self.state.located = match trial.kind {
            PartKind::Free { located } => located,
            _ => None,
        };
        if let ImpactResolution::TimeStepping { .. } = self.settings.impacts {
            return;
        }
        for (contact, found) in trial.active.iter().zip(&self.work.rigid) {
            self.state.pairs[contact.pair].closed = contact.phase.closes(found.impulse[0]);
        }
        self.close_at_rest();
    }

    /// Obstacles have the velocities of their motions, whatever the rule makes of their increments.
    pub(super) fn steer_obstacles(&mut self) {
        let (time, width) = (self.state.time, 0.02 * self.settings.step);
        for dofs in self.model.prescribed.iter().rev() {
            let Some(body) = dofs.node.checked_sub(self.model.beam_node_count()) else { break };
            if self.model.bodies[body].kind != BodyKind::Obstacle {
                break;
            }
            if dofs.drives.iter().all(Vec::is_empty) {
                continue; // it stands
            }
            let rate = |motion: usize| self.model.motions[motion].rate(time, width);
            let mut velocity = [0.0; 4];
            for (normal, drive) in dofs.normals.iter().zip(&dofs.drives) {
                let along: f64 = drive.iter().map(|(m, a)| a * rate(*m)).sum();
                (0..4).for_each(|k| velocity[k] += along * normal[k]);
            }
            self.state.velocity[dofs.node] = velocity;
        }
    }
}
