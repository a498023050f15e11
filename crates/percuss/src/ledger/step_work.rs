//! Work of forces over a step.

use crate::math::vec2::{add, cross, dot, scale};
use crate::scalar::Number;

/// Work, impulse and angular impulse of forces over a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct StepWork<S = f64> {
    /// Work \[J\].
    pub work: S,
    /// Impulse, shape (2) \[N s\].
    pub impulse: [S; 2],
    /// Angular impulse about the origin \[N m s\].
    pub angular_impulse: S,
    /// Sums of the magnitudes of the single impulses and angular impulses, shape (2) \[N s, N m s\].
    pub passed: [S; 2],
}

impl<S: Number> StepWork<S> {
    /// None, in as many lanes as a number has.
    #[inline(always)]
    pub fn none(like: S) -> Self {
        let zero = like.constant(0.0);
        Self { work: zero, impulse: [zero; 2], angular_impulse: zero, passed: [zero; 2] }
    }

    /// Adds a force at position `x`, moved by `d` over a step of size `h`.
    #[inline(always)]
    pub fn add_force(&mut self, force: [S; 2], x: [S; 2], d: [S; 2], h: S) {
        self.work += dot(force, d);
        let (impulse, turning) = (scale(h, force), h * cross(x, force));
        self.impulse = add(self.impulse, impulse);
        self.angular_impulse += turning;
        self.passed[0] += impulse[0].abs() + impulse[1].abs();
        self.passed[1] += turning.abs();
    }

    /// Adds a force on a node's values and slopes, whose position and tangent in the middle of a step of size `h` are `middle`, moved by
    /// `d`.
    #[inline(always)]
    pub fn add_nodal(&mut self, force: &[S; 4], [x, g]: [[S; 2]; 2], d: &[S; 4], h: S) {
        self.add_force([force[0], force[1]], x, [d[0], d[1]], h);
        // Slope parts: no net force, but work and moment.
        let couple = [force[2], force[3]];
        self.work += dot(couple, [d[2], d[3]]);
        self.angular_impulse += h * cross(g, couple);
    }
}
