//! Meshes of beams that can yield: short elements where plastic hinges may form.
//!
//! An element has a linear curvature and, at its nodes, the slope of its neighbours. With three Gauss points a hinge at one of its ends turns without
//! more work than at a point about a pole at 0.285 of its length (`hinge_pole` of the advisor): between two hinges a stretch of length a with elements of
//! lengths h there bears `1/(1 - 0.285 (h1 + h2)/a)` times the collapse load. Eight equal elements of a clamped beam with a force in its middle bear
//! 17 % more. With one element of a tenth of the mean length at each end of a stretch it is 1.5 %, and the others are longer by a third only.

use super::centre_line::CentreLine;
use super::definition::{Beam, ElementSize};
use super::mesh::{BeamPlace, SAME_PLACE, SLIVER, SpanPlan, cut, parts_of, share_out};

/// Length of an element at a hinge over the mean of its stretch, unless it is less than the least.
const SHORT: f64 = 0.1;

/// A part of a beam between neighbouring places that have a node.
struct HingeStretch {
    /// Its part \[index of a part\].
    part: usize,
    from: f64,
    to: f64,
    /// Whether a hinge may form at its start and at its end, shape (2).
    hinges: [bool; 2],
    /// Least length of a short element at its start and at its end, shape (2) \[m\].
    least: [f64; 2],
}

impl HingeStretch {
    fn length(&self) -> f64 {
        self.to - self.from
    }

    fn hinge_count(&self) -> usize {
        self.hinges.iter().filter(|hinge| **hinge).count()
    }

    /// Its nodes after the first, with so many elements between short ones.
    fn stations(&self, full: usize, short: bool) -> Vec<f64> {
        let count = if short { self.hinge_count() } else { 0 };
        let mean = self.length() / (full + count) as f64;
        let size = |end: usize| (SHORT * mean).max(self.least[end]).min(mean);
        let at = |end: usize| if short && self.hinges[end] { size(end) } else { 0.0 };
        let (a, b) = (self.from + at(0), self.to - at(1));
        let mut out = Vec::with_capacity(full + count);
        if a > self.from {
            out.push(a);
        }
        out.extend((1..full).map(|i| a + (b - a) * (i as f64 / full as f64)));
        if b < self.to {
            out.push(b);
        }
        out.push(self.to);
        out
    }
}

/// A beam before it is meshed.
struct HingeLayout {
    /// Its parts, shape (parts).
    parts: Vec<SpanPlan>,
    /// Places inside each part that have a node, shape (parts, places).
    breaks: Vec<Vec<BeamPlace>>,
    /// What lies between these and the ends of parts, shape (stretches).
    stretches: Vec<HingeStretch>,
}

impl HingeLayout {
    fn new(
        beam: &Beam,
        line: &CentreLine,
        places: &[BeamPlace],
        least: impl Fn(&SpanPlan, f64) -> Option<f64>,
    ) -> Self {
        let parts = parts_of(beam, line);
        let near = near(beam, line);
        let breaks: Vec<_> = parts.iter().map(|part| breaks(part, places, near)).collect();
        let stretches = stretches(&parts, &breaks, ends(line, places), least);
        Self { parts, breaks, stretches }
    }
}

/// Spans of a beam with nodes at `places`, which are in their order along it, those struck among them; and whether it has short elements. The least
/// length of these at a place of a part is `least`, none if the part cannot yield.
pub fn spans(
    beam: &Beam,
    line: &CentreLine,
    places: &[BeamPlace],
    least: impl Fn(&SpanPlan, f64) -> Option<f64>,
) -> (Vec<SpanPlan>, bool) {
    let HingeLayout { mut parts, breaks, stretches } = HingeLayout::new(beam, line, places, least);
    let (full, short) = numbers(beam.mesh.size, &stretches);
    for part in &mut parts {
        part.stations.truncate(1);
    }
    for (stretch, full) in stretches.iter().zip(full) {
        parts[stretch.part].stations.extend(stretch.stations(full, short));
    }
    let spans = parts.into_iter().zip(breaks).flat_map(|(part, breaks)| cut(part, &breaks));
    (spans.collect(), short)
}

/// Places at which a plastic hinge may form, between parts and in those that can yield, in their order along the beam \[m\].
pub fn hinges(
    beam: &Beam,
    line: &CentreLine,
    places: &[BeamPlace],
    least: impl Fn(&SpanPlan, f64) -> Option<f64>,
) -> Vec<f64> {
    let mut out: Vec<f64> = Vec::new();
    for stretch in &HingeLayout::new(beam, line, places, least).stretches {
        let at = [stretch.from, stretch.to].into_iter().zip(stretch.hinges);
        out.extend(at.filter(|(_, hinge)| *hinge).map(|(s, _)| s));
    }
    out.dedup();
    out
}

/// Places closer to each other than this share a node \[m\].
fn near(beam: &Beam, line: &CentreLine) -> f64 {
    let mean = match beam.mesh.size {
        ElementSize::Number(n) => line.length() / n.max(1) as f64,
        ElementSize::Length(h) => h.min(line.length()),
    };
    SLIVER * SHORT * mean
}

/// Whether a hinge may form at the start and at the end of the beam.
fn ends(line: &CentreLine, places: &[BeamPlace]) -> [bool; 2] {
    let slack = SAME_PLACE * line.length();
    [0.0, line.length()]
        .map(|end| places.iter().any(|place| place.hinge && (place.s - end).abs() <= slack))
}

/// Places inside a part, those close to each other as one.
fn breaks(part: &SpanPlan, places: &[BeamPlace], near: f64) -> Vec<BeamPlace> {
    let [from, to] = [part.stations[0], part.stations[1]];
    let mut out: Vec<BeamPlace> = Vec::new();
    for place in places.iter().filter(|p| p.s - from > near && to - p.s > near) {
        match out.last_mut() {
            Some(before) if place.s - before.s <= near => {
                before.ends_span |= place.ends_span;
                before.hinge |= place.hinge;
            }
            _ => out.push(*place),
        }
    }
    out
}

fn stretches(
    parts: &[SpanPlan],
    breaks: &[Vec<BeamPlace>],
    ends: [bool; 2],
    least: impl Fn(&SpanPlan, f64) -> Option<f64>,
) -> Vec<HingeStretch> {
    let mut out = Vec::new();
    for (part, plan) in parts.iter().enumerate() {
        let mut from = (plan.stations[0], part > 0 || ends[0]);
        let last = (plan.stations[1], part + 1 < parts.len() || ends[1]);
        for to in breaks[part].iter().map(|place| (place.s, place.hinge)).chain([last]) {
            let least = [from, to].map(|(s, hinge)| least(plan, s).filter(|_| hinge));
            let hinges = least.map(|least| least.is_some());
            let least = least.map(|least| least.unwrap_or(0.0));
            out.push(HingeStretch { part, from: from.0, to: to.0, hinges, least });
            from = to;
        }
    }
    out
}

/// Number of elements of each stretch but for short ones, and whether there are such: only if the requested number allows for one more each.
fn numbers(size: ElementSize, stretches: &[HingeStretch]) -> (Vec<usize>, bool) {
    let lengths: Vec<f64> = stretches.iter().map(HingeStretch::length).collect();
    let short: usize = stretches.iter().map(HingeStretch::hinge_count).sum();
    match size {
        ElementSize::Number(n) if n < short + stretches.len() => (share_out(n, &lengths), false),
        ElementSize::Number(n) => (share_out(n - short, &lengths), true),
        ElementSize::Length(h) => {
            let full = |length: &f64| (length / h * (1.0 - 1e-9)).ceil().max(1.0) as usize;
            (lengths.iter().map(full).collect(), true)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::definition::{MaterialId, Mesh, SectionId};
    use super::*;

    fn meshed(elements: usize, places: &[(f64, bool)]) -> Vec<Vec<f64>> {
        let beam = Beam {
            mesh: Mesh { hinges: true, ..Mesh::even(elements) },
            ..Beam::new("b", &[[0.0, 0.0], [2.0, 0.0]], elements, MaterialId(0), SectionId(0))
        };
        let line = CentreLine::new(&beam).unwrap();
        let place = |(s, hinge): &(f64, bool)| BeamPlace { s: *s, ends_span: false, hinge: *hinge };
        let places: Vec<BeamPlace> = places.iter().map(place).collect();
        spans(&beam, &line, &places, |_, _| Some(0.0))
            .0
            .into_iter()
            .map(|plan| plan.stations)
            .collect()
    }

    #[test]
    fn elements_next_to_hinges_are_a_tenth_of_the_mean() {
        let close = |found: &[Vec<f64>], expected: &[f64]| {
            assert_eq!(found.len(), 1);
            assert_eq!(found[0].len(), expected.len(), "{found:?}");
            let off = found[0].iter().zip(expected).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 1e-12, "{found:?}");
        };
        // Clamped at both ends, a force in the middle.
        let clamped = meshed(8, &[(0.0, true), (1.0, true), (2.0, true)]);
        close(&clamped, &[0.0, 0.025, 0.5, 0.975, 1.0, 1.025, 1.5, 1.975, 2.0]);
        // A roller at the end has no hinge.
        let propped = meshed(5, &[(0.0, true), (1.0, true), (2.0, false)]);
        close(&propped, &[0.0, 1.0 / 30.0, 1.0 - 1.0 / 30.0, 1.0, 1.05, 2.0]);
        // Too few for short ones: equal.
        close(&meshed(4, &[(0.0, true), (1.0, true), (2.0, true)]), &[0.0, 0.5, 1.0, 1.5, 2.0]);
        // Nothing inside, no moment at the ends.
        close(&meshed(4, &[]), &[0.0, 0.5, 1.0, 1.5, 2.0]);
    }
}
