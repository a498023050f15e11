//! Natural modes about an equilibrium: subspace iteration on the factored tangent, linear in the number of elements.

use nalgebra::{DMatrix, SymmetricEigen};

use super::section_forces;
use super::static_search::{factor_shifted, linearized};
use super::statics::bending_scale;
use crate::contact::effective_mass::mass_band;
use crate::element::beam::ElementValues;
use crate::element::point::{form_a, form_b};
use crate::element::strain::gradient;
use crate::linalg::chain::Chain;
use crate::math::vec2::dot;
use crate::model::Model;
use crate::model::frozen::ConnectorLaw;
use crate::settings::Scheme;
use crate::state::State;
use crate::step::connectors::Grip;
use crate::step::forcing::Forcing;
use crate::step::integration::{Integration, Rule};
use crate::step::modal_damping::ModalDamping;
use crate::step::tangent::{Tangent, inner, project};

/// Iterations before the modes count as found as well as they can be.
const MOST_ITERATIONS: usize = 300;
/// Times the shift is raised where modes lie below it.
const MOST_SHIFTS: usize = 12;
/// Relative change of an eigenvalue that has settled.
const SETTLED: f64 = 1e-13;
/// Modes of an eigenvalue below this share of the lowest bending frequency's square are motions of a rigid body.
const RIGID: f64 = 1e-6;

/// Eigenvalues below this share of the highest one of the mesh are round-off.
const ROUND_OFF: f64 = 1e-14;

/// A natural mode.
#[derive(Clone, Debug)]
pub struct Mode {
    /// Square of the angular frequency \[1/s^2\]; negative for a motion that grows: the equilibrium is unstable.
    pub eigenvalue: f64,
    /// Nodal displacements and slopes (u1, u2, u1', u2') of unit modal mass, shape (n_node).
    pub shape: Vec<[f64; 4]>,
}

impl Mode {
    /// Natural frequency \[Hz\]; zero for a motion without stiffness, NaN where the equilibrium is unstable.
    pub fn frequency(&self) -> f64 {
        self.eigenvalue.sqrt() / std::f64::consts::TAU
    }
}

/// The `count` lowest natural modes about `state`, an equilibrium, in ascending order; projectiles take no part.
///
/// Fewer if the mesh has fewer; empty where the tangent is singular.
pub fn modes_about(model: &Model, state: &State, count: usize) -> Vec<Mode> {
    let model = &model.structure();
    let state = &state.of_structure(model);
    let mut modes = lowest(model, state, count).unwrap_or_default();
    // Motions of a rigid body have round-off for an eigenvalue.
    let zero = (RIGID * bending_scale(model)).max(ROUND_OFF * highest(model));
    for mode in &mut modes {
        if mode.eigenvalue.abs() <= zero {
            mode.eigenvalue = 0.0;
        }
    }
    modes
}

/// The `count` lowest natural frequencies about the stress-free reference configuration \[Hz\], in ascending order.
pub fn natural_frequencies(model: &Model, count: usize) -> Vec<f64> {
    let rest = State::at_rest(model, Scheme::EnergyMomentum);
    modes_about(model, &rest, count).iter().map(Mode::frequency).collect()
}

/// Damping of the flexible modes about `state`.
pub(super) fn modal_damping(model: &Model, state: &State) -> ModalDamping {
    let ratios = &model.modal_damping;
    if ratios.is_empty() {
        return ModalDamping::default();
    }
    let nodes = model.node_count();
    let model = &model.structure();
    let state = &state.of_structure(model);
    let rigid = RIGID * bending_scale(model);
    // Motions of rigid bodies come first, at most three a beam; as a rule three in all.
    let mut spare = 3;
    let found = loop {
        let found = lowest(model, state, ratios.len() + spare).unwrap_or_default();
        let flexible = found.iter().filter(|m| m.eigenvalue > rigid).count();
        let all = found.len() < ratios.len() + spare || spare >= 3 * model.beams.len();
        if flexible >= ratios.len() || all {
            break found;
        }
        spare *= 2;
    };
    let mass = mass_band(model, &state.displacement);
    let flexible = found.into_iter().filter(|m| m.eigenvalue > rigid);
    let mut damping = ModalDamping::default();
    for (mode, ratio) in flexible.zip(ratios).filter(|(_, ratio)| **ratio > 0.0) {
        damping.vectors.push(mass.multiply(&mode.shape));
        damping.rates.push(2.0 * ratio * mode.eigenvalue.sqrt());
    }
    for vector in &mut damping.vectors {
        project(model, vector);
        vector.resize(nodes, [0.0; 4]);
    }
    damping
}

/// Lowest modes, or `None` where the shifted tangent is singular.
pub(super) fn lowest(model: &Model, state: &State, count: usize) -> Option<Vec<Mode>> {
    let mut shift = bending_scale(model) + compression(model, state);
    for _ in 0..MOST_SHIFTS {
        match lowest_above(model, state, count, shift)? {
            Some(modes) => return Some(modes),
            None => shift *= 8.0,
        }
    }
    None
}

/// Lowest modes, all of them above minus `shift`; nothing inside if some lie below.
fn lowest_above(
    model: &Model,
    state: &State,
    count: usize,
    shift: f64,
) -> Option<Option<Vec<Mode>>> {
    let mass = mass_band(model, &state.displacement);
    let mut search = linearized(model, state);
    let mut tangent = factor_shifted(&mut search, &mass, shift)?;
    let held: usize = model.holds.iter().map(|h| h.normals.len()).sum();
    let free = (4 * model.node_count()).saturating_sub(held + model.constraints.len());
    let count = count.min(free);
    let size = (2 * count).max(count + 8).min(free);
    let mut basis = start(model, size);
    let mut previous = vec![f64::INFINITY; count];
    for iteration in 0..MOST_ITERATIONS {
        orthonormalize(&mass, &mut basis);
        let image = solve_all(model, &mut tangent, &mass, &basis);
        let (inverse, rotation) = ritz(&mass, &basis, &image);
        // Shapes from the basis, which is orthonormal; the images go on.
        let eigenvalues: Vec<f64> = inverse.iter().take(count).map(|t| 1.0 / t - shift).collect();
        let settled = eigenvalues
            .iter()
            .zip(&previous)
            .all(|(a, b)| (a - b).abs() <= SETTLED * (a.abs() + shift));
        if settled || iteration + 1 == MOST_ITERATIONS {
            if inverse.iter().any(|t| *t < 0.0) {
                return Some(None);
            }
            let mut shapes = combine(&image, &rotation, count);
            orthonormalize(&mass, &mut shapes);
            let modes = eigenvalues.into_iter().zip(shapes);
            let modes = modes.map(|(eigenvalue, shape)| Mode { eigenvalue, shape });
            return Some(Some(refined(model, state, modes.collect())));
        }
        previous = eigenvalues;
        basis = combine(&image, &rotation, size);
    }
    Some(None)
}

/// In the unloaded reference configuration, eigenvalues by the strains of the shapes.
///
/// The tangent's entries cancel to the last digits where a mode strains little; strains are formed from differences of
/// displacements and squared, so that motions of a rigid body are what they are.
fn refined(model: &Model, state: &State, mut modes: Vec<Mode>) -> Vec<Mode> {
    let stressed = state.displacement.as_flattened().iter().any(|u| *u != 0.0)
        || model.connectors.iter().zip(&state.coordinates).any(|(c, q)| c.potential(*q) > 0.0);
    if stressed {
        return modes;
    }
    for mode in &mut modes {
        mode.eigenvalue = 2.0 * strain_energy(model, &mode.shape);
    }
    modes.sort_by(|a, b| a.eigenvalue.total_cmp(&b.eigenvalue));
    modes
}

/// Energy of small displacements from the reference configuration, of beams and springs \[J\].
pub(super) fn strain_energy(model: &Model, shape: &[[f64; 4]]) -> f64 {
    let mut energy = 0.0;
    for (span, k, a, _) in model.each_element() {
        let table = span.table(k);
        let u = ElementValues::new(&shape[a], &shape[a + 1]);
        for row in &table.rows {
            let c = gradient(span.measure, row.tangent, row.bend);
            let (dg, dp) = (u.at(&row.first), u.at(&row.second));
            let (da, db) =
                (form_a(row.tangent).on(dg, dp), form_b(row.tangent, row.bend).on(dg, dp));
            let (eps, kappa) = (c.alpha * da, c.c1 * db + c.c2 * da);
            energy += 0.5 * (row.weighed.axial * eps * eps + row.weighed.bending * kappa * kappa);
        }
        if let Some(samples) = &table.membrane {
            let along = |i: usize| dot(samples.tangent[i], u.at(&samples.rows[i]));
            energy += samples.energy([along(0), along(1), along(2)]);
        }
    }
    let rest = vec![[0.0; 4]; shape.len()];
    let forcing = Forcing::new(model);
    let rule = Integration { h: 1.0, rule: Rule::Static };
    for c in &model.connectors {
        let step = c.step(&rule, &forcing, c.value(&rest, 0.0), &rest, &rest);
        let moved = |(g, (p, slope)): (usize, Grip)| {
            dot(step.forms[g], if slope { p.gradient(shape) } else { p.value(shape) })
        };
        let change: f64 = c.grips().map(moved).sum();
        if let ConnectorLaw::Linear { stiffness, .. } = c.law {
            energy += 0.5 * stiffness * change * change;
        }
    }
    energy
}

/// A bound of the highest eigenvalue of the mesh \[1/s^2\].
fn highest(model: &Model) -> f64 {
    let mut most = 0.0_f64;
    for (span, k, _, _) in model.each_element() {
        let (table, row) = (span.table(k), &span.table(k).rows[1]);
        let h2 = table.length * table.length;
        let axial = 60.0 * row.section.axial / (row.mass * h2);
        most = most.max(axial + 8400.0 * row.section.bending / (row.mass * h2 * h2));
    }
    most
}

/// What compression can take from the square of a frequency: `N^2 / (4 EI rhoA)` inside a beam, four times that at a free end
/// under a dead load; twice as much again for what else softens.
fn compression(model: &Model, state: &State) -> f64 {
    let mut most = 0.0_f64;
    for (span, k, _, _) in model.each_element() {
        let row = &span.table(k).rows[1];
        let axial = section_forces::elastic_axial(span, k, state);
        most = most.max(axial.min(0.0).powi(2) / (row.section.bending * row.mass));
    }
    2.0 * most
}

/// Vectors that are orthogonal to no motion.
pub(super) fn start(model: &Model, size: usize) -> Vec<Vec<[f64; 4]>> {
    let mut seed = 1_u64;
    let mut next = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
    };
    (0..size)
        .map(|_| {
            let mut x: Vec<[f64; 4]> =
                (0..model.node_count()).map(|_| std::array::from_fn(|_| next())).collect();
            project(model, &mut x);
            x
        })
        .collect()
}

fn solve_all(
    model: &Model,
    tangent: &mut Tangent,
    mass: &Chain,
    basis: &[Vec<[f64; 4]>],
) -> Vec<Vec<[f64; 4]>> {
    let solve = |x: &Vec<[f64; 4]>| {
        let mut y = mass.multiply(x);
        tangent.solve_linear(model, &mut y);
        y
    };
    basis.iter().map(solve).collect()
}

/// Gram-Schmidt in the inner product of the mass, twice.
fn orthonormalize(mass: &Chain, vectors: &mut [Vec<[f64; 4]>]) {
    for i in 0..vectors.len() {
        let (done, rest) = vectors.split_at_mut(i);
        let x = &mut rest[0];
        for _ in 0..2 {
            let weighed = mass.multiply(x);
            for y in done.iter() {
                subtract(x, inner(y, &weighed), y);
            }
        }
        let size = inner(x, &mass.multiply(x)).sqrt();
        scale(x, 1.0 / size);
    }
}

/// Eigenvalues of the inverse within the basis, descending, and the rotation to their vectors.
fn ritz(
    mass: &Chain,
    basis: &[Vec<[f64; 4]>],
    image: &[Vec<[f64; 4]>],
) -> (Vec<f64>, DMatrix<f64>) {
    let weighed: Vec<Vec<[f64; 4]>> = basis.iter().map(|x| mass.multiply(x)).collect();
    let n = basis.len();
    let matrix = DMatrix::from_fn(n, n, |i, j| inner(&weighed[i], &image[j]));
    sorted_eigen(&matrix)
}

/// Eigenvalues of the symmetric part, descending, with their vectors as columns.
pub(super) fn sorted_eigen(matrix: &DMatrix<f64>) -> (Vec<f64>, DMatrix<f64>) {
    let n = matrix.nrows();
    let eigen = SymmetricEigen::new((matrix + matrix.transpose()) * 0.5);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let values = order.iter().map(|i| eigen.eigenvalues[*i]).collect();
    (values, DMatrix::from_fn(n, n, |r, c| eigen.eigenvectors[(r, order[c])]))
}

/// The first `count` combinations of vectors.
pub(super) fn combine(
    vectors: &[Vec<[f64; 4]>],
    rotation: &DMatrix<f64>,
    count: usize,
) -> Vec<Vec<[f64; 4]>> {
    (0..count)
        .map(|c| {
            let mut sum = vec![[0.0; 4]; vectors[0].len()];
            for (r, v) in vectors.iter().enumerate() {
                subtract(&mut sum, -rotation[(r, c)], v);
            }
            sum
        })
        .collect()
}

/// `x -= factor y`.
pub(super) fn subtract(x: &mut [[f64; 4]], factor: f64, y: &[[f64; 4]]) {
    for (x, y) in x.as_flattened_mut().iter_mut().zip(y.as_flattened()) {
        *x -= factor * y;
    }
}

/// `x *= factor`.
pub(super) fn scale(x: &mut [[f64; 4]], factor: f64) {
    x.as_flattened_mut().iter_mut().for_each(|c| *c *= factor);
}
