//! The axis of a beam for contact: a row of elements, and the closest point on them.

#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use super::configuration::Configuration;
pub use super::placed::AxisElement;
use super::placed::{ElementEnds, Placed};
use crate::element::beam::NodeFrame;
use crate::math::vec2::{add, cross, dot, norm, scale, sub};

/// Distances that differ by less than this share are the same.
const SAME: f64 = 1e-14;

/// Share of its length up to which each end of a beam is rounded: the rest has to be an axis.
pub const LONGEST_CAP: f64 = 0.499;
/// Ends closer to a node than this share of an element are at the node.
const AT_NODE: f64 = 1e-9;
/// Limit of the taper for the inclination of an end.
const STEEPEST: f64 = 0.9;

/// The elements of a beam's axis.
#[derive(Clone, Debug)]
pub struct AxisElements {
    /// The elements, in their order along the beam, shape (elements of the beam).
    list: Vec<AxisElement>,
    /// Length of the longest \[m\].
    pub longest: f64,
    /// Largest half depth \[m\].
    pub deepest: f64,
    /// Elements before the first of these, and from the second on, are within half a depth of an end, shape (2)
    /// \[index of an element of the beam\].
    near_ends: [usize; 2],
}

fn near_ends(list: &[AxisElement]) -> [usize; 2] {
    let (Some(first), Some(last)) = (list.first(), list.last()) else { return [0; 2] };
    let [from, to] = [first.half_depths[0], last.half_depths[1]];
    let length = last.s + last.length;
    let until = if from > 0.0 { list.partition_point(|e| e.s < from) } else { 0 };
    let since = |e: &AxisElement| e.s + e.length <= length - to;
    [until, if to > 0.0 { list.partition_point(since) } else { list.len() }]
}

impl AxisElements {
    /// Of a list in order.
    pub fn new(list: Vec<AxisElement>) -> Self {
        let most = |of: fn(&AxisElement) -> f64| list.iter().map(of).fold(0.0, f64::max);
        Self {
            longest: most(|e| e.length),
            deepest: most(|e| e.half_depths[0].max(e.half_depths[1])),
            near_ends: near_ends(&list),
            list,
        }
    }

    /// Numbers of the elements of which parts are no farther from an end than half the depth there.
    pub fn at_ends(&self) -> impl Iterator<Item = usize> {
        let [first, last] = self.near_ends;
        (0..first).chain(last.max(first)..self.list.len())
    }

    /// Both ends, with corners rounded by these radii, at most half a depth; they are within the length of the beam.
    pub fn ends(&self, roundings: [f64; 2]) -> [AxisEnd; 2] {
        [0, 1].map(|which| self.end(which == 1, roundings[which]))
    }

    fn end(&self, last: bool, rounding: f64) -> AxisEnd {
        let length = self.list.last().map_or(0.0, |e| e.s + e.length);
        let away = rounding.min(LONGEST_CAP * length);
        let s = if last { length - away } else { away };
        let count = self.list.len();
        let mut k = self.list.partition_point(|e| e.s + e.length <= s).min(count.max(1) - 1);
        let Some(element) = self.list.get(k) else { return AxisEnd::default() };
        let mut xi = ((s - element.s) / element.length).clamp(0.0, 1.0);
        if (xi - xi.round()).abs() < AT_NODE {
            xi = xi.round();
            // An end at a node is that of the element within.
            if last && xi == 0.0 && k > 0 {
                (k, xi) = (k - 1, 1.0);
            } else if !last && xi == 1.0 && k + 1 < count {
                (k, xi) = (k + 1, 0.0);
            }
        }
        let element = &self.list[k];
        let [a, b] = element.half_depths;
        let out = if last { 1.0 } else { -1.0 };
        let half_depth = element.half_depth(xi);
        let inner = half_depth - away.min(half_depth);
        let lean = (out * (b - a) / element.length).clamp(-STEEPEST, STEEPEST);
        // The faces of a tapered end are inclined, so they meet the edge farther out than a circle about the axis extends.
        let half_width = inner / (1.0 - lean * lean).sqrt();
        let point = AxisPoint { element: k, xi };
        AxisEnd { point, s, out, half_width, rounding: half_depth - inner, lean }
    }
}

impl Default for AxisEnd {
    fn default() -> Self {
        let point = AxisPoint::default();
        Self { point, s: 0.0, out: 1.0, half_width: 0.0, rounding: 0.0, lean: 0.0 }
    }
}

impl std::ops::Deref for AxisElements {
    type Target = [AxisElement];

    fn deref(&self) -> &[AxisElement] {
        &self.list
    }
}

/// A point of an axis: the number of its element and the share of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AxisPoint {
    /// Number of the element in the beam.
    pub element: usize,
    /// Share of the element, from 0 to 1.
    pub xi: f64,
}

/// End of an axis for contact, and the closure of the outline there.
///
/// The end of the beam beyond the section at `point`: a straight edge across, with corners rounded by arcs of a circle. The edge of their centres
/// has half a width of `half_width` about the axis; the outline is `rounding` away from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisEnd {
    /// The last point of the axis.
    pub point: AxisPoint,
    /// Its arc length from the start of the beam \[m\].
    pub s: f64,
    /// Sign of the outward direction along its axis.
    pub out: f64,
    /// Half the width of the edge \[m\].
    pub half_width: f64,
    /// Radius of the corners \[m\].
    pub rounding: f64,
    /// Growth of the half depth per length towards the end.
    pub lean: f64,
}

/// A point of an axis and its element, in the current configuration.
#[derive(Clone, Copy)]
pub struct ClosestPoint {
    /// The point.
    pub point: AxisPoint,
    /// Its element.
    pub placed: Placed,
}

/// The point of an axis that is nearest of all.
#[derive(Clone, Copy)]
pub struct Nearest {
    /// The point.
    pub closest: ClosestPoint,
    /// The closest point in the neighbourhood of the guess, if another one is closer: the closest point jumps between two arms of a beam.
    pub leapt_from: Option<AxisPoint>,
}

/// The axis of a beam in a configuration.
#[derive(Clone, Copy)]
pub struct Axis<'a> {
    /// Frames of all nodes in the reference configuration, shape (nodes).
    pub nodes: &'a [NodeFrame],
    pub elements: &'a AxisElements,
    /// Omitted elements, for a beam against itself: the first of them, and the first after them, shape (2) \[index of an element of the beam\].
    pub skip: [usize; 2],
    /// Its start and end, shape (2).
    pub ends: &'a [AxisEnd; 2],
    /// Length that none of the elements exceeds \[m\].
    pub arc: f64,
    /// Whether the beam has parted from a node to the next one, shape (beam nodes); empty while none has.
    pub parted: &'a [bool],
}

/// A bound of the length of a beam's longest element.
pub fn longest_arc(elements: &[AxisElement], nodes: &[NodeFrame], at: &Configuration) -> f64 {
    let squared = |e| ElementEnds::new(e, nodes, at).longest_squared();
    elements.iter().map(squared).fold(0.0, |most, x| if x > most { x } else { most }).sqrt()
}

impl Axis<'_> {
    /// Whether an element has parted: the outline has a gap there.
    pub fn is_parted(&self, k: usize) -> bool {
        self.parted.get(self.elements[k].node).is_some_and(|parted| *parted)
    }

    fn is_skipped(&self, k: usize) -> bool {
        self.skip[0] <= k && k < self.skip[1]
    }

    fn is_beyond_ends(&self, k: usize) -> bool {
        let [first, last] = self.ends;
        k < first.point.element || k > last.point.element
    }

    fn left_out(&self, k: usize) -> bool {
        self.is_skipped(k) || self.is_beyond_ends(k) || self.is_parted(k)
    }

    /// Shares of an element between which it is part of the axis.
    fn limits(&self, k: usize) -> [f64; 2] {
        let [first, last] = self.ends.each_ref().map(|end| end.point);
        let low = if k == first.element { first.xi } else { 0.0 };
        [low, if k == last.element { last.xi } else { 1.0 }]
    }

    /// The element at an end of the axis, in the current configuration.
    pub fn placed_end(&self, end: &AxisEnd, at: &Configuration) -> Placed {
        self.placed(end.point.element, at)
    }

    fn placed(&self, k: usize, at: &Configuration) -> Placed {
        Placed::new(&self.elements[k], self.nodes, at)
    }

    /// The closest point to `y` of all; `None` if all elements are omitted. The search starts near `guess`.
    pub fn nearest(
        &self,
        y: [f64; 2],
        at: &Configuration,
        guess: AxisPoint,
        side: f64,
    ) -> Option<Nearest> {
        let mut best = (f64::INFINITY, None);
        if guess.element < self.elements.len() && !self.left_out(guess.element) {
            let near = self.near(y, at, guess, side);
            best = (near.placed.away(y, near.point.xi), Some(near));
        }
        let local = best.1;
        let found = local.map(|closest| closest.point.element);
        let mut leaps = false;
        let mut next = self.ends[0].point.element;
        while next <= self.ends[1].point.element {
            let k = next;
            next += 1;
            if self.left_out(k) {
                next = if self.is_skipped(k) { self.skip[1] } else { next };
                continue;
            }
            let element = &self.elements[k];
            let ends = ElementEnds::new(element, self.nodes, at);
            let within = best.0 + self.elements.deepest;
            let squared = ends.least_distance_squared(y);
            if within < 0.0 || squared > within * within {
                // The distance to the following elements decreases at most by the length of the axis.
                next += ((squared.sqrt() - within) / self.arc) as usize;
                continue;
            }
            if Some(k) == found && ends.has_one_closest_point(within) {
                continue;
            }
            let placed = Placed::between(element, &ends);
            let xi = placed.nearest(&ends, y, side, self.limits(k));
            let away = placed.away(y, xi);
            // Of two equally close points, the first one: at a node both elements give the same.
            if away + SAME * norm(sub(placed.position(xi), y)) < best.0 {
                best = (away, Some(ClosestPoint { point: AxisPoint { element: k, xi }, placed }));
                leaps = true;
            }
        }
        if !leaps {
            return local.map(|closest| Nearest { closest, leapt_from: None });
        }
        // The closest point that the next search in its neighbourhood will find.
        let closest = best.1.map(|closest| self.near(y, at, closest.point, side))?;
        Some(Nearest { closest, leapt_from: local.map(|closest| closest.point) })
    }

    /// Whether another point is closer to `y` than `closest`.
    pub fn has_nearer(
        &self,
        y: [f64; 2],
        at: &Configuration,
        closest: AxisPoint,
        side: f64,
    ) -> bool {
        let Some(found) = self.nearest(y, at, closest, side) else { return false };
        let nearest = found.closest.placed.away(y, found.closest.point.xi);
        let placed = self.placed(closest.element, at);
        nearest + SAME * norm(sub(placed.position(closest.xi), y)) < placed.away(y, closest.xi)
    }

    /// The point nearest to `y` in the neighbourhood of another one: downhill along the axis.
    pub fn near(
        &self,
        y: [f64; 2],
        at: &Configuration,
        from: AxisPoint,
        side: f64,
    ) -> ClosestPoint {
        let [first, last] = self.ends.each_ref().map(|end| end.point.element);
        let (mut element, mut guess, mut way) = (from.element.clamp(first, last), from.xi, 0_i8);
        loop {
            let placed = self.placed(element, at);
            let xi = placed.descend(y, guess, side, self.limits(element));
            let here = ClosestPoint { point: AxisPoint { element, xi }, placed };
            let slope = |placed: &Placed, xi: f64| placed.slope_at(y, xi, side);
            let (next, start) = if xi == 1.0 && way >= 0 && slope(&placed, xi) < 0.0 {
                way = 1;
                (element + 1, 0.0)
            } else if xi == 0.0 && way <= 0 && slope(&placed, xi) > 0.0 {
                way = -1;
                (element.wrapping_sub(1), 1.0)
            } else {
                return here;
            };
            if next >= self.elements.len() || self.left_out(next) {
                return here;
            }
            // At a corner the next element may lead away again: then the corner is nearest.
            let ahead = slope(&self.placed(next, at), start);
            if ahead * f64::from(way) >= 0.0 {
                return here;
            }
            (element, guess) = (next, start);
        }
    }

    /// Whether a point is where the elements left out begin, which is no end.
    pub fn is_border(&self, point: AxisPoint) -> bool {
        let k = point.element;
        let hidden = |k: usize| self.is_skipped(k) || self.is_beyond_ends(k);
        (point.xi == 1.0 && k + 1 < self.elements.len() && hidden(k + 1))
            || (point.xi == 0.0 && k > 0 && hidden(k - 1))
    }

    /// The end of the axis that the place at arc length `s` is no farther from than half its width.
    pub fn end_near(&self, s: f64) -> Option<&AxisEnd> {
        let [first, last] = self.ends;
        let away = [s - first.s, last.s - s];
        let (end, away) = if away[0] < away[1] { (first, away[0]) } else { (last, away[1]) };
        (away <= end.half_width).then_some(end)
    }

    /// Sign of the side of `y`, relative to the axis at its closest point; zero beyond an end.
    pub fn side(&self, y: [f64; 2], at: &Configuration, point: AxisPoint) -> f64 {
        let placed = self.placed(point.element, at);
        self.side_of(sub(y, placed.position(point.xi)), &placed, at, point)
    }

    /// The same for a place at a distance from its closest point, whose element is given.
    pub fn side_of(
        &self,
        away: [f64; 2],
        placed: &Placed,
        at: &Configuration,
        point: AxisPoint,
    ) -> f64 {
        // An end is a section.
        let outward = dot(away, placed.section(point.xi));
        if self.ends.iter().any(|end| end.point == point && end.out * outward > 0.0) {
            return 0.0;
        }
        let tangent = placed.tangent(point.xi);
        let onward = dot(away, tangent);
        let neighbour = if point.xi == 1.0 && onward > 0.0 {
            (point.element + 1, 0.0)
        } else if point.xi == 0.0 && onward < 0.0 {
            (point.element.wrapping_sub(1), 1.0)
        } else {
            return if cross(tangent, away) < 0.0 { -1.0 } else { 1.0 };
        };
        let (k, xi) = neighbour;
        if k >= self.elements.len() || self.left_out(k) {
            return 0.0;
        }
        let other = self.placed(k, at).tangent(xi);
        let mean = add(scale(1.0 / norm(tangent), tangent), scale(1.0 / norm(other), other));
        if cross(mean, away) < 0.0 { -1.0 } else { 1.0 }
    }
}
