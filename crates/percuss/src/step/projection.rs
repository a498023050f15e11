//! Components held at nodes, projected out of vectors and blocks.

use crate::linalg::block::{Block, IDENTITY, ZERO, mul};
use crate::linalg::chain::Chain;
use crate::model::Model;
use crate::model::frozen::PrescribedDofs;

/// Removes the held components of nodal values.
pub fn project(model: &Model, nodal: &mut [[f64; 4]]) {
    for dofs in &model.prescribed {
        project_node(dofs, &mut nodal[dofs.node]);
    }
}

/// Removes the held components of a node's values.
pub fn project_node(dofs: &PrescribedDofs, x: &mut [f64; 4]) {
    if dofs.is_whole() {
        *x = [0.0; 4];
        return;
    }
    for n in &dofs.normals {
        let along = n[0] * x[0] + n[1] * x[1] + n[2] * x[2] + n[3] * x[3];
        for i in 0..4 {
            x[i] -= along * n[i];
        }
    }
}

/// Replaces the rows and columns of held components: `P A P + s N N^T` with the scale s of the block.
pub fn prescribe_block(chain: &mut Chain, dofs: &PrescribedDofs, linked: &[bool]) {
    let (i, p) = (dofs.node, &dofs.free);
    if dofs.is_whole() && !linked[i] && (i == 0 || !linked[i - 1]) {
        chain.diag[i] = IDENTITY;
        return;
    }
    let diag = &chain.diag[i];
    let scale = (0..4).map(|k| diag[k][k].abs()).fold(0.0_f64, f64::max).max(1e-300);
    if dofs.is_whole() {
        chain.diag[i] = IDENTITY.map(|row| row.map(|x| scale * x));
        if linked[i] {
            (chain.upper[i], chain.lower[i]) = (ZERO, ZERO);
        }
        if i > 0 && linked[i - 1] {
            (chain.upper[i - 1], chain.lower[i - 1]) = (ZERO, ZERO);
        }
        return;
    }
    let mut block = mul(&mul(p, diag), p);
    for n in &dofs.normals {
        for r in 0..4 {
            for c in 0..4 {
                block[r][c] += scale * n[r] * n[c];
            }
        }
    }
    chain.diag[i] = block;
    if linked[i] {
        chain.upper[i] = mul(p, &chain.upper[i]);
        chain.lower[i] = mul(&chain.lower[i], p);
    }
    if i > 0 && linked[i - 1] {
        chain.upper[i - 1] = mul(&chain.upper[i - 1], p);
        chain.lower[i - 1] = mul(p, &chain.lower[i - 1]);
    }
}

/// Removes held components from a block between two nodes.
pub fn project_coupling(model: &Model, a: usize, b: usize, block: &mut Block) {
    if let Some(dofs) = model.dofs_at(a) {
        *block = mul(&dofs.free, block);
    }
    if let Some(dofs) = model.dofs_at(b) {
        *block = mul(block, &dofs.free);
    }
}
