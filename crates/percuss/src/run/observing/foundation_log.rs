//! Foundations along beams: records during a run, which become their results.

use crate::analysis::foundations::properties;
use crate::model::Model;
use crate::model::frozen::FoundationData;
use crate::state::State;
use crate::summary::{FoundationSummary, Peak, Range, SectionPeak, SectionRange};

/// Sums over a foundation in a state.
#[derive(Clone, Copy, Debug, Default)]
pub struct FoundationSums {
    /// Resultant force on the beam, shape (2) \[N\].
    pub force: [f64; 2],
    /// Reaction per length of largest magnitude, signed, and its arc length from the start of the beam, shape (2) \[N/m, m\].
    pub pressure: [f64; 2],
    /// Length without contact \[m\].
    pub lifted: f64,
    /// Stored energy, without hardening \[J\].
    pub energy: f64,
    /// Energy dissipated by yielding so far, and that stored by hardening, shape (2) \[J\].
    pub flow: [f64; 2],
    /// Plastic deflection of largest magnitude, signed, and its arc length from the start of the beam, shape (2) \[m\].
    pub plastic: [f64; 2],
}

impl FoundationSums {
    /// Those of a foundation in a state.
    pub fn of(model: &Model, state: &State, foundation: &FoundationData) -> Self {
        let mut sums = Self { pressure: [0.0, f64::NAN], ..Self::default() };
        for place in foundation.places(model, state) {
            for i in 0..2 {
                sums.force[i] += place.force[i];
                sums.flow[i] += place.flow[i];
            }
            sums.energy += place.stored;
            if place.lifted {
                sums.lifted += place.length;
            }
            for (most, value) in
                [(&mut sums.pressure, place.pressure), (&mut sums.plastic, place.plastic)]
            {
                if value.abs() > most[0].abs() || most[1].is_nan() {
                    *most = [value, place.s];
                }
            }
        }
        sums
    }
}

/// Nothing seen yet, one record per foundation.
pub fn unset(model: &Model) -> Vec<FoundationSummary> {
    let none = |foundation: &FoundationData| FoundationSummary {
        name: foundation.name.clone(),
        properties: properties(model, foundation),
        force: [Range::default(); 2],
        pressure: SectionRange::default(),
        lifted: Peak::default(),
        energy_max: Peak::default(),
        energy: 0.0,
        plastic: SectionPeak { value: 0.0, ..SectionPeak::default() },
        first_yield: None,
        dissipated: 0.0,
        dissipated_by_preload: 0.0,
        hardening: 0.0,
    };
    model.foundations.iter().map(none).collect()
}

/// Enters the state at the end of a step into the records, one per foundation.
pub fn note(model: &Model, state: &State, records: &mut [FoundationSummary]) {
    for (foundation, record) in model.foundations.iter().zip(records) {
        let sums = FoundationSums::of(model, state, foundation);
        for place in foundation.places(model, state) {
            record.pressure.take(place.pressure, place.s, state.time);
        }
        for i in 0..2 {
            record.force[i].take(sums.force[i], state.time);
        }
        for (peak, value) in
            [(&mut record.lifted, sums.lifted), (&mut record.energy_max, sums.energy)]
        {
            if value > peak.value || peak.value.is_nan() {
                *peak = Peak { value, time: state.time };
            }
        }
        let [dissipated, hardening] = sums.flow;
        (record.energy, record.dissipated, record.hardening) = (sums.energy, dissipated, hardening);
        if dissipated > 0.0 {
            record.first_yield.get_or_insert(state.time);
        }
        record.plastic = match sums.plastic {
            [0.0, _] => SectionPeak { value: 0.0, ..SectionPeak::default() },
            [value, s] => SectionPeak { value, s, time: state.time },
        };
    }
}

/// Enters the dissipation before the run into the records.
pub fn note_preload(records: &mut [FoundationSummary]) {
    records.iter_mut().for_each(|record| record.dissipated_by_preload = record.dissipated);
}
