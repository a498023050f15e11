//! Where in time impacts happen.
//!
//! If a part of a step would end with one rigid thing inside another, or if they have passed through each other on the way, the
//! instant of contact is located by a root search over its size, each trial a full solution; the part ends there, and the impulse acts
//! in an impact interval, a very short part of its own. That starts half its length before the gap vanishes, so that its middle is the
//! instant of contact.

use super::budget::Part;
use super::solve::Attempt;
use super::solver::Solving;
use super::trial::{PartKind, Trial};
use crate::math::hermite::Cubic;
use crate::math::roots;
use crate::step::contacts::ActiveContact;
use crate::step::newton::Failure;

/// A contact is located to this share of an impact interval.
pub const LOCATED: f64 = 1e-3;
/// Differences of gaps below this share of the size of positions are round-off.
pub const ROUND_OFF: f64 = 1e-15;

impl Solving<'_> {
    /// A part without impacts: of its whole size, or up to the first instant of contact.
    pub fn advance_to_contact(&mut self, part: &Part) -> Result<Trial, Failure> {
        let mut active = self.resting();
        self.solve_resting(&Attempt::free(part.size), &mut active)?;
        let instant = self.first_contact(part.size, &mut active)?;
        let located = instant.and_then(|instant| {
            let nearest = |a: &usize, b: &usize| {
                self.gap_ahead(instant, *a).total_cmp(&self.gap_ahead(instant, *b))
            };
            self.open_contacts().into_iter().min_by(nearest)
        });
        let (h, kind) = (instant.unwrap_or(part.size), PartKind::Free { located });
        Ok(Trial { h, active, fallback_law: false, kind })
    }

    /// Open rigid pairs that could touch within the step solved last.
    pub(super) fn open_contacts(&self) -> Vec<usize> {
        let open = |i: &usize| self.rigid_law(*i).is_some() && !self.state.pairs[*i].closed;
        self.encounters.reached.iter().copied().filter(open).collect()
    }

    /// The gap of pair `i` half an impact interval after the end of the step solved last, as [`Self::path`] counts it.
    fn gap_ahead(&self, h: f64, i: usize) -> f64 {
        let [gap, rate] = self.gap_next(h, i);
        gap - self.floor(i) + 0.5 * self.impact_interval() * rate.min(0.0)
    }

    /// What the gap of pair `i` is below zero by round-off where the step begins.
    fn floor(&self, i: usize) -> f64 {
        self.seen(i).gap.clamp(-self.no_gap(), 0.0)
    }

    /// The gap of pair `i` over the step of size `h` solved last; one that opens from round-off below zero begins at zero.
    fn path(&self, h: f64, i: usize) -> Cubic {
        let pair = self.seen(i);
        let (floor, [gap, rate]) = (self.floor(i), self.gap_next(h, i));
        Cubic { h, start: [pair.gap - floor, pair.rate], end: [gap - floor, rate] }
    }

    /// Least gap ahead of the given contacts, and whether the one it belongs to approaches.
    fn nearest_ahead(&self, h: f64, open: &[usize]) -> (f64, bool) {
        let nearest =
            open.iter().map(|i| (self.gap_ahead(h, *i), *i)).min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or((f64::INFINITY, false), |(ahead, i)| (ahead, self.gap_next(h, i)[1] < 0.0))
    }

    /// The instant of the first contact within the step of size `size` solved last, if there is one; the step up to it is
    /// then the one solved last.
    fn first_contact(
        &mut self,
        size: f64,
        resting: &mut [ActiveContact],
    ) -> Result<Option<f64>, Failure> {
        let open = self.open_contacts();
        if open.is_empty() {
            return Ok(None);
        }
        let paths: Vec<Cubic> = open.iter().map(|i| self.path(size, *i)).collect();
        let (mut end, mut ahead) = (size, self.nearest_ahead(size, &open).0);
        if ahead > 0.0 {
            // One may have dipped into the other and out again, or passed through it.
            let dips = |c: &Cubic| c.stationary().find(|t| c.value(*t) < 0.0);
            let dip = paths.iter().filter_map(dips).reduce(f64::min);
            let passed = self.first_passage(&open).map(|share| share * size);
            let Some(dip) = [dip, passed].into_iter().flatten().reduce(f64::min) else {
                return Ok(None);
            };
            self.solve_resting(&Attempt::free(dip), resting)?;
            (end, ahead) = (dip, self.nearest_ahead(dip, &open).0);
            if ahead > 0.0 {
                if passed.is_some() {
                    return Err(Failure::Passed);
                }
                self.solve_resting(&Attempt::free(size), resting)?;
                return Ok(None);
            }
        }
        let rate = paths.iter().map(|c| c.start[1].abs().max(c.end[1].abs())).fold(0.0, f64::max);
        let tolerance = LOCATED * self.impact_interval();
        let near = (tolerance * rate).max(ROUND_OFF * self.positions);
        let start = paths
            .iter()
            .map(|c| c.start[0] + 0.5 * self.impact_interval() * c.start[1].min(0.0))
            .fold(f64::INFINITY, f64::min)
            .max(near);
        let guess = end * start / (start - ahead);
        let guess = paths.iter().filter_map(|c| descent(c, end)).reduce(f64::min).unwrap_or(guess);
        let guess = guess - 0.5 * self.impact_interval();
        let instant = roots::bracketed((0.0, start), (end, ahead), guess, tolerance, near, |t| {
            self.solve_resting(&Attempt::free(t), resting)?;
            let (ahead, approaching) = self.nearest_ahead(t, &open);
            // A contact that has just opened is as near as one about to close, but is not what is sought; one that lies
            // inside is, even on its way out again.
            Ok::<f64, Failure>(if approaching || ahead < -near {
                ahead
            } else {
                ahead.max(2.0 * near)
            })
        })?;
        Ok(Some(instant))
    }
}

/// Where the gap first falls to zero, if it does before `end`.
pub fn descent(gap: &Cubic, end: f64) -> Option<f64> {
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
