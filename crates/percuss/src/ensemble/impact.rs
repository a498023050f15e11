//! Impulses of a rigid projectile, and the impact interval they act in.

use super::engine::Engine;
use crate::scalar::Number;

impl<S: Number> Engine<S> {
    /// Gap of a guided projectile and its rate at the end of the step solved last.
    pub fn gap_next(&self, k: usize) -> [S; 2] {
        let state = &self.guides[k];
        [state.gap + state.gap_change, state.gap_change * 2.0 / self.h - state.rate]
    }

    /// Adds to the correction what the impulse of the projectile that strikes changes: with it the gap opens at the rate that
    /// Newton's law asks for.
    pub fn strike(&mut self, k: usize) {
        let (correction, guides) = (self.correction.clone(), self.guides.clone());
        let moved = self.numbers.guides[k].along(&correction) - guides[k].correction;
        let opening = self.answer(k);
        let state = &self.guides[k];
        // Impulse over the step, rate at its end.
        let twice = self.h.recip() * 2.0;
        let free = (state.gap_change + moved) * twice - state.rate;
        let wanted = -(self.numbers.guides[k].stiffness * state.rate);
        let impulse = state.impulse + (wanted - free) / (opening * twice / self.h);
        let impulse = impulse.max(impulse.constant(0.0));
        let force = (impulse - state.impulse) / self.h;
        self.guides[k].impulse = impulse;
        for (c, own) in self.correction.iter_mut().zip(&correction) {
            for i in 0..4 {
                c[i] = own[i] + c[i] * force;
            }
        }
        for (state, own) in self.guides.iter_mut().zip(&guides) {
            state.correction = own.correction + state.correction * force;
        }
    }

    /// The answer of the factored tangent to a unit force that opens a gap, left in the corrections; returns how far it opens.
    fn answer(&mut self, k: usize) -> S {
        let zero = self.h.constant(0.0);
        let guide = &self.numbers.guides[k];
        self.correction.fill([zero; 4]);
        for (i, c) in guide.row().iter().enumerate() {
            self.correction[guide.node + i / 4][i % 4] = *c;
        }
        Self::project(&self.numbers.prescribed, &mut self.correction);
        self.factors.solve(&mut self.correction);
        for (j, (guide, state)) in self.numbers.guides.iter().zip(&mut self.guides).enumerate() {
            let own = if j == k { zero.constant(-1.0) } else { zero };
            let moved = guide.along(&self.correction);
            let [slope, inertia] = state.factored;
            state.correction = (slope * moved + own) / inertia;
        }
        let guide = &self.numbers.guides[k];
        guide.along(&self.correction) - self.guides[k].correction
    }
}
