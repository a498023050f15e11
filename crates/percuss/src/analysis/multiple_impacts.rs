//! Several touching bodies struck at one instant: the blow passed on from body to body, or shared by the impact law.
//!
//! One after another: of all contacts that touch, the one that approaches fastest has an impact of its own, in an impact interval of its own
//! in which no other contact acts; what that sets in motion approaches its neighbours, and so on, until nothing approaches faster
//! than what sticks. Each impact obeys the law of its contact, friction included, and its work enters the balance as that of any other.
//! What is left, next to nothing, or a sequence that does not end, is settled at once and without restitution.

use super::impacts::{Advance, STICK};
use super::simulation::Simulation;
use crate::analysis::record::Recorder;
use crate::error::Error;
use crate::step::contacts::{ActiveContact, Phase};
use crate::step::newton::Failure;

/// Impacts in a sequence for each contact that touches: with restitution they die out like a geometric series.
const IMPACTS_EACH: usize = 64;
/// Impacts in a sequence: together they take no longer than a thousandth of a step.
const MOST_IMPACTS: usize = 1000;
/// What changes the velocity of a contact by less than this share of its own impulse's is no part of its blow.
const COUPLED: f64 = 0.01;

impl Simulation<'_> {
    /// Impacts one after another, in impact intervals of their own.
    pub(super) fn impacts_in_sequence(
        &mut self,
        touching: &[usize],
        advance: &mut Advance,
        recorder: &mut dyn Recorder,
    ) -> Result<Result<f64, Failure>, Error> {
        let interval = self.impact_interval() * advance.share;
        let resting = self.resting();
        let mut members: Vec<usize> = resting.iter().map(|c| c.pair).collect();
        members.extend_from_slice(touching);
        let blow = touching.iter().map(|i| -self.state.pairs[*i].rate).fold(0.0, f64::max);
        if self.fastest(&members, STICK * blow).is_none() {
            return self.impact(touching, advance, recorder); // all of them stick
        }
        let mut done = 0.0;
        let most = MOST_IMPACTS.min(IMPACTS_EACH * members.len());
        for _ in 0..most {
            let Some(i) = self.fastest(&members, STICK * blow) else { break };
            let pair = &mut self.state.pairs[i];
            pair.closed = false;
            pair.approach_max = pair.approach_max.max(-pair.rate);
            let active = [self.striking(i, false)];
            let fallback_law = match self.solve_impact(interval, &active) {
                Ok(fallback_law) => fallback_law,
                Err(failure) if done == 0.0 => return Ok(Err(failure)),
                Err(_) => break,
            };
            if self.work.rigid[0].impulse[0] <= 0.0 {
                break; // held on both sides
            }
            if done == 0.0 {
                self.record(recorder)?;
            }
            self.accept_impact(interval, &active, fallback_law);
            done += interval;
        }
        advance.events_left = advance.events_left.saturating_sub(1);
        match self.plastic_remainder(&members, interval) {
            Ok(settled) => done += settled,
            Err(failure) if done == 0.0 => return Ok(Err(failure)),
            Err(_) => {} // the next part of the step finds them as they are
        }
        self.record(recorder)?;
        Ok(Ok(done))
    }

    /// The contact that approaches fastest, if that is an approach; the first one of several that are equally fast.
    fn fastest(&self, members: &[usize], least: f64) -> Option<usize> {
        let rate = |i: &usize| self.state.pairs[*i].rate;
        let approaches = |i: &&usize| -rate(i) > self.stick_velocity(**i).max(least);
        members.iter().filter(approaches).min_by(|a, b| rate(a).total_cmp(&rate(b))).copied()
    }

    /// The end of a sequence: what still approaches comes to rest against what it touches; returns the time that takes.
    fn plastic_remainder(&mut self, members: &[usize], interval: f64) -> Result<f64, Failure> {
        let slow = self.no_approach();
        let approaches = |i: &&usize| -self.state.pairs[**i].rate > slow;
        let left: Vec<usize> = members.iter().filter(approaches).copied().collect();
        if left.is_empty() {
            return Ok(0.0);
        }
        let mut active = self.resting();
        active.retain(|contact| !left.contains(&contact.pair));
        active.extend(left.iter().map(|i| self.striking(*i, true)));
        let fallback_law = self.solve_impact(interval, &active)?;
        self.accept_impact(interval, &active, fallback_law);
        Ok(interval)
    }

    /// Counts the impact solved last if bodies that touch shared it: if impulses elsewhere changed the velocity of a contact that
    /// bounces.
    pub(super) fn note_shared_blow(&mut self, active: &[ActiveContact]) {
        let (problem, m) = (&self.work.impact, 2 * active.len());
        let impulse = |a: usize| self.work.rigid[a].impulse[0];
        let contact = |a: usize| self.model.pairs[active[a].pair].contact;
        let bounces = |a: usize| match active[a].phase {
            Phase::Impact { restitution, .. } => {
                let fast =
                    self.state.pairs[active[a].pair].rate < -self.stick_velocity(active[a].pair);
                restitution > 0.0 && impulse(a) > 0.0 && fast
            }
            Phase::Resting { .. } | Phase::PlasticPostStep { .. } => false,
        };
        let mobility = |a: usize, b: usize| problem.delassus[2 * b * m + 2 * a];
        let shares = |a: usize, b: usize| {
            let (own, other) = (mobility(a, a) * impulse(a), mobility(a, b) * impulse(b));
            contact(a) != contact(b) && other.abs() > COUPLED * own
        };
        let all = 0..active.len();
        let pair = all.clone().filter(|a| bounces(*a)).find_map(|a| {
            let other = all.clone().find(|b| shares(a, *b))?;
            Some([contact(a), contact(other)])
        });
        let Some(contacts) = pair else { return };
        let shared = &mut self.shared_blows;
        if shared.count == 0 {
            (shared.first, shared.contacts) = (self.state.time, contacts);
        }
        shared.count += 1;
    }
}
