//! Chains tied together at some of their nodes: a block band with couplings beyond it and a border of constraints.
//!
//! Nodes that anything beyond the band touches are interface nodes. The runs of nodes between them are eliminated by blocks,
//! each run onto the interface nodes at its ends; what is left, interface nodes and border, is a small system, dense or
//! sparse. Order and pattern are found once. Without interface nodes this is the chain alone.

use super::block::{self, Block, ZERO};
use super::chain::{Chain, SingularPivot};
use super::dense::DenseLu;
use super::sparse::SparseLu;

/// A row or column of the border: its coefficients at nodes.
pub type BorderVector = Vec<(usize, [f64; 4])>;

/// Interface systems of up to this order are solved densely.
const DENSE: usize = 36;

/// A run of nodes that touch nothing beyond the band.
#[derive(Clone, Debug)]
struct Run {
    start: usize,
    end: usize,
    /// Interface nodes (their slots) before and after it.
    left: Option<usize>,
    right: Option<usize>,
}

/// The matrix, and after [`Condensed::factor`] its factors.
#[derive(Clone, Debug)]
pub struct Condensed {
    /// The band.
    pub chain: Chain,
    /// Blocks beyond the band: (row node, column node, block). The places never change.
    pub couplings: Vec<(usize, usize, Block)>,
    /// Border columns, one a constraint; nodes as in the pattern.
    pub columns: Vec<BorderVector>,
    /// Border rows, one a constraint.
    pub rows: Vec<BorderVector>,
    /// Border diagonal: zero for a constraint, one for one that does not act.
    pub corner: Vec<f64>,
    runs: Vec<Run>,
    /// Interface nodes, ascending.
    interface: Vec<usize>,
    /// Whether interface node i and i + 1 are neighbours in the band.
    adjacent: Vec<bool>,
    /// `pivot^-1 (block to the left interface node)` of the nodes of runs.
    to_left: Vec<Block>,
    /// Block of the left interface node's row in the column of a node of a run.
    from_left: Vec<Block>,
    core: Core,
    right_side: Vec<f64>,
}

#[derive(Clone, Debug)]
enum Core {
    Empty,
    Dense { matrix: Vec<f64>, lu: DenseLu },
    Sparse { lu: Box<SparseLu>, blocks: Vec<BlockPlace> },
}

/// Where the columns of a block of the interface system lie among the values of the sparse matrix.
#[derive(Clone, Copy, Debug)]
struct BlockPlace {
    row: usize,
    column: usize,
    starts: [usize; 4],
}

impl Condensed {
    /// A zero matrix of `n` nodes. `links(i)` tells whether node i is linked to i + 1 by the band; `couplings` are the
    /// pairs of nodes with a block beyond it, `border` the nodes of each border vector.
    pub fn new(
        n: usize,
        links: impl Fn(usize) -> bool,
        couplings: &[(usize, usize)],
        border: &[Vec<usize>],
    ) -> Self {
        let mut interface: Vec<usize> = couplings
            .iter()
            .flat_map(|(a, b)| [*a, *b])
            .chain(border.iter().flatten().copied())
            .collect();
        interface.sort_unstable();
        interface.dedup();
        let adjacent = interface.windows(2).map(|w| w[1] == w[0] + 1 && links(w[0])).collect();
        let vector = |nodes: &Vec<usize>| nodes.iter().map(|k| (*k, [0.0; 4])).collect();
        let extra = if interface.is_empty() { 0 } else { n };
        let mut condensed = Self {
            chain: Chain::zeros(n),
            couplings: couplings.iter().map(|(a, b)| (*a, *b, ZERO)).collect(),
            columns: border.iter().map(vector).collect(),
            rows: border.iter().map(vector).collect(),
            corner: vec![0.0; border.len()],
            runs: runs(n, &links, &interface),
            right_side: vec![0.0; 4 * interface.len() + border.len()],
            interface,
            adjacent,
            to_left: vec![ZERO; extra],
            from_left: vec![ZERO; extra],
            core: Core::Empty,
        };
        condensed.core = condensed.new_core();
        condensed
    }

    fn order(&self) -> usize {
        4 * self.interface.len() + self.columns.len()
    }

    fn slot(&self, node: usize) -> usize {
        self.interface.partition_point(|k| *k < node)
    }

    /// Pairs of slots that share a block in the interface system.
    fn block_pairs(&self) -> Vec<(usize, usize)> {
        let mut pairs: Vec<(usize, usize)> = (0..self.interface.len()).map(|i| (i, i)).collect();
        let both = |a: usize, b: usize| [(a, b), (b, a)];
        for (i, adjacent) in self.adjacent.iter().enumerate() {
            if *adjacent {
                pairs.extend(both(i, i + 1));
            }
        }
        for run in &self.runs {
            if let (Some(a), Some(b)) = (run.left, run.right) {
                pairs.extend(both(a, b));
            }
        }
        pairs.extend(self.couplings.iter().map(|(a, b, _)| (self.slot(*a), self.slot(*b))));
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    fn new_core(&self) -> Core {
        let n = self.order();
        if n == 0 {
            return Core::Empty;
        }
        let dense = || Core::Dense { matrix: vec![0.0; n * n], lu: DenseLu::default() };
        if n <= DENSE {
            return dense();
        }
        let pairs = self.block_pairs();
        let mut entries = Vec::new();
        for (a, b) in &pairs {
            entries.extend((0..16).map(|k| (4 * a + k / 4, 4 * b + k % 4)));
        }
        let first = 4 * self.interface.len();
        for (c, column) in self.columns.iter().enumerate() {
            entries.push((first + c, first + c));
            for (node, _) in column {
                let at = 4 * self.slot(*node);
                for k in 0..4 {
                    entries.push((at + k, first + c));
                    entries.push((first + c, at + k));
                }
            }
        }
        let Some(lu) = SparseLu::new(n, &entries) else { return dense() };
        let blocks = pairs
            .into_iter()
            .map(|(row, column)| BlockPlace {
                row,
                column,
                starts: std::array::from_fn(|k| lu.place(4 * row, 4 * column + k)),
            })
            .collect();
        Core::Sparse { lu: Box::new(lu), blocks }
    }

    /// Product of the band and the couplings with nodal values, before factorisation.
    pub fn multiply(&self, x: &[[f64; 4]]) -> Vec<[f64; 4]> {
        let mut y = self.chain.multiply(x);
        for (i, j, block) in &self.couplings {
            let add = block::apply(block, &x[*j]);
            (0..4).for_each(|k| y[*i][k] += add[k]);
        }
        y
    }

    /// Factors the assembled matrix.
    ///
    /// # Errors
    /// The node where it is singular; `None` stands for the interface system.
    pub fn factor(&mut self) -> Result<(), Option<SingularPivot>> {
        if self.order() == 0 {
            return self.chain.factor().map_err(Some);
        }
        self.core.clear();
        for i in 0..self.interface.len() {
            let node = self.interface[i];
            self.core.add(i, i, &self.chain.diag[node], 1.0);
            if self.adjacent.get(i).is_some_and(|a| *a) {
                self.core.add(i, i + 1, &self.chain.upper[node], 1.0);
                self.core.add(i + 1, i, &self.chain.lower[node], 1.0);
            }
        }
        for r in 0..self.runs.len() {
            let run = self.runs[r].clone();
            self.eliminate(&run).map_err(Some)?;
        }
        for (a, b, block) in &self.couplings {
            let (a, b) = (self.slot(*a), self.slot(*b));
            self.core.add(a, b, block, 1.0);
        }
        let first = 4 * self.interface.len();
        for (c, (column, row)) in self.columns.iter().zip(&self.rows).enumerate() {
            self.core.set(first + c, first + c, self.corner[c]);
            for (node, values) in column {
                let at = 4 * self.slot(*node);
                (0..4).for_each(|k| self.core.set(at + k, first + c, values[k]));
            }
            for (node, values) in row {
                let at = 4 * self.slot(*node);
                (0..4).for_each(|k| self.core.set(first + c, at + k, values[k]));
            }
        }
        if self.core.factor() { Ok(()) } else { Err(None) }
    }

    /// Eliminates the nodes of a run onto the interface nodes at its ends.
    fn eliminate(&mut self, run: &Run) -> Result<(), SingularPivot> {
        let chain = &mut self.chain;
        let (mut to_left, mut from_left) = (ZERO, ZERO);
        if run.left.is_some() {
            (to_left, from_left) = (chain.lower[run.start - 1], chain.upper[run.start - 1]);
        }
        for i in run.start..run.end {
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
                    self.core.add(right, right, &product, -1.0);
                }
            }
            if let Some(left) = run.left {
                let h = block::mul(&inverse, &to_left);
                self.core.add(left, left, &block::mul(&from_left, &h), -1.0);
                (self.to_left[i], self.from_left[i]) = (h, from_left);
                if inside {
                    let (mut next_to, mut next_from) = (ZERO, ZERO);
                    block::sub_mul(&mut next_to, &chain.lower[i], &h);
                    block::sub_mul(&mut next_from, &from_left, &gain);
                    (to_left, from_left) = (next_to, next_from);
                } else if let Some(right) = run.right {
                    self.core.add(right, left, &block::mul(&chain.lower[i], &h), -1.0);
                    self.core.add(left, right, &block::mul(&from_left, &gain), -1.0);
                }
            }
        }
        Ok(())
    }

    /// Solves in place with the factors: nodal values in `x`, border values in `border`.
    pub fn solve(&mut self, x: &mut [[f64; 4]], border: &mut [f64]) {
        if self.order() == 0 {
            self.chain.solve(x);
            return;
        }
        let first = 4 * self.interface.len();
        let mut right = std::mem::take(&mut self.right_side);
        for (i, node) in self.interface.iter().enumerate() {
            right[4 * i..4 * i + 4].copy_from_slice(&x[*node]);
        }
        right[first..].copy_from_slice(border);
        for run in &self.runs {
            self.forward(run, x, &mut right);
        }
        self.core.solve(&mut right);
        for run in &self.runs {
            self.backward(run, x, &right);
        }
        for (i, node) in self.interface.iter().enumerate() {
            x[*node].copy_from_slice(&right[4 * i..4 * i + 4]);
        }
        border.copy_from_slice(&right[first..]);
        self.right_side = right;
    }

    fn forward(&self, run: &Run, x: &mut [[f64; 4]], right: &mut [f64]) {
        let chain = &self.chain;
        let mut carry = [0.0; 4];
        for i in run.start..run.end {
            let y = std::array::from_fn(|k| x[i][k] - carry[k]);
            let z = block::apply(&chain.diag[i], &y);
            x[i] = z;
            if let Some(left) = run.left {
                take(&mut right[4 * left..], &block::apply(&self.from_left[i], &z));
            }
            if i + 1 < run.end || run.right.is_some() {
                carry = block::apply(&chain.lower[i], &z);
            }
        }
        if let Some(slot) = run.right {
            take(&mut right[4 * slot..], &carry);
        }
    }

    fn backward(&self, run: &Run, x: &mut [[f64; 4]], right: &[f64]) {
        let value = |slot: Option<usize>| {
            slot.map(|s| std::array::from_fn::<f64, 4, _>(|k| right[4 * s + k]))
        };
        let (left, mut next) = (value(run.left), value(run.right));
        for i in (run.start..run.end).rev() {
            if let Some(next) = &next {
                take(&mut x[i], &block::apply(&self.chain.upper[i], next));
            }
            if let Some(left) = &left {
                take(&mut x[i], &block::apply(&self.to_left[i], left));
            }
            next = Some(x[i]);
        }
    }
}

/// `target -= values`.
#[inline(always)]
fn take(target: &mut [f64], values: &[f64; 4]) {
    for k in 0..4 {
        target[k] -= values[k];
    }
}

/// Runs of nodes between interface nodes, cut where the band is not linked.
fn runs(n: usize, links: &impl Fn(usize) -> bool, interface: &[usize]) -> Vec<Run> {
    let slot = |node: usize| interface.binary_search(&node).ok();
    let mut runs = Vec::new();
    let mut i = 0;
    while i < n {
        if slot(i).is_some() {
            i += 1;
            continue;
        }
        let start = i;
        while links(i) && i + 1 < n && slot(i + 1).is_none() {
            i += 1;
        }
        let left = if start > 0 && links(start - 1) { slot(start - 1) } else { None };
        let right = if i + 1 < n && links(i) { slot(i + 1) } else { None };
        runs.push(Run { start, end: i + 1, left, right });
        i += 1;
    }
    runs
}

impl Core {
    fn clear(&mut self) {
        match self {
            Self::Empty => {}
            Self::Dense { matrix, .. } => matrix.fill(0.0),
            Self::Sparse { lu, .. } => lu.values.fill(0.0),
        }
    }

    /// Adds `sign` times a block at a pair of slots.
    fn add(&mut self, row: usize, column: usize, block: &Block, sign: f64) {
        match self {
            Self::Empty => {}
            Self::Dense { matrix, .. } => {
                let n = matrix.len().isqrt();
                for i in 0..4 {
                    for j in 0..4 {
                        matrix[(4 * row + i) * n + 4 * column + j] += sign * block[i][j];
                    }
                }
            }
            Self::Sparse { lu, blocks } => {
                let at = blocks.partition_point(|b| (b.row, b.column) < (row, column));
                for (j, start) in blocks[at].starts.into_iter().enumerate() {
                    for i in 0..4 {
                        lu.values[start + i] += sign * block[i][j];
                    }
                }
            }
        }
    }

    fn set(&mut self, row: usize, column: usize, value: f64) {
        match self {
            Self::Empty => {}
            Self::Dense { matrix, .. } => {
                let n = matrix.len().isqrt();
                matrix[row * n + column] = value;
            }
            Self::Sparse { lu, .. } => {
                let place = lu.place(row, column);
                lu.values[place] = value;
            }
        }
    }

    fn factor(&mut self) -> bool {
        match self {
            Self::Empty => true,
            Self::Dense { matrix, lu } => lu.factor(matrix.len().isqrt(), matrix),
            Self::Sparse { lu, .. } => lu.factor(),
        }
    }

    fn solve(&self, x: &mut [f64]) {
        match self {
            Self::Empty => {}
            Self::Dense { lu, .. } => lu.solve(x),
            Self::Sparse { lu, .. } => lu.solve(x),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix with two chains of 6 and 5 nodes, couplings and constraints, and its product with a vector.
    fn sample(couplings: &[(usize, usize)], border: &[Vec<usize>]) -> Condensed {
        let mut seed = 7_u64;
        let mut next = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
        };
        let mut fill = |diagonal: f64| -> Block {
            std::array::from_fn(|r| {
                std::array::from_fn(|c| next() + if r == c { diagonal } else { 0.0 })
            })
        };
        let n = 11;
        let mut a = Condensed::new(n, |i| i != 5, couplings, border);
        for i in 0..n {
            a.chain.diag[i] = fill(5.0);
            if i != 5 && i + 1 < n {
                (a.chain.upper[i], a.chain.lower[i]) = (fill(0.0), fill(0.0));
            }
        }
        for coupling in &mut a.couplings {
            coupling.2 = fill(0.0);
        }
        let values: Vec<[f64; 4]> = (0..100).map(|_| fill(1.0)[0]).collect();
        let mut k = 0;
        for vector in a.columns.iter_mut().chain(&mut a.rows) {
            for (_, value) in vector {
                *value = values[k];
                k += 1;
            }
        }
        a
    }

    fn multiply(a: &Condensed, x: &[[f64; 4]], border: &[f64]) -> (Vec<[f64; 4]>, Vec<f64>) {
        let mut y = a.multiply(x);
        for (column, b) in a.columns.iter().zip(border) {
            for (node, c) in column {
                (0..4).for_each(|k| y[*node][k] += c[k] * b);
            }
        }
        let inner = |row: &BorderVector| -> f64 {
            row.iter().map(|(node, c)| (0..4).map(|k| c[k] * x[*node][k]).sum::<f64>()).sum()
        };
        (y, a.rows.iter().map(inner).collect())
    }

    fn check(couplings: &[(usize, usize)], border: &[Vec<usize>]) {
        let a = sample(couplings, border);
        let b: Vec<[f64; 4]> = (0..11).map(|i| [1.0, f64::from(i), -2.0, 0.5]).collect();
        let c: Vec<f64> = (0..border.len()).map(|i| 1.0 - i as f64).collect();
        let (mut x, mut l) = (b.clone(), c.clone());
        let mut lu = a.clone();
        lu.factor().unwrap();
        lu.solve(&mut x, &mut l);
        let (y, d) = multiply(&a, &x, &l);
        for (y, b) in y.iter().zip(&b) {
            (0..4).for_each(|k| assert!((y[k] - b[k]).abs() < 1e-10, "{couplings:?} {border:?}"));
        }
        d.iter().zip(&c).for_each(|(d, c)| assert!((d - c).abs() < 1e-10));
    }

    #[test]
    fn solutions_satisfy_the_system() {
        check(&[], &[]);
        check(&[], &[vec![5, 6]]);
        check(&[(2, 8), (8, 2)], &[]);
        check(&[(2, 8), (8, 2)], &[vec![0, 10], vec![2, 3, 8]]);
        // Large enough for the sparse interface system.
        check(
            &[(0, 10), (10, 0), (3, 7), (7, 3), (4, 7), (7, 4)],
            &[vec![0, 6], vec![1], vec![3, 4, 9]],
        );
    }
}
