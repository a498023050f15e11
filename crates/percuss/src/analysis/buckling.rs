//! Linear buckling: the load factor at which the tangent would turn singular if the geometric stiffness grew with the load.

use nalgebra::DMatrix;

use super::modes::{combine, scale, sorted_eigen, start, subtract};
use super::static_search::{StaticSearch, largest, linearized};
use crate::model::Model;
use crate::settings::Scheme;
use crate::state::State;
use crate::step::tangent::{Tangent, inner, project};

/// Iterations of the subspace.
const MOST_ITERATIONS: usize = 200;
/// Vectors beside those asked for: loads the other way round buckle structures too, and come in between.
const SPARE: usize = 24;
/// Relative change of a factor that has settled.
const SETTLED: f64 = 1e-12;

/// A buckling mode of the linearised structure.
#[derive(Clone, Debug)]
pub struct BucklingMode {
    /// Factor on the loads that act at time zero.
    pub factor: f64,
    /// Nodal displacements and slopes, largest component one, shape (n_node).
    pub shape: Vec<[f64; 4]>,
}

/// Linear buckling factors of the loads that act at time zero: up to `count` positive ones, in ascending order.
///
/// `(K + factor K_g) shape = 0` about the reference configuration, with K_g the geometric stiffness of the stresses of the linear
/// response to the loads. Empty if no load acts, nothing buckles, or the
/// unloaded structure is a mechanism or unstable.
pub fn buckling(model: &Model, count: usize) -> Vec<BucklingMode> {
    find(&model.structure(), count).unwrap_or_default()
}

fn find(model: &Model, count: usize) -> Option<Vec<BucklingMode>> {
    let rest = State::at_rest(model, Scheme::EnergyMomentum);
    let stiffness = linearized(model, &rest).work.tangent;
    let (response, multipliers, mut factored) = linear_response(model)?;
    let stressed = stressed(model, &rest, &response, &multipliers);
    // - K_g x
    let geometric = |x: &[[f64; 4]]| {
        let mut y = stiffness.multiply(x);
        subtract(&mut y, 1.0, &stressed.multiply(x));
        project(model, &mut y);
        y
    };
    let held: usize = model.holds.iter().map(|h| h.normals.len()).sum();
    let free = (4 * model.node_count()).saturating_sub(held + model.constraints.len());
    let size = (2 * count).max(count + SPARE).min(free);
    let mut basis = start(model, size);
    for x in &mut basis {
        factored.solve_linear(model, x);
    }
    let mut previous = Vec::new();
    for iteration in 0..MOST_ITERATIONS {
        if !orthonormalize(&stiffness, &mut basis) {
            return None;
        }
        let loads: Vec<Vec<[f64; 4]>> = basis.iter().map(|x| geometric(x)).collect();
        let matrix = DMatrix::from_fn(size, size, |i, j| inner(&basis[i], &loads[j]));
        let (inverse, rotation) = sorted_eigen(&matrix);
        let factors: Vec<f64> = inverse.iter().take(count).map(|t| 1.0 / t).collect();
        let settled = !previous.is_empty()
            && factors
                .iter()
                .zip(&previous)
                .all(|(a, b): (&f64, &f64)| *a <= 0.0 || (a - b).abs() <= SETTLED * a.abs());
        if settled || iteration + 1 == MOST_ITERATIONS {
            let shapes = combine(&basis, &rotation, count.min(size));
            let modes = factors.into_iter().zip(shapes).filter(|(f, _)| *f > 0.0);
            return Some(modes.map(|(factor, shape)| normalized(factor, shape)).collect());
        }
        previous = factors;
        basis = combine(&loads, &rotation, size);
        for x in &mut basis {
            factored.solve_linear(model, x);
        }
    }
    None
}

fn normalized(factor: f64, mut shape: Vec<[f64; 4]>) -> BucklingMode {
    let most = shape.iter().fold(0.0_f64, |m, x| m.max(x[0].abs()).max(x[1].abs()));
    scale(&mut shape, 1.0 / most);
    BucklingMode { factor, shape }
}

/// The tangent of the reference configuration under the stresses of the linear response, not factored: displacements
/// stay out of it.
fn stressed(model: &Model, rest: &State, response: &[[f64; 4]], multipliers: &[f64]) -> Tangent {
    let mut search = StaticSearch::at(model, rest);
    search.forcing.set_static(model, 1.0);
    search.forcing.rest_motions();
    search.work.multiplier.copy_from_slice(multipliers);
    search.work.correction.copy_from_slice(response);
    search.foresee(false);
    search.assemble::<true>();
    search.work.tangent
}

/// Displacements and multipliers of the linear response to the loads, and the factored stiffness.
fn linear_response(model: &Model) -> Option<(Vec<[f64; 4]>, Vec<f64>, Tangent)> {
    let rest = State::at_rest(model, Scheme::EnergyMomentum);
    let mut search = linearized(model, &rest);
    search.work.multiplier.fill(0.0);
    search.factor_assembled().ok()?;
    search.forcing.set_static(model, 1.0);
    search.forcing.rest_motions();
    search.assemble::<false>();
    let loaded = search.work.residual.clone();
    search.forcing.set_static(model, 0.0);
    search.assemble::<false>();
    // The loads alone: springs may be stressed before they act.
    let difference = |(a, b): (&[f64; 4], &[f64; 4])| std::array::from_fn(|i| b[i] - a[i]);
    let mut x: Vec<[f64; 4]> = loaded.iter().zip(&search.work.residual).map(difference).collect();
    let mut tangent = search.work.tangent.clone();
    let multipliers = tangent.solve_linear(model, &mut x);
    // Round-off is no load.
    let reach = largest(&x);
    (reach > 1e-14 * search.size()).then_some((x, multipliers, tangent))
}

/// Gram-Schmidt in the inner product of the stiffness, twice; `false` if the stiffness is not positive: stressed springs have
/// made the reference configuration unstable before any load acts.
fn orthonormalize(stiffness: &Tangent, vectors: &mut [Vec<[f64; 4]>]) -> bool {
    for i in 0..vectors.len() {
        let (done, rest) = vectors.split_at_mut(i);
        let x = &mut rest[0];
        for _ in 0..2 {
            let weighed = stiffness.multiply(x);
            for y in done.iter() {
                subtract(x, inner(y, &weighed), y);
            }
        }
        let size = inner(x, &stiffness.multiply(x)).sqrt();
        if !(size > 0.0 && size.is_finite()) {
            return false;
        }
        scale(x, 1.0 / size);
    }
    true
}
