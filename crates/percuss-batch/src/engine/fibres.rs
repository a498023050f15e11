//! Dissipation of the fibres in a step, and their stored energy.

use super::Engine;
use crate::numbers::SpanNumbers;
use percuss::internals::element::beam::{ElementTable, ElementValues};
use percuss::internals::element::fibre::FibreFlow;
use percuss::internals::element::yielding::{
    ElementFibres, FibreEnergies, GaussStrains, gauss_strains,
};
use percuss::internals::model::frozen::SpanFibres;
use percuss::internals::scalar::{Number, Task};

impl<S: Number> Engine<S> {
    /// Number of spans with fibres.
    pub fn yielding_spans(&self) -> usize {
        self.numbers.spans.iter().filter(|span| span.fibres.is_some()).count()
    }

    /// Moves the fibres to the end of the current step, to which the displacements belong already.
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
        ElementFibres { laws: &fibres.laws, fibres: fibres.of(k), states, present: None }
    }

    /// Energies of the fibres of an element.
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
