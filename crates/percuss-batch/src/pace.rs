//! At what pace a run in a lane goes: the parts of its steps, as a single run has them ([`step`](percuss::internals::run::step)).
//!
//! A part is a free one of the whole size that is left, one up to an instant of contact, which a root search over its size
//! locates, or an impact interval. To the lanes all of them are steps of some size with some contacts pressing; whether one is
//! accepted, and what comes next, each lane decides by itself.

use percuss::internals::run::contact_status::{IMPACT_INTERVAL, STICK};
use percuss::internals::run::locate::{LOCATED, ROUND_OFF, descent};
use percuss::internals::run::step::MOST_EVENTS;
use percuss::internals::settings::{SAME_INSTANT, Settings};
use percuss::math::hermite::Cubic;
use percuss::math::roots::Bracket;

/// What a lane solves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LanePart {
    /// All that is left of the step.
    Whole,
    /// Up to where one of the gaps seems to have dipped below zero and out again.
    Dip,
    /// All that is left of the step, in which nothing touches.
    Clear,
    /// Up to a trial of the root search.
    Trial,
    /// An impact interval.
    Impact,
}

/// What a rigid contact does in a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// Nothing: it stands open.
    Open,
    /// It stays closed while it presses.
    Rests,
    /// It strikes with this coefficient of restitution.
    Strikes(f64),
}

/// A rigid contact of a lane.
#[derive(Clone, Copy, Debug)]
pub struct Touching {
    restitution: f64,
    pub closed: bool,
    /// Fastest approach so far \[m/s\].
    pub approach_max: f64,
    /// What it does in the part at hand.
    pub role: Role,
}

/// What is seen of a rigid contact over a part.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    /// Gap and its rate at the start, shape (2) \[m, m/s\].
    pub start: [f64; 2],
    /// The same at the end, shape (2) \[m, m/s\].
    pub end: [f64; 2],
}

/// What is no approach, and no gap, by round-off \[m/s, m\].
#[derive(Clone, Copy, Debug)]
pub struct Negligible {
    pub rate: f64,
    pub gap: f64,
}

/// A run on its way through its steps.
#[derive(Clone, Debug)]
pub struct Pace {
    /// Size of a step and end of the run \[s\].
    step: f64,
    end: f64,
    /// Size of the structure \[m\].
    size: f64,
    /// Steps of the run, and those done.
    count: usize,
    pub steps: usize,
    /// Time at the start of the part at hand \[s\].
    pub time: f64,
    /// Size of the step at hand, and what is done of it \[s\].
    target: f64,
    offset: f64,
    /// The part at hand, its size, and that of the whole one it belongs to \[s\].
    pub part: LanePart,
    pub h: f64,
    whole: f64,
    /// Instants located and impacts that the step may still have.
    events_left: usize,
    /// The contact that was located at the end of the part before, or of the one at hand \[index of a rigid contact\].
    located: Option<usize>,
    /// Rigid contacts, shape (rigid contacts).
    pub contacts: Vec<Touching>,
    search: Bracket,
    /// Gaps of the open contacts over the whole part, shape (open contacts).
    paths: Vec<Cubic>,
    /// Gaps up to this one are as good as none in the search at hand \[m\].
    near: f64,
    /// Rows that a recorder would be given, every so many steps, and the time of the last one \[s\].
    pub rows: usize,
    record_every: usize,
    row_time: f64,
    /// Parts solved, trials included.
    pub solver_steps: usize,
}

impl Pace {
    /// At the start of a run with rigid contacts of these coefficients of restitution.
    pub fn new(settings: &Settings, size: f64, rigid: &[f64]) -> Self {
        let contact = |restitution: &f64| Touching {
            restitution: *restitution,
            closed: false,
            approach_max: 0.0,
            role: Role::Open,
        };
        let mut pace = Self {
            step: settings.step,
            end: settings.end,
            size,
            count: settings.step_count(),
            steps: 0,
            time: 0.0,
            target: 0.0,
            offset: 0.0,
            part: LanePart::Whole,
            h: 0.0,
            whole: 0.0,
            events_left: MOST_EVENTS,
            located: None,
            contacts: rigid.iter().map(contact).collect(),
            search: Bracket::default(),
            paths: Vec::new(),
            near: 0.0,
            rows: 1,
            record_every: settings.record_every,
            row_time: 0.0,
            solver_steps: 0,
        };
        pace.open_step();
        pace
    }

    /// Size of the structure \[m\].
    pub fn size(&self) -> f64 {
        self.size
    }

    /// Length of an impact interval \[s\].
    pub fn interval(&self) -> f64 {
        IMPACT_INTERVAL * self.step
    }

    /// Whether the run has come to its end.
    pub fn is_over(&self) -> bool {
        self.steps == self.count
    }

    /// Whether impacts accumulate: more of them than are followed one by one.
    pub fn accumulates(&self) -> bool {
        self.events_left == 0
    }

    fn open_step(&mut self) {
        let target = self.step.min(self.end - self.steps as f64 * self.step);
        let whole = (target - self.step).abs() <= SAME_INSTANT * self.step;
        self.target = if whole { self.step } else { target };
        self.events_left = MOST_EVENTS;
    }

    /// Begins the next part where the contacts stand as given, shape (rigid contacts).
    pub fn begin(&mut self, seen: &[Seen], nothing: Negligible) {
        let interval = self.interval();
        let mut strikes = false;
        for (k, (contact, seen)) in self.contacts.iter_mut().zip(seen).enumerate() {
            let [gap, rate] = seen.end;
            let close = self.located == Some(k) || gap < -0.75 * interval * rate;
            contact.role = match contact.closed {
                true => Role::Rests,
                false if rate < 0.0 && close => {
                    strikes = true;
                    let stick = (STICK * contact.approach_max).max(nothing.rate);
                    Role::Strikes(if -rate <= stick { 0.0 } else { contact.restitution })
                }
                false => Role::Open,
            };
        }
        self.begin_part(strikes);
    }

    #[inline(always)]
    fn begin_part(&mut self, strikes: bool) {
        self.whole = self.target - self.offset;
        (self.part, self.h) = if strikes {
            (LanePart::Impact, self.interval())
        } else {
            (LanePart::Whole, self.whole)
        };
        self.located = None;
    }

    /// Whether the part solved last is accepted; if not, the next trial is at hand. Contacts as given, shape (rigid contacts).
    pub fn judge(&mut self, seen: &[Seen], nothing: Negligible) -> bool {
        match self.part {
            LanePart::Clear | LanePart::Impact => true,
            LanePart::Whole => self.first_contact(seen, nothing),
            LanePart::Dip => {
                let (ahead, _) = self.nearest(seen, nothing);
                if ahead > 0.0 {
                    (self.part, self.h) = (LanePart::Clear, self.whole);
                } else {
                    self.open_search(self.h, ahead);
                }
                false
            }
            LanePart::Trial => {
                let (ahead, nearest) = self.nearest(seen, nothing);
                let approaches = nearest.is_some_and(|k| seen[k].end[1] < 0.0);
                let inside = approaches || ahead < -self.near;
                if self.search.take(if inside { ahead } else { ahead.max(2.0 * self.near) }) {
                    self.located = nearest;
                    return true;
                }
                self.h = self.search.propose();
                false
            }
        }
    }

    /// What a gap is below zero by round-off where the part begins.
    fn floor(seen: &Seen, nothing: Negligible) -> f64 {
        seen.start[0].clamp(-nothing.gap, 0.0)
    }

    /// Least gap of the open contacts half an impact interval after the end of the part, and whose it is.
    fn nearest(&self, seen: &[Seen], nothing: Negligible) -> (f64, Option<usize>) {
        let mut least = (f64::INFINITY, None);
        for (k, (contact, seen)) in self.contacts.iter().zip(seen).enumerate() {
            if contact.closed {
                continue;
            }
            let [gap, rate] = seen.end;
            let ahead = gap - Self::floor(seen, nothing) + 0.5 * self.interval() * rate.min(0.0);
            if ahead < least.0 {
                least = (ahead, Some(k));
            }
        }
        least
    }

    /// Whether nothing touches in a whole part; else the first trial of the search is at hand.
    fn first_contact(&mut self, seen: &[Seen], nothing: Negligible) -> bool {
        self.paths.clear();
        for (contact, seen) in self.contacts.iter().zip(seen).filter(|(c, _)| !c.closed) {
            let floor = Self::floor(seen, nothing);
            let above = |[gap, rate]: [f64; 2]| [gap - floor, rate];
            let (start, end) = (above(seen.start), above(seen.end));
            self.paths.push(Cubic { h: self.h, start, end });
            debug_assert!(contact.role == Role::Open);
        }
        let (ahead, _) = self.nearest(seen, nothing);
        if ahead <= 0.0 {
            self.open_search(self.whole, ahead);
            return false;
        }
        let dips = |c: &Cubic| c.stationary().find(|t| c.value(*t) < 0.0);
        let Some(dip) = self.paths.iter().filter_map(dips).reduce(f64::min) else {
            return true;
        };
        (self.part, self.h) = (LanePart::Dip, dip);
        false
    }

    /// Begins the search for the instant of contact before `end`, where the least gap ahead is `ahead`.
    fn open_search(&mut self, end: f64, ahead: f64) {
        let (interval, paths) = (self.interval(), &self.paths);
        let rate = paths.iter().map(|c| c.start[1].abs().max(c.end[1].abs())).fold(0.0, f64::max);
        let tolerance = LOCATED * interval;
        self.near = (tolerance * rate).max(ROUND_OFF * self.size);
        let start = paths
            .iter()
            .map(|c| c.start[0] + 0.5 * interval * c.start[1].min(0.0))
            .fold(f64::INFINITY, f64::min)
            .max(self.near);
        let guess = end * start / (start - ahead);
        let guess = paths.iter().filter_map(|c| descent(c, end)).reduce(f64::min).unwrap_or(guess);
        let guess = guess - 0.5 * interval;
        self.search = Bracket::new((0.0, start), (end, ahead), guess, [tolerance, self.near]);
        (self.part, self.h) = (LanePart::Trial, self.search.propose());
    }

    /// Accepts the part at hand: contacts at its end and impulses as given, shape (rigid contacts).
    pub fn accept(&mut self, seen: &[Seen], impulses: &[f64], nothing: Negligible) {
        let event = self.part == LanePart::Impact || self.located.is_some();
        self.events_left = self.events_left.saturating_sub(usize::from(event));
        let strikes = |c: &Touching| matches!(c.role, Role::Strikes(_));
        let strikes = self.contacts.iter().zip(impulses).any(|(c, i)| strikes(c) && *i > 0.0);
        if strikes {
            self.row();
        }
        for ((contact, seen), impulse) in self.contacts.iter_mut().zip(seen).zip(impulses) {
            match contact.role {
                Role::Open => {}
                Role::Rests => contact.closed = *impulse > 0.0,
                Role::Strikes(restitution) => {
                    contact.approach_max = contact.approach_max.max(-seen.start[1]);
                    contact.closed = restitution == 0.0;
                }
            }
        }
        self.close_at_rest(seen, nothing);
        self.time += self.h;
        self.offset += self.h;
        if strikes {
            self.row();
        }
        self.end_step();
    }

    /// Contacts that touch, at rest but for what is no approach, count as closed.
    pub fn close_at_rest(&mut self, seen: &[Seen], nothing: Negligible) {
        for (contact, seen) in self.contacts.iter_mut().zip(seen) {
            let [gap, rate] = seen.end;
            contact.closed |= gap <= nothing.gap && rate.abs() <= nothing.rate;
        }
    }

    /// A row, unless this instant has one.
    fn row(&mut self) {
        if self.time > self.row_time {
            self.rows += 1;
            self.row_time = self.time;
        }
    }

    /// Ends the step if nothing is left of it.
    #[inline(always)]
    fn end_step(&mut self) {
        if self.offset < self.target * (1.0 - SAME_INSTANT) || self.accumulates() {
            return;
        }
        self.steps += 1;
        self.offset -= self.target;
        if self.offset.abs() <= SAME_INSTANT * self.step {
            self.offset = 0.0;
        }
        let time = (self.steps as f64 * self.step).min(self.end) + self.offset;
        self.time = if self.offset > 0.0 { time.max(self.time) } else { time };
        if self.steps.is_multiple_of(self.record_every) || self.is_over() {
            self.row();
        }
        self.open_step();
    }
}
