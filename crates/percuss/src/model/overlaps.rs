//! Initial interpenetration: bodies that overlap or cross at the start of a run.

use super::Model;
use super::fault::Fault;
use super::frozen::ContactData;
use crate::geometry::axis::AxisElement;
use crate::geometry::configuration::Configuration;
use crate::geometry::pair::{Carrier, Memory, Pair, Target};
use crate::geometry::placed::Placed;
use crate::geometry::touch::{SearchRegion, Touch};
use crate::math::vec2::{add, cross, norm, rot90, scale, sub};

/// Penetrations at the start below this share of the bodies' size are round-off.
const TOUCHING: f64 = 1e-9;
/// Share of the largest deviation of elements from their curve that its three values a piece may leave unknown: less than that for arcs
/// of half a radian an element, and for splines.
const UNKNOWN: f64 = 0.02;
/// Number of straight lines that represent an element.
const CHORDS: usize = 8;
/// Number of points of an element in the search for the one closest to a point of its curve, and bisections between two.
const PLACES: usize = 16;
const HALVINGS: usize = 40;

impl Model {
    /// A fault for each contact `of` those with overlapping partners in a configuration: depth, place, and remedy.
    pub(crate) fn overlaps(
        &self,
        displacement: &[[f64; 4]],
        of: impl Fn(&ContactData) -> bool,
    ) -> Vec<Fault> {
        let at = Configuration::of(displacement);
        let mut faults = Vec::new();
        for contact in self.contacts.iter().filter(|c| of(c)) {
            let depth = |pair: &Pair| {
                let touch = pair.touch(self, &at, &Memory::default(), SearchRegion::All)?;
                self.is_inside(pair, &touch, &at).then_some((touch, pair.source_partner))
            };
            let worst = self.pairs[contact.pairs.clone()].iter().filter_map(depth);
            let worst = worst.min_by(|a, b| a.0.gap.total_cmp(&b.0.gap));
            if let Some((touch, partner)) = worst.or_else(|| self.crossing(contact, &at)) {
                faults.push(overlap(contact, &touch, partner));
            }
        }
        faults
    }

    /// Penetration through a beam between its contact points: the end with the least depth, as a contact from the other side, and its partner.
    fn crossing(&self, contact: &ContactData, at: &Configuration) -> Option<(Touch, usize)> {
        let pairs = &self.pairs[contact.pairs.clone()];
        let mut polyline: Option<(usize, Vec<[f64; 2]>)> = None;
        let mut last: Option<&Target> = None;
        let crosses = pairs.iter().any(|pair| {
            let beam = pair.movers[0];
            if beam >= self.beams.len() || last == Some(&pair.target) {
                return false;
            }
            last = Some(&pair.target);
            let other = match (pair.target.wall(), pair.target.beam()) {
                (Some(ends), _) => ends.map(|end| end.place(at)).to_vec(),
                (None, Some(onto)) if onto != beam => self.polyline(onto, at),
                _ => return false,
            };
            if polyline.as_ref().is_none_or(|(of, _)| *of != beam) {
                polyline = Some((beam, self.polyline(beam, at)));
            }
            polyline.as_ref().is_some_and(|(_, own)| cross_each_other(own, &other))
        });
        if !crosses {
            return None;
        }
        let through = |pair: &Pair| {
            let end = match &pair.source.carrier {
                Carrier::Body { .. } => true,
                Carrier::Beam { .. } => pair.at_end,
            };
            let touch =
                pair.touch(self, at, &Memory::default(), SearchRegion::All).filter(|_| end)?;
            let depth = touch.gap + 2.0 * pair.thickness(self, &touch.memory);
            let back = Touch { gap: -depth, normal: scale(-1.0, touch.normal), ..touch };
            depth.is_finite().then_some((back, pair.source_partner))
        };
        pairs.iter().filter_map(through).max_by(|a, b| a.0.gap.total_cmp(&b.0.gap))
    }

    /// Places along the axis of a beam.
    fn polyline(&self, beam: usize, at: &Configuration) -> Vec<[f64; 2]> {
        let axis = &self.beams[beam].axis;
        let along = axis.iter().flat_map(|element| {
            let placed = Placed::new(element, &self.nodes, at);
            (0..=CHORDS).map(move |k| placed.position(k as f64 / CHORDS as f64))
        });
        along.collect()
    }

    /// Whether the closest points of a pair overlap by more than round-off and more than the distance of elements from the given curves: a body
    /// that touches such a curve is in contact on any side of the element.
    fn is_inside(&self, pair: &Pair, touch: &Touch, at: &Configuration) -> bool {
        let touching = TOUCHING * self.scale_of(pair);
        if touch.gap >= -touching {
            return false;
        }
        let beside = self.source_deviation(pair, at);
        let most = norm(beside) + self.largest_deviation(&pair.target);
        if touch.gap < -(touching + most * (1.0 + UNKNOWN)) {
            return true;
        }
        let y = add(pair.source.place(at), beside);
        let gap = match &pair.target {
            Target::Axis { beam, skip, .. } => {
                let kept = |k: &usize| !(skip[0]..skip[1]).contains(k);
                let elements = &self.beams[*beam].axis;
                let near = (0..elements.len()).filter(kept);
                let away = near.map(|k| self.away_from_curve(&elements[k], y, at));
                away.fold(f64::INFINITY, f64::min) - pair.reach
            }
            _ => touch.gap + beside[0] * touch.normal[0] + beside[1] * touch.normal[1],
        };
        gap < -(touching + most * UNKNOWN)
    }

    /// From the place of a source to where the curve of its beam would have it, shape (2) \[m\].
    fn source_deviation(&self, pair: &Pair, at: &Configuration) -> [f64; 2] {
        let Some(beam) = self.beams.get(pair.movers[0]).filter(|_| !pair.s.is_nan()) else {
            return [0.0; 2];
        };
        let next = beam.axis.partition_point(|e| e.s <= pair.s).max(1);
        let element = &beam.axis[next - 1];
        let xi = ((pair.s - element.s) / element.length).clamp(0.0, 1.0);
        beside(element, &Placed::new(element, &self.nodes, at), xi)
    }

    fn largest_deviation(&self, target: &Target) -> f64 {
        let Some(beam) = target.beam() else { return 0.0 };
        let each = self.beams[beam].axis.iter().map(AxisElement::largest_deviation);
        each.fold(0.0, f64::max)
    }

    /// Least distance of a place from the face of the original curve of an element, within its extent \[m\].
    fn away_from_curve(&self, element: &AxisElement, y: [f64; 2], at: &Configuration) -> f64 {
        let placed = Placed::new(element, &self.nodes, at);
        let away = |xi: f64| {
            let place = add(placed.position(xi), beside(element, &placed, xi));
            norm(sub(y, place)) - element.half_depth(xi)
        };
        let share = |k: usize| k as f64 / PLACES as f64;
        let least = (0..=PLACES).min_by(|a, b| away(share(*a)).total_cmp(&away(share(*b))));
        let best = least.unwrap_or(0);
        let (mut xi, mut step) = (share(best), share(1));
        for _ in 0..HALVINGS {
            step *= 0.5;
            for other in [xi - step, xi + step].map(|x| x.clamp(0.0, 1.0)) {
                if away(other) < away(xi) {
                    xi = other;
                }
            }
        }
        away(xi)
    }

    fn scale_of(&self, pair: &Pair) -> f64 {
        match pair.target.beam() {
            Some(beam) => self.beams[beam].length.max(pair.reach),
            None if pair.target.is_guided() => f64::INFINITY, // its standoff is checked separately
            None => pair.reach.max(1e-3),
        }
    }
}

/// Vector from a point of an element to the original curve, shape (2) \[m\].
fn beside(element: &AxisElement, placed: &Placed, xi: f64) -> [f64; 2] {
    let deviation = element.deviation(xi);
    if deviation == 0.0 {
        return [0.0; 2];
    }
    let tangent = placed.tangent(xi);
    scale(deviation / norm(tangent), rot90(tangent))
}

/// Whether two polylines cross: their halves are tested only if the boxes around them intersect.
fn cross_each_other(one: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let (one, other) = (Boxed::new(one), Boxed::new(other));
    let mut left = vec![(1, 1)];
    while let Some((a, b)) = left.pop() {
        if !meet(&one.boxes[a], &other.boxes[b]) {
            continue;
        }
        match (one.halves(a), other.halves(b)) {
            (None, None) if segments_cross(one.pieces(a), other.pieces(b)) => return true,
            (None, None) => {}
            (None, Some([c, d])) => left.extend([(a, c), (a, d)]),
            (Some([c, d]), None) => left.extend([(c, b), (d, b)]),
            (Some(x), Some(y)) => left.extend(x.into_iter().flat_map(|c| y.map(|d| (c, d)))),
        }
    }
    false
}

/// Whether a piece of one polyline crosses one of another.
fn segments_cross(one: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let apart = |a: [f64; 2], b: [f64; 2], line: &[[f64; 2]]| {
        let side = |p: [f64; 2]| cross(sub(b, a), sub(p, a));
        side(line[0]) * side(line[1]) >= 0.0
    };
    one.windows(2).any(|a| other.windows(2).any(|b| !apart(a[0], a[1], b) && !apart(b[0], b[1], a)))
}

/// A box: its least and largest coordinates, shape (2, 2) \[m\].
type Box2 = [[f64; 2]; 2];

/// Pieces of a polyline in a leaf.
const LEAF: usize = 8;

/// A polyline with the boxes around its halves, their halves, and so on, as a heap: that of number k has those of 2 k and 2 k + 1.
struct Boxed<'a> {
    /// Its points, shape (points, 2) \[m\].
    points: &'a [[f64; 2]],
    /// Leaves, a power of two.
    leaves: usize,
    /// The boxes, from number 1 on, shape (2 leaves, 2, 2) \[m\].
    boxes: Vec<Box2>,
}

impl<'a> Boxed<'a> {
    fn new(points: &'a [[f64; 2]]) -> Self {
        let leaves = points.len().saturating_sub(1).div_ceil(LEAF).next_power_of_two();
        let boxes = vec![[[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]; 2 * leaves];
        let mut own = Self { points, leaves, boxes };
        for k in (1..2 * leaves).rev() {
            own.boxes[k] = match own.halves(k) {
                Some([a, b]) => around(own.boxes[a], own.boxes[b]),
                None => own.pieces(k).iter().map(|p| [*p, *p]).fold(own.boxes[k], around),
            };
        }
        own
    }

    fn halves(&self, k: usize) -> Option<[usize; 2]> {
        (k < self.leaves).then_some([2 * k, 2 * k + 1])
    }

    /// Points of a leaf, the first one of the next included.
    fn pieces(&self, k: usize) -> &'a [[f64; 2]] {
        let first = (LEAF * (k - self.leaves)).min(self.points.len());
        &self.points[first..(first + LEAF + 1).min(self.points.len())]
    }
}

/// The box around two.
fn around(a: Box2, b: Box2) -> Box2 {
    let both = |k: usize, pick: fn(f64, f64) -> f64| [0, 1].map(|i| pick(a[k][i], b[k][i]));
    [both(0, f64::min), both(1, f64::max)]
}

/// Whether two boxes have a point in common.
fn meet(a: &Box2, b: &Box2) -> bool {
    (0..2).all(|i| a[0][i] <= b[1][i] && b[0][i] <= a[1][i])
}

/// A length by seven significant digits \[m\].
fn legible(x: f64) -> String {
    let decimals = if x == 0.0 { 0.0 } else { 6.0 - x.abs().log10().floor() };
    let text = format!("{x:.*}", decimals.clamp(1.0, 15.0) as usize);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn overlap(contact: &ContactData, touch: &Touch, partner: usize) -> Fault {
    let depth = -touch.gap;
    let [x, y] = touch.closest_place.map(legible);
    // Slightly more than necessary, so that rounding leaves no overlap.
    let shift = scale(depth * (1.0 + 1e-6), touch.normal).map(|x| legible(x + 0.0));
    let (inside, of) = (&contact.between[partner], &contact.between[1 - partner]);
    let found = format!("`{inside}` starts {} m inside `{of}`, at [{x}, {y}]", legible(depth));
    let expected = format!(
        "a start without penetration: move `{inside}` by [{}, {}] m, or `{of}` the other way",
        shift[0], shift[1]
    );
    Fault::new(format!("contact.{}.between", contact.name), found, expected)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compared with every piece of one against every piece of the other; lines of few and of many leaves, that cross, touch only with their boxes,
    /// or are apart.
    #[test]
    fn boxes_hide_no_crossing() {
        let wave = |count: usize, shift: f64| -> Vec<[f64; 2]> {
            let place = |i: usize| {
                let x = i as f64 / count as f64;
                [x + 0.1 * (37.0 * x).sin(), (9.0 * x + shift).sin() + shift]
            };
            (0..=count).map(place).collect()
        };
        let mut found = [0; 2];
        for (n, m) in [(1, 1), (1, 40), (7, 8), (9, 130), (257, 300)] {
            for k in 0..25 {
                let (one, other) = (wave(n, 0.0), wave(m, 0.15 * f64::from(k)));
                let expected = segments_cross(&one, &other);
                assert_eq!(cross_each_other(&one, &other), expected, "{n} {m} {k}");
                found[usize::from(expected)] += 1;
            }
        }
        assert!(found.iter().all(|count| *count > 20), "{found:?}");
    }
}
