//! Bodies in contact with only one element of a beam: eliminated onto its nodes before the band is factored, at negligible cost.

use crate::linalg::block::{self, Block, ZERO, mul};
use crate::linalg::chain::Chain;

/// The eliminated bodies, with the data of their solution.
#[derive(Clone, Debug, Default)]
pub struct CondensedBodies {
    /// One entry a body eliminated, shape (bodies eliminated).
    bodies: Vec<CondensedBody>,
}

#[derive(Clone, Copy, Debug)]
struct CondensedBody {
    body: usize,
    /// Nodes that it touches, those in use first, shape (2) \[index of a node\].
    nodes: [usize; 2],
    count: usize,
    /// `C K^-1` of each node's row: contribution of the body's right side there, shape (2, 4, 4) \[-, m, 1/m\].
    onto: [Block; 2],
    /// `K^-1 D` of each node's column: contribution of the node's value to the body's, shape (2, 4, 4) \[-, m, 1/m\].
    from: [Block; 2],
}

impl CondensedBodies {
    /// Forgets all.
    pub fn clear(&mut self) {
        self.bodies.clear();
    }

    /// Eliminates bodies (nodes from `first` on) whose couplings are all with one element and that no spring ties to others; removes their couplings.
    ///
    /// # Errors
    /// The node of a body whose block is singular.
    pub fn eliminate(
        &mut self,
        chain: &mut Chain,
        (linked, tied): (&[bool], &[usize]),
        first: usize,
        couplings: &mut Vec<(usize, usize, Block)>,
    ) -> Result<(), usize> {
        for (a, b, _) in couplings.iter() {
            let body = (*a).max(*b);
            if body < first || tied.contains(&body) || self.bodies.iter().any(|s| s.body == body) {
                continue;
            }
            if let Some(found) = condensed_body(body, linked, first, couplings) {
                self.bodies.push(found);
            }
        }
        for s in &mut self.bodies {
            // That of a guided projectile is diagonal.
            let inverse = block::inverse_alone(&chain.diag[s.body]).ok_or(s.body)?;
            let find = |row: usize, column: usize| {
                let at = couplings.iter().find(|c| c.0 == row && c.1 == column);
                at.map_or(&ZERO, |c| &c.2)
            };
            for i in 0..s.count {
                s.onto[i] = mul(find(s.nodes[i], s.body), &inverse);
                s.from[i] = mul(&inverse, find(s.body, s.nodes[i]));
            }
            for i in 0..s.count {
                for j in 0..s.count {
                    let target = match (i, j) {
                        (0, 1) => &mut chain.upper[s.nodes[0]],
                        (1, 0) => &mut chain.lower[s.nodes[0]],
                        _ => &mut chain.diag[s.nodes[i]],
                    };
                    block::sub_mul(target, &s.onto[i], find(s.body, s.nodes[j]));
                }
            }
        }
        couplings.retain(|c| !self.bodies.iter().any(|s| s.body == c.0 || s.body == c.1));
        Ok(())
    }

    /// Adds the bodies' right sides to those of their nodes.
    pub fn before(&self, x: &mut [[f64; 4]]) {
        for s in &self.bodies {
            let own = x[s.body];
            for i in 0..s.count {
                let left = block::apply(&s.onto[i], &own);
                (0..4).for_each(|k| x[s.nodes[i]][k] -= left[k]);
            }
        }
    }

    /// Subtracts the contribution of the nodes from the bodies' solutions.
    pub fn after(&self, x: &mut [[f64; 4]]) {
        for s in &self.bodies {
            for i in 0..s.count {
                let left = block::apply(&s.from[i], &x[s.nodes[i]]);
                (0..4).for_each(|k| x[s.body][k] -= left[k]);
            }
        }
    }
}

/// The body as a condensed body, if it has no connections and contact with at most one element.
fn condensed_body(
    body: usize,
    linked: &[bool],
    first: usize,
    couplings: &[(usize, usize, Block)],
) -> Option<CondensedBody> {
    if linked[body] || linked[body - 1] {
        return None;
    }
    let (mut nodes, mut count) = ([usize::MAX; 2], 0);
    for (a, b, _) in couplings.iter().filter(|c| c.0 == body || c.1 == body) {
        let other = if *a == body { *b } else { *a };
        if other >= first {
            return None;
        }
        if !nodes[..count].contains(&other) {
            if count == 2 {
                return None;
            }
            nodes[count] = other;
            count += 1;
        }
    }
    nodes[..count].sort_unstable();
    if count == 2 && !(nodes[1] == nodes[0] + 1 && linked[nodes[0]]) {
        return None;
    }
    let blocks = [ZERO; 2];
    Some(CondensedBody { body, nodes, count, onto: blocks, from: blocks })
}
