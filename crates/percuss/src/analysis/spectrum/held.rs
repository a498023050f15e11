//! Active contacts of an equilibrium, which are kept closed in small motions about it.

use crate::geometry::row::Row;
use crate::geometry::turning::Turning;

/// A contact that is kept closed.
#[derive(Clone, Debug)]
pub struct Held {
    /// Gradient of its gap on the nodes that move.
    pub row: Row,
    /// Stiffness of its law, or far above that of the beams \[N/m\].
    pub stiffness: f64,
    /// Its force \[N\].
    pub force: f64,
    /// Rotation of its direction: parts of the second derivative of the gap, shape (such parts).
    pub turnings: Vec<Turning>,
}

impl Held {
    pub(super) fn nodes(&self) -> Vec<usize> {
        let turned = self.turnings.iter().flat_map(|t| &t.forms);
        let mut nodes: Vec<usize> = std::iter::once(&self.row)
            .chain(turned)
            .flat_map(|row| row.iter().map(|(node, _)| node))
            .collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }
}
