//! Elastic supports and stops in a step: the difference quotient of the potential, as in single runs
//! ([`step::connectors`](percuss::internals::step::connectors)).

use super::Engine;
use crate::ground_springs::{GroundSpringState, row};
use percuss::internals::ledger::Ledger;
use percuss::internals::scalar::Number;
use percuss::math::vec2::scale;

impl<S: Number> Engine<S> {
    /// Force of a spring at the current increment.
    #[inline(always)]
    fn see_spring(&self, k: usize) -> GroundSpringState<S> {
        let spring = &self.numbers.springs[k];
        let change = spring.along(&self.increment);
        let [elastic, slope] = spring.law.quotient(spring.along(&self.displacement), change);
        let lag = spring.damping / self.h;
        let (force, slope) = (elastic + lag * change, slope + lag);
        GroundSpringState { force, slope, change, factored: self.springs[k].factored }
    }

    /// Forces of the springs, and their tangent if `TANGENT`.
    #[inline(always)]
    pub fn push_springs<const TANGENT: bool>(&mut self) {
        for k in 0..self.springs.len() {
            let state = self.see_spring(k);
            self.springs[k] = state;
            let spring = &self.numbers.springs[k];
            let point = &spring.point;
            point.spread(scale(state.force, spring.direction), &mut self.residual);
            if TANGENT {
                let row = row(&point.shape, &spring.direction);
                self.tangent.add_square(point.node, &row, state.slope);
            }
        }
    }

    /// Copies the slopes of the last assembled tangent to those of the factors in use, in the given lanes.
    #[inline(always)]
    pub fn factor_springs(&mut self, which: S::Mask) {
        for state in &mut self.springs {
            state.factored = S::choose(which, state.slope, state.factored);
        }
    }

    /// Lanes in which the force of every spring agrees within an impulse of `small` with the one that the factors predicted for the correction: no
    /// spring has opened or closed.
    #[inline(always)]
    pub fn springs_foreseen(&self, small: S) -> S::Mask {
        let mut all = !small.less(small);
        for (k, before) in self.springs.iter().enumerate() {
            if self.numbers.springs[k].law.is_one_sided() {
                let now = self.see_spring(k);
                let foreseen = before.force + before.factored * (now.change - before.change);
                all = all & ((now.force - foreseen) * self.h).abs().at_most(small);
            }
        }
        all
    }

    /// Energy of the springs \[J\].
    #[inline(always)]
    pub fn spring_energy(&self) -> S {
        let zero = self.h.constant(0.0);
        let each = self.numbers.springs.iter();
        each.fold(zero, |sum, s| sum + s.law.energy(s.along(&self.displacement)))
    }

    /// Enters the impulses of the ground and the losses of the dampers over the step.
    #[inline(always)]
    pub fn enter_springs(&self, ledger: &mut Ledger<S>) {
        let (u, d) = (&self.displacement, &self.increment);
        for (k, spring) in self.numbers.springs.iter().enumerate() {
            let state = self.see_spring(k);
            ledger.loss_damping += spring.damping / self.h * state.change * state.change;
            let [x, _] = spring.point.middle(u, d);
            let force = scale(-state.force, spring.direction);
            ledger.react(self.h, x, force, self.h.constant(0.0));
        }
    }
}
