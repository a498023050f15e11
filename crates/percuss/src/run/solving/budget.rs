//! What is left of a step: the size of its next part, and how many events and corrections it may still have.

use super::trial::Trial;
use crate::settings::{SAME_INSTANT, Settings};
use crate::step::newton::Failure;

/// A step is cut down to this share of its size before the run gives up.
const SMALLEST_SHARE: f64 = 1e-4;
/// Corrections of Newton's iteration in a step, over all its parts, impacts and cuts, before the run gives up: more would not end.
pub const MOST_CORRECTIONS: usize = 100_000;
/// More instants located and impacts than this in one step count as accumulated: for the rest of it what touches stays together.
pub const MOST_EVENTS: usize = 128;

/// A part of a step that is to be solved.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Its size at most \[s\].
    pub size: f64,
    /// Share of the step to which failures have cut it; impact intervals are cut likewise.
    pub share: f64,
}

/// What is left of a step.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// Size of the step: the one given, or what is left up to the end of the run \[s\].
    pub target: f64,
    /// Size of its next part at most \[s\].
    size: f64,
    /// Size below which parts are not cut any further \[s\].
    smallest: f64,
    /// Instants located and impacts that it may still have.
    pub events_left: usize,
    /// Corrections that the run may have taken at its end.
    pub most_corrections: usize,
}

impl Budget {
    pub fn new(settings: &Settings, steps: usize, corrections: usize) -> Self {
        let step = settings.step;
        let target = step.min(settings.end - steps as f64 * step);
        let target = if (target - step).abs() <= SAME_INSTANT * step { step } else { target };
        Self::of(target, step, corrections)
    }

    /// A step of size `target`, cut by shares of `step` where parts of it fail.
    pub fn of(target: f64, step: f64, corrections: usize) -> Self {
        let smallest = SMALLEST_SHARE * step;
        let most_corrections = corrections + MOST_CORRECTIONS;
        Self { target, size: target, smallest, events_left: MOST_EVENTS, most_corrections }
    }

    /// Whether something is left of the step, `offset` of it done.
    pub fn remains(&self, offset: f64) -> bool {
        offset < self.target * (1.0 - SAME_INSTANT)
    }

    /// The next part, `offset` of the step done; it ends at the next cut at the latest, which is `cut` away.
    pub fn next(&self, offset: f64, cut: f64) -> Option<Part> {
        let size = self.size.min(self.target - offset).min(cut);
        self.remains(offset).then_some(Part { size, share: self.size / self.target })
    }

    /// Ends the step so long after its beginning at the latest.
    pub fn end_at(&mut self, target: f64) {
        if target < self.target {
            self.target = target;
            self.size = self.size.min(target);
        }
    }

    /// Takes a part off that ends with a trial; behind one of its whole size the next may be larger again. That one ends at an instant of
    /// contact, or is an impact, says nothing of the size that failed before.
    pub fn spend(&mut self, trial: &Trial) {
        if trial.is_event() {
            self.events_left = self.events_left.saturating_sub(1);
        } else {
            self.size = (2.0 * self.size).min(self.target);
        }
    }

    /// Cuts the size of a part that has failed in half.
    ///
    /// # Errors
    /// The failure, if the step cannot be cut any further.
    pub fn halve(&mut self, part: &Part, failure: Failure) -> Result<(), Failure> {
        self.size = 0.5 * part.size;
        if self.size >= self.smallest { Ok(()) } else { Err(failure) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::trial::PartKind;
    use super::*;

    #[test]
    fn a_size_that_failed_is_tried_again_behind_a_whole_part_alone() {
        let settings = Settings::new(1.0, 0.1);
        let trial = |kind| Trial { h: 0.0, active: Vec::new(), fallback_law: false, kind };
        let mut budget = Budget::new(&settings, 0, 7);
        assert_eq!(budget.most_corrections, 7 + MOST_CORRECTIONS);
        let part = budget.next(0.0, f64::INFINITY).unwrap();
        budget.halve(&part, Failure::Impact).unwrap();
        for kind in [PartKind::Free { located: Some(0) }, PartKind::Impact] {
            budget.spend(&trial(kind));
            assert_eq!(budget.next(0.0, f64::INFINITY).unwrap().size, 0.05);
        }
        assert_eq!(budget.events_left, MOST_EVENTS - 2);
        budget.spend(&trial(PartKind::Free { located: None }));
        assert_eq!(budget.next(0.0, f64::INFINITY).unwrap().size, 0.1);
    }
}
