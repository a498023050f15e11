//! Fibres over a step.

use super::{Fibre, FibreState, StressLaw};
use crate::scalar::Number;

/// Dissipation of the fibres of all beams, and of the connectors that yield, over a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct FibreLosses {
    /// By plastic flow \[J\].
    pub plastic: f64,
    /// Energy stored in failing fibres at its end \[J\].
    pub failure: f64,
    /// By the viscosity of their materials \[J\].
    pub viscous: f64,
    /// Whether any fibre has yielded in it.
    pub yielded: bool,
}

/// Result of moving fibres to the end of a step (theory, page 6).
#[derive(Clone, Copy, Debug)]
pub struct FibreFlow<S: Number> {
    /// Dissipation by plastic flow and by the viscosity of their materials, shape (2) \[J\].
    pub taken: [S; 2],
    /// Lanes in which a fibre that carries force has reached its failure strain.
    pub failing: S::Mask,
    /// Lanes in which any has yielded.
    pub flowed: S::Mask,
}

impl<S: Number> FibreFlow<S> {
    /// Zero, with the lanes of the given number.
    #[inline(always)]
    pub fn beside(taken: [S; 2]) -> Self {
        let none = taken[0].less(taken[0]);
        Self { taken, failing: none, flowed: none }
    }

    /// Moves a fibre to the end of a step, from the membrane and bending strains at its Gauss point, of the given weight, to those at the end;
    /// `times` are as in [`StressLaw::advance`]. Returns the plastic dissipation \[J/m^3\].
    #[inline(always)]
    pub fn advance(
        &mut self,
        (law, fibre): (&StressLaw<S>, &Fibre<S>),
        state: &mut FibreState<S>,
        (weight, [from, to]): (S, [[S; 2]; 2]),
        times: (S, S),
    ) -> S {
        let (e0, e1) = (from[0] + fibre.height * from[1], to[0] + fibre.height * to[1]);
        let before = state.accumulated;
        let [plastic, viscous] = law.advance(state, [e0, e1], times);
        let volume = fibre.area * weight;
        self.taken[0] = self.taken[0].add_product(volume, plastic);
        self.taken[1] = self.taken[1].add_product(volume, viscous);
        if !state.failed {
            self.failing = self.failing | law.fails(e1);
        }
        self.flowed = self.flowed | before.less(state.accumulated);
        plastic
    }
}
