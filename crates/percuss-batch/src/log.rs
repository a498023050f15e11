//! Peaks of points and intervals of contacts for the summaries of an ensemble, resolved within the step.

mod guide;
mod path;
mod saved_records;

use super::engine::Engine;
use super::numbers::GuideLaw;
use super::yield_log::{self, YieldLog};
use guide::GuideLog;
use percuss::internals::contact::free_gap::FreeGap;
use percuss::internals::run::crest::Crest;
use percuss::internals::scalar::{Mask, Number};
use percuss::internals::step::contacts::IMPULSIVE;
use percuss::math::interpolant::Interpolant;
use saved_records::SavedRecords;

pub use guide::{Closed, Top};

/// The record of an ensemble.
#[derive(Clone, Debug)]
pub struct Log<S: Number> {
    /// Time at the start of the current step \[s\].
    pub time: S,
    /// Extremes of the recorded points, by component, shape (recorded points, 2).
    pub points: Vec<[Crest<S>; 2]>,
    /// Records of the guided projectiles, shape (guided projectiles).
    pub guides: Vec<GuideLog<S>>,
    /// Records of yielding, shape (spans with fibres).
    pub yields: Vec<YieldLog<S>>,
    /// Displacements and velocities of the recorded points at the start of the step, shape (recorded points, 2, 2) \[m, m/s\].
    point_start: Vec<[[S; 2]; 2]>,
    /// Gaps and their rates at the start of the step, shape (guided projectiles, 2) \[m, m/s\].
    gap_start: Vec<[S; 2]>,
    /// Lanes whose step is accepted.
    taken: S::Mask,
    /// Records of the other lanes, which are restored.
    saved: SavedRecords<S>,
}

impl<S: Number> Log<S> {
    /// Empty records.
    pub fn new(engine: &Engine<S>) -> Self {
        let zero = engine.h.constant(0.0);
        let top = Top { value: zero, time: zero };
        let guide = |_| GuideLog {
            open: Closed::none(zero),
            is_open: vec![false; S::LANES],
            closed: vec![Vec::new(); S::LANES],
            deepest: top,
            given: [zero; 3],
            free: zero,
            released: zero.less(zero),
            parted: FreeGap { gap: zero, rate: zero, acceleration: zero },
            parted_at: [zero; 2],
        };
        let (points, guides) = (engine.numbers.points.len(), engine.guides.len());
        Self {
            time: zero,
            points: vec![[Crest::new(zero, zero); 2]; points],
            guides: (0..guides).map(guide).collect(),
            yields: vec![YieldLog::none(zero); engine.yielding_spans()],
            point_start: vec![[[zero; 2]; 2]; points],
            gap_start: vec![[zero; 2]; guides],
            taken: zero.at_most(zero),
            saved: SavedRecords::default(),
        }
    }

    /// Begins a new run in a lane.
    pub fn reset(&mut self, lane: usize) {
        let zero = self.time.constant(0.0);
        let none = Closed::none(zero);
        self.time.set_lane(lane, zero, 0);
        for crest in self.points.as_flattened_mut() {
            crest.reset(lane, zero);
        }
        self.yields.iter_mut().for_each(|log| log.reset(lane));
        for log in &mut self.guides {
            log.open.set_lane(lane, &none, 0);
            log.is_open[lane] = false;
            log.closed[lane].clear();
            log.given.iter_mut().for_each(|given| given.set_lane(lane, zero, 0));
            log.free.set_lane(lane, zero, 0);
            let before = log.released;
            log.released = zero.mask(|i| i != lane && before.lane(i));
            log.deepest.value.set_lane(lane, zero, 0);
            log.deepest.time.set_lane(lane, zero, 0);
        }
    }

    /// Saves the records that the end of a step changes; only lanes of the mask `go` are updated.
    #[inline(always)]
    pub fn keep(&mut self, go: S::Mask) {
        self.taken = go;
        self.saved.save((&mut self.points, &mut self.guides, &mut self.yields));
    }

    /// Restores the saved records of all lanes except those of the mask `go`.
    #[inline(always)]
    pub fn restore(&mut self, go: S::Mask) {
        self.taken = go | !go;
        self.saved.restore((&mut self.points, &mut self.guides, &mut self.yields), go);
    }

    /// Records the start of a step.
    #[inline(always)]
    pub fn begin(&mut self, engine: &Engine<S>) {
        for (k, start) in self.point_start.iter_mut().enumerate() {
            *start = engine.point(k);
        }
        for (start, guide) in self.gap_start.iter_mut().zip(&engine.guides) {
            *start = [guide.gap, guide.rate];
        }
    }

    /// Records the end of the step.
    #[inline(always)]
    pub fn end(&mut self, engine: &Engine<S>) {
        let impulsive = engine.h.less(engine.numbers.step * IMPULSIVE);
        for (k, crests) in self.points.iter_mut().enumerate() {
            let ([u0, v0], [u1, v1]) = (self.point_start[k], engine.point(k));
            for c in 0..2 {
                let (h, from) = (engine.h, self.time);
                let path = Interpolant { h, start: [u0[c], v0[c]], end: [u1[c], v1[c]] };
                crests[c].take(&path, from, impulsive);
            }
        }
        if !self.yields.is_empty() {
            yield_log::note(engine, self.time + engine.h, &mut self.yields);
        }
        for (k, (log, state)) in self.guides.iter_mut().zip(&engine.guides).enumerate() {
            let push = state.force + state.impulse / engine.h;
            log.given[0] += engine.h * push;
            log.given[1] += push * state.increment;
            log.given[2] += push * engine.numbers.guides[k].along(&engine.increment);
        }
        for k in 0..self.guides.len() {
            if engine.numbers.guides[k].law != GuideLaw::Rigid {
                self.contact(engine, k, impulsive);
            }
        }
    }

    #[inline(always)]
    fn contact(&mut self, engine: &Engine<S>, k: usize, impulsive: S::Mask) {
        let (guide, state) = (&engine.numbers.guides[k], &engine.guides[k]);
        let zero = engine.h.constant(0.0);
        let (time, h) = (self.time, engine.h);
        let [gap_0, rate_0] = self.gap_start[k];
        let least = gap_0.if_less(state.gap, gap_0, state.gap);
        let log = &mut self.guides[k];
        let free = FreeGap { gap: gap_0, rate: rate_0, acceleration: log.free };
        log.open_throughout(self.taken, !least.less(zero), (state.rate - rate_0) / h);
        if !least.any_less(zero) {
            return;
        }
        let path = Interpolant { h, start: [-gap_0, -rate_0], end: [-state.gap, -state.rate] };
        for lane in 0..S::LANES {
            let (before, after) = (gap_0.lane(lane), state.gap.lane(lane));
            if self.taken.lane(lane) && !log.is_open[lane] && (before < 0.0 || after < 0.0) {
                log.is_open[lane] = true;
                let [opens, approach] = path::touch_down(&path, &free, lane);
                let mut new = Closed::none(zero);
                new.start = time + opens;
                new.approach = approach;
                new.changes[0] = free.acceleration * h;
                new.place = engine.struck_before(k, h - opens);
                log.open.set_lane(lane, &new, lane);
            }
        }
        let force = state.force;
        log.open.impulse += h * force;
        log.open.steps += zero.constant(1.0);
        log.open.given[0] += force * guide.along(&engine.increment);
        log.open.given[1] += -(force * state.increment);
        log.open.deepest.take(&path, time, impulsive);
        log.deepest.take(&path, time, impulsive);
        for lane in 0..S::LANES {
            if self.taken.lane(lane) && log.is_open[lane] && state.gap.lane(lane) >= 0.0 {
                let parted = FreeGap { gap: state.gap, rate: -state.rate, acceleration: zero };
                let mut done = log.open;
                let since = done.part(&parted, [time, h]);
                log.parted.gap.set_lane(lane, parted.gap, lane);
                log.parted.rate.set_lane(lane, parted.rate, lane);
                log.parted_at[0].set_lane(lane, time, lane);
                log.parted_at[1].set_lane(lane, h, lane);
                let released = log.released;
                log.released = zero.mask(|i| i == lane || released.lane(i));
                done.place_end = engine.struck_before(k, since);
                log.closed[lane].push(done);
                log.is_open[lane] = false;
                log.open.set_lane(lane, &Closed::none(zero), lane);
            }
        }
    }

    /// Projectiles with a minimum of the gap without contact in the step just solved, in the first lane: number, time, gap.
    pub fn passes<'a>(&'a self, engine: &'a Engine<S>) -> impl Iterator<Item = (usize, S, S)> + 'a {
        let each = self.gap_start.iter().zip(&engine.guides).enumerate();
        each.filter_map(|(k, (&[gap, rate], state))| {
            let open = gap.lane(0) > 0.0 && state.gap.lane(0) > 0.0;
            if !open || rate.lane(0) >= 0.0 || state.rate.lane(0) < 0.0 {
                return None;
            }
            let path =
                Interpolant { h: engine.h, start: [gap, rate], end: [state.gap, state.rate] };
            let own = path.lane(0);
            let least = own.stationary().min_by(|a, b| own.value(*a).total_cmp(&own.value(*b)));
            // The gap is stationary there: a shift of the instant with the parameters does not change it to first order.
            let t = engine.h.constant(least?);
            Some((k, self.time + t, path.value(t)))
        })
    }

    /// Contact intervals of a lane; the last one may not have ended.
    pub fn intervals(&self, engine: &Engine<S>, k: usize, lane: usize) -> Vec<Closed<S>> {
        let log = &self.guides[k];
        let mut all = log.closed[lane].clone();
        if log.is_open[lane] {
            let (guide, state) = (&engine.numbers.guides[k], &engine.guides[k]);
            let (stored, place_end) = (guide.energy(-state.gap), engine.struck(k));
            all.push(Closed { stored, place_end, ..log.open });
        }
        all
    }
}

impl<S: Number> Engine<S> {
    /// Place of the point that a projectile strikes \[m\].
    pub fn struck(&self, k: usize) -> [S; 2] {
        let guide = &self.numbers.guides[k];
        let u = guide.value(&self.displacement);
        [guide.struck[0] + u[0], guide.struck[1] + u[1]]
    }

    /// The same at a time `before` the end of the last step.
    pub fn struck_before(&self, k: usize, since: S) -> [S; 2] {
        let [now, moved] = [self.struck(k), self.numbers.guides[k].value(&self.increment)];
        let share = since / self.h;
        [now[0] - share * moved[0], now[1] - share * moved[1]]
    }
}
