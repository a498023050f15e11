//! Contacts under smooth laws: their resultant over all pairs.

use std::ops::Range;

use super::gap_over_step::{GapOverStep, highest};
use super::{ContactLog, Free, Released, StepViews, opened};
use crate::contact::free_gap::FreeGap;
use crate::geometry::touch::SearchRegion;
use crate::model::SmoothLaw;
use crate::settings::SAME_INSTANT;
use crate::state::PairState;
use crate::summary::{ContactInterval, ContactRecord, PressedIn};

/// The point that touches first.
struct FirstPoint {
    /// Time from the start of the step \[s\].
    after: f64,
    approach: f64,
    pair: usize,
    /// Change of its rate in a step \[m/s\].
    change: f64,
}

impl ContactLog {
    /// Pairs of one contact follow one another.
    pub(super) fn smooth_contacts(&mut self, seen: StepViews<'_>) {
        let (model, all) = (seen.model, &seen.work.smooth);
        let contact_of = |k: usize| model.pairs[all[k].pair].contact;
        let mut first = 0;
        while first < all.len() {
            let contact = contact_of(first);
            let end = (first..all.len()).find(|k| contact_of(*k) != contact).unwrap_or(all.len());
            if let Some(law) = model.contacts[contact].law.smooth() {
                self.smooth_contact(seen, law, contact, first..end);
            }
            first = end;
        }
    }

    /// Whether pair `k` of the current step was closed in it.
    fn pressed(&self, seen: StepViews<'_>, k: usize) -> bool {
        let contact = &seen.work.smooth[k];
        let after = seen.after(contact.pair);
        let gap = |seen_at: &PairState| seen.law(k).map_or(0.0, |law| law.free_gap(seen_at));
        gap(&seen.before[k]) < 0.0 || gap(after) < 0.0 || contact.force.force != 0.0
    }

    fn smooth_contact(
        &mut self,
        seen: StepViews<'_>,
        law: &SmoothLaw,
        contact: usize,
        pairs: Range<usize>,
    ) {
        if !pairs.clone().any(|k| self.pressed(seen, k)) {
            return pairs.for_each(|k| self.open_throughout(seen, k));
        }
        // A contact that closes again at once has no free motion over a step.
        if let Some(released) = self.take_released(|r| r.contact == contact) {
            self.tell(&released, f64::NAN);
        }
        let mut gaps = std::mem::take(&mut self.gaps);
        gaps.clear();
        let pressed = pairs.clone().filter(|k| self.pressed(seen, *k));
        gaps.extend(pressed.map(|k| self.gap_over_step(seen, law, k)));
        let peak = highest(&gaps, law, seen.span.start);
        self.gaps = gaps;
        self.note_depth(seen, contact, pairs.clone());
        if self.open[contact].is_none() {
            self.open_interval(seen, law, contact, pairs.clone());
        }
        let ContactRecord::Smooth { peak_force, intervals } = &mut self.records[contact] else {
            return;
        };
        if peak_force.value.is_nan() || peak.value > peak_force.value {
            *peak_force = peak;
        }
        let Some(open) = self.open[contact] else { return };
        let interval = &mut intervals[open];
        interval.steps += 1;
        if interval.peak_force.value.is_nan() || peak.value > interval.peak_force.value {
            interval.peak_force = peak;
        }
        add_work(interval, seen, law, pairs.clone());
        let gap = |k: &usize| law.free_gap(&seen.state.pairs[seen.work.smooth[*k].pair]);
        let deepest = pairs.clone().min_by(|a, b| gap(a).total_cmp(&gap(b)));
        match deepest.filter(|k| gap(k) < 0.0) {
            Some(deepest) => interval.place_end = seen.place(seen.work.smooth[deepest].pair, 0.0),
            None if seen.tears(law, pairs.clone()) => self.tear_interval(seen, contact, open),
            None => self.close_interval(seen, contact, open, pairs),
        }
    }

    /// Penetration of the pairs of a contact at the end of the step.
    fn note_depth(&mut self, seen: StepViews<'_>, contact: usize, pairs: Range<usize>) {
        let (model, end) = (seen.model, seen.span.start + seen.span.h);
        for k in pairs {
            let i = seen.work.smooth[k].pair;
            let now = PressedIn::of(model, i, seen.after(i), end);
            let most = &mut self.pressed[contact];
            if now.is_some_and(|now| most.is_none_or(|most| now.share() > most.share())) {
                *most = now;
            }
        }
    }

    fn gap_over_step(&self, seen: StepViews<'_>, law: &SmoothLaw, k: usize) -> GapOverStep {
        let after = seen.after(seen.work.smooth[k].pair);
        GapOverStep::new(seen.span.h, &seen.before[k], after, law)
    }

    /// Begins an interval with the point that touches first; of several at one instant, with the fastest.
    fn open_interval(
        &mut self,
        seen: StepViews<'_>,
        law: &SmoothLaw,
        contact: usize,
        pairs: Range<usize>,
    ) {
        let span = seen.span;
        let mut first: Option<FirstPoint> = None;
        for k in pairs.filter(|k| self.pressed(seen, *k)) {
            let pair = seen.work.smooth[k].pair;
            let acceleration = self.free[pair].before(span.start);
            let [after, approach] = self.gap_over_step(seen, law, k).touch_down(acceleration);
            let change = acceleration * span.h;
            let found = FirstPoint { after, approach, pair, change };
            let sooner = first.as_ref().is_none_or(|f| {
                found.after < f.after || (found.after == f.after && found.approach > f.approach)
            });
            if sooner {
                first = Some(found);
            }
        }
        let ContactRecord::Smooth { intervals, .. } = &mut self.records[contact] else { return };
        let Some(first) = first.filter(|_| intervals.len() < ContactRecord::IMPACTS_KEPT) else {
            return;
        };
        let place = seen.place(first.pair, 1.0 - first.after / span.h);
        self.open[contact] = Some(intervals.len());
        self.first[contact] = first.pair;
        let steady = first.change.abs() <= first.approach.abs();
        let interval = opened(span.start + first.after, first.approach, place);
        intervals.push(ContactInterval { steady, ..interval });
    }

    /// Ends an interval with the point that leaves last.
    fn close_interval(
        &mut self,
        seen: StepViews<'_>,
        contact: usize,
        interval: usize,
        pairs: Range<usize>,
    ) {
        let span = seen.span;
        self.open[contact] = None;
        let mut last: Option<(f64, Released)> = None;
        for k in pairs.filter(|k| self.pressed(seen, *k)) {
            let pair = seen.work.smooth[k].pair;
            let left = seen.after(pair);
            let (gap, rate) = (seen.law(k).map_or(left.gap, |law| law.free_gap(left)), left.rate);
            let released = Released { pair, contact, interval, gap, rate, span };
            let [since, _] = released.parted(0.0);
            if last.as_ref().is_none_or(|(least, _)| since < *least) {
                last = Some((since, released));
            }
        }
        let Some((since, released)) = last else { return };
        self.tell(&released, 0.0);
        self.released.push(released);
        let place_end = seen.place(released.pair, since / span.h);
        if let ContactRecord::Smooth { intervals, .. } = &mut self.records[contact] {
            intervals[interval].place_end = place_end;
            intervals[interval].one_point = self.first[contact] == released.pair;
        }
    }

    /// Ends an interval with the fracture of the touching part of a beam.
    fn tear_interval(&mut self, seen: StepViews<'_>, contact: usize, interval: usize) {
        self.open[contact] = None;
        if let ContactRecord::Smooth { intervals, .. } = &mut self.records[contact] {
            intervals[interval].end = seen.span.start + seen.span.h;
            intervals[interval].torn = true;
        }
    }

    /// A pair with an open gap over a step: its free motion gives the separation velocity in the previous step.
    fn open_throughout(&mut self, seen: StepViews<'_>, k: usize) {
        let span = seen.span;
        if span.impulsive {
            return;
        }
        let i = seen.work.smooth[k].pair;
        // The motion of a gap to another part of the beam does not continue the one before.
        if seen.separation(i).is_some() {
            self.free[i] = Free::default();
            self.take_released(|r| r.pair == i);
            return;
        }
        // A sleeping pair was evaluated at the start of the step, not at its end.
        let Some(touch) = super::touch(seen.model, seen.state, i, SearchRegion::Near) else {
            return;
        };
        let row = seen.model.pairs[i].normal_row(&touch, &seen.state.configuration());
        let acceleration = (row.on(&seen.state.velocity) - seen.before[k].rate) / span.h;
        self.free[i] = Free { acceleration, until: span.start + span.h };
        if let Some(released) = self.take_released(|r| r.pair == i) {
            self.tell(&released, acceleration);
        }
    }

    /// An interval that ended in the step before.
    fn take_released(&mut self, which: impl Fn(&Released) -> bool) -> Option<Released> {
        let k = self.released.iter().position(which)?;
        Some(self.released.swap_remove(k))
    }

    /// End of an interval and separation velocity, with the motion of the gap traced back with the acceleration of the next step; NaN without such
    /// a step, if the contact closed again within it.
    fn tell(&mut self, released: &Released, acceleration: f64) {
        let ContactRecord::Smooth { intervals, .. } = &mut self.records[released.contact] else {
            return;
        };
        let interval = &mut intervals[released.interval];
        let flown = if acceleration.is_nan() { 0.0 } else { acceleration };
        let [since, separation] = released.parted(flown);
        interval.end = released.span.start + (released.span.h - since);
        // A contact that has separated cannot have a velocity of approach.
        interval.separation_velocity = if separation >= 0.0 { separation } else { f64::NAN };
        let change = acceleration * released.span.h;
        interval.steady &= change.abs() <= separation;
    }
}

impl StepViews<'_> {
    /// Whether a fracture at the end of the step separated pairs that were closed then.
    fn tears(&self, law: &SmoothLaw, mut pairs: Range<usize>) -> bool {
        pairs.any(|k| {
            let separated = self.separation(self.work.smooth[k].pair);
            separated.is_some_and(|separated| law.free_gap(&separated.before) < 0.0)
        })
    }
}

impl Released {
    /// Time since it ended, and the velocity of separation then.
    fn parted(&self, acceleration: f64) -> [f64; 2] {
        let back = FreeGap { gap: self.gap, rate: -self.rate, acceleration };
        let [since, rate] = back.closes(self.span.h);
        [since, -rate]
    }
}

impl Free {
    /// The acceleration of the gap in a step that begins at `start`, if it was evaluated until then \[m/s^2\].
    fn before(&self, start: f64) -> f64 {
        if (start - self.until).abs() <= SAME_INSTANT * start.abs() {
            self.acceleration
        } else {
            0.0
        }
    }
}

/// Impulses and energies of the pairs of a contact over the step.
fn add_work(
    interval: &mut ContactInterval,
    seen: StepViews<'_>,
    law: &SmoothLaw,
    pairs: Range<usize>,
) {
    for (contact, before) in seen.work.smooth[pairs.clone()].iter().zip(&seen.before[pairs]) {
        let (pair, after) = (&seen.model.pairs[contact.pair], seen.after(contact.pair));
        let force = contact.force.force;
        interval.impulse += seen.span.h * force;
        seen.add_energy(&mut interval.energy, pair, &contact.row, force);
        interval.energy.lost -= contact.force.dissipated * contact.row.on(&seen.work.increment);
        let stored = |pair: &PairState| {
            if pair.gap < 0.0 { law.stored(-pair.gap, pair.deepest) } else { 0.0 }
        };
        // What a fracture at the end of the step leaves without a partner is lost.
        let torn = stored(after) - stored(&seen.state.pairs[contact.pair]);
        interval.energy.stored += stored(after) - stored(before) - torn;
        interval.energy.lost += torn;
        interval.energy.failure += torn;
    }
}
