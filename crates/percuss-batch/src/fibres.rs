//! Fibres of the runs of an ensemble: what they remember.

use super::numbers::Numbers;
use percuss::internals::element::fibre::FibreState;
use percuss::internals::element::yielding::GaussStrains;
use percuss::internals::scalar::Number;
use percuss::math::hermite::GAUSS;

/// Where the fibres stand.
#[derive(Clone, Debug)]
pub struct FibreStates<S: Number> {
    /// What they remember, shape (fibres).
    pub states: Vec<FibreState<S>>,
    /// Strains at the Gauss points at the start of the step, shape (elements, Gauss points, 2); empty without fibres \[-, 1/m\].
    pub strains: Vec<GaussStrains<S>>,
    /// Whether any has flowed in the step accepted last.
    pub flowed: S::Mask,
    /// Energy that plastic flow and the viscosity of materials took in the step accepted last, shape (2) \[J\].
    pub taken: [S; 2],
    /// Lanes in which a fibre has come to its failure strain in that step.
    pub failing: S::Mask,
}

impl<S: Number> FibreStates<S> {
    /// Of runs whose beams are in their reference configuration, at which there is no strain.
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

    /// Whether there are none.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.states.is_empty()
    }

    /// Every number of what they remember and how they are strained, in a fixed order.
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
