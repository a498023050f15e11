//! Newton's iteration of the runs of an ensemble: each converges on its own, by the tests of a single run.

use super::band::Band;
use super::books::Books;
use super::engine::{Engine, GuideState};
use crate::scalar::{Number, array};
use crate::step::newton::{IMPULSE_TOLERANCE, MOST_IMPULSE, MOST_ITERATIONS};
use crate::step::watch::{WORK_TOLERANCE, Watch};

/// The iteration of one lane.
#[derive(Clone, Copy, Debug)]
pub struct Search {
    /// Whether there is a run in the lane.
    pub live: bool,
    /// Whether the step found no solution.
    pub failed: bool,
    /// Still to be corrected.
    seeking: bool,
    watch: Watch,
    /// Corrections and factorisations of the run so far.
    pub iterations: usize,
    pub factorizations: usize,
}

impl Search {
    /// A lane without a run.
    pub fn idle() -> Self {
        Self {
            live: false,
            failed: false,
            seeking: false,
            watch: Watch::new(0.0),
            iterations: 0,
            factorizations: 0,
        }
    }
}

/// What an increment leaves unbalanced.
struct Unbalanced<S> {
    /// Work over the step, all taken with the same sign \[J\].
    work: S,
    /// Impulse \[N s\].
    impulse: S,
}

impl<S: Number> Engine<S> {
    /// Finds the increments of the step at hand; lanes in which there is none are marked.
    #[inline(always)]
    pub fn solve(&mut self, books: &Books<S>, lanes: &mut [Search]) {
        self.predict();
        let reach = largest(&self.displacement);
        let momentum = {
            let play = (self.numbers.total_mass * books.energy_scale * 2.0).sqrt();
            play.max(books.linear_scale)
        };
        for (i, lane) in lanes.iter_mut().enumerate() {
            lane.watch = Watch::new(books.energy_scale.lane(i));
            (lane.seeking, lane.failed) = (lane.live, false);
        }
        let (mut assemble, mut seen) = (true, false);
        let mut corrections = 0;
        let mut kept = None;
        while corrections < MOST_ITERATIONS {
            if assemble {
                self.evaluate::<true>();
            } else {
                self.evaluate::<false>();
            }
            if !seen {
                let left = self.unbalanced();
                let share = left.impulse / momentum;
                for (i, lane) in lanes.iter_mut().enumerate().filter(|(_, l)| l.seeking) {
                    lane.weigh(left.work.lane(i), share.lane(i), corrections);
                }
                if lanes.iter().all(|l| !l.seeking) {
                    break;
                }
            }
            let stale = |l: &Search| l.seeking && corrections > 0 && !l.watch.contracts();
            if !assemble && lanes.iter().any(stale) {
                (assemble, seen) = (true, true);
                kept = Some((self.band.clone(), self.guides.clone()));
                continue;
            }
            if assemble {
                self.renew(lanes, kept.take(), stale);
            }
            self.correct_and_strike();
            corrections += 1;
            self.take(lanes, reach, books, corrections == 1);
            (assemble, seen) = (false, false);
        }
        lanes.iter_mut().filter(|l| l.seeking).for_each(|l| l.failed = true);
        if S::DERIVES {
            self.follow();
        }
    }

    #[inline(always)]
    fn correct_and_strike(&mut self) {
        self.correct();
        if let (1, Some(k)) = (S::LANES, self.striking) {
            self.strike(k);
        }
    }

    /// The increments if nothing accelerates.
    #[inline(always)]
    fn predict(&mut self) {
        for (d, v) in self.increment.iter_mut().zip(&self.velocity) {
            *d = array(|i| self.h * v[i]);
        }
        Self::project(&self.numbers.holds, &mut self.increment);
        for guide in &mut self.guides {
            guide.increment = self.h * guide.velocity;
        }
    }

    #[inline(always)]
    fn unbalanced(&mut self) -> Unbalanced<S> {
        let zero = self.h.constant(0.0);
        self.correction.copy_from_slice(&self.residual);
        Self::project(&self.numbers.holds, &mut self.correction);
        let (mut work, mut sum) = (zero, [zero; 2]);
        for (r, d) in self.correction.iter().zip(&self.increment) {
            for i in 0..4 {
                work += (r[i] * d[i]).abs();
            }
            for i in 0..2 {
                sum[i] += r[i];
            }
        }
        for (guide, state) in self.numbers.guides.iter().zip(&self.guides) {
            work += (state.residual * state.increment).abs();
            for i in 0..2 {
                sum[i] += state.residual * guide.direction[i];
            }
        }
        let impulse = self.h * (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
        Unbalanced { work, impulse }
    }

    /// Factors the tangent; in lanes that still converge well with the factors kept, these stay.
    #[inline(always)]
    fn renew(
        &mut self,
        lanes: &mut [Search],
        kept: Option<(Band<S>, Vec<GuideState<S>>)>,
        stale: impl Fn(&Search) -> bool,
    ) {
        self.factor();
        for (i, lane) in lanes.iter_mut().enumerate() {
            let renewed = kept.is_none() || stale(lane);
            lane.factorizations += usize::from(renewed && lane.live);
            if let (false, Some((band, guides))) = (renewed, &kept) {
                self.band.set_lane(i, band);
                for (mine, old) in self.guides.iter_mut().zip(guides) {
                    mine.factored_slope.set_lane(i, old.factored_slope, i);
                    mine.factored_inertia.set_lane(i, old.factored_inertia, i);
                }
            }
        }
    }

    /// Takes the correction into the increments of the lanes that seek.
    #[inline(always)]
    fn take(&mut self, lanes: &mut [Search], reach: S, books: &Books<S>, first: bool) {
        let zero = self.h.constant(0.0);
        let seeking = zero.constants(|i| f64::from(u8::from(lanes[i].seeking)));
        let (mut work, mut size, mut step) = (zero, zero, zero);
        for ((d, c), r) in self.increment.iter_mut().zip(&self.correction).zip(&self.residual) {
            for i in 0..4 {
                work += (c[i] * r[i]).abs();
                size = size.max(c[i].abs());
                d[i] += zero.if_less(seeking, c[i], zero);
                step = step.max(d[i].abs());
            }
        }
        let mut force = zero;
        for guide in &mut self.guides {
            work += (guide.correction * guide.residual).abs();
            size = size.max(guide.correction.abs());
            guide.increment += zero.if_less(seeking, guide.correction, zero);
            step = step.max(guide.increment.abs());
            force += guide.force + guide.impulse;
        }
        for (i, lane) in lanes.iter_mut().enumerate().filter(|(_, l)| l.seeking) {
            lane.iterations += 1;
            let work = work.lane(i);
            if first {
                let scale = books.energy_scale.lane(i);
                lane.watch.play(if scale > 0.0 { scale } else { work });
            }
            let places = if force.lane(i) > 0.0 { self.numbers.size.lane(i) } else { 0.0 };
            lane.watch.corrected(size.lane(i), reach.lane(i), step.lane(i), work, places);
        }
    }

    /// Derivatives follow the values with the tangent at the solution: one linear step.
    fn follow(&mut self) {
        self.evaluate::<true>();
        self.factor();
        self.correct_and_strike();
        for (d, c) in self.increment.iter_mut().zip(&self.correction) {
            (0..4).for_each(|i| d[i] += c[i]);
        }
        for guide in &mut self.guides {
            guide.increment += guide.correction;
        }
        self.evaluate::<false>();
    }
}

impl Search {
    /// Looks at what is unbalanced: nothing, or nothing but round-off, and the lane is done.
    fn weigh(&mut self, work: f64, impulse: f64, corrections: usize) {
        self.watch.unbalanced(work);
        if !work.is_finite() {
            (self.seeking, self.failed) = (false, true);
        } else if corrections > 0 {
            let small = |most: f64| impulse <= most || impulse.is_nan();
            let exact = work <= WORK_TOLERANCE * self.watch.energy && small(IMPULSE_TOLERANCE);
            if exact || self.watch.settled() && small(MOST_IMPULSE) {
                self.seeking = false;
            }
        }
    }
}

/// The largest component.
#[inline(always)]
fn largest<S: Number>(nodal: &[[S; 4]]) -> S {
    let mut most = nodal[0][0].constant(0.0);
    for x in nodal {
        for i in 0..4 {
            most = most.max(x[i].abs());
        }
    }
    most
}
