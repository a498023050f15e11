//! Fibres of the runs of an ensemble: what they remember, what they take in a step, what they store.

use super::engine::Engine;
use super::numbers::{Numbers, SpanNumbers};
use percuss::internals::element::beam::{ElementTable, ElementValues};
use percuss::internals::element::fibre::{FibreFlow, FibreState};
use percuss::internals::element::yielding::{
    ElementFibres, FibreEnergies, GaussStrains, gauss_strains,
};
use percuss::internals::model::frozen::SpanFibres;
use percuss::internals::scalar::{Number, Task, array};
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

impl<S: Number> Engine<S> {
    /// Number of spans with fibres.
    pub fn yielding_spans(&self) -> usize {
        self.numbers.spans.iter().filter(|span| span.fibres.is_some()).count()
    }

    /// Moves the fibres to the end of the step at hand, where displacements are already.
    #[inline(always)]
    pub fn advance_fibres(&mut self) {
        if !self.fibres.is_empty() {
            self.h.apart(Advance(self));
        }
    }

    #[inline(always)]
    fn advance_all_fibres(&mut self) {
        let (zero, rate) = (self.h.constant(0.0), self.h.recip());
        let all = &mut self.fibres;
        let mut flow = FibreFlow::beside([zero; 2]);
        let mut element = 0;
        for span in &self.numbers.spans {
            let Some(fibres) = &span.fibres else {
                element += span.count;
                continue;
            };
            let times = (self.h, span.retardation * rate);
            for k in 0..span.count {
                let (a, table) = (span.first + k, span.table(k));
                let u = ElementValues::new(&self.displacement[a], &self.displacement[a + 1]);
                let to = gauss_strains(table, span.measure, &u);
                let from = std::mem::replace(&mut all.strains[element], to);
                let mut states = all.states[fibres.range(k)].iter_mut();
                for (j, points) in fibres.of(k).iter().enumerate() {
                    let weight = table.rows[j].weight;
                    for (fibre, state) in points.iter().zip(&mut states) {
                        let law = &fibres.laws[fibre.law];
                        flow.advance((law, fibre), state, (weight, [from[j], to[j]]), times);
                    }
                }
                element += 1;
            }
        }
        (all.taken, all.failing, all.flowed) = (flow.taken, flow.failing, flow.flowed);
    }

    /// Fibres of the element of number `k` in a span.
    #[inline(always)]
    pub fn element_fibres<'a>(
        &'a self,
        fibres: &'a SpanFibres<S>,
        k: usize,
    ) -> ElementFibres<'a, S> {
        let states = &self.fibres.states[fibres.range(k)];
        ElementFibres { laws: &fibres.laws, fibres: fibres.of(k), states }
    }

    /// What the fibres of an element store.
    #[inline(always)]
    pub fn fibre_energies(
        &self,
        (span, fibres): (&SpanNumbers<S>, &SpanFibres<S>),
        k: usize,
        element: usize,
    ) -> FibreEnergies<S> {
        let (table, strains) = (span.table(k), &self.fibres.strains[element]);
        self.h.apart(Energies { of: &self.element_fibres(fibres, k), table, strains })
    }
}

/// See [`Engine::advance_fibres`].
struct Advance<'a, S: Number>(&'a mut Engine<S>);

impl<S: Number> Task for Advance<'_, S> {
    type Output = ();
    #[inline(always)]
    fn run(self) {
        self.0.advance_all_fibres();
    }
}

/// See [`ElementFibres::energies`].
struct Energies<'a, S: Number> {
    of: &'a ElementFibres<'a, S>,
    table: &'a ElementTable<S>,
    /// At the Gauss points, shape (Gauss points, 2) \[-, 1/m\].
    strains: &'a GaussStrains<S>,
}

impl<S: Number> Task for Energies<'_, S> {
    type Output = FibreEnergies<S>;
    #[inline(always)]
    fn run(self) -> FibreEnergies<S> {
        self.of.energies(self.table, self.strains)
    }
}
