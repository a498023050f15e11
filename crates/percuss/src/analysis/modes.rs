//! Natural frequencies about the reference configuration.

use nalgebra::{DMatrix, SymmetricEigen};

use crate::contact::effective_mass;
use crate::element::beam::{ElementSums, ElementValues, step_point};
use crate::element::collocation;
use crate::linalg::chain::Chain;
use crate::model::Model;
use crate::model::frozen::Constraint;
use crate::step::{assemble, constraint};

/// Natural frequencies of the beams about their stress-free reference configuration \[Hz\], in ascending order.
///
/// Projectiles are not part of the structure. Solved densely: meant for up to some hundred elements; the round-off of the
/// reduction to standard form grows with the fourth power of the number of elements along a beam.
pub fn natural_frequencies(model: &Model) -> Vec<f64> {
    let (stiffness, mass) = (dense(&stiffness(model)), dense(&effective_mass::mass_band(model)));
    let basis = free_motions(model);
    let k = basis.transpose() * stiffness * &basis;
    let m = basis.transpose() * mass * &basis;
    let Some(cholesky) = m.cholesky() else { return Vec::new() };
    let l = cholesky.l();
    // L^-1 K L^-T
    let Some(half) = l.solve_lower_triangular(&k) else { return Vec::new() };
    let Some(reduced) = l.solve_lower_triangular(&half.transpose()) else { return Vec::new() };
    let symmetric = (&reduced + reduced.transpose()) * 0.5;
    let mut omega2: Vec<f64> = SymmetricEigen::new(symmetric).eigenvalues.iter().copied().collect();
    omega2.sort_by(f64::total_cmp);
    omega2.iter().map(|w2| w2.max(0.0).sqrt() / std::f64::consts::TAU).collect()
}

/// Stiffness of the reference configuration, without supports.
fn stiffness(model: &Model) -> Chain {
    let mut chain = Chain::zeros(model.node_count());
    let rest = ElementValues { chord: [0.0; 2], slope_a: [0.0; 2], slope_b: [0.0; 2] };
    for beam in &model.beams {
        let mut sums = ElementSums::zero();
        for row in &beam.table.rows {
            let point = step_point(&beam.table, row, &rest, &rest);
            sums.add::<true>(row, &collocation::response::<f64, true>(&beam.law, &point, 1.0));
        }
        let no_mass = [[0.0; 4]; 4];
        for a in beam.nodes.start..beam.nodes.end - 1 {
            assemble::spread(&sums.tangent, &no_mass, 0.0, a, &mut chain);
        }
    }
    chain
}

fn dense(chain: &Chain) -> DMatrix<f64> {
    let n = chain.diag.len();
    let mut out = DMatrix::zeros(4 * n, 4 * n);
    for a in 0..n {
        for i in 0..4 {
            for j in 0..4 {
                out[(4 * a + i, 4 * a + j)] = chain.diag[a][i][j];
                if a + 1 < n {
                    out[(4 * a + i, 4 * a + 4 + j)] = chain.upper[a][i][j];
                    out[(4 * a + 4 + i, 4 * a + j)] = chain.lower[a][i][j];
                }
            }
        }
    }
    out
}

/// Orthonormal basis, column by column, of the motions that supports and joints leave free.
fn free_motions(model: &Model) -> DMatrix<f64> {
    let n = 4 * model.node_count();
    let held: usize = model.holds.iter().map(|h| h.normals.len()).sum();
    let mut rows = DMatrix::zeros(n, held + model.constraints.len());
    let mut column = 0;
    for hold in &model.holds {
        for normal in &hold.normals {
            (0..4).for_each(|i| rows[(4 * hold.node + i, column)] = normal[i]);
            column += 1;
        }
    }
    let rest = vec![[0.0; 4]; model.node_count()];
    let gradient = |c: &Constraint| {
        let mut nodal = rest.clone();
        constraint::add_gradient(c, &rest, &rest, 0.0, 1.0, &mut nodal);
        nodal
    };
    for c in &model.constraints {
        for (i, value) in gradient(c).as_flattened().iter().enumerate() {
            rows[(i, column)] = *value;
        }
        column += 1;
    }
    let mut complement = DMatrix::identity(n, n);
    if column > 0 {
        rows.qr().q_tr_mul(&mut complement);
    }
    complement.rows(column, n - column).transpose()
}
