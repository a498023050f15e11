//! Strains, their rates and stresses of the fibres of an element where the state stands.

use crate::element::beam::ElementValues;
use crate::element::fibre::{FibreState, StressLaw};
use crate::element::yielding::GaussStrains;
use crate::math::hermite::GAUSS;
use crate::model::frozen::{Span, SpanFibres};
use crate::state::State;
use crate::step::fibres::fibre_strains;

/// Calls `see` for every fibre of an element: number of the Gauss point, height, strain (NaN of a failed one) and stress where the state stands, with
/// that of the viscosity of the material at mean rates over the step.
pub(super) fn each_fibre(
    (span, fibres, k): (&Span, &SpanFibres, usize),
    state: &State,
    rates: Option<&GaussStrains>,
    mut see: impl FnMut(usize, f64, f64, f64),
) {
    let strains = strains_of(span, k, state, 0.0);
    let of = state.fibres_of(fibres, k);
    for j in 0..GAUSS {
        for (fibre, memory) in of.at(j) {
            let at = |[membrane, bending]: [f64; 2]| membrane + fibre.height * bending;
            let strain = at(strains[j]);
            if memory.failed {
                see(j, fibre.height, f64::NAN, 0.0);
                continue;
            }
            let law = &fibres.laws[fibre.law];
            let stress = law.stress(memory, strain);
            let more = rates.map_or(0.0, |rates| {
                viscous_stress(law, memory, [strain, at(rates[j])], stress, span.retardation)
            });
            see(j, fibre.height, strain, stress + more);
        }
    }
}

/// Stress by the viscosity of a material with a retardation time, at a strain and its rate, beside the stress without it \[Pa\].
fn viscous_stress(
    law: &StressLaw,
    memory: &FibreState,
    [strain, rate]: [f64; 2],
    stress: f64,
    retardation: f64,
) -> f64 {
    let change = rate * BRIEF;
    law.viscous(memory, [strain - change, strain, change], retardation / BRIEF, [stress, 0.0])[0]
}

/// Strain at a place, as membrane and bending strain, and its rate, shape (2, 2) \[-, 1/m; 1/s, 1/(m s)\].
pub(super) type StrainsAndRates = [[f64; 2]; 2];

/// Time over which rates of strain are differences \[s\]: so short that velocities are constant.
const BRIEF: f64 = 1e-7;

/// Strains at the Gauss points, a brief time after a state, as membrane and bending strain, shape (Gauss points, 2) \[-, 1/m\].
fn strains_of(span: &Span, k: usize, state: &State, time: f64) -> [[f64; 2]; GAUSS] {
    let (a, u, v) = (span.nodes.start + k, &state.displacement, &state.velocity);
    let node = |n: usize| std::array::from_fn(|i| u[n][i] + time * v[n][i]);
    fibre_strains(span, k, &ElementValues::new(&node(a), &node(a + 1)))
}

/// Strains of a state and their rates at the Gauss points.
pub(super) fn strains_and_rates(span: &Span, k: usize, state: &State) -> [StrainsAndRates; GAUSS] {
    let [before, now] = [-BRIEF, 0.0].map(|time| strains_of(span, k, state, time));
    std::array::from_fn(|j| {
        let rate = [0, 1].map(|i| (now[j][i] - before[j][i]) / BRIEF);
        [now[j], rate]
    })
}
