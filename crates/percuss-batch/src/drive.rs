//! Steps the runs of a shape in lanes: each lane advances by its own parts of steps, and is filled with the next run when its run has ended.

use super::commit::Accept;
use super::detail::Detail;
use super::engine::Engine;
use super::impact::Press;
use super::lane::{Lane, LaneRun};
use super::ledger::LaneLedger;
use super::log::Log;
use super::newton::LaneNewton;
use super::numbers::{GuideLaw, Numbers};
use super::saved_lanes::SavedLanes;
use super::sections::Sections;
use super::summary::{Fixed, Reading, SummaryInput};
use percuss::internals::contact::impact::gives_energy;
use percuss::internals::run::locate::Seen;
use percuss::internals::scalar::{Mask, Number};
use percuss::internals::step::contacts::IMPULSIVE;
use percuss::{RunSummary, Termination};

/// Gap, rate and impulse of the rigid contact in all lanes.
struct Views<S> {
    /// Gap and its rate at the start of the part, shape (2) \[m, m/s\].
    start: [S; 2],
    /// The same at its end, shape (2) \[m, m/s\].
    end: [S; 2],
    /// Impulse \[N s\], and its work \[J\].
    impulse: S,
    work: S,
}

/// Runs of one shape in lanes.
pub struct LaneDriver<'a, S: Number> {
    /// The runs, shape (runs).
    runs: &'a [LaneRun<'a>],
    engine: Engine<S>,
    ledger: LaneLedger<S>,
    log: Log<S>,
    search: LaneNewton<S>,
    saved: SavedLanes<S>,
    /// Section forces, if they are requested.
    sections: Option<Sections<'a, S>>,
    /// Number of the rigid projectile, if there is one \[index of a projectile\].
    guide: Option<usize>,
    /// The run in each lane, shape (lanes).
    lanes: Vec<Option<Lane>>,
    /// Number of the next run, which is in no lane yet.
    next: usize,
}

/// The rigid projectiles of a run, shape (rigid projectiles) \[index of a projectile\].
pub fn rigid_guides<S>(numbers: &Numbers<S>) -> impl Iterator<Item = usize> {
    let all = numbers.guides.iter().enumerate();
    all.filter(|(_, guide)| guide.law == GuideLaw::Rigid).map(|(k, _)| k)
}

impl<'a, S: Number> LaneDriver<'a, S> {
    /// A driver for runs of one shape with at most one rigid projectile.
    #[inline(always)]
    pub fn of(runs: &'a [LaneRun<'a>], detail: Detail, like: S) -> Self {
        let mut engine = Engine::new(runs[0].numbers.map(&mut |x| like.constant(x)));
        let guide = rigid_guides(&engine.numbers).next();
        engine.press = guide.map(|guide| Press::new(&engine.numbers, guide));
        let mut search = LaneNewton::idle(engine.h);
        search.by_parts = guide.is_some();
        Self {
            runs,
            sections: Sections::of(&engine, runs[0].model, detail),
            ledger: LaneLedger::open(&engine),
            saved: SavedLanes(Vec::new()),
            log: Log::new(&engine),
            lanes: (0..S::LANES).map(|_| None).collect(),
            next: 0,
            search,
            guide,
            engine,
        }
    }

    /// Steps all runs to their ends and passes their summaries to `keep`.
    #[inline(always)]
    pub fn run(mut self, keep: &mut dyn FnMut(usize, Option<RunSummary>)) {
        (0..S::LANES).for_each(|lane| self.fill(lane));
        while self.lanes.iter().any(Option::is_some) {
            self.set_parts();
            self.log.begin(&self.engine);
            self.engine.solve(&self.ledger, &mut self.search);
            let seen = self.views();
            let go = self.judge(seen.as_ref());
            self.go_on(go);
            self.close_parts(seen.as_ref(), go, keep);
        }
    }

    /// Puts the next run into a lane.
    fn fill(&mut self, number: usize) {
        self.search.set_run(number, self.next < self.runs.len());
        self.lanes[number] = None;
        let Some(run) = self.runs.get(self.next) else { return };
        let like = self.engine.h;
        let mut fresh = Engine::new(run.numbers.map(&mut |x| like.constant(x)));
        self.engine.set_lane(number, &mut fresh);
        self.ledger.set_lane(number, &LaneLedger::open(&fresh), 0);
        self.log.reset(number);
        if let Some(sections) = &mut self.sections {
            sections.begin(number, run.model);
        }
        let mut lane = Lane::new(self.next, run, self.guide);
        let nothing = lane.nothing(&self.ledger, number);
        let gap = self.gap_and_rate(number);
        lane.progress.close_at_rest(gap.into_iter(), nothing);
        lane.progress.begin(gap.into_iter(), nothing);
        self.lanes[number] = Some(lane);
        self.next += 1;
    }

    /// Gap of the rigid contact of a lane and its rate, if there is one, shape (2) \[m, m/s\].
    #[inline(always)]
    fn gap_and_rate(&self, number: usize) -> Option<[f64; 2]> {
        let state = &self.engine.guides[self.guide?];
        Some([state.gap.lane(number), state.rate.lane(number)])
    }

    /// Sets the current part of every lane: its size, the bound of its contact, the factors of its loads.
    #[inline(always)]
    fn set_parts(&mut self) {
        let (lanes, h) = (&self.lanes, self.engine.h);
        let of = |lane: usize, read: &dyn Fn(&Lane) -> f64, none: f64| {
            lanes[lane].as_ref().map_or(none, read)
        };
        self.engine.h = h.constants(|i| of(i, &|lane| lane.progress.h(), h.lane(i)));
        self.log.time = h.constants(|i| of(i, &|lane| lane.progress.time, 0.0));
        if let (Some(press), Some(guide)) = (&mut self.engine.press, self.guide) {
            let rate = self.engine.guides[guide].rate;
            self.search.ahead = h.constants(|i| of(i, &|lane| lane.ahead(), 0.0));
            self.search.trusted = h.constants(|i| of(i, &|lane| lane.trusted(), 0.0));
            let strikes = |lane: &Lane| lane.progress.is_impact();
            self.engine.constraints.impulsive = h.mask(|i| lanes[i].as_ref().is_some_and(strikes));
            let bound = |i: usize| lanes[i].as_ref().and_then(|lane| lane.bound(rate.lane(i)));
            press.bound = h.constants(|i| bound(i).unwrap_or(0.0));
            press.which = h.mask(|i| bound(i).is_some());
        }
        if self.engine.load_factors.is_empty() {
            return;
        }
        for (k, factor) in self.engine.load_factors.iter_mut().enumerate() {
            *factor = h.constants(|i| {
                let load = |lane: &Lane| &self.runs[lane.run].model.loads[k];
                of(i, &|lane| load(lane).factor(lane.progress.time, lane.progress.h()), 0.0)
            });
        }
        self.engine.apply_loads();
    }

    /// Gap, rate and impulse of the rigid contact, if there is one.
    #[inline(always)]
    fn views(&self) -> Option<Views<S>> {
        let guide = self.guide?;
        let state = &self.engine.guides[guide];
        Some(Views {
            start: [state.gap, state.rate],
            end: self.engine.gap_next(guide),
            impulse: state.impulse,
            work: state.impulse * state.gap_change / self.engine.h,
        })
    }

    /// Lanes whose part is accepted.
    #[inline(always)]
    fn judge(&mut self, seen: Option<&Views<S>>) -> S::Mask {
        let mut go = [false; 64];
        for (number, go) in go.iter_mut().enumerate().take(S::LANES) {
            let Some(lane) = &mut self.lanes[number] else { continue };
            let own = seen.map(|seen| seen.lane(number));
            *go = lane.judge(own.as_slice(), self.search.failed.lane(number));
        }
        self.engine.h.mask(|lane| go[lane])
    }

    /// Moves the lanes of the mask `go` to the end of their parts. The state of lanes whose run has ended or failed is not used again.
    #[inline(always)]
    fn go_on(&mut self, go: S::Mask) {
        let lanes = &self.lanes;
        let idle = self.search.failed | self.engine.h.mask(|lane| lanes[lane].is_none());
        let go = if (!(go | idle)).any() { Some(go) } else { None };
        if go.is_some() {
            self.saved.save(&mut self.engine, &mut self.ledger);
        }
        let (engine, ledger, log) = (&mut self.engine, &mut self.ledger, &mut self.log);
        let sections = self.sections.as_mut();
        Accept { engine, ledger, log, sections, go }.accept();
        if let Some(go) = go {
            self.saved.restore(&mut self.engine, &mut self.ledger, go);
        }
    }

    /// Concludes the parts of the lanes of the mask `go`: runs that have ended leave their lanes, and runs with an event that lanes do not support
    /// are repeated as single runs.
    #[inline(always)]
    fn close_parts(
        &mut self,
        seen: Option<&Views<S>>,
        go: S::Mask,
        keep: &mut dyn FnMut(usize, Option<RunSummary>),
    ) {
        for number in 0..S::LANES {
            let Some(mut lane) = self.lanes[number].take() else { continue };
            let index = self.runs[lane.run].index;
            let gone = go.lane(number);
            // Failing fibres are computed in single runs.
            let fails = gone && self.engine.fibres.failing.lane(number);
            let failed = self.search.failed.lane(number) || fails;
            if failed || gone && !self.advance(&mut lane, number, seen) {
                keep(index, None);
                self.fill(number);
            } else if gone && lane.progress.is_over() {
                keep(index, Some(self.summary(&lane, number)));
                self.fill(number);
            } else {
                self.lanes[number] = Some(lane);
            }
        }
    }

    /// Accepts the part of a lane and begins the next one; `false` where a single run would continue differently.
    #[inline(always)]
    fn advance(&self, lane: &mut Lane, number: usize, seen: Option<&Views<S>>) -> bool {
        let gap = self.gap_and_rate(number);
        let (mut now, mut impulse) = (None, None);
        if let (Some(seen), Some(end)) = (seen, gap) {
            if !self.note(lane, number, seen) {
                return false;
            }
            now = Some(Seen { end, ..seen.lane(number) });
            impulse = Some(seen.impulse.lane(number));
        }
        let nothing = lane.nothing(&self.ledger, number);
        lane.progress.accept(now.as_slice(), impulse.as_slice(), nothing);
        if let Some([gap, _]) = gap {
            lane.rigid.see(gap, lane.progress.time);
        }
        if lane.progress.has_accumulated() {
            return false;
        }
        lane.progress.begin(gap.into_iter(), nothing);
        true
    }

    /// Records the rigid contact of a lane in its part; `false` where Moreau's law replaces the law of the contact.
    #[inline(always)]
    fn note(&self, lane: &mut Lane, number: usize, seen: &Views<S>) -> bool {
        let (own, impulse) = (seen.lane(number), seen.impulse.lane(number));
        let work = seen.work.lane(number);
        if lane.progress.is_impact() && gives_energy(work, [(impulse, own.start[1])]) {
            return false;
        }
        let contact = lane.progress.contacts[0];
        if let Some(press) = &self.engine.press
            && contact.phase.is_some()
            && (impulse > 0.0 || contact.rests())
        {
            let part = self.engine.part(press.guide, seen.start[1]).lane(number);
            let impulsive = part.h < IMPULSIVE * self.engine.numbers.step.lane(number);
            lane.rigid.take(&part, lane.progress.time, contact.rests(), impulsive);
            lane.weigh(&part, press.opening.lane(number), press.bound.lane(number));
        }
        true
    }

    fn summary(&mut self, lane: &Lane, number: usize) -> RunSummary {
        let end = self.engine.h.constant(lane.progress.time);
        self.log.time.set_lane(number, end, number);
        let own = &self.runs[lane.run];
        let input = SummaryInput {
            model: own.model,
            engine: &self.engine,
            ledger: &self.ledger,
            log: &self.log,
            search: &self.search,
            lane: number,
            steps: lane.progress.steps,
            accumulated_steps: 0,
            solver_steps: lane.progress.solver_steps,
            rows: lane.progress.rows,
            rigid: &|k, reading| lane.rigid.record(reading.fixed[k].s, &|x| x, false),
            residual: lane.rigid.residual,
        };
        let fixed = Fixed::all(own.model);
        let read = |x: S| x.lane(number);
        let reading = Reading { read: &read, fixed: &fixed, derivative: false };
        let mut summary = input.summary(Termination::Completed, &reading);
        if let Some(sections) = &self.sections {
            summary.section_forces = sections.end(number);
        }
        summary
    }
}

impl<S: Number> Views<S> {
    /// The values of one lane.
    #[inline(always)]
    fn lane(&self, lane: usize) -> Seen {
        let both = |x: [S; 2]| [x[0].lane(lane), x[1].lane(lane)];
        Seen { contact: 0, start: both(self.start), end: both(self.end) }
    }
}
