//! Whether what formulas of linear elasticity assume held in the run.

use super::super::case::Meeting;
use super::super::surroundings::Surroundings;
use super::super::words::quantity;
use super::observed::{Assumptions, ObservedContact};

impl ObservedContact<'_> {
    /// Adds that all stays elastic and whole, where something could do otherwise: up to the end of the first touch, or of the run for what
    /// is `of_run`.
    pub(super) fn elastic(&self, assumptions: Assumptions, of_run: bool) -> Assumptions {
        let all = self.inelastic();
        if all.is_empty() {
            return assumptions;
        }
        // A touch that lasts to the end of the run has no end.
        let ended = self.interval().map_or(self.touch.time(), |i| i.end);
        let until = if of_run || ended.is_nan() { f64::INFINITY } else { ended };
        match all.into_iter().flatten().min_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((what, time)) if time <= until => {
                let what = format!("elastic: {what} at {}", quantity(time, "s"));
                assumptions.and(what, false)
            }
            _ => assumptions.and("elastic, without failure", true),
        }
    }

    /// What can yield, fail or tear of all that hangs together with the beam; of what did, what and when \[s\].
    pub(super) fn inelastic(&self) -> Vec<Option<(String, f64)>> {
        let beam = match &self.case.meeting {
            Meeting::Struck(struck) => struck.place.index,
            Meeting::Beams(beams) => beams.numbers.0,
            Meeting::Bodies(_) => return Vec::new(),
        };
        let (run, around) = (self.run, Surroundings::of(self.model, beam));
        let own = |name: &str| {
            let mut beams = (0..self.model.beam_count()).filter(|b| around.beams[*b]);
            beams.any(|b| self.model.beam(b).name() == name)
        };
        let beams = run.plastic.iter().filter(|one| own(&one.name)).map(|one| {
            one.first_yield.map(|first| (format!("beam '{}' yields", one.name), first.time))
        });
        let springs = run.yielding.iter().map(|one| {
            let first = one.failed.into_iter().chain(one.first_yield).reduce(f64::min);
            first.map(|time| (format!("'{}' yields", one.name), time))
        });
        let joints = run.joints.iter().map(|one| {
            one.parted.map(|parted| (format!("joint '{}' fails", one.name), parted.time))
        });
        beams.chain(springs).chain(joints).collect()
    }
}
