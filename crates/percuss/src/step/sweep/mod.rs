//! Elements side by side in vector registers: energies and momenta, residual and tangent of the invariant scheme.
//!
//! Every element has the same operations in the same order, for any registers of the processor, and nodal sums are taken element by element: bits
//! depend on neither.

mod advance;
mod fibres;
mod span;
mod start;

use pulp::Simd;

use fibres::SweptFibres;

use super::columns::Columns;
use crate::element::beam::{ElementTable, ElementValues};
use crate::element::energy_momentum::End;
use crate::element::mapped::Replacement;
use crate::math::hermite::GAUSS;
use crate::model::Model;
use crate::model::frozen::Span;
use crate::scalar::{Lanes, Real};

pub use advance::AdvanceFibres;
pub use span::SpanStep;

/// Numbers of an [`End`].
const END: usize = 7;

/// Data of the elements during the iteration of a step, and results of an evaluation.
#[derive(Clone, Debug, Default)]
pub struct Sweep {
    /// Numbers of the elements' tables, one entry per span, shape (spans, numbers of a table, elements) \[each its own\]: empty if its elements
    /// share one; `None` if it is not swept.
    tables: Vec<Option<Columns>>,
    /// Positions and tangents of the nodes in the reference configuration, shape (4, beam nodes) \[m, -\].
    frames: Columns,
    /// Whether the state at the start of the step has been taken in.
    begun: bool,
    /// Whether forces and accelerations are those of the last evaluation.
    evaluated: bool,
    /// Nodal displacements at the start of the step, shape (4, beam nodes) \[m, -\].
    displacement: Columns,
    /// Nodal velocities at the start of the step, shape (4, beam nodes) \[m/s, 1/s\].
    velocity: Columns,
    /// Increments of the nodal displacements, shape (4, beam nodes) \[m, -\].
    increment: Columns,
    /// Gauss points at the start of the step, shape (Gauss points times numbers of an end, elements) \[-, 1/m\].
    starts: Columns,
    /// Angular rates of their tangents at the start, shape (Gauss points, elements) \[rad/s\].
    spin: Columns,
    /// The same at the end, shape (Gauss points, elements) \[rad/s\].
    end_spin: Columns,
    /// Accelerations as in [`EndForces::inertia()`](super::end_forces::EndForces::inertia()), shape (4, beam nodes) \[m/s^2, 1/s^2\].
    inertia: Columns,
    /// Forces on both nodes, shape (8, elements) \[N, N m\].
    forces: Columns,
    /// Fibres, one entry a span, shape (spans).
    fibres: Vec<SweptFibres>,
    /// Whether all fibres of a span are intact, shape (spans); failed ones are evaluated one by one.
    carries_force: Vec<bool>,
}

impl Sweep {
    /// State before any evaluation.
    pub fn new(model: &Model) -> Self {
        let (nodes, elements) = (model.beam_node_count(), model.element_count());
        let nodal = || Columns::zeros(4, nodes);
        let mut frames = nodal();
        for (n, frame) in model.nodes[..nodes].iter().enumerate() {
            let ([x, y], [s, t]) = (frame.position, frame.tangent);
            frames.gather(n, &[[x, y, s, t]]);
        }
        Self {
            frames,
            begun: false,
            evaluated: false,
            tables: model.spans.iter().map(tables).collect(),
            displacement: nodal(),
            velocity: nodal(),
            increment: nodal(),
            starts: Columns::zeros(GAUSS * END, elements),
            spin: Columns::zeros(GAUSS, elements),
            end_spin: Columns::zeros(GAUSS, elements),
            inertia: nodal(),
            forces: Columns::zeros(8, elements),
            fibres: vec![SweptFibres::default(); model.spans.len()],
            carries_force: vec![true; model.spans.len()],
        }
    }

    /// Whether the elements of a span are swept.
    pub fn has(&self, span: usize) -> bool {
        self.tables.get(span).is_some_and(Option::is_some) && self.carries_force[span]
    }

    /// Whether the elements of a span are swept, and the forces on them are those of the last evaluation.
    pub fn has_evaluated(&self, span: usize) -> bool {
        self.evaluated && self.has(span)
    }

    /// Forces on both nodes of an element, as evaluated, shape (2, 4) \[N, N m\].
    pub fn on_nodes(&self, element: usize) -> [[f64; 4]; 2] {
        let [a1, a2, a3, a4, b1, b2, b3, b4] = self.forces.row(element);
        [[a1, a2, a3, a4], [b1, b2, b3, b4]]
    }

    /// Acceleration of a node, as evaluated, shape (4) \[m/s^2, 1/s^2\].
    pub fn inertia(&self, node: usize) -> [f64; 4] {
        self.inertia.row(node)
    }

    /// Adds forces on both nodes of an element to those evaluated.
    pub fn add_on_nodes(&mut self, element: usize, forces: &[[f64; 4]; 2]) {
        let own = self.on_nodes(element);
        for (i, (own, force)) in own.as_flattened().iter().zip(forces.as_flattened()).enumerate() {
            self.forces.set(i, element, own + force);
        }
    }

    /// Adds to the acceleration of a node that was evaluated.
    pub fn add_inertia(&mut self, node: usize, acceleration: &[f64; 4]) {
        let own = self.inertia(node);
        (0..4).for_each(|i| self.inertia.set(i, node, own[i] + acceleration[i]));
    }

    /// Angular rates at the end of the step, from the evaluation before.
    pub fn end_spin(&self, element: usize) -> [f64; GAUSS] {
        self.end_spin.row(element)
    }

    /// Enters the forces of an element that is not swept.
    pub fn set_end_spin(&mut self, element: usize, spin: [f64; GAUSS]) {
        for (j, spin) in spin.into_iter().enumerate() {
            self.end_spin.set(j, element, spin);
        }
    }

    /// Tables of elements from number `k` of a span on; `None` if they share one.
    #[inline(always)]
    pub fn table<P: Simd>(
        &self,
        (number, span): (usize, &Span),
        k: usize,
        like: Lanes<P>,
    ) -> Option<ElementTable<Lanes<P>>> {
        let numbers = self.tables[number].as_ref().filter(|_| span.tables.len() > 1)?;
        Some(span.tables[0].map(&mut Each { like, numbers, k, column: 0 }))
    }

    /// Forces on elements from `element` on, whose first node is `a`.
    #[inline(always)]
    pub fn acting<P: Simd>(
        &self,
        like: Lanes<P>,
        a: usize,
        element: usize,
    ) -> EndActions<Lanes<P>> {
        let forces: [Lanes<P>; 8] = self.forces.load_row(like, element);
        let [a1, a2, a3, a4, b1, b2, b3, b4] = forces;
        EndActions {
            frames: [self.frames.load_row(like, a), self.frames.load_row(like, a + 1)],
            displacement: [
                self.displacement.load_row(like, a),
                self.displacement.load_row(like, a + 1),
            ],
            increment: [self.increment.load_row(like, a), self.increment.load_row(like, a + 1)],
            inertia: [self.inertia.load_row(like, a), self.inertia.load_row(like, a + 1)],
            forces: [[a1, a2, a3, a4], [b1, b2, b3, b4]],
        }
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

/// Forces on an element in a step, at both nodes.
#[derive(Clone, Copy, Debug)]
pub struct EndActions<S> {
    /// Reference position and tangent, shape (2, 4) \[m, -\].
    pub frames: [[S; 4]; 2],
    /// Displacements at the start, shape (2, 4) \[m, -\].
    pub displacement: [[S; 4]; 2],
    /// Their increments, shape (2, 4) \[m, -\].
    pub increment: [[S; 4]; 2],
    /// Accelerations as in [`EndForces`](super::end_forces::EndForces), shape (2, 4) \[m/s^2, 1/s^2\].
    pub inertia: [[S; 4]; 2],
    /// Forces as there, shape (2, 4) \[N, N m\].
    pub forces: [[S; 4]; 2],
}

/// The same number in every lane.
pub struct Alike<P: Simd>(pub Lanes<P>);

impl<P: Simd> Replacement<f64, Lanes<P>> for Alike<P> {
    #[inline(always)]
    fn of(&mut self, number: f64) -> Lanes<P> {
        self.0.constant(number)
    }
}

/// The numbers of elements from number `k` of a span on.
struct Each<'a, P: Simd> {
    like: Lanes<P>,
    /// Numbers of the tables, shape (numbers of a table, elements of the span) \[each its own\].
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

/// Numbers of a span's tables, if its elements are similar enough to share registers.
fn tables(span: &Span) -> Option<Columns> {
    let sampled = |t: &ElementTable| t.membrane.as_ref().map(|m| m.is_nodal);
    let alike = span.tables.windows(2).all(|t| sampled(&t[0]) == sampled(&t[1]));
    if !alike || span.shear.is_some() || !SweptFibres::can_hold(span) {
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
