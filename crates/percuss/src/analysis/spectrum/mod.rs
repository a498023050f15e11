//! Eigenvalues of linearised structures.
//!
//! Matrices are formed and factored in [`crate::scalar::Wide`] numbers, eigenvalues counted by the signs of pivots and found in
//! Krylov subspaces of the inverse. Which motions strain nothing is a matter of geometry alone.

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

use super::static_search::StaticSearch;
use crate::linalg::chain::Chain;
use crate::math::hermite;
use crate::model::Model;
use crate::step::tangent::Tangent;

/// Length of all beams \[m\].
pub fn size(model: &Model) -> f64 {
    model.beams.iter().map(|b| b.length).sum()
}

/// A measure of motions by stiffness: the mass matrix of beams with a mass of `EI / l^4` per length, l the length of all beams.
/// Against it no bending stiffness of the structure is small, whatever its density. Of unit bending stiffness if `unit`.
pub fn metric(model: &Model, unit: bool) -> Chain {
    metric_of(model, unit, |_| true)
}

/// The same of those elements whose first node is told to count.
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

/// Stiffness below this share of that of bending counts as none.
const NEUTRAL: f64 = 1e-6;

/// Whether an equilibrium is stable.
#[derive(Clone, Copy, Debug)]
pub struct Stability {
    /// Whether no motion about it grows.
    pub stable: bool,
    /// Motions against which there is no stiffness but the opposite, if they were counted.
    pub negative: Option<usize>,
}

impl Stability {
    fn counted(negative: Option<usize>) -> Self {
        Self { stable: negative == Some(0), negative }
    }
}

/// Whether no motion of a structure about an equilibrium, where `search` stands, grows; contacts are left out but for those held
/// closed.
///
/// Stiffness decides where forces have a potential: no pivot is negative, but for those of round-off beside the bending
/// stiffness. Density has no part in it. Where a force follows the beams, motions may grow that stiffness knows nothing of
/// (flutter), and frequencies decide.
pub fn stability_about(model: &Model, search: &StaticSearch, held: Vec<Held>) -> Stability {
    /// Eigenvalues below this share of the largest one looked at count as none.
    const ROUND_OFF: f64 = 1e-9;
    /// Modes looked at where frequencies decide.
    const MODES: usize = 8;
    let layout = Layout::holding(model, held.clone());
    let mut tangent = layout.tangent(search);
    if !layout.is_symmetric(&tangent) {
        let modes = super::modes::lowest(model, &search.base, held, MODES);
        let most = modes.iter().fold(0.0_f64, |most, m| most.max(m.eigenvalue.abs()));
        let floor = ROUND_OFF * most;
        let stable = modes.iter().all(|m| m.imaginary == 0.0 && m.eigenvalue >= -floor);
        return Stability { stable, negative: None };
    }
    layout.add_band(&mut tangent, &metric(model, false), NEUTRAL);
    Stability::counted(layout.factor(tangent, true).map(|f| f.negative))
}

/// The same by a tangent that was assembled, that of beams that yield as they are loaded on; nothing where it is not symmetric.
pub fn stability_loaded(
    model: &Model,
    search: &StaticSearch,
    tangent: &Tangent,
) -> Option<Stability> {
    let layout = Layout::new(model);
    let mut matrix = layout.assembled(search, tangent);
    if !layout.is_symmetric(&matrix) {
        return None;
    }
    layout.add_band(&mut matrix, &metric(model, false), NEUTRAL);
    Some(Stability::counted(layout.factor(matrix, true).map(|f| f.negative)))
}
