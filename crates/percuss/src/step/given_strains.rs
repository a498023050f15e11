//! Strains that loads give to elements, such as those of heat: their forces in a step, their energy and the work that they do.

use super::forcing::Forcing;
use super::integration::{Integration, MidpointForces, Rule};
use crate::element::beam::{ElementSums, ElementValues};
use crate::element::given_strain::{Evaluation, GivenStrain};
use crate::linalg::chain::Chain;
use crate::model::Model;
use crate::model::frozen::{LoadAction, LoadData, Span, StrainedElement};
use crate::state::State;

/// Where a scheme evaluates forces.
fn evaluation(rule: &Integration) -> Evaluation {
    match rule.rule {
        Rule::Midpoint(MidpointForces::Invariant) => Evaluation::Discrete,
        _ => Evaluation::At(rule.theta()),
    }
}

/// Membrane and bending strains given to element `k` of a span.
fn of_element(span: &Span, k: usize, [strain, bending]: [f64; 2]) -> GivenStrain<'_> {
    let (table, shear, measure) = (span.table(k), span.shear_at(k), span.measure);
    GivenStrain { table, shear, measure, strain, bending }
}

/// Elements with given strains: of each load with a factor the element, and its strains times the factor.
fn each<'m>(
    model: &'m Model,
    factors: &'m [f64],
) -> impl Iterator<Item = (&'m StrainedElement, GivenStrain<'m>)> + 'm {
    let loads = model.loads.iter().zip(factors).filter(|(_, factor)| **factor != 0.0);
    loads.flat_map(move |(load, factor)| {
        let elements: &[StrainedElement] = match &load.kind {
            LoadAction::Strain { elements, .. } => elements,
            _ => &[],
        };
        elements.iter().map(move |own| {
            let (span, k) = model.element_of(own.node);
            let strains = [own.strain, own.bending].map(|strain| factor * strain);
            (own, of_element(span, k, strains))
        })
    })
}

/// Values of the two nodes of an element.
fn values(nodal: &[[f64; 4]], node: usize) -> ElementValues<f64> {
    ElementValues::new(&nodal[node], &nodal[node + 1])
}

/// Adds the forces to the residual, and their tangent to the band if `TANGENT`.
pub fn apply<const TANGENT: bool>(
    model: &Model,
    (state, increment): (&State, &[[f64; 4]]),
    (rule, factors): (&Integration, &[f64]),
    residual: &mut [[f64; 4]],
    chain: &mut Chain,
) {
    let evaluation = evaluation(rule);
    for (own, given) in each(model, factors) {
        let a = own.node;
        let (start, step) = (values(&state.displacement, a), values(increment, a));
        let sums = given.forces::<TANGENT>(evaluation, &start, &step);
        for (node, force) in sums.nodal_force().iter().enumerate() {
            (0..4).for_each(|i| residual[a + node][i] += force[i]);
        }
        if TANGENT {
            add_tangent(&sums, a, chain);
        }
    }
}

fn add_tangent(sums: &ElementSums<f64>, a: usize, chain: &mut Chain) {
    let [aa, ab, ba, bb] = sums.nodal_tangent(&[[0.0; 4]; 4], 0.0);
    for i in 0..4 {
        for j in 0..4 {
            chain.diag[a][i][j] += aa[i][j];
            chain.upper[a][i][j] += ab[i][j];
            chain.lower[a][i][j] += ba[i][j];
            chain.diag[a + 1][i][j] += bb[i][j];
        }
    }
}

/// Adds the forces on both nodes of each element to `on_nodes`, on values and slopes, shape (elements, 2, 4) \[N, N m\].
pub fn on_nodes(
    model: &Model,
    (state, increment): (&State, &[[f64; 4]]),
    (rule, factors): (&Integration, &[f64]),
    on_nodes: &mut [[[f64; 4]; 2]],
) {
    let evaluation = evaluation(rule);
    for (own, given) in each(model, factors) {
        let a = own.node;
        let (start, step) = (values(&state.displacement, a), values(increment, a));
        let forces = given.forces::<false>(evaluation, &start, &step).nodal_force();
        for (own, force) in on_nodes[own.element].iter_mut().zip(&forces) {
            (0..4).for_each(|i| own[i] += force[i]);
        }
    }
}

/// What the given strains add to the axial and the bending strain energy of a configuration, with the factors of all loads there, shape (2) \[J\].
pub fn energy(model: &Model, displacement: &[[f64; 4]], factors: &[f64]) -> [f64; 2] {
    let mut sum = [0.0; 2];
    // Loads on the same element add up before they are squared.
    let mut all = vec![[0.0; 2]; model.element_count()];
    for (own, given) in each(model, factors) {
        all[own.element][0] += given.strain;
        all[own.element][1] += given.bending;
    }
    for (span, k, a, e) in model.each_element() {
        let [strain, bending] = all[e];
        if strain == 0.0 && bending == 0.0 {
            continue;
        }
        let given = of_element(span, k, [strain, bending]);
        let [axial, bent] = given.energy(&values(displacement, a));
        (sum[0], sum[1]) = (sum[0] + axial, sum[1] + bent);
    }
    sum
}

/// Work that the given strains do over a step: the change of the strain energy that is not the work of the elements' forces.
pub fn work(
    model: &Model,
    state: &State,
    rule: &Integration,
    forcing: &Forcing,
    increment: &[[f64; 4]],
) -> f64 {
    if state.strained.is_empty() {
        return 0.0;
    }
    let after: Vec<[f64; 4]> = (state.displacement.iter().zip(increment))
        .map(|(u, d)| std::array::from_fn(|i| u[i] + d[i]))
        .collect();
    let before = energy(model, &state.displacement, &state.strained);
    let end = factors_at(model, state.time + rule.h);
    let after = energy(model, &after, &end);
    let evaluation = evaluation(rule);
    let mut by_forces = 0.0;
    for (own, given) in each(model, &forcing.factors) {
        let a = own.node;
        let (start, step) = (values(&state.displacement, a), values(increment, a));
        let forces = given.forces::<false>(evaluation, &start, &step).nodal_force();
        for (force, d) in forces.iter().zip(&increment[a..a + 2]) {
            by_forces += (0..4).map(|i| force[i] * d[i]).sum::<f64>();
        }
    }
    (after[0] - before[0]) + (after[1] - before[1]) - by_forces
}

/// Factors of the loads that give strains at an instant, zero of all others, shape (loads) \[-\]; empty without such loads.
pub fn factors_at(model: &Model, time: f64) -> Vec<f64> {
    if !model.gives_strains() {
        return Vec::new();
    }
    let factor = |load: &LoadData| match load.kind {
        LoadAction::Strain { .. } if time > 0.0 => load.factor_at(time),
        LoadAction::Strain { .. } => load.factor_at_start(),
        _ => 0.0,
    };
    model.loads.iter().map(factor).collect()
}
