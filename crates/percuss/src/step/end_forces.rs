//! What acts on the elements.

use super::sweep::Sweep;
use crate::model::Model;

/// What acts on the elements, as last assembled: section forces follow from it.
#[derive(Clone, Debug, Default)]
pub struct EndForces {
    /// Forces on both nodes of each element, inertia and gravity included, loads along it not, shape (elements, 2, 4) \[N, N m\].
    pub on_nodes: Vec<[[f64; 4]; 2]>,
    /// Accelerations of the beams' nodes, less gravity, with mass-proportional damping, shape (beam nodes, 4) \[m/s^2, 1/s^2\].
    pub inertia: Vec<[f64; 4]>,
    /// Elements that are evaluated side by side.
    pub sweep: Sweep,
}

impl EndForces {
    /// Nothing assembled yet.
    pub fn new(model: &Model) -> Self {
        Self { sweep: Sweep::new(model), ..Self::one_by_one(model) }
    }

    /// The same for statics, which evaluates elements one by one.
    pub fn one_by_one(model: &Model) -> Self {
        Self {
            on_nodes: vec![[[0.0; 4]; 2]; model.element_count()],
            inertia: vec![[0.0; 4]; model.beam_node_count()],
            sweep: Sweep::default(),
        }
    }
}
