//! Divides beams into spans and spans into elements.
//!
//! A span is a part of a beam without corner, of one material and one section: its nodes follow each other and its
//! strains are smooth. Where a span ends inside a beam, two nodes stand at the same place, joined rigidly; the
//! stretch may jump there.

use super::centre_line::{CentreLine, Piece};
use super::definition::{Beam, ElementSize, MaterialId, Mesh, SectionId};

/// A span to be meshed.
#[derive(Clone, Debug)]
pub struct SpanPlan {
    /// Number of its piece of the centre line.
    pub piece: usize,
    /// Arc length from the start of the piece to that of the span \[m\].
    pub offset: f64,
    /// Arc length from the start of the beam at the nodes \[m\]; at least two.
    pub stations: Vec<f64>,
    pub material: MaterialId,
    pub section: SectionId,
}

impl SpanPlan {
    /// Position and tangent of node `i`.
    pub fn node(&self, line: &CentreLine, i: usize) -> ([f64; 2], [f64; 2]) {
        line.pieces[self.piece].at(self.offset + self.stations[i] - self.stations[0])
    }
}

/// Breaks closer than this share of the length are one.
const SAME_PLACE: f64 = 1e-9;

/// Spans of a checked beam along its centre line.
pub fn spans(beam: &Beam, line: &CentreLine) -> Vec<SpanPlan> {
    let mut plans = parts_of(beam, line);
    divide(&beam.mesh, line, &mut plans);
    plans
}

/// Number of spans of a beam.
pub fn parts(beam: &Beam, line: &CentreLine) -> usize {
    parts_of(beam, line).len()
}

/// Spans with their ends as only stations.
fn parts_of(beam: &Beam, line: &CentreLine) -> Vec<SpanPlan> {
    let length = line.length();
    let mut plans = Vec::new();
    let mut start = 0.0;
    for (index, piece) in line.pieces.iter().enumerate() {
        let end = start + piece.length();
        let slack = SAME_PLACE * length;
        let inside = beam.changes.iter().map(|c| line.arc(c.at));
        let mut ends: Vec<f64> =
            inside.filter(|s| *s > start + slack && *s < end - slack).collect();
        ends.push(end);
        let mut from = start;
        for to in ends {
            let before = beam.changes.iter().filter(|c| line.arc(c.at) <= from + slack);
            let (mut material, mut section) = (beam.material, beam.section);
            for change in before {
                material = change.material.unwrap_or(material);
                section = change.section.unwrap_or(section);
            }
            let (offset, stations) = (from - start, vec![from, to]);
            plans.push(SpanPlan { piece: index, offset, stations, material, section });
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
        // The count of a unit size, over the smallest size wanted.
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

/// Shares `n` elements out among spans by weight, at least one each: largest remainders first.
fn share_out(n: usize, weights: &[f64]) -> Vec<usize> {
    let total: f64 = weights.iter().sum();
    let mut numbers: Vec<usize> =
        weights.iter().map(|w| ((w / total * n as f64 + 1e-9).floor() as usize).max(1)).collect();
    while numbers.iter().sum::<usize>() < n {
        let lack = |i: &usize| weights[*i] / total * n as f64 - numbers[*i] as f64;
        let most = (0..weights.len()).max_by(|a, b| lack(a).total_cmp(&lack(b)));
        let Some(most) = most else { break };
        numbers[most] += 1;
    }
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

    /// Station at which the count from `a` reaches `count`, a `share` of the way if even.
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
        spans(&beam, &line).into_iter().map(|p| p.stations).collect()
    }

    #[test]
    fn elements_are_shared_out_by_length() {
        assert_eq!(stations(Mesh::even(6)), [vec![0.0, 1.0, 2.0], vec![2.0, 3.0, 4.0, 5.0, 6.0]]);
        let by_length = Mesh { size: ElementSize::Length(1.1), grading: None };
        assert_eq!(stations(by_length).iter().map(Vec::len).collect::<Vec<_>>(), [3, 5]);
    }

    #[test]
    fn graded_elements_are_smallest_where_asked() {
        let grading = Some(Grading { towards: Along::Fraction(1.0), ratio: 4.0 });
        let found = stations(Mesh { size: ElementSize::Number(20), grading });
        let all: Vec<f64> = found.iter().flat_map(|s| s.windows(2).map(|w| w[1] - w[0])).collect();
        assert_eq!(all.len(), 20);
        assert!((all[0] / all[19] - 4.0).abs() < 0.6, "{all:?}");
        let size = Mesh { size: ElementSize::Length(0.1), grading };
        let last = stations(size);
        let end = last[1].windows(2).last().map(|w| w[1] - w[0]).unwrap();
        assert!(end <= 0.028 && end > 0.02, "{end}");
    }
}
