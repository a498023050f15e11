//! Plastic flow of a fibre, independent of rate or with viscous overstress.

use super::{FibreState, FibreStep, Overstress, PlasticLaw, Plasticity, StressPath};
use crate::scalar::{Mask, Number, Task};

impl Plasticity {
    /// Yield stress of the virgin material \[Pa\].
    pub fn first_yield(&self) -> f64 {
        self.curve[0].stress
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

    /// Where the part of the given number ends.
    #[inline(always)]
    fn end_of(&self, part: usize) -> S {
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

/// Corrections of the root that viscous flow follows from, which converges in some five, and the last of them, relative; the balance
/// does not depend on it.
const MOST_ROOTS: usize = 100;
const ROOT: f64 = 1e-14;

/// A path with viscous overstress.
struct Overstressed<S> {
    step: FibreStep<S>,
    /// Derivative of the stress at the end with respect to the time it takes \[Pa/s\].
    stress_by_time: S,
}

/// Stresses this close to the limit at which a fibre yields are on it, relative: what is stiff knows its stress to no more digits.
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

/// See [`PlasticLaw::viscous`].
pub(super) struct Viscous<'a, S> {
    pub law: &'a PlasticLaw<S>,
    pub overstress: &'a Overstress<S>,
    pub state: &'a FibreState<S>,
    /// Strain at both ends of the step, shape (2) \[1\].
    pub ends: [S; 2],
    /// Size of the step \[s\].
    pub h: S,
}

impl<S: Number> Task for Viscous<'_, S> {
    type Output = FibreStep<S>;
    #[inline(always)]
    fn run(self) -> FibreStep<S> {
        self.law.viscous(self.overstress, self.state, self.ends, self.h)
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
        let (mut modulus, mut bears) = (young, none.at_most(none));
        if self.slack.is_some() {
            let (gaped, gapes) = (self.gapes(state, from), self.gapes(state, to));
            path.start = S::choose(gaped, none, elastic);
            let before = S::choose(gaped, none, young);
            path.cross(gaped, gapes, before, state.plastic - from);
            (modulus, bears) = (S::choose(gapes, none, young), !gapes);
        }
        let back = self.plasticity.kinematic * state.plastic;
        let trial = young * (to - state.plastic) - back;
        let limit = self.plasticity.yield_stress(state.accumulated);
        let flows = limit.less(trial.abs()) & bears;
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

    /// Goes on to the end of a path along the hardening curve, part after part; what is at the end already stays there.
    #[inline(always)]
    fn flow_on(&self, mut path: StressPath<S>, state: &FibreState<S>, sign: S) -> FibreStep<S> {
        let (one, length) = (sign.constant(1.0), path.length.abs());
        let (mut end, mut flowed) = (*state, sign.constant(0.0));
        for (i, part) in self.plasticity.curve.iter().enumerate() {
            let until = self.plasticity.end_of(i);
            let here = path.at.less(one) & end.accumulated.less(until);
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

    /// With viscous overstress; the path is cut where it reaches the yield stress, as nothing flows before: what flows then does so
    /// under a relative stress that is never less than the yield stress, and gives no energy.
    #[inline(always)]
    fn viscous(
        &self,
        overstress: &Overstress<S>,
        state: &FibreState<S>,
        [from, to]: [S; 2],
        h: S,
    ) -> FibreStep<S> {
        let (none, one) = (from.constant(0.0), from.constant(1.0));
        let (start, length) = (self.young * (from - state.plastic), to - from);
        let back = self.plasticity.kinematic * state.plastic;
        let (first, last) = (start - back, self.young * (to - state.plastic) - back);
        let sign = last.if_less(none, -one, one);
        let limit = sign * self.plasticity.yield_stress(state.accumulated);
        let beyond = limit.abs().less(last.abs());
        let yields_from_rest = beyond & none.less((limit - first) * sign);
        if !yields_from_rest.any() {
            return self.overstressed(overstress, state, ([from, to], h)).step;
        }
        // The others are cut at their start.
        let share = S::choose(yields_from_rest, (limit - first) / (last - first), none);
        let middle = from + share * length;
        let elastic = (start + limit + back) * 0.5;
        let rest = one - share;
        let flows = self.overstressed(overstress, state, ([middle, to], rest * h));
        // The part that flows takes longer where the path does.
        let longer = S::choose(yields_from_rest, flows.stress_by_time * share * h / length, none);
        let tangent = flows.step.tangent + longer;
        let mean = share * elastic + rest * flows.step.mean;
        // d(s De)/de1 = s2 + De2 ds2/de1.
        let work = flows.step.mean + rest * length * tangent * 0.5;
        let slope = S::choose(yields_from_rest, (work - mean) / length, flows.step.slope);
        FibreStep { mean, slope, tangent, ..flows.step }
    }

    /// A path beyond yield, or one within: the overstress at its end makes it flow.
    #[inline(always)]
    fn overstressed(
        &self,
        law: &Overstress<S>,
        state: &FibreState<S>,
        ([from, to], h): ([S; 2], S),
    ) -> Overstressed<S> {
        let (young, none) = (self.young, from.constant(0.0));
        let one = from.constant(1.0);
        let start = young * (from - state.plastic);
        let trial = young * (to - state.plastic);
        let relative = trial - self.plasticity.kinematic * state.plastic;
        let (flow, [slope, by_time]) = self.flow(law, state.accumulated, relative.abs(), h);
        let sign = relative.if_less(none, -one, one);
        let mut end = *state;
        end.plastic += sign * flow;
        end.accumulated += flow;
        let stress = young * (to - end.plastic);
        let tangent = young * (one - young * slope);
        let mean = (start + stress) * 0.5;
        let stored = self.plasticity.stored(&end) - self.plasticity.stored(state);
        let dissipated = S::choose(none.less(flow), mean * sign * flow - stored, none);
        end.dissipated += dissipated;
        let slope = tangent * 0.5;
        let step = FibreStep { mean, slope, stress, tangent, state: end, dissipated };
        Overstressed { step, stress_by_time: -(young * sign * by_time) }
    }

    /// Plastic flow in a step of size `h` from the relative stress at its end without flow, and its derivatives with respect to that
    /// stress and to h: the root z of `|xi| - (E + Hk) h C z^q - Y (1 + z)`, of which the flow is `h C z^q`.
    #[inline(always)]
    fn flow(&self, law: &Overstress<S>, accumulated: S, relative: S, h: S) -> (S, [S; 2]) {
        let (none, one) = (h.constant(0.0), h.constant(1.0));
        let initial = self.plasticity.yield_stress(accumulated);
        let over = relative - initial;
        let flows = none.less(over) & none.less(h);
        if !flows.any() {
            return (none, [none; 2]);
        }
        let (stiffness, most) = (self.young + self.plasticity.kinematic, law.rate * h);
        let lowest = initial.max(none.constant(f64::MIN_POSITIVE));
        // From above; the function is concave there but for kinks of the hardening curve.
        let free = (over / (stiffness * most)).powf(one / law.exponent);
        let stiff = over / lowest;
        let mut high = S::choose(flows, stiff.if_less(free, stiff, free), one);
        let (mut low, mut z) = (none, high);
        let mut seeking = flows;
        let whole = whole(law.exponent);
        for _ in 0..MOST_ROOTS {
            let flow = most * power(z, law.exponent, whole);
            let [limit, modulus] = self.plasticity.limit(accumulated + flow);
            let rate = law.exponent * flow / z;
            let left = relative - stiffness * flow - limit * (one + z);
            let slope = -((stiffness + modulus * (one + z)) * rate + limit);
            let change = left / slope;
            let found = change.abs().at_most(z * ROOT);
            if S::DERIVES && found.any() {
                z = z - change; // of which the derivatives are those of the root
            }
            seeking = seeking & !found;
            if !seeking.any() {
                break;
            }
            let above = none.less(left);
            low = S::choose(above, z, low);
            high = S::choose(above, high, z);
            let next = z - change;
            let within = low.less(next) & next.less(high);
            z = S::choose(seeking, S::choose(within, next, (low + high) * 0.5), z);
        }
        let flows = flows & none.less(z);
        let found = most * power(z, law.exponent, whole);
        let [limit, modulus] = self.plasticity.limit(accumulated + found);
        let per_flow = z / (law.exponent * found);
        let by_stress = one / (stiffness + modulus * (one + z) + limit * per_flow);
        let by_time = by_stress * limit * z / (law.exponent * h);
        let by_stress = S::choose(flows, by_stress, none);
        (S::choose(flows, found, none), [by_stress, S::choose(flows, by_time, none)])
    }
}

/// Largest exponent of a power that products make faster than logarithms.
const MOST_FACTORS: u32 = 16;

/// An exponent that is one small whole number in all lanes, as that of most metals; none where derivatives are wanted.
#[inline(always)]
fn whole<S: Number>(exponent: S) -> Option<u32> {
    let first = exponent.lane(0);
    let other = !exponent.equals(exponent.constant(first));
    let small = (1.0..=f64::from(MOST_FACTORS)).contains(&first) && first.fract() == 0.0;
    (!S::DERIVES && small && !other.any()).then_some(first as u32)
}

/// `base^exponent` of a positive base.
#[inline(always)]
fn power<S: Number>(base: S, exponent: S, whole: Option<u32>) -> S {
    let Some(whole) = whole else { return base.powf(exponent) };
    let (mut product, mut square, mut left) = (base.constant(1.0), base, whole);
    while left > 0 {
        if left % 2 == 1 {
            product = product * square;
        }
        square = square * square;
        left /= 2;
    }
    product
}
