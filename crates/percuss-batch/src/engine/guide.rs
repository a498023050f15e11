//! Guided projectiles of the runs in the current step.

use crate::ground_springs::row;
use crate::numbers::GuideNumbers;
use percuss::internals::model::frozen::combine;
use percuss::internals::scalar::Number;
use percuss::math::vec2::dot;

/// State of a guided projectile, and its values in the current step.
#[derive(Clone, Copy, Debug)]
pub struct GuideState<S> {
    /// Displacement along the line of motion \[m\], velocity \[m/s\].
    pub way: S,
    pub velocity: S,
    /// Gap \[m\] and its rate \[m/s\].
    pub gap: S,
    pub rate: S,
    /// Increment of the displacement, residual and correction.
    pub increment: S,
    pub residual: S,
    pub correction: S,
    /// Change of the gap over the step \[m\].
    pub gap_change: S,
    /// Force of the loads, shape (2) \[N\].
    pub applied: [S; 2],
    /// Force \[N\], its slope by the penetration at the end of the step \[N/m\].
    pub force: S,
    pub slope: S,
    /// Slope, and inertia with the slope, of the tangent assembled last, shape (2) \[N/m\].
    pub assembled: [S; 2],
    /// The same of the factors in use, shape (2) \[N/m\].
    pub factored: [S; 2],
    /// Impulse of a rigid contact that strikes in this step \[N s\].
    pub impulse: S,
}

impl<S: Number> GuideNumbers<S> {
    /// Nodal values of the struck point along the line of motion, as a form on its two nodes.
    #[inline(always)]
    pub fn row(&self) -> [S; 8] {
        row(&self.shape, &self.direction)
    }

    /// The form applied to given nodal values.
    #[inline(always)]
    pub fn along(&self, nodal: &[[S; 4]]) -> S {
        let w = self.value(nodal);
        dot(self.direction, w)
    }

    /// Nodal values interpolated to the struck point.
    #[inline(always)]
    pub fn value(&self, nodal: &[[S; 4]]) -> [S; 2] {
        combine(nodal, self.node, &self.shape)
    }
}

impl<S: Number> GuideState<S> {
    pub(super) fn at_start(guide: &GuideNumbers<S>) -> Self {
        let zero = guide.mass.constant(0.0);
        Self {
            way: zero,
            velocity: guide.speed,
            gap: guide.standoff,
            rate: -guide.speed,
            increment: zero,
            residual: zero,
            correction: zero,
            gap_change: zero,
            applied: [zero; 2],
            force: zero,
            slope: zero,
            assembled: [zero, guide.mass],
            factored: [zero, guide.mass],
            impulse: zero,
        }
    }

    /// Contact force due to the residual of the projectile when its displacement is eliminated \[N\].
    #[inline(always)]
    pub fn left_over(&self) -> S {
        let [slope, inertia] = self.factored;
        slope * self.residual / inertia
    }
}
