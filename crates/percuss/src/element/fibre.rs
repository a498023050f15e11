//! A fibre of a section that can yield: its stress over a step, its stored energy and dissipation.
//!
//! Strain is linear from one end of a step to the other. The stress that does the step's work is its mean over that path, `s = int sigma de / De`:
//! then `s De` is the change of the stored energy of the fibre plus its dissipation, exactly, for a step of any size. With the tangent modulus
//! along the path, `Et(t)` for t from 0 to 1,
//!
//! `s = sigma0 + De int Et (1 - t) dt`, `ds/de1 = int Et t dt`, `sigma1 = sigma0 + De int Et dt`.

mod flow;
mod law;
mod mapped;
mod path;
mod plastic;
#[cfg(test)]
mod tests;
mod viscous;

use crate::scalar::{Mask, Number};
pub use flow::{FibreFlow, FibreLosses};

pub use law::{
    FibreState, FibreStep, Hardening, Inelasticity, Overstress, PlasticLaw, Plasticity, Slack,
    StressLaw,
};
pub use mapped::LawShape;
use path::StressPath;
use viscous::Viscous;

/// A fibre: a part of a section in which strain and stress are uniform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibre<S = f64> {
    /// Height above the centre line, along the normal to the left of the beam's direction \[m\].
    pub height: S,
    /// Area \[m^2\].
    pub area: S,
    /// Whether it carries force; a fibre without area only gives strain and stress at the surface.
    pub carries_force: bool,
    /// Number of its law among those of the span.
    pub law: usize,
}

impl Fibre {
    /// A fibre that carries force.
    pub fn bearing(height: f64, area: f64, law: usize) -> Self {
        Self { height, area, carries_force: true, law }
    }

    /// A fibre without area for strain and stress at a surface, of the first law.
    pub fn at_surface(height: f64) -> Self {
        Self { height, area: 0.0, carries_force: false, law: 0 }
    }
}

impl StressLaw {
    /// That of a material.
    pub fn new(young: f64, inelasticity: Option<&Inelasticity>) -> Self {
        match inelasticity {
            None => Self::Elastic { young },
            Some(Inelasticity::OneSided(slack)) => Self::OneSided { young, slack: *slack },
            Some(Inelasticity::Plastic(plasticity)) => {
                Self::Plastic(PlasticLaw { young, plasticity: plasticity.clone(), slack: None })
            }
            Some(Inelasticity::OneSidedPlastic(slack, plasticity)) => {
                let (plasticity, slack) = (plasticity.clone(), Some(*slack));
                Self::Plastic(PlasticLaw { young, plasticity, slack })
            }
        }
    }

    /// The same without further plastic flow: strains are relative to the plastic strains.
    pub fn without_flow(&self) -> Self {
        match self {
            Self::Plastic(PlasticLaw { young, slack: None, .. }) => Self::Elastic { young: *young },
            Self::Plastic(law) => {
                let curve = vec![Hardening { from: 0.0, stress: f64::MAX, modulus: 0.0 }];
                let (kinematic, overstress) = (law.plasticity.kinematic, None);
                let plasticity = Plasticity { curve, kinematic, overstress, failure_strain: None };
                Self::Plastic(PlasticLaw { plasticity, ..law.clone() })
            }
            other => other.clone(),
        }
    }

    /// The fibre after quasi-static straining: the result does not depend on its initial strain.
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
}

impl StressLaw {
    /// Magnitude of a strain over that at which the fibre fails \[-\]; none where it gapes, and of one that never fails.
    pub fn use_of_failure_strain(&self, strain: f64) -> f64 {
        let Self::Plastic(law) = self else { return 0.0 };
        let gapes = law.slack.is_some_and(|slack| slack.frees(strain));
        law.plasticity.failure_strain.filter(|_| !gapes).map_or(0.0, |limit| strain.abs() / limit)
    }
}

impl<S> StressLaw<S> {
    /// The side without stress, if there is one.
    pub fn slack(&self) -> Option<Slack> {
        match self {
            Self::Elastic { .. } => None,
            Self::OneSided { slack, .. } => Some(*slack),
            Self::Plastic(law) => law.slack,
        }
    }
}

impl<S: Number> StressLaw<S> {
    /// Young's modulus \[Pa\].
    #[inline(always)]
    pub fn young(&self) -> S {
        match self {
            Self::Elastic { young } | Self::OneSided { young, .. } => *young,
            Self::Plastic(law) => law.young,
        }
    }

    /// The fibre over a step of size `h` from strain `from` to `to`.
    #[inline(always)]
    pub fn step(&self, state: &FibreState<S>, from: S, to: S, h: S) -> FibreStep<S> {
        let none = from.constant(0.0);
        match self {
            _ if state.failed => FibreStep::without_flow(StressPath::new(none, none), state),
            Self::Elastic { young } => {
                let mut path = StressPath::new(*young * (from - state.plastic), to - from);
                path.go_on(*young, from.constant(1.0));
                FibreStep::without_flow(path, state)
            }
            Self::OneSided { young, slack } => one_sided(*young, *slack, [from, to], state),
            Self::Plastic(law) => match &law.plasticity.overstress {
                Some(overstress) => {
                    h.apart(Viscous { law, overstress, state, ends: [from, to], h })
                }
                None => law.path(state, from, to),
            },
        }
    }

    /// Moves a fibre to the end of a step of size `h`; returns the dissipation by plastic flow and by the viscosity of its material, shape (2)
    /// \[J/m^3\]. `lag` is the retardation time over the step size.
    #[inline(always)]
    pub fn advance(
        &self,
        state: &mut FibreState<S>,
        [from, to]: [S; 2],
        (h, lag): (S, S),
    ) -> [S; 2] {
        let found = self.step(state, from, to, h);
        let change = to - from;
        let viscous = if state.failed {
            h.constant(0.0)
        } else {
            self.viscous(state, [from, to, change], lag, [found.mean, found.slope])[0]
        };
        *state = found.state;
        [found.dissipated, viscous * change]
    }

    /// Mean stress by the viscosity of the material over a step from and to a strain, by a change, and its derivative with respect to the strain at
    /// the end, shape (2) \[Pa\]; beside the mean of the stress without it and its derivative. `lag` is as in [`Self::advance`].
    ///
    /// A material with stress of one sign alone has it where it does not gape, and both together keep that sign: where they would not, it takes the
    /// elastic energy that is set free.
    #[inline(always)]
    pub fn viscous(
        &self,
        state: &FibreState<S>,
        [from, to, change]: [S; 3],
        lag: S,
        [mean, slope]: [S; 2],
    ) -> [S; 2] {
        let viscous = self.young() * lag;
        let Some(slack) = self.slack() else { return [viscous * change, viscous] };
        let sign = match slack {
            Slack::Tension => -1.0,
            Slack::Compression => 1.0,
        };
        let none = from.constant(0.0);
        let [first, last] = [from, to].map(|strain| (strain - state.plastic) * sign);
        let (starts, ends) = (none.less(first), none.less(last));
        let crossing = (last.max(none) - first.max(none)) * sign;
        let own = viscous * S::choose(starts & ends, change, crossing);
        let cut = ((mean + own) * sign).less(none);
        let rise = S::choose(ends, viscous, none);
        [S::choose(cut, none - mean, own), S::choose(cut, none - slope, rise)]
    }

    /// Elastic strain of a fibre that has reached a strain: none of one that gapes \[-\].
    #[inline(always)]
    fn elastic_strain(&self, state: &FibreState<S>, strain: S) -> S {
        let none = strain.constant(0.0);
        let gapes = match self {
            _ if state.failed => return none,
            Self::Elastic { .. } => return strain - state.plastic,
            Self::OneSided { slack, .. } => slack.frees(strain),
            Self::Plastic(law) => law.gapes(state, strain),
        };
        S::choose(gapes, none, strain - state.plastic)
    }

    /// Stress at a strain that the fibre has reached \[Pa\].
    #[inline(always)]
    pub fn stress(&self, state: &FibreState<S>, strain: S) -> S {
        self.young() * self.elastic_strain(state, strain)
    }

    /// Elastic energy per volume \[J/m^3\].
    #[inline(always)]
    pub fn elastic_energy(&self, state: &FibreState<S>, strain: S) -> S {
        let elastic = self.elastic_strain(state, strain);
        self.young() * elastic * elastic * 0.5
    }

    /// Energy per volume that hardening has stored \[J/m^3\].
    #[inline(always)]
    pub fn hardening_energy(&self, state: &FibreState<S>) -> S {
        match self {
            Self::Plastic(law) if !state.failed => law.plasticity.stored(state),
            _ => state.plastic.constant(0.0),
        }
    }

    /// Whether a fibre is strained to the side on which its material has no resistance.
    pub fn is_slack(&self, state: &FibreState<S>, strain: S) -> bool {
        let frees = |slack: Slack| slack.frees(strain - state.plastic).any();
        self.slack().is_some_and(frees)
    }

    /// Ratio of the stress to that of first yield of a fibre that has not yielded; zero for an elastic one.
    pub fn use_of_limit(&self, state: &FibreState<S>, strain: S) -> Option<S> {
        let Self::Plastic(law) = self else { return None };
        Some(self.stress(state, strain).abs() / law.plasticity.yield_stress(state.accumulated))
    }

    /// Whether a fibre fails at this strain.
    #[inline(always)]
    pub fn fails(&self, strain: S) -> S::Mask {
        let never = strain.less(strain);
        let Self::Plastic(law) = self else { return never };
        let Some(limit) = law.plasticity.failure_strain else { return never };
        let beyond = limit.at_most(strain.abs());
        match law.slack {
            // A gap is no strain of the material.
            Some(slack) => beyond & !slack.frees(strain),
            None => beyond,
        }
    }
}

impl<S: Number> FibreStep<S> {
    /// Without plastic flow.
    #[inline(always)]
    fn without_flow(path: StressPath<S>, state: &FibreState<S>) -> Self {
        Self {
            mean: path.start + path.length * path.sums[1],
            slope: path.sums[2],
            stress: path.stress(),
            tangent: path.modulus,
            state: *state,
            dissipated: path.start.constant(0.0),
        }
    }
}

#[inline(always)]
fn one_sided<S: Number>(
    young: S,
    slack: Slack,
    [from, to]: [S; 2],
    state: &FibreState<S>,
) -> FibreStep<S> {
    let none = from.constant(0.0);
    let (gaped, gapes) = (slack.frees(from), slack.frees(to));
    let before = S::choose(gaped, none, young);
    let mut path = StressPath::new(before * from, to - from);
    path.cross(gaped, gapes, before, none - from);
    path.go_on(S::choose(gapes, none, young), from.constant(1.0));
    FibreStep::without_flow(path, state)
}
