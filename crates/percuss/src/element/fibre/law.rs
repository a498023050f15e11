//! Laws of fibres and their states, without their integration over a step.

use crate::scalar::Number;
use serde::{Deserialize, Serialize};

/// State variables of a fibre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FibreState<S = f64> {
    /// Plastic strain \[-\].
    pub plastic: S,
    /// Accumulated plastic strain, the sum of the magnitudes of its increments \[-\].
    pub accumulated: S,
    /// Energy dissipated so far, per volume \[J/m^3\].
    pub dissipated: S,
    /// Whether it has failed and carries no force.
    pub failed: bool,
}

/// A straight part of a hardening curve: from here on the yield stress grows by `modulus` per accumulated plastic strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hardening<S = f64> {
    /// Accumulated plastic strain at which it begins \[-\].
    pub from: S,
    /// Yield stress there \[Pa\].
    pub stress: S,
    /// Isotropic plastic modulus, d(yield stress)/d(accumulated plastic strain) \[Pa\].
    pub modulus: S,
}

/// Viscous overstress after Cowper and Symonds: accumulated plastic strain grows at the rate `C (|xi|/Y - 1)^q`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overstress<S = f64> {
    /// C \[1/s\].
    pub rate: S,
    /// q.
    pub exponent: S,
}

/// Sign of stress that a fibre cannot carry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slack {
    /// Tension.
    Tension,
    /// Compression.
    Compression,
}

impl Slack {
    /// Whether an elastic strain is one without stress.
    #[inline]
    pub(super) fn frees<S: Number>(self, elastic: S) -> S::Mask {
        let none = elastic.constant(0.0);
        match self {
            Self::Tension => none.less(elastic),
            Self::Compression => elastic.less(none),
        }
    }
}

/// How stress follows strain.
#[derive(Clone, Debug, PartialEq)]
pub enum StressLaw<S = f64> {
    /// In proportion.
    Elastic {
        /// Young's modulus \[Pa\].
        young: S,
    },
    /// Linear on one side, zero on the other.
    OneSided {
        /// Young's modulus \[Pa\].
        young: S,
        /// The side without stress.
        slack: Slack,
    },
    /// Elastic, then plastic.
    Plastic(PlasticLaw<S>),
}

/// Yielding with isotropic and kinematic hardening, rate and failure.
#[derive(Clone, Debug, PartialEq)]
pub struct Plasticity<S = f64> {
    /// Parts of the curve of the yield stress over accumulated plastic strain, the first from zero on, shape (parts); the last one is unbounded.
    pub curve: Vec<Hardening<S>>,
    /// Kinematic plastic modulus, d(back stress)/d(plastic strain) \[Pa\].
    pub kinematic: S,
    /// Viscous overstress; without it stress does not depend on rates.
    pub overstress: Option<Overstress<S>>,
    /// Magnitude of strain at which a fibre fails \[-\].
    pub failure_strain: Option<S>,
}

/// Behaviour of a material beyond Hooke's law.
#[derive(Clone, Debug, PartialEq)]
pub enum Inelasticity {
    /// It carries no stress of one sign.
    OneSided(Slack),
    /// It yields.
    Plastic(Plasticity),
    /// It carries no stress of one sign, and yields under the other.
    OneSidedPlastic(Slack, Plasticity),
}

/// A linearly elastic material that yields.
#[derive(Clone, Debug, PartialEq)]
pub struct PlasticLaw<S = f64> {
    /// Young's modulus \[Pa\].
    pub young: S,
    /// How it yields.
    pub plasticity: Plasticity<S>,
    /// The side without stress, if there is one: beyond the plastic strain on that side a fibre gapes.
    pub slack: Option<Slack>,
}

/// A fibre over a step.
#[derive(Clone, Copy, Debug)]
pub struct FibreStep<S = f64> {
    /// Mean stress over the path \[Pa\].
    pub mean: S,
    /// Its derivative with respect to the strain at the end \[Pa\].
    pub slope: S,
    /// Stress at the end \[Pa\].
    pub stress: S,
    /// Its derivative with respect to the strain at the end \[Pa\].
    pub tangent: S,
    /// Its state variables at the end, except failure.
    pub state: FibreState<S>,
    /// Energy dissipated per volume \[J/m^3\].
    pub dissipated: S,
}
