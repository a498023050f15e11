//! Damping of the modes of a linearised structure.
//!
//! With modes phi of unit modal mass about the configuration at the start the damping matrix is `sum 2 zeta omega (M phi)(M phi)^T`.
//! It acts on motion relative to the rigid motion of each body and to supports that move. A body is what elements, joints and springs
//! hold together. Over a step from x0 to x1 = x0 + d, in its middle x_m:
//!
//! ```text
//! rigid motions      R y = (a + w J x_m, w J g_m), y = (a, w): all increments d of a body that stays as it is have this form
//! supports           C y = b, with b their increments: y = y_s + N z, what they give and what they leave free
//! relative motion    q = P (d - R y_s),  P = I - R N (N^T R^T M R N)^-1 N^T R^T M
//! forces             -P^T Q M phi (2 zeta omega / h) (Q M phi)^T q,  Q the rotation of the body since the start
//! ```
//!
//! They have no resultant and no moment against the rigid motions that supports leave free, and take energy or none, never give any.

mod bodies;
mod ground;
mod moving;

use super::external::middle;
use super::tangent::inner;
use crate::ledger::StepWork;
use crate::linalg::chain::Chain;
use crate::model::Model;
use crate::state::State;
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
    /// What each mode's coordinate moves by where the ground of a tie moves by one and the structure follows as it does at rest,
    /// shape (modes, ties to the ground) \[kg^(1/2), kg^(1/2) m\].
    pub followed: Vec<Vec<f64>>,
    /// Positions and tangents of the beams' nodes at the start, shape (nodes of beams, 4) \[m, -\].
    pub start: Vec<[f64; 4]>,
    /// The mass matrix there.
    pub mass: Chain,
    /// Whether any body can move as a whole, now or later.
    pub moves: bool,
}

impl ModalDamping {
    /// Whether nothing is damped.
    pub fn is_empty(&self) -> bool {
        self.vectors.is_empty()
    }
}

/// What modal damping does in a step.
#[derive(Clone, Copy, Debug)]
pub struct ModalFlow {
    /// Work, impulse and angular impulse of its forces on the structure.
    pub done: StepWork,
    /// Energy that it takes \[J\].
    pub loss: f64,
    /// Of that, what supports that move have brought \[J\].
    pub brought: f64,
}

impl MovingModes {
    /// Adds the damping forces of an increment in a step of size `h` to a residual.
    pub fn apply(
        &self,
        damping: &ModalDamping,
        increment: &[[f64; 4]],
        h: f64,
        residual: &mut [[f64; 4]],
    ) {
        for (k, vector) in self.vectors(damping).iter().enumerate() {
            let force = damping.rates[k] * self.moved(k, vector, increment) / h;
            for (target, v) in residual.iter_mut().zip(vector) {
                (0..4).for_each(|i| target[i] += force * v[i]);
            }
        }
    }

    /// What a mode's coordinate moves by, relative to rigid motion and supports.
    fn moved(&self, k: usize, vector: &[[f64; 4]], increment: &[[f64; 4]]) -> f64 {
        inner(vector, increment) - self.followed.get(k).unwrap_or(&0.0)
    }

    /// What the damping does in a step by an increment from a state.
    pub fn flow(
        &self,
        model: &Model,
        damping: &ModalDamping,
        state: &State,
        increment: &[[f64; 4]],
        h: f64,
    ) -> ModalFlow {
        let mut force = vec![[0.0; 4]; increment.len()];
        self.apply(damping, increment, h, &mut force);
        let mut done = StepWork::default();
        for (node, f) in force.iter().enumerate() {
            let place = middle(model, state, increment, node);
            done.add_nodal(&f.map(|x| -x), place, &increment[node], h);
        }
        let (mut loss, mut brought) = (0.0, 0.0);
        for (k, vector) in self.vectors(damping).iter().enumerate() {
            let moved = self.moved(k, vector, increment);
            loss += damping.rates[k] / h * moved * moved;
            brought -= damping.rates[k] / h * moved * self.followed.get(k).unwrap_or(&0.0);
        }
        ModalFlow { done, loss, brought }
    }
}
