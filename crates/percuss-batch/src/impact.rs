//! Impulses of a rigid projectile, and the impact interval in which they act.

use super::numbers::Numbers;
use percuss::internals::scalar::Number;

/// A rigid contact, which presses in the parts of some of the lanes.
#[derive(Clone, Debug)]
pub struct Press<S: Number> {
    /// Number of the projectile \[index of a projectile\].
    pub guide: usize,
    /// Lanes in whose part it may press.
    pub which: S::Mask,
    /// Least rate of the gap at the end of the part \[m/s\].
    pub bound: S,
    /// Opening of the gap by a unit force \[m/N\].
    pub opening: S,
    /// Displacements of the nodes by it, shape (beam nodes, 4) \[m/N, 1/N\].
    pub nodal: Vec<[S; 4]>,
    /// Displacements of the projectiles by it, shape (guided projectiles) \[m/N\].
    pub ways: Vec<S>,
    /// Changes of the multipliers by it, shape (constraints) \[-, m\].
    pub multipliers: Vec<S>,
    /// Whether these belong to the factors in use.
    pub known: bool,
}

impl<S: Number> Press<S> {
    /// A contact that presses in no lane.
    pub fn new(numbers: &Numbers<S>, guide: usize) -> Self {
        let zero = numbers.step.constant(0.0);
        Self {
            guide,
            which: zero.less(zero),
            bound: zero,
            opening: zero,
            nodal: vec![[zero; 4]; numbers.nodes.len()],
            ways: vec![zero; numbers.guides.len()],
            multipliers: vec![zero; numbers.constraints.len()],
            known: false,
        }
    }
}
