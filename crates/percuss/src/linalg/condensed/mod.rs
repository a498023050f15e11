//! Chains tied together at some of their nodes: a block band with couplings beyond it and a border of constraints.
//!
//! Nodes with couplings beyond the band are interface nodes. The runs of nodes between them are eliminated by blocks, each run onto the interface
//! nodes at its ends. Interface nodes connected by constraints form clusters, reduced to the space that their constraints leave free. The remaining
//! system is small, dense or sparse. Constraints at a single node may be reduced inside the band. Order and pattern are determined once. Without
//! interface nodes this is the chain alone.

mod layout;
mod nodal;
mod runs;
mod solve;
#[cfg(test)]
mod tests;

use super::block::{self, Block, ZERO};
use super::chain::{Chain, SingularPivot};
pub use super::cluster::BorderVector;
use super::cluster::Cluster;
use super::schur::SchurComplement;
use nodal::NodalConstraint;
use runs::{NodeRun, runs};

/// Joints of up to this number of components are reduced to the space that their constraints leave free.
const LARGEST_CLUSTER: usize = 64;

/// The matrix, and after [`Condensed::factor`] its factors.
#[derive(Clone, Debug)]
pub struct Condensed {
    /// The band.
    pub chain: Chain,
    /// Blocks beyond the band: (row node, column node, block), shape (couplings, 4, 4) \[index of a node, index of a node, N/m, N, N m\]. The
    /// places never change.
    pub couplings: Vec<(usize, usize, Block)>,
    /// Border columns, by node as in the pattern, shape (constraints, nodes of one, 4)
    /// \[index of a node, unit of the constraint by that of the component\].
    pub columns: Vec<BorderVector>,
    /// Border rows, likewise, shape (constraints, nodes of one, 4) \[index of a node, unit of the constraint by that of the component\].
    pub rows: Vec<BorderVector>,
    /// Border diagonal: zero for a constraint, one for an inactive one, shape (constraints) \[-\].
    pub corner: Vec<f64>,
    /// Constraints reduced inside the band, ascending, shape (such constraints).
    nodal: Vec<NodalConstraint>,
    /// Runs of nodes between interface nodes, ascending, shape (runs).
    runs: Vec<NodeRun>,
    /// Interface nodes, ascending, shape (interface nodes) \[index of a node\].
    interface: Vec<usize>,
    /// Whether interface node i and i + 1 are neighbours in the band, shape (interface nodes less one).
    adjacent: Vec<bool>,
    /// `pivot^-1 (block to the left interface node)` of the nodes of runs, shape (nodes, 4, 4) \[-, m, 1/m\].
    to_left: Vec<Block>,
    /// Block of the left interface node's row in the column of a node of a run, shape (nodes, 4, 4) \[N/m, N, N m\].
    from_left: Vec<Block>,
    /// The interface matrix by pairs of slots, ascending, shape (pairs of slots, 4, 4) \[index of a slot, index of a slot, N/m, N, N m\].
    blocks: Vec<(usize, usize, Block)>,
    /// Joints, and interface nodes on their own, shape (clusters).
    clusters: Vec<Cluster>,
    /// Cluster of a slot, and its number there, shape (interface nodes) \[index of a cluster, index within it\].
    home: Vec<(usize, usize)>,
    /// Constraints outside of clusters, shape (such constraints) \[index of a constraint\].
    border: Vec<usize>,
    schur: SchurComplement,
    scratch: Scratch,
}

/// Memory for a solution.
#[derive(Clone, Debug, Default)]
struct Scratch {
    /// Right side on the interface, shape (4 interface nodes) \[N, N m\].
    right: Vec<f64>,
    /// Values of the interface nodes, shape (4 interface nodes) \[m, -\].
    nodal: Vec<f64>,
    /// Remainder of the right side after these, shape (4 interface nodes) \[N, N m\].
    left_over: Vec<f64>,
    /// Right side and solution of the reduced system, shape (reduced unknowns) \[N, N m, then m, -\].
    reduced: Vec<f64>,
}

/// Coefficients of the border's constraints at nodes.
#[derive(Clone, Debug)]
pub struct BorderPattern {
    /// Nodes, shape (nodes of the constraint) \[index of a node\].
    pub nodes: Vec<usize>,
    /// Whether it always acts: only then can a joint be reduced by it.
    pub permanent: bool,
    /// Whether it is reduced inside the band, unless couplings or other constraints make its node an interface node: such a constraint has one node
    /// and always acts, and no other such constraint has the same node.
    pub in_band: bool,
}

impl Condensed {
    /// A zero matrix of `n` nodes. `links(i)` is whether node i is coupled to i + 1 by the band; `couplings` are the pairs of nodes with a block
    /// beyond it.
    pub fn new(
        n: usize,
        links: impl Fn(usize) -> bool,
        couplings: &[(usize, usize)],
        border: &[BorderPattern],
    ) -> Self {
        let tied = couplings.iter().flat_map(|(a, b)| [*a, *b]);
        let tying = border.iter().filter(|b| !b.in_band).flat_map(|b| b.nodes.iter().copied());
        let mut interface: Vec<usize> = tied.chain(tying).collect();
        interface.sort_unstable();
        interface.dedup();
        let in_band = border.iter().enumerate().filter(|(_, b)| b.in_band);
        let within = in_band.map(|(number, b)| (number, b.nodes[0]));
        let within = within.filter(|(_, node)| interface.binary_search(node).is_err());
        let linked = |i: usize| [i > 0 && links(i - 1), i + 1 < n && links(i)];
        let nodal = within.map(|(number, i)| NodalConstraint::new(number, i, linked(i))).collect();
        let adjacent = interface.windows(2).map(|w| w[1] == w[0] + 1 && links(w[0])).collect();
        let vector = |b: &BorderPattern| b.nodes.iter().map(|k| (*k, [0.0; 4])).collect();
        let extra = if interface.is_empty() { 0 } else { n };
        let mut condensed = Self {
            chain: Chain::zeros(n),
            couplings: couplings.iter().map(|(a, b)| (*a, *b, ZERO)).collect(),
            columns: border.iter().map(vector).collect(),
            rows: border.iter().map(vector).collect(),
            corner: vec![0.0; border.len()],
            nodal,
            runs: runs(n, &links, &interface),
            interface,
            adjacent,
            to_left: vec![ZERO; extra],
            from_left: vec![ZERO; extra],
            blocks: Vec::new(),
            clusters: Vec::new(),
            home: Vec::new(),
            border: Vec::new(),
            schur: SchurComplement::Empty,
            scratch: Scratch::default(),
        };
        condensed.find_blocks();
        condensed.find_clusters(border);
        condensed.schur = SchurComplement::new(condensed.order(), || condensed.schur_entries());
        condensed
    }

    /// Number of unknowns of the reduced system.
    fn order(&self) -> usize {
        self.reduced_nodes() + self.border.len()
    }

    fn reduced_nodes(&self) -> usize {
        self.clusters.last().map_or(0, |c| c.first + c.size())
    }

    fn slot(&self, node: usize) -> usize {
        self.interface.partition_point(|k| *k < node)
    }

    /// Whether a constraint is reduced inside the band.
    fn is_nodal(&self, constraint: usize) -> bool {
        self.nodal.binary_search_by_key(&constraint, |one| one.number).is_ok()
    }

    /// Factors the assembled matrix.
    ///
    /// # Errors
    /// The node where it is singular; `None` for constraints or the interface system.
    pub fn factor(&mut self) -> Result<(), Option<SingularPivot>> {
        if !nodal::reduce(&mut self.nodal, &mut self.chain, (&self.rows, &self.columns)) {
            return Err(None);
        }
        if self.interface.is_empty() {
            return self.chain.factor().map_err(Some);
        }
        self.blocks.iter_mut().for_each(|b| b.2 = ZERO);
        for i in 0..self.interface.len() {
            let node = self.interface[i];
            self.add(i, i, &self.chain.diag[node].clone(), 1.0);
            if self.adjacent.get(i).is_some_and(|a| *a) {
                self.add(i, i + 1, &self.chain.upper[node].clone(), 1.0);
                self.add(i + 1, i, &self.chain.lower[node].clone(), 1.0);
            }
        }
        for r in 0..self.runs.len() {
            let run = self.runs[r].clone();
            self.eliminate(&run).map_err(Some)?;
        }
        for k in 0..self.couplings.len() {
            let (a, b, block) = self.couplings[k];
            self.add(self.slot(a), self.slot(b), &block, 1.0);
        }
        let (interface, rows, columns) = (&self.interface, &self.rows, &self.columns);
        let slot_of = |node: usize| interface.partition_point(|k| *k < node);
        if !self.clusters.iter_mut().all(|c| c.reduce(rows, columns, slot_of)) {
            return Err(None);
        }
        self.fill_core();
        if self.schur.factor() { Ok(()) } else { Err(None) }
    }

    /// Adds `sign` times a block to the interface matrix.
    fn add(&mut self, row: usize, column: usize, block: &Block, sign: f64) {
        let at = self.blocks.partition_point(|b| (b.0, b.1) < (row, column));
        for (t, v) in self.blocks[at].2.as_flattened_mut().iter_mut().zip(block.as_flattened()) {
            *t += sign * v;
        }
    }

    /// Reduces the interface matrix, `Tm^T A T1`, with the rest of the border.
    fn fill_core(&mut self) {
        let mut schur = std::mem::replace(&mut self.schur, SchurComplement::Empty);
        schur.clear();
        for (a, b, block) in &self.blocks {
            let ((ca, na), (cb, nb)) = (self.home[*a], self.home[*b]);
            let (left, right) = (&self.clusters[ca], &self.clusters[cb]);
            let (fa, fb) = (left.size(), right.size());
            let (test, trial) = (left.test(na), right.trial(nb));
            for j in 0..fb {
                let column: [f64; 4] =
                    std::array::from_fn(|r| (0..4).map(|c| block[r][c] * trial[c * fb + j]).sum());
                if column == [0.0; 4] {
                    continue;
                }
                schur.add_column(left.first, right.first + j, fa, |i| {
                    (0..4).map(|r| test[r * fa + i] * column[r]).sum()
                });
            }
        }
        let first = self.reduced_nodes();
        for (k, c) in self.border.iter().enumerate() {
            schur.add_column(first + k, first + k, 1, |_| self.corner[*c]);
            for (node, values) in &self.columns[*c] {
                let (cluster, at) = self.home[self.slot(*node)];
                let cluster = &self.clusters[cluster];
                let (f, test) = (cluster.size(), cluster.test(at));
                schur.add_column(cluster.first, first + k, f, |i| {
                    (0..4).map(|r| test[r * f + i] * values[r]).sum()
                });
            }
            for (node, values) in &self.rows[*c] {
                let (cluster, at) = self.home[self.slot(*node)];
                let cluster = &self.clusters[cluster];
                let (f, trial) = (cluster.size(), cluster.trial(at));
                for j in 0..f {
                    let value = (0..4).map(|r| values[r] * trial[r * f + j]).sum();
                    schur.add_column(first + k, cluster.first + j, 1, |_| value);
                }
            }
        }
        self.schur = schur;
    }

    /// Eliminates the nodes of a run onto the interface nodes at its ends.
    fn eliminate(&mut self, run: &NodeRun) -> Result<(), SingularPivot> {
        let (mut to_left, mut from_left) = (ZERO, ZERO);
        if run.left.is_some() {
            let chain = &self.chain;
            (to_left, from_left) = (chain.lower[run.start - 1], chain.upper[run.start - 1]);
        }
        // Contributions of a run to its left end are summed up before they are entered.
        let mut at_left = ZERO;
        for i in run.start..run.end {
            let chain = &mut self.chain;
            let inverse = block::inverse(&chain.diag[i]).ok_or(SingularPivot { node: i })?;
            chain.diag[i] = inverse;
            let inside = i + 1 < run.end;
            let coupled = inside || run.right.is_some();
            let mut gain = ZERO;
            if coupled {
                gain = block::mul(&inverse, &chain.upper[i]);
                chain.upper[i] = gain;
                if inside {
                    let (lower, diag) = (&chain.lower[i], &mut chain.diag[i + 1]);
                    block::sub_mul(diag, lower, &gain);
                } else if let Some(right) = run.right {
                    let product = block::mul(&chain.lower[i], &gain);
                    self.add(right, right, &product, -1.0);
                }
            }
            if let Some(left) = run.left {
                let h = block::mul(&inverse, &to_left);
                block::sub_mul(&mut at_left, &from_left, &h);
                (self.to_left[i], self.from_left[i]) = (h, from_left);
                if inside {
                    let (mut next_to, mut next_from) = (ZERO, ZERO);
                    block::sub_mul(&mut next_to, &self.chain.lower[i], &h);
                    block::sub_mul(&mut next_from, &from_left, &gain);
                    (to_left, from_left) = (next_to, next_from);
                } else if let Some(right) = run.right {
                    self.add(right, left, &block::mul(&self.chain.lower[i], &h), -1.0);
                    self.add(left, right, &block::mul(&from_left, &gain), -1.0);
                }
            }
        }
        if let Some(left) = run.left {
            self.add(left, left, &at_left, 1.0);
        }
        Ok(())
    }
}

/// `target -= values`.
#[inline(always)]
fn take(target: &mut [f64], values: &[f64; 4]) {
    for k in 0..4 {
        target[k] -= values[k];
    }
}
