//! Plastic flow of a fibre, independent of rate.

use super::law::{FibreState, FibreStep, PlasticLaw, Plasticity};
use super::path::StressPath;
use crate::scalar::{Mask, Number};

impl Plasticity {
    /// Yield stress of the virgin material \[Pa\].
    pub fn first_yield(&self) -> f64 {
        self.curve[0].stress
    }

    /// The yield stress, if it changes neither with strain nor with its rate \[Pa\].
    pub fn plateau(&self) -> Option<f64> {
        let flat = self.curve.iter().all(|part| part.modulus == 0.0)
            && self.kinematic == 0.0
            && self.overstress.is_none();
        flat.then(|| self.first_yield())
    }
}

impl<S: Number> Plasticity<S> {
    /// Yield stress at an accumulated plastic strain and its slope there, shape (2) \[Pa\].
    #[inline(always)]
    fn limit(&self, accumulated: S) -> [S; 2] {
        let mut part = self.curve[0];
        for next in &self.curve[1..] {
            let reached = next.from.at_most(accumulated);
            if !reached.any() {
                break;
            }
            part.from = S::choose(reached, next.from, part.from);
            part.stress = S::choose(reached, next.stress, part.stress);
            part.modulus = S::choose(reached, next.modulus, part.modulus);
        }
        [part.stress + part.modulus * (accumulated - part.from), part.modulus]
    }

    /// Yield stress at an accumulated plastic strain \[Pa\].
    #[inline(always)]
    pub fn yield_stress(&self, accumulated: S) -> S {
        self.limit(accumulated)[0]
    }

    /// End of the part of the given number.
    #[inline(always)]
    pub(super) fn end_of(&self, part: usize) -> S {
        match self.curve.get(part + 1) {
            Some(next) => next.from,
            None => self.curve[0].from.constant(f64::INFINITY),
        }
    }

    /// Energy per volume that hardening has stored: `int (Y - Y0) dalpha + Hk p^2 / 2`.
    #[inline(always)]
    pub(super) fn stored(&self, state: &FibreState<S>) -> S {
        let none = state.plastic.constant(0.0);
        let mut isotropic = none;
        for (i, part) in self.curve.iter().enumerate() {
            let end = self.end_of(i);
            let length = state.accumulated.if_less(end, state.accumulated, end) - part.from;
            let reached = none.less(length);
            if !reached.any() {
                break;
            }
            let above = part.stress - self.curve[0].stress;
            let stored = (above + part.modulus * length * 0.5) * length;
            isotropic += S::choose(reached, stored, none);
        }
        isotropic + self.kinematic * state.plastic * state.plastic * 0.5
    }
}

/// Stresses this close to the yield limit are on it, relative: the stress of a stiff fibre is not more accurate.
const ON_LIMIT: f64 = 1e-6;

impl PlasticLaw {
    /// See [`super::StressLaw::loading_tangent`].
    pub(super) fn loading_tangent(&self, end: &FibreStep) -> f64 {
        let relative = end.stress - self.plasticity.kinematic * end.state.plastic;
        let [limit, slope] = self.plasticity.limit(end.state.accumulated);
        if end.state.accumulated == 0.0 || relative.abs() < (1.0 - ON_LIMIT) * limit {
            return end.tangent;
        }
        let modulus = slope + self.plasticity.kinematic;
        self.young * modulus / (self.young + modulus)
    }
}

impl<S: Number> PlasticLaw<S> {
    /// Whether a fibre gapes at a strain.
    #[inline(always)]
    pub(super) fn gapes(&self, state: &FibreState<S>, strain: S) -> S::Mask {
        match self.slack {
            Some(slack) => slack.frees(strain - state.plastic),
            None => strain.less(strain),
        }
    }

    /// Independent of rate: without stress while it gapes, elastic up to the yield stress, then along the hardening curve.
    #[inline(always)]
    pub(super) fn path(&self, state: &FibreState<S>, from: S, to: S) -> FibreStep<S> {
        let (young, none) = (self.young, from.constant(0.0));
        let one = from.constant(1.0);
        let elastic = young * (from - state.plastic);
        let mut path = StressPath::new(elastic, to - from);
        let (mut modulus, mut carries_force) = (young, none.at_most(none));
        if self.slack.is_some() {
            let (gaped, gapes) = (self.gapes(state, from), self.gapes(state, to));
            path.start = S::choose(gaped, none, elastic);
            let before = S::choose(gaped, none, young);
            path.cross(gaped, gapes, before, state.plastic - from);
            (modulus, carries_force) = (S::choose(gapes, none, young), !gapes);
        }
        let back = self.plasticity.kinematic * state.plastic;
        let trial = young * (to - state.plastic) - back;
        let limit = self.plasticity.yield_stress(state.accumulated);
        let flows = limit.less(trial.abs()) & carries_force;
        if !flows.any() {
            path.go_on(modulus, one);
            return FibreStep::without_flow(path, state);
        }
        let sign = none.if_less(trial, one, -one);
        let reach = path.at + (sign * limit + back - path.start) / (young * path.length);
        let reach = reach.max(none);
        path.go_on(modulus, S::choose(flows, reach.if_less(one, reach, one), one));
        self.flow_on(path, state, sign)
    }

    /// Continues to the end of a path along the hardening curve, part after part; a fibre that is already at the end does not change.
    #[inline(always)]
    fn flow_on(&self, mut path: StressPath<S>, state: &FibreState<S>, sign: S) -> FibreStep<S> {
        let (one, length) = (sign.constant(1.0), path.length.abs());
        let (mut end, mut flowed) = (*state, sign.constant(0.0));
        for (i, part) in self.plasticity.curve.iter().enumerate() {
            let goes_on = path.at.less(one);
            if !goes_on.any() {
                break;
            }
            let until = self.plasticity.end_of(i);
            let here = goes_on & end.accumulated.less(until);
            if !here.any() {
                continue;
            }
            let modulus = part.modulus + self.plasticity.kinematic;
            // Plastic strain per strain.
            let share = self.young / (self.young + modulus);
            let rest = (one - path.at) * length;
            let left = until - end.accumulated;
            let ends = (share * rest).at_most(left);
            let gained = S::choose(here, S::choose(ends, share * rest, left), sign.constant(0.0));
            let mut to = one;
            if (here & !ends).any() {
                let next = path.at + left / (share * length);
                to = S::choose(ends, one, next.if_less(one, next, one));
            }
            let tangent = S::choose(here, share * modulus, path.modulus);
            path.go_on(tangent, S::choose(here, to, path.at));
            flowed += gained;
            end.plastic += sign * gained;
            let accumulated = S::choose(ends, end.accumulated + gained, until);
            end.accumulated = S::choose(here, accumulated, end.accumulated);
        }
        let dissipated = self.plasticity.curve[0].stress * flowed;
        end.dissipated += dissipated;
        FibreStep { state: end, dissipated, ..FibreStep::without_flow(path, state) }
    }
}
