//! Divides beams into spans and spans into elements.
//!
//! A span is a part of a beam without corners, of one material and one section: its nodes are consecutive and its strains are smooth. Where a span
//! ends inside a beam, two nodes coincide, connected rigidly; the stretch may jump there. Points of action have a node, and a span ends if the
//! axial force may jump there: the requested number of elements is the least.

use super::centre_line::{CentreLine, Piece};
use super::definition::{Beam, ElementSize, MaterialId, Mesh, SectionId};

/// A place along a beam.
#[derive(Clone, Copy, Debug)]
pub struct BeamPlace {
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Whether the axial force may jump there.
    pub ends_span: bool,
    /// Whether the bending moment may be largest there, so that a plastic hinge forms.
    pub hinge: bool,
}

/// A span to be meshed.
#[derive(Clone, Debug)]
pub struct SpanPlan {
    /// Number of its piece of the centre line.
    pub piece: usize,
    /// Arc length from the start of the piece to that of the span \[m\].
    pub offset: f64,
    /// Arc length from the start of the beam at the nodes, shape (nodes, at least 2) \[m\].
    pub stations: Vec<f64>,
    pub material: MaterialId,
    pub section: SectionId,
}

impl SpanPlan {
    /// Position and tangent of node `i`.
    pub fn node(&self, line: &CentreLine, i: usize) -> ([f64; 2], [f64; 2]) {
        self.at(line, self.stations[i])
    }

    /// Position and tangent at arc length `s` from the start of the beam.
    pub fn at(&self, line: &CentreLine, s: f64) -> ([f64; 2], [f64; 2]) {
        line.pieces[self.piece].at(self.offset + s - self.stations[0])
    }
}

/// Breaks closer than this share of the length are one.
pub(super) const SAME_PLACE: f64 = 1e-9;

/// A place is at a node if it is closer to it than this share of the element: a point is located there as well.
const AT_NODE: f64 = 1e-9;
/// Places closer to each other, or to the end of a part, than this share of an element share a node: a shorter element would lose more digits than
/// it gains.
pub(super) const SLIVER: f64 = 1e-3;
/// An element that is longer than requested by no more than this share is not divided.
const SLACK: f64 = 1e-6;

/// Spans of a checked beam along its centre line, with nodes at `places`, which are in their order along it.
pub fn spans(beam: &Beam, line: &CentreLine, places: &[BeamPlace]) -> Vec<SpanPlan> {
    let mut plans = parts_of(beam, line);
    divide(&beam.mesh, line, &mut plans);
    let grade = Grade::new(&beam.mesh, line);
    plans.into_iter().flat_map(|plan| with_places(plan, &grade, places)).collect()
}

/// A divided part with nodes at the places inside it, cut where spans end.
fn with_places(mut plan: SpanPlan, grade: &Grade, places: &[BeamPlace]) -> Vec<SpanPlan> {
    let breaks = breaks(&plan.stations, places);
    if breaks.is_empty() {
        return vec![plan];
    }
    if !breaks.iter().all(|place| plan.stations.contains(&place.s)) {
        plan.stations = redivided(&plan.stations, grade, &breaks);
    }
    cut(plan, &breaks)
}

/// A part with all its nodes, cut where spans end.
pub(super) fn cut(plan: SpanPlan, breaks: &[BeamPlace]) -> Vec<SpanPlan> {
    let mut out = Vec::new();
    let start = (plan.offset, plan.stations[0]);
    let mut rest = plan.stations.as_slice();
    for place in breaks.iter().filter(|place| place.ends_span) {
        let Some(i) = rest.iter().position(|s| *s == place.s) else { continue };
        out.push(SpanPlan { stations: rest[..=i].to_vec(), ..plan.clone() });
        rest = &rest[i..];
    }
    out.push(SpanPlan { stations: rest.to_vec(), ..plan.clone() });
    for plan in &mut out {
        plan.offset = start.0 + (plan.stations[0] - start.1);
    }
    out
}

/// The places of nodes inside a divided part, in their order: at its own nodes where these are close enough.
fn breaks(stations: &[f64], places: &[BeamPlace]) -> Vec<BeamPlace> {
    let (first, last) = (stations[0], stations[stations.len() - 1]);
    let inside = places.partition_point(|p| p.s <= first)..places.partition_point(|p| p.s < last);
    let mut kept: Vec<BeamPlace> = Vec::new();
    for mut place in places[inside].iter().copied() {
        let next = stations.partition_point(|s| *s <= place.s).clamp(1, stations.len() - 1);
        let (a, b) = (stations[next - 1], stations[next]);
        for station in [a, b] {
            if (place.s - station).abs() <= AT_NODE * (b - a) {
                place.s = station;
            }
        }
        let near = SLIVER * (b - a);
        if place.s - first <= near || last - place.s <= near {
            continue;
        }
        match kept.last_mut() {
            Some(before) if place.s == before.s => {
                before.ends_span |= place.ends_span;
                before.hinge |= place.hinge;
            }
            Some(before) if place.s - before.s <= near => {}
            _ => kept.push(place),
        }
    }
    kept
}

/// Stations of a part between its breaks, elements no longer than they were.
fn redivided(stations: &[f64], grade: &Grade, breaks: &[BeamPlace]) -> Vec<f64> {
    let (first, last) = (stations[0], stations[stations.len() - 1]);
    let one = grade.count(first, last) / (stations.len() - 1) as f64;
    let mut out = vec![first];
    let mut from = first;
    for to in breaks.iter().map(|place| place.s).chain([last]) {
        let weight = grade.count(from, to);
        let n = (weight / one - SLACK).ceil().max(1.0) as usize;
        for i in 1..n {
            let share = i as f64 / n as f64;
            out.push(grade.station(from, to, weight * share, share));
        }
        out.push(to);
        from = to;
    }
    out
}

/// Number of spans of a beam.
pub fn parts(beam: &Beam, line: &CentreLine) -> usize {
    parts_of(beam, line).len()
}

/// Spans with their ends as only stations.
pub(super) fn parts_of(beam: &Beam, line: &CentreLine) -> Vec<SpanPlan> {
    let slack = SAME_PLACE * line.length();
    let mut plans = Vec::new();
    let mut start = 0.0;
    // Changes are in their order along the beam.
    let mut changes = beam.changes.iter().map(|change| (line.arc(change.at), change)).peekable();
    let (mut material, mut section) = (beam.material, beam.section);
    for (index, piece) in line.pieces.iter().enumerate() {
        let end = start + piece.length();
        let mut from = start;
        loop {
            while let Some((_, change)) = changes.next_if(|(s, _)| *s <= from + slack) {
                material = change.material.unwrap_or(material);
                section = change.section.unwrap_or(section);
            }
            let to = changes.peek().map(|(s, _)| *s).filter(|s| *s < end - slack).unwrap_or(end);
            let (offset, stations) = (from - start, vec![from, to]);
            plans.push(SpanPlan { piece: index, offset, stations, material, section });
            if to == end {
                break;
            }
            from = to;
        }
        start = end;
    }
    plans
}

/// Sets the stations of all spans.
fn divide(mesh: &Mesh, line: &CentreLine, plans: &mut [SpanPlan]) {
    let grade = Grade::new(mesh, line);
    let weights: Vec<f64> =
        plans.iter().map(|p| grade.count(p.stations[0], p.stations[1])).collect();
    let numbers: Vec<usize> = match mesh.size {
        ElementSize::Number(n) => share_out(n, &weights),
        // Sum of the unit size, divided by the smallest required size.
        ElementSize::Length(h) => weights
            .iter()
            .map(|w| ((w / h * grade.smallest) * (1.0 - 1e-9)).ceil().max(1.0) as usize)
            .collect(),
    };
    for ((plan, n), weight) in plans.iter_mut().zip(numbers).zip(weights) {
        let (a, b) = (plan.stations[0], plan.stations[1]);
        plan.stations = (0..=n)
            .map(|i| match i {
                0 => a,
                _ if i == n => b,
                _ => grade.station(a, b, weight * i as f64 / n as f64, i as f64 / n as f64),
            })
            .collect();
    }
}

/// Shares of elements that differ by less are equal.
const EQUAL: f64 = 1e-9;

/// Shares `n` elements out among spans by weight, at least one each: largest remainders first, and equal ones together, so that equal spans have
/// equal numbers; the sum may be larger by that.
pub(super) fn share_out(n: usize, weights: &[f64]) -> Vec<usize> {
    let total: f64 = weights.iter().sum();
    let mut numbers: Vec<usize> =
        weights.iter().map(|w| ((w / total * n as f64 + EQUAL).floor() as usize).max(1)).collect();
    // Each lacks less than one, so that none is given two.
    let left = n.saturating_sub(numbers.iter().sum());
    let lack = |i: usize| weights[i] / total * n as f64 - numbers[i] as f64;
    let mut order: Vec<usize> = (0..weights.len()).rev().collect();
    order.sort_by(|a, b| lack(*b).total_cmp(&lack(*a)));
    let Some(least) = left.checked_sub(1).and_then(|last| order.get(last)).map(|i| lack(*i)) else {
        return numbers;
    };
    let more: Vec<usize> = order.into_iter().filter(|i| lack(*i) >= least - EQUAL).collect();
    more.into_iter().for_each(|i| numbers[i] += 1);
    numbers
}

/// Relative size of elements along a beam: `1 + slope |s - centre|`.
struct Grade {
    centre: f64,
    slope: f64,
    /// Sizes are relative to this one, `1 / ratio` of the largest.
    smallest: f64,
}

impl Grade {
    fn new(mesh: &Mesh, line: &CentreLine) -> Self {
        let Some(grading) = mesh.grading else {
            return Self { centre: 0.0, slope: 0.0, smallest: 1.0 };
        };
        let centre = line.arc(grading.towards);
        let reach = centre.max(line.length() - centre);
        let slope = (grading.ratio - 1.0) / reach;
        Self { centre, slope, smallest: grading.ratio }
    }

    /// Integral of the inverse size from the centre to `s`.
    fn primitive(&self, s: f64) -> f64 {
        let d = s - self.centre;
        if self.slope == 0.0 { d } else { (self.slope * d.abs()).ln_1p().copysign(d) / self.slope }
    }

    /// Number of elements of unit smallest size between two stations.
    fn count(&self, a: f64, b: f64) -> f64 {
        self.primitive(b) - self.primitive(a)
    }

    /// Station at which the count from `a` reaches `count`, at a `share` of the length if uniform.
    fn station(&self, a: f64, b: f64, count: f64, share: f64) -> f64 {
        if self.slope == 0.0 {
            return a + share * (b - a);
        }
        let target = self.primitive(a) + count;
        let d = ((self.slope * target.abs()).exp_m1() / self.slope).copysign(target);
        self.centre + d
    }
}

/// Whether a piece is straight, so that equal elements share one table.
pub fn is_straight(piece: &Piece) -> bool {
    matches!(piece, Piece::Straight { .. })
}

#[cfg(test)]
mod tests {
    use super::super::definition::{Along, Grading};
    use super::*;

    fn beam(mesh: Mesh) -> Beam {
        let points = [[0.0, 0.0], [0.0, 2.0], [4.0, 2.0]];
        Beam { mesh, ..Beam::new("b", &points, 6, MaterialId(0), SectionId(0)) }
    }

    fn stations(mesh: Mesh) -> Vec<Vec<f64>> {
        let beam = beam(mesh);
        let line = CentreLine::new(&beam).unwrap();
        spans(&beam, &line, &[]).into_iter().map(|p| p.stations).collect()
    }

    #[test]
    fn nodes_stand_where_something_acts_and_spans_end_where_the_axial_force_jumps() {
        let beam = Beam::new("b", &[[0.0, 0.0], [1.0, 0.0]], 4, MaterialId(0), SectionId(0));
        let line = CentreLine::new(&beam).unwrap();
        let meshed = |places: &[(f64, bool)]| {
            let places: Vec<BeamPlace> = places
                .iter()
                .map(|(s, ends_span)| BeamPlace { s: *s, ends_span: *ends_span, hinge: false })
                .collect();
            spans(&beam, &line, &places)
        };
        let stations = |places: &[(f64, bool)]| -> Vec<Vec<f64>> {
            meshed(places).into_iter().map(|p| p.stations).collect()
        };
        let plain = vec![0.0, 0.25, 0.5, 0.75, 1.0];
        // At nodes, nearly at nodes, at the ends, and just beside an end: the mesh does not change.
        for s in [0.25, 0.25 + 1e-11, 0.0, 1.0, 1e-5] {
            assert_eq!(stations(&[(s, false)]), std::slice::from_ref(&plain), "{s}");
        }
        assert_eq!(stations(&[(0.5, true)]), [plain[..3].to_vec(), plain[2..].to_vec()]);
        let found = stations(&[(0.4, true), (0.4 + 1e-13, false), (0.9, false)]);
        let lengths = |s: &[f64]| s.windows(2).map(|w| w[1] - w[0]).collect::<Vec<_>>();
        assert_eq!(found.len(), 2);
        assert_eq!(found[0], [0.0, 0.2, 0.4]);
        assert!(found[1].contains(&0.9) && found[1].first() == Some(&0.4));
        assert!(lengths(&found[1]).iter().all(|l| *l <= 0.25 + 1e-6), "{found:?}");
        // Start of the second on the line.
        let plans = meshed(&[(0.4, true)]);
        assert_eq!(plans[1].node(&line, 0).0, [0.4, 0.0]);
    }

    #[test]
    fn elements_are_shared_out_by_length() {
        assert_eq!(stations(Mesh::even(6)), [vec![0.0, 1.0, 2.0], vec![2.0, 3.0, 4.0, 5.0, 6.0]]);
        let by_length = Mesh { size: ElementSize::Length(1.1), ..Mesh::even(1) };
        assert_eq!(stations(by_length).iter().map(Vec::len).collect::<Vec<_>>(), [3, 5]);
    }

    /// Of three parts of lengths 3, 4 and 3 with five elements the first and the last have as many: 1.5 each are rounded alike.
    #[test]
    fn equal_parts_have_equal_numbers_of_elements() {
        assert_eq!(share_out(5, &[3.0, 4.0, 3.0]), [2, 2, 2]);
        assert_eq!(share_out(6, &[3.0, 4.0, 3.0]), [2, 2, 2]);
        assert_eq!(share_out(15, &[3.0, 4.0, 3.0 + 1e-12]), [5, 6, 5]);
        for n in 1..60 {
            let found = share_out(n, &[2.0, 0.7, 5.0, 0.7, 2.0 - 1e-13]);
            assert_eq!((found[0], found[1]), (found[4], found[3]), "{n}");
            let all = found.iter().sum::<usize>();
            // At 48 the remainders of both pairs are equal.
            assert!((n..=n + 3).contains(&all) || n < 5, "{n}: {found:?}");
        }
    }

    #[test]
    fn graded_elements_are_smallest_where_asked() {
        let grading = Some(Grading { towards: Along::Fraction(1.0), ratio: 4.0 });
        let found = stations(Mesh { grading, ..Mesh::even(20) });
        let all: Vec<f64> = found.iter().flat_map(|s| s.windows(2).map(|w| w[1] - w[0])).collect();
        assert_eq!(all.len(), 20);
        assert!((all[0] / all[19] - 4.0).abs() < 0.6, "{all:?}");
        let size = Mesh { size: ElementSize::Length(0.1), grading, hinges: false };
        let last = stations(size);
        let end = last[1].windows(2).last().map(|w| w[1] - w[0]).unwrap();
        assert!(end <= 0.028 && end > 0.02, "{end}");
    }
}
