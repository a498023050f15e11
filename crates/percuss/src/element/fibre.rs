//! A fibre of a section that can yield: its stress over a step, and what it stores and dissipates.
//!
//! Strain runs straight from one end of a step to the other. The stress that does the step's work is its mean over that path,
//! `s = int sigma de / De`: then `s De` is the change of what the fibre stores plus what it dissipates, exactly, for a step of
//! any size. With the tangent modulus along the path, `Et(t)` for t from 0 to 1,
//!
//! `s = sigma0 + De int Et (1 - t) dt`, `ds/de1 = int Et t dt`, `sigma1 = sigma0 + De int Et dt`.

use serde::{Deserialize, Serialize};

/// A fibre: a part of a section in which strain and stress are uniform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibre {
    /// Height above the centre line, along the normal to the left of the beam's direction \[m\].
    pub height: f64,
    /// Area \[m^2\]; zero for one that only tells strain and stress at the surface.
    pub area: f64,
    /// Number of its law among those of the span.
    pub law: usize,
}

/// What a fibre remembers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FibreState {
    /// Plastic strain \[1\].
    pub plastic: f64,
    /// Accumulated plastic strain, the sum of the magnitudes of its increments \[1\].
    pub accumulated: f64,
    /// Energy dissipated so far, per volume \[J/m^3\].
    pub dissipated: f64,
    /// Whether it has failed: it bears nothing any more.
    pub failed: bool,
}

/// A straight part of a hardening curve: from here on the yield stress grows by `modulus` per accumulated plastic strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hardening {
    /// Accumulated plastic strain at which it begins \[1\].
    pub from: f64,
    /// Yield stress there \[Pa\].
    pub stress: f64,
    /// Isotropic plastic modulus, d(yield stress)/d(accumulated plastic strain) \[Pa\].
    pub modulus: f64,
}

/// Viscous overstress after Cowper and Symonds: accumulated plastic strain grows at the rate `C (|xi|/Y - 1)^q`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overstress {
    /// C \[1/s\].
    pub rate: f64,
    /// q.
    pub exponent: f64,
}

/// Which sign of stress a fibre cannot bear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slack {
    /// Tension.
    Tension,
    /// Compression.
    Compression,
}

/// How stress follows strain.
#[derive(Clone, Debug, PartialEq)]
pub enum StressLaw {
    /// In proportion.
    Elastic {
        /// Young's modulus \[Pa\].
        young: f64,
    },
    /// In proportion on one side, nothing on the other.
    OneSided {
        /// Young's modulus \[Pa\].
        young: f64,
        /// The side without stress.
        slack: Slack,
    },
    /// Elastic, then plastic.
    Plastic(PlasticLaw),
}

/// Yielding with isotropic and kinematic hardening, rate and failure.
#[derive(Clone, Debug, PartialEq)]
pub struct Plasticity {
    /// Parts of the curve of the yield stress over accumulated plastic strain, the first from zero on; the last goes on for ever.
    pub curve: Vec<Hardening>,
    /// Kinematic plastic modulus, d(back stress)/d(plastic strain) \[Pa\].
    pub kinematic: f64,
    /// Viscous overstress; without it stress does not depend on rates.
    pub overstress: Option<Overstress>,
    /// Magnitude of strain at which a fibre fails \[1\].
    pub failure_strain: Option<f64>,
}

/// What a material does beyond Hooke's law.
#[derive(Clone, Debug, PartialEq)]
pub enum Inelasticity {
    /// It bears no stress of one sign.
    OneSided(Slack),
    /// It yields.
    Plastic(Plasticity),
}

/// A linearly elastic material that yields.
#[derive(Clone, Debug, PartialEq)]
pub struct PlasticLaw {
    /// Young's modulus \[Pa\].
    pub young: f64,
    /// How it yields.
    pub plasticity: Plasticity,
}

/// A fibre over a step.
#[derive(Clone, Copy, Debug)]
pub struct FibreStep {
    /// Mean stress over the path \[Pa\].
    pub mean: f64,
    /// Its derivative with respect to the strain at the end \[Pa\].
    pub slope: f64,
    /// Stress at the end \[Pa\].
    pub stress: f64,
    /// Its derivative with respect to the strain at the end \[Pa\].
    pub tangent: f64,
    /// What it remembers at the end, failure apart.
    pub state: FibreState,
    /// Energy dissipated per volume \[J/m^3\].
    pub dissipated: f64,
}

impl StressLaw {
    /// That of a material.
    pub fn new(young: f64, inelasticity: Option<&Inelasticity>) -> Self {
        match inelasticity {
            None => Self::Elastic { young },
            Some(Inelasticity::OneSided(slack)) => Self::OneSided { young, slack: *slack },
            Some(Inelasticity::Plastic(plasticity)) => {
                Self::Plastic(PlasticLaw { young, plasticity: plasticity.clone() })
            }
        }
    }

    /// Young's modulus \[Pa\].
    pub fn young(&self) -> f64 {
        match self {
            Self::Elastic { young } | Self::OneSided { young, .. } => *young,
            Self::Plastic(law) => law.young,
        }
    }

    /// The fibre over a step of size `h` from strain `from` to `to`.
    #[inline]
    pub fn step(&self, state: &FibreState, from: f64, to: f64, h: f64) -> FibreStep {
        match self {
            _ if state.failed => FibreStep::without_flow(StressPath::new(0.0, 0.0), state),
            Self::Elastic { young } => {
                let mut path = StressPath::new(young * (from - state.plastic), to - from);
                path.go_on(*young, 1.0);
                FibreStep::without_flow(path, state)
            }
            Self::OneSided { young, slack } => one_sided(*young, *slack, [from, to], state),
            Self::Plastic(law) => match law.plasticity.overstress {
                Some(overstress) => law.viscous(overstress, state, from, to, h),
                None => law.path(state, from, to),
            },
        }
    }

    /// The fibre brought to a strain slowly: what it comes to does not depend on where it began.
    pub fn at_rest(&self, state: &FibreState, to: f64) -> FibreStep {
        match self {
            Self::Plastic(law) if !state.failed => {
                let back = law.plasticity.kinematic * state.plastic;
                law.path(state, state.plastic + back / law.young, to)
            }
            _ => self.step(state, 0.0, to, f64::INFINITY),
        }
    }

    /// Stress at a strain that the fibre has reached \[Pa\].
    pub fn stress(&self, state: &FibreState, strain: f64) -> f64 {
        match self {
            _ if state.failed => 0.0,
            Self::OneSided { young, slack: Slack::Tension } => young * strain.min(0.0),
            Self::OneSided { young, slack: Slack::Compression } => young * strain.max(0.0),
            _ => self.young() * (strain - state.plastic),
        }
    }

    /// Elastic energy per volume \[J/m^3\].
    pub fn elastic_energy(&self, state: &FibreState, strain: f64) -> f64 {
        0.5 * self.stress(state, strain).powi(2) / self.young()
    }

    /// Energy per volume that hardening has stored \[J/m^3\].
    pub fn hardening_energy(&self, state: &FibreState) -> f64 {
        match self {
            Self::Plastic(law) if !state.failed => law.plasticity.stored(state),
            _ => 0.0,
        }
    }

    /// Whether a fibre fails at this strain.
    pub fn fails(&self, strain: f64) -> bool {
        match self {
            Self::Plastic(law) => {
                law.plasticity.failure_strain.is_some_and(|limit| strain.abs() >= limit)
            }
            _ => false,
        }
    }
}

/// Stress along a straight path of strain, gathered from parts of constant tangent modulus.
struct StressPath {
    start: f64,
    length: f64,
    /// How far it has been gathered, from 0 to 1.
    at: f64,
    /// `int Et dt`, `int Et (1 - t) dt`, `int Et t dt`.
    sums: [f64; 3],
    /// Tangent modulus of the part gathered last.
    modulus: f64,
}

impl StressPath {
    fn new(start: f64, length: f64) -> Self {
        Self { start, length, at: 0.0, sums: [0.0; 3], modulus: 0.0 }
    }

    /// Goes on to the share `to` of the path with a tangent modulus.
    #[inline]
    fn go_on(&mut self, modulus: f64, to: f64) {
        let (share, middle) = (to - self.at, 0.5 * (self.at + to));
        self.sums[0] += modulus * share;
        self.sums[1] += modulus * share * (1.0 - middle);
        self.sums[2] += modulus * share * middle;
        (self.at, self.modulus) = (to, modulus);
    }

    /// Stress where it has been gathered to.
    fn stress(&self) -> f64 {
        self.start + self.length * self.sums[0]
    }
}

impl FibreStep {
    /// Without plastic flow.
    #[inline]
    fn without_flow(path: StressPath, state: &FibreState) -> Self {
        Self {
            mean: path.start + path.length * path.sums[1],
            slope: path.sums[2],
            stress: path.stress(),
            tangent: path.modulus,
            state: *state,
            dissipated: 0.0,
        }
    }
}

fn one_sided(young: f64, slack: Slack, [from, to]: [f64; 2], state: &FibreState) -> FibreStep {
    let modulus = |strain: f64| match slack {
        Slack::Tension if strain < 0.0 => young,
        Slack::Compression if strain > 0.0 => young,
        _ => 0.0,
    };
    let mut path = StressPath::new(modulus(from) * from, to - from);
    if from * to < 0.0 {
        path.go_on(modulus(from), from / (from - to));
    }
    path.go_on(modulus(if to == 0.0 { from } else { to }), 1.0);
    FibreStep::without_flow(path, state)
}

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
    fn stored(&self, state: &FibreState) -> f64 {
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

impl PlasticLaw {
    /// Independent of rate: elastic up to the yield stress, then along the hardening curve.
    fn path(&self, state: &FibreState, from: f64, to: f64) -> FibreStep {
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

    /// With viscous overstress; the path is cut where the stress changes its sign, so that no part gives energy.
    fn viscous(
        &self,
        overstress: Overstress,
        state: &FibreState,
        from: f64,
        to: f64,
        h: f64,
    ) -> FibreStep {
        let (start, length) = (self.young * (from - state.plastic), to - from);
        let trial = start + self.young * length;
        if start * trial >= 0.0 {
            return self.overstressed(overstress, state, ([from, to], h)).step;
        }
        let share = start / (start - trial);
        let middle = from + share * length;
        let first = self.overstressed(overstress, state, ([from, middle], share * h));
        let rest = 1.0 - share;
        let second = self.overstressed(overstress, &first.step.state, ([middle, to], rest * h));
        // The second part takes longer where the path does.
        let longer = second.stress_by_time * share * h / length;
        let tangent = second.step.tangent + longer;
        let mean = share * first.step.mean + rest * second.step.mean;
        // d(s De)/de1 = s2 + De2 ds2/de1.
        let work = second.step.mean + 0.5 * rest * length * tangent;
        FibreStep {
            mean,
            slope: (work - mean) / length,
            tangent,
            dissipated: first.step.dissipated + second.step.dissipated,
            ..second.step
        }
    }

    /// A path on which the stress does not change its sign: the overstress at its end makes it flow.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn law(isotropic: f64, kinematic: f64, overstress: Option<Overstress>) -> StressLaw {
        StressLaw::Plastic(PlasticLaw {
            young: 200e9,
            plasticity: Plasticity {
                curve: vec![Hardening { from: 0.0, stress: 250e6, modulus: isotropic }],
                kinematic,
                overstress,
                failure_strain: None,
            },
        })
    }

    /// Pseudo-random numbers from -1 to 1.
    fn random(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// The largest error of the balance, relative to the energies at hand, and the least dissipation relative likewise.
    fn walk(law: &StressLaw, steps: usize, size: f64) -> (f64, f64) {
        let (mut state, mut strain, mut seed) = (FibreState::default(), 0.0, 7);
        let energy = |s: &FibreState, e: f64| law.elastic_energy(s, e) + law.hardening_energy(s);
        let (mut worst, mut least): (f64, f64) = (0.0, 0.0);
        for _ in 0..steps {
            let next = 0.02 * random(&mut seed) * if seed % 3 == 0 { size } else { 0.1 * size };
            let step = law.step(&state, strain, next, 1e-4);
            let change = energy(&step.state, next) - energy(&state, strain);
            let work = step.mean * (next - strain);
            // Against the energy at first yield, and what is stored, of which changes are differences.
            let scale =
                250e6_f64.powi(2) / (2.0 * 200e9) + work.abs() + law.hardening_energy(&state);
            worst = worst.max((work - change - step.dissipated).abs() / scale);
            least = least.min(step.dissipated / scale);
            (state, strain) = (step.state, next);
        }
        (worst, least)
    }

    #[test]
    fn work_is_what_is_stored_and_what_is_dissipated_for_any_step() {
        let rate = Some(Overstress { rate: 40.4, exponent: 5.0 });
        for law in [law(0.0, 0.0, None), law(2e9, 0.0, None), law(1e9, 3e9, None), table()] {
            let (worst, least) = walk(&law, 300_000, 1.0);
            assert!(worst < 1e-13 && least >= 0.0, "{law:?}: {worst:e}, {least:e}");
        }
        for law in [law(0.0, 0.0, rate), law(0.0, 3e9, rate)] {
            let (worst, least) = walk(&law, 100_000, 1.0);
            assert!(worst < 1e-12 && least >= -1e-13, "{law:?}: {worst:e}, {least:e}");
        }
        for slack in [Slack::Tension, Slack::Compression] {
            let law = StressLaw::OneSided { young: 200e9, slack };
            let (worst, _) = walk(&law, 10_000, 1.0);
            assert!(worst < 1e-13, "{worst:e}");
        }
    }

    fn table() -> StressLaw {
        let part = |from, stress, modulus| Hardening { from, stress, modulus };
        let curve = vec![part(0.0, 250e6, 5e9), part(0.01, 300e6, 1e9), part(0.05, 340e6, 0.0)];
        let StressLaw::Plastic(plastic) = law(0.0, 0.0, None) else { unreachable!() };
        StressLaw::Plastic(PlasticLaw {
            plasticity: Plasticity { curve, ..plastic.plasticity },
            ..plastic
        })
    }

    #[test]
    fn slopes_are_derivatives() {
        let rate = Some(Overstress { rate: 40.4, exponent: 5.0 });
        let laws = [law(2e9, 1e9, None), law(2e9, 1e9, rate), table()];
        for (law, strained) in laws.iter().flat_map(|l| [0.0, 2e-3, -4e-3, 0.03].map(|e| (l, e))) {
            let start = law.step(&FibreState::default(), 0.0, strained, 1e-4).state;
            for to in [strained + 1e-4, strained + 7e-3, strained - 9e-3, 0.06] {
                let at = |e: f64| law.step(&start, strained, e, 1e-4);
                let d = 1e-8;
                let (a, b, here) = (at(to - d), at(to + d), at(to));
                let (mean, end) =
                    ((b.mean - a.mean) / (2.0 * d), (b.stress - a.stress) / (2.0 * d));
                let near = |x: f64, y: f64| (x - y).abs() < 2e-5 * 200e9;
                assert!(near(mean, here.slope), "{law:?} {strained} {to}: {mean:e} {here:?}");
                assert!(near(end, here.tangent), "{law:?} {strained} {to}: {end:e} {here:?}");
            }
        }
    }

    #[test]
    fn steady_flow_has_the_overstress_of_cowper_and_symonds() {
        let law = law(0.0, 0.0, Some(Overstress { rate: 40.4, exponent: 5.0 }));
        let (mut state, mut strain, h, rate) = (FibreState::default(), 0.0, 1e-5, 100.0);
        let mut stress = 0.0;
        for _ in 0..2000 {
            let step = law.step(&state, strain, strain + h * rate, h);
            (state, strain, stress) = (step.state, strain + h * rate, step.stress);
        }
        let expected = 250e6 * (1.0 + (rate / 40.4_f64).powf(0.2));
        assert!((stress / expected - 1.0).abs() < 1e-9, "{stress:e} {expected:e}");
    }
}
