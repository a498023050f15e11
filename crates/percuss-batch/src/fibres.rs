//! Fibres of the runs of an ensemble: what they remember.

use super::numbers::Numbers;
use percuss::internals::element::fibre::FibreState;
use percuss::internals::element::yielding::GaussStrains;
use percuss::internals::scalar::{Number, array};
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

    /// Puts those of a run of another ensemble into a lane.
    pub fn set_lane(&mut self, lane: usize, from: &Self, from_lane: usize) {
        for (mine, other) in self.states.iter_mut().zip(&from.states) {
            mine.plastic.set_lane(lane, other.plastic, from_lane);
            mine.accumulated.set_lane(lane, other.accumulated, from_lane);
            mine.dissipated.set_lane(lane, other.dissipated, from_lane);
        }
        let strains = self.strains.as_flattened_mut().as_flattened_mut().iter_mut();
        for (mine, other) in strains.zip(from.strains.as_flattened().as_flattened()) {
            mine.set_lane(lane, *other, from_lane);
        }
    }

    /// Takes over those of another, which has as many.
    #[inline(always)]
    pub fn copy_from(&mut self, from: &Self) {
        self.states.copy_from_slice(&from.states);
        self.strains.copy_from_slice(&from.strains);
    }

    /// Puts all lanes but those that `go` back to what was kept.
    #[inline(always)]
    pub fn put_back(&mut self, kept: &Self, go: S::Mask) {
        for (now, kept) in self.states.iter_mut().zip(&kept.states) {
            now.plastic = S::choose(go, now.plastic, kept.plastic);
            now.accumulated = S::choose(go, now.accumulated, kept.accumulated);
            now.dissipated = S::choose(go, now.dissipated, kept.dissipated);
        }
        for (now, kept) in self.strains.iter_mut().zip(&kept.strains) {
            for j in 0..GAUSS {
                now[j] = array(|i| S::choose(go, now[j][i], kept[j][i]));
            }
        }
    }
}
