//! Springs and hinges that can yield or break: records during a run, and their results.

use serde::{Deserialize, Serialize};

use crate::analysis::set_beside;
use crate::model::Model;
use crate::model::frozen::{Connector, YieldingLaw};
use crate::state::State;
use crate::summary::{NoPermanentSet, Peak, PermanentSet, YieldingSummary};

/// Record of a connector that can yield.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ConnectorRecord {
    plastic: Peak,
    /// Its own coordinate, relative to the force-free one.
    extension: Peak,
    /// Its own force, or moment, at ends of steps, that of its damper included.
    force: Peak,
    first_yield: Option<f64>,
    /// Dissipation in the static start \[J\].
    preload: f64,
    failed: Option<f64>,
}

/// Enters the dissipation before the run into the records, one per connector that can yield.
pub fn note_preload(model: &Model, state: &State, records: &mut [ConnectorRecord]) {
    for ((_, _, own), record) in model.yielding().zip(records) {
        record.preload = state.memories[own.memory].dissipated;
    }
}

/// Enters the state at the end of a step into the records, one per connector that can yield.
pub fn note(model: &Model, state: &State, records: &mut [ConnectorRecord]) {
    for ((i, c, own), record) in model.yielding().zip(records) {
        let memory = &state.memories[own.memory];
        // After its failure its ends move independently.
        if record.failed.is_some() {
            continue;
        }
        let q = state.coordinates[i];
        // A slack rope or an open gap is as long as it happens to be.
        let acts = c.law.acts_at(q);
        let extension = if acts { own.sign * (q - c.law.free()) } else { 0.0 };
        take(&mut record.extension, extension, state.time);
        if !memory.failed {
            take(&mut record.force, own.sign * c.force_now(i, state), state.time);
        }
        if memory.accumulated > 0.0 {
            take(&mut record.plastic, own.sign * memory.plastic, state.time);
            record.first_yield.get_or_insert(state.time);
        }
        record.failed = memory.failed.then_some(state.time);
    }
}

fn take(peak: &mut Peak, value: f64, time: f64) {
    if value.abs() > peak.value.abs() || peak.value.is_nan() {
        *peak = Peak { value, time };
    }
}

/// Results of a run, one entry per connector that can yield, from its records and the beams' permanent deflections.
pub fn summaries(
    model: &Model,
    state: &State,
    records: &[ConnectorRecord],
    sets: &[Result<PermanentSet, NoPermanentSet>],
) -> Vec<YieldingSummary> {
    let summary = |((_, c, own), record): ((usize, &Connector, &YieldingLaw), &ConnectorRecord)| {
        let memory = &state.memories[own.memory];
        let none = Peak { value: 0.0, time: f64::NAN };
        YieldingSummary {
            name: own.name.clone(),
            turns: c.turns(),
            // No -0.
            plastic: own.sign * memory.plastic + 0.0,
            plastic_max: record.first_yield.map_or(none, |_| record.plastic),
            accumulated: memory.accumulated,
            extension_max: record.extension,
            force_max: Peak { value: record.force.value + 0.0, ..record.force },
            first_yield: record.first_yield,
            dissipated: memory.dissipated,
            dissipated_by_preload: record.preload,
            hardening: c.hardening_energy(&state.memories),
            failed: record.failed,
            permanent_set: set_beside(model, c, sets),
        }
    };
    model.yielding().zip(records).map(summary).collect()
}
