//! Contact laws of guided projectiles.

use super::engine::GuideState;
use super::numbers::{GuideLaw, GuideNumbers};
use percuss::internals::contact::law::{ForceCurve, PowerLaw};
use percuss::internals::scalar::Number;

impl<S: Number> GuideNumbers<S> {
    /// Force law of the contact; `None` for a rigid one.
    #[inline(always)]
    fn curve(&self) -> Option<PowerLaw<S>> {
        match self.law {
            GuideLaw::Linear => Some(PowerLaw::Linear(self.stiffness)),
            GuideLaw::Hertz => Some(PowerLaw::Hertz(self.stiffness)),
            GuideLaw::Rigid => None,
        }
    }

    /// Force over a step that ends at penetration `p1`, and its slope; `rate` is the reciprocal of the step size.
    #[inline(always)]
    pub fn force(&self, state: &mut GuideState<S>, p1: S, rate: S) {
        if let Some(curve) = self.curve() {
            [state.force, state.slope] = curve.quotient(-state.gap, p1);
        }
        if self.damped {
            self.damp(state, p1 + state.gap, rate);
        }
    }

    /// Adds the dissipative part of a damped force, for a change of penetration over the step: as in
    /// [`SmoothLaw::step_force`](percuss::SmoothLaw::step_force).
    #[inline(always)]
    fn damp(&self, state: &mut GuideState<S>, change: S, rate: S) {
        let (elastic, slope) = (state.force, state.slope);
        let zero = elastic.constant(0.0);
        let rate = self.dissipation * rate;
        let factor = elastic.constant(1.0) + rate * change;
        let pushes = zero.less(factor);
        state.force = S::choose(pushes, elastic * factor, zero);
        state.slope = S::choose(pushes, slope * factor + elastic * rate, zero);
        state.dissipated = state.force - elastic;
    }

    /// Potential at penetration `p` \[J\].
    #[inline(always)]
    pub fn energy(&self, p: S) -> S {
        let zero = p.constant(0.0);
        self.curve().map_or(zero, |curve| curve.energy(p.max(zero)))
    }

    /// Force at a gap that changes at a rate \[N\].
    #[inline(always)]
    pub fn pushes(&self, gap: S, rate: S) -> S {
        let zero = gap.constant(0.0);
        let force = self.reaction((-gap).max(zero));
        if self.damped {
            force * (gap.constant(1.0) - self.dissipation * rate).max(zero)
        } else {
            force
        }
    }

    /// Force at a penetration that is not negative, without dissipation \[N\]; zero of a rigid contact.
    #[inline(always)]
    pub fn reaction(&self, p: S) -> S {
        self.curve().map_or(p.constant(0.0), |curve| curve.at(p))
    }
}
