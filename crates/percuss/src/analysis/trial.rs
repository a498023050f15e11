//! A step tried: solved with the pairs that could touch, looked at for what passed through unseen, accepted.

use super::simulation::Simulation;
use crate::geometry::configuration::Configuration;
use crate::geometry::pair::{Memory, Target};
use crate::geometry::touch::Reach;
use crate::math::vec2::norm;
use crate::model::TouchLaw;
use crate::model::frozen::BodyKind;
use crate::settings::Scheme;
use crate::step::contacts::{ActiveContact, IMPULSIVE, ImpulseLaw, Phase};
use crate::step::integration::Integration;
use crate::step::newton::{Failure, StepProblem};
use crate::step::workspace::Workspace;
use crate::step::{commit, flows};

/// Pairs that could touch if everything moved by so many times its velocity are looked at within a step.
const AHEAD: f64 = 2.0;
/// Looks along a path; what has not been seen inside by then is taken to slide along the face.
const LOOKS: usize = 200;
/// What is inside for less of its way than this share of the distance at which centre and axis touch has only grazed the face,
/// no deeper than about a thousandth of that distance.
const GRAZE: f64 = 0.1;

impl Simulation<'_> {
    /// Solves a step of size `h` without accepting it.
    pub(super) fn solve(
        &mut self,
        h: f64,
        active: &[ActiveContact],
        law: ImpulseLaw,
    ) -> Result<(), Failure> {
        self.solver_steps += 1;
        let (time, step) = (self.state.time, self.settings.step);
        let followed = &self.state.followed;
        self.forcing.set(self.model, time, h, step, followed);
        if self.jumping {
            self.forcing.set_motions(self.model, time, h, step, followed, true);
        }
        self.search.within(self.model, &self.state.velocity, AHEAD * h, &mut self.near);
        let near = std::mem::take(&mut self.near);
        self.look(&near);
        self.near = near;
        let mut reach = Reach::Near;
        loop {
            let problem = StepProblem {
                model: self.model,
                state: &self.state,
                integration: self.integration(h),
                forcing: &self.forcing,
                damping: &self.damping,
                size: self.size,
                near: &self.near,
                active,
                law,
                feedback: (h / self.settings.step).min(1.0),
                arcs: self.search.arcs(),
                reach,
            };
            let solved = problem.solve(&mut self.work, &mut self.effort);
            if reach == Reach::Near && !self.closest_points_stand() {
                reach = Reach::All;
                continue;
            }
            solved?;
            self.search.within(self.model, &self.work.increment, 1.0, &mut self.reached);
            let reached = std::mem::take(&mut self.reached);
            self.look(&reached);
            self.reached = reached;
            if self.near_enough(h) {
                break;
            }
        }
        self.smooth_passage()
    }

    /// The scheme on a step of size `h`; accelerations know no impulses, so jumps of velocity are made by the midpoint rule.
    fn integration(&self, h: f64) -> Integration {
        let by_midpoint = self.jumping && self.settings.scheme.advances_accelerations();
        Integration::new(if by_midpoint { Scheme::Midpoint } else { self.settings.scheme }, h)
    }

    /// Looks at pairs that still sleep, where the state stands. They have not touched since they fell asleep, so they are
    /// on the side where they are seen.
    fn look(&mut self, pairs: &[usize]) {
        for i in pairs {
            if self.search.awake().binary_search(i).is_err() && !self.looked.contains(i) {
                self.state.pairs[*i].memory.side = 0.0;
                self.state.see(self.model, *i, Reach::All);
                self.looked.push(*i);
            }
        }
    }

    /// Whether every smooth pair that came within reach was looked at; if not, they will be.
    fn near_enough(&mut self, h: f64) -> bool {
        let known = self.near.len();
        for k in 0..self.reached.len() {
            let i = self.reached[k];
            if self.is_smooth(i) && !self.near[..known].contains(&i) && self.gap_next(h, i)[0] < 0.0
            {
                self.near.push(i);
            }
        }
        self.near.sort_unstable();
        self.near.len() == known
    }

    /// Whether nothing has come nearer to smooth contacts, as the step was solved, than the closest points it was solved with.
    fn closest_points_stand(&self) -> bool {
        let (at, smooth) = (self.end_of_step(), &self.work.smooth);
        let stands = |i: usize| {
            let (pair, seen) = (&self.model.pairs[i], &self.state.pairs[i]);
            match smooth.binary_search_by_key(&i, |c| c.pair) {
                // A closest point that is not followed to the end of the step was not looked for either.
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
        self.near.iter().copied().filter(on_axis).filter(|i| self.is_smooth(*i)).all(stands)
    }

    fn is_smooth(&self, i: usize) -> bool {
        let contact = &self.model.contacts[self.model.pairs[i].contact];
        matches!(contact.law, TouchLaw::Smooth(_))
    }

    /// The end of the step solved last.
    fn end_of_step(&self) -> Configuration<'_> {
        let Workspace { increment, arcs, .. } = &self.work;
        Configuration { start: &self.state.displacement, increment, share: 1.0, arcs }
    }

    /// Gap of pair `i` at the end of the step solved last, and its rate.
    pub(super) fn gap_next(&self, h: f64, i: usize) -> [f64; 2] {
        let (pair, d) = (&self.model.pairs[i], &self.work.increment);
        let at = self.end_of_step();
        let seen = &self.state.pairs[i];
        let Some(touch) = pair.at_end(self.model, &at, &seen.memory, seen.gap) else {
            return [f64::INFINITY, 0.0];
        };
        let row = pair.normal_row(&touch, &at);
        let lead = &self.work.lead;
        let leads = if lead.is_empty() { 0.0 } else { row.on(&lead.velocity) };
        [touch.gap, 2.0 * row.on(d) / h - row.on(&self.state.velocity) + leads]
    }

    /// Fails if a smooth pair has passed through unseen.
    fn smooth_passage(&mut self) -> Result<(), Failure> {
        let reached = std::mem::take(&mut self.reached);
        let smooth: Vec<usize> = reached.iter().copied().filter(|i| self.is_smooth(*i)).collect();
        self.reached = reached;
        if self.first_passage(&smooth).is_some() { Err(Failure::Passed) } else { Ok(()) }
    }

    /// The share of the step solved last at which the first of the given open pairs is inside another, though at its end it is
    /// outside again, or inside from the other side: one has passed through the other. The side it came from is remembered
    /// if it was not known.
    pub(super) fn first_passage(&mut self, pairs: &[usize]) -> Option<f64> {
        let mut first: Option<f64> = None;
        for &i in pairs {
            if let Some((share, memory)) = self.passage(i) {
                let seen = &mut self.state.pairs[i].memory;
                if seen.side == 0.0 {
                    seen.side = memory.side;
                }
                first = Some(first.map_or(share, |f| f.min(share)));
            }
        }
        first
    }

    /// Follows pair `i` along the straight path of the step, never further than it is apart.
    fn passage(&self, i: usize) -> Option<(f64, Memory)> {
        let pair = &self.model.pairs[i];
        let seen = &self.state.pairs[i];
        if !pair.target.has_sides() || seen.gap <= 0.0 || seen.gap.is_nan() {
            return None;
        }
        let at = self.end_of_step();
        let way = self.search.way(&pair.movers);
        let mut memory = seen.memory;
        let chord = GRAZE * pair.thickness(self.model, &memory);
        if seen.gap + chord > way {
            return None;
        }
        let last = pair.at_end(self.model, &at, &memory, seen.gap)?;
        // Inside where it is looked for, or outside at both ends and not fast enough to have been inside.
        let inside = last.gap <= 0.0;
        let entered = inside && last.memory.side == memory.side;
        if entered || seen.gap + chord + last.apart.max(0.0) > way {
            return None;
        }
        let floor = chord.max(1e-6 * way).max(1e-9 * seen.gap);
        let (mut share, mut apart) = (0.0, seen.gap);
        for _ in 0..LOOKS {
            share += apart.max(floor) / way;
            if share >= 1.0 {
                return None;
            }
            let touch = pair.touch(self.model, &at.at(share), &memory, Reach::All)?;
            if touch.gap < 0.0 {
                let side = touch.memory.side;
                let meant = inside && (side == last.memory.side || side == 0.0);
                return (!meant).then_some((share, memory));
            }
            (apart, memory) = (touch.apart, touch.memory);
        }
        None
    }

    /// Accepts the step solved last, with the contacts that took part in it, and measures the new state.
    pub(super) fn accept(&mut self, h: f64, active: &[ActiveContact]) {
        let integration = self.integration(h);
        let impulsive = h < IMPULSIVE * self.settings.step;
        let (forcing, persistent) = (&self.forcing, self.persistent.as_slice());
        let solved =
            super::monitor::Solved { rule: integration, forcing, impulsive, active, persistent };
        self.monitor.begin_step(self.model, &self.state, &self.work, &solved);
        let before = impulsive.then(|| self.state.multiplier.clone());
        let strikes = |c: &ActiveContact| !matches!(c.phase, Phase::Resting { .. });
        let carries_impulses = impulsive && (self.jumping || active.iter().any(strikes));
        self.gather_given(h);
        self.note_start_reactions(integration);
        self.remember();
        let (state, forcing) = (&mut self.state, &self.forcing);
        commit::commit(self.model, state, integration, forcing, &self.damping, &self.work);
        if let Some(before) = before {
            // Multipliers of an impact are impulses over its time: no prediction for what follows.
            self.state.multiplier = before;
        }
        self.steer_obstacles();
        self.search.moved(self.model);
        self.search.see(self.model, &mut self.state, Reach::Near);
        let part = super::monitor::Part {
            h,
            impulsive,
            active,
            persistent: &self.persistent,
            fallback_law: std::mem::take(&mut self.fallback_law),
            awake: self.search.awake(),
        };
        self.monitor.end_step(self.model, &self.state, &self.work, &part);
        self.frames.part = (h, carries_impulses);
        self.gather_reactions(h, carries_impulses);
        self.gather_impulses(h, active);
        self.measure();
    }

    /// Reactions at the start of the step solved last, where the step before does not tell them.
    fn note_start_reactions(&mut self, integration: Integration) {
        // Whether or not velocities have jumped there.
        let of_run = self.state.step == 0;
        let found = integration.at_start(of_run).filter(|_| self.state.instant.is_none());
        let Some(at_start) = found else { return };
        let (model, state, forcing) = (self.model, &self.state, &self.forcing);
        let mut work = self.work.clone();
        work.lead.set(model, state, &at_start, forcing);
        let problem = StepProblem {
            model,
            state,
            integration: at_start,
            forcing,
            damping: &self.damping,
            size: self.size,
            near: &self.near,
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
    fn remember(&mut self) {
        let (model, state) = (self.model, &mut self.state);
        for &i in self.reached.iter().filter(|i| model.pairs[**i].target.has_sides()) {
            let seen = &mut state.pairs[i];
            let Workspace { increment, arcs, smooth, .. } = &self.work;
            let at = Configuration { start: &state.displacement, increment, share: 1.0, arcs };
            let known =
                smooth.binary_search_by_key(&i, |c| c.pair).ok().and_then(|k| smooth[k].end);
            let end = known.or_else(|| {
                model.pairs[i].at_end(model, &at, &seen.memory, seen.gap).map(|touch| touch.memory)
            });
            seen.memory = end.unwrap_or(seen.memory);
        }
        self.looked.clear();
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

/// Size of the structure \[m\].
pub(super) fn size_of(model: &crate::model::Model) -> f64 {
    let from = model.nodes.first().map_or([0.0; 2], |n| n.position);
    let away = |x: [f64; 2]| norm([x[0] - from[0], x[1] - from[1]]);
    let lengths = model.beams.iter().map(|b| b.length);
    lengths.chain(model.nodes.iter().map(|n| away(n.position))).fold(0.0, f64::max)
}
