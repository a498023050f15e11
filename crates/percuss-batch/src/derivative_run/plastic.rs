//! Derivatives of the results of beams that can yield.

use super::{DerivativeRun, Derived};
use crate::yield_log::YieldLog;
use percuss::internals::model::frozen::BeamData;
use percuss::internals::scalar::{Number, Real};
use percuss::{FirstYield, Model, PermanentSet, PlasticHinge, PlasticSummary, SectionPeak};

impl DerivativeRun<'_> {
    /// Derivatives of the results of each beam that can yield: largest strains, dissipation and energy stored in hardening; plastic hinges and
    /// permanent deflections have none.
    pub fn plastic(
        &self,
        model: &Model,
        read: &dyn Fn(Derived) -> f64,
        run: &[PlasticSummary],
    ) -> Vec<PlasticSummary> {
        let mut out = Vec::new();
        for (beam, own) in self.yields(model) {
            let Some(found) = run.iter().find(|summary| summary.name == beam.name) else {
                continue;
            };
            let most = |of: &dyn Fn(&YieldLog<Derived>) -> Derived| {
                let larger = |a: Derived, b: Derived| a.abs().if_less(b.abs(), b, a);
                let value = own.iter().map(of).reduce(larger).map_or(0.0, read);
                SectionPeak { value, s: f64::NAN, time: f64::NAN }
            };
            let [dissipated, hardening] = self.beam_energies(beam);
            let nan = f64::NAN;
            let hinge = |hinge: &PlasticHinge| PlasticHinge {
                s: nan,
                length: nan,
                rotation: nan,
                dissipated: nan,
                ..*hinge
            };
            out.push(PlasticSummary {
                strain_max: most(&|log| log.strain.value),
                accumulated_max: most(&|log| log.accumulated.value),
                first_yield: found.first_yield.map(|_| FirstYield { s: nan, time: nan }),
                hinges: found.hinges.iter().map(hinge).collect(),
                dissipated: read(dissipated),
                hardening: read(hardening),
                permanent_set: (found.permanent_set)
                    .map(|_| PermanentSet { s: nan, displacement: [nan; 2] }),
                ..found.clone()
            });
        }
        out
    }

    /// Records of the spans of each beam.
    pub fn yields<'b>(
        &self,
        model: &'b Model,
    ) -> impl Iterator<Item = (&'b BeamData, &[YieldLog<Derived>])> {
        let mut logs = &self.log.yields[..];
        model.beams.iter().map(move |beam| {
            let with = model.spans[beam.spans.clone()].iter().filter(|span| span.fibres.is_some());
            let (own, rest) = logs.split_at(with.count());
            logs = rest;
            (beam, own)
        })
    }

    /// Energy dissipated by the fibres of a beam, and energy stored in hardening, shape (2) \[J\].
    fn beam_energies(&self, beam: &BeamData) -> [Derived; 2] {
        let engine = &self.engine;
        let mut sums = [engine.h.constant(0.0); 2];
        for i in beam.spans.clone() {
            let span = &engine.numbers.spans[i];
            let Some(fibres) = &span.fibres else { continue };
            let first: usize = engine.numbers.spans[..i].iter().map(|span| span.count).sum();
            for k in 0..span.count {
                sums[1] += engine.fibre_energies((span, fibres), k, first + k).hardening;
                let mut states = engine.fibres.states[fibres.range(k)].iter();
                for (points, row) in fibres.of(k).iter().zip(&span.table(k).rows) {
                    for (fibre, state) in points.iter().zip(&mut states) {
                        sums[0] += fibre.area * row.weight * state.dissipated;
                    }
                }
            }
        }
        sums
    }
}
