//! Fibres over a step: what they remember at its end, and what they dissipate.

use super::integration::Integration;
use crate::element::beam::{ElementTable, ElementValues};
use crate::element::fibre::FibreState;
use crate::element::yielding::{ElementFibres, ElementStep, GaussStrains, gauss_strains};
use crate::math::hermite::GAUSS;
use crate::model::Model;
use crate::model::frozen::{Span, SpanFibres};
use crate::state::State;

/// What the fibres of all beams, and the connectors that yield, take over a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct FibreLosses {
    /// By plastic flow \[J\].
    pub plastic: f64,
    /// Stored in what fails at its end \[J\].
    pub failure: f64,
    /// By the viscosity of their materials \[J\].
    pub viscous: f64,
}

impl State {
    /// Fibres of the element of number `k` in a span.
    pub(crate) fn fibres_of<'a>(&'a self, fibres: &'a SpanFibres, k: usize) -> ElementFibres<'a> {
        let states = &self.fibres[fibres.range(k)];
        ElementFibres { laws: &fibres.laws, fibres: fibres.of(k), states }
    }
}

/// A step of an element from nodal values by their increments.
pub fn element_step<'a>(
    (span, table): (&'a Span, &'a ElementTable),
    [start, increment]: [&'a ElementValues<f64>; 2],
    rule: &Integration,
) -> ElementStep<'a> {
    let lag = rule.lag(span.retardation);
    ElementStep { table, measure: span.measure, start, increment, h: rule.h, lag }
}

/// Moves the fibres to the end of a step, from the displacements of `state` by the increment.
pub fn advance(
    model: &Model,
    state: &mut State,
    rule: &Integration,
    increment: &[[f64; 4]],
) -> FibreLosses {
    let mut losses = FibreLosses::default();
    if state.fibres.is_empty() {
        return losses;
    }
    for (span, k, a, _) in model.each_element() {
        let Some(fibres) = &span.fibres else { continue };
        let (table, u) = (span.table(k), &state.displacement);
        let start = ElementValues::new(&u[a], &u[a + 1]);
        let change = ElementValues::new(&increment[a], &increment[a + 1]);
        let step = element_step((span, table), [&start, &change], rule);
        let [from, to] = step.strains();
        let mut states = state.fibres[fibres.range(k)].iter_mut();
        for (j, points) in fibres.of(k).iter().enumerate() {
            for (fibre, state) in points.iter().zip(&mut states) {
                let law = &fibres.laws[fibre.law];
                let [e0, e1] = [from[j], to[j]].map(|s| s[0] + fibre.height * s[1]);
                let found = law.step(state, e0, e1, step.h);
                *state = found.state;
                let volume = fibre.area * table.rows[j].weight;
                losses.plastic += volume * found.dissipated;
                losses.viscous += volume * law.young() * step.lag * (e1 - e0).powi(2);
                if law.fails(e1) && !state.failed {
                    let stored = law.elastic_energy(state, e1) + law.hardening_energy(state);
                    losses.failure += volume * stored;
                    state.failed = true;
                }
            }
        }
    }
    losses
}

/// Brings the fibres slowly to where displacements have led.
pub fn bring_to_rest(model: &Model, displacement: &[[f64; 4]], states: &mut [FibreState]) {
    for (span, k, a, _) in model.each_element() {
        let Some(fibres) = &span.fibres else { continue };
        let u = ElementValues::new(&displacement[a], &displacement[a + 1]);
        let strains = gauss_strains(span.table(k), span.measure, &u);
        let mut states = states[fibres.range(k)].iter_mut();
        for (points, [membrane, bending]) in fibres.of(k).iter().zip(strains) {
            for (fibre, state) in points.iter().zip(&mut states) {
                let (law, strain) = (&fibres.laws[fibre.law], membrane + fibre.height * bending);
                *state = law.at_rest(state, strain).state;
                state.failed |= law.fails(strain);
            }
        }
    }
}

/// Energies of an element of fibres where the state stands: stretching, bending and other stresses, hardening \[J\].
pub fn energies(state: &State, span: &Span, k: usize, u: &ElementValues<f64>) -> [f64; 3] {
    let Some(fibres) = &span.fibres else { return [0.0; 3] };
    let table = span.table(k);
    let strains = gauss_strains(table, span.measure, u);
    let of = state.fibres_of(fibres, k);
    let (mut axial, mut all, mut hardening) = (0.0, 0.0, 0.0);
    for (j, row) in table.rows.iter().enumerate() {
        let (mut force, mut stiffness) = (0.0, 0.0);
        for (fibre, memory) in of.at(j) {
            let law = &fibres.laws[fibre.law];
            let strain = strains[j][0] + fibre.height * strains[j][1];
            let volume = fibre.area * row.weight;
            all += volume * law.elastic_energy(memory, strain);
            hardening += volume * law.hardening_energy(memory);
            force += fibre.area * law.stress(memory, strain);
            stiffness += fibre.area * law.young();
        }
        axial += 0.5 * row.weight * force * force / stiffness;
    }
    [axial, all - axial, hardening]
}

/// Elastic strains that go with the forces of an element of fibres where the state stands: membrane strains at the sampling points,
/// bending strains at the Gauss points.
pub fn equivalent_strains(state: &State, span: &Span, k: usize) -> Option<GaussStrains> {
    let fibres = span.fibres.as_ref()?;
    let (table, a) = (span.table(k), span.nodes.start + k);
    let at_gauss = &table.membrane.as_ref()?.at_gauss;
    let u = ElementValues::new(&state.displacement[a], &state.displacement[a + 1]);
    let strains = gauss_strains(table, span.measure, &u);
    let of = state.fibres_of(fibres, k);
    let mut out = [[0.0; 2]; GAUSS];
    let mut membrane = [0.0; GAUSS];
    for j in 0..GAUSS {
        let (mut force, mut moment, mut stiffness) = (0.0, 0.0, [0.0; 2]);
        for (fibre, memory) in of.at(j) {
            let law = &fibres.laws[fibre.law];
            let stress = law.stress(memory, strains[j][0] + fibre.height * strains[j][1]);
            force += fibre.area * stress;
            moment += fibre.area * fibre.height * stress;
            stiffness[0] += fibre.area * law.young();
            stiffness[1] += fibre.area * fibre.height * fibre.height * law.young();
        }
        (membrane[j], out[j][1]) = (force / stiffness[0], moment / stiffness[1]);
    }
    let matrix = nalgebra::Matrix3::from_fn(|j, i| at_gauss[j][i]);
    let sampled = matrix.lu().solve(&nalgebra::Vector3::from(membrane))?;
    (0..GAUSS).for_each(|i| out[i][0] = sampled[i]);
    Some(out)
}
