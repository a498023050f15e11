//! Matrices of the linearised structure in [`Wide`] numbers.
//!
//! Element matrices are sums of products of strains' gradients, which know differences of displacements alone: formed in Wide
//! numbers, motions of a rigid body stay without strain against any number of elements.

use super::super::static_search::StaticSearch;
use super::held::Held;
use crate::element::beam::{ElementSums, ElementTable, ElementValues, GaussRow, step_point};
use crate::element::collocation;
use crate::element::membrane::{MembranePoint, MembraneTable};
use crate::element::point::{SectionLaw, Strains};
use crate::linalg::block;
use crate::linalg::chain::Chain;
use crate::linalg::condensed::BorderVector;
use crate::linalg::elimination::{Factors, Pattern};
use crate::math::vec2::{dot, dot4};
use crate::model::Model;
use crate::model::frozen::{Connector, ConstraintKind, PrescribedDofs, Span};
use crate::scalar::Wide;
use crate::step::connectors::{self, ConnectorStep};
use crate::step::constraint::{self, ConstraintStep};
use crate::step::external;
use crate::step::integration::{Integration, Rule};
use crate::step::tangent::Tangent;

/// Strains at the Gauss points of an element whose stresses stiffen it, as in [`crate::state::State::strain`].
type Stored = [[f64; 2]; 3];
type WideBlock = [[Wide; 4]; 4];

/// Statics has no step size; this one keeps quotients finite.
const RULE: Integration = Integration { h: 1.0, rule: Rule::Static };

/// Constraints at the base of a search.
fn at_rest<'a>(search: &'a StaticSearch, still: &'a [[f64; 4]]) -> ConstraintStep<'a> {
    let (start, forcing) = (&search.base.displacement[..], &search.forcing);
    ConstraintStep { start, increment: still, forcing, share: 1.0 }
}

/// Places of the unknowns: nodes, and with those of a joint or support the multipliers of its constraints.
pub struct Layout<'m> {
    pub model: &'m Model,
    pattern: Pattern,
    /// First unknown of each node in its group, with the group.
    home: Vec<(usize, usize)>,
    /// The same for the multipliers.
    multiplier: Vec<(usize, usize)>,
    /// What holds leave free, by their number.
    free: Vec<WideBlock>,
    /// Number of a node's hold.
    hold: Vec<Option<usize>>,
    /// Contacts that stay closed.
    pub(super) held: Vec<Held>,
}

/// Whether stress and stiffness are those of the structure, or left out for unit bending stiffness and springs to match beams
/// of the given length.
#[derive(Clone, Copy, Debug)]
pub enum StressTerms {
    Taken,
    Left(f64),
}

impl StressTerms {
    /// Stiffness of a spring.
    fn of_spring(self, spring: &Connector, stiffness: f64) -> f64 {
        match self {
            Self::Left(length) if stiffness != 0.0 => {
                let turns = spring.attachments().any(|(_, (_, gradient))| gradient);
                length.powi(if turns { -1 } else { -3 })
            }
            _ => stiffness,
        }
    }
}

/// A matrix before factorisation.
#[derive(Clone)]
pub struct Matrix {
    values: Vec<Wide>,
    /// Constraints that act: as many eigenvalues are negative for them alone.
    constrained: usize,
    /// Largest entry of what loads, turning springs and turning joints add: its round-off is that of symmetry.
    turning: f64,
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

    fn zeros(&self) -> Matrix {
        Matrix { values: vec![Wide::ZERO; self.pattern.len()], constrained: 0, turning: 0.0 }
    }

    /// The tangent at the base of a search.
    pub fn tangent(&self, search: &StaticSearch) -> Matrix {
        self.tangent_with(search, 1.0)
    }

    /// The same where contacts press with a share of their forces.
    pub fn tangent_with(&self, search: &StaticSearch, pressed: f64) -> Matrix {
        let mut matrix = self.zeros();
        self.add_elements(&mut matrix, search, |_, _, e| (Wide::ONE, search.base.strain[e]));
        let mut rest = Tangent::new(self.model);
        let (base, forcing) = (&search.base, &search.forcing);
        let still = vec![[0.0; 4]; base.displacement.len()];
        self.add_turning(search, &still, &mut rest);
        let add = |c: &Connector, s: &ConnectorStep| self.add_spring(&mut matrix, c, s, s.slope);
        connectors::apply_turning(self.model, base, &RULE, forcing, &mut rest, add);
        self.add_blocks(&mut matrix, &rest);
        self.add_held(&mut matrix, pressed);
        self.add_border(&mut matrix, search);
        matrix
    }

    /// Stiffness without stress of the same geometry and supports, but of unit bending stiffness throughout: what it leaves
    /// free no stiffness holds, whatever it may be. `length` makes springs as stiff as beams.
    pub fn kinematic(&self, search: &StaticSearch, length: f64) -> Matrix {
        let mut matrix = self.zeros();
        self.add_elements(&mut matrix, search, |span, k, _| (unit(span.table(k)), [[0.0; 2]; 3]));
        let add = |c: &Connector, s: &ConnectorStep| {
            self.add_spring(&mut matrix, c, s, StressTerms::Left(length).of_spring(c, s.slope));
        };
        let mut unused = Tangent::new(self.model);
        let (base, forcing) = (&search.base, &search.forcing);
        connectors::apply_turning(self.model, base, &RULE, forcing, &mut unused, add);
        self.add_held_kinematic(&mut matrix, length);
        self.add_border(&mut matrix, search);
        matrix
    }

    fn add_elements(
        &self,
        matrix: &mut Matrix,
        search: &StaticSearch,
        weigh: impl Fn(&Span, usize, usize) -> (Wide, Stored),
    ) {
        for (span, k, a, e) in self.model.each_element() {
            let (factor, stored) = weigh(span, k, e);
            let sums = element(span, k, a, &search.base.displacement, &stored);
            let none = [[Wide::ZERO; 4]; 4];
            let [aa, ab, ba, bb] = sums.nodal_tangent(&none, Wide::ZERO);
            for (i, j, block) in [(a, a, aa), (a, a + 1, ab), (a + 1, a, ba), (a + 1, a + 1, bb)] {
                self.add(matrix, i, j, &block.map(|row| row.map(|x| x * factor)));
            }
        }
    }

    /// Twice the energy of small motions `x` in each element and spring, and what loads and turning add to it.
    pub fn each_energy(
        &self,
        search: &StaticSearch,
        x: &[[f64; 4]],
        stress: StressTerms,
        mut each: impl FnMut(f64),
    ) {
        for (span, k, a, e) in self.model.each_element() {
            let (factor, stored) = match stress {
                StressTerms::Taken => (1.0, search.base.strain[e]),
                StressTerms::Left(_) => (unit(span.table(k)).round(), [[0.0; 2]; 3]),
            };
            let sums = element(span, k, a, &search.base.displacement, &stored);
            let (p, q) = (&x[a], &x[a + 1]);
            let d = [q[0] - p[0], q[1] - p[1], p[2], p[3], q[2], q[3]];
            let mut sum = Wide::ZERO;
            for (row, di) in sums.tangent.iter().zip(d) {
                for (k, dj) in row.iter().zip(d) {
                    sum += *k * di * dj;
                }
            }
            each(factor * sum.round());
        }
        let mut rest = Tangent::new(self.model);
        let (base, forcing) = (&search.base, &search.forcing);
        let still = vec![[0.0; 4]; base.displacement.len()];
        if let StressTerms::Taken = stress {
            self.add_turning(search, &still, &mut rest);
        }
        for held in &self.held {
            let stiffness = match stress {
                StressTerms::Taken => held.stiffness,
                StressTerms::Left(length) => length.powi(-3),
            };
            each(stiffness * held.row.on(x).powi(2));
        }
        let add = |c: &Connector, s: &ConnectorStep| {
            let moved: f64 = c
                .attachments()
                .map(|(g, (p, slope))| {
                    dot(s.forms[g], if slope { p.gradient(x) } else { p.value(x) })
                })
                .sum();
            each(stress.of_spring(c, s.slope) * moved * moved);
        };
        match stress {
            StressTerms::Taken => {
                connectors::apply_turning(self.model, base, &RULE, forcing, &mut rest, add);
                for (i, j, block) in rest.blocks() {
                    each(dot4(&block::apply(block, &x[j]), &x[i]));
                }
            }
            StressTerms::Left(_) => {
                let mut unused = Tangent::new(self.model);
                connectors::apply_turning(self.model, base, &RULE, forcing, &mut unused, add);
            }
        }
    }

    /// Adds what loads that follow the beams and joints that turn add to the tangent.
    fn add_turning(&self, search: &StaticSearch, still: &[[f64; 4]], rest: &mut Tangent) {
        let (base, forcing) = (&search.base, &search.forcing);
        let mut residual = still.to_vec();
        external::apply::<true>(self.model, base, forcing, 1.0, still, &mut residual, rest);
        let step = at_rest(search, still);
        for (i, c) in self.model.constraints.iter().enumerate() {
            if let ConstraintKind::Angle { points, .. } = &c.kind
                && let Some(k) = step.hessian(c, search.work.multiplier[i])
            {
                rest.add_hessian(i, points, &k);
            }
        }
    }

    /// Adds `stiffness form (x) form`, products in Wide numbers.
    fn add_spring(&self, m: &mut Matrix, c: &Connector, step: &ConnectorStep, stiffness: f64) {
        let ends: Vec<(usize, [Wide; 4])> = c
            .attachments()
            .flat_map(|(g, (p, gradient))| {
                let n = if gradient { &p.slope } else { &p.shape };
                let (form, n) = (step.forms[g], *n);
                [0, 1].map(move |end| {
                    let w = |k: usize| Wide::from(n[2 * end + k / 2]) * form[k % 2];
                    (p.node + end, std::array::from_fn(w))
                })
            })
            .collect();
        for (i, left) in &ends {
            for (j, right) in &ends {
                self.add(m, *i, *j, &left.map(|l| right.map(|r| l * r * stiffness)));
            }
        }
    }

    fn add_blocks(&self, matrix: &mut Matrix, rest: &Tangent) {
        for (i, j, block) in rest.blocks() {
            let largest = block.as_flattened().iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            matrix.turning = matrix.turning.max(largest);
            self.add(matrix, i, j, &block.map(|row| row.map(Wide::from)));
        }
    }

    fn add_border(&self, matrix: &mut Matrix, search: &StaticSearch) {
        let still = vec![[0.0; 4]; self.model.node_count()];
        let step = at_rest(search, &still);
        for (i, c) in self.model.constraints.iter().enumerate() {
            let (group, own) = self.multiplier[i];
            let (start, stride) = self.pattern.place(group, group);
            if !search.forcing.constrained[i] {
                matrix.values[start + own * stride + own] += Wide::ONE;
                continue;
            }
            matrix.constrained += 1;
            let mut vector: BorderVector =
                constraint::nodes(c).into_iter().map(|node| (node, [0.0; 4])).collect();
            step.border(c, true, &mut vector);
            for (node, values) in vector {
                let (_, at) = self.home[node];
                let row = values.map(Wide::from);
                let row = self.hold[node].map_or(row, |h| times(&row, &self.free[h]));
                for k in 0..4 {
                    matrix.values[start + own * stride + at + k] += row[k];
                    matrix.values[start + (at + k) * stride + own] += row[k];
                }
            }
        }
    }

    /// Adds a block between two nodes, without what is held.
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

    /// Product with nodal values; constraints have no part in it.
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
        // Round-off: of f64 in what loads add, of Wide numbers elsewhere.
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

    /// Factors a matrix; with its negative eigenvalues beside those of constraints if `count`. `None` if it is singular.
    pub fn factor(&self, matrix: &Matrix, count: bool) -> Option<Factored<'_>> {
        let mut values = matrix.values.clone();
        for (h, dofs) in self.model.prescribed.iter().enumerate() {
            let (group, at) = self.home[dofs.node];
            let (start, stride) = self.pattern.place(group, group);
            let place = |r: usize, c: usize| start + (at + r) * stride + at + c;
            let own = (0..4).fold(0.0_f64, |m, k| m.max(values[place(k, k)].round().abs()));
            let scale = if own > 0.0 { own } else { 1.0 };
            for r in 0..4 {
                for c in 0..4 {
                    let one = if r == c { Wide::ONE } else { Wide::ZERO };
                    values[place(r, c)] += (one - self.free[h][r][c]) * scale;
                }
            }
        }
        let factors = Factors::new(&self.pattern, values, count)?;
        let negative = factors.negative.saturating_sub(matrix.constrained);
        Some(Factored { layout: self, factors, negative })
    }
}

/// A factored matrix.
pub struct Factored<'l> {
    layout: &'l Layout<'l>,
    factors: Factors<'l>,
    /// Negative eigenvalues within what supports and joints leave free.
    pub negative: usize,
}

impl Factored<'_> {
    /// Nodal values of the solution for nodal forces.
    pub fn solve(&self, forces: &[[f64; 4]]) -> Vec<[f64; 4]> {
        self.solve_with_multipliers(forces).0
    }

    /// The same with the multipliers of constraints.
    pub fn solve_with_multipliers(&self, forces: &[[f64; 4]]) -> (Vec<[f64; 4]>, Vec<f64>) {
        let Layout { model, pattern, home, hold, free, multiplier, .. } = self.layout;
        let place = |(group, at): (usize, usize)| pattern.first[group] + at;
        let mut x = vec![Wide::ZERO; 4 * model.node_count() + multiplier.len()];
        let freed = |i: usize, f: [Wide; 4]| hold[i].map_or(f, |h| times(&f, &free[h]));
        for (i, f) in forces.iter().enumerate() {
            let at = place(home[i]);
            x[at..at + 4].copy_from_slice(&freed(i, f.map(Wide::from)));
        }
        self.factors.solve(&mut x);
        let node = |i: usize| {
            let at = place(home[i]);
            freed(i, std::array::from_fn(|k| x[at + k])).map(Wide::round)
        };
        let multipliers = multiplier.iter().map(|m| x[place(*m)].round()).collect();
        ((0..model.node_count()).map(node).collect(), multipliers)
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
fn times(x: &[Wide; 4], block: &WideBlock) -> [Wide; 4] {
    std::array::from_fn(|c| (0..4).fold(Wide::ZERO, |sum, r| sum + x[r] * block[r][c]))
}

/// One over the bending stiffness of an element.
fn unit(table: &ElementTable) -> Wide {
    Wide::ONE / Wide::from(table.rows[1].section.bending)
}

/// Tangent of an element at displacements `u`, with the geometric stiffness of the strains `stored`.
pub fn element(
    span: &Span,
    k: usize,
    a: usize,
    u: &[[f64; 4]],
    stored: &Stored,
) -> ElementSums<Wide> {
    let table = span.table(k);
    let nodal = |n: &[f64; 4]| n.map(Wide::from);
    let old = ElementValues::new(&nodal(&u[a]), &nodal(&u[a + 1]));
    let zero = [Wide::ZERO; 2];
    let still = ElementValues { chord: zero, slope_a: zero, slope_b: zero };
    let mut sums = ElementSums::zero(Wide::ZERO);
    for (row, [membrane, bending]) in table.rows.iter().zip(stored) {
        let row = widened(row);
        let strains = Strains { membrane: Wide::from(*membrane), bending: Wide::from(*bending) };
        let point = step_point(&row, &old, &still);
        sums.add::<true>(
            &row,
            &collocation::foreseeing::<Wide, true>(&row.weighed, &point, strains),
        );
    }
    if let Some(samples) = &table.membrane {
        let samples = widened_samples(samples);
        let steps = samples.step(&old, &still);
        let points = std::array::from_fn(|i| MembranePoint {
            geometric: Wide::from(stored[i][0]),
            ..steps[i].collocated(span.measure, 1.0, 0.0)
        });
        samples.add::<true>(&points, 1.0, &mut sums);
    }
    sums
}

fn widened(row: &GaussRow) -> GaussRow<Wide> {
    let w = Wide::from;
    let law = |l: &SectionLaw<f64>| SectionLaw {
        axial: w(l.axial),
        bending: w(l.bending),
        rotary: w(l.rotary),
        measure: l.measure,
    };
    GaussRow {
        first: row.first.map(w),
        second: row.second.map(w),
        weight: w(row.weight),
        tangent: row.tangent.map(w),
        bend: row.bend.map(w),
        curvature: w(row.curvature),
        weighed: law(&row.weighed),
        section: law(&row.section),
        mass: w(row.mass),
        area: w(row.area),
        half_depth: w(row.half_depth),
    }
}

fn widened_samples(samples: &MembraneTable) -> MembraneTable<Wide> {
    let w = Wide::from;
    let all = |m: &[[f64; 3]; 3]| m.map(|row| row.map(w));
    MembraneTable {
        rows: all(&samples.rows),
        tangent: samples.tangent.map(|t| t.map(Wide::from)),
        // Symmetric to the last digit, which products in f64 are not.
        stiffness: std::array::from_fn(|i| {
            std::array::from_fn(|k| w(samples.stiffness[i.min(k)][i.max(k)]))
        }),
        at_gauss: all(&samples.at_gauss),
    }
}
