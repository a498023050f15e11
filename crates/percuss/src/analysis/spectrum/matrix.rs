//! Matrices of the linearised structure in [`Wide`] numbers.
//!
//! Element matrices are sums of products of strain gradients, which depend only on differences of displacements: formed in Wide numbers, rigid-body
//! motions remain strain-free for any number of elements.

use super::held::Held;
use crate::geometry::row::Row;
use crate::linalg::chain::Chain;
use crate::linalg::elimination::Pattern;
use crate::model::Model;
use crate::model::frozen::PrescribedDofs;
use crate::scalar::Wide;
use crate::step::constraint::{self};
use crate::step::integration::{Integration, Rule};

/// Strains at the Gauss points of an element whose stresses stiffen it, as in [`crate::state::State::strain`].
pub(super) type Stored = [[f64; 2]; 3];
type WideBlock = [[Wide; 4]; 4];

/// Statics has no step size; this one keeps quotients finite.
pub(super) const RULE: Integration = Integration { h: 1.0, rule: Rule::Static };

/// Places of the unknowns: nodes, and with those of a joint or support the multipliers of its constraints.
pub struct Layout<'m> {
    pub model: &'m Model,
    pub(super) pattern: Pattern,
    /// Group of each node, with its first unknown there, shape (nodes) \[index of a group, index within it\].
    pub(super) home: Vec<(usize, usize)>,
    /// The same for the multipliers, shape (constraints) \[index of a group, index within it\].
    pub(super) multiplier: Vec<(usize, usize)>,
    /// Free directions of supported nodes, by their number, shape (nodes held, 4, 4) \[-\].
    pub(super) free: Vec<WideBlock>,
    /// Number of a node's hold, shape (nodes) \[index of a hold\].
    pub(super) hold: Vec<Option<usize>>,
    /// Contacts that stay closed, shape (such contacts).
    pub(super) held: Vec<Held>,
}

/// A matrix before factorisation.
#[derive(Clone)]
pub struct Matrix {
    /// Entries, in the order of the pattern, shape (entries of the pattern) \[N/m, N, N m for stiffness; kg, kg m, kg m^2 for mass\].
    pub(super) values: Vec<Wide>,
    /// Constraints that act: as many eigenvalues are negative for them alone.
    pub(super) constrained: usize,
    /// Largest entry of the terms of loads, rotating springs and rotating joints: its round-off limits the symmetry.
    pub(super) turning: f64,
}

impl<'m> Layout<'m> {
    pub fn new(model: &'m Model) -> Self {
        Self::holding(model, Vec::new())
    }

    /// With contacts that stay closed.
    pub fn holding(model: &'m Model, held: Vec<Held>) -> Self {
        let n = model.node_count();
        let tied: Vec<Vec<usize>> = model.constraints.iter().map(constraint::nodes).collect();
        let (group, count) = groups(n, &tied);
        let mut sizes = vec![0; count];
        let mut place = |g: usize, size: usize| {
            let at = sizes[g];
            sizes[g] += size;
            (g, at)
        };
        let home: Vec<_> = group.iter().map(|g| place(*g, 4)).collect();
        let multiplier = tied.iter().map(|nodes| place(group[nodes[0]], 1)).collect();
        let band = model.each_element().map(|(_, _, a, _)| (a, a + 1));
        let spanned = model.connectors.iter().flat_map(|c| {
            let nodes: Vec<usize> =
                c.attachments().flat_map(|(_, (p, _))| [p.node, p.node + 1]).collect();
            let ends = nodes.clone();
            ends.into_iter().flat_map(move |a| nodes.clone().into_iter().map(move |b| (a, b)))
        });
        let touching = held.iter().flat_map(|held| {
            let nodes = held.nodes();
            let ends = nodes.clone();
            ends.into_iter().flat_map(move |a| nodes.clone().into_iter().map(move |b| (a, b)))
        });
        let coupled = band.chain(spanned).chain(touching);
        let pattern = Pattern::new(sizes, coupled.map(|(a, b)| (group[a], group[b])));
        let mut hold = vec![None; n];
        model.prescribed.iter().enumerate().for_each(|(i, h)| hold[h.node] = Some(i));
        let free = model.prescribed.iter().map(projection).collect();
        Self { model, pattern, home, multiplier, free, hold, held }
    }

    pub(super) fn zeros(&self) -> Matrix {
        Matrix {
            values: vec![Wide::ZERO; self.pattern.value_count()],
            constrained: 0,
            turning: 0.0,
        }
    }

    /// Adds a block between two nodes, without fixed degrees of freedom.
    pub(super) fn add(&self, matrix: &mut Matrix, i: usize, j: usize, block: &WideBlock) {
        let mut block = *block;
        if let Some(h) = self.hold[j] {
            block = block.map(|row| times(&row, &self.free[h]));
        }
        if let Some(h) = self.hold[i] {
            let free = &self.free[h];
            block = free.map(|row| times(&row, &block));
        }
        let ((gi, ri), (gj, cj)) = (self.home[i], self.home[j]);
        let (start, stride) = self.pattern.place(gi, gj);
        for (r, row) in block.iter().enumerate() {
            let at = start + (ri + r) * stride + cj;
            for (t, v) in matrix.values[at..at + 4].iter_mut().zip(row) {
                *t += *v;
            }
        }
    }

    /// `a + factor b`.
    pub fn combined(&self, a: &Matrix, b: &Matrix, factor: f64) -> Matrix {
        let sum = |(a, b): (&Wide, &Wide)| *a + *b * factor;
        let values = a.values.iter().zip(&b.values).map(sum).collect();
        Matrix { values, constrained: a.constrained, turning: a.turning.max(b.turning) }
    }

    /// Adds `factor` times a band.
    pub fn add_band(&self, matrix: &mut Matrix, band: &Chain, factor: f64) {
        let wide = |b: &[[f64; 4]; 4]| b.map(|row| row.map(|x| Wide::from(x) * factor));
        for i in 0..self.model.node_count() {
            self.add(matrix, i, i, &wide(&band.diag[i]));
        }
        for (_, _, a, _) in self.model.each_element() {
            self.add(matrix, a, a + 1, &wide(&band.upper[a]));
            self.add(matrix, a + 1, a, &wide(&band.lower[a]));
        }
    }

    /// Adds a spring to one component of a node.
    pub fn add_stiffness(&self, matrix: &mut Matrix, node: usize, component: usize, value: f64) {
        let mut block = [[Wide::ZERO; 4]; 4];
        block[component][component] = Wide::from(value);
        self.add(matrix, node, node, &block);
    }

    /// Product with nodal values, without constraints.
    pub fn multiply(&self, matrix: &Matrix, x: &[[f64; 4]]) -> Vec<[f64; 4]> {
        let n = self.model.node_count();
        let mut y = vec![[Wide::ZERO; 4]; n];
        let mut times_block = |i: usize, j: usize| {
            let ((gi, ri), (gj, cj)) = (self.home[i], self.home[j]);
            let (start, stride) = self.pattern.place(gi, gj);
            for r in 0..4 {
                let at = start + (ri + r) * stride + cj;
                for c in 0..4 {
                    y[i][r] += matrix.values[at + c] * x[j][c];
                }
            }
        };
        for (i, j) in self.node_pairs() {
            times_block(i, j);
        }
        y.into_iter().map(|y| y.map(Wide::round)).collect()
    }

    /// Ordered pairs of nodes that elements or connectors couple, each once.
    fn node_pairs(&self) -> Vec<(usize, usize)> {
        let n = self.model.node_count();
        let mut pairs: Vec<(usize, usize)> = (0..n).map(|i| (i, i)).collect();
        for (_, _, a, _) in self.model.each_element() {
            pairs.extend([(a, a + 1), (a + 1, a)]);
        }
        for c in &self.model.connectors {
            let nodes = || c.attachments().flat_map(|(_, (p, _))| [p.node, p.node + 1]);
            pairs.extend(nodes().flat_map(|a| nodes().map(move |b| (a, b))));
        }
        for c in &self.model.constraints {
            let nodes = constraint::nodes(c);
            pairs.extend(nodes.iter().flat_map(|a| nodes.iter().map(|b| (*a, *b))));
        }
        for held in &self.held {
            let nodes = held.nodes();
            pairs.extend(nodes.iter().flat_map(|a| nodes.iter().map(|b| (*a, *b))));
        }
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// Whether it is symmetric: no force follows the beams that has no potential.
    pub fn is_symmetric(&self, matrix: &Matrix) -> bool {
        let (mut most, mut all) = (0.0_f64, 0.0_f64);
        for (i, j) in self.node_pairs().into_iter().filter(|(i, j)| i <= j) {
            let ((gi, ri), (gj, cj)) = (self.home[i], self.home[j]);
            let (forth, across) = (self.pattern.place(gi, gj), self.pattern.place(gj, gi));
            for r in 0..4 {
                for c in 0..4 {
                    let a = matrix.values[forth.0 + (ri + r) * forth.1 + cj + c];
                    let b = matrix.values[across.0 + (cj + c) * across.1 + ri + r];
                    most = most.max((a - b).round().abs());
                    all = all.max(a.round().abs());
                }
            }
        }
        // Round-off: of f64 in terms of loads, of Wide numbers elsewhere.
        most <= 1e-9 * matrix.turning + 1e-24 * all
    }

    /// The symmetric part.
    pub fn symmetric(&self, matrix: &Matrix) -> Matrix {
        let mut out = matrix.clone();
        for (i, j) in self.node_pairs() {
            let ((gi, ri), (gj, cj)) = (self.home[i], self.home[j]);
            let (forth, across) = (self.pattern.place(gi, gj), self.pattern.place(gj, gi));
            for r in 0..4 {
                for c in 0..4 {
                    let at = forth.0 + (ri + r) * forth.1 + cj + c;
                    let other = across.0 + (cj + c) * across.1 + ri + r;
                    out.values[at] = (matrix.values[at] + matrix.values[other]) * 0.5;
                }
            }
        }
        out
    }
}

/// Groups of nodes that constraints tie together: the group of each node, and their number.
fn groups(n: usize, tied: &[Vec<usize>]) -> (Vec<usize>, usize) {
    let mut parent: Vec<usize> = (0..n).collect();
    fn root(parent: &mut [usize], mut i: usize) -> usize {
        while parent[i] != i {
            parent[i] = parent[parent[i]];
            i = parent[i];
        }
        i
    }
    for nodes in tied {
        for pair in nodes.windows(2) {
            let (a, b) = (root(&mut parent, pair[0]), root(&mut parent, pair[1]));
            parent[a.max(b)] = a.min(b);
        }
    }
    let mut number = vec![usize::MAX; n];
    let mut count = 0;
    let mut group = Vec::with_capacity(n);
    for i in 0..n {
        let r = root(&mut parent, i);
        if number[r] == usize::MAX {
            number[r] = count;
            count += 1;
        }
        group.push(number[r]);
    }
    (group, count)
}

/// `I - N N^T` with the held directions N orthonormal to the last digit of Wide numbers.
fn projection(dofs: &PrescribedDofs) -> WideBlock {
    let mut free = [[Wide::ZERO; 4]; 4];
    (0..4).for_each(|k| free[k][k] = Wide::ONE);
    for n in &dofs.normals {
        let n = times(&n.map(Wide::from), &free);
        let size = n.iter().fold(Wide::ZERO, |sum, x| sum + *x * *x);
        for r in 0..4 {
            for c in 0..4 {
                free[r][c] -= n[r] * n[c] / size;
            }
        }
    }
    free
}

/// `x^T B`.
pub(super) fn times(x: &[Wide; 4], block: &WideBlock) -> [Wide; 4] {
    std::array::from_fn(|c| (0..4).fold(Wide::ZERO, |sum, r| sum + x[r] * block[r][c]))
}

impl Layout<'_> {
    /// Adds contacts that are kept closed, with the terms of the rotation of the given share of their forces.
    pub fn add_held(&self, matrix: &mut Matrix, share: f64) {
        for held in &self.held {
            self.add_product(matrix, [&held.row; 2], held.stiffness);
            for turning in &held.turnings {
                for (a, weights) in turning.forms.iter().zip(&turning.weights) {
                    for (b, weight) in turning.forms.iter().zip(weights) {
                        self.add_product(matrix, [a, b], -share * held.force * weight);
                    }
                }
            }
        }
    }

    /// The same with springs as stiff as beams of a length and of unit bending stiffness.
    pub(super) fn add_held_kinematic(&self, matrix: &mut Matrix, length: f64) {
        for held in &self.held {
            self.add_product(matrix, [&held.row; 2], length.powi(-3));
        }
    }

    /// Adds `factor a (x) b`, products in Wide numbers.
    fn add_product(&self, matrix: &mut Matrix, [a, b]: [&Row; 2], factor: f64) {
        if factor == 0.0 {
            return;
        }
        for (i, left) in a.iter() {
            for (j, right) in b.iter() {
                let block = left.map(|l| right.map(|r| Wide::from(l) * r * factor));
                self.add(matrix, i, j, &block);
            }
        }
    }
}
