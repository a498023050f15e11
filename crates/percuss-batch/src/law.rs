//! Contact laws of guided projectiles without branches, as [`SmoothLaw::step_force`](percuss::SmoothLaw) has them.

use super::engine::GuideState;
use super::numbers::{GuideLaw, GuideNumbers};
use percuss::internals::scalar::Number;

impl<S: Number> GuideNumbers<S> {
    /// Force over a step that ends at penetration `p1`, and its slope.
    #[inline(always)]
    pub fn force(&self, state: &mut GuideState<S>, p1: S) {
        if self.law == GuideLaw::Rigid {
            return;
        }
        [state.force, state.slope] = difference_quotient(self.law, self.stiffness, -state.gap, p1);
    }

    /// Potential at penetration `p` \[J\].
    #[inline(always)]
    pub fn energy(&self, p: S) -> S {
        let p = p.max(p.constant(0.0));
        match self.law {
            GuideLaw::Linear => self.stiffness * p * p * 0.5,
            GuideLaw::Hertz => self.stiffness * p * p * p.sqrt() * 0.4,
            GuideLaw::Rigid => p.constant(0.0),
        }
    }

    /// Force at a penetration that is not negative \[N\].
    #[inline(always)]
    pub fn reaction(&self, p: S) -> S {
        reaction(self.law, self.stiffness, p)
    }
}

/// Difference quotient of the potential of a law that presses from penetration zero on, from `p0` to `p1` \[N\], and its slope by `p1`
/// \[N/m\].
#[inline(always)]
pub fn difference_quotient<S: Number>(law: GuideLaw, stiffness: S, p0: S, p1: S) -> [S; 2] {
    let zero = p1.constant(0.0);
    let (q0, q1) = (p0.max(zero), p1.max(zero));
    let (sum, step) = (q0 + q1, p1 - p0);
    // Of the way over the step, the share inside.
    let least = p0.if_less(p1, p0, p1);
    let share = least.if_less(zero, (q1 - q0) / step, p1.constant(1.0));
    let elastic = mean_force(law, stiffness, q0, q1) * share;
    let close = step.abs().if_less(
        sum * 1e-6,
        spring(law, stiffness, sum * 0.5) * 0.5,
        (reaction(law, stiffness, q1) - elastic) / step,
    );
    let touches = |x: S| zero.if_less(sum, x, zero);
    [touches(elastic), touches(close)]
}

#[inline(always)]
fn reaction<S: Number>(law: GuideLaw, stiffness: S, p: S) -> S {
    match law {
        GuideLaw::Hertz => stiffness * p * p.sqrt(),
        _ => stiffness * p,
    }
}

#[inline(always)]
fn spring<S: Number>(law: GuideLaw, stiffness: S, p: S) -> S {
    match law {
        GuideLaw::Hertz => stiffness * p.sqrt() * 1.5,
        _ => stiffness,
    }
}

/// Difference quotient of the potential between penetrations that are not negative.
#[inline(always)]
fn mean_force<S: Number>(law: GuideLaw, stiffness: S, q0: S, q1: S) -> S {
    match law {
        GuideLaw::Hertz => {
            let (a, b) = (q1.sqrt(), q0.sqrt());
            let (a2, ab, b2) = (a * a, a * b, b * b);
            let sum = a2 * a2 + ab * (a2 + ab + b2) + b2 * b2;
            stiffness * sum / (a + b) * 0.4
        }
        _ => stiffness * (q0 + q1) * 0.5,
    }
}
