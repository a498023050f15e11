//! Inertia of a velocity field in a configuration within a step.

use super::super::end_forces::EndForces;
use crate::element::beam::{ElementSums, ElementTable, ElementValues};
use crate::element::point::PointResponse;
use crate::math::vec2::{add, cross, dot, scale};
use crate::model::Model;

/// A configuration within a step.
pub(super) struct Middle<'a> {
    pub model: &'a Model,
    /// Displacements of the nodes at the start of the step, shape (nodes, 4) \[m, -, rad\].
    pub start: &'a [[f64; 4]],
    /// Their increments over the step, shape (nodes, 4) \[m, -, rad\].
    pub increment: &'a [[f64; 4]],
    pub share: f64,
    /// Whether no element connects a node to the next one, from the state, shape (beam nodes), or empty \[-\].
    pub parted: &'a [bool],
}

impl<'a> Middle<'a> {
    /// Table and number of the element that starts at a node.
    pub fn element(&self, a: usize) -> (&'a ElementTable, usize) {
        let (span, k) = self.model.element_of(a);
        (span.table(k), span.elements.start + k)
    }

    /// Tangent at Gauss point `j` of the element that starts at node `a`.
    pub fn tangent(&self, a: usize, j: usize) -> [f64; 2] {
        let row = &self.element(a).0.rows[j];
        let at = |x: &[[f64; 4]]| ElementValues::new(&x[a], &x[a + 1]).at(&row.first);
        add(row.reference.tangent, add(at(self.start), scale(self.share, at(self.increment))))
    }

    /// `(g x g_dot) / a` there, of a nodal field; sections of a fractured element do not rotate.
    pub fn turning(&self, a: usize, j: usize, field: &[[f64; 4]]) -> f64 {
        if self.parted.get(a).is_some_and(|parted| *parted) {
            return 0.0;
        }
        let (g, row) = (self.tangent(a, j), &self.element(a).0.rows[j]);
        cross(g, ElementValues::new(&field[a], &field[a + 1]).at(&row.first)) / dot(g, g)
    }

    /// The tangent at point mass `i`, and `(g x g_dot) / a` there.
    pub fn mass_turning(&self, i: usize, field: &[[f64; 4]]) -> ([f64; 2], f64) {
        let p = &self.model.masses[i].point;
        let moved = add(p.gradient(self.start), scale(self.share, p.gradient(self.increment)));
        let g = add(p.tangent, moved);
        (g, cross(g, p.gradient(field)) / dot(g, g))
    }

    /// Adds `factor` times the inertia of an acceleration field of an element.
    pub fn add_element_inertia(
        &self,
        a: usize,
        field: &[[f64; 4]],
        factor: f64,
        nodal: &mut [[f64; 4]],
        ends: &mut EndForces,
    ) {
        let (table, element) = self.element(a);
        let mut sums = ElementSums::zero(0.0);
        for (j, row) in table.rows.iter().enumerate() {
            let g = self.tangent(a, j);
            let moment = row.weighed.rotary * self.turning(a, j, field);
            let force_g =
                if moment == 0.0 { [0.0; 2] } else { scale(moment / dot(g, g), [-g[1], g[0]]) };
            let response = PointResponse { force_g, force_p: [0.0; 2], tangent: [[0.0; 4]; 4] };
            sums.add::<false>(row, &response);
        }
        let turning = sums.nodal_force();
        let translation = times_mass(table, &field[a], &field[a + 1]);
        let mut forces = [[0.0; 4]; 2];
        for k in 0..2 {
            for i in 0..4 {
                forces[k][i] = factor * (turning[k][i] + translation[k][i]);
                nodal[a + k][i] += forces[k][i];
            }
        }
        ends.add_on_nodes(self.model, element, &forces);
    }
}

/// `M x` of an element, per node.
pub(super) fn times_mass(table: &ElementTable, a: &[f64; 4], b: &[f64; 4]) -> [[f64; 4]; 2] {
    let mut out = [[0.0; 4]; 2];
    for i in 0..2 {
        let x = [a[i], a[2 + i], b[i], b[2 + i]];
        let p = table.mass.map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3] * x[3]);
        (out[0][i], out[0][2 + i], out[1][i], out[1][2 + i]) = (p[0], p[1], p[2], p[3]);
    }
    out
}
