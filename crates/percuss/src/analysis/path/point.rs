//! A point of a path of equilibria, and its recorder.

use crate::analysis::equilibrium::Equilibrium;

/// A point of an equilibrium path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathPoint {
    /// Factor on the loads that act at time zero.
    pub factor: f64,
    /// Displacements of the recorded points, in their order, shape (points, 2) \[m\].
    pub displacements: Vec<[f64; 2]>,
    /// Whether the structure returns to it under its loads: no motion about it grows.
    pub stable: bool,
}

/// Receives equilibria along a path, for drawings.
pub trait PathRecorder {
    /// Whether the equilibrium at a point is requested; `limit` at a limit point. Limit points come between the points before and after them.
    fn wants(&mut self, limit: bool) -> bool;

    /// Called with a requested equilibrium and its load factor.
    fn equilibrium(&mut self, factor: f64, limit: bool, found: &Equilibrium);
}
