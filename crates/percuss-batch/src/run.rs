//! Steps ensembles to their ends: lanes whose run has ended take the next one.

use super::commit::Accept;
use super::engine::Engine;
use super::ledger::LaneLedger;
use super::log::Log;
use super::newton::LaneNewton;
use super::numbers::Numbers;
use super::paced::{LaneRun, Paced, rigid_guides};
use super::shape::{BatchShape, numbers};
use super::summary::{Fixed, Reading, Telling};
use percuss::Model;
use percuss::internals::run::decider::step_behind;
use percuss::internals::scalar::{Lanes, Mask, Number, in_lanes};
use percuss::internals::settings::Settings;
use percuss::{RunSummary, Termination};

/// Simulates those of the runs that ensembles know, and of which no more is asked than they tell; `None` for the others.
///
/// A run's summary is the same to the last bit whatever runs stand beside it. Runs in which an iteration fails are left to the
/// solver that cuts steps: `None`.
pub fn simulate_ensemble(runs: &[(&Model, &Settings)]) -> Vec<Option<RunSummary>> {
    let mut done: Vec<Option<RunSummary>> = runs.iter().map(|_| None).collect();
    let known = |(i, (model, settings)): (usize, &(&Model, &Settings))| {
        let faultless = settings.validate(model).is_empty();
        let numbers = lane_numbers(model, settings).ok().filter(|_| faultless)?;
        Some((i, BatchShape::of(&numbers), numbers))
    };
    let mut left: Vec<_> = runs.iter().enumerate().filter_map(known).collect();
    while let Some((_, shape, _)) = left.first() {
        let shape = shape.clone();
        let (group, others): (Vec<_>, Vec<_>) = left.into_iter().partition(|r| r.1 == shape);
        left = others;
        let group: Vec<LaneRun> = group
            .into_iter()
            .map(|(index, _, numbers)| LaneRun {
                index,
                model: runs[index].0,
                settings: runs[index].1,
                numbers,
            })
            .collect();
        let mut keep = |index: usize, summary| done[index] = summary;
        in_lanes(SideBySide { runs: &group, keep: &mut keep });
    }
    done
}

/// The numbers of a run that goes in a lane, or why it runs alone.
fn lane_numbers(model: &Model, settings: &Settings) -> Result<Numbers<f64>, &'static str> {
    let numbers = numbers(model, settings)?;
    match rigid_guides(&numbers).count() {
        0 | 1 => Ok(numbers),
        _ => Err("more than one rigid projectile"),
    }
}

/// What of a run keeps [`simulate_batch`](super::simulate_batch) from stepping it beside others under
/// [`Detail::Motion`](super::Detail::Motion), in words; none if nothing does.
pub fn runs_alone(model: &Model, settings: &Settings) -> Option<&'static str> {
    lane_numbers(model, settings).err()
}

/// Runs in lanes, compiled for each of the register widths that processors have.
struct SideBySide<'a, 'r> {
    /// The runs, shape (runs).
    runs: &'a [LaneRun<'r>],
    keep: &'a mut dyn FnMut(usize, Option<RunSummary>),
}

impl pulp::WithSimd for SideBySide<'_, '_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<P: pulp::Simd>(self, family: P) {
        let like = Lanes::new(family, 0.0);
        match rigid_guides(&self.runs[0].numbers).next() {
            None => Ensemble::of(self.runs, like).run(self.runs, self.keep),
            Some(guide) => Paced::of(self.runs, guide, like).run(self.runs, self.keep),
        }
    }
}

/// An ensemble in mid-flight.
struct Ensemble<S: Number> {
    engine: Engine<S>,
    ledger: LaneLedger<S>,
    log: Log<S>,
    search: LaneNewton<S>,
    /// The run in each lane and its steps done, shape (lanes) \[index of a run, number of steps\].
    lanes: Vec<Option<(usize, usize)>>,
    /// The first run that no lane has taken yet.
    next: usize,
}

impl<S: Number> Ensemble<S> {
    #[inline(always)]
    fn of(runs: &[LaneRun], like: S) -> Self {
        let numbers = runs[0].numbers.map(&mut |x| like.constant(x));
        let engine = Engine::new(numbers);
        Self {
            ledger: LaneLedger::open(&engine),
            log: Log::new(&engine),
            search: LaneNewton::idle(engine.h),
            lanes: vec![None; S::LANES],
            next: 0,
            engine,
        }
    }

    /// Runs all to their ends, handing over their summaries.
    #[inline(always)]
    fn run(mut self, runs: &[LaneRun], keep: &mut dyn FnMut(usize, Option<RunSummary>)) {
        (0..S::LANES).for_each(|lane| self.fill(lane, runs));
        while self.lanes.iter().any(Option::is_some) {
            self.set_steps(runs);
            self.log.begin(&self.engine);
            self.engine.solve(&self.ledger, &mut self.search);
            let (engine, ledger, log) = (&mut self.engine, &mut self.ledger, &mut self.log);
            Accept { engine, ledger, log, go: None }.accept();
            self.close_step(runs, keep);
        }
    }

    /// Puts the next run into a lane.
    fn fill(&mut self, lane: usize, runs: &[LaneRun]) {
        self.search.set_run(lane, self.next < runs.len());
        self.lanes[lane] = None;
        let Some(run) = runs.get(self.next) else { return };
        self.lanes[lane] = Some((self.next, 0));
        self.next += 1;
        let like = self.engine.h;
        let fresh = Engine::new(run.numbers.map(&mut |x| like.constant(x)));
        self.engine.set_lane(lane, &fresh, 0);
        self.ledger.set_lane(lane, &LaneLedger::open(&fresh), 0);
        self.log.reset(lane);
    }

    /// Gives every lane the size of its next step, of which the last one may be shorter, and the factors of its loads.
    #[inline(always)]
    fn set_steps(&mut self, runs: &[LaneRun]) {
        for lane in 0..S::LANES {
            let Some((run, steps)) = self.lanes[lane] else { continue };
            let settings = runs[run].settings;
            let left = self.engine.h.constant(step_behind(settings, steps));
            self.engine.h.set_lane(lane, left, lane);
            let (start, h) = (steps as f64 * settings.step, self.engine.h.lane(lane));
            for (factor, load) in self.engine.load_factors.iter_mut().zip(&runs[run].model.loads) {
                let mean = factor.constant(load.factor(start, h));
                factor.set_lane(lane, mean, lane);
            }
        }
        if !self.engine.load_factors.is_empty() {
            self.engine.apply_loads();
        }
    }

    /// Takes in the end of a step: runs that have ended or failed leave their lanes.
    #[inline(always)]
    fn close_step(&mut self, runs: &[LaneRun], keep: &mut dyn FnMut(usize, Option<RunSummary>)) {
        let lanes = &self.lanes;
        self.log.time = self.log.time.constants(|lane| {
            lanes[lane].map_or(0.0, |(run, steps)| runs[run].settings.instant(steps + 1))
        });
        for lane in 0..S::LANES {
            let Some((run, steps)) = &mut self.lanes[lane] else { continue };
            let own = &runs[*run];
            *steps += 1;
            let (steps, search) = (*steps, &self.search);
            // A fibre that fails is left to single runs.
            let failed = search.failed.lane(lane) || self.engine.fibres.failing.lane(lane);
            if failed {
                keep(own.index, None);
                self.fill(lane, runs);
            } else if steps == own.settings.step_count() {
                let telling = Telling {
                    model: own.model,
                    engine: &self.engine,
                    ledger: &self.ledger,
                    log: &self.log,
                    search: &self.search,
                    lane,
                    steps,
                    accumulated_steps: 0,
                    solver_steps: steps,
                    // The one at the start, too.
                    rows: 1 + steps.div_ceil(own.settings.record_every),
                    rigid: &|_, _| unreachable!("no rigid contacts"),
                    residual: 0.0,
                };
                let fixed = Fixed::all(own.model);
                let read = |x: S| x.lane(lane);
                let reading = Reading { read: &read, fixed: &fixed, derivative: false };
                let summary = telling.summary(Termination::Completed, &reading);
                keep(own.index, Some(summary));
                self.fill(lane, runs);
            }
        }
    }
}
