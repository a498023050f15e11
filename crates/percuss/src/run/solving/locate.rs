//! Location of impacts in time.
//!
//! If rigid bodies would overlap at the end of a part of a step, or have passed through each other within it, the instant of contact is located by
//! a root search over its size, each trial a full solution; the part ends there, and the impulse acts in an impact interval, a very short part of
//! its own. It starts half its length before the gap vanishes, so that its middle is the instant of contact.

use crate::math::hermite::Cubic;
use crate::math::roots::{self, Bracket};

/// A contact is located to this share of an impact interval.
const LOCATED: f64 = 1e-3;
/// Differences of gaps below this share of the size of positions are round-off.
const ROUND_OFF: f64 = 1e-15;

/// Gap and rate of a rigid contact over a solved part.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// The contact.
    pub contact: usize,
    /// Gap and its rate at the start, shape (2) \[m, m/s\].
    pub start: [f64; 2],
    /// The same at the end, shape (2) \[m, m/s\].
    pub end: [f64; 2],
}

impl Seen {
    /// The gap if it is negative by round-off at the start of the part, otherwise zero \[m\].
    fn floor(&self, no_gap: f64) -> f64 {
        self.start[0].clamp(-no_gap, 0.0)
    }
}

/// Verdict on a solved part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It is solved once more, by another size or with more contacts.
    Again,
    /// It is accepted; it ends where this contact was located, if one was.
    Ends {
        /// The contact.
        located: Option<usize>,
    },
    /// Bodies have passed through each other, and gaps do not give the instant: the part is cut.
    Passed,
}

/// Gaps that matter to the search \[m\], and its time scale.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tolerances {
    /// Length of an impact interval \[s\].
    pub interval: f64,
    /// Scale of positions \[m\].
    pub positions: f64,
    /// A gap that is none \[m\].
    pub no_gap: f64,
}

/// Kind of the last solution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum SolvedUpTo {
    /// The whole part.
    #[default]
    Whole,
    /// Up to the point at which a gap seems to have been negative for a time, or, if `passed`, a body may have passed through.
    Dip { passed: bool },
    /// The whole part, without contact.
    Clear,
    /// Up to a trial of the root search.
    Trial,
}

/// The search for the first contact within a part without impact.
#[derive(Clone, Debug, Default)]
pub struct FirstContact {
    tolerances: Tolerances,
    stage: SolvedUpTo,
    /// Size of the whole part \[s\].
    whole: f64,
    /// Size of the next solution \[s\].
    pub h: f64,
    /// Gaps over the whole part, shape (open contacts).
    paths: Vec<Cubic>,
    root: Bracket,
    /// Gaps up to this one are as good as none \[m\].
    near: f64,
}

impl FirstContact {
    /// Begins with a part of the given size.
    pub fn begin(&mut self, whole: f64, tolerances: Tolerances) {
        (self.stage, self.whole, self.h, self.tolerances) =
            (SolvedUpTo::Whole, whole, whole, tolerances);
    }

    /// Whether the last solution was the whole part, from which the open contacts are known.
    pub fn is_whole(&self) -> bool {
        self.stage == SolvedUpTo::Whole
    }

    /// Verdict on the open contacts from the last solution; `passed` is the share of it at which the first of them has passed through a body.
    pub fn judge(&mut self, open: &[Seen], passed: impl FnOnce() -> Option<f64>) -> Verdict {
        let clear = Verdict::Ends { located: None };
        if self.stage == SolvedUpTo::Clear || open.is_empty() {
            return clear;
        }
        let (ahead, nearest) = self.nearest(open);
        match self.stage {
            SolvedUpTo::Clear => return clear,
            SolvedUpTo::Whole => {
                self.note_paths(open);
                if ahead > 0.0 {
                    // One may have dipped into the other and out again, or passed through it.
                    let dips = |c: &Cubic| c.stationary().find(|t| c.value(*t) < 0.0);
                    let dip = self.paths.iter().filter_map(dips).reduce(f64::min);
                    let passed = passed().map(|share| share * self.whole);
                    let Some(first) = [dip, passed].into_iter().flatten().reduce(f64::min) else {
                        return clear;
                    };
                    (self.stage, self.h) = (SolvedUpTo::Dip { passed: passed.is_some() }, first);
                } else {
                    self.open_search(ahead);
                }
            }
            SolvedUpTo::Dip { passed } => {
                if ahead <= 0.0 {
                    self.open_search(ahead);
                } else if passed {
                    return Verdict::Passed;
                } else {
                    (self.stage, self.h) = (SolvedUpTo::Clear, self.whole);
                }
            }
            SolvedUpTo::Trial => {
                // A contact that has just opened is as close as one about to close, but is not the result of the search; an overlapping one is,
                // even while it separates.
                let sought = nearest.end[1] < 0.0 || ahead < -self.near;
                if self.root.take(if sought { ahead } else { ahead.max(2.0 * self.near) }) {
                    return Verdict::Ends { located: Some(nearest.contact) };
                }
                self.h = self.root.propose();
            }
        }
        Verdict::Again
    }

    /// Least gap half an impact interval after the end of the last solution \[m\], and its contact.
    fn nearest<'s>(&self, open: &'s [Seen]) -> (f64, &'s Seen) {
        let Tolerances { interval, no_gap, .. } = self.tolerances;
        let ahead = |seen: &'s Seen| {
            let [gap, rate] = seen.end;
            (gap - seen.floor(no_gap) + 0.5 * interval * rate.min(0.0), seen)
        };
        let nearer = |a: (f64, &'s Seen), b: (f64, &'s Seen)| if b.0 < a.0 { b } else { a };
        open[1..].iter().map(ahead).fold(ahead(&open[0]), nearer)
    }

    /// Notes the gaps over the whole part; one that opens from round-off below zero begins at zero.
    fn note_paths(&mut self, open: &[Seen]) {
        let (h, no_gap) = (self.whole, self.tolerances.no_gap);
        self.paths.clear();
        self.paths.extend(open.iter().map(|seen| {
            let above = |[gap, rate]: [f64; 2]| [gap - seen.floor(no_gap), rate];
            Cubic { h, start: above(seen.start), end: above(seen.end) }
        }));
    }

    /// Begins the root search before the end of the last solution, for the least gap ahead `ahead`.
    fn open_search(&mut self, ahead: f64) {
        let (end, paths) = (self.h, &self.paths);
        let Tolerances { interval, positions, .. } = self.tolerances;
        let rate = paths.iter().map(|c| c.start[1].abs().max(c.end[1].abs())).fold(0.0, f64::max);
        let tolerance = LOCATED * interval;
        self.near = (tolerance * rate).max(ROUND_OFF * positions);
        let start = paths
            .iter()
            .map(|c| c.start[0] + 0.5 * interval * c.start[1].min(0.0))
            .fold(f64::INFINITY, f64::min)
            .max(self.near);
        let guess = end * start / (start - ahead);
        let guess = paths.iter().filter_map(|c| descent(c, end)).reduce(f64::min).unwrap_or(guess);
        let guess = guess - 0.5 * interval;
        self.root = Bracket::new((0.0, start), (end, ahead), guess, [tolerance, self.near]);
        (self.stage, self.h) = (SolvedUpTo::Trial, self.root.propose());
    }
}

/// First instant at which the gap decreases to zero, if it is before `end`.
fn descent(gap: &Cubic, end: f64) -> Option<f64> {
    let opened = || gap.stationary().find(|t| *t < end && gap.value(*t) > 0.0);
    let from = if gap.value(0.0) > 0.0 { 0.0 } else { opened()? };
    let (a, b) = (gap.value(from), gap.value(end));
    if b > 0.0 {
        return None;
    }
    let f = |t: f64| Ok::<f64, std::convert::Infallible>(gap.value(t));
    let guess = from + (end - from) * a / (a - b);
    match roots::bracketed((from, a), (end, b), guess, 1e-12 * end, 0.0, f) {
        Ok(t) => Some(t),
    }
}
