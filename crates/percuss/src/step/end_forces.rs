//! Forces on the ends of elements, from the last assembly.

use crate::model::Model;
use crate::step::sweep::Sweep;

/// Forces on the elements, from the last assembly, which give the section forces.
#[derive(Clone, Debug, Default)]
pub struct EndForces {
    /// As [`Self::on_nodes()`] of spans that are not swept, shape (elements, 2, 4) \[N, N m\]; empty if all are.
    pub(super) on_nodes: Vec<[[f64; 4]; 2]>,
    /// As [`Self::inertia()`], shape (beam nodes, 4) \[m/s^2, 1/s^2\]; empty if all are.
    pub(super) inertia: Vec<[f64; 4]>,
    /// Elements that are evaluated side by side.
    pub sweep: Sweep,
}

impl EndForces {
    /// State before any assembly; the default is that of statics, which evaluates elements one by one.
    pub fn new(model: &Model) -> Self {
        Self { sweep: Sweep::new(model), ..Self::default() }
    }

    /// Allocates memory for elements that are evaluated one by one: for a long swept beam it would be a sixteenth of its memory.
    pub(super) fn make_room(&mut self, model: &Model) {
        if self.on_nodes.is_empty() {
            self.on_nodes = vec![[[0.0; 4]; 2]; model.element_count()];
            self.inertia = vec![[0.0; 4]; model.beam_node_count()];
        }
    }

    /// Forces on both nodes of an element of the span of the given number, inertia and gravity included, loads along it not, shape (2, 4)
    /// \[N, N m\].
    pub fn on_nodes(&self, span: usize, element: usize) -> [[f64; 4]; 2] {
        if self.sweep.has_evaluated(span) {
            return self.sweep.on_nodes(element);
        }
        self.on_nodes[element]
    }

    /// Acceleration of a node of the span of the given number, less gravity, with mass-proportional damping, shape (4)
    /// \[m/s^2, 1/s^2\].
    pub fn inertia(&self, span: usize, node: usize) -> [f64; 4] {
        if self.sweep.has_evaluated(span) { self.sweep.inertia(node) } else { self.inertia[node] }
    }

    /// Adds forces on both nodes of an element.
    pub fn add_on_nodes(&mut self, model: &Model, element: usize, forces: &[[f64; 4]; 2]) {
        let span = model.spans.partition_point(|span| span.elements.end <= element);
        if self.sweep.has_evaluated(span) {
            return self.sweep.add_on_nodes(element, forces);
        }
        self.make_room(model);
        for (own, force) in
            self.on_nodes[element].as_flattened_mut().iter_mut().zip(forces.as_flattened())
        {
            *own += force;
        }
    }

    /// Adds to the acceleration of a node.
    pub fn add_inertia(&mut self, model: &Model, node: usize, acceleration: &[f64; 4]) {
        let span = model.spans.partition_point(|span| span.nodes.end <= node);
        if self.sweep.has_evaluated(span) {
            return self.sweep.add_inertia(node, acceleration);
        }
        self.make_room(model);
        (0..4).for_each(|i| self.inertia[node][i] += acceleration[i]);
    }
}
