//! Fixed components of nodes, projected out of vectors and blocks.

use crate::linalg::block::{Block, IDENTITY, mul};
use crate::linalg::chain::Chain;
use crate::math::vec2::dot4;
use crate::model::Model;
use crate::model::frozen::PrescribedDofs;
use crate::scalar::Number;

/// Removes the fixed components of nodal values.
pub fn project(model: &Model, nodal: &mut [[f64; 4]]) {
    project_held(&model.prescribed, nodal);
}

/// Removes given components of nodal values.
#[inline(always)]
pub fn project_held<S: Number>(prescribed: &[PrescribedDofs<S>], nodal: &mut [[S; 4]]) {
    for dofs in prescribed {
        dofs.project(&mut nodal[dofs.node]);
    }
}

impl<S: Number> PrescribedDofs<S> {
    /// Removes the fixed components of the node's values: `P x`.
    #[inline(always)]
    pub fn project(&self, x: &mut [S; 4]) {
        let Some(held) = self.components else {
            for normal in &self.normals {
                let along = dot4(normal, x);
                for k in 0..4 {
                    x[k] = x[k].sub_product(along, normal[k]);
                }
            }
            return;
        };
        for k in 0..4 {
            if held[k] {
                x[k] = x[k].constant(0.0);
            }
        }
    }

    /// Removes the rows of fixed components: `P A`.
    #[inline(always)]
    pub fn project_rows(&self, block: &mut Block<S>) {
        let Some(held) = self.components else {
            *block = mul(&self.free, block);
            return;
        };
        for k in 0..4 {
            if held[k] {
                block[k] = [block[k][0].constant(0.0); 4];
            }
        }
    }

    /// Removes the columns of fixed components: `A P`.
    #[inline(always)]
    pub fn project_columns(&self, block: &mut Block<S>) {
        let Some(held) = self.components else {
            *block = mul(block, &self.free);
            return;
        };
        for row in block {
            for k in 0..4 {
                if held[k] {
                    row[k] = row[k].constant(0.0);
                }
            }
        }
    }

    /// Replaces the rows and columns of fixed components in the node's own block: `P A P + s N N^T` with the scale s of the block.
    #[inline(always)]
    fn hold_block(&self, block: &mut Block<S>) {
        // Fixed directions have the scale of the others, or round-off in them would be amplified.
        let mut scale = block[0][0].constant(1e-300);
        for k in 0..4 {
            scale = scale.max(block[k][k].abs());
        }
        self.project_rows(block);
        self.project_columns(block);
        let Some(held) = self.components else {
            for normal in &self.normals {
                for r in 0..4 {
                    for c in 0..4 {
                        block[r][c] = block[r][c].add_product(scale * normal[r], normal[c]);
                    }
                }
            }
            return;
        };
        for k in 0..4 {
            if held[k] {
                block[k][k] = scale;
            }
        }
    }

    /// The same in all blocks of a band, whose node `i` is `linked` to the next one.
    #[inline(always)]
    pub fn hold_in(
        &self,
        [diag, upper, lower]: [&mut [Block<S>]; 3],
        linked: impl Fn(usize) -> bool,
    ) {
        let i = self.node;
        self.hold_block(&mut diag[i]);
        if linked(i) {
            self.project_rows(&mut upper[i]);
            self.project_columns(&mut lower[i]);
        }
        if i > 0 && linked(i - 1) {
            self.project_columns(&mut upper[i - 1]);
            self.project_rows(&mut lower[i - 1]);
        }
    }
}

/// Replaces the rows and columns of fixed components.
pub fn prescribe_block(chain: &mut Chain, dofs: &PrescribedDofs, linked: &[bool]) {
    let i = dofs.node;
    if dofs.is_whole() && !linked[i] && (i == 0 || !linked[i - 1]) {
        chain.diag[i] = IDENTITY;
        return;
    }
    dofs.hold_in([&mut chain.diag, &mut chain.upper, &mut chain.lower], |i| linked[i]);
}

/// Removes fixed components from a block between two nodes.
pub fn project_coupling(model: &Model, a: usize, b: usize, block: &mut Block) {
    if let Some(dofs) = model.dofs_at(a) {
        dofs.project_rows(block);
    }
    if let Some(dofs) = model.dofs_at(b) {
        dofs.project_columns(block);
    }
}
