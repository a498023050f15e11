//! The tangent of a step: the band of the beams with the components held at nodes, and its border of constraints.

use super::constraint;
use crate::linalg::block::Block;
use crate::linalg::chain::{Chain, SingularPivot};
use crate::linalg::dense::DenseLu;
use crate::model::Model;
use crate::model::frozen::NodeHold;

/// The band, factored in place, and the Schur complement of the border.
#[derive(Clone, Debug)]
pub struct Tangent {
    /// The band.
    pub chain: Chain,
    /// `A^-1 C^T`, one nodal vector a constraint.
    columns: Vec<Vec<[f64; 4]>>,
    /// `C A^-1 C^T`, row by row.
    schur: Vec<f64>,
    factored_schur: DenseLu,
    right: Vec<f64>,
}

/// Why a tangent cannot be factored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Singular {
    /// At a node.
    Node(usize),
    /// In the border of constraints.
    Constraints,
}

impl From<SingularPivot> for Singular {
    fn from(pivot: SingularPivot) -> Self {
        Self::Node(pivot.node)
    }
}

impl Tangent {
    /// Room for the tangent of `model`.
    pub fn new(model: &Model) -> Self {
        let (n, k) = (model.node_count(), model.constraints.len());
        Self {
            chain: Chain::zeros(n),
            columns: vec![vec![[0.0; 4]; n]; k],
            schur: vec![0.0; k * k],
            factored_schur: DenseLu::default(),
            right: vec![0.0; k],
        }
    }

    /// Factors the assembled band with its held components, and the border, whose columns are the constraint gradients
    /// at the midpoint and whose rows those at the end of the step.
    ///
    /// # Errors
    /// Where it is singular.
    pub fn factor(
        &mut self,
        model: &Model,
        u: &[[f64; 4]],
        increment: &[[f64; 4]],
    ) -> Result<(), Singular> {
        for hold in &model.holds {
            hold_block(&mut self.chain, hold);
        }
        self.chain.factor()?;
        let k = model.constraints.len();
        if k == 0 {
            return Ok(());
        }
        for (c, column) in model.constraints.iter().zip(&mut self.columns) {
            column.fill([0.0; 4]);
            constraint::add_gradient(c, u, increment, 0.5, 1.0, column);
            project(model, column);
            self.chain.solve(column);
            project(model, column);
        }
        for (i, c) in model.constraints.iter().enumerate() {
            for (j, column) in self.columns.iter().enumerate() {
                self.schur[i * k + j] = constraint::derivative(c, u, increment, column);
            }
        }
        if self.factored_schur.factor(k, &self.schur) { Ok(()) } else { Err(Singular::Constraints) }
    }

    /// Solves `A x + C^T dl = x_given`, `C x = -c` in place and adds dl to `multiplier`.
    ///
    /// c is the change of each constraint over the step plus a share `feedback` of what it was at the start, or zero without
    /// feedback. The share is that of the step in the given step size: round-off of positions, taken back within a very
    /// short step, would be a velocity.
    pub fn solve(
        &mut self,
        model: &Model,
        u: &[[f64; 4]],
        increment: &[[f64; 4]],
        x: &mut [[f64; 4]],
        multiplier: &mut [f64],
        feedback: Option<f64>,
    ) {
        project(model, x);
        self.chain.solve(x);
        project(model, x);
        if model.constraints.is_empty() {
            return;
        }
        for (c, right) in model.constraints.iter().zip(&mut self.right) {
            let value = feedback.map_or(0.0, |share| {
                constraint::change(c, u, increment) + share * constraint::start_value(c, u)
            });
            *right = value + constraint::derivative(c, u, increment, x);
        }
        self.factored_schur.solve(&mut self.right);
        for ((column, change), multiplier) in self.columns.iter().zip(&self.right).zip(multiplier) {
            *multiplier += change;
            for (target, c) in x.iter_mut().zip(column) {
                for i in 0..4 {
                    target[i] -= change * c[i];
                }
            }
        }
    }
}

/// Removes the held components of nodal values.
pub fn project(model: &Model, nodal: &mut [[f64; 4]]) {
    for hold in &model.holds {
        let x = &mut nodal[hold.node];
        for n in &hold.normals {
            let along = n[0] * x[0] + n[1] * x[1] + n[2] * x[2] + n[3] * x[3];
            for i in 0..4 {
                x[i] -= along * n[i];
            }
        }
    }
}

/// Replaces the rows and columns of held components: `P A P + s N N^T` with the scale s of the block.
fn hold_block(chain: &mut Chain, hold: &NodeHold) {
    let i = hold.node;
    let mut p: Block = [[0.0; 4]; 4];
    let mut held: Block = [[0.0; 4]; 4];
    let diag = &chain.diag[i];
    let scale = (0..4).map(|k| diag[k][k].abs()).fold(0.0_f64, f64::max).max(1e-300);
    for r in 0..4 {
        p[r][r] = 1.0;
        for c in 0..4 {
            for n in &hold.normals {
                p[r][c] -= n[r] * n[c];
                held[r][c] += scale * n[r] * n[c];
            }
        }
    }
    use crate::linalg::block::mul;
    let mut block = mul(&mul(&p, diag), &p);
    for r in 0..4 {
        for c in 0..4 {
            block[r][c] += held[r][c];
        }
    }
    chain.diag[i] = block;
    chain.upper[i] = mul(&p, &chain.upper[i]);
    chain.lower[i] = mul(&chain.lower[i], &p);
    if i > 0 {
        chain.upper[i - 1] = mul(&chain.upper[i - 1], &p);
        chain.lower[i - 1] = mul(&p, &chain.lower[i - 1]);
    }
}
