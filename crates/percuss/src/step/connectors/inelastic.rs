//! Connectors that yield, by the law of a fibre with force and extension in place of stress and strain, and those that break.

use super::super::forcing::Forcing;
use super::super::integration::{Integration, Rule};
use crate::element::fibre::{FibreLosses, FibreState, StressLaw};
use crate::model::Model;
use crate::model::frozen::{Connector, YieldingLaw};
use crate::state::State;

impl Connector {
    /// How it yields or breaks and what it remembers, if it can.
    pub fn memory<'a>(
        &'a self,
        memories: &'a [FibreState],
    ) -> Option<(&'a YieldingLaw, &'a FibreState)> {
        self.yielding.as_ref().map(|own| (own, &memories[own.memory]))
    }

    /// Whether it is gone.
    pub fn has_failed(&self, memories: &[FibreState]) -> bool {
        self.memory(memories).is_some_and(|(_, state)| state.failed)
    }

    /// Energy that its hardening has stored \[J\].
    pub fn hardening_energy(&self, memories: &[FibreState]) -> f64 {
        let stored = |law: &StressLaw, state| law.hardening_energy(state);
        let memory = self.memory(memories);
        memory.and_then(|(own, state)| Some(stored(own.law.as_ref()?, state))).unwrap_or(0.0)
    }

    /// Force at a value of the coordinate that it has reached, dampers left out \[N, N m\].
    pub fn reached_force(&self, q: f64, memories: &[FibreState]) -> f64 {
        match self.memory(memories) {
            Some((_, state)) if state.failed => 0.0,
            Some((YieldingLaw { law: Some(law), .. }, state)) => {
                law.stress(state, q - self.law.free())
            }
            _ => self.law.collocated(q, 0.0, 1.0)[0],
        }
    }
}

/// Force of the law and its derivative with respect to the extension at the end: the mean over the step, or in one that knows no
/// time that of an extension reached slowly.
pub(super) fn force(
    law: &StressLaw,
    state: &FibreState,
    rule: &Integration,
    [from, to]: [f64; 2],
) -> [f64; 2] {
    match rule.rule {
        Rule::Static => {
            let found = law.at_rest(state, to);
            [found.stress, law.loading_tangent(&found)]
        }
        // Schemes that advance accelerations are refused.
        Rule::Midpoint(_) | Rule::Alpha(_) => {
            let found = law.step(state, from, to, rule.h);
            [found.mean, found.slope]
        }
    }
}

/// What connectors that yield or break remember at the end of a step, from the coordinates of `state` by the increment; what they take over
/// it is added to the losses.
pub fn advanced(
    model: &Model,
    state: &State,
    rule: &Integration,
    (forcing, increment): (&Forcing, &[[f64; 4]]),
    losses: &mut FibreLosses,
) -> Vec<FibreState> {
    let mut memories = state.memories.clone();
    if memories.is_empty() {
        return memories;
    }
    for (i, c) in model.connectors.iter().enumerate() {
        let Some(own) = &c.yielding else { continue };
        let from = state.coordinates[i] - c.law.free();
        let step = c.step(i, rule, forcing, state, increment);
        let to = from + step.change;
        let memory = &mut memories[own.memory];
        let mut fails = step.force.abs() > own.strength;
        let mut stored = 0.0;
        if let Some(law) = &own.law {
            let found = law.step(memory, from, to, rule.h);
            *memory = found.state;
            losses.plastic += found.dissipated;
            fails |= law.fails(to);
            stored = law.elastic_energy(memory, to) + law.hardening_energy(memory);
        } else if fails {
            stored = c.law.energy(state.coordinates[i] + step.change);
        }
        if fails && !memory.failed {
            losses.failure += stored;
            memory.failed = true;
        }
    }
    memories
}

/// Brings connectors that yield slowly to where displacements have led; none fails by that.
pub fn bring_to_rest(
    model: &Model,
    displacement: &[[f64; 4]],
    coordinates: &[f64],
    memories: &mut [FibreState],
) {
    for (c, q0) in model.connectors.iter().zip(coordinates) {
        let Some(YieldingLaw { law: Some(law), memory, .. }) = &c.yielding else { continue };
        let extension = c.value(displacement, *q0) - c.law.free();
        let memory = &mut memories[*memory];
        *memory = law.at_rest(memory, extension).state;
    }
}
