//! Plastic flow of a fibre with viscous overstress.

use super::law::{FibreState, FibreStep, Hardening, Overstress, PlasticLaw};
use crate::scalar::{Mask, Number, Task};

/// Corrections of the root for viscous flow, which converges in about five, and the relative size of the last one; the balance does not depend on it.
const MOST_ROOTS: usize = 100;
const ROOT: f64 = 1e-14;
/// Corrections after which a root is found once its miss is round-off of its terms, too: one close to zero is known no better.
const ENOUGH: usize = 8;
/// Round-off of a sum of a few terms, relative to the largest.
const ROUND_OFF: f64 = 4.0 * f64::EPSILON;

/// See [`PlasticLaw::viscous`].
pub(super) struct Viscous<'a, S> {
    pub law: &'a PlasticLaw<S>,
    pub overstress: &'a Overstress<S>,
    pub state: &'a FibreState<S>,
    /// Strain at both ends of the step, shape (2) \[-\].
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
    /// With viscous overstress. The path is divided where it reaches the yield stress, as there is no flow before, and at every corner of the
    /// hardening curve: on each part the flow has a mean stress that is never less than the mean yield stress, and does not create energy.
    #[inline(always)]
    fn viscous(
        &self,
        overstress: &Overstress<S>,
        state: &FibreState<S>,
        [from, to]: [S; 2],
        h: S,
    ) -> FibreStep<S> {
        let (none, one) = (from.constant(0.0), from.constant(1.0));
        let start = self.young * (from - state.plastic);
        let back = self.plasticity.kinematic * state.plastic;
        let (first, last) = (start - back, self.young * (to - state.plastic) - back);
        let sign = last.if_less(none, -one, one);
        let limit = sign * self.plasticity.yield_stress(state.accumulated);
        let beyond = limit.abs().less(last.abs());
        let yields_from_rest = beyond & none.less((limit - first) * sign);
        let mut path = ViscousPath::new(self, overstress, state, ([from, to], sign, h));
        if yields_from_rest.any() {
            // The longer the path, the earlier.
            let share = S::choose(yields_from_rest, (limit - first) / (last - first), none);
            let cut = Cut { at: share, earlier: share / (to - from), stress: limit + back };
            path.go_on(yields_from_rest, &cut, none);
        }
        for (i, part) in self.plasticity.curve.iter().enumerate() {
            let goes_on = path.at.less(one);
            if !goes_on.any() {
                break;
            }
            let until = self.plasticity.end_of(i);
            let here = goes_on & path.state.accumulated.less(until);
            if here.any() {
                let last = i + 1 == self.plasticity.curve.len();
                path.flow_on(here, part, (!last).then_some(until));
            }
        }
        path.close()
    }
}

/// A place at which a path is cut.
struct Cut<S> {
    /// Share of the path.
    at: S,
    /// Derivative of the share with respect to the length of the path, negative.
    earlier: S,
    /// Stress there \[Pa\].
    stress: S,
}

/// A path with viscous overstress, gathered from parts on which the yield stress is a straight line; stress is taken as one on each.
///
/// The flow up to a division does not depend on the length of the path; its instant does.
struct ViscousPath<'a, S> {
    law: &'a PlasticLaw<S>,
    overstress: &'a Overstress<S>,
    /// Strain at both ends, shape (2) \[-\].
    ends: [S; 2],
    /// Sign of the flow.
    sign: S,
    /// Its duration \[s\].
    h: S,
    /// Completed share of the path, from 0 to 1, and its derivative with respect to the length of the path, negative.
    at: S,
    earlier: S,
    /// Stress there \[Pa\], and its derivative with respect to the strain at the end.
    stress: S,
    tangent: S,
    /// Integral of the stress over the path so far, and its derivative with respect to the strain at the end \[Pa\].
    mean: S,
    slope: S,
    state: FibreState<S>,
    dissipated: S,
}

impl<'a, S: Number> ViscousPath<'a, S> {
    #[inline(always)]
    fn new(
        law: &'a PlasticLaw<S>,
        overstress: &'a Overstress<S>,
        state: &FibreState<S>,
        (ends, sign, h): ([S; 2], S, S),
    ) -> Self {
        let none = h.constant(0.0);
        let stress = law.young * (ends[0] - state.plastic);
        Self {
            law,
            overstress,
            ends,
            sign,
            h,
            at: none,
            earlier: none,
            stress,
            tangent: none,
            mean: none,
            slope: none,
            state: *state,
            dissipated: none,
        }
    }

    /// Continues to a division, at which the stress has a derivative with respect to the strain at the end.
    #[inline(always)]
    fn go_on(&mut self, here: S::Mask, to: &Cut<S>, tangent: S) {
        let (share, mean) = (to.at - self.at, (self.stress + to.stress) * 0.5);
        let longer = self.earlier - to.earlier;
        let slope = longer * mean + share * (self.tangent + tangent) * 0.5;
        self.mean = S::choose(here, self.mean + share * mean, self.mean);
        self.slope = S::choose(here, self.slope + slope, self.slope);
        self.at = S::choose(here, to.at, self.at);
        self.earlier = S::choose(here, to.earlier, self.earlier);
        self.stress = S::choose(here, to.stress, self.stress);
        self.tangent = S::choose(here, tangent, self.tangent);
    }

    /// Continues along one part of the hardening curve: to its end, if the path extends to it.
    #[inline(always)]
    fn flow_on(&mut self, here: S::Mask, part: &Hardening<S>, until: Option<S>) {
        let (none, one) = (self.h.constant(0.0), self.h.constant(1.0));
        let (young, kinematic) = (self.law.young, self.law.plasticity.kinematic);
        let (sign, [from, to]) = (self.sign, self.ends);
        let before = self.state;
        let trial = young * (to - before.plastic) - kinematic * before.plastic;
        let line = FlowLine {
            law: self.overstress,
            stiffness: young + kinematic,
            part,
            accumulated: before.accumulated,
            until,
        };
        let rest = (one - self.at) * self.h;
        let (mut flow, [by_stress, by_time], crosses) = line.flow(here, sign * trial, rest);
        let mut end = Cut { at: one, earlier: none, stress: none };
        let mut tangent = young * (one - young * by_stress);
        tangent = tangent - young * sign * by_time * self.h * self.earlier;
        let mut strain = to;
        let relative = sign * (self.stress - kinematic * before.plastic);
        if let Some(until) = until.filter(|_| crosses.any()) {
            let length = to - from;
            let way = [relative, sign * young * length, self.h, one - self.at];
            let [share, slope, held] = line.corner(crosses, way);
            let at = self.at + share;
            let earlier = (held * self.earlier + sign * young * at) / slope;
            end.at = S::choose(crosses, at, end.at);
            end.earlier = S::choose(crosses, earlier, end.earlier);
            flow = S::choose(crosses, until - before.accumulated, flow);
            strain = S::choose(crosses, from + at * length, strain);
            tangent = S::choose(crosses, young * (at - length * earlier), tangent);
        }
        let mut after = before;
        after.plastic += sign * flow;
        after.accumulated += flow;
        if let Some(until) = until {
            after.accumulated = S::choose(crosses, until, after.accumulated);
        }
        end.stress = young * (strain - after.plastic);
        let over = [
            relative - line.limit(before.accumulated),
            sign * (end.stress - kinematic * after.plastic) - line.limit(after.accumulated),
        ];
        let first = self.law.plasticity.curve[0].stress;
        let dissipated = flow * (first + (over[0] + over[1]) * 0.5);
        let dissipated = S::choose(here & none.less(flow), dissipated, none);
        self.dissipated += dissipated;
        self.state.plastic = S::choose(here, after.plastic, before.plastic);
        self.state.accumulated = S::choose(here, after.accumulated, before.accumulated);
        self.go_on(here, &end, tangent);
    }

    #[inline(always)]
    fn close(mut self) -> FibreStep<S> {
        self.state.dissipated += self.dissipated;
        let Self { mean, slope, stress, tangent, state, dissipated, .. } = self;
        FibreStep { mean, slope, stress, tangent, state, dissipated }
    }
}

/// Viscous flow while the yield stress is a straight line over accumulated plastic strain.
struct FlowLine<'a, S> {
    law: &'a Overstress<S>,
    /// Fall of the relative stress per plastic strain \[Pa\].
    stiffness: S,
    part: &'a Hardening<S>,
    /// Accumulated plastic strain at the start \[-\].
    accumulated: S,
    /// End of the line, if the path extends to it.
    until: Option<S>,
}

impl<S: Number> FlowLine<'_, S> {
    /// Yield stress at an accumulated plastic strain \[Pa\].
    #[inline(always)]
    fn limit(&self, accumulated: S) -> S {
        self.part.stress + self.part.modulus * (accumulated - self.part.from)
    }

    /// Plastic flow in a time h from the relative stress at its end without flow, its derivatives with respect to that stress and to h,
    /// and whether the line ends before: the root z of `xi - (E + Hk) h C z^q - Y (1 + z)`, of which the flow is `h C z^q`.
    #[inline(always)]
    fn flow(&self, here: S::Mask, relative: S, h: S) -> (S, [S; 2], S::Mask) {
        let (none, one) = (h.constant(0.0), h.constant(1.0));
        let (initial, most) = (self.limit(self.accumulated), self.law.rate * h);
        let mut lowest = initial.max(none.constant(f64::MIN_POSITIVE));
        let mut flows = here & none.less(relative - initial) & none.less(h);
        let mut crosses = none.less(none);
        if let Some(until) = self.until {
            let (left, corner) = (until - self.accumulated, self.limit(until));
            let z = (S::choose(flows, left / most, one)).powf(one / self.law.exponent);
            crosses = flows & none.less(relative - self.stiffness * left - corner * (one + z));
            flows = flows & !crosses;
            lowest = corner.if_less(lowest, corner, lowest);
        }
        if !flows.any() {
            return (none, [none; 2], crosses);
        }
        // From above; the function is concave there.
        let over = relative - lowest;
        let free = (over / (self.stiffness * most)).powf(one / self.law.exponent);
        let stiff = over / lowest;
        let mut search =
            RootSearch::up_to(S::choose(flows, stiff.if_less(free, stiff, free), one), flows);
        let whole = whole(self.law.exponent);
        for k in 0..MOST_ROOTS {
            let z = search.at;
            let flow = most * power(z, self.law.exponent, whole);
            let limit = self.limit(self.accumulated + flow);
            let rate = self.law.exponent * flow / z;
            let left = relative - self.stiffness * flow - limit * (one + z);
            let slope = -((self.stiffness + self.part.modulus * (one + z)) * rate + limit);
            let round_off = round_off(k, relative, slope);
            if search.is_found_after(left / slope, none.less(left), round_off) {
                break;
            }
        }
        let z = search.at;
        let flows = flows & none.less(z);
        let found = most * power(z, self.law.exponent, whole);
        let limit = self.limit(self.accumulated + found);
        let per_flow = z / (self.law.exponent * found);
        let hardens = self.part.modulus * (one + z);
        let by_stress = one / (self.stiffness + hardens + limit * per_flow);
        let by_time = by_stress * limit * z / (self.law.exponent * h);
        let by_stress = S::choose(flows, by_stress, none);
        let by_time = S::choose(flows, by_time, none);
        (S::choose(flows, found, none), [by_stress, by_time], crosses)
    }

    /// Share x of a path at the end of the line, the root of `xi + rise x - (E + Hk) flow - Y (1 + z)` with `flow = h x C z^q` known, from the
    /// relative stress xi at the start of the line, its rise and the time over all of the path, and the rest of the path; with the derivative at
    /// the root, and its part by the time.
    #[inline(always)]
    fn corner(&self, crosses: S::Mask, [relative, rise, h, rest]: [S; 4]) -> [S; 3] {
        let (none, one) = (h.constant(0.0), h.constant(1.0));
        let Some(until) = self.until else { return [none; 3] };
        let (left, limit) = (until - self.accumulated, self.limit(until));
        let fallen = relative - self.stiffness * left;
        let most = S::choose(crosses, left / (self.law.rate * h), one);
        let mut search = RootSearch::up_to(S::choose(crosses, rest, one), crosses);
        let mut held = none;
        let mut slope = one;
        for k in 0..MOST_ROOTS {
            let x = search.at;
            let z = (most / x).powf(one / self.law.exponent);
            held = limit * z / (self.law.exponent * x);
            slope = rise + held;
            let miss = fallen + rise * x - limit * (one + z);
            let round_off = round_off(k, limit * (one + z), slope);
            if search.is_found_after(miss / slope, !none.less(miss), round_off) {
                break;
            }
        }
        [search.at, slope, held]
    }
}

/// Newton's iteration for a positive root in an interval, halved where a correction leaves it.
struct RootSearch<S: Number> {
    low: S,
    high: S,
    /// The current value, which begins at the upper end.
    at: S,
    seeking: S::Mask,
}

impl<S: Number> RootSearch<S> {
    /// Between zero and `high`, in the lanes of the mask.
    #[inline(always)]
    fn up_to(high: S, seeking: S::Mask) -> Self {
        Self { low: high.constant(0.0), high, at: high, seeking }
    }

    /// Subtracts a correction; `above` says where the root is above the current value, `round_off` how well it can be known. Whether it is found in all
    /// lanes.
    #[inline(always)]
    fn is_found_after(&mut self, change: S, above: S::Mask, round_off: S) -> bool {
        let at = self.at;
        let found = change.abs().at_most((at * ROOT).max(round_off));
        if S::DERIVES && found.any() {
            self.at = at - change; // of which the derivatives are those of the root
        }
        self.seeking = self.seeking & !found;
        if !self.seeking.any() {
            return true;
        }
        let at = self.at;
        self.low = S::choose(above, at, self.low);
        self.high = S::choose(above, self.high, at);
        let next = at - change;
        let within = self.low.less(next) & next.less(self.high);
        let middle = (self.low + self.high) * 0.5;
        self.at = S::choose(self.seeking, S::choose(within, next, middle), at);
        false
    }
}

/// Round-off of a root, from the largest term of its equation and the slope there; none in the first corrections.
#[inline(always)]
fn round_off<S: Number>(corrections: usize, term: S, slope: S) -> S {
    match corrections < ENOUGH {
        true => term.constant(0.0),
        false => (term / slope).abs() * ROUND_OFF,
    }
}

/// Largest exponent of a power that products make faster than logarithms.
const MOST_FACTORS: u32 = 16;

/// An exponent that is the same small whole number in all lanes, as for most metals; `None` if derivatives are needed.
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
