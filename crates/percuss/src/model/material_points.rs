//! Material points of beams: positions of references.

use super::definition::{Along, PointRef};
use super::frozen::{MaterialPoint, Model, Span};
use crate::element::shear::StretchedPlace;
use crate::math::vec2::norm;

/// The material point meant by a (checked) reference; points within a billionth of an element of a node are that node, at a
/// corner the end of the span before it.
pub(super) fn locate(model: &Model, reference: &PointRef) -> MaterialPoint {
    let beam_index = reference.beam.0 as usize;
    let beam = &model.beams[beam_index];
    let s = match reference.along {
        Along::Fraction(f) => f * beam.length,
        Along::Distance(s) => s,
    };
    MaterialPoint { label: reference.label.clone(), ..point_at(model, beam_index, s) }
}

/// The material point at arc length `s` of a beam.
pub(super) fn point_at(model: &Model, beam_index: usize, s: f64) -> MaterialPoint {
    let beam = &model.beams[beam_index];
    let spans = &model.spans[beam.spans.clone()];
    let slack = 1e-12 * beam.length;
    let last = |span: &Span| span.stations[span.stations.len() - 1];
    let first = spans.partition_point(|span| s > last(span) + slack);
    let span = &spans[first.min(spans.len() - 1)];
    let n = span.elements.len();
    let mut element = span.stations.partition_point(|x| *x <= s).clamp(1, n) - 1;
    let share = |element: usize| {
        (s - span.stations[element]) / (span.stations[element + 1] - span.stations[element])
    };
    let mut xi = share(element);
    if (xi - xi.round()).abs() < 1e-9 {
        xi = xi.round();
        if xi == 1.0 && element + 1 < n {
            (element, xi) = (element + 1, 0.0);
        }
    }
    let (node, inside) = (span.nodes.start + element, span.inside(element));
    let (a, b) = (model.nodes[node], model.nodes[node + 1]);
    let (shape, slope) = (inside.axis(xi), inside.section(xi));
    let combine = |n: &[f64; 4]| {
        [0, 1].map(|i| {
            n[0] * a.position[i] + n[1] * a.tangent[i] + n[2] * b.position[i] + n[3] * b.tangent[i]
        })
    };
    // Derivatives with respect to the arc length of the interpolated reference.
    let stretch = match xi {
        0.0 | 1.0 => 1.0,
        _ => norm(combine(&slope)),
    };
    let slope = slope.map(|c| c / stretch);
    let tangent = if xi == 0.0 {
        a.tangent
    } else if xi == 1.0 {
        b.tangent
    } else {
        combine(&slope)
    };
    MaterialPoint {
        label: String::new(),
        beam: beam_index,
        node,
        xi,
        s,
        position: combine(&shape),
        shape,
        slope,
        tangent,
        stretched: StretchedPlace::new(
            &inside,
            xi,
            [a.position, b.position],
            [a.tangent, b.tangent],
        )
        .map(Box::new),
    }
}
