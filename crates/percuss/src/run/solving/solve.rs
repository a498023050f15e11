//! Solution of a part of a step: with the pairs that could touch, and again if it brings others close.

use super::decider::{Decider, Resolution};
use super::locate::{Seen, Verdict};
use super::solver::Solving;
use super::trial::{PartKind, Trial};
use crate::geometry::configuration::Configuration;
use crate::geometry::pair::{Memory, Target};
use crate::geometry::touch::SearchRegion;
use crate::model::TouchLaw;
use crate::step::contacts::{ActiveContact, ImpulseLaw, Phase};
use crate::step::newton::{Failure, StepProblem};
use crate::step::workspace::Workspace;

/// Pairs that could touch within this multiple of all velocities are evaluated within a step.
const AHEAD: f64 = 2.0;

/// Kind of a part of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attempt {
    /// Its size \[s\].
    pub h: f64,
    /// Law of the impulses of rigid contacts.
    pub law: ImpulseLaw,
    /// Whether prescribed velocities jump in it.
    pub jumps: bool,
}

impl Attempt {
    /// It has no impact.
    pub fn free(h: f64) -> Self {
        Self { h, law: ImpulseLaw::Newton, jumps: false }
    }

    /// Contacts strike in it.
    pub fn impact(h: f64, law: ImpulseLaw) -> Self {
        Self { h, law, jumps: false }
    }
}

impl Solving<'_> {
    /// Solves a part of a step without accepting it.
    pub(super) fn solve(
        &mut self,
        attempt: &Attempt,
        active: &[ActiveContact],
    ) -> Result<(), Failure> {
        self.counts.solver_steps += 1;
        let h = attempt.h;
        let (time, step) = (self.state.time, self.settings.step);
        let integration = self.integration(h, attempt.jumps);
        let theta = integration.theta();
        self.forcing.set(self.model, (time, h, theta), step, &self.state.followed);
        self.forcing.part(self.model, &self.state.joints_parted);
        if attempt.jumps {
            self.forcing.set_motions(self.model, time, h, step, &self.state.followed, true);
        }
        self.search.within(self.model, &self.state.velocity, AHEAD * h, &mut self.encounters.near);
        (0..self.encounters.near.len()).for_each(|k| self.look(self.encounters.near[k]));
        let mut reach = SearchRegion::Near;
        loop {
            let problem = StepProblem {
                model: self.model,
                state: self.state,
                integration,
                forcing: self.forcing,
                damping: self.damping,
                size: self.size,
                positions: self.positions,
                near: &self.encounters.near,
                sights: &self.encounters.sights,
                active,
                law: attempt.law,
                feedback: (h / self.settings.step).min(1.0),
                arcs: self.search.arcs(),
                reach,
            };
            let solved = problem.solve(self.work, &mut self.counts.effort);
            if reach == SearchRegion::Near && !self.closest_points_remain() {
                reach = SearchRegion::All;
                continue;
            }
            solved?;
            let reached = &mut self.encounters.reached;
            self.search.within(self.model, &self.work.increment, 1.0, reached);
            (0..self.encounters.reached.len()).for_each(|k| self.look(self.encounters.reached[k]));
            if self.near_enough(h) {
                break;
            }
        }
        self.smooth_passage()
    }

    /// Solves a part without impact in which `resting` contacts stay closed; their friction never creates energy.
    pub(super) fn solve_resting(
        &mut self,
        attempt: &Attempt,
        resting: &mut [ActiveContact],
    ) -> Result<(), Failure> {
        loop {
            self.solve(attempt, resting)?;
            let mut again = false;
            for (contact, found) in resting.iter_mut().zip(&self.work.rigid) {
                let work = found.impulse[1] * found.tangent.on(&self.work.increment) / attempt.h;
                if work > 0.0 && contact.phase == (Phase::Resting { mean: false }) {
                    contact.phase = Phase::Resting { mean: true };
                    again = true;
                }
            }
            if !again {
                return Ok(());
            }
        }
    }

    /// A part without impact: of its whole size, up to the first instant of contact, or with held closing contacts.
    pub fn advance_freely(&mut self, decider: &mut Decider) -> Result<Trial, Failure> {
        let (mut active, mut open) = (decider.part.active.clone(), Vec::new());
        loop {
            let h = decider.h();
            self.solve_resting(&Attempt::free(h), &mut active)?;
            if decider.updates_open_contacts() {
                open = self.open_contacts();
            }
            let seen: Vec<Seen> = open.iter().map(|i| self.seen_over(h, *i)).collect();
            let verdict = decider.judge(&seen, |pairs| self.first_passage(pairs));
            active.extend_from_slice(&decider.part.active[active.len()..]);
            let kind = match (verdict, decider.part.resolution) {
                (Verdict::Again, _) => continue,
                (Verdict::Passed, _) => return Err(Failure::Passed),
                (Verdict::Ends { .. }, Resolution::Accumulated) => PartKind::Held,
                (Verdict::Ends { located }, _) => PartKind::Free { located },
            };
            return Ok(Trial { h, active, fallback_law: false, kind });
        }
    }

    /// Evaluates a sleeping pair in the current state.
    fn look(&mut self, i: usize) {
        let sights = &mut self.encounters.sights;
        if self.search.awake().binary_search(&i).is_err()
            && let Err(k) = sights.binary_search_by_key(&i, |sight| sight.0)
        {
            sights.insert(k, (i, self.state.woken(self.model, i)));
        }
    }

    /// Whether all smooth pairs within reach were evaluated; the others are evaluated next.
    fn near_enough(&mut self, h: f64) -> bool {
        let known = self.encounters.near.len();
        for k in 0..self.encounters.reached.len() {
            let i = self.encounters.reached[k];
            let unseen = self.is_smooth(i) && !self.encounters.near[..known].contains(&i);
            if unseen && self.gap_next(h, i)[0] < 0.0 {
                self.encounters.near.push(i);
            }
        }
        self.encounters.near.sort_unstable();
        self.encounters.near.len() == known
    }

    /// Whether the closest points of smooth contacts in the solution are still the closest at its end.
    fn closest_points_remain(&self) -> bool {
        let (at, smooth) = (self.end_of_step(), &self.work.smooth);
        let remains = |i: usize| {
            let (pair, seen) = (&self.model.pairs[i], self.seen(i));
            match smooth.binary_search_by_key(&i, |c| c.pair) {
                // A closest point that is not followed to the end of the step was not searched either.
                Ok(k) => smooth[k].end.is_none_or(|end| {
                    !pair.leaps(self.model, &at, &Memory { near: end.near, ..seen.memory })
                }),
                // It stayed beyond an end that is left to others.
                Err(_) => {
                    let end = pair.at_end(self.model, &at, &seen.memory, seen.gap);
                    end.is_none_or(|touch| touch.gap.is_infinite())
                }
            }
        };
        let on_axis = |i: &usize| matches!(self.model.pairs[*i].target, Target::Axis { .. });
        self.encounters
            .near
            .iter()
            .copied()
            .filter(on_axis)
            .filter(|i| self.is_smooth(*i))
            .all(remains)
    }

    pub(super) fn is_smooth(&self, i: usize) -> bool {
        let contact = &self.model.contacts[self.model.pairs[i].contact];
        matches!(contact.law, TouchLaw::Smooth(_))
    }

    /// The end of the step solved last.
    pub(super) fn end_of_step(&self) -> Configuration<'_> {
        let Workspace { increment, arcs, .. } = &*self.work;
        self.state.configuration_after(increment, arcs)
    }

    /// Gap of pair `i` at the end of the step solved last, and its rate.
    pub(super) fn gap_next(&self, h: f64, i: usize) -> [f64; 2] {
        let (pair, d) = (&self.model.pairs[i], &self.work.increment);
        let at = self.end_of_step();
        let seen = self.seen(i);
        let Some(touch) = pair.at_end(self.model, &at, &seen.memory, seen.gap) else {
            return [f64::INFINITY, 0.0];
        };
        let row = pair.normal_row(&touch, &at);
        let lead = &self.work.lead;
        let leads = if lead.is_empty() { 0.0 } else { row.on(&lead.velocity) };
        [touch.gap, 2.0 * row.on(d) / h - row.on(&self.state.velocity) + leads]
    }
}
