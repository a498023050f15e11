//! What happens at contacts: intervals, impacts, forces, impulses, energies.

use super::monitor::Part;
use crate::contact::configuration::Configuration;
use crate::contact::free_gap::FreeGap;
use crate::contact::pair::Pair;
use crate::contact::row::Row;
use crate::contact::touch::{Reach, Touch};
use crate::math::hermite::Cubic;
use crate::math::roots;
use crate::model::frozen::ContactData;
use crate::model::{Model, SmoothLaw, TouchLaw};
use crate::settings::SAME_INSTANT;
use crate::state::{PairState, State};
use crate::step::contacts::{Phase, SmoothContact};
use crate::step::workspace::Workspace;
use crate::summary::{ContactInterval, ContactPlace, ContactRecord, EnergySplit, Impact, Peak};

/// The record of all contacts.
#[derive(Clone, Debug)]
pub struct ContactLog {
    /// One record a contact.
    pub records: Vec<ContactRecord>,
    /// Largest violation of the conditions of impulses, relative to the largest rate.
    pub residual: f64,
    /// Number of the open interval of each pair in its contact's record.
    open: Vec<Option<usize>>,
    /// Smooth and rigid pairs of the step at hand as they were at its start.
    before: Vec<PairState>,
    start: f64,
    /// What each smooth pair did in the last step in which it stood open.
    free: Vec<Free>,
    /// Intervals that ended in the step before.
    released: Vec<Released>,
}

/// An interval that has ended in a step, and what the gap was at its end.
#[derive(Clone, Copy, Debug)]
struct Released {
    pair: usize,
    /// Its number in the contact's record.
    interval: usize,
    gap: f64,
    rate: f64,
    span: Span,
}

/// The free motion of a gap.
#[derive(Clone, Copy, Debug)]
struct Free {
    /// Acceleration of the gap \[m/s^2\].
    acceleration: f64,
    /// Until when \[s\].
    until: f64,
}

/// Time and size of a step.
#[derive(Clone, Copy, Debug)]
struct Span {
    start: f64,
    h: f64,
    /// Whether it is as short as an impact, in which rates jump.
    brief: bool,
}

impl ContactLog {
    /// Nothing has happened yet.
    pub fn new(model: &Model, state: &State) -> Self {
        let record = |contact: &ContactData| match &contact.law {
            TouchLaw::Smooth(law) => {
                let each = state.pairs[contact.pairs.clone()].iter();
                let value = each.map(|p| law.potential.force(-p.gap)).fold(0.0, f64::max);
                let peak_force = Peak { value, time: state.time };
                ContactRecord::Smooth { peak_force, intervals: Vec::new() }
            }
            TouchLaw::Rigid(_) => ContactRecord::Nonsmooth {
                impacts: Vec::new(),
                impact_count: 0,
                tamed_count: 0,
                impulse_total: 0.0,
                intervals: Vec::new(),
                penetration: Peak { value: 0.0, time: state.time },
            },
        };
        Self {
            records: model.contacts.iter().map(record).collect(),
            residual: 0.0,
            open: vec![None; model.pairs.len()],
            before: Vec::new(),
            start: state.time,
            free: vec![Free { acceleration: 0.0, until: f64::NAN }; model.pairs.len()],
            released: Vec::new(),
        }
    }

    /// Notes the start of a step that stands solved in `work`: smooth contacts first, then what `active` names.
    pub fn begin_step(&mut self, state: &State, work: &Workspace) {
        self.start = state.time;
        self.before.clear();
        self.before.extend(work.smooth.iter().map(|c| state.pairs[c.pair]));
    }

    /// Takes in the end of the step.
    pub fn end_step(&mut self, model: &Model, state: &State, work: &Workspace, part: &Part) {
        let span = Span { start: self.start, h: part.h, brief: part.brief };
        for (k, contact) in work.smooth.iter().enumerate() {
            let law = &model.contacts[model.pairs[contact.pair].contact].law;
            if let TouchLaw::Smooth(law) = law {
                let before = self.before[k];
                self.smooth(model, state, work, law, contact, &before, span);
            }
        }
        if !part.active.is_empty() {
            self.residual = self.residual.max(work.impact_residual);
        }
        for k in 0..part.active.len() {
            self.rigid(model, state, work, part, k, span);
        }
        for &i in part.awake {
            let depth = -state.pairs[i].gap;
            if let ContactRecord::Nonsmooth { penetration, .. } =
                &mut self.records[model.pairs[i].contact]
                && depth > penetration.value
            {
                *penetration = Peak { value: depth, time: state.time };
            }
        }
    }

    #[expect(clippy::too_many_arguments, reason = "a step seen from all sides, in one place")]
    fn smooth(
        &mut self,
        model: &Model,
        state: &State,
        work: &Workspace,
        law: &SmoothLaw,
        contact: &SmoothContact,
        before: &PairState,
        span: Span,
    ) {
        let i = contact.pair;
        let (pair, after) = (&model.pairs[i], &state.pairs[i]);
        if before.gap >= 0.0 && after.gap >= 0.0 {
            return self.open_throughout(model, state, i, before.rate, span);
        }
        // What closes again at once has not flown freely over a step.
        self.take_released(i);
        let gap =
            Cubic { h: span.h, start: [before.gap, before.rate], end: [after.gap, after.rate] };
        let ContactRecord::Smooth { peak_force, intervals } = &mut self.records[pair.contact]
        else {
            return;
        };
        let mut highest = Peak { value: 0.0, time: f64::NAN };
        for t in moments(&gap, law.dissipation > 0.0) {
            let rate = -slope(&gap, t);
            let value =
                (law.potential.force(-gap.value(t)) * (1.0 + law.dissipation * rate)).max(0.0);
            if value > highest.value {
                highest = Peak { value, time: span.start + t };
            }
        }
        if highest.value > peak_force.value {
            *peak_force = highest;
        }
        if self.open[i].is_none() && intervals.len() < ContactRecord::IMPACTS_KEPT {
            let [opens, approach] = touch_down(&gap, self.free[i].before(span.start));
            self.open[i] = Some(intervals.len());
            intervals.push(opened(span.start + opens, approach, place(model, state, i)));
        }
        let Some(open) = self.open[i] else { return };
        let interval = &mut intervals[open];
        let force = contact.force.force;
        interval.impulse += span.h * force;
        if interval.peak_force.value.is_nan() || highest.value > interval.peak_force.value {
            interval.peak_force = highest;
        }
        let closing = -contact.row.on(&work.increment);
        let change = law.potential.energy(-after.gap) - law.potential.energy(-before.gap);
        add_energy(&mut interval.energy, model, pair, &contact.row, force, work);
        interval.energy.lost += contact.force.dissipated * closing;
        interval.energy.stored += change;
        interval.place_end = place(model, state, i);
        if after.gap >= 0.0 {
            let released =
                Released { pair: i, interval: open, gap: after.gap, rate: after.rate, span };
            released.tell(interval, 0.0);
            self.released.push(released);
            self.open[i] = None;
        }
    }

    /// A pair that stood open over a step: its free motion tells with what velocity it parted in the step before.
    fn open_throughout(&mut self, model: &Model, state: &State, i: usize, rate: f64, span: Span) {
        if span.brief {
            return;
        }
        // One that sleeps was looked at when the step began, not when it ended.
        let Some(seen) = touch(model, state, i, Reach::Near) else { return };
        let pair = &model.pairs[i];
        let row = pair.normal_row(&seen, &Configuration::of(&state.displacement));
        let acceleration = (row.on(&state.velocity) - rate) / span.h;
        self.free[i] = Free { acceleration, until: span.start + span.h };
        let Some(released) = self.take_released(i) else { return };
        if let ContactRecord::Smooth { intervals, .. } = &mut self.records[pair.contact] {
            released.tell(&mut intervals[released.interval], acceleration);
        }
    }

    /// The interval of pair `i` that ended in the step before.
    fn take_released(&mut self, i: usize) -> Option<Released> {
        let k = self.released.iter().position(|r| r.pair == i)?;
        Some(self.released.swap_remove(k))
    }

    fn rigid(
        &mut self,
        model: &Model,
        state: &State,
        work: &Workspace,
        part: &Part,
        k: usize,
        span: Span,
    ) {
        let (contact, found) = (&part.active[k], &work.rigid[k]);
        let i = contact.pair;
        let pair = &model.pairs[i];
        let ContactRecord::Nonsmooth {
            impacts,
            impact_count,
            tamed_count,
            impulse_total,
            intervals,
            ..
        } = &mut self.records[pair.contact]
        else {
            return;
        };
        let [normal, tangential] = found.impulse;
        // The row on velocities: before from the mean and what comes after.
        let mean = found.normal.on(&work.increment) / span.h;
        let after = found.normal.on(&state.velocity);
        let before = 2.0 * mean - after;
        let mut energy = EnergySplit::default();
        let h = span.h;
        add_energy(&mut energy, model, pair, &found.normal, normal / h, work);
        add_energy(&mut energy, model, pair, &found.tangent, tangential / h, work);
        energy.lost = -energy.given[0] - energy.given[1];
        *impulse_total += normal;
        let rests = !matches!(contact.phase, Phase::Impact { .. })
            || part.persistent.get(k).is_some_and(|rests| *rests);
        if rests {
            let open = self.open[i].is_some();
            if !open && normal > 0.0 && intervals.len() < ContactRecord::IMPACTS_KEPT {
                self.open[i] = Some(intervals.len());
                let opened = opened(span.start, -before, place(model, state, i));
                intervals.push(ContactInterval { tangential_impulse: 0.0, ..opened });
            }
            if let Some(open) = self.open[i] {
                let interval = &mut intervals[open];
                interval.impulse += normal;
                interval.tangential_impulse += tangential;
                (0..2).for_each(|p| interval.energy.given[p] += energy.given[p]);
                interval.energy.lost += energy.lost;
                interval.place_end = place(model, state, i);
                if normal + contact.phase.carried()[0] <= 0.0 {
                    // Nothing has pressed since the step began; a pulse is the end of what pressed before it.
                    let settles = matches!(contact.phase, Phase::Settling { .. });
                    let [end, rate] =
                        if settles { [state.time, after] } else { [span.start, before] };
                    interval.end = end;
                    interval.separation_velocity = rate;
                    self.open[i] = None;
                }
            }
        } else if normal > 0.0 {
            *impact_count += 1;
            *tamed_count += usize::from(part.tamed);
            if impacts.len() < ContactRecord::IMPACTS_KEPT {
                let time = if part.brief { span.start + 0.5 * h } else { span.start };
                impacts.push(Impact {
                    time,
                    impulse: normal,
                    tangential_impulse: tangential,
                    approach_velocity: -before,
                    separation_velocity: after,
                    place: place(model, state, i),
                    energy,
                    tamed: part.tamed,
                });
            }
        }
    }
}

impl Released {
    /// When it ended and with what velocity, the gap's motion since followed backwards with the acceleration of the step after.
    fn tell(&self, interval: &mut ContactInterval, acceleration: f64) {
        let back = FreeGap { gap: self.gap, rate: -self.rate, acceleration };
        let [since, rate] = back.closes(self.span.h);
        interval.end = self.span.start + (self.span.h - since);
        interval.separation_velocity = -rate;
    }
}

impl Free {
    /// The acceleration of the gap in a step that begins at `start`, if it was seen until then \[m/s^2\].
    fn before(&self, start: f64) -> f64 {
        if (start - self.until).abs() <= SAME_INSTANT * start.abs() {
            self.acceleration
        } else {
            0.0
        }
    }
}

/// Time from the start of the step at which a contact closes, and the velocity of approach.
fn touch_down(gap: &Cubic, acceleration: f64) -> [f64; 2] {
    if gap.start[0] >= 0.0 {
        let [g, rate] = gap.start;
        let [time, rate] = FreeGap { gap: g, rate, acceleration }.closes(gap.h);
        if rate < 0.0 {
            return [time, -rate];
        }
    }
    let time = crossing(gap);
    [time, -slope(gap, time)]
}

fn opened(start: f64, approach_velocity: f64, place: ContactPlace) -> ContactInterval {
    ContactInterval {
        start,
        end: f64::NAN,
        impulse: 0.0,
        tangential_impulse: f64::NAN,
        peak_force: Peak::default(),
        approach_velocity,
        separation_velocity: f64::NAN,
        place,
        place_end: place,
        energy: EnergySplit::default(),
    }
}

/// Adds the work of a force along a row on either party.
fn add_energy(
    energy: &mut EnergySplit,
    model: &Model,
    pair: &Pair,
    row: &Row,
    force: f64,
    work: &Workspace,
) {
    if force == 0.0 {
        return;
    }
    let source = model.nodes_of_mover(pair.movers[0]);
    let on_source = force * row.on_some(&work.increment, |n| source.contains(&n));
    energy.given[pair.source_party] += on_source;
    energy.given[1 - pair.source_party] += force * row.on(&work.increment) - on_source;
}

/// Pair `i` where the state stands.
pub fn touch(model: &Model, state: &State, i: usize, reach: Reach) -> Option<Touch> {
    let at = Configuration::of(&state.displacement);
    model.pairs[i].touch(model, &at, &state.pairs[i].memory, reach)
}

/// Arc length of a contact along its beam; of two beams, along the first one.
pub fn along(pair: &Pair, touch: &Touch) -> f64 {
    let on_source = pair.source_party == 0 && !pair.s.is_nan();
    if on_source || touch.s.is_nan() { pair.s } else { touch.s }
}

/// Where pair `i` is nearest.
fn place(model: &Model, state: &State, i: usize) -> ContactPlace {
    let Some(touch) = touch(model, state, i, Reach::Near) else {
        return ContactPlace::default();
    };
    let position = [0, 1].map(|i| touch.foot_place[i] + touch.radius * touch.normal[i]);
    ContactPlace { s: along(&model.pairs[i], &touch), position }
}

/// Instants at which the force of a contact may be largest.
fn moments(gap: &Cubic, dissipates: bool) -> impl Iterator<Item = f64> {
    let between = if dissipates { 16 } else { 0 };
    let h = gap.h;
    let inner = (1..between).map(move |k| h * f64::from(k) / 16.0);
    gap.stationary().chain(inner).chain([h])
}

/// Derivative of a cubic.
fn slope(gap: &Cubic, t: f64) -> f64 {
    let xi = t / gap.h;
    let rise = 6.0 * (xi - xi * xi) * (gap.end[0] - gap.start[0]) / gap.h;
    rise + (1.0 - 4.0 * xi + 3.0 * xi * xi) * gap.start[1] + (3.0 * xi * xi - 2.0 * xi) * gap.end[1]
}

/// The first instant within the step at which the gap changes sign.
fn crossing(gap: &Cubic) -> f64 {
    let opening = gap.start[0] < 0.0;
    let sign = if opening { -1.0 } else { 1.0 };
    let f = |t: f64| sign * gap.value(t);
    // If both ends have the same sign, the cubic dips between them: search up to the dip.
    let ends = [f(0.0), f(gap.h)];
    let until = if ends[1] > 0.0 {
        gap.stationary().find(|t| f(*t) <= 0.0).unwrap_or(gap.h)
    } else {
        gap.h
    };
    if ends[0] <= 0.0 {
        return 0.0;
    }
    let end = f(until);
    let guess = until * ends[0] / (ends[0] - end);
    let search = roots::bracketed((0.0, ends[0]), (until, end), guess, 0.0, 0.0, |t| {
        Ok::<f64, std::convert::Infallible>(f(t))
    });
    match search {
        Ok(t) => t,
    }
}
