//! Impulses of a rigid projectile, and the impact interval they act in.

use super::numbers::Numbers;
use percuss::internals::scalar::Number;

/// A rigid contact, which presses in the parts of some of the runs side by side.
#[derive(Clone, Debug)]
pub struct Press<S: Number> {
    /// Number of the projectile \[index of a projectile\].
    pub guide: usize,
    /// Lanes in whose part it may press.
    pub which: S::Mask,
    /// Least rate of the gap at the end of the part \[m/s\].
    pub bound: S,
    /// How far a unit force opens the gap \[m/N\].
    pub opening: S,
    /// How far it moves the nodes, shape (beam nodes, 4) \[m/N, 1/N\].
    pub nodal: Vec<[S; 4]>,
    /// How far it moves the projectiles, shape (guided projectiles) \[m/N\].
    pub ways: Vec<S>,
    /// What it changes of the multipliers, shape (constraints) \[-, m\].
    pub multipliers: Vec<S>,
    /// Whether these are those of the factors in use.
    pub known: bool,
}

impl<S: Number> Press<S> {
    /// Of a projectile that presses nowhere.
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
