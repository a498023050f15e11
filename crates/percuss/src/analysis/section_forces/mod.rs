//! Section forces of a step or an equilibrium, and their extremes over the length of each beam and over time.
//!
//! They follow from the balance of every element with the forces on its ends as the scheme has them, its loads and its
//! inertia ([`line`]), not from its strains: they agree with the reactions of supports, and jump only where something acts.
//! Of a step they are those of its middle, where the scheme has its balance, as reactions are means over the step.

mod acted;
mod between;
mod capacity;
mod drawn;
mod element;
mod fibres;
mod fibres_now;
mod lanes;
mod line;
mod lines;
mod runs;
mod screen;
mod sheared;
mod span_lines;

use crate::element::shear::MIDDLE;
use crate::element::yielding::GaussStrains;
use crate::math::hermite::{self, GAUSS};
use crate::model::Model;
use crate::model::frozen::{BeamData, MaterialPoint, Span, SpanFibres};
use crate::scalar::in_lanes;
use crate::state::State;
use crate::summary::{
    Envelope, PointForces, PointStress, SAME_SIZE, SectionForceSummary, SectionPeak, SectionRange,
};
use element::{ElementForces, PLACES, station};
use fibres::{Fibres, Strained};
use fibres_now::each_fibre;
use lanes::PlainSpan;
use line::SectionForces;

pub use acted::ordered;
pub use lines::{Acting, Lines};
pub use runs::{ElementActing, ElementPlace, ForceInside, RunForces};

/// Nothing seen yet, one entry a beam.
pub fn unset(model: &Model) -> Vec<SectionForceSummary> {
    let entry = |beam: &BeamData| {
        let acted = acted::places(model, beam);
        let n = acted::regular(beam) + 2 * acted.len();
        let places = |w: &[f64]| PLACES.map(|xi| station(w[0], w[1], xi));
        let mut s = Vec::with_capacity(n);
        for span in &model.spans[beam.spans.clone()] {
            s.extend(span.stations.windows(2).flat_map(places));
        }
        s.extend(acted.iter().flat_map(|at| [*at; 2]));
        let open = || [vec![f64::NAN; n], vec![f64::NAN; n]];
        let stressed = model.spans[beam.spans.clone()].iter().any(|span| !is_plain(span));
        let stress = if stressed { open() } else { Default::default() };
        let none = SectionRange::default();
        SectionForceSummary {
            name: beam.name.clone(),
            axial: none,
            shear: none,
            moment: none,
            strain: none,
            stress: none,
            shear_stress: none,
            von_mises_inside: SectionPeak::default(),
            beyond: None,
            beyond_inside: None,
            excess: None,
            plateau: plateau(&model.spans[beam.spans.clone()]),
            envelope: Envelope { s, axial: open(), shear: open(), moment: open(), stress },
        }
    };
    model.beams.iter().map(entry).collect()
}

/// The yield stress of spans without hardening, if it is one.
fn plateau(spans: &[Span]) -> Option<f64> {
    let mut all = spans.iter().map(|span| span.fibres.as_ref().and_then(SpanFibres::plateau));
    let first = all.next().flatten()?;
    all.all(|other| other == Some(first)).then_some(first)
}

/// Whether records of beams have as many places.
pub fn fit(a: &[SectionForceSummary], b: &[SectionForceSummary]) -> bool {
    let places = |all: &[SectionForceSummary]| -> Vec<[usize; 9]> {
        let of = |beam: &SectionForceSummary| {
            let e = &beam.envelope;
            let [[n0, n1], [q0, q1], [m0, m1], [s0, s1]] =
                [&e.axial, &e.shear, &e.moment, &e.stress]
                    .map(|pair| pair.each_ref().map(Vec::len));
            [e.s.len(), n0, n1, q0, q1, m0, m1, s0, s1]
        };
        all.iter().map(of).collect()
    };
    places(a) == places(b)
}

/// Takes section forces into the extremes so far; `state` is that at the end of the step.
pub fn update(model: &Model, lines: &Lines, state: &State, out: &mut [SectionForceSummary]) {
    for (beam, out) in model.beams.iter().zip(out) {
        let regular = acted::regular(beam);
        let acted = out.envelope.s.len() > regular;
        for span in &model.spans[beam.spans.clone()] {
            if is_plain(span) {
                let first = beam.elements.start;
                in_lanes(PlainSpan { span, first, lines, state, out: &mut *out });
                if acted {
                    acted::take_plain(span, lines, out, regular);
                }
                continue;
            }
            let torn = span.nodes.clone().any(|node| state.has_parted(node));
            for k in 0..span.elements.len() {
                let element = span.elements.start + k;
                let (line, inner) = lines.of(element);
                let (strained, yielded) =
                    (strained(span, k, state), yielded(span, k, state, lines));
                let (stresses, sheared) = (true, true);
                let piece =
                    ElementForces { span, k, line, inner, strained, yielded, stresses, sheared };
                let index = PLACES.len() * (element - beam.elements.start);
                piece.take(out, index, state.time);
                if acted {
                    piece.take_acted(out, regular);
                }
                if let Some(fibres) = span.fibres.as_ref().filter(|_| !torn) {
                    capacity::take(&piece, fibres, state, out);
                }
            }
        }
    }
}

/// Whether a span has section forces, but no stresses.
fn is_plain(span: &Span) -> bool {
    span.fibres.is_none() && !span.has_depth()
}

/// Strains of a span whose stresses tell of more than strains; else they follow from the forces.
fn strained(span: &Span, k: usize, state: &State) -> Option<[Strained; 2]> {
    let wanted = span.retardation > 0.0 && span.has_depth() && span.shear.is_none();
    wanted.then(|| fibres::strained(span, k, state))
}

/// Extreme fibres at the Gauss points of an element that can yield, as strained and stressed where the state stands. A gap is not a strain of the
/// material: failed fibres have none, and those of an element that has fractured have all failed.
fn yielded(span: &Span, k: usize, state: &State, lines: &Lines) -> Option<[Fibres; GAUSS]> {
    let fibres = span.fibres.as_ref()?;
    let mut out = [Fibres { strain: [f64::NAN; 2], stress: [f64::NAN; 2] }; GAUSS];
    let rates = lines.rates_of(span.elements.start + k);
    each_fibre((span, fibres, k), state, rates, |j, _, strain, stress| {
        for (range, value) in [(&mut out[j].strain, strain), (&mut out[j].stress, stress)] {
            *range = [range[0].min(value), range[1].max(value)];
        }
    });
    if span.shear.is_some() {
        out = [out[MIDDLE]; GAUSS]; // it has one point
    }
    Some(out)
}

/// Stresses at the top and at the bottom at a Gauss point of an element that can yield, shape (2) \[Pa\]; of several fibres at one
/// height that of larger magnitude.
fn yielded_faces(
    (span, fibres, k): (&Span, &SpanFibres, usize),
    state: &State,
    rates: Option<&GaussStrains>,
    at: usize,
) -> [f64; 2] {
    let (mut heights, mut out) = ([f64::NEG_INFINITY; 2], [f64::NAN; 2]);
    let at = if span.shear.is_some() { MIDDLE } else { at };
    each_fibre((span, fibres, k), state, rates, |j, height, _, stress| {
        if j != at {
            return;
        }
        for (side, height) in [height, -height].into_iter().enumerate() {
            let beside = height == heights[side] && stress.abs() > out[side].abs();
            if height > heights[side] || beside {
                (heights[side], out[side]) = (height, stress);
            }
        }
    });
    out
}

/// Section forces at a point. Where they jump, axial force, shear and moment are those just ahead of the point, and the stresses
/// are those of the side with the worse one.
pub fn at_point(model: &Model, lines: &Lines, state: &State, point: &MaterialPoint) -> PointForces {
    let mut found: Option<PointForces> = None;
    let [behind, front] = sides(model, point);
    // Without stresses, what is behind has no say.
    let plain = |(node, ..): &(usize, f64, bool)| is_plain(model.element_of(*node).0);
    let behind = behind.filter(|side| front.is_none() || !plain(side));
    for (node, xi, ahead) in [behind, front].into_iter().flatten() {
        let (span, k) = model.element_of(node);
        let (line, inner) = lines.of(span.elements.start + k);
        let (strained, yielded) = (strained(span, k, state), yielded(span, k, state, lines));
        let (stresses, sheared) = (true, false);
        let piece = ElementForces { span, k, line, inner, strained, yielded, stresses, sheared };
        let f = line.at(xi, inner, ahead);
        let own = stress_at(&piece, xi, &f, (state, lines));
        let stress = match found {
            Some(PointForces { stress: other, .. }) if is_worse(other.largest, own.largest) => {
                other
            }
            _ => own,
        };
        found = Some(PointForces { axial: f.axial, shear: f.shear, moment: f.moment, stress });
    }
    let none = f64::NAN;
    let stress = PointStress { largest: none, top: none, bottom: none };
    found.unwrap_or(PointForces { axial: none, shear: none, moment: none, stress })
}

/// Stresses of an element at a share of the way under the section forces there.
fn stress_at(
    piece: &ElementForces<'_>,
    xi: f64,
    forces: &SectionForces,
    (state, lines): (&State, &Lines),
) -> PointStress {
    let ElementForces { span, k, yielded, .. } = piece;
    let rates = lines.rates_of(span.elements.start + k);
    let Some((fibres, yielded)) = span.fibres.as_ref().zip(*yielded) else {
        let [top, bottom] = fibres::faces(&span.section_at(*k, xi), forces);
        let largest = piece.fibres(xi, forces).map_or(f64::NAN, |fibres| larger(fibres.stress));
        return PointStress { largest, top, bottom };
    };
    // Of an element that can yield, at the nearest Gauss point, of two the one with the larger stress: elsewhere fibres remember nothing.
    let at = |gauss: usize| {
        let [top, bottom] = yielded_faces((span, fibres, *k), state, rates, gauss);
        PointStress { largest: larger(yielded[gauss].stress), top, bottom }
    };
    let [one, other] = hermite::nearest_gauss_points(xi).map(at);
    if is_worse(other.largest, one.largest) { other } else { one }
}

/// Of the least and the largest stress that of larger magnitude; tension, where they are as large.
fn larger([least, most]: [f64; 2]) -> f64 {
    if is_worse(least, most) { least } else { most }
}

/// Whether a stress is larger than another by more than round-off, or there is no other.
fn is_worse(one: f64, other: f64) -> bool {
    one.abs() > other.abs() * (1.0 + SAME_SIZE) || other.is_nan()
}

/// The sides of a point, behind it and ahead of it: node a of the element, share of the way, whether ahead of what acts there.
fn sides(model: &Model, point: &MaterialPoint) -> [Option<(usize, f64, bool)>; 2] {
    let (span, k) = model.element_of(point.node);
    let beam = &model.beams[point.beam];
    let (a, b) = (span.stations[k], span.stations[k + 1]);
    let node = if point.shape[0] == 1.0 {
        point.node
    } else if point.shape[2] == 1.0 {
        point.node + 1
    } else {
        let xi = ((point.s - a) / (b - a)).clamp(0.0, 1.0);
        return [Some((point.node, xi, false)), Some((point.node, xi, true))];
    };
    // Where spans meet two nodes stand at the place.
    let (first, last) = (span.nodes.start, span.nodes.end - 1);
    let (mut behind, mut ahead) = (node.checked_sub(1), Some(node));
    if node == first {
        behind = (node > beam.nodes.start).then(|| node - 2);
    }
    if node == last {
        ahead = (node + 1 < beam.nodes.end).then_some(node + 1);
    }
    [behind.map(|n| (n, 1.0, true)), ahead.map(|n| (n, 0.0, false))]
}
