//! A fibre of a section that can yield: its stress over a step, and what it stores and dissipates.
//!
//! Strain runs straight from one end of a step to the other. The stress that does the step's work is its mean over that path,
//! `s = int sigma de / De`: then `s De` is the change of what the fibre stores plus what it dissipates, exactly, for a step of
//! any size. With the tangent modulus along the path, `Et(t)` for t from 0 to 1,
//!
//! `s = sigma0 + De int Et (1 - t) dt`, `ds/de1 = int Et t dt`, `sigma1 = sigma0 + De int Et dt`.

mod plastic;
#[cfg(test)]
mod tests;

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
    /// Parts of the curve of the yield stress over accumulated plastic strain, the first from zero on, shape (parts); the last goes on for
    /// ever.
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

    /// Tangent modulus of one that is strained on from the end of a step: where it ends on the limit at which it yields, that with which
    /// it flows \[Pa\].
    pub fn loading_tangent(&self, end: &FibreStep) -> f64 {
        match self {
            Self::Plastic(law) if !end.state.failed => law.loading_tangent(end),
            _ => end.tangent,
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
    /// `int Et dt`, `int Et (1 - t) dt`, `int Et t dt`, shape (3) \[Pa\].
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
