//! The cubic Hermite beam element: interpolation to Gauss points and integration of forces and tangent.
//!
//! Degrees of freedom of a node are (u1, u2, u1', u2'), of an element those of its two nodes.

pub use super::gauss::{
    ElementSums, ElementValues, GaussRow, SectionValues, ShearedPlace, step_point,
};
use super::membrane::MembraneTable;
use super::point::{Reference, SectionLaw};
use crate::math::hermite::{self, GAUSS, GAUSS_WEIGHTS};
use crate::math::vec2::{cross, dot4, norm};
use crate::scalar::Real;

/// An element: its interpolation, section and mass.
#[derive(Clone, Copy, Debug)]
pub struct ElementTable<S = f64> {
    /// Length between its nodes by the arc of the centre line \[m\].
    pub length: S,
    /// Rows at the Gauss points, shape (Gauss points).
    pub rows: [GaussRow<S>; GAUSS],
    /// Mass matrix of one displacement component, `int rhoA N_a N_b ds`, order (u_a, u_a', u_b, u_b'), shape (4, 4) \[kg, kg m, kg m^2\].
    pub mass: [[S; 4]; 4],
    /// Membrane strains sampled at the nodes and the middle, in elements long against the radius of gyration; in others that are made of
    /// fibres sampled at the Gauss points.
    pub membrane: Option<MembraneTable<S>>,
}

/// Position and unit tangent of a node in the reference configuration.
#[derive(Clone, Copy, Debug)]
pub struct NodeFrame {
    /// Position, shape (2) \[m\].
    pub position: [f64; 2],
    /// Tangent, shape (2) \[-\].
    pub tangent: [f64; 2],
}

impl ElementTable {
    /// Table of an element between two nodes, `length` of arc apart; `section` gives constants at a share of the length.
    ///
    /// The reference is interpolated like the displacements, so that rigid motions have zero strain. Membrane strains are sampled at the nodes and
    /// the middle if the element is long relative to the radius of gyration, with and without `fibres`: elements that can yield are the same as
    /// elastic ones.
    pub fn new(
        length: f64,
        ends: [NodeFrame; 2],
        fibres: bool,
        section: impl Fn(f64) -> SectionValues,
    ) -> Self {
        let [a, b] = ends;
        let chord = [0, 1].map(|i| b.position[i] - a.position[i]);
        let reference = ElementValues { chord, slope_a: a.tangent, slope_b: b.tangent };
        let points = hermite::gauss_points();
        let middle = section(0.5);
        let gyration = middle.law.gyration();
        let slender = length > MembraneTable::SLENDER * gyration;
        let sampled = slender || fibres;
        let rows = std::array::from_fn(|k| {
            let (first, second) = (
                chord_form(hermite::slope(points[k], length)),
                chord_form(hermite::curvature(points[k], length)),
            );
            let values = section(points[k]);
            let stretch = norm(reference.at(&first));
            let (first, second) =
                (first.map(|c| c / stretch), second.map(|c| c / (stretch * stretch)));
            let (tangent, bend) = (reference.at(&first), reference.at(&second));
            let weight = GAUSS_WEIGHTS[k] * length * stretch;
            let weighed = SectionLaw {
                axial: if sampled { 0.0 } else { values.law.axial * weight },
                bending: values.law.bending * weight,
                rotary: values.law.rotary * weight,
                ..values.law
            };
            GaussRow {
                first,
                second,
                weight,
                reference: Reference { tangent, bend, curvature: cross(tangent, bend) },
                weighed,
                section: values.law,
            }
        });
        let mass = hermite::mass(length, |xi| {
            section(xi).mass * norm(reference.at(&chord_form(hermite::slope(xi, length))))
        });
        let membrane = sampled.then(|| match slender {
            true => MembraneTable::at_nodes(length, &reference, &rows),
            false => MembraneTable::at_gauss_points(&rows),
        });
        Self { length, rows, mass, membrane }
    }
}

impl<S: Real> ElementTable<S> {
    /// Adds the mass matrix times nodal accelerations to the forces on the two nodes.
    #[inline(always)]
    pub fn add_inertia(
        &self,
        acc_a: &[S; 4],
        acc_b: &[S; 4],
        on_a: &mut [S; 4],
        on_b: &mut [S; 4],
    ) {
        let m = &self.mass;
        for i in 0..2 {
            let acc = [acc_a[i], acc_a[2 + i], acc_b[i], acc_b[2 + i]];
            let mut force = acc;
            for k in 0..4 {
                force[k] = dot4(&m[k], &acc);
            }
            on_a[i] += force[0];
            on_a[2 + i] += force[1];
            on_b[i] += force[2];
            on_b[2 + i] += force[3];
        }
    }
}

impl ElementTable {
    /// Nodes `a` and `a + 1` of the element with the forces on their values and slopes that accelerate all of it uniformly.
    pub fn uniform_force(&self, a: usize, [g1, g2]: [f64; 2]) -> [(usize, [f64; 4]); 2] {
        let m = &self.mass;
        // Columns of values summed.
        [(0, a), (2, a + 1)].map(|(row, node)| {
            let (on_value, on_slope) = (m[row][0] + m[row][2], m[row + 1][0] + m[row + 1][2]);
            (node, [on_value * g1, on_value * g2, on_slope * g1, on_slope * g2])
        })
    }
}

/// Coefficients of (u_b - u_a, u_a', u_b') from those of (u_a, u_a', u_b, u_b'), whose first and third are opposite.
fn chord_form(c: [f64; 4]) -> [f64; 3] {
    [c[2], c[1], c[3]]
}

#[cfg(test)]
mod tests;
