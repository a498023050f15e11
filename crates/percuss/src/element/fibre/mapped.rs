//! Laws of fibres in other numbers: the same of several runs side by side, or with derivatives.

use super::Fibre;
use super::law::{Hardening, Overstress, PlasticLaw, Plasticity, StressLaw};

impl<S: Copy> Fibre<S> {
    /// The same with every number replaced.
    pub fn map<T>(&self, f: &mut impl FnMut(S) -> T) -> Fibre<T> {
        Fibre {
            height: f(self.height),
            area: f(self.area),
            carries_force: self.carries_force,
            law: self.law,
        }
    }
}

impl<S: Copy> StressLaw<S> {
    /// The same with every number replaced.
    pub fn map<T>(&self, f: &mut impl FnMut(S) -> T) -> StressLaw<T> {
        match self {
            Self::Elastic { young } => StressLaw::Elastic { young: f(*young) },
            Self::OneSided { young, slack } => {
                StressLaw::OneSided { young: f(*young), slack: *slack }
            }
            Self::Plastic(PlasticLaw { young, plasticity, slack }) => {
                let (young, slack) = (f(*young), *slack);
                StressLaw::Plastic(PlasticLaw { young, plasticity: plasticity.map(f), slack })
            }
        }
    }

    /// All its properties that are not numbers.
    pub fn shape(&self) -> LawShape {
        let slack = self.slack();
        match self {
            Self::Plastic(PlasticLaw { plasticity, .. }) => LawShape {
                slack,
                parts: plasticity.curve.len(),
                feels_rate: plasticity.overstress.is_some(),
                fails: plasticity.failure_strain.is_some(),
            },
            _ => LawShape { slack, parts: 0, feels_rate: false, fails: false },
        }
    }
}

/// Common properties of stress laws of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LawShape {
    slack: Option<super::Slack>,
    /// Number of parts of the hardening curve; zero for elastic laws.
    parts: usize,
    feels_rate: bool,
    fails: bool,
}

impl<S: Copy> Plasticity<S> {
    fn map<T>(&self, f: &mut impl FnMut(S) -> T) -> Plasticity<T> {
        let part = |part: &Hardening<S>, f: &mut dyn FnMut(S) -> T| Hardening {
            from: f(part.from),
            stress: f(part.stress),
            modulus: f(part.modulus),
        };
        Plasticity {
            curve: self.curve.iter().map(|p| part(p, f)).collect(),
            kinematic: f(self.kinematic),
            overstress: (self.overstress.as_ref())
                .map(|law| Overstress { rate: f(law.rate), exponent: f(law.exponent) }),
            failure_strain: self.failure_strain.map(f),
        }
    }
}
