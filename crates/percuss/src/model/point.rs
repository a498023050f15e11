//! Points that a mesh carries along.

use crate::element::shear::StretchedPlace;
use crate::math::vec2::{add, dot4, middle};
use crate::scalar::Real;

/// A material point: its position in the mesh and its dependence on the nodes.
#[derive(Clone, Debug)]
pub struct MaterialPoint<S = f64> {
    pub label: String,
    pub beam: usize,
    /// Node `a` of the element; node `b` is the next one.
    pub node: usize,
    /// Share of the element's length at which it is \[-\].
    pub xi: S,
    /// Arc length from the start of the beam \[m\].
    pub s: S,
    /// Coefficients of its displacement, on (u_a, u_a', u_b, u_b'), shape (4) \[-, m, -, m\]: those of the field inside its element.
    pub shape: [S; 4],
    /// Coefficients of its tangent x', of a shear-flexible beam of the vector d of its section, shape (4) \[1/m, -, 1/m, -\].
    pub slope: [S; 4],
    /// Reference position, shape (2) \[m\].
    pub position: [S; 2],
    /// Reference tangent, shape (2) \[-\].
    pub tangent: [S; 2],
    /// Of a place inside a shear-flexible element what stretch adds to its displacement.
    pub stretched: Option<Box<StretchedPlace>>,
}

impl<S: Real> MaterialPoint<S> {
    /// Interpolates nodal values with the shape functions.
    #[inline(always)]
    pub fn value(&self, nodal: &[[S; 4]]) -> [S; 2] {
        combine(nodal, self.node, &self.shape)
    }

    /// Interpolates nodal values with the derivatives of the shape functions.
    #[inline(always)]
    pub fn gradient(&self, nodal: &[[S; 4]]) -> [S; 2] {
        combine(nodal, self.node, &self.slope)
    }

    /// Position and tangent in the middle of a step from displacements `u` by `d`.
    #[inline(always)]
    pub fn middle(&self, u: &[[S; 4]], d: &[[S; 4]]) -> [[S; 2]; 2] {
        [
            add(self.position, middle(self.value(u), self.value(d))),
            add(self.tangent, middle(self.gradient(u), self.gradient(d))),
        ]
    }

    /// Adds `shape^T f` to nodal forces.
    #[inline(always)]
    pub fn spread(&self, force: [S; 2], nodal: &mut [[S; 4]]) {
        spread(&self.shape, self.node, force, nodal);
    }

    /// Adds `shape^T f` to the forces on the two nodes of its element.
    pub fn spread_over(&self, force: [S; 2], nodes: &mut [[S; 4]; 2]) {
        spread(&self.shape, 0, force, nodes);
    }

    /// Adds `slope^T f` to the forces on the two nodes of its element.
    pub fn spread_gradient_over(&self, force: [S; 2], nodes: &mut [[S; 4]; 2]) {
        spread(&self.slope, 0, force, nodes);
    }

    /// Adds `slope^T f` to nodal forces.
    #[inline(always)]
    pub fn spread_gradient(&self, force: [S; 2], nodal: &mut [[S; 4]]) {
        spread(&self.slope, self.node, force, nodal);
    }
}

impl<S: Copy> MaterialPoint<S> {
    /// The same with every number replaced, in a fixed order.
    pub fn map<T>(&self, f: &mut impl FnMut(S) -> T) -> MaterialPoint<T> {
        MaterialPoint {
            label: self.label.clone(),
            beam: self.beam,
            node: self.node,
            xi: f(self.xi),
            s: f(self.s),
            shape: self.shape.map(&mut *f),
            slope: self.slope.map(&mut *f),
            position: self.position.map(&mut *f),
            tangent: self.tangent.map(&mut *f),
            stretched: self.stretched.clone(),
        }
    }
}

impl MaterialPoint {
    /// Its displacement, as it is reported: that of [`value`](Self::value), by which forces act, and the stretch of its element.
    pub fn displacement(&self, u: &[[f64; 4]]) -> [f64; 2] {
        let moved = self.value(u);
        let nodes = || [&u[self.node], &u[self.node + 1]];
        self.stretched.as_ref().map_or(moved, |own| add(moved, own.displacement(nodes())))
    }

    /// Its velocity, likewise.
    pub fn velocity(&self, u: &[[f64; 4]], v: &[[f64; 4]]) -> [f64; 2] {
        let moves = self.value(v);
        let of = |nodal: &'_ [[f64; 4]]| [nodal[self.node], nodal[self.node + 1]];
        self.stretched.as_ref().map_or(moves, |own| {
            let ([a, b], [c, d]) = (of(u), of(v));
            add(moves, own.velocity([&a, &b], [&c, &d]))
        })
    }

    /// Beam of a point that is none of a beam: the centre of a body.
    pub const OF_BODY: usize = usize::MAX;

    /// Node of the body whose centre it is; none of a point of a beam.
    pub fn body_node(&self) -> Option<usize> {
        let own = || if self.shape[0] == 0.0 { self.node + 1 } else { self.node };
        (self.beam == Self::OF_BODY).then(own)
    }
}

/// Interpolates nodal values with shape functions, or their derivatives, of the element of a node.
#[inline(always)]
pub fn combine<S: Real>(nodal: &[[S; 4]], node: usize, n: &[S; 4]) -> [S; 2] {
    let (a, b) = (&nodal[node], &nodal[node + 1]);
    [dot4(n, &[a[0], a[2], b[0], b[2]]), dot4(n, &[a[1], a[3], b[1], b[3]])]
}

#[inline(always)]
fn spread<S: Real>(n: &[S; 4], node: usize, force: [S; 2], nodal: &mut [[S; 4]]) {
    for i in 0..2 {
        nodal[node][i] = nodal[node][i].add_product(n[0], force[i]);
        nodal[node][2 + i] = nodal[node][2 + i].add_product(n[1], force[i]);
        nodal[node + 1][i] = nodal[node + 1][i].add_product(n[2], force[i]);
        nodal[node + 1][2 + i] = nodal[node + 1][2 + i].add_product(n[3], force[i]);
    }
}
