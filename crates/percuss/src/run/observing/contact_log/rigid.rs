//! Contacts under rigid laws: simultaneous impacts are one impact, resting contact is one interval, for any number of pairs.

use super::{ContactLog, StepViews, opened, rate_of_rest};
use crate::run::solving::trial::{Separated, Trial};
use crate::step::contacts::Phase;
use crate::summary::{ContactInterval, ContactRecord, EnergySplit, Impact};

/// Impulse and motion of a pair in a step.
struct PairPart {
    contact: usize,
    pair: usize,
    phase: Phase,
    /// Impulses along normal and tangent, shape (2) \[N s\].
    impulse: [f64; 2],
    /// How far it slid \[m\].
    slip: f64,
    /// Work of friction, negative where it dissipates \[J\].
    friction_work: f64,
    /// Rates of the gap \[m/s\].
    before: f64,
    after: f64,
    energy: EnergySplit,
}

impl ContactLog {
    pub(super) fn rigid_contacts(&mut self, seen: StepViews<'_>, trial: &Trial) {
        for k in 0..trial.active.len() {
            let done = done(seen, trial, k);
            let rests = !matches!(done.phase, Phase::Impact { .. })
                || trial.persistent().get(k).is_some_and(|rests| *rests);
            let ContactRecord::Nonsmooth { impulse_total, impulse_resting, .. } =
                &mut self.records[done.contact]
            else {
                continue;
            };
            *impulse_total += done.impulse[0];
            if let Some(slides) = &mut self.slides[done.contact] {
                slides.take(self.part, done.impulse[0], done.slip, done.friction_work);
            }
            if rests {
                *impulse_resting += done.impulse[0];
                self.rest(seen, &done);
            } else if done.impulse[0] > 0.0 {
                self.strike(seen, trial.fallback_law, &done);
            }
        }
        self.end_rests(seen);
    }

    /// A pair that rests.
    fn rest(&mut self, seen: StepViews<'_>, done: &PairPart) {
        let (span, now) = (seen.span, self.part);
        let resting = &mut self.rests[done.contact];
        let ContactRecord::Nonsmooth { intervals, .. } = &mut self.records[done.contact] else {
            return;
        };
        let kept = intervals.len() < ContactRecord::IMPACTS_KEPT;
        if resting.interval.is_none() && done.impulse[0] > 0.0 && kept {
            resting.interval = Some(intervals.len());
            self.resting.push(done.contact);
            let approach = (-done.before).max(0.0);
            let opened = opened(span.start, approach, seen.place(done.pair, 1.0));
            intervals.push(ContactInterval { tangential_impulse: 0.0, ..opened });
        }
        let Some(open) = resting.interval else { return };
        let interval = &mut intervals[open];
        interval.impulse += done.impulse[0];
        interval.tangential_impulse += done.impulse[1];
        (0..2).for_each(|p| interval.energy.given[p] += done.energy.given[p]);
        interval.energy.lost += done.energy.lost;
        if done.impulse[0] + done.phase.carried()[0] > 0.0 {
            interval.steps += usize::from(resting.pressed != now && !span.impulsive);
            (resting.pressed, resting.pair, resting.torn) = (now, done.pair, false);
            interval.place_end = seen.place(done.pair, 0.0);
            return;
        }
        // No contact force since the step began; an impact interval is the end of the previous contact.
        let settles = matches!(done.phase, Phase::PlasticPostStep { .. });
        let end = match settles {
            true => [seen.state.time, done.after.max(0.0)],
            false => [span.start, rate_of_rest(done.before, done.after)],
        };
        if resting.ceased != now || end[1] < resting.end[1] {
            (resting.ceased, resting.end) = (now, end);
        }
    }

    /// Ends the intervals of contacts of which no pair presses any more.
    fn end_rests(&mut self, seen: StepViews<'_>) {
        let (now, rests, records) = (self.part, &mut self.rests, &mut self.records);
        self.resting.retain(|contact| {
            let resting = &mut rests[*contact];
            // Short parts of a step may omit resting contacts.
            if resting.pressed == now || (seen.span.impulsive && resting.ceased != now) {
                return true;
            }
            let [end, rate] = if resting.ceased == now {
                resting.end
            } else {
                [seen.span.start, seen.state.pairs[resting.pair].rate.max(0.0)]
            };
            let open = resting.interval.take();
            if let (ContactRecord::Nonsmooth { intervals, .. }, Some(open)) =
                (&mut records[*contact], open)
            {
                intervals[open].end = end;
                intervals[open].torn = resting.torn;
                intervals[open].separation_velocity = if resting.torn { f64::NAN } else { rate };
            }
            false
        });
    }

    /// Pairs that rested and that a fracture has separated: the interval ends there, if none of its contact presses any more.
    pub(super) fn tear_rests(&mut self, separated: &[Separated]) {
        for contact in &self.resting {
            let resting = &mut self.rests[*contact];
            resting.torn |= separated.iter().any(|one| one.pair == resting.pair);
        }
    }

    /// A pair that strikes; with others of its contact at the same instant it is one impact.
    fn strike(&mut self, seen: StepViews<'_>, fallback_law: bool, done: &PairPart) {
        let span = seen.span;
        let ContactRecord::Nonsmooth { impacts, impact_count, fallback_count, .. } =
            &mut self.records[done.contact]
        else {
            return;
        };
        // An instant is the middle of an impact interval, or the start of a step at which contacts are evaluated.
        let back = if span.impulsive { 0.5 } else { 1.0 };
        let another = std::mem::replace(&mut self.struck[done.contact], self.part) == self.part;
        let alone = Impact {
            time: span.start + (1.0 - back) * span.h,
            impulse: done.impulse[0],
            tangential_impulse: done.impulse[1],
            points: 1,
            approach_velocity: -done.before,
            separation_velocity: done.after,
            place: seen.place(done.pair, back),
            energy: done.energy,
            fallback_law,
        };
        if !another {
            *impact_count += 1;
            *fallback_count += usize::from(fallback_law);
            if impacts.len() < ContactRecord::IMPACTS_KEPT {
                impacts.push(alone);
            }
        } else if *impact_count == impacts.len()
            && let Some(impact) = impacts.last_mut()
        {
            impact.join(&alone);
        }
    }
}

impl Impact {
    /// Adds another point with an impact at the same instant.
    fn join(&mut self, other: &Self) {
        self.impulse += other.impulse;
        self.tangential_impulse += other.tangential_impulse;
        self.points += other.points;
        (0..2).for_each(|p| self.energy.given[p] += other.energy.given[p]);
        self.energy.lost += other.energy.lost;
        if other.approach_velocity > self.approach_velocity {
            self.approach_velocity = other.approach_velocity;
            self.separation_velocity = other.separation_velocity;
            self.place = other.place;
        }
    }
}

fn done(seen: StepViews<'_>, trial: &Trial, k: usize) -> PairPart {
    let (contact, found, h) = (&trial.active[k], &seen.work.rigid[k], seen.span.h);
    let pair = &seen.model.pairs[contact.pair];
    // The row on velocities: those before from the mean and those after.
    let after = found.normal.on(&seen.state.velocity);
    let before = 2.0 * found.normal.on(&seen.work.increment) / h - after;
    let mut energy = EnergySplit::default();
    let [normal, tangential] = found.impulse;
    let slip = found.tangent.on(&seen.work.increment);
    seen.add_energy(&mut energy, pair, &found.normal, normal / h);
    seen.add_energy(&mut energy, pair, &found.tangent, tangential / h);
    energy.lost = -energy.given[0] - energy.given[1];
    PairPart {
        contact: pair.contact,
        pair: contact.pair,
        phase: contact.phase,
        impulse: found.impulse,
        slip,
        friction_work: tangential / h * slip,
        before,
        after,
        energy,
    }
}
