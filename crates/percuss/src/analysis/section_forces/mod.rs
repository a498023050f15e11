//! Section forces of a step or an equilibrium, and their extremes over the length of each beam and over time.
//!
//! They follow from the balance of every element with the forces on its ends as the scheme has them, its loads and its
//! inertia ([`line`]), not from its strains: they agree with the reactions of supports, and jump only where something acts.
//! Of a step they are those of its middle, where the scheme has its balance, as reactions are means over the step.

mod between;
mod element;
mod fibres;
mod lanes;
mod line;
mod lines;
mod runs;
mod screen;
mod span_lines;

use crate::element::beam::ElementValues;
use crate::element::yielding::gauss_strains;
use crate::math::hermite::GAUSS;
use crate::model::Model;
use crate::model::frozen::{BeamData, MaterialPoint, Span};
use crate::scalar::in_lanes;
use crate::state::State;
use crate::summary::{Envelope, SectionForceSummary, SectionRange};
use element::{ElementForces, PLACES, station};
use fibres::{Fibres, Strained};
use lanes::PlainSpan;

pub use lines::{Acting, Lines};
pub use runs::{ElementActing, ElementPlace, ForceInside, RunForces};

/// Nothing seen yet, one entry a beam.
pub fn unset(model: &Model) -> Vec<SectionForceSummary> {
    let entry = |beam: &BeamData| {
        let n = PLACES.len() * beam.elements.len();
        let places = |w: &[f64]| PLACES.map(|xi| station(w[0], w[1], xi));
        let mut s = Vec::with_capacity(n);
        for span in &model.spans[beam.spans.clone()] {
            s.extend(span.stations.windows(2).flat_map(places));
        }
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
            beyond: None,
            envelope: Envelope { s, axial: open(), shear: open(), moment: open(), stress },
        }
    };
    model.beams.iter().map(entry).collect()
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
        for span in &model.spans[beam.spans.clone()] {
            if is_plain(span) {
                let first = beam.elements.start;
                in_lanes(PlainSpan { span, first, lines, state, out: &mut *out });
                continue;
            }
            for k in 0..span.elements.len() {
                let element = span.elements.start + k;
                let (line, inner) = lines.of(element);
                let (strained, yielded) = (strained(span, k, state), yielded(span, k, state));
                let stresses = true;
                let piece = ElementForces { span, k, line, inner, strained, yielded, stresses };
                let index = PLACES.len() * (element - beam.elements.start);
                piece.take(out, index, state.time);
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
    let wanted = span.retardation > 0.0 && span.has_depth();
    wanted.then(|| fibres::strained(span, k, state))
}

/// Extreme fibres at the Gauss points of an element that can yield, as strained and stressed where the state stands.
fn yielded(span: &Span, k: usize, state: &State) -> Option<[Fibres; GAUSS]> {
    let fibres = span.fibres.as_ref()?;
    let (a, u) = (span.nodes.start + k, &state.displacement);
    let u = ElementValues::new(&u[a], &u[a + 1]);
    let strains = gauss_strains(span.table(k), span.measure, &u);
    let of = state.fibres_of(fibres, k);
    Some(std::array::from_fn(|j| {
        let mut out = Fibres { strain: [f64::NAN; 2], stress: [f64::NAN; 2] };
        for (fibre, memory) in of.at(j) {
            let strain = strains[j][0] + fibre.height * strains[j][1];
            let stress = fibres.laws[fibre.law].stress(memory, strain);
            for (range, value) in [(&mut out.strain, strain), (&mut out.stress, stress)] {
                *range = [range[0].min(value), range[1].max(value)];
            }
        }
        out
    }))
}

/// Section forces at a point, and the stress of larger magnitude. Where they jump, axial force, shear and moment are those just
/// ahead of the point, and the stress is the worse of both sides.
pub fn at_point(model: &Model, lines: &Lines, state: &State, point: &MaterialPoint) -> [f64; 4] {
    let mut found: Option<[f64; 4]> = None;
    let [behind, front] = sides(model, point);
    // Without stresses, what is behind has no say.
    let plain = |(node, ..): &(usize, f64, bool)| is_plain(model.element_of(*node).0);
    let behind = behind.filter(|side| front.is_none() || !plain(side));
    for (node, xi, ahead) in [behind, front].into_iter().flatten() {
        let (span, k) = model.element_of(node);
        let (line, inner) = lines.of(span.elements.start + k);
        let (strained, yielded) = (strained(span, k, state), yielded(span, k, state));
        let stresses = true;
        let piece = ElementForces { span, k, line, inner, strained, yielded, stresses };
        let f = line.at(xi, inner, ahead);
        // Of an element that can yield, at the nearest Gauss point: elsewhere fibres remember nothing.
        let near = ((xi * GAUSS as f64) as usize).min(GAUSS - 1);
        let fibres = piece.fibres(xi, &f).or(piece.yielded.map(|fibres| fibres[near]));
        let stress = fibres.map_or(f64::NAN, |fibres| {
            let [least, most] = fibres.stress;
            if least.abs() > most.abs() { least } else { most }
        });
        let worse = match found {
            Some([.., other]) if other.abs() > stress.abs() || stress.is_nan() => other,
            _ => stress,
        };
        found = Some([f.axial, f.shear, f.moment, worse]);
    }
    found.unwrap_or([f64::NAN; 4])
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
