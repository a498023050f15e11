//! Eigenvalues of linearised structures.
//!
//! Matrices are formed and factored in [`crate::scalar::Wide`] numbers, eigenvalues counted by the signs of pivots and found in Krylov subspaces of
//! the inverse. Strain-free motions follow from the geometry alone.

mod factor;
mod held;
mod kinematics;
mod krylov;
mod matrix;
mod pencil;
mod stiffness;
mod wide_element;

pub use held::Held;
pub use kinematics::{FreeMotions, free_motions, strain_share, stress_share};
pub use krylov::{ImagePair, Krylov, Nodal, Ritz, random, subtract};
pub use matrix::{Layout, Matrix};
pub use pencil::{Eigen, Pencil};

use crate::linalg::chain::Chain;
use crate::math::hermite;
use crate::model::Model;

/// Length of all beams \[m\].
pub fn size(model: &Model) -> f64 {
    model.beams.iter().map(|b| b.length).sum()
}

/// A measure of motions by stiffness: the mass matrix of beams with a mass of `EI / l^4` per length, l the length of all beams.
/// Against it no bending stiffness of the structure is small, whatever its density. Of unit bending stiffness if `unit`.
pub fn metric(model: &Model, unit: bool) -> Chain {
    metric_of(model, unit, |_| true)
}

/// The same of the elements whose first node is marked.
pub fn metric_of(model: &Model, unit: bool, counts: impl Fn(usize) -> bool) -> Chain {
    let mut chain = Chain::zeros(model.node_count());
    let length = size(model);
    for (span, k, a, _) in model.each_element() {
        let table = span.table(k);
        let bending = match (counts(a), unit) {
            (false, _) => 0.0,
            (true, true) => 1.0,
            (true, false) => table.rows[1].section.bending,
        };
        let mass = hermite::mass(table.length, |_| bending / length.powi(4));
        let none = crate::element::beam::ElementSums::zero(0.0);
        crate::step::assemble::spread(&none, &mass, 1.0, a, &mut chain);
    }
    chain
}
