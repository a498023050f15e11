//! State variables of the fibres of an ensemble.

use super::numbers::Numbers;
use percuss::internals::element::fibre::FibreState;
use percuss::internals::element::yielding::GaussStrains;
use percuss::internals::scalar::Number;
use percuss::math::hermite::GAUSS;

/// State of the fibres.
#[derive(Clone, Debug)]
pub struct FibreStates<S: Number> {
    /// State variables, shape (fibres).
    pub states: Vec<FibreState<S>>,
    /// Strains at the Gauss points at the start of the step, shape (elements, Gauss points, 2); empty without fibres \[-, 1/m\].
    pub strains: Vec<GaussStrains<S>>,
    /// Whether any fibre has yielded in the last accepted step.
    pub flowed: S::Mask,
    /// Energy dissipated by plastic flow and by the viscosity of materials in the last accepted step, shape (2) \[J\].
    pub taken: [S; 2],
    /// Lanes in which a fibre has reached its failure strain in that step.
    pub failing: S::Mask,
}

impl<S: Number> FibreStates<S> {
    /// Fibres of beams in their reference configuration, without strain.
    pub fn at_rest(numbers: &Numbers<S>) -> Self {
        let zero = numbers.step.constant(0.0);
        let with = || numbers.spans.iter().filter_map(|span| Some((span, span.fibres.as_ref()?)));
        let count = with().map(|(span, of)| span.count * of.count).sum();
        let elements = numbers.spans.iter().map(|span| span.count).sum();
        let fresh =
            FibreState { plastic: zero, accumulated: zero, dissipated: zero, failed: false };
        Self {
            states: vec![fresh; count],
            strains: vec![[[zero; 2]; GAUSS]; if count > 0 { elements } else { 0 }],
            flowed: zero.less(zero),
            taken: [zero; 2],
            failing: zero.less(zero),
        }
    }

    /// Whether there are no fibres.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.states.is_empty()
    }

    /// Calls `f` with every state variable and strain in a fixed order.
    #[inline(always)]
    pub fn each(&mut self, mut f: impl FnMut(&mut S)) {
        for state in &mut self.states {
            for x in [&mut state.plastic, &mut state.accumulated, &mut state.dissipated] {
                f(x);
            }
        }
        for x in self.strains.as_flattened_mut().as_flattened_mut() {
            f(x);
        }
    }
}
