//! Lines of a span's section forces, element beside element.

use super::line::{ElementShape, Line, NUMBERS};
use crate::model::frozen::Span;
use crate::scalar::Lanes;
use crate::step::columns::Columns;
use crate::step::sweep::{Alike, Sweep};
use pulp::{Simd, WithSimd};

/// The lines of a span that has been swept, but for forces inside its elements.
pub struct SpanLines<'a> {
    pub span: &'a Span,
    /// Number of the span.
    pub number: usize,
    pub sweep: &'a Sweep,
    /// Where in the step forces are evaluated, as a share of it.
    pub theta: f64,
    /// Coefficients of the lines of all elements, shape (numbers of a line, elements) \[m, N, N m\].
    pub lines: &'a mut Columns,
}

impl WithSimd for SpanLines<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<P: Simd>(self, family: P) {
        let Self { span, number, sweep, theta, lines } = self;
        let like = Lanes::new(family, 0.0);
        let mut table = span.tables[0].map(&mut Alike(like));
        for k in (0..span.elements.len()).step_by(P::F64_LANES) {
            if let Some(own) = sweep.table((number, span), k, like) {
                table = own;
            }
            let element = span.elements.start + k;
            let acting = sweep.acting(like, span.nodes.start + k, element);
            let mut moved = acting.displacement;
            for node in 0..2 {
                for i in 0..4 {
                    moved[node][i] += acting.increment[node][i] * theta;
                }
            }
            let ([fa, fb], [ma, mb]) = (&acting.frames, &moved);
            let shape = ElementShape {
                tangents: [[fa[2] + ma[2], fa[3] + ma[3]], [fb[2] + mb[2], fb[3] + mb[3]]],
                chord: [(fb[0] - fa[0]) + (mb[0] - ma[0]), (fb[1] - fa[1]) + (mb[1] - ma[1])],
                length: table.length,
            };
            let mut along = [[like; 4]; 2];
            let [on_a, on_b] = &mut along;
            table.add_inertia(&acting.inertia[0], &acting.inertia[1], on_a, on_b);
            let (mut line, left) = Line::open(&shape, &acting.forces, &along);
            line.close_smooth(left);
            let numbers = line.numbers();
            for i in 0..NUMBERS {
                lines.store(i, element, numbers[i]);
            }
        }
    }
}
