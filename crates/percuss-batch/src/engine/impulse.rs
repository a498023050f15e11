//! Impulses of a rigid projectile in a step: the rate of its gap has a lower bound.

use super::Engine;
use crate::impact::Press;
use percuss::internals::scalar::{Mask, Number};
use percuss::internals::step::projection::project_held;

impl<S: Number> Engine<S> {
    /// Gap of a guided projectile and its rate at the end of the step solved last.
    #[inline(always)]
    pub fn gap_next(&self, k: usize) -> [S; 2] {
        let state = &self.guides[k];
        [state.gap + state.gap_change, state.gap_change * 2.0 / self.h - state.rate]
    }

    /// Solution of the factored tangent for a unit force that opens a gap, stored in the corrections; returns the opening.
    #[inline(always)]
    fn answer(&mut self, k: usize) -> S {
        let zero = self.h.constant(0.0);
        let guide = &self.numbers.guides[k];
        self.correction.fill([zero; 4]);
        for (i, c) in guide.row().iter().enumerate() {
            self.correction[guide.node + i / 4][i % 4] = *c;
        }
        project_held(&self.numbers.prescribed, &mut self.correction);
        self.solve_constrained(false);
        for (j, (guide, state)) in self.numbers.guides.iter().zip(&mut self.guides).enumerate() {
            let own = if j == k { zero.constant(-1.0) } else { zero };
            let moved = guide.along(&self.correction);
            let [slope, inertia] = state.factored;
            state.correction = (slope * moved + own) / inertia;
        }
        let guide = &self.numbers.guides[k];
        guide.along(&self.correction) - self.guides[k].correction
    }

    /// Adds the effect of the contact impulse to the corrections of the lanes that iterate: the rate of the gap is not below the bound, and equals
    /// it where the contact presses.
    #[inline(always)]
    pub fn press(&mut self, seeking: S::Mask) {
        let Some(mut press) = self.press.take() else { return };
        let which = press.which & seeking;
        if which.any() {
            if !press.known {
                self.find_answer(&mut press);
            }
            self.add_impulse(&press, which);
        }
        self.press = Some(press);
    }

    /// Response of the factors in use to a unit force; the corrections do not change.
    #[inline(always)]
    fn find_answer(&mut self, press: &mut Press<S>) {
        std::mem::swap(&mut self.correction, &mut press.nodal);
        for (way, state) in press.ways.iter_mut().zip(&self.guides) {
            *way = state.correction;
        }
        for (mine, change) in press.multipliers.iter_mut().zip(self.constraints.corrections()) {
            *mine = *change;
        }
        press.opening = self.answer(press.guide);
        std::mem::swap(&mut self.correction, &mut press.nodal);
        for (way, state) in press.ways.iter_mut().zip(&mut self.guides) {
            std::mem::swap(way, &mut state.correction);
        }
        for (mine, change) in press.multipliers.iter_mut().zip(self.constraints.corrections()) {
            std::mem::swap(mine, change);
        }
        press.known = true;
    }

    /// Marks the response as outdated after a new factorisation.
    #[inline(always)]
    pub fn forget_answer(&mut self) {
        if let Some(press) = &mut self.press {
            press.known = false;
        }
    }

    #[inline(always)]
    fn add_impulse(&mut self, press: &Press<S>, which: S::Mask) {
        let (k, twice) = (press.guide, self.h.recip() * 2.0);
        let (guide, state) = (&self.numbers.guides[k], &self.guides[k]);
        let moved = guide.along(&self.correction) - state.correction;
        let free = (state.gap_change + moved) * twice - state.rate;
        let impulse = state.impulse + (press.bound - free) / (press.opening * twice / self.h);
        let impulse = impulse.max(impulse.constant(0.0));
        let force = (impulse - state.impulse) / self.h;
        self.guides[k].impulse = S::choose(which, impulse, state.impulse);
        for (c, answer) in self.correction.iter_mut().zip(&press.nodal) {
            for i in 0..4 {
                c[i] = S::choose(which, c[i].add_product(answer[i], force), c[i]);
            }
        }
        for (state, way) in self.guides.iter_mut().zip(&press.ways) {
            let own = state.correction;
            state.correction = S::choose(which, own.add_product(*way, force), own);
        }
        for (change, answer) in self.constraints.corrections().zip(&press.multipliers) {
            *change = S::choose(which, change.add_product(*answer, force), *change);
        }
    }
}
