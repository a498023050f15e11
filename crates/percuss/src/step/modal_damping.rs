//! Damping of the modes of a linearised structure.
//!
//! With modes phi of unit modal mass about the initial configuration the damping matrix is `sum 2 zeta omega (M phi)(M phi)^T`.
//! It knows displacements as they are, so it means what it says while rotations stay small.

use super::tangent::inner;

/// Vectors `M phi` and their rates `2 zeta omega`.
#[derive(Clone, Debug, Default)]
pub struct ModalDamping {
    /// `M phi`, nodal vectors, shape (modes, nodes, 4) \[kg^(1/2), kg^(1/2) m\].
    pub vectors: Vec<Vec<[f64; 4]>>,
    /// `2 zeta omega`, shape (modes) \[1/s\].
    pub rates: Vec<f64>,
}

impl ModalDamping {
    /// Whether nothing is damped.
    pub fn is_empty(&self) -> bool {
        self.vectors.is_empty()
    }

    /// Adds the damping forces of an increment in a step of size `h`; returns the energy they take from it \[J\].
    pub fn apply(&self, increment: &[[f64; 4]], h: f64, nodal: &mut [[f64; 4]]) -> f64 {
        let mut loss = 0.0;
        for (vector, rate) in self.vectors.iter().zip(&self.rates) {
            let moved = inner(vector, increment);
            let force = rate * moved / h;
            loss += force * moved;
            for (target, v) in nodal.iter_mut().zip(vector) {
                (0..4).for_each(|i| target[i] += force * v[i]);
            }
        }
        loss
    }
}
