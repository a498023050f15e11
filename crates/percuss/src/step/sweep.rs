//! Elastic elements side by side in vector registers: residual and tangent of the invariant scheme.
//!
//! Every element sees the same operations in the same order, whatever registers the processor has, and nodal sums are taken element
//! by element: bits depend on neither.

use pulp::{Simd, WithSimd};

use super::assemble::EndForces;
use super::columns::Columns;
use super::integration::Integration;
use crate::element::beam::{ElementTable, ElementValues};
use crate::element::elastic::ElasticStep;
use crate::element::energy_momentum::End;
use crate::element::mapped::Replacement;
use crate::linalg::block::{Block, ZERO};
use crate::linalg::chain::Chain;
use crate::math::hermite::GAUSS;
use crate::model::frozen::Span;
use crate::model::{Model, StrainMeasure};
use crate::scalar::{Lanes, Real, in_lanes};
use crate::state::State;

/// Numbers of an [`End`].
const END: usize = 7;

/// What is kept of the elements while a step is iterated, and what an evaluation leaves.
#[derive(Clone, Debug, Default)]
pub struct Sweep {
    /// Numbers of the elements' tables, one entry a span: empty if its elements share one; nothing if it is not swept.
    tables: Vec<Option<Columns>>,
    /// Nodal displacements and velocities at the start of the step, and increments, shape (4, n_beam_node).
    displacement: Columns,
    velocity: Columns,
    increment: Columns,
    /// Gauss points at the start of the step, shape (n_gauss n_end, n_elem).
    starts: Columns,
    /// Angular rates of their tangents at the start and at the end, shape (n_gauss, n_elem) \[rad/s\].
    spin: Columns,
    end_spin: Columns,
    /// Accelerations as in [`EndForces::inertia`], shape (4, n_beam_node).
    inertia: Columns,
    /// Forces on both nodes, shape (8, n_elem) \[N, N m\].
    forces: Columns,
}

impl Sweep {
    /// Nothing evaluated yet.
    pub fn new(model: &Model) -> Self {
        let (nodes, elements) = (model.beam_node_count(), model.element_count());
        let nodal = || Columns::zeros(4, nodes);
        Self {
            tables: model.spans.iter().map(tables).collect(),
            displacement: nodal(),
            velocity: nodal(),
            increment: nodal(),
            starts: Columns::zeros(GAUSS * END, elements),
            spin: Columns::zeros(GAUSS, elements),
            end_spin: Columns::zeros(GAUSS, elements),
            inertia: nodal(),
            forces: Columns::zeros(8, elements),
        }
    }

    /// Whether the elements of a span are swept.
    pub fn has(&self, span: usize) -> bool {
        self.tables[span].is_some()
    }

    /// Begins a step: its start stays while it is iterated.
    pub fn begin(&mut self, model: &Model, state: &State) {
        in_lanes(Begin { sweep: self, model, state });
    }

    /// Angular rates at the end of the step, from the evaluation before.
    pub fn end_spin(&self, element: usize) -> [f64; GAUSS] {
        self.end_spin.row(element)
    }

    /// Gauss points of elements from `element` on at the start of the step.
    #[inline(always)]
    fn starts<P: Simd>(&self, like: Lanes<P>, element: usize) -> [End<Lanes<P>>; GAUSS] {
        [self.start(like, element, 0), self.start(like, element, 1), self.start(like, element, 2)]
    }

    #[inline(always)]
    fn start<P: Simd>(&self, like: Lanes<P>, element: usize, j: usize) -> End<Lanes<P>> {
        let (own, i) = (&self.starts, END * j);
        End {
            slope: [own.load(like, i, element), own.load(like, i + 1, element)],
            bend: [own.load(like, i + 2, element), own.load(like, i + 3, element)],
            stretch: own.load(like, i + 4, element),
            inverse: own.load(like, i + 5, element),
            membrane: own.load(like, i + 6, element),
        }
    }

    #[inline(always)]
    fn set_start<P: Simd>(&mut self, element: usize, j: usize, end: &End<Lanes<P>>) {
        let (own, i) = (&mut self.starts, END * j);
        own.store(i, element, end.slope[0]);
        own.store(i + 1, element, end.slope[1]);
        own.store(i + 2, element, end.bend[0]);
        own.store(i + 3, element, end.bend[1]);
        own.store(i + 4, element, end.stretch);
        own.store(i + 5, element, end.inverse);
        own.store(i + 6, element, end.membrane);
    }
}

/// The same number in every lane.
struct Alike<P: Simd>(Lanes<P>);

impl<P: Simd> Replacement<f64, Lanes<P>> for Alike<P> {
    #[inline(always)]
    fn of(&mut self, number: f64) -> Lanes<P> {
        self.0.constant(number)
    }
}

/// The numbers of elements from number `k` of a span on.
struct Each<'a, P: Simd> {
    like: Lanes<P>,
    numbers: &'a Columns,
    k: usize,
    column: usize,
}

impl<P: Simd> Replacement<f64, Lanes<P>> for Each<'_, P> {
    #[inline(always)]
    fn of(&mut self, _: f64) -> Lanes<P> {
        self.column += 1;
        self.numbers.load(self.like, self.column - 1, self.k)
    }
}

/// Numbers of a span's tables, if its elements are alike enough to stand side by side.
fn tables(span: &Span) -> Option<Columns> {
    let sampled = |t: &ElementTable| t.membrane.is_some();
    let alike = span.tables.windows(2).all(|t| sampled(&t[0]) == sampled(&t[1]));
    if span.fibres.is_some() || !alike {
        return None;
    }
    if span.tables.len() == 1 {
        return Some(Columns::default());
    }
    let mut count = 0;
    span.tables[0].map(&mut |_| count += 1);
    let mut numbers = Columns::zeros(count, span.tables.len());
    for (k, table) in span.tables.iter().enumerate() {
        let mut column = 0;
        table.map(&mut |x| {
            numbers.set(column, k, x);
            column += 1;
        });
    }
    Some(numbers)
}

/// Values of elements from node `a` on.
#[inline(always)]
fn values<P: Simd>(nodal: &Columns, like: Lanes<P>, a: usize) -> ElementValues<Lanes<P>> {
    ElementValues::new(&nodal.load_row(like, a), &nodal.load_row(like, a + 1))
}

/// See [`Sweep::begin`].
struct Begin<'a> {
    sweep: &'a mut Sweep,
    model: &'a Model,
    state: &'a State,
}

impl WithSimd for Begin<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<P: Simd>(self, family: P) {
        let Self { sweep, model, state } = self;
        let (like, nodes) = (Lanes::new(family, 0.0), model.beam_node_count());
        sweep.displacement.gather(0, &state.displacement[..nodes]);
        sweep.velocity.gather(0, &state.velocity[..nodes]);
        sweep.spin.gather(0, &state.spin);
        for (i, span) in model.spans.iter().enumerate() {
            if !sweep.has(i) {
                continue;
            }
            let mut table = span.tables[0].map(&mut Alike(like));
            for k in (0..span.elements.len()).step_by(P::F64_LANES) {
                if let (Some(numbers), true) = (&sweep.tables[i], span.tables.len() > 1) {
                    table = span.tables[0].map(&mut Each { like, numbers, k, column: 0 });
                }
                let u = values(&sweep.displacement, like, span.nodes.start + k);
                let ends = End::all(span.measure, &table.rows, &u);
                for (j, end) in ends.iter().enumerate() {
                    sweep.set_start(span.elements.start + k, j, end);
                }
            }
        }
    }
}

/// Residual of a span's elements at an increment, and their tangent if `TANGENT`.
pub struct SpanStep<'a, const TANGENT: bool> {
    pub model: &'a Model,
    /// Number of the span.
    pub span: usize,
    pub rule: &'a Integration,
    pub gravity: [f64; 2],
    pub increment: &'a [[f64; 4]],
    pub residual: &'a mut [[f64; 4]],
    pub chain: &'a mut Chain,
    pub forces: &'a mut EndForces,
}

impl<const TANGENT: bool> SpanStep<'_, TANGENT> {
    /// Evaluates.
    pub fn evaluate(self) {
        in_lanes(self);
    }
}

impl<const TANGENT: bool> WithSimd for SpanStep<'_, TANGENT> {
    type Output = ();
    #[inline(always)]
    fn with_simd<P: Simd>(mut self, family: P) {
        let like = Lanes::new(family, 0.0);
        self.accelerations(like);
        match self.model.spans[self.span].measure {
            StrainMeasure::Green => self.elements(like, StrainMeasure::Green),
            StrainMeasure::Engineering => self.elements(like, StrainMeasure::Engineering),
        }
        self.sum();
    }
}

impl<const TANGENT: bool> SpanStep<'_, TANGENT> {
    /// Accelerations of the nodes in the equation of motion, less gravity, with what mass-proportional damping adds.
    #[inline(always)]
    fn accelerations<P: Simd>(&mut self, like: Lanes<P>) {
        let span = &self.model.spans[self.span];
        let Sweep { velocity, increment, inertia, .. } = &mut self.forces.sweep;
        let nodes = span.nodes.clone();
        increment.gather(nodes.start, &self.increment[nodes.clone()]);
        let h = like.constant(self.rule.h);
        let rate = h.recip();
        let twice = rate + rate;
        let damping = like.constant(span.mass_damping);
        for n in nodes.clone().step_by(P::F64_LANES) {
            for i in 0..4 {
                let d = increment.load(like, i, n);
                // d/h as the divider rounds it: velocities are made of the same.
                let near = d * rate;
                let mean = near.add_product(d.sub_product(near, h), rate);
                let mut a = (mean - velocity.load(like, i, n)) * twice;
                a = a.add_product(damping, mean);
                if i < 2 {
                    a = a - like.constant(self.gravity[i]);
                }
                inertia.store(i, n, a);
            }
        }
        for n in nodes {
            self.forces.inertia[n] = self.forces.sweep.inertia.row(n);
        }
    }

    #[inline(always)]
    fn elements<P: Simd>(&mut self, like: Lanes<P>, measure: StrainMeasure) {
        let span = &self.model.spans[self.span];
        if TANGENT {
            self.chain.diag[span.nodes.start] = ZERO;
        }
        let rate = like.constant(self.rule.h).recip();
        let lag = like.constant(self.rule.lag(span.retardation));
        let damping = like.constant(span.mass_damping);
        let slope = self.rule.inertia_slope() + span.mass_damping * self.rule.rate_slope();
        let mut table = span.tables[0].map(&mut Alike(like));
        let count = span.elements.len();
        for k in (0..count).step_by(P::F64_LANES) {
            let sweep = &mut self.forces.sweep;
            if let (Some(numbers), true) = (&sweep.tables[self.span], span.tables.len() > 1) {
                table = span.tables[0].map(&mut Each { like, numbers, k, column: 0 });
            }
            let (a, element) = (span.nodes.start + k, span.elements.start + k);
            let step = ElasticStep {
                table: &table,
                measure,
                starts: &sweep.starts(like, element),
                spin: &sweep.spin.load_row(like, element),
                start: values(&sweep.displacement, like, a),
                increment: values(&sweep.increment, like, a),
                rate,
                lag,
                damping,
            };
            let (sums, spin) = step.sums::<TANGENT>();
            let [mut on_a, mut on_b] = sums.nodal_force();
            let acceleration =
                [sweep.inertia.load_row(like, a), sweep.inertia.load_row(like, a + 1)];
            table.add_inertia(&acceleration[0], &acceleration[1], &mut on_a, &mut on_b);
            for i in 0..4 {
                sweep.forces.store(i, element, on_a[i]);
                sweep.forces.store(4 + i, element, on_b[i]);
            }
            if TANGENT {
                let blocks = sums.nodal_tangent(&table.mass, like.constant(slope));
                spread(&blocks, a, P::F64_LANES.min(count - k), self.chain);
            } else {
                for j in 0..GAUSS {
                    sweep.end_spin.store(j, element, spin[j]);
                }
            }
        }
    }

    /// Sums the forces up at the nodes.
    #[inline(always)]
    fn sum(&mut self) {
        let span = &self.model.spans[self.span];
        let EndForces { on_nodes, sweep, .. } = &mut *self.forces;
        self.residual[span.nodes.start] = [0.0; 4];
        for (k, element) in span.elements.clone().enumerate() {
            let a = span.nodes.start + k;
            let [a1, a2, a3, a4, b1, b2, b3, b4] = sweep.forces.row(element);
            let (on_a, on_b) = ([a1, a2, a3, a4], [b1, b2, b3, b4]);
            on_nodes[element] = [on_a, on_b];
            for i in 0..4 {
                self.residual[a][i] += on_a[i];
            }
            self.residual[a + 1] = on_b;
        }
    }
}

/// Spreads the tangents of `count` elements from node `a` on over the band.
#[inline(always)]
fn spread<P: Simd>(blocks: &[[[Lanes<P>; 4]; 4]; 4], a: usize, count: usize, chain: &mut Chain) {
    let [aa, ab, ba, bb] = blocks;
    for lane in 0..count {
        let n = a + lane;
        for i in 0..4 {
            for j in 0..4 {
                chain.diag[n][i][j] += aa[i][j].at(lane);
            }
        }
        set_block(&mut chain.upper[n], ab, lane);
        set_block(&mut chain.lower[n], ba, lane);
        set_block(&mut chain.diag[n + 1], bb, lane);
    }
}

#[inline(always)]
fn set_block<P: Simd>(target: &mut Block, block: &[[Lanes<P>; 4]; 4], lane: usize) {
    for i in 0..4 {
        for j in 0..4 {
            target[i][j] = block[i][j].at(lane);
        }
    }
}
