//! Whether a pair has passed through each other within a part of a step, unseen at its ends.

use super::solver::Solving;
use crate::geometry::pair::Memory;
use crate::geometry::touch::SearchRegion;
use crate::step::newton::Failure;

/// Number of evaluations along a path; a contact without overlap in all of them is assumed to slide along the face.
const LOOKS: usize = 200;
/// An overlap over less of the path than this share of the distance at which centre and axis touch only grazes the face, no deeper than about a
/// thousandth of that distance.
const GRAZE: f64 = 0.1;

impl Solving<'_> {
    /// Fails if a smooth pair has passed through unseen.
    pub(super) fn smooth_passage(&mut self) -> Result<(), Failure> {
        let mut passed = false;
        for k in 0..self.encounters.reached.len() {
            let pair = self.encounters.reached[k];
            passed |= self.is_smooth(pair) && self.first_passage(&[pair]).is_some();
        }
        if passed { Err(Failure::Passed) } else { Ok(()) }
    }

    /// Share of the last solved step at which the first of the given open pairs overlaps, though at its end it is outside again, or overlaps from
    /// the other side: the bodies have passed through each other. Its initial side is stored if it was unknown.
    pub(super) fn first_passage(&mut self, pairs: &[usize]) -> Option<f64> {
        let mut first: Option<f64> = None;
        for &i in pairs {
            if let Some((share, memory)) = self.passage(i) {
                if self.seen(i).memory.side == 0.0 {
                    self.encounters.sight_mut(self.state, i).memory.side = memory.side;
                }
                first = Some(first.map_or(share, |f| f.min(share)));
            }
        }
        first
    }

    /// Follows pair `i` along the straight path of the step, never further than its gap.
    fn passage(&self, i: usize) -> Option<(f64, Memory)> {
        let pair = &self.model.pairs[i];
        let seen = self.seen(i);
        if !pair.target.has_sides() || seen.gap <= 0.0 || seen.gap.is_nan() {
            return None;
        }
        let at = self.end_of_step();
        let way = self.search.way(&pair.movers);
        let mut memory = seen.memory;
        let chord = GRAZE * pair.thickness(self.model, &memory);
        if seen.gap + chord > way {
            return None;
        }
        let last = pair.at_end(self.model, &at, &memory, seen.gap)?;
        // Overlap at the evaluated points, or outside at both ends and too slow for an overlap between.
        let inside = last.gap <= 0.0;
        let entered = inside && last.memory.side == memory.side;
        if entered || seen.gap + chord + last.apart.max(0.0) > way {
            return None;
        }
        let floor = chord.max(1e-6 * way).max(1e-9 * seen.gap);
        let (mut share, mut apart) = (0.0, seen.gap);
        for _ in 0..LOOKS {
            share += apart.max(floor) / way;
            if share >= 1.0 {
                return None;
            }
            let touch = pair.touch(self.model, &at.at(share), &memory, SearchRegion::All)?;
            if touch.gap < 0.0 {
                let side = touch.memory.side;
                let meant = inside && (side == last.memory.side || side == 0.0);
                return (!meant).then_some((share, memory));
            }
            (apart, memory) = (touch.apart, touch.memory);
        }
        None
    }
}
