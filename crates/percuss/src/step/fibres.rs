//! Fibres over a step: their state variables at its end, and their dissipation.

use super::integration::Integration;
use super::sweep::{AdvanceFibres, Sweep};
use crate::element::beam::{ElementTable, ElementValues};
use crate::element::fibre::{Fibre, FibreFlow, FibreLosses, FibreState, StressLaw};
use crate::element::shear::{moved, stored};
use crate::element::yielding::{
    ElementFibres, ElementStep, FibreEnergies, GaussStrains, gauss_strains,
};
use crate::math::hermite::GAUSS;
use crate::model::Model;
use crate::model::frozen::{Span, SpanFibres};
use crate::state::State;

impl State {
    /// Fibres of the element of number `k` in a span.
    pub(crate) fn fibres_of<'a>(&'a self, fibres: &'a SpanFibres, k: usize) -> ElementFibres<'a> {
        let states = &self.fibres[fibres.range(k)];
        ElementFibres { laws: &fibres.laws, fibres: fibres.of(k), states, present: None }
    }
}

/// Membrane and bending strain of the fibres of an element at its Gauss points; a shear-flexible one has one point, whose strains they all have.
pub fn fibre_strains(span: &Span, k: usize, u: &ElementValues<f64>) -> GaussStrains {
    match span.shear_at(k) {
        Some(shear) => [shear.strains_of_fibres(u); GAUSS],
        None => gauss_strains(span.table(k), span.measure, u),
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

/// An element that parts at the end of a step.
#[derive(Clone, Copy, Debug)]
pub struct PartedElement {
    /// Its node `a`.
    pub node: usize,
    /// The Gauss point at which no fibre is left.
    pub gauss: usize,
    /// Energy stored at that instant in all parts that fail in it \[J\].
    pub energy: f64,
}

/// Moves the fibres to the end of a step, from the displacements of `state` by the increment. An element without fibres at one of its Gauss points
/// loses all others too, and is returned.
pub fn advance(
    model: &Model,
    state: &mut State,
    rule: &Integration,
    increment: &[[f64; 4]],
    sweep: &Sweep,
) -> (FibreLosses, Vec<PartedElement>) {
    let (mut losses, mut parted) = (FibreLosses::default(), Vec::new());
    if state.fibres.is_empty() {
        return (losses, parted);
    }
    for (number, span) in model.spans.iter().enumerate() {
        let Some(fibres) = &span.fibres else { continue };
        let mut moved = Moved { span, fibres, rule, increment, state, losses: &mut losses };
        if rule.sweeps() && sweep.has(number) {
            let (state, losses) = (&mut *moved.state, &mut *moved.losses);
            let failing = AdvanceFibres { sweep, span, number, state, rule, losses }.advance();
            failing.into_iter().for_each(|k| parted.extend(moved.fail(k)));
            continue;
        }
        for k in 0..span.elements.len() {
            if !moved.state.has_parted(span.nodes.start + k) && moved.advance(k) {
                parted.extend(moved.fail(k));
            }
        }
    }
    (losses, parted)
}

/// Fibres of a span that move to the end of a step.
struct Moved<'a> {
    span: &'a Span,
    fibres: &'a SpanFibres,
    rule: &'a Integration,
    /// Increment of the nodal displacements over the step, shape (nodes, 4) \[m, -, rad\].
    increment: &'a [[f64; 4]],
    state: &'a mut State,
    losses: &'a mut FibreLosses,
}

impl Moved<'_> {
    /// Strains of an element at both ends of the step.
    fn strains(&self, k: usize) -> [GaussStrains; 2] {
        let [start, change] = self.values(k);
        if self.span.shear.is_some() {
            let end = moved(&start, &change, 1.0);
            return [&start, &end].map(|u| fibre_strains(self.span, k, u));
        }
        element_step((self.span, self.span.table(k)), [&start, &change], self.rule).strains()
    }

    /// Nodal values of an element at the start of the step, and their increments.
    fn values(&self, k: usize) -> [ElementValues<f64>; 2] {
        let a = self.span.nodes.start + k;
        [&self.state.displacement[..], self.increment].map(|u| ElementValues::new(&u[a], &u[a + 1]))
    }

    /// Energy of the shear force of an element at the end of the step \[J\].
    fn sheared(&self, k: usize) -> f64 {
        let [start, change] = self.values(k);
        let end = moved(&start, &change, 1.0);
        self.span.shear_at(k).map_or(0.0, |shear| 0.5 * shear.energies(&end)[1])
    }

    /// Moves those of an element; returns whether any has reached its failure strain.
    fn advance(&mut self, k: usize) -> bool {
        let (fibres, table) = (self.fibres, self.span.table(k));
        let (h, lag) = (self.rule.h, self.rule.lag(self.span.retardation));
        let [from, to] = self.strains(k);
        let mut flow = FibreFlow::beside([self.losses.plastic, self.losses.viscous]);
        let mut states = self.state.fibres[fibres.range(k)].iter_mut();
        for (j, points) in fibres.of(k).iter().enumerate() {
            for (fibre, state) in points.iter().zip(&mut states) {
                let law = &fibres.laws[fibre.law];
                let on = (table.rows[j].weight, [from[j], to[j]]);
                let before = state.accumulated;
                flow.advance((law, fibre), state, on, (h, lag));
                self.losses.yielded |= state.accumulated != before;
            }
        }
        [self.losses.plastic, self.losses.viscous] = flow.taken;
        flow.failing
    }

    /// Lets the fibres of an element fail that have reached their failure strain, and all others if none is left at a Gauss point.
    fn fail(&mut self, k: usize) -> Option<PartedElement> {
        let fibres = self.fibres;
        let ([_, strains], sheared) = (self.strains(k), self.sheared(k));
        let states = &mut self.state.fibres[fibres.range(k)];
        let broken = |law: &StressLaw, strain: f64| law.fails(strain);
        let mut energy = fail_those((fibres, k), self.span.table(k), &strains, states, broken);
        let gap = gap(fibres.of(k), states);
        if gap.is_some() {
            energy += fail_those((fibres, k), self.span.table(k), &strains, states, |_, _| true);
            energy += sheared;
        }
        self.losses.failure += energy;
        gap.map(|gauss| PartedElement { node: self.span.nodes.start + k, gauss, energy })
    }
}

/// The first Gauss point of an element at which no fibre is left.
fn gap(fibres: &[Vec<Fibre>; GAUSS], mut states: &[FibreState]) -> Option<usize> {
    fibres.iter().position(|points| {
        let (here, rest) = states.split_at(points.len());
        states = rest;
        let carries_force =
            |(fibre, state): (&Fibre, &FibreState)| fibre.carries_force && !state.failed;
        !points.is_empty() && !points.iter().zip(here).any(carries_force)
    })
}

/// Lets those fibres of an element fail that reach their failure strain; returns their stored energy \[J\].
fn fail_those(
    (fibres, k): (&SpanFibres, usize),
    table: &ElementTable,
    strains: &GaussStrains,
    states: &mut [FibreState],
    fails: impl Fn(&StressLaw, f64) -> bool,
) -> f64 {
    let mut stored = 0.0;
    let mut states = states.iter_mut();
    for ((points, row), [membrane, bending]) in fibres.of(k).iter().zip(&table.rows).zip(strains) {
        for (fibre, state) in points.iter().zip(&mut states).filter(|(_, state)| !state.failed) {
            let (law, strain) = (&fibres.laws[fibre.law], membrane + fibre.height * bending);
            if fails(law, strain) {
                let energy = law.elastic_energy(state, strain) + law.hardening_energy(state);
                stored += fibre.area * row.weight * energy;
                state.failed = true;
            }
        }
    }
    stored
}

/// Strains the fibres quasi-statically to the current displacements; fibres do not fail by that.
pub fn bring_to_rest(model: &Model, displacement: &[[f64; 4]], all: &mut [FibreState]) {
    for (span, k, a, _) in model.each_element() {
        let Some(fibres) = &span.fibres else { continue };
        let u = ElementValues::new(&displacement[a], &displacement[a + 1]);
        let strains = fibre_strains(span, k, &u);
        let mut states = all[fibres.range(k)].iter_mut();
        for (points, [membrane, bending]) in fibres.of(k).iter().zip(strains) {
            for (fibre, state) in points.iter().zip(&mut states) {
                let (law, strain) = (&fibres.laws[fibre.law], membrane + fibre.height * bending);
                *state = law.at_rest(state, strain).state;
                state.failed |= !fibre.carries_force && law.fails(strain);
            }
        }
    }
}

/// Lets all fibres of the elements fail that have none left at a Gauss point, and were not in `parted` before; returns their first nodes, and the
/// Gauss point.
pub fn part_at_rest(
    model: &Model,
    parted: impl Fn(usize) -> bool,
    all: &mut [FibreState],
) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    for (span, k, a, _) in model.each_element() {
        let Some(fibres) = &span.fibres else { continue };
        let states = &mut all[fibres.range(k)];
        let Some(gauss) = gap(fibres.of(k), states) else { continue };
        if !parted(a) {
            found.push((a, gauss));
            states.iter_mut().for_each(|state| state.failed = true);
        }
    }
    found
}

/// The first nodes of the elements that have no fibre left.
pub fn parted<'a>(model: &'a Model, states: &'a [FibreState]) -> impl Iterator<Item = usize> + 'a {
    model.each_element().filter_map(|(span, k, a, _)| {
        let fibres = span.fibres.as_ref()?;
        gap(fibres.of(k), &states[fibres.range(k)]).map(|_| a)
    })
}

/// Stored energy of a fibre element in the current state.
pub fn energies(
    state: &State,
    (span, fibres): (&Span, &SpanFibres),
    k: usize,
    u: &ElementValues<f64>,
) -> FibreEnergies<f64> {
    state.fibres_of(fibres, k).energies(span.table(k), &fibre_strains(span, k, u))
}

/// Elastic strains for the forces of a fibre element in the current state: membrane strains at the sampling points, bending strains at the Gauss
/// points; of a shear-flexible one as it stores them.
pub fn equivalent_strains(state: &State, span: &Span, k: usize) -> Option<GaussStrains> {
    let fibres = span.fibres.as_ref()?;
    let (table, a) = (span.table(k), span.nodes.start + k);
    let u = ElementValues::new(&state.displacement[a], &state.displacement[a + 1]);
    let of = state.fibres_of(fibres, k);
    if let Some(shear) = span.shear_at(k) {
        return Some(stored(shear.elastic_strains(&of, &u)));
    }
    let at_gauss = &table.membrane.as_ref()?.at_gauss;
    let strains = gauss_strains(table, span.measure, &u);
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
