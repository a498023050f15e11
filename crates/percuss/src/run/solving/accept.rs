//! Acceptance of a part of a step: the only writer of [`State`] while a run steps.

use super::solver::{Solver, StateView};
use super::trial::{PartKind, Separated, Solved};
use crate::geometry::configuration::Configuration;
use crate::geometry::dents::Dent;
use crate::geometry::touch::SearchRegion;
use crate::ledger::Measures;
use crate::model::{Model, TouchLaw};
use crate::settings::{ImpactResolution, Settings};
use crate::state::State;
use crate::step::contacts::{ImpulseLaw, Phase};
use crate::step::fibres::PartedElement;
use crate::step::newton::StepProblem;
use crate::step::workspace::Workspace;
use crate::step::{commit, flows};

/// End of a part.
#[derive(Clone, Debug)]
pub struct PartEnd {
    /// Energies and momenta there.
    pub measures: Measures,
    /// Elements that parted there, shape (such elements).
    pub parted: Vec<PartedElement>,
    /// Pairs that they have separated, in their order, shape (such pairs).
    pub separated: Vec<Separated>,
    /// Whether any fibre has yielded in it.
    pub yielded: bool,
}

/// Moves a state to the end of a solved part.
pub struct Acceptance<'a> {
    pub model: &'a Model,
    pub settings: &'a Settings,
    pub state: &'a mut State,
    pub solver: &'a mut Solver,
}

impl Acceptance<'_> {
    /// Writes the part into the state.
    pub fn accept(&mut self, solved: &mut Solved) -> PartEnd {
        for (pair, seen) in solved.solution.encounters.sights.drain(..) {
            self.state.pairs[pair] = seen;
        }
        self.note_approach(solved);
        self.note_start_reactions(solved);
        self.remember_closest_points(solved);
        let (parted, yielded) = self.commit(solved);
        self.part_joints(solved);
        let opened = self.part(&parted);
        let measures = self.solver.measures_in(&mut solved.solution, self.model, self.state);
        self.state.ledger.rescale(&measures);
        self.update_contacts(solved);
        self.open_parted(&opened);
        PartEnd { measures, parted, separated: opened, yielded }
    }

    /// Approach velocity of contacts in an impact, or of held ones.
    fn note_approach(&mut self, solved: &Solved) {
        let held = matches!(solved.trial.kind, PartKind::Held);
        for contact in &solved.trial.active {
            if held || matches!(contact.phase, Phase::Impact { .. }) {
                let pair = &mut self.state.pairs[contact.pair];
                pair.approach_max = pair.approach_max.max(-pair.rate);
            }
        }
    }

    /// Reactions at the start of the part, if the previous one does not give them.
    fn note_start_reactions(&mut self, solved: &Solved) {
        // Whether or not velocities have jumped there.
        let of_run = self.state.step == 0;
        let found = solved.rule.at_start(of_run).filter(|_| self.state.instant.is_none());
        let Some(at_start) = found else { return };
        let (model, state, solver) = (self.model, &*self.state, &*self.solver);
        let mut forcing = solved.solution.forcing.clone();
        forcing.set_loads_at(model, state.time, solved.rule.h);
        let forcing = &forcing;
        let mut work = solved.solution.work.clone();
        work.lead.set(model, state, &at_start, forcing);
        let problem = StepProblem {
            model,
            state,
            integration: at_start,
            forcing,
            damping: &solver.damping,
            size: solver.size,
            positions: solver.positions,
            near: &solved.solution.encounters.near,
            sights: &[],
            active: &[],
            law: ImpulseLaw::Newton,
            feedback: 0.0,
            arcs: solver.search.arcs(),
            reach: SearchRegion::Near,
        };
        problem.unbalanced(&mut work);
        let found = flows::reactions_at_start(model, state, &at_start, forcing, &work);
        self.state.instant = Some(found);
    }

    /// Sides and closest points at the end of the part, from its solution.
    fn remember_closest_points(&mut self, solved: &Solved) {
        let (model, state) = (self.model, &mut *self.state);
        let reached = solved.solution.encounters.reached.iter();
        for &i in reached.filter(|i| model.pairs[**i].target.has_sides()) {
            let seen = &mut state.pairs[i];
            let Workspace { increment, arcs, smooth, .. } = &solved.solution.work;
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
    }

    /// Moves the state, and evaluates the pairs there; returns the fracturing elements, and whether any fibre has yielded.
    fn commit(&mut self, solved: &mut Solved) -> (Vec<PartedElement>, bool) {
        let (model, state, solver) = (self.model, &mut *self.state, &mut *self.solver);
        let before = solved.impulsive.then(|| state.multiplier.clone());
        let (work, forcing) = (&mut solved.solution.work, &solved.solution.forcing);
        let ended = commit::commit(model, state, solved.rule, forcing, &solver.damping, work);
        work.beams.sweep.end();
        state.offset += solved.rule.h;
        if let Some(before) = before {
            // Multipliers of an impact are impulses over its time: they do not predict later ones.
            state.multiplier = before;
        }
        commit::steer_obstacles(model, state, self.settings.step);
        solver.search.moved(model);
        solver.search.see(model, state, SearchRegion::Near);
        self.remember_crushing(solved);
        ended
    }

    /// Depth and position of the indentation of contacts with crushing.
    fn remember_crushing(&mut self, solved: &Solved) {
        let (model, state) = (self.model, &mut *self.state);
        if state.dents.is_empty() {
            return;
        }
        for contact in &solved.solution.work.smooth {
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

    /// Joints that carried more than their strength hold no longer.
    fn part_joints(&mut self, solved: &Solved) {
        let all = self.model.joints.iter().zip(&solved.joint_loads);
        for (parted, (joint, load)) in self.state.joints_parted.iter_mut().zip(all) {
            *parted |= joint.parts_under(load);
        }
    }

    /// Rigid contacts that are closed at the end, and the one that was located there.
    fn update_contacts(&mut self, solved: &mut Solved) {
        self.state.located = match solved.trial.kind {
            PartKind::Free { located } => located,
            _ => None,
        };
        if let ImpactResolution::TimeStepping { .. } = self.settings.impacts {
            return;
        }
        let found = solved.trial.active.iter().zip(&solved.solution.work.rigid);
        for (contact, found) in found {
            self.state.pairs[contact.pair].closed = contact.phase.closes(found.impulse[0]);
        }
        let at = StateView { model: self.model, settings: self.settings, state: self.state };
        for pair in self.solver.solving(at, &mut solved.solution).at_rest() {
            self.state.pairs[pair].closed = true;
        }
    }
}
