//! The axis of a beam as contact sees it: elements in a row, and the point of them nearest to a place.

use super::configuration::Configuration;
use crate::element::beam::NodeFrame;
use crate::math::vec2::{add, cross, dot, norm, scale, sub};

/// Iterations after which a foot is closed in on by halves.
const PATIENCE: usize = 40;
/// A step by which Newton's iteration for a foot has settled: it converges quadratically, so what is left is round-off.
const SETTLED: f64 = 1e-9;
/// Steps to a foot shorter than this do not leap over a crest of the distance.
const CREST: f64 = 1e-6;
/// Places at which the feet on a strongly bent element are looked for.
const FEET: usize = 32;

/// An element of a beam's axis.
#[derive(Clone, Copy, Debug)]
pub struct AxisElement {
    /// Node `a`; node `b` is the next one.
    pub node: usize,
    /// Length \[m\].
    pub length: f64,
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Distance of either face from the axis at both ends, linear between \[m\].
    pub half_depths: [f64; 2],
}

impl AxisElement {
    /// Distance of either face from the axis at a share of the element \[m\].
    pub fn half_depth(&self, xi: f64) -> f64 {
        let [a, b] = self.half_depths;
        a + xi * (b - a)
    }
}

/// The elements of a beam's axis.
#[derive(Clone, Debug)]
pub struct AxisElements {
    list: Vec<AxisElement>,
    /// Length of the longest \[m\].
    pub longest: f64,
    /// Largest half depth \[m\].
    pub deepest: f64,
}

impl AxisElements {
    /// Of a list in order.
    pub fn new(list: Vec<AxisElement>) -> Self {
        let most = |of: fn(&AxisElement) -> f64| list.iter().map(of).fold(0.0, f64::max);
        Self {
            longest: most(|e| e.length),
            deepest: most(|e| e.half_depths[0].max(e.half_depths[1])),
            list,
        }
    }
}

impl std::ops::Deref for AxisElements {
    type Target = [AxisElement];

    fn deref(&self) -> &[AxisElement] {
        &self.list
    }
}

/// A point of an axis: the number of its element and the share of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisPoint {
    /// Number of the element in the beam.
    pub element: usize,
    /// Share of the element, from 0 to 1.
    pub xi: f64,
}

/// The point of an axis that is nearest of all.
#[derive(Clone, Copy, Debug)]
pub struct Nearest {
    /// The point.
    pub point: AxisPoint,
    /// The point nearest in the neighbourhood of the guess, if another one is nearer: the foot leaps between two arms of a
    /// beam.
    pub leapt_from: Option<AxisPoint>,
}

/// An element in a configuration: position and slope at both ends.
#[derive(Clone, Copy)]
struct Ends {
    nodes: [[f64; 4]; 2],
    length: f64,
}

impl Ends {
    fn new(element: &AxisElement, nodes: &[NodeFrame], at: &Configuration) -> Self {
        let end = |n: usize| {
            let (frame, u) = (&nodes[n], at.node(n));
            let (x, g) = (frame.position, frame.tangent);
            [x[0] + u[0], x[1] + u[1], g[0] + u[2], g[1] + u[3]]
        };
        Self { nodes: [end(element.node), end(element.node + 1)], length: element.length }
    }

    /// A bound from above of its length, squared: control vectors of the derivative bound it.
    fn longest_squared(&self) -> f64 {
        let [a, b, c] = self.control_vectors().map(|t| dot(t, t));
        let most = if a > b { a } else { b };
        self.length * self.length * if c > most { c } else { most }
    }

    /// Control vectors of the derivative with respect to arc length of the reference.
    fn control_vectors(&self) -> [[f64; 2]; 3] {
        let [a, b] = &self.nodes;
        let inner = |i: usize| 3.0 * (b[i] - a[i]) / self.length - a[2 + i] - b[2 + i];
        [[a[2], a[3]], [inner(0), inner(1)], [b[2], b[3]]]
    }

    /// A bound from below of the distance of its axis from `y`, squared: the axis lies in the box about its control points.
    fn least_distance_squared(&self, y: [f64; 2]) -> f64 {
        let [a, b] = &self.nodes;
        let third = self.length / 3.0;
        let mut squared = 0.0;
        for i in 0..2 {
            let (p, q) = (a[i] + third * a[2 + i], b[i] - third * b[2 + i]);
            let (low, high) = (a[i].min(b[i]).min(p.min(q)), a[i].max(b[i]).max(p.max(q)));
            let outside = (low - y[i]).max(y[i] - high).max(0.0);
            squared += outside * outside;
        }
        squared
    }

    /// Whether a place at most `away` from it has one point of it that is nearest in its neighbourhood, not several: the square
    /// of the distance is convex throughout. So it is wherever the element is bent by less than about a radian.
    fn has_one_foot(&self, away: f64) -> bool {
        let [a, b] = &self.nodes;
        let chord = [b[0] - a[0], b[1] - a[1]];
        let span = norm(chord);
        // Control vectors bound the derivative, as its ends bound the second derivative.
        let [first, inner, last] = self.control_vectors();
        let least = dot(first, chord).min(dot(inner, chord)).min(dot(last, chord)) / span;
        let turn = norm(sub(inner, first)).max(norm(sub(last, inner)));
        least > 0.0 && least * least > (away + 2.0 * span) * 2.0 * turn / self.length
    }
}

/// The axis of an element in a configuration: a cubic in the share of the element.
///
/// Its faces envelop the circles about its points with the half depth as their radius. The point nearest to a place is that
/// whose circle is, so on a tapered element the normal leans back from the thick end.
#[derive(Clone, Copy)]
pub struct Placed {
    /// Coefficients of the powers of the share.
    powers: [[f64; 2]; 4],
    length: f64,
    /// Half depth at the first end, and its growth to the other.
    half_depth: f64,
    growth: f64,
}

/// A place of an element as a point sees it.
#[derive(Clone, Copy)]
struct Seen {
    /// From the point to the place.
    away: [f64; 2],
    /// Derivative with respect to the share.
    tangent: [f64; 2],
}

impl Placed {
    /// Of an element.
    pub fn new(element: &AxisElement, nodes: &[NodeFrame], at: &Configuration) -> Self {
        Self::between(element, &Ends::new(element, nodes, at))
    }

    fn between(element: &AxisElement, ends: &Ends) -> Self {
        let [a, b] = &ends.nodes;
        let mut powers = [[0.0; 2]; 4];
        for i in 0..2 {
            let (g, h) = (ends.length * a[2 + i], ends.length * b[2 + i]);
            let rise = b[i] - a[i];
            powers[0][i] = a[i];
            powers[1][i] = g;
            powers[2][i] = 3.0 * rise - 2.0 * g - h;
            powers[3][i] = g + h - 2.0 * rise;
        }
        let [half_depth, last] = element.half_depths;
        Self { powers, length: ends.length, half_depth, growth: last - half_depth }
    }

    /// Distance of `y` from the circle about a point.
    fn away(&self, y: [f64; 2], xi: f64) -> f64 {
        norm(sub(self.position(xi), y)) - self.half_depth - self.growth * xi
    }

    /// Position at a share of the element.
    pub fn position(&self, xi: f64) -> [f64; 2] {
        let [a, b, c, d] = &self.powers;
        let at = |i: usize| a[i] + xi * (b[i] + xi * (c[i] + xi * d[i]));
        [at(0), at(1)]
    }

    /// Derivative with respect to the share.
    fn onward(&self, xi: f64) -> [f64; 2] {
        let [_, b, c, d] = &self.powers;
        let at = |i: usize| b[i] + xi * (2.0 * c[i] + 3.0 * xi * d[i]);
        [at(0), at(1)]
    }

    /// Second derivative with respect to the share.
    fn turning(&self, xi: f64) -> [f64; 2] {
        let [_, _, c, d] = &self.powers;
        let at = |i: usize| 2.0 * c[i] + 6.0 * xi * d[i];
        [at(0), at(1)]
    }

    /// Derivative with respect to arc length of the reference.
    pub fn tangent(&self, xi: f64) -> [f64; 2] {
        scale(1.0 / self.length, self.onward(xi))
    }

    /// Second derivative with respect to arc length of the reference.
    pub fn bend(&self, xi: f64) -> [f64; 2] {
        scale(1.0 / (self.length * self.length), self.turning(xi))
    }

    fn seen(&self, y: [f64; 2], xi: f64) -> Seen {
        Seen { away: sub(self.position(xi), y), tangent: self.onward(xi) }
    }

    /// The share nearest to `y` of all. Where the element is bent so much that there may be several feet, each is looked for.
    fn nearest(&self, ends: &Ends, y: [f64; 2], side: f64) -> f64 {
        let away = |xi: f64| self.away(y, xi);
        let coarse: [f64; 5] = std::array::from_fn(|k| away(0.25 * k as f64));
        let (best, least) = least_of(&coarse);
        if ends.has_one_foot(least + self.half_depth + self.growth.max(0.0)) {
            return self.descend(y, 0.25 * best as f64, side);
        }
        let fine: [f64; FEET + 1] = std::array::from_fn(|k| away(k as f64 / FEET as f64));
        let nearer = |k: usize, other: Option<&f64>| other.is_none_or(|other| fine[k] <= *other);
        let valleys = (0..=FEET).filter(|k| {
            nearer(*k, k.checked_sub(1).map(|before| &fine[before])) && nearer(*k, fine.get(k + 1))
        });
        let feet = valleys.map(|k| self.descend(y, k as f64 / FEET as f64, side));
        feet.min_by(|a, b| away(*a).total_cmp(&away(*b))).unwrap_or(0.5)
    }

    /// The share nearest to `y` in the neighbourhood of another one: Newton's iteration on the square of the distance, downhill,
    /// within the element. What is on the other side of the axis than `side` has gone through: it is nearest where it is deepest.
    fn descend(&self, y: [f64; 2], mut xi: f64, side: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        let mut seen = self.seen(y, xi);
        for iteration in 0..PATIENCE + 55 {
            let slope = self.slope(&seen, side);
            let safe = dot(seen.tangent, seen.tangent);
            let full = safe + dot(seen.away, self.turning(xi)) - self.leaning(&seen, side);
            // Gauss-Newton where the square of the distance is not convex.
            let convex = full > 0.1 * safe;
            if slope > 0.0 {
                high = xi
            } else {
                low = xi
            }
            let mut next = xi - slope / if convex { full } else { safe };
            // Where the distance hardly changes, next to a centre of curvature, Newton's iteration crawls.
            let crawls = iteration >= PATIENCE;
            if crawls {
                next = 0.5 * (low + high);
            } else if !(next >= low && next <= high) {
                // Out of the bracket: to its end if that is the element's, else to its middle.
                next = if next < low && low == 0.0 {
                    0.0
                } else if next > high && high == 1.0 {
                    1.0
                } else {
                    0.5 * (low + high)
                };
            }
            let mut there = self.seen(y, next);
            // Beyond a crest lies the neighbourhood of another foot.
            while !crawls
                && (next - xi).abs() > CREST
                && self.distance(&there, next, side) > self.distance(&seen, xi, side)
            {
                next = 0.5 * (xi + next);
                there = self.seen(y, next);
            }
            let step = (next - xi).abs();
            (xi, seen) = (next, there);
            if step <= if convex { SETTLED } else { 1e-15 } {
                break;
            }
        }
        xi
    }

    /// What is least at a foot.
    fn distance(&self, seen: &Seen, xi: f64, side: f64) -> f64 {
        let depth = if self.growth == 0.0 { 0.0 } else { self.growth * xi * through(seen, side) };
        norm(seen.away) - depth
    }

    /// How half the square of the distance changes with the share: negative where it is nearer further on.
    fn slope(&self, seen: &Seen, side: f64) -> f64 {
        let level = dot(seen.away, seen.tangent);
        if self.growth == 0.0 {
            return level;
        }
        level - self.growth * norm(seen.away) * through(seen, side)
    }

    /// What the taper takes from the derivative of that.
    fn leaning(&self, seen: &Seen, side: f64) -> f64 {
        if self.growth == 0.0 {
            return 0.0;
        }
        let distance = norm(seen.away);
        let level = dot(seen.away, seen.tangent);
        if distance > 0.0 { self.growth * through(seen, side) * level / distance } else { 0.0 }
    }
}

/// Whether a point lies on the given side of an axis (1) or has gone through (-1); without a side it lies outside.
fn through(seen: &Seen, side: f64) -> f64 {
    if cross(seen.away, seen.tangent) * side < 0.0 { -1.0 } else { 1.0 }
}

/// Index and value of the least.
fn least_of(values: &[f64]) -> (usize, f64) {
    let least = values.iter().copied().enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
    least.unwrap_or((0, f64::INFINITY))
}

/// The axis of a beam in a configuration.
#[derive(Clone, Copy)]
pub struct Axis<'a> {
    pub nodes: &'a [NodeFrame],
    pub elements: &'a AxisElements,
    /// Elements left out, for a beam against itself.
    pub skip: [usize; 2],
    /// Length that none of the elements exceeds \[m\].
    pub arc: f64,
}

/// A bound of the length of a beam's longest element.
pub fn longest_arc(elements: &[AxisElement], nodes: &[NodeFrame], at: &Configuration) -> f64 {
    let squared = |e| Ends::new(e, nodes, at).longest_squared();
    elements.iter().map(squared).fold(0.0, |most, x| if x > most { x } else { most }).sqrt()
}

impl Axis<'_> {
    fn left_out(&self, k: usize) -> bool {
        self.skip[0] <= k && k < self.skip[1]
    }

    fn placed(&self, k: usize, at: &Configuration) -> Placed {
        Placed::new(&self.elements[k], self.nodes, at)
    }

    /// The point nearest to `y` of all; `None` if all elements are left out. The search starts near `guess`.
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
            best = (self.placed(near.element, at).away(y, near.xi), Some(near));
        }
        let local = best.1;
        let found = local.map(|p| p.element);
        let mut next = 0;
        while next < self.elements.len() {
            let k = next;
            next += 1;
            if self.left_out(k) {
                next = self.skip[1];
                continue;
            }
            let element = &self.elements[k];
            let ends = Ends::new(element, self.nodes, at);
            let within = best.0 + self.elements.deepest;
            let squared = ends.least_distance_squared(y);
            if within < 0.0 || squared > within * within {
                // Elements that follow cannot come nearer faster than the axis is long.
                next += ((squared.sqrt() - within) / self.arc) as usize;
                continue;
            }
            if Some(k) == found && ends.has_one_foot(within) {
                continue;
            }
            let placed = Placed::between(element, &ends);
            let xi = placed.nearest(&ends, y, side);
            let away = placed.away(y, xi);
            // Of two as near, the one found first: at a node both elements say the same.
            if away + 1e-14 * norm(sub(placed.position(xi), y)) < best.0 {
                best = (away, Some(AxisPoint { element: k, xi }));
            }
        }
        if best.1 == local {
            return local.map(|point| Nearest { point, leapt_from: None });
        }
        // The foot that the next search in its neighbourhood will find.
        let point = best.1.map(|point| self.near(y, at, point, side))?;
        Some(Nearest { point, leapt_from: local })
    }

    /// The point nearest to `y` in the neighbourhood of another one: downhill along the axis.
    pub fn near(&self, y: [f64; 2], at: &Configuration, from: AxisPoint, side: f64) -> AxisPoint {
        let (mut element, mut guess, mut way) = (from.element, from.xi, 0_i8);
        loop {
            let placed = self.placed(element, at);
            let xi = placed.descend(y, guess, side);
            let slope = |placed: &Placed, xi: f64| placed.slope(&placed.seen(y, xi), side);
            let (next, start) = if xi == 1.0 && way >= 0 && slope(&placed, xi) < 0.0 {
                way = 1;
                (element + 1, 0.0)
            } else if xi == 0.0 && way <= 0 && slope(&placed, xi) > 0.0 {
                way = -1;
                (element.wrapping_sub(1), 1.0)
            } else {
                return AxisPoint { element, xi };
            };
            if next >= self.elements.len() || self.left_out(next) {
                return AxisPoint { element, xi };
            }
            // At a corner the next element may lead away again: then the corner is nearest.
            let ahead = slope(&self.placed(next, at), start);
            if ahead * f64::from(way) >= 0.0 {
                return AxisPoint { element, xi };
            }
            (element, guess) = (next, start);
        }
    }

    /// Whether a point is where the elements left out begin, which is no end.
    pub fn is_border(&self, point: AxisPoint) -> bool {
        let k = point.element;
        (point.xi == 1.0 && k + 1 < self.elements.len() && self.left_out(k + 1))
            || (point.xi == 0.0 && k > 0 && self.left_out(k - 1))
    }

    /// Sign of the side on which `y` lies, seen along the axis at its nearest point; zero beyond an end.
    pub fn side(&self, y: [f64; 2], at: &Configuration, point: AxisPoint) -> f64 {
        let placed = self.placed(point.element, at);
        self.side_of(sub(y, placed.position(point.xi)), placed.tangent(point.xi), at, point)
    }

    /// The same, where the place lies away from its nearest point, at which the tangent is given.
    pub fn side_of(
        &self,
        away: [f64; 2],
        tangent: [f64; 2],
        at: &Configuration,
        point: AxisPoint,
    ) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        /// However the axis is bent: going downhill from anywhere comes nearer, and the nearest point of all is where the search
        /// in its own neighbourhood finds it again.
        #[test]
        fn feet_are_downhill_and_found_again(
            nodes in proptest::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64, -2.5..2.5_f64, -2.5..2.5_f64), 4),
            y in (-1.2..1.2_f64, -1.2..1.2_f64),
            (start, xi) in (0..3_usize, 0.0..1.0_f64),
        ) {
            let still = NodeFrame { position: [0.0; 2], tangent: [0.0; 2] };
            let frames = [still; 4];
            let displacement: Vec<_> = nodes.iter().map(|n| [n.0, n.1, n.2, n.3]).collect();
            let element =
                |k: usize| AxisElement { node: k, length: 1.0, s: k as f64, half_depths: [0.0; 2] };
            let elements = AxisElements::new((0..3).map(element).collect());
            let at = Configuration::of(&displacement);
            let arc = longest_arc(&elements, &frames, &at);
            let bounded = Axis { nodes: &frames, elements: &elements, skip: [0, 0], arc };
            let y = [y.0, y.1];
            let away = |p: AxisPoint| bounded.placed(p.element, &at).away(y, p.xi);

            let from = AxisPoint { element: start, xi };
            let near = bounded.near(y, &at, from, 0.0);
            prop_assert!(away(near) <= away(from) + 1e-12, "{} from {}", away(near), away(from));

            let nearest = bounded.nearest(y, &at, from, 0.0).map_or(from, |n| n.point);
            let again = bounded.near(y, &at, nearest, 0.0);
            prop_assert!((away(again) - away(nearest)).abs() <= 1e-12);
            // Elements skipped by their length would not have been nearer.
            let all = Axis { arc: f64::INFINITY, ..bounded };
            let unbounded = all.nearest(y, &at, from, 0.0).map_or(from, |n| n.point);
            prop_assert!((away(unbounded) - away(nearest)).abs() <= 1e-12);
            // No point of a fine sampling is nearer, but by what lies between points of the search's own.
            for k in 0..3 {
                for j in 0..=200 {
                    let sample = away(AxisPoint { element: k, xi: f64::from(j) / 200.0 });
                    prop_assert!(sample >= away(nearest) - 1e-2, "{sample} {}", away(nearest));
                }
            }
        }
    }
}
