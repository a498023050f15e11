//! Newton's iteration of the runs of an ensemble: each converges on its own, by the tests of a single run.

use super::books::Books;
use super::engine::Engine;
use crate::scalar::Number;
use crate::step::newton::{IMPULSE_TOLERANCE, MOST_IMPULSE, MOST_ITERATIONS};
use crate::step::watch::{WORK_TOLERANCE, Watch};

/// Factors of the tangent serve at most so many steps: masses dominate it, so it changes little, and renewing it costs as much as
/// two corrections.
const MOST_SERVICE: usize = 8;

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
    /// Impulse left unbalanced, relative to the momentum in play.
    impulse: f64,
    /// The size of the step that the tangent was factored for \[s\], the steps it has served, and those it may serve.
    factored_for: f64,
    served: usize,
    service: usize,
    /// Whether the tangent is to be factored anew.
    renew: bool,
    /// Size of the last step \[s\], and whether this one has the same.
    size: f64,
    steady: bool,
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
            impulse: 0.0,
            factored_for: f64::NAN,
            served: 0,
            service: MOST_SERVICE,
            renew: false,
            size: f64::NAN,
            steady: false,
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
        for (i, lane) in lanes.iter_mut().enumerate() {
            lane.begin(books.energy_scale.lane(i), self.h.lane(i), S::DERIVES);
        }
        self.predict(lanes);
        let reach = largest(&self.displacement);
        let momentum = {
            let play = (self.numbers.total_mass * books.energy_scale * 2.0).sqrt();
            play.max(books.linear_scale)
        };
        let (mut assemble, mut seen) = (lanes.iter().any(|l| l.renew), false);
        let mut corrections = 0;
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
            if !assemble && corrections > 0 {
                for lane in &mut *lanes {
                    lane.judge();
                }
                if lanes.iter().any(|l| l.renew) {
                    (assemble, seen) = (true, true);
                    continue;
                }
            }
            if assemble {
                self.renew(lanes);
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

    /// The increments if accelerations stay as they were in a step of the same size, or are zero.
    #[inline(always)]
    fn predict(&mut self, lanes: &[Search]) {
        let steady = self.h.constants(|i| f64::from(u8::from(lanes[i].steady)));
        for n in 0..self.increment.len() {
            for i in 0..4 {
                let free = self.h * self.velocity[n][i];
                self.increment[n][i] = free.add_product(steady, free - self.increment[n][i]);
            }
        }
        Self::project(&self.numbers.holds, &mut self.increment);
        for guide in &mut self.guides {
            let free = self.h * guide.velocity;
            guide.increment = free.add_product(steady, free - guide.increment);
        }
    }

    #[inline(always)]
    fn unbalanced(&self) -> Unbalanced<S> {
        let zero = self.h.constant(0.0);
        let (mut work, mut sum) = (zero, [zero; 2]);
        for n in 0..self.increment.len() {
            let (r, d) = (&self.residual[n], &self.increment[n]);
            for i in 0..4 {
                work += (r[i] * d[i]).abs();
            }
            for i in 0..2 {
                sum[i] += r[i];
            }
        }
        for k in 0..self.guides.len() {
            let (guide, state) = (&self.numbers.guides[k], &self.guides[k]);
            work += (state.residual * state.increment).abs();
            for i in 0..2 {
                sum[i] += state.residual * guide.direction[i];
            }
        }
        let impulse = self.h * (sum[0] * sum[0] + sum[1] * sum[1]).sqrt();
        Unbalanced { work, impulse }
    }

    /// Factors the tangent as assembled last, for the lanes that want it renewed; in the others the factors stay.
    #[inline(always)]
    fn renew(&mut self, lanes: &mut [Search]) {
        self.factor();
        let zero = self.h.constant(0.0);
        if lanes.iter().all(|l| l.renew || !l.live) {
            std::mem::swap(&mut self.factors, &mut self.tangent);
            self.guides.iter_mut().for_each(|g| g.factored = g.assembled);
        } else {
            let renew = zero.constants(|i| f64::from(u8::from(lanes[i].renew)));
            self.factors.take(&self.tangent, renew);
            for guide in &mut self.guides {
                for (mine, new) in guide.factored.iter_mut().zip(guide.assembled) {
                    *mine = zero.if_less(renew, new, *mine);
                }
            }
        }
        for (i, lane) in lanes.iter_mut().enumerate().filter(|(_, l)| l.renew) {
            lane.factorizations += 1;
            (lane.renew, lane.served, lane.factored_for) = (false, 0, self.h.lane(i));
        }
    }

    /// Takes the correction into the increments of the lanes that seek.
    #[inline(always)]
    fn take(&mut self, lanes: &mut [Search], reach: S, books: &Books<S>, first: bool) {
        let zero = self.h.constant(0.0);
        let seeking = zero.constants(|i| f64::from(u8::from(lanes[i].seeking)));
        let (mut work, mut size, mut step) = (zero, zero, zero);
        for n in 0..self.increment.len() {
            let (d, c, r) = (&mut self.increment[n], &self.correction[n], &self.residual[n]);
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
        std::mem::swap(&mut self.factors, &mut self.tangent);
        self.guides.iter_mut().for_each(|g| g.factored = g.assembled);
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
    /// Begins a step of size `h`.
    fn begin(&mut self, energy: f64, h: f64, derives: bool) {
        self.watch = Watch::new(energy);
        (self.seeking, self.failed) = (self.live, false);
        self.steady = self.size == h && !derives;
        self.size = h;
        self.served += 1;
        // Derivatives need the tangent at the solution anyway.
        let due = derives || self.served >= self.service;
        self.renew = self.live && (due || self.factored_for != h);
        if due {
            self.service = MOST_SERVICE.min(self.service + 1);
        }
    }

    /// Wants the tangent renewed if the iteration no longer contracts well.
    fn judge(&mut self) {
        self.renew = self.seeking && !self.watch.contracts();
        if self.renew {
            self.service = 1.max(self.service / 2);
        }
    }

    /// Looks at what is unbalanced: nothing, or nothing but round-off, and the lane is done. Without joints the work and the impulse
    /// left by a correction that contracted well are known from those before it, round-off apart.
    fn weigh(&mut self, work: f64, impulse: f64, corrections: usize) {
        self.watch.unbalanced(work);
        let impulse_left = std::mem::replace(&mut self.impulse, impulse) * self.watch.left_share();
        if !work.is_finite() {
            (self.seeking, self.failed) = (false, true);
        } else if corrections > 0 {
            let small = |most: f64| impulse <= most || impulse.is_nan();
            let enough = WORK_TOLERANCE * self.watch.energy;
            let exact = work <= enough && small(IMPULSE_TOLERANCE);
            let gone = self.watch.work_left() <= enough && impulse_left <= IMPULSE_TOLERANCE;
            if exact || (gone || self.watch.settled()) && small(MOST_IMPULSE) {
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
