//! Events during static loading, load step by load step: first yield of beams, and the loss of stiffness of the structure.

use super::static_search::{StaticSearch, largest};
use crate::math::hermite;
use crate::model::Model;
use crate::model::frozen::BeamData;
use crate::state::State;

/// Place and share of the loads of the first yield of a beam in static loading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticFirstYield {
    /// Arc length from the start of the beam \[m\], that of the Gauss point that has yielded most by then.
    pub s: f64,
    /// Share of the loads at the end of the load step of first yield \[-\].
    pub share: f64,
}

/// Events so far.
#[derive(Clone, Debug)]
pub(super) struct Course {
    /// First yields, shape (beams).
    pub first_yields: Vec<Option<StaticFirstYield>>,
    /// Share of the loads at the last place.
    share: f64,
    /// Increments of the nodes there, shape (nodes, 4) \[m, -\].
    increment: Vec<[f64; 4]>,
    /// How far nodes go at most for the share of the loads in the first step, and in any, shape (2) \[m\].
    rates: [f64; 2],
}

impl Course {
    /// Before the first load step.
    pub fn new(search: &StaticSearch<'_>) -> Self {
        Self {
            first_yields: vec![None; search.model.beams.len()],
            share: 0.0,
            increment: search.work.increment.clone(),
            rates: [f64::NAN, 0.0],
        }
    }

    /// Records an equilibrium at a share of the loads.
    pub fn take(&mut self, search: &StaticSearch<'_>, share: f64) {
        let now = &search.work.increment;
        let pairs = now.iter().zip(&self.increment);
        let moved: Vec<[f64; 4]> =
            pairs.map(|(a, b)| [a[0] - b[0], a[1] - b[1], 0.0, 0.0]).collect();
        let rate = largest(&moved) / (share - self.share);
        let rate = if rate.is_finite() { rate } else { 0.0 }; // something failed where something had failed before
        let [first, most] = self.rates;
        self.rates = [if first.is_nan() { rate } else { first }, most.max(rate)];
        self.share = share;
        self.increment.copy_from_slice(now);
        for (beam, first) in search.model.beams.iter().zip(&mut self.first_yields) {
            if first.is_none() {
                *first = yielded_most(search.model, &search.base, beam)
                    .map(|s| StaticFirstYield { s, share });
            }
        }
    }

    /// How many times faster with the loads than in the first step nodes went where they went fastest.
    pub fn softening(&self) -> f64 {
        self.rates[1] / self.rates[0]
    }
}

/// Arc length of the Gauss point of a beam whose fibres have yielded most, if any has \[m\].
fn yielded_most(model: &Model, state: &State, beam: &BeamData) -> Option<f64> {
    let xi = hermite::gauss_points();
    let mut most = (0.0, None);
    for span in &model.spans[beam.spans.clone()] {
        let Some(of) = &span.fibres else { continue };
        for k in 0..span.elements.len() {
            let (from, to) = (span.stations[k], span.stations[k + 1]);
            let mut rest = &state.fibres[of.range(k)];
            for (j, fibres) in of.of(k).iter().enumerate() {
                let (own, others) = rest.split_at(fibres.len());
                rest = others;
                let accumulated = own.iter().fold(0.0_f64, |m, fibre| m.max(fibre.accumulated));
                if accumulated > most.0 {
                    most = (accumulated, Some(from + xi[j] * (to - from)));
                }
            }
        }
    }
    most.1
}
