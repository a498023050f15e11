//! Where in time impacts happen.
//!
//! Event mode: if a step would end with one rigid thing inside another, or if they have passed through each other on the way, the
//! instant of contact is located by a root search over the step size, each trial a full step; the shortened step is accepted,
//! and the impulse acts in an impact interval, a very short step of its own. The impact interval starts half its length before the gap vanishes, so
//! that its middle is the instant of contact; its impulse obeys the impact law exactly, and its energy enters the balance exactly.
//!
//! Time-stepping mode: the gap is looked at once per step, as in the paper.

use super::simulation::Simulation;
use crate::analysis::record::Recorder;
use crate::error::Error;
use crate::math::hermite::Cubic;
use crate::math::roots;
use crate::model::{ImpactLaw, RigidLaw, TouchLaw};
use crate::settings::{ImpactResolution, MultipleImpacts};
use crate::step::contacts::{ActiveContact, ImpulseLaw, Phase, RigidContact};
use crate::step::newton::Failure;

/// Length of an impact interval as a share of the step.
pub(super) const IMPACT_INTERVAL: f64 = 1e-6;
/// A contact is located to this share of an impact interval.
const LOCATED: f64 = 1e-3;
/// Differences of gaps below this share of the size of the structure are round-off.
const ROUND_OFF: f64 = 1e-15;
/// Approach slower than this share of the fastest one so far does not bounce: accumulating impacts end.
pub(super) const STICK: f64 = 1e-6;
/// Nor does approach slower than this share of the velocity scale, which is round-off.
const NO_APPROACH: f64 = 1e-12;
/// Nor does approach slower than this share of what gravity gives in a step: piles at rest would rattle over gaps of a picometre.
const CREEP: f64 = 1e-5;
/// Energy that impulses may give, relative to the work they do: round-off.
const NO_GAIN: f64 = 1e-12;

/// What remains of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Advance {
    /// Size of the part to advance by, at most \[s\].
    pub size: f64,
    /// Share of the step to which failures have cut it; impact intervals are cut likewise.
    pub share: f64,
    /// Events (instants located, impact intervals) that this step of the given size may still have.
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
        if self.jumps() {
            return Ok(self.jump(advance.share));
        }
        match self.settings.impacts {
            ImpactResolution::Event => {
                self.settle();
                if advance.events_left == 0 {
                    return Ok(self.accumulated_part(advance.size));
                }
                let touching = self.touching();
                let sequential = self.settings.multiple_impacts == MultipleImpacts::Sequential;
                if touching.is_empty() {
                    Ok(self.free_part(advance))
                } else if sequential {
                    self.impacts_in_sequence(&touching, advance, recorder)
                } else {
                    self.impact(&touching, advance, recorder)
                }
            }
            ImpactResolution::TimeStepping { closed_tolerance } => {
                Ok(self.time_stepping_part(advance.size, closed_tolerance))
            }
        }
    }

    /// Law of pair `i`, if it is a rigid one.
    fn rigid_law(&self, i: usize) -> Option<RigidLaw> {
        match &self.model.contacts[self.model.pairs[i].contact].law {
            TouchLaw::Rigid(law) => Some(*law),
            TouchLaw::Smooth(_) => None,
        }
    }

    pub(super) fn impact_interval(&self) -> f64 {
        IMPACT_INTERVAL * self.settings.step
    }

    /// Rigid pairs near enough to matter where the state stands.
    pub(super) fn rigid(&self) -> Vec<usize> {
        let awake = self.search.awake().iter().copied();
        awake.filter(|i| self.rigid_law(*i).is_some()).collect()
    }

    /// Rigid pairs that touch, at rest but for what is no approach, count as closed.
    fn settle(&mut self) {
        let (slow, reach) = (self.no_approach(), self.no_gap());
        for i in self.rigid() {
            let pair = &mut self.state.pairs[i];
            if pair.gap <= reach && pair.rate.abs() <= slow {
                pair.closed = true;
            }
        }
    }

    /// Open contacts that would close within the next three quarters of an impact interval, and those just located.
    fn touching(&mut self) -> Vec<usize> {
        let located = self.located.take();
        let interval = self.impact_interval();
        let near = |i: &usize| {
            let pair = &self.state.pairs[*i];
            let close = located == Some(*i) || pair.gap < -0.75 * interval * pair.rate;
            !pair.closed && pair.rate < 0.0 && close
        };
        self.rigid().into_iter().filter(near).collect()
    }

    /// Approach velocities of pair `i` up to this one do not bounce \[m/s\].
    pub(super) fn stick_velocity(&self, i: usize) -> f64 {
        (STICK * self.state.pairs[i].approach_max).max(self.no_approach())
    }

    /// Velocities up to this one are none between things that touch \[m/s\].
    pub(super) fn no_approach(&self) -> f64 {
        let creep = CREEP * self.model.gravity() * self.settings.step;
        creep.max(NO_APPROACH * self.velocity_in_play())
    }

    /// Gaps up to this one are none between things that do not approach \[m\].
    fn no_gap(&self) -> f64 {
        (1e-12 * self.size).max(self.no_approach() * self.settings.step)
    }

    /// Velocity that goes with the largest energy of the run so far \[m/s\].
    fn velocity_in_play(&self) -> f64 {
        (2.0 * self.state.ledger.energy_scale / self.model.total_mass).sqrt()
    }

    /// Contacts that stay closed.
    pub(super) fn resting(&self) -> Vec<ActiveContact> {
        let closed = self.rigid().into_iter().filter(|i| self.state.pairs[*i].closed);
        closed.map(ActiveContact::resting).collect()
    }

    /// Solves a step in which nothing strikes but `resting` contacts stay closed; friction on them never gives energy.
    pub(super) fn solve_resting(
        &mut self,
        h: f64,
        resting: &mut [ActiveContact],
    ) -> Result<(), Failure> {
        loop {
            self.solve(h, resting, ImpulseLaw::Newton)?;
            let mut again = false;
            for (contact, found) in resting.iter_mut().zip(&self.work.rigid) {
                let work = found.impulse[1] * found.tangent.on(&self.work.increment) / h;
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

    /// A step without impacts: of the given size, or up to the first instant of contact.
    fn free_part(&mut self, advance: &mut Advance) -> Result<f64, Failure> {
        let mut resting = self.resting();
        self.solve_resting(advance.size, &mut resting)?;
        let contact = self.first_contact(advance.size, &mut resting)?;
        let done = contact.unwrap_or(advance.size);
        advance.events_left -= usize::from(contact.is_some());
        self.located = contact.and_then(|instant| {
            let open = self.open_contacts();
            open.into_iter()
                .min_by(|a, b| self.gap_ahead(instant, *a).total_cmp(&self.gap_ahead(instant, *b)))
        });
        self.accept(done, &resting);
        self.release(&resting);
        Ok(done)
    }

    /// Releases resting contacts whose impulse has vanished.
    pub(super) fn release(&mut self, active: &[ActiveContact]) {
        for (contact, found) in active.iter().zip(&self.work.rigid) {
            if !matches!(contact.phase, Phase::Impact { .. }) {
                let pressed = contact.phase.carried()[0] + found.impulse[0];
                self.state.pairs[contact.pair].closed = pressed > 0.0;
            }
        }
    }

    /// Open rigid pairs that could touch within the step solved last.
    pub(super) fn open_contacts(&self) -> Vec<usize> {
        let open = |i: &usize| self.rigid_law(*i).is_some() && !self.state.pairs[*i].closed;
        self.reached.iter().copied().filter(open).collect()
    }

    /// The gap of pair `i` half an impact interval after the end of the step solved last, as [`Self::path`] counts it.
    fn gap_ahead(&self, h: f64, i: usize) -> f64 {
        let [gap, rate] = self.gap_next(h, i);
        gap - self.floor(i) + 0.5 * self.impact_interval() * rate.min(0.0)
    }

    /// What the gap of pair `i` is below zero by round-off where the step begins.
    fn floor(&self, i: usize) -> f64 {
        self.state.pairs[i].gap.clamp(-self.no_gap(), 0.0)
    }

    /// The gap of pair `i` over the step of size `h` solved last; one that opens from round-off below zero begins at zero.
    fn path(&self, h: f64, i: usize) -> Cubic {
        let pair = &self.state.pairs[i];
        let (floor, [gap, rate]) = (self.floor(i), self.gap_next(h, i));
        Cubic { h, start: [pair.gap - floor, pair.rate], end: [gap - floor, rate] }
    }

    /// Least gap ahead of the given contacts, and whether the one it belongs to approaches.
    fn nearest_ahead(&self, h: f64, open: &[usize]) -> (f64, bool) {
        let nearest =
            open.iter().map(|i| (self.gap_ahead(h, *i), *i)).min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or((f64::INFINITY, false), |(ahead, i)| (ahead, self.gap_next(h, i)[1] < 0.0))
    }

    /// The instant of the first contact within the step of size `size` solved last, if there is one; the step up to it is
    /// then the one solved last.
    fn first_contact(
        &mut self,
        size: f64,
        resting: &mut [ActiveContact],
    ) -> Result<Option<f64>, Failure> {
        let open = self.open_contacts();
        if open.is_empty() {
            return Ok(None);
        }
        let paths: Vec<Cubic> = open.iter().map(|i| self.path(size, *i)).collect();
        let (mut end, mut ahead) = (size, self.nearest_ahead(size, &open).0);
        if ahead > 0.0 {
            // One may have dipped into the other and out again, or passed through it.
            let dips = |c: &Cubic| c.stationary().find(|t| c.value(*t) < 0.0);
            let dip = paths.iter().filter_map(dips).reduce(f64::min);
            let passed = self.first_passage(&open).map(|share| share * size);
            let Some(dip) = [dip, passed].into_iter().flatten().reduce(f64::min) else {
                return Ok(None);
            };
            self.solve_resting(dip, resting)?;
            (end, ahead) = (dip, self.nearest_ahead(dip, &open).0);
            if ahead > 0.0 {
                if passed.is_some() {
                    return Err(Failure::Passed);
                }
                self.solve_resting(size, resting)?;
                return Ok(None);
            }
        }
        let rate = paths.iter().map(|c| c.start[1].abs().max(c.end[1].abs())).fold(0.0, f64::max);
        let tolerance = LOCATED * self.impact_interval();
        let near = (tolerance * rate).max(ROUND_OFF * self.size);
        let start = paths
            .iter()
            .map(|c| c.start[0] + 0.5 * self.impact_interval() * c.start[1].min(0.0))
            .fold(f64::INFINITY, f64::min)
            .max(near);
        let guess = end * start / (start - ahead);
        let guess = paths.iter().filter_map(|c| descent(c, end)).reduce(f64::min).unwrap_or(guess);
        let guess = guess - 0.5 * self.impact_interval();
        let instant = roots::bracketed((0.0, start), (end, ahead), guess, tolerance, near, |t| {
            self.solve_resting(t, resting)?;
            let (ahead, approaching) = self.nearest_ahead(t, &open);
            // A contact that has just opened is as near as one about to close, but is not what is sought; one that lies
            // inside is, even on its way out again.
            Ok::<f64, Failure>(if approaching || ahead < -near {
                ahead
            } else {
                ahead.max(2.0 * near)
            })
        })?;
        Ok(Some(instant))
    }

    /// The impact interval in which the impulses of the touching contacts act.
    pub(super) fn impact(
        &mut self,
        touching: &[usize],
        advance: &mut Advance,
        recorder: &mut dyn Recorder,
    ) -> Result<Result<f64, Failure>, Error> {
        let interval = self.impact_interval() * advance.share;
        let mut active = self.resting();
        for &i in touching {
            let rate = self.state.pairs[i].rate;
            let pair = &mut self.state.pairs[i];
            pair.approach_max = pair.approach_max.max(-rate);
            let sticks = -rate <= self.stick_velocity(i);
            active.push(self.striking(i, sticks));
        }
        let fallback_law = match self.solve_impact(interval, &active) {
            Ok(fallback_law) => fallback_law,
            Err(failure) => return Ok(Err(failure)),
        };
        let struck = &self.work.rigid[active.len() - touching.len()..];
        let strikes = struck.iter().any(|contact| contact.impulse[0] > 0.0);
        if strikes {
            self.record(recorder)?;
        }
        self.note_shared_blow(&active);
        self.accept_impact(interval, &active, fallback_law);
        advance.events_left = advance.events_left.saturating_sub(1);
        if strikes {
            self.record(recorder)?;
        }
        Ok(Ok(interval))
    }

    /// Accepts the impact interval solved last.
    pub(super) fn accept_impact(
        &mut self,
        interval: f64,
        active: &[ActiveContact],
        fallback_law: bool,
    ) {
        self.fallback_law = fallback_law;
        self.accept(interval, active);
        self.weigh_struck(active);
        self.release(active);
        for contact in active {
            if let Phase::Impact { restitution, .. } = contact.phase {
                // What sticks is held from here on; if nothing presses it, the next step releases it.
                self.state.pairs[contact.pair].closed = restitution == 0.0;
            }
        }
    }

    /// Pair `i` as it strikes; without restitution where it sticks.
    pub(super) fn striking(&self, i: usize, sticks: bool) -> ActiveContact {
        let law = self.rigid_law(i);
        let e = |law: RigidLaw| (law.restitution, law.tangential_restitution);
        let (restitution, tangential) = law.filter(|_| !sticks).map_or((0.0, 0.0), e);
        ActiveContact { pair: i, phase: Phase::Impact { restitution, tangential } }
    }

    /// Solves a step with impulses by the contacts' impact law, by another one where that would give energy; tells whether it
    /// would have.
    pub(super) fn solve_impact(
        &mut self,
        h: f64,
        active: &[ActiveContact],
    ) -> Result<bool, Failure> {
        let moreau = |c: &ActiveContact| {
            self.rigid_law(c.pair).is_some_and(|law| law.impact == ImpactLaw::Moreau)
        };
        let laws: &[ImpulseLaw] = if active.iter().any(moreau) {
            &[ImpulseLaw::Moreau, ImpulseLaw::Mean]
        } else {
            &[ImpulseLaw::Newton, ImpulseLaw::Moreau, ImpulseLaw::Mean]
        };
        let mut outcome = Err(Failure::Impact);
        for (k, law) in laws.iter().enumerate() {
            outcome = self.solve(h, active, *law).map(|()| k > 0);
            // With friction, a law may also have no solution.
            let unsolved = outcome == Err(Failure::Impact);
            if !unsolved && (outcome.is_err() || !self.impulses_give(h, 0.0)) {
                break;
            }
        }
        outcome
    }

    /// Whether the impulses of the step solved last, and those before that did so much work, give energy.
    pub(super) fn impulses_give(&self, h: f64, before: f64) -> bool {
        let mut size = 0.0_f64;
        for found in &self.work.rigid {
            for (impulse, row) in found.impulse.iter().zip([&found.normal, &found.tangent]) {
                size += (impulse * row.on(&self.state.velocity)).abs();
            }
        }
        self.work_of_impulses(h) + before > NO_GAIN * size
    }

    /// Work of the impulses of the step of size `h` solved last \[J\].
    pub(super) fn work_of_impulses(&self, h: f64) -> f64 {
        let work = |found: &RigidContact| {
            let rows = found.impulse.iter().zip([&found.normal, &found.tangent]);
            rows.map(|(impulse, row)| impulse * row.on(&self.work.increment) / h).sum::<f64>()
        };
        self.work.rigid.iter().map(work).sum()
    }

    /// A step of the paper's: contacts closed at its start obey the impact law over the whole step.
    fn time_stepping_part(&mut self, size: f64, closed_tolerance: f64) -> Result<f64, Failure> {
        let mut active = Vec::new();
        for i in self.rigid() {
            let pair = self.state.pairs[i];
            // What separates already is not struck: an impulse on its way out would give energy.
            if pair.gap <= closed_tolerance && pair.rate <= self.stick_velocity(i) {
                active.push(self.striking(i, false));
            }
        }
        self.fallback_law = self.solve_impact(size, &active)?;
        self.note_shared_blow(&active);
        let reached = std::mem::take(&mut self.reached);
        let passed = self.first_passage(&reached);
        self.reached = reached;
        if passed.is_some() {
            return Err(Failure::Passed);
        }
        let rates: Vec<f64> = active.iter().map(|c| self.state.pairs[c.pair].rate).collect();
        let rests: Vec<bool> = active
            .iter()
            .zip(&rates)
            .map(|(c, rate)| {
                let most = self.state.pairs[c.pair].approach_max.max(-rate);
                self.state.pairs[c.pair].approach_max = most;
                -rate <= self.stick_velocity(c.pair)
            })
            .collect();
        self.persistent.clear();
        self.persistent.extend(rests);
        self.accept(size, &active);
        self.weigh_struck(&active);
        self.persistent.clear();
        Ok(size)
    }
}

/// Where the gap first falls to zero, if it does before `end`.
fn descent(gap: &Cubic, end: f64) -> Option<f64> {
    let opened = || gap.stationary().find(|t| *t < end && gap.value(*t) > 0.0);
    let from = if gap.value(0.0) > 0.0 { 0.0 } else { opened()? };
    let (a, b) = (gap.value(from), gap.value(end));
    if b > 0.0 {
        return None;
    }
    let f = |t: f64| Ok::<f64, std::convert::Infallible>(gap.value(t));
    let guess = from + (end - from) * a / (a - b);
    match roots::bracketed((from, a), (end, b), guess, 1e-12 * end, 0.0, f) {
        Ok(t) => Some(t),
    }
}
