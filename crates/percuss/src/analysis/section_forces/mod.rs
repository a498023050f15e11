//! Section forces of a step or an equilibrium, and their extremes over the length of each beam and over time.
//!
//! They follow from the balance of every element with the forces on its ends as the scheme has them, its loads and its
//! inertia ([`line`]), not from its strains: they agree with the reactions of supports, and jump only where something acts.
//! Of a step they are those of its middle, where the scheme has its balance, as reactions are means over the step.

mod between;
mod fibres;
mod lanes;
mod line;
mod lines;

use crate::element::beam::ElementValues;
use crate::element::yielding::gauss_strains;
use crate::math::hermite::{self, GAUSS};
use crate::model::Model;
use crate::model::frozen::{BeamData, MaterialPoint, Span};
use crate::scalar::in_lanes;
use crate::state::State;
use crate::summary::{Envelope, SectionForceSummary, SectionPeak, SectionRange};
use fibres::{Fibres, Strained};
use lanes::PlainSpan;
use line::{Inner, Line, SectionForces};

pub use lines::{Acting, Lines};

/// Places of an element that the envelope knows: both ends and the middle.
const PLACES: [f64; 3] = [0.0, 0.5, 1.0];

/// What changes by less than this share of itself along half an element does not change.
const FLAT: f64 = 1e-12;

/// Nothing seen yet, one entry a beam.
pub fn unset(model: &Model) -> Vec<SectionForceSummary> {
    let entry = |beam: &BeamData| {
        let n = PLACES.len() * beam.elements.len();
        let places = |w: &[f64]| PLACES.map(|xi| station(w[0], w[1], xi));
        let s = model.spans[beam.spans.clone()]
            .iter()
            .flat_map(|span| span.stations.windows(2).flat_map(places))
            .collect();
        let open = || [vec![f64::NAN; n], vec![f64::NAN; n]];
        let none = SectionRange::default();
        SectionForceSummary {
            name: beam.name.clone(),
            axial: none,
            shear: none,
            moment: none,
            strain: none,
            stress: none,
            beyond: None,
            envelope: Envelope { s, axial: open(), shear: open(), moment: open(), stress: open() },
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

/// Arc length at a share of the way.
fn station(a: f64, b: f64, xi: f64) -> f64 {
    if xi == 1.0 { b } else { a + xi * (b - a) }
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
                let piece = ElementForces { span, k, line, inner, strained, yielded };
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

/// An element with its section forces.
struct ElementForces<'a> {
    span: &'a Span,
    k: usize,
    line: Line,
    /// Forces inside the element, by place, shape (such forces).
    inner: &'a [Inner],
    /// Strains at both nodes, where they do not follow from the forces, shape (2).
    strained: Option<[Strained; 2]>,
    /// Extreme fibres at the Gauss points of an element that can yield, shape (Gauss points).
    yielded: Option<[Fibres; GAUSS]>,
}

impl ElementForces<'_> {
    /// Arc length at a share of the way.
    fn s(&self, xi: f64) -> f64 {
        station(self.span.stations[self.k], self.span.stations[self.k + 1], xi)
    }

    /// Extreme fibres; nothing without a depth.
    fn fibres(&self, xi: f64, forces: &SectionForces) -> Option<Fibres> {
        if !self.span.has_depth() || self.yielded.is_some() {
            return None;
        }
        let section = self.span.section_at(self.k, xi);
        let gauss = ((xi * GAUSS as f64) as usize).min(GAUSS - 1);
        let curvature = self.span.table(self.k).rows[gauss].reference.curvature;
        let strained = self.strained.map(|[a, b]| {
            let mix = |a: f64, b: f64| (1.0 - xi) * a + xi * b;
            Strained { stretch: mix(a.stretch, b.stretch), turn: mix(a.turn, b.turn) }
        });
        Some(fibres::fibres(&section, curvature, forces, strained))
    }

    /// Takes the element into the extremes of its beam, its places into the envelope from `index` on.
    fn take(&self, out: &mut SectionForceSummary, index: usize, time: f64) {
        let places = PLACES.map(|xi| self.line.at(xi, self.inner, false));
        for (j, forces) in places.iter().enumerate() {
            let fibres = self.take_at(out, PLACES[j], forces, time);
            let e = &mut out.envelope;
            widen(&mut e.axial, index + j, forces.axial, forces.axial);
            widen(&mut e.shear, index + j, forces.shear, forces.shear);
            widen(&mut e.moment, index + j, forces.moment, forces.moment);
            if let Some(Fibres { stress: [least, most], .. }) = fibres {
                widen(&mut e.stress, index + j, least, most);
            }
        }
        for (j, fibres) in self.yielded.iter().flatten().enumerate() {
            self.take_fibres(out, hermite::gauss_points()[j], fibres, time);
            let [least, most] = fibres.stress;
            widen(&mut out.envelope.stress, index + j, least, most);
        }
        if !self.inner.is_empty() {
            self.take_between_forces(out, time);
        } else {
            self.take_between_places(out, &places, time);
        }
    }

    fn take_at(
        &self,
        out: &mut SectionForceSummary,
        xi: f64,
        forces: &SectionForces,
        time: f64,
    ) -> Option<Fibres> {
        let s = self.s(xi);
        out.axial.take(forces.axial, s, time);
        out.shear.take(forces.shear, s, time);
        out.moment.take(forces.moment, s, time);
        let fibres = self.fibres(xi, forces)?;
        self.take_fibres(out, xi, &fibres, time);
        Some(fibres)
    }

    fn take_fibres(&self, out: &mut SectionForceSummary, xi: f64, fibres: &Fibres, time: f64) {
        let s = self.s(xi);
        for side in 0..2 {
            out.stress.take(fibres.stress[side], s, time);
            out.strain.take(fibres.strain[side], s, time);
            let (stress, strength) = (fibres.stress[side], self.span.strength);
            // At the first instant, where it is largest.
            let first = out.beyond.is_none_or(|b| b.time == time && stress.abs() > b.value.abs());
            if first && strength.is_some_and(|strength| strength.is_passed(stress)) {
                out.beyond = Some(SectionPeak { value: stress, s, time });
            }
        }
    }
}

fn widen([min, max]: &mut [Vec<f64>; 2], i: usize, least: f64, most: f64) {
    // The first value replaces NaN.
    if least < min[i] || min[i].is_nan() {
        min[i] = least;
    }
    if most > max[i] || max[i].is_nan() {
        max[i] = most;
    }
}

/// Section forces at a point, and the stress of larger magnitude. Where they jump, axial force, shear and moment are those just
/// ahead of the point, and the stress is the worse of both sides.
pub fn at_point(model: &Model, lines: &Lines, state: &State, point: &MaterialPoint) -> [f64; 4] {
    let mut found: Option<[f64; 4]> = None;
    for (node, xi, ahead) in sides(model, point).into_iter().flatten() {
        let (span, k) = model.element_of(node);
        let (line, inner) = lines.of(span.elements.start + k);
        let (strained, yielded) = (strained(span, k, state), yielded(span, k, state));
        let piece = ElementForces { span, k, line, inner, strained, yielded };
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
