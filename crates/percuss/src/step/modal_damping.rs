//! Damping of the modes of a linearised structure.
//!
//! With modes phi of unit modal mass about the configuration at the start the damping matrix is `sum 2 zeta omega (M phi)(M phi)^T`. It acts on
//! motion relative to the rigid motion of each body and to moving supports. A body is a set of parts connected by elements, joints and springs.
//! Over a step from x0 to x1 = x0 + d, in its middle x_m:
//!
//! ```text
//! rigid motions      R y = (a + w J x_m, w J g_m), y = (a, w): all increments d of a body that stays as it is have this form
//! supports           C y = b, with b their increments: y = y_s + N z, what they give and what they leave free
//! relative motion    q = P (d - R y_s),  P = I - R N (N^T R^T M R N)^-1 N^T R^T M
//! forces             -P^T Q M phi (2 zeta omega / h) (Q M phi)^T q,  Q the rotation of the body since the start
//! ```
//!
//! They have no resultant and no moment against the rigid motions that supports leave free, and never create energy.

mod bodies;
mod ground;
mod moving;

use crate::linalg::chain::Chain;
pub use bodies::{Bodies, positions};
pub use ground::{StepView, each_tie, tie_count};
pub use moving::MovingModes;

/// Vectors `M phi` and their rates `2 zeta omega`.
#[derive(Clone, Debug, Default)]
pub struct ModalDamping {
    /// `M phi` about the configuration at the start, nodal vectors, shape (modes, nodes, 4) \[kg^(1/2), kg^(1/2) m\].
    pub vectors: Vec<Vec<[f64; 4]>>,
    /// `2 zeta omega`, shape (modes) \[1/s\].
    pub rates: Vec<f64>,
    /// Change of each mode's coordinate for a unit motion of the ground of a tie that the structure follows statically, shape (modes, ties to the
    /// ground) \[kg^(1/2), kg^(1/2) m\].
    pub followed: Vec<Vec<f64>>,
    /// Positions and tangents of the beams' nodes at the start, shape (nodes of beams, 4) \[m, -\].
    pub start: Vec<[f64; 4]>,
    /// The mass matrix there.
    pub mass: Chain,
    /// Whether any body can move as a whole, now or later.
    pub moves: bool,
}

impl ModalDamping {
    /// Whether no mode is damped.
    pub fn is_empty(&self) -> bool {
        self.vectors.is_empty()
    }
}
