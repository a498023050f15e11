//! Contacts with crushing: loading along the curve of the law, unloading along a steeper line, and permanent indentation.
//!
//! For the deepest penetration m so far the force is `F(m) - k (m - p)`, without tension, with F the curve and k the slope of unloading: there is
//! no contact before the permanent indentation `r = m - F(m)/k`. The energy `f^2 / (2 k)` is recoverable; beyond m the rest of the work, `integral
//! of F (1 - F'/k) dp`, is dissipated, which is not negative if no part of the curve is steeper than the line. The force over a step is the mean
//! over the straight path from one penetration to the other, so that its work is the change of the stored energy plus the dissipation, in steps of
//! any size.

use std::ops::Range;

use super::law::{CLOSE, StepForce};
use crate::geometry::dents::{CarriedCrush, Dent, Dents};
use crate::model::{SmoothLaw, TouchLaw};
use crate::state::{PairState, State};

/// Share of the force at its deepest by which a contact may press less than the face where it is would answer, without a word.
const DIFFERS: f64 = 0.1;

impl SmoothLaw {
    /// Force at penetration `p`, the deepest so far being `deepest` \[N\]; without the part of rates.
    pub fn force(&self, p: f64, deepest: f64) -> f64 {
        match self.unloading {
            Some(slope) if p < deepest => slope * (p - self.permanent(deepest)).max(0.0),
            _ => self.potential.force(p),
        }
    }

    /// Energy at penetration `p` that is had back when it opens \[J\].
    pub fn stored(&self, p: f64, deepest: f64) -> f64 {
        match self.unloading {
            Some(slope) => 0.5 * self.force(p, deepest).powi(2) / slope,
            None => self.potential.energy(p),
        }
    }

    /// Stiffness at penetration `p` \[N/m\]; at the deepest point so far that of going deeper.
    pub fn stiffness(&self, p: f64, deepest: f64) -> f64 {
        match self.unloading {
            Some(slope) if p < deepest => {
                if p > self.permanent(deepest) {
                    slope
                } else {
                    0.0
                }
            }
            _ => self.potential.stiffness(p),
        }
    }

    /// Stiffness for small motions about penetration `p` at rest \[N/m\]: of a law that crushes the slope of unloading.
    pub fn held_stiffness(&self, p: f64) -> f64 {
        self.unloading.unwrap_or_else(|| self.potential.stiffness(p))
    }

    /// Permanent indentation, at which the force is zero \[m\]; zero for a law without crushing.
    pub fn permanent(&self, deepest: f64) -> f64 {
        let left = |slope: f64| deepest - self.potential.force(deepest) / slope;
        self.unloading.map_or(0.0, |slope| left(slope).max(0.0))
    }

    /// Gap to the permanent indentation of a pair with crushing \[m\]; the gap of all others.
    pub(crate) fn free_gap(&self, seen: &PairState) -> f64 {
        if self.unloading.is_some() { seen.gap + self.permanent(seen.deepest) } else { seen.gap }
    }

    /// State of a pair at the end of a step: the face stores its indentations by position, and an unloaded pair has only the indentation of the
    /// face at `now`. `pressed` is whether it had a force in the step; the face has its indentations, and the radius of the indenter.
    ///
    /// A loaded pair, or one that would be loaded at once with a smaller indentation, keeps its line of unloading, since without a force along the
    /// face another line would store an energy without work. The excess is returned.
    pub(crate) fn remember(
        &self,
        deepest: &mut f64,
        now: Dent,
        face: Option<(&mut Dents, f64)>,
        pressed: bool,
    ) {
        let depth = now.depth;
        let deepens = depth > *deepest;
        *deepest = deepest.max(depth);
        let Some((dents, radius)) = face.filter(|_| !now.place.is_nan()) else { return };
        let known = dents.depth_at(&now, radius);
        if deepens {
            dents.deepen(now, radius);
        } else if depth > 0.0 {
            dents.pass(now, radius);
        }
        let is_free = |deepest: f64| depth <= self.permanent(deepest);
        if is_free(*deepest) {
            if !pressed && is_free(known) {
                *deepest = known;
            }
            return;
        }
        let own = known.max(depth);
        let missing = self.force(depth, own) - self.force(depth, *deepest);
        if dents.has_left(&now, radius) && missing > DIFFERS * self.potential.force(*deepest) {
            dents.carry(&now, self.permanent(*deepest) - self.permanent(own));
        }
    }

    /// The elastic part of [`SmoothLaw::step_force`] of a law that crushes.
    pub(super) fn crushing(&self, slope: f64, [p0, p1]: [f64; 2], deepest: f64) -> StepForce {
        let deepest = deepest.max(p0).max(0.0);
        let step = p1 - p0;
        // The way over the line of unloading, measured from where it begins to press.
        let free = self.permanent(deepest);
        let (a, b) = ((p0 - free).max(0.0), (p1.min(deepest) - free).max(0.0));
        let beyond = (p1 - deepest).max(0.0);
        if a == 0.0 && b == 0.0 && beyond == 0.0 {
            return StepForce::default();
        }
        if step == 0.0 {
            let (force, stiffness) = (self.force(p1, deepest), self.stiffness(p1, deepest));
            return StepForce { force, dissipated: 0.0, slope: 0.5 * stiffness };
        }
        let mut force = 0.5 * slope * (a + b) * (b - a) / step;
        let mut dissipated = 0.0;
        if beyond > 0.0 {
            let curve = self.potential.quotient(deepest, p1).force;
            let [before, after] = [deepest, p1].map(|p| self.potential.force(p));
            // Of the way beyond, the mean of F F'/k, which is stored.
            let stored = 0.5 * (before + after) * (after - before) / (beyond * slope);
            force += curve * beyond / step;
            dissipated = (curve - stored) * beyond / step;
        }
        let close = step.abs() <= CLOSE * (p0.abs() + p1.abs());
        let slope = if close {
            0.5 * self.stiffness(p1, deepest)
        } else {
            (self.force(p1, deepest) - force) / step
        };
        StepForce { force, dissipated, slope }
    }
}

impl TouchLaw {
    /// Largest permanent indentation of the pairs under the law \[m\]; `None` for a law without crushing.
    pub(crate) fn permanent(&self, state: &State, pairs: Range<usize>) -> Option<f64> {
        let Self::Smooth(law) = self else { return None };
        let deepest = |i: usize| state.pairs[i].deepest.max(state.dents[i].deepest());
        law.unloading.map(|_| pairs.map(|i| law.permanent(deepest(i))).fold(0.0, f64::max))
    }

    /// Largest indentation that any of the pairs under the law carried along from another position.
    pub(crate) fn carried(&self, state: &State, pairs: Range<usize>) -> Option<CarriedCrush> {
        let mut most = CarriedCrush::default();
        if self.crushes() {
            pairs.for_each(|i| most.most(state.dents[i].carried));
        }
        (most.depth > 0.0).then_some(most)
    }
}

#[cfg(test)]
mod tests {
    use crate::model::{ContactForce, Potential, SmoothLaw};

    fn laws() -> [SmoothLaw; 3] {
        let table = |penetration, force| Potential::Table { penetration, force };
        let law = |potential, unloading| SmoothLaw {
            potential,
            dissipation: 0.0,
            force: ContactForce::Conserving,
            unloading: Some(unloading),
        };
        [
            law(Potential::Linear { stiffness: 1e6 }, 4e6),
            // It crushes at a constant force, and then locks.
            law(table(vec![0.0, 0.001, 0.05, 0.06], vec![0.0, 2e3, 2e3, 2e4]), 5e6),
            // No steeper than the curve: no dissipation on the first stretch.
            law(table(vec![0.0, 0.01, 0.02], vec![0.0, 1e4, 1e4]), 1e6),
        ]
    }

    /// Penetrations that go to and fro, also out of the contact.
    fn ways() -> impl Iterator<Item = f64> {
        (0..400_i32).map(|i| {
            let t = f64::from(i);
            0.03 * (0.37 * t).sin() + 0.025 * (0.011 * t).sin() + 1e-9 * (7.1 * t).cos()
        })
    }

    #[test]
    fn work_is_what_is_stored_and_what_is_dissipated_and_the_latter_is_never_negative() {
        for law in laws() {
            let (mut p0, mut deepest, mut lost) = (0.0, 0.0_f64, 0.0);
            for p1 in ways() {
                let step = law.step_force([p0, p1], deepest, 0.1);
                let dissipated = step.dissipated * (p1 - p0);
                let before = law.stored(p0, deepest);
                deepest = deepest.max(p1);
                let stored = law.stored(p1, deepest) - before;
                let scale = law.potential.energy(0.06);
                let miss = step.force * (p1 - p0) - stored - dissipated;
                assert!(miss.abs() <= 1e-14 * scale, "{law:?}: {p0} to {p1}: {miss}");
                assert!(dissipated >= -1e-16 * scale && step.force >= 0.0, "{law:?}: {p0} to {p1}");
                lost += dissipated;
                p0 = p1;
            }
            assert!(lost > 0.0);
        }
    }

    #[test]
    fn work_does_not_depend_on_the_size_of_steps() {
        for law in laws() {
            let work = |n: u32| {
                let (mut p0, mut deepest, mut work) = (-0.01, 0.0_f64, 0.0);
                for (from, to) in [(-0.01, 0.03), (0.03, 0.015), (0.015, 0.055), (0.055, -0.01)] {
                    for i in 1..=n {
                        let p1 = from + (to - from) * f64::from(i) / f64::from(n);
                        work += law.step_force([p0, p1], deepest, 0.1).force * (p1 - p0);
                        deepest = deepest.max(p1);
                        p0 = p1;
                    }
                }
                work
            };
            let coarse = work(1);
            assert!((work(97) - coarse).abs() <= 1e-13 * law.potential.energy(0.055));
        }
    }

    #[test]
    fn slopes_are_those_of_the_force_over_the_step() {
        let deepest = 0.021;
        for law in laws() {
            for (p0, p1) in
                [(0.01, 0.03), (0.02, 0.012), (-0.01, 0.04), (0.0195, 0.0199), (0.03, -0.02)]
            {
                let e = 1e-8;
                let f = |p1: f64| law.step_force([p0, p1], deepest, 0.1).force;
                let difference = (f(p1 + e) - f(p1 - e)) / (2.0 * e);
                let slope = law.step_force([p0, p1], deepest, 0.1).slope;
                let scale = law.unloading.unwrap_or(0.0);
                assert!((slope - difference).abs() <= 1e-5 * scale, "{law:?} {p0} {p1}");
            }
        }
    }

    #[test]
    fn a_released_contact_stays_pushed_in() {
        let law = &laws()[0];
        // F = 1e4 N at 10 mm; back along 4e6 N/m over 2.5 mm.
        assert!((law.permanent(0.01) - 0.0075).abs() < 1e-15);
        assert_eq!(law.force(0.007, 0.01), 0.0);
        assert!((law.force(0.008, 0.01) - 2e3).abs() < 1e-9);
        assert!((law.stored(0.01, 0.01) - 12.5).abs() < 1e-12);
    }
}
