//! Where in time impacts happen.
//!
//! Event mode: if a step would end with a projectile inside the beam, the instant of contact is located by a root search
//! over the step size, each trial a full step; the shortened step is accepted, and the impulse acts in a pulse, a very short
//! step of its own. The pulse starts half its length before the gap vanishes, so that its middle is the instant of
//! contact; its impulse obeys Newton's law exactly, and its energy is booked exactly.
//!
//! Time-stepping mode: the gap is looked at once per step, as in the paper.

use super::simulation::Simulation;
use crate::error::Error;
use crate::math::hermite::Cubic;
use crate::math::roots;
use crate::model::frozen::ContactLaw;
use crate::record::Recorder;
use crate::settings::ImpactResolution;
use crate::step::commit;
use crate::step::integration::Integration;
use crate::step::newton::{ActiveContact, Failure, StepProblem};
use crate::summary::Impact;

/// Length of a pulse as a share of the step.
const PULSE: f64 = 1e-6;
/// Parts of a step below this share of it are as short as an impact: a mean force over them is an impulse in disguise.
const BRIEF: f64 = 1e-3;
/// A contact is located to this share of a pulse.
const LOCATED: f64 = 1e-3;
/// Approach slower than this share of the fastest one so far does not bounce: accumulating impacts end.
const STICK: f64 = 1e-6;
/// Nor does approach slower than this share of the velocities in play, which is round-off.
const NO_APPROACH: f64 = 1e-12;

/// What remains of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Advance {
    /// Size of the part to advance by, at most \[s\].
    pub size: f64,
    /// Share of the step to which failures have cut it; pulses are cut likewise.
    pub share: f64,
    /// Events (instants located, pulses) that this step of the given size may still have.
    pub events_left: usize,
}

impl Advance {
    /// More events than this in one step count as accumulated impacts: for the rest of the step what touches stays together.
    pub const MOST_EVENTS: usize = 128;
}

impl Simulation<'_> {
    /// Advances by a part of the step of at most the given size; returns the part, or why there is no solution.
    pub(super) fn advance_part(
        &mut self,
        advance: &mut Advance,
        recorder: &mut dyn Recorder,
    ) -> Result<Result<f64, Failure>, Error> {
        match self.settings.impacts {
            ImpactResolution::Event => {
                self.settle();
                if advance.events_left == 0 {
                    return Ok(self.accumulated_part(advance.size));
                }
                let touching = self.touching();
                if touching.is_empty() {
                    Ok(self.free_part(advance))
                } else {
                    self.impact(&touching, advance, recorder)
                }
            }
            ImpactResolution::TimeStepping { closed_tolerance } => {
                Ok(self.time_stepping_part(advance.size, closed_tolerance))
            }
        }
    }

    fn restitution(&self, i: usize) -> Option<f64> {
        match self.model.projectiles[i].law {
            ContactLaw::Unilateral { restitution } => Some(restitution),
            ContactLaw::Spring { .. } => None,
        }
    }

    fn rigid(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.model.projectiles.len()).filter(|i| self.restitution(*i).is_some())
    }

    /// Open rigid contacts.
    fn open_contacts(&self) -> impl Iterator<Item = usize> + '_ {
        self.rigid().filter(|i| !self.state.projectiles[*i].closed)
    }

    fn pulse(&self) -> f64 {
        PULSE * self.settings.step
    }

    /// Projectiles that lie on the beam, at rest but for round-off, count as closed.
    fn settle(&mut self) {
        let round_off = NO_APPROACH * self.velocity_in_play();
        for i in 0..self.model.projectiles.len() {
            let p = &self.model.projectiles[i];
            let reach = 1e-12 * self.model.beams[p.point.beam].length;
            let at_rest = self.restitution(i).is_some()
                && self.state.gap_rate(self.model, i).abs() <= round_off
                && self.state.gap(self.model, i) <= reach;
            if at_rest {
                self.state.projectiles[i].closed = true;
            }
        }
    }

    /// Open contacts that would close within the next three quarters of a pulse, and those just located.
    fn touching(&mut self) -> Vec<usize> {
        let near = |i: &usize| {
            let rate = self.state.gap_rate(self.model, *i);
            let gap = self.state.gap(self.model, *i);
            rate < 0.0 && (self.located == Some(*i) || gap < -0.75 * self.pulse() * rate)
        };
        let touching = self.open_contacts().filter(near).collect();
        self.located = None;
        touching
    }

    /// Approach velocities of projectile `i` up to this one do not bounce \[m/s\].
    fn stick_velocity(&self, i: usize) -> f64 {
        let round_off = NO_APPROACH * self.velocity_in_play();
        (STICK * self.state.projectiles[i].approach_max).max(round_off)
    }

    /// Velocity that goes with the largest energy of the run so far \[m/s\].
    fn velocity_in_play(&self) -> f64 {
        (2.0 * self.state.books.energy_scale / self.model.total_mass).sqrt()
    }

    /// Contacts that stay closed: held at zero gap rate while their impulse pushes.
    ///
    /// One that happens to open as the step begins is held where it is: its mean rate over the step is zero then, so that the
    /// impulse gives no energy.
    fn resting(&self) -> Vec<ActiveContact> {
        let bound = |i: usize| -self.state.gap_rate(self.model, i).max(0.0);
        self.rigid()
            .filter(|i| self.state.projectiles[*i].closed)
            .map(|projectile| ActiveContact { projectile, bound: bound(projectile) })
            .collect()
    }

    /// Solves a step of size `h` without accepting it.
    fn solve(&mut self, h: f64, active: &[ActiveContact]) -> Result<(), Failure> {
        self.solver_steps += 1;
        self.forcing.set(self.model, self.state.time, h, self.settings.step);
        let problem = StepProblem {
            model: self.model,
            state: &self.state,
            integration: Integration::new(self.settings.scheme, h),
            forcing: &self.forcing,
            damping: &self.damping,
            active,
            feedback: (h / self.settings.step).min(1.0),
        };
        problem.solve(&mut self.work, &mut self.effort)
    }

    /// Gap of projectile `i` at the end of the step solved last, and its rate.
    fn gap_next(&self, h: f64, i: usize) -> [f64; 2] {
        let problem = StepProblem {
            model: self.model,
            state: &self.state,
            integration: Integration::new(self.settings.scheme, h),
            forcing: &self.forcing,
            damping: &self.damping,
            active: &[],
            feedback: 0.0,
        };
        [problem.gap_next(&self.work, i), problem.gap_rate_next(&self.work, i)]
    }

    /// Accepts the step solved last and measures the new state.
    fn accept(&mut self, h: f64) {
        let integration = Integration::new(self.settings.scheme, h);
        self.monitor.begin_step(self.model, &self.state);
        let brief = h < BRIEF * self.settings.step;
        let before = brief.then(|| self.state.multiplier.clone());
        let (state, forcing) = (&mut self.state, &self.forcing);
        commit::commit(self.model, state, integration, forcing, &self.damping, &self.work);
        if let Some(before) = before {
            // Multipliers of an impact are impulses over its time: no prediction for what follows.
            self.state.multiplier = before;
        }
        self.monitor.end_step(self.model, &self.state, h, &self.work.force, brief);
        self.gather_reactions(h, brief);
        for (i, sum) in self.row_impulse.iter_mut().enumerate() {
            *sum += self.work.impulse[i] + h * self.work.force[i]; // one of the two is zero
        }
        self.measure();
    }

    /// A step without impacts: of the given size, or up to the first instant of contact.
    fn free_part(&mut self, advance: &mut Advance) -> Result<f64, Failure> {
        let resting = self.resting();
        self.solve(advance.size, &resting)?;
        let contact = self.first_contact(advance.size, &resting)?;
        let done = contact.unwrap_or(advance.size);
        advance.events_left -= usize::from(contact.is_some());
        self.located = contact.and_then(|instant| {
            let ahead = |i: &usize| self.gap_ahead(instant, *i);
            self.open_contacts().min_by(|a, b| ahead(a).total_cmp(&ahead(b)))
        });
        self.accept(done);
        for contact in &resting {
            self.book_persistent(contact.projectile);
        }
        Ok(done)
    }

    /// The rest of a step in which impacts have accumulated: contacts no wider than the fastest approach covers in a pulse
    /// are held while they push, and none is sought.
    fn accumulated_part(&mut self, size: f64) -> Result<f64, Failure> {
        for i in 0..self.model.projectiles.len() {
            let reach = self.pulse() * self.state.projectiles[i].approach_max;
            if self.restitution(i).is_some() && self.state.gap(self.model, i) <= reach {
                self.state.projectiles[i].closed = true;
            }
        }
        let resting = self.resting();
        self.solve(size, &resting)?;
        self.accept(size);
        for contact in &resting {
            self.book_persistent(contact.projectile);
        }
        Ok(size)
    }

    /// Releases a resting contact whose impulse has vanished, and notes its impulse.
    fn book_persistent(&mut self, i: usize) {
        let impulse = self.work.impulse[i];
        let closed = impulse > 0.0;
        self.state.projectiles[i].closed = closed;
        self.monitor.persistent(i, impulse, self.state.time, closed);
    }

    /// The gap of projectile `i` half a pulse after the end of the step solved last.
    fn gap_ahead(&self, h: f64, i: usize) -> f64 {
        let [gap, rate] = self.gap_next(h, i);
        gap + 0.5 * self.pulse() * rate.min(0.0)
    }

    fn least_gap_ahead(&self, h: f64) -> f64 {
        self.nearest_ahead(h).0
    }

    /// Least gap ahead of all open contacts, and whether the one it belongs to approaches.
    fn nearest_ahead(&self, h: f64) -> (f64, bool) {
        let nearest = self
            .open_contacts()
            .map(|i| (self.gap_ahead(h, i), i))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or((f64::INFINITY, false), |(ahead, i)| (ahead, self.gap_next(h, i)[1] < 0.0))
    }

    /// The instant of the first contact within the step of size `size` solved last, if there is one; the step up to it is
    /// then the one solved last.
    fn first_contact(
        &mut self,
        size: f64,
        resting: &[ActiveContact],
    ) -> Result<Option<f64>, Failure> {
        if self.open_contacts().next().is_none() {
            return Ok(None);
        }
        let paths: Vec<Cubic> = self
            .open_contacts()
            .map(|i| Cubic {
                h: size,
                start: [self.state.gap(self.model, i), self.state.gap_rate(self.model, i)],
                end: self.gap_next(size, i),
            })
            .collect();
        let (mut end, mut ahead) = (size, self.least_gap_ahead(size));
        if ahead > 0.0 {
            // A projectile may have dipped into the beam and out again.
            let dips = |c: &Cubic| c.stationary().find(|t| c.value(*t) < 0.0);
            let Some(dip) = paths.iter().filter_map(dips).reduce(f64::min) else {
                return Ok(None);
            };
            self.solve(dip, resting)?;
            (end, ahead) = (dip, self.least_gap_ahead(dip));
            if ahead > 0.0 {
                self.solve(size, resting)?;
                return Ok(None);
            }
        }
        let rate = paths.iter().map(|c| c.start[1].abs().max(c.end[1].abs())).fold(0.0, f64::max);
        let tolerance = LOCATED * self.pulse();
        let start = paths
            .iter()
            .map(|c| c.start[0] + 0.5 * self.pulse() * c.start[1].min(0.0))
            .fold(f64::INFINITY, f64::min)
            .max(tolerance * rate);
        let guess = end * start / (start - ahead);
        let guess = paths.iter().filter_map(|c| descent(c, end)).reduce(f64::min).unwrap_or(guess);
        let guess = guess - 0.5 * self.pulse();
        let instant = roots::bracketed(
            (0.0, start),
            (end, ahead),
            guess,
            tolerance,
            tolerance * rate,
            |t| {
                self.solve(t, resting)?;
                let (ahead, approaching) = self.nearest_ahead(t);
                // A contact that has just opened is as near as one about to close, but is not what is sought; one that lies
                // inside the beam is, even on its way out again.
                Ok::<f64, Failure>(if approaching || ahead < -tolerance * rate {
                    ahead
                } else {
                    ahead.max(2.0 * tolerance * rate)
                })
            },
        )?;
        Ok(Some(instant))
    }

    /// The pulse in which the impulses of the touching contacts act.
    fn impact(
        &mut self,
        touching: &[usize],
        advance: &mut Advance,
        recorder: &mut dyn Recorder,
    ) -> Result<Result<f64, Failure>, Error> {
        let pulse = self.pulse() * advance.share;
        let resting = self.resting();
        let mut active = resting.clone();
        let mut before = Vec::with_capacity(touching.len());
        for &i in touching {
            let rate = self.state.gap_rate(self.model, i);
            let p = &mut self.state.projectiles[i];
            p.approach_max = p.approach_max.max(-rate);
            let sticks = -rate <= self.stick_velocity(i);
            let e = if sticks { 0.0 } else { self.restitution(i).unwrap_or(0.0) };
            before.push((i, rate, e));
            active.push(ActiveContact { projectile: i, bound: -e * rate });
        }
        if let Err(failure) = self.solve(pulse, &active) {
            return Ok(Err(failure));
        }
        let time = self.state.time + 0.5 * pulse;
        let after: Vec<f64> = touching.iter().map(|i| self.gap_next(pulse, *i)[1]).collect();
        let strikes = touching.iter().any(|i| self.work.impulse[*i] > 0.0);
        if strikes {
            self.record(recorder)?;
        }
        self.accept(pulse);
        for contact in &resting {
            self.book_persistent(contact.projectile);
        }
        for ((i, rate, e), separation) in before.into_iter().zip(after) {
            // What sticks is held from here on; if nothing presses it, the next step releases it.
            self.state.projectiles[i].closed = e == 0.0;
            let impulse = self.work.impulse[i];
            if impulse > 0.0 {
                let energy_lost = -0.5 * impulse * (rate + separation);
                let (approach_velocity, separation_velocity) = (-rate, separation);
                self.monitor.impact(
                    i,
                    Impact { time, impulse, approach_velocity, separation_velocity, energy_lost },
                );
            }
        }
        advance.events_left = advance.events_left.saturating_sub(1);
        if strikes {
            self.record(recorder)?;
        }
        Ok(Ok(pulse))
    }

    /// A step of the paper's: contacts closed at its start obey Newton's law over the whole step.
    fn time_stepping_part(&mut self, size: f64, closed_tolerance: f64) -> Result<f64, Failure> {
        let closed: Vec<(ActiveContact, f64)> = self
            .rigid()
            .filter(|i| self.state.gap(self.model, *i) <= closed_tolerance)
            // What separates already is not struck: an impulse on its way out would give energy.
            .filter(|i| self.state.gap_rate(self.model, *i) <= self.stick_velocity(*i))
            .map(|projectile| {
                let rate = self.state.gap_rate(self.model, projectile);
                let e = self.restitution(projectile).unwrap_or(0.0);
                (ActiveContact { projectile, bound: -e * rate }, rate)
            })
            .collect();
        let active: Vec<ActiveContact> = closed.iter().map(|(contact, _)| *contact).collect();
        self.solve(size, &active)?;
        let start = self.state.time;
        let after: Vec<f64> = active.iter().map(|c| self.gap_next(size, c.projectile)[1]).collect();
        self.accept(size);
        for ((contact, rate), separation) in closed.into_iter().zip(after) {
            let i = contact.projectile;
            let impulse = self.work.impulse[i];
            let p = &mut self.state.projectiles[i];
            p.approach_max = p.approach_max.max(-rate);
            if -rate <= self.stick_velocity(i) {
                self.monitor.persistent(i, impulse, self.state.time, impulse > 0.0);
            } else if impulse > 0.0 {
                let energy_lost = -0.5 * impulse * (rate + separation);
                self.monitor.impact(
                    i,
                    Impact {
                        time: start,
                        impulse,
                        approach_velocity: -rate,
                        separation_velocity: separation,
                        energy_lost,
                    },
                );
            }
        }
        Ok(size)
    }
}

/// Where the gap first falls to zero, if it does before `end`.
fn descent(gap: &Cubic, end: f64) -> Option<f64> {
    let (a, b) = (gap.value(0.0), gap.value(end));
    if a <= 0.0 || b > 0.0 {
        return None;
    }
    let f = |t: f64| Ok::<f64, std::convert::Infallible>(gap.value(t));
    match roots::bracketed((0.0, a), (end, b), end * a / (a - b), 1e-12 * end, 0.0, f) {
        Ok(t) => Some(t),
    }
}
