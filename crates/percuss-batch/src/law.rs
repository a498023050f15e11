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

    /// Force over a step that ends at penetration `p1`, and its slope.
    #[inline(always)]
    pub fn force(&self, state: &mut GuideState<S>, p1: S) {
        if let Some(curve) = self.curve() {
            [state.force, state.slope] = curve.quotient(-state.gap, p1);
        }
    }

    /// Potential at penetration `p` \[J\].
    #[inline(always)]
    pub fn energy(&self, p: S) -> S {
        let zero = p.constant(0.0);
        self.curve().map_or(zero, |curve| curve.energy(p.max(zero)))
    }

    /// Force at a penetration that is not negative \[N\]; zero of a rigid contact.
    #[inline(always)]
    pub fn reaction(&self, p: S) -> S {
        self.curve().map_or(p.constant(0.0), |curve| curve.at(p))
    }
}
