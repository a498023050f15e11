//! The gap of a pair over a step, and where within it a contact closes, opens and presses hardest.

use crate::contact::free_gap::FreeGap;
use crate::math::hermite::Cubic;
use crate::math::roots;
use crate::model::SmoothLaw;
use crate::state::PairState;
use crate::summary::Peak;

/// Number of instants within a step at which the force of several points, or of one with losses, is evaluated.
const LOOKS: u32 = 16;

/// The gap of a closed pair over a step: a cubic through gaps and rates at its ends.
#[derive(Clone, Copy, Debug)]
pub struct GapOverStep {
    gap: Cubic,
    /// Deepest penetration before the step, and the permanent indentation, for a law with crushing; otherwise zero \[m\].
    deepest: f64,
    permanent: f64,
}

impl GapOverStep {
    /// Between the ends of a step of size `h`.
    pub fn new(h: f64, before: &PairState, after: &PairState, law: &SmoothLaw) -> Self {
        let gap = Cubic { h, start: [before.gap, before.rate], end: [after.gap, after.rate] };
        let deepest = before.deepest;
        Self { gap, deepest, permanent: law.permanent(deepest) }
    }

    /// Whether it is one: where an end of a beam is left to another pair, its gap is infinite.
    fn is_known(&self) -> bool {
        self.gap.start[0].is_finite() && self.gap.end[0].is_finite()
    }

    /// Gap and rate at a time from the start of the step, on the cubic within the limits of the rates in the step.
    ///
    /// If a velocity jumps within the step, the cubic overshoots: its rates and penetrations exceed the actual ones.
    fn at(&self, t: f64) -> [f64; 2] {
        let Cubic { h, start: [g0, v0], end: [g1, v1] } = self.gap;
        let mean = (g1 - g0) / h;
        let (slowest, fastest) = (v0.min(v1).min(mean), v0.max(v1).max(mean));
        let least = (g0 + t * slowest).max(g1 - (h - t) * fastest);
        [self.gap.value(t).max(least), self.gap.slope(t).clamp(slowest, fastest)]
    }

    /// Force at a time from the start of the step; for a pair that moves to another one, only that at the end.
    fn force(&self, law: &SmoothLaw, t: f64) -> f64 {
        let [gap, rate] = if t == self.gap.h {
            self.gap.end
        } else if self.is_known() {
            self.at(t)
        } else {
            return 0.0;
        };
        if gap >= 0.0 {
            return 0.0;
        }
        (law.force(-gap, self.deepest) * (1.0 - law.dissipation * rate)).max(0.0)
    }

    /// Time from the start of the step at which it closes, and the velocity of approach; `acceleration` is that of the step
    /// before.
    pub fn touch_down(&self, acceleration: f64) -> [f64; 2] {
        let Cubic { h, start, end } = self.gap;
        // A surface with crushing is struck at its current position.
        let [start, end] = [start, end].map(|[gap, rate]| [gap + self.permanent, rate]);
        let gap = &Cubic { h, start, end };
        if gap.start[0] < 0.0 {
            return [0.0, -gap.start[1]];
        }
        if !self.is_known() {
            return [gap.h, -gap.end[1]];
        }
        let [g, rate] = gap.start;
        let [time, rate] = FreeGap { gap: g, rate, acceleration }.closes(gap.h);
        if rate < 0.0 {
            return [time, -rate];
        }
        let time = crossing(gap);
        [time, -gap.slope(time)]
    }
}

/// The largest force of some pairs together within a step that begins at `start`.
pub fn highest(gaps: &[GapOverStep], law: &SmoothLaw, start: f64) -> Peak {
    let Some(first) = gaps.first() else { return Peak { value: 0.0, time: f64::NAN } };
    let h = first.gap.h;
    let force = |t: f64| gaps.iter().map(|c| c.force(law, t)).sum::<f64>();
    let mut best = Peak { value: force(h), time: h };
    let mut take = |t: f64| {
        let value = force(t);
        if value > best.value {
            best = Peak { value, time: t };
        }
    };
    if gaps.len() == 1 && first.is_known() {
        first.gap.stationary().for_each(&mut take);
    }
    if gaps.len() > 1 || law.dissipation > 0.0 {
        let wide = h / f64::from(LOOKS);
        (1..LOOKS).for_each(|k| take(wide * f64::from(k)));
        let about = best.time;
        if about < h {
            // The vertex of the parabola through the best and its neighbours.
            let [a, b, c] = [about - wide, about, about + wide].map(force);
            let bend = a - 2.0 * b + c;
            if bend < 0.0 {
                let vertex = about + (0.5 * wide * (a - c) / bend).clamp(-wide, wide);
                let value = force(vertex);
                if value > best.value {
                    best = Peak { value, time: vertex };
                }
            }
        }
    }
    Peak { time: start + best.time, ..best }
}

/// The first closing instant within the step of a gap that is open at its start; its minimum if it does not close.
fn crossing(gap: &Cubic) -> f64 {
    let start = gap.start[0];
    if start <= 0.0 {
        return 0.0;
    }
    let inside = |t: &f64| gap.value(*t) <= 0.0;
    let Some(until) = gap.stationary().chain([gap.h]).find(inside) else {
        let nearest = gap.stationary().min_by(|a, b| gap.value(*a).total_cmp(&gap.value(*b)));
        return nearest.unwrap_or(gap.h);
    };
    let end = gap.value(until);
    let guess = until * start / (start - end);
    let search = roots::bracketed((0.0, start), (until, end), guess, 0.0, 0.0, |t| {
        Ok::<f64, std::convert::Infallible>(gap.value(t))
    });
    match search {
        Ok(t) => t,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Potential, SmoothLaw};

    fn over_step(start: [f64; 2], end: [f64; 2], h: f64) -> GapOverStep {
        let gap = Cubic { h, start, end };
        GapOverStep { gap, deepest: 0.0, permanent: 0.0 }
    }

    #[test]
    fn a_jump_of_velocity_makes_no_force_that_no_state_of_the_step_has() {
        let law = SmoothLaw {
            dissipation: 2.0,
            ..SmoothLaw::elastic(Potential::Linear { stiffness: 2e5 })
        };
        // At rest against each other, then one is pulled away at 60 m/s, or thrown against the other at that speed and stopped again.
        for (end, most) in
            [([6e-3 - 1e-3, 60.0], 200.0), ([-7e-3, 0.0], 2e5 * 7e-3 * (1.0 + 2.0 * 60.0))]
        {
            let gaps = [over_step([-1e-3, 0.0], end, 1e-4)];
            let peak = highest(&gaps, &law, 0.0);
            assert!(peak.value <= most * (1.0 + 1e-12), "{peak:?} above {most}");
        }
    }

    #[test]
    fn the_crest_of_a_steady_step_is_that_of_the_cubic() {
        let law = SmoothLaw::elastic(Potential::Linear { stiffness: 1e6 });
        // Free fall against a spring: g = -0.01 - 2 t + 500 t^2, deepest at 2 ms by 2 mm.
        let (h, gap) = (4e-3, |t: f64| [-0.01 - 2.0 * t + 500.0 * t * t, -2.0 + 1000.0 * t]);
        let peak = highest(&[over_step(gap(0.0), gap(h), h)], &law, 0.0);
        assert!((peak.value - 1.2e4).abs() < 1e-8 && (peak.time - 2e-3).abs() < 1e-9, "{peak:?}");
    }
}
