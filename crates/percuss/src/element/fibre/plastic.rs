//! Plastic flow of a fibre, independent of rate or with viscous overstress.

use super::{FibreState, FibreStep, Hardening, Overstress, PlasticLaw, Plasticity, StressPath};

impl Plasticity {
    /// The part of the hardening curve at an accumulated plastic strain, and where it ends.
    fn part(&self, accumulated: f64) -> (&Hardening, f64) {
        let next = self.curve.partition_point(|p| p.from <= accumulated).max(1);
        let end = self.curve.get(next).map_or(f64::INFINITY, |p| p.from);
        (&self.curve[next - 1], end)
    }

    /// Yield stress at an accumulated plastic strain \[Pa\].
    pub fn yield_stress(&self, accumulated: f64) -> f64 {
        let (part, _) = self.part(accumulated);
        part.stress + part.modulus * (accumulated - part.from)
    }

    /// Yield stress of the virgin material \[Pa\].
    pub fn first_yield(&self) -> f64 {
        self.curve[0].stress
    }

    /// Energy per volume that hardening has stored: `int (Y - Y0) dalpha + Hk p^2 / 2`.
    pub(super) fn stored(&self, state: &FibreState) -> f64 {
        let mut isotropic = 0.0;
        for (i, part) in self.curve.iter().enumerate() {
            let end = self.curve.get(i + 1).map_or(f64::INFINITY, |p| p.from);
            let length = state.accumulated.min(end) - part.from;
            if length <= 0.0 {
                break;
            }
            let above = part.stress - self.first_yield();
            isotropic += (above + 0.5 * part.modulus * length) * length;
        }
        isotropic + 0.5 * self.kinematic * state.plastic.powi(2)
    }
}

/// Corrections of the root that viscous flow follows from, which converges in some five, and the last of them, relative; the balance
/// does not depend on it.
const MOST_ROOTS: usize = 100;
const ROOT: f64 = 1e-14;

/// A path with viscous overstress.
struct Overstressed {
    step: FibreStep,
    /// Derivative of the stress at the end with respect to the time it takes \[Pa/s\].
    stress_by_time: f64,
}

/// Stresses this close to the limit at which a fibre yields are on it, relative: what is stiff knows its stress to no more digits.
const ON_LIMIT: f64 = 1e-6;

impl PlasticLaw {
    /// See [`super::StressLaw::loading_tangent`].
    pub(super) fn loading_tangent(&self, end: &FibreStep) -> f64 {
        let relative = end.stress - self.plasticity.kinematic * end.state.plastic;
        let limit = self.plasticity.yield_stress(end.state.accumulated);
        if end.state.accumulated == 0.0 || relative.abs() < (1.0 - ON_LIMIT) * limit {
            return end.tangent;
        }
        let (part, _) = self.plasticity.part(end.state.accumulated);
        let modulus = part.modulus + self.plasticity.kinematic;
        self.young * modulus / (self.young + modulus)
    }

    /// Independent of rate: elastic up to the yield stress, then along the hardening curve.
    pub(super) fn path(&self, state: &FibreState, from: f64, to: f64) -> FibreStep {
        let young = self.young;
        let mut path = StressPath::new(young * (from - state.plastic), to - from);
        let back = self.plasticity.kinematic * state.plastic;
        let trial = young * (to - state.plastic) - back;
        let limit = self.plasticity.yield_stress(state.accumulated);
        if trial.abs() <= limit {
            path.go_on(young, 1.0);
            return FibreStep::without_flow(path, state);
        }
        let sign = trial.signum();
        let elastic = (sign * limit + back - path.start) / (young * path.length);
        path.go_on(young, elastic.clamp(0.0, 1.0));
        let (mut end, mut flowed) = (*state, 0.0);
        while path.at < 1.0 {
            let (part, until) = self.plasticity.part(end.accumulated);
            let modulus = part.modulus + self.plasticity.kinematic;
            let tangent = young * modulus / (young + modulus);
            // Plastic strain per strain.
            let flow = young / (young + modulus);
            let rest = (1.0 - path.at) * path.length.abs();
            let most = (until - end.accumulated) / flow;
            let (to, gained) = if rest <= most {
                (1.0, flow * rest)
            } else {
                ((path.at + most / path.length.abs()).min(1.0), until - end.accumulated)
            };
            path.go_on(tangent, to);
            flowed += gained;
            end.plastic += sign * gained;
            end.accumulated = if rest <= most { end.accumulated + gained } else { until };
        }
        let dissipated = self.plasticity.first_yield() * flowed;
        end.dissipated += dissipated;
        FibreStep { state: end, dissipated, ..FibreStep::without_flow(path, state) }
    }

    /// With viscous overstress; the path is cut where it reaches the yield stress, as nothing flows before: what flows then does so
    /// under a relative stress that is never less than the yield stress, and gives no energy.
    pub(super) fn viscous(
        &self,
        overstress: Overstress,
        state: &FibreState,
        from: f64,
        to: f64,
        h: f64,
    ) -> FibreStep {
        let (start, length) = (self.young * (from - state.plastic), to - from);
        let back = self.plasticity.kinematic * state.plastic;
        let (first, last) = (start - back, self.young * (to - state.plastic) - back);
        let limit = last.signum() * self.plasticity.yield_stress(state.accumulated);
        let yields_from_rest = last.abs() > limit.abs() && (limit - first) * last.signum() > 0.0;
        if !yields_from_rest {
            return self.overstressed(overstress, state, ([from, to], h)).step;
        }
        let share = (limit - first) / (last - first);
        let middle = from + share * length;
        let elastic = 0.5 * (start + limit + back);
        let rest = 1.0 - share;
        let flows = self.overstressed(overstress, state, ([middle, to], rest * h));
        // The part that flows takes longer where the path does.
        let longer = flows.stress_by_time * share * h / length;
        let tangent = flows.step.tangent + longer;
        let mean = share * elastic + rest * flows.step.mean;
        // d(s De)/de1 = s2 + De2 ds2/de1.
        let work = flows.step.mean + 0.5 * rest * length * tangent;
        FibreStep { mean, slope: (work - mean) / length, tangent, ..flows.step }
    }

    /// A path beyond yield, or one within: the overstress at its end makes it flow.
    fn overstressed(
        &self,
        law: Overstress,
        state: &FibreState,
        ([from, to], h): ([f64; 2], f64),
    ) -> Overstressed {
        let young = self.young;
        let start = young * (from - state.plastic);
        let trial = young * (to - state.plastic);
        let relative = trial - self.plasticity.kinematic * state.plastic;
        let (flow, [slope, by_time]) = self.flow(law, state.accumulated, relative.abs(), h);
        let sign = relative.signum();
        let mut end = *state;
        end.plastic += sign * flow;
        end.accumulated += flow;
        let stress = young * (to - end.plastic);
        let tangent = young * (1.0 - young * slope);
        let mean = 0.5 * (start + stress);
        let stored = self.plasticity.stored(&end) - self.plasticity.stored(state);
        let dissipated = if flow > 0.0 { mean * sign * flow - stored } else { 0.0 };
        end.dissipated += dissipated;
        let slope = 0.5 * tangent;
        let step = FibreStep { mean, slope, stress, tangent, state: end, dissipated };
        Overstressed { step, stress_by_time: -young * sign * by_time }
    }

    /// Plastic flow in a step of size `h` from the relative stress at its end without flow, and its derivatives with respect to that
    /// stress and to h: the root z of `|xi| - (E + Hk) h C z^q - Y (1 + z)`, of which the flow is `h C z^q`.
    fn flow(&self, law: Overstress, accumulated: f64, relative: f64, h: f64) -> (f64, [f64; 2]) {
        let over = relative - self.plasticity.yield_stress(accumulated);
        if over <= 0.0 || h <= 0.0 {
            return (0.0, [0.0; 2]);
        }
        let (stiffness, most) = (self.young + self.plasticity.kinematic, law.rate * h);
        let lowest = self.plasticity.yield_stress(accumulated).max(f64::MIN_POSITIVE);
        // From above; the function is concave there but for kinks of the hardening curve.
        let mut high = (over / lowest).min((over / (stiffness * most)).powf(1.0 / law.exponent));
        let (mut low, mut z) = (0.0, high);
        let yields = |flow: f64| {
            let at = accumulated + flow;
            (self.plasticity.yield_stress(at), self.plasticity.part(at).0.modulus)
        };
        for _ in 0..MOST_ROOTS {
            let flow = most * z.powf(law.exponent);
            let ((limit, modulus), rate) = (yields(flow), law.exponent * flow / z);
            let left = relative - stiffness * flow - limit * (1.0 + z);
            let slope = -(stiffness + modulus * (1.0 + z)) * rate - limit;
            let change = left / slope;
            if change.abs() <= ROOT * z {
                break;
            }
            *(if left > 0.0 { &mut low } else { &mut high }) = z;
            let next = z - change;
            z = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        if z <= 0.0 {
            return (0.0, [0.0; 2]);
        }
        let found = most * z.powf(law.exponent);
        let (limit, modulus) = yields(found);
        let per_flow = z / (law.exponent * found);
        let by_stress = 1.0 / (stiffness + modulus * (1.0 + z) + limit * per_flow);
        (found, [by_stress, by_stress * limit * z / (law.exponent * h)])
    }
}
