//! Impact on several touching bodies: a sequence of impacts from body to body, or one simultaneous impact.
//!
//! In a sequence, of all touching contacts the one with the fastest approach has an impact of its own, in an impact interval of its own without
//! other contacts; bodies set in motion by it approach their neighbours, and so on, until no approach is faster than the sticking limit. Contacts
//! with equal approach share their interval: the motion gives no order among them, and symmetry is preserved. Each impact obeys the law of its
//! contact, including friction, and its work enters the balance as that of any other. A negligible rest, or a sequence that does not end, is
//! concluded by a simultaneous impact without restitution.

use super::decider::{Part, STICK};
use super::solver::Solving;
use super::trial::{PartKind, Sequence, Trial};
use crate::step::contacts::{ActiveContact, Phase};
use crate::step::newton::Failure;

/// Impacts in a sequence for each contact that touches: with restitution they die out like a geometric series.
const IMPACTS_EACH: usize = 64;
/// Limit of impacts in a sequence: together they take no longer than a thousandth of a step.
const MOST_IMPACTS: usize = 1000;
/// A contact whose velocity changes by less than this share of the change by its own impulse is not affected by an impact.
const COUPLED: f64 = 0.01;

impl Solving<'_> {
    /// The first impact of a sequence: that of the contact with the fastest approach. All contacts together if none rebounds.
    pub fn strike_fastest(&mut self, part: &Part) -> Result<Trial, Failure> {
        let members: Vec<usize> = part.active.iter().map(|c| c.pair).collect();
        let approach = |c: &ActiveContact| match c.phase {
            Phase::Impact { .. } => -self.state.pairs[c.pair].rate,
            Phase::Resting { .. } | Phase::PlasticPostStep { .. } => 0.0,
        };
        let fastest = part.active.iter().map(approach).fold(0.0, f64::max);
        let sequence = Sequence {
            interval: part.interval,
            least: STICK * fastest,
            left: MOST_IMPACTS.min(IMPACTS_EACH * members.len()),
            members,
        };
        let first = self.fastest(&sequence);
        if first.is_empty() {
            return self.strike(part);
        }
        match self.strike_alone(&first, sequence.clone())? {
            Some(trial) => Ok(trial),
            None => self.end_of_sequence(&sequence)?.ok_or(Failure::Impact),
        }
    }

    /// The next impact of a sequence, or its end; an approach that no impulses can end remains for the next part of the step.
    pub fn next_of(&mut self, sequence: Sequence) -> Option<Trial> {
        let fastest = if sequence.left > 0 { self.fastest(&sequence) } else { Vec::new() };
        let next = match fastest.is_empty() {
            true => None,
            false => self.strike_alone(&fastest, sequence.clone()).ok().flatten(),
        };
        next.or_else(|| self.end_of_sequence(&sequence).ok().flatten())
    }

    /// The contact with the fastest approach, if there is an approach, and those that are equally fast within the accuracy of rates.
    fn fastest(&self, sequence: &Sequence) -> Vec<usize> {
        let rate = |i: &usize| self.state.pairs[*i].rate;
        let approaches = |i: &usize| -rate(i) > self.stick_velocity(*i).max(sequence.least);
        let mut members: Vec<usize> = sequence.members.iter().copied().filter(approaches).collect();
        let fastest = members.iter().map(rate).fold(0.0, f64::min);
        let alike = self.nothing().rate;
        members.retain(|i| rate(i) <= fastest + alike);
        members
    }

    /// The impact of the contacts with the fastest approach, without any other contact; `None` if they are fixed on both sides.
    fn strike_alone(
        &mut self,
        fastest: &[usize],
        sequence: Sequence,
    ) -> Result<Option<Trial>, Failure> {
        let kind = PartKind::InSequence(Sequence { left: sequence.left - 1, ..sequence });
        let active = fastest.iter().map(|i| self.striking(*i, false)).collect();
        let trial = self.solve_impact(sequence.interval, active, kind)?;
        let struck = self.work.rigid.iter().any(|found| found.impulse[0] > 0.0);
        Ok(struck.then_some(trial))
    }

    /// The end of a sequence: remaining approaches are stopped by a plastic impact; `None` without any.
    fn end_of_sequence(&mut self, sequence: &Sequence) -> Result<Option<Trial>, Failure> {
        let slow = self.nothing().rate;
        let approaches = |i: &&usize| -self.state.pairs[**i].rate > slow;
        let left: Vec<usize> = sequence.members.iter().filter(approaches).copied().collect();
        if left.is_empty() {
            return Ok(None);
        }
        let mut active = self.resting();
        active.retain(|contact| !left.contains(&contact.pair));
        active.extend(left.iter().map(|i| self.striking(*i, true)));
        self.solve_impact(sequence.interval, active, PartKind::EndOfSequence).map(Some)
    }

    /// Two contacts of the impact solved last if bodies that touch shared it: if impulses elsewhere changed the velocity of one that
    /// bounces.
    pub(super) fn multiple_impact(&self, trial: &Trial) -> Option<[usize; 2]> {
        if !matches!(trial.kind, PartKind::Impact | PartKind::TimeStepping { .. }) {
            return None;
        }
        let active = &trial.active;
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
        all.clone().filter(|a| bounces(*a)).find_map(|a| {
            let other = all.clone().find(|b| shares(a, *b))?;
            Some([contact(a), contact(other)])
        })
    }
}
