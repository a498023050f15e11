//! What the values of a row follow from.

use crate::analysis::section_forces::Lines;
use crate::contact::search::Search;
use crate::ledger::Measures;
use crate::state::State;

/// A state at which a row is taken, and changes since the previous row.
pub struct Now<'a> {
    pub state: &'a State,
    pub measures: &'a Measures,
    /// Impulses along normal and tangent, shape (contacts, 2) \[N s\].
    pub impulse: &'a [[f64; 2]],
    /// Rotations of the recorded points in the current state, shape (points) \[rad\].
    pub rotations: &'a [f64],
    /// Pairs evaluated in the current state, and bounds for the gaps of the others.
    pub search: &'a Search,
    /// Mean reactions, shape (supports, 3) \[N, N m\].
    pub reactions: &'a [[f64; 3]],
    /// Their additional impulses, shape (supports, 3) \[N s, N m s\].
    pub reaction_impulses: &'a [[f64; 3]],
    /// Section forces of the last step without impact.
    pub lines: &'a Lines,
    /// Velocity of the accelerated base, shape (2) \[m/s\].
    pub base_velocity: [f64; 2],
    /// Newton iterations.
    pub iterations: usize,
}
