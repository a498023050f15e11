//! Constraints at single nodes, such as the unit length of a node's vector, reduced inside the band.
//!
//! With `c x = s` at a node and forces along m, one of its components follows from the others: `x = T y + x0` with `c T = 0`, and equations are
//! taken along the columns of Tm with `m Tm = 0`, as in a cluster. Row and column of that component are then those of the identity: the band keeps its
//! shape, and the node is no interface node.

use super::super::block::Block;
use super::super::chain::Chain;
use super::super::cluster::BorderVector;
use crate::math::vec2::dot4;

/// Least product of the coefficients of a dependent component in the constraint and in the direction of its force.
const LEAST_PRODUCT: f64 = 1e-10;

/// A constraint at a node of the band, with the data of its reduction.
#[derive(Clone, Debug)]
pub(super) struct NodalConstraint {
    /// Its number.
    pub(super) number: usize,
    node: usize,
    /// Whether the band links the node to the one before it, and to the one after it, shape (2) \[-\].
    linked: [bool; 2],
    /// The component that follows from the others.
    dependent: usize,
    /// Coefficient of that component in the constraint, and in the direction of its force, shape (2) \[-\].
    own: [f64; 2],
    /// Coefficients of the constraint relative to that one, shape (4) \[1/m, 1/m, -, -\].
    trial: [f64; 4],
    /// The direction of its force, likewise, shape (4) \[1/m, 1/m, -, -\].
    test: [f64; 4],
    /// Row of the component in the band: in the columns of the node before, its own and the node after, shape (3, 4) \[N, N, N m, N m\].
    row: [[f64; 4]; 3],
    /// Its column, likewise, shape (3, 4) \[N, N, N m, N m\].
    column: [[f64; 4]; 3],
    /// Value of the component in x0.
    particular: f64,
    /// Right side of its equation, less the contribution of x0.
    right: f64,
}

impl NodalConstraint {
    /// The constraint of the given number, at a node that the band links to the one before and to the one after it.
    pub(super) fn new(number: usize, node: usize, linked: [bool; 2]) -> Self {
        Self {
            number,
            node,
            linked,
            dependent: 0,
            own: [0.0; 2],
            trial: [0.0; 4],
            test: [0.0; 4],
            row: [[0.0; 4]; 3],
            column: [[0.0; 4]; 3],
            particular: 0.0,
            right: 0.0,
        }
    }

    /// Chooses the dependent component for the present coefficients; `false` if there is none.
    fn choose(&mut self, constraint: &[f64; 4], force: &[f64; 4]) -> bool {
        let product = |k: usize| (constraint[k] * force[k]).abs();
        let d = (1..4).fold(0, |best, k| if product(k) > product(best) { k } else { best });
        self.dependent = d;
        self.own = [constraint[d], force[d]];
        // Quotients: that of the component itself is exactly one.
        self.trial = constraint.map(|c| c / constraint[d]);
        self.test = force.map(|c| c / force[d]);
        product(d) > LEAST_PRODUCT
    }

    /// Stores row and column of the dependent component, as assembled.
    fn store(&mut self, chain: &Chain) {
        let (i, d) = (self.node, self.dependent);
        let column = |block: &Block| [block[0][d], block[1][d], block[2][d], block[3][d]];
        (self.row[1], self.column[1]) = (chain.diag[i][d], column(&chain.diag[i]));
        let [before, after] = self.linked;
        if before {
            (self.row[0], self.column[0]) = (chain.lower[i - 1][d], column(&chain.upper[i - 1]));
        }
        if after {
            (self.row[2], self.column[2]) = (chain.upper[i][d], column(&chain.lower[i]));
        }
    }

    /// `Tm^T A T` in the blocks of the node.
    fn reduce_band(&self, chain: &mut Chain) {
        let (i, d) = (self.node, self.dependent);
        let own = &mut chain.diag[i];
        self.reduce_rows(own);
        self.reduce_columns(own);
        own[d][d] = 1.0;
        let [before, after] = self.linked;
        if before {
            self.reduce_rows(&mut chain.lower[i - 1]);
            self.reduce_columns(&mut chain.upper[i - 1]);
        }
        if after {
            self.reduce_rows(&mut chain.upper[i]);
            self.reduce_columns(&mut chain.lower[i]);
        }
    }

    /// `Tm^T A`; the row of the dependent component is zero afterwards.
    fn reduce_rows(&self, block: &mut Block) {
        let own = block[self.dependent];
        for (row, share) in block.iter_mut().zip(self.test) {
            for k in 0..4 {
                row[k] -= share * own[k];
            }
        }
    }

    /// `A T`; the column of the dependent component is zero afterwards.
    fn reduce_columns(&self, block: &mut Block) {
        for row in block {
            let own = row[self.dependent];
            for k in 0..4 {
                row[k] -= self.trial[k] * own;
            }
        }
    }

    /// Nodes with a share in the row of the dependent component: the number of their part, and their own.
    fn parts(&self) -> impl Iterator<Item = (usize, usize)> {
        let (i, [before, after]) = (self.node, self.linked);
        let before = before.then(|| (0, i - 1));
        before.into_iter().chain([(1, i)]).chain(after.then_some((2, i + 1)))
    }

    /// Computes x0 for the constraint's right side, and subtracts what it contributes to the equations.
    fn take_particular(&mut self, right: f64, x: &mut [[f64; 4]]) {
        self.particular = right / self.own[0];
        if self.particular == 0.0 {
            return;
        }
        for (part, node) in self.parts() {
            for k in 0..4 {
                x[node][k] -= self.column[part][k] * self.particular;
            }
        }
    }

    /// The multiplier, from the equation of the dependent component.
    fn multiplier(&self, x: &[[f64; 4]]) -> f64 {
        let acting: f64 = self.parts().map(|(part, node)| dot4(&self.row[part], &x[node])).sum();
        (self.right - acting) / self.own[1]
    }
}

/// Reduces the band, before its factorisation, by the present coefficients; `false` if a constraint has none.
pub(super) fn reduce(
    all: &mut [NodalConstraint],
    chain: &mut Chain,
    (rows, columns): (&[BorderVector], &[BorderVector]),
) -> bool {
    for one in &mut *all {
        let (c, m) = (&rows[one.number][0].1, &columns[one.number][0].1);
        if !one.choose(c, m) {
            return false;
        }
        one.store(chain);
    }
    all.iter().for_each(|one| one.reduce_band(chain));
    true
}

/// Reduces the right side: nodal values and, by number, those of the constraints.
pub(super) fn reduce_right(all: &mut [NodalConstraint], x: &mut [[f64; 4]], border: &[f64]) {
    all.iter_mut().for_each(|one| one.take_particular(border[one.number], x));
    for one in all {
        let x = &mut x[one.node];
        one.right = x[one.dependent];
        for k in 0..4 {
            x[k] -= one.test[k] * one.right;
        }
    }
}

/// Completes the solution of the reduced system, and enters the multipliers by number.
pub(super) fn complete(all: &[NodalConstraint], x: &mut [[f64; 4]], border: &mut [f64]) {
    for one in all {
        let x = &mut x[one.node];
        x[one.dependent] = 0.0;
        x[one.dependent] = -dot4(&one.trial, x);
    }
    // The contribution of x0 has been subtracted already.
    all.iter().for_each(|one| border[one.number] = one.multiplier(x));
    all.iter().for_each(|one| x[one.node][one.dependent] += one.particular);
}
