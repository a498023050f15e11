//! The axis of a beam as contact sees it: elements in a row, and the point of them nearest to a place.

use super::configuration::Configuration;
use crate::element::beam::NodeFrame;
use crate::math::hermite;
use crate::math::vec2::{add, cross, dot, norm, scale, sub};

/// Iterations after which a foot is closed in on by halves.
const PATIENCE: usize = 40;
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
///
/// Its faces envelop the circles about its points with the half depth as their radius. The point nearest to a place is that
/// whose circle is, so on a tapered element the normal leans back from the thick end.
#[derive(Clone, Copy)]
pub struct Placed {
    ends: [[f64; 4]; 2],
    length: f64,
    /// Half depth at the first end, and its growth per length.
    half_depth: f64,
    taper: f64,
}

impl Placed {
    /// Of an element.
    pub fn new(element: &AxisElement, nodes: &[NodeFrame], at: &Configuration) -> Self {
        let end = |n: usize| {
            let (frame, u) = (&nodes[n], at.node(n));
            let (x, g) = (frame.position, frame.tangent);
            [x[0] + u[0], x[1] + u[1], g[0] + u[2], g[1] + u[3]]
        };
        let [half_depth, last] = element.half_depths;
        Self {
            ends: [end(element.node), end(element.node + 1)],
            length: element.length,
            half_depth,
            taper: (last - half_depth) / element.length,
        }
    }

    /// Distance of `y` from the circle about a point.
    fn away(&self, y: [f64; 2], xi: f64) -> f64 {
        norm(sub(self.position(xi), y)) - self.half_depth - self.taper * xi * self.length
    }

    fn combine(&self, n: &[f64; 4]) -> [f64; 2] {
        let [a, b] = &self.ends;
        [0, 1].map(|i| n[0] * a[i] + n[1] * a[2 + i] + n[2] * b[i] + n[3] * b[2 + i])
    }

    /// Position at a share of the element.
    pub fn position(&self, xi: f64) -> [f64; 2] {
        self.combine(&hermite::shape(xi, self.length))
    }

    /// Derivative with respect to arc length of the reference.
    pub fn tangent(&self, xi: f64) -> [f64; 2] {
        self.combine(&hermite::slope(xi, self.length))
    }

    /// Second derivative with respect to arc length of the reference.
    pub fn bend(&self, xi: f64) -> [f64; 2] {
        self.combine(&hermite::curvature(xi, self.length))
    }

    /// A bound from below of the distance of its circles from `y`: its control points lie about its middle.
    fn least_distance(&self, y: [f64; 2]) -> f64 {
        let [a, b] = &self.ends;
        let half = [0.5 * (b[0] - a[0]), 0.5 * (b[1] - a[1])];
        let third = self.length / 3.0;
        let middle = [a[0] + half[0], a[1] + half[1]];
        // Inner control points, seen from the middle.
        let p = [third * a[2] - half[0], third * a[3] - half[1]];
        let q = [half[0] - third * b[2], half[1] - third * b[3]];
        let reach = dot(half, half).max(dot(p, p)).max(dot(q, q)).sqrt();
        norm(sub(y, middle)) - reach - self.half_depth - (self.taper * self.length).max(0.0)
    }

    /// Whether a place at most `away` from it has one point of it that is nearest in its neighbourhood, not several: the square
    /// of the distance is convex throughout. So it is wherever the element is bent by less than about a radian.
    fn has_one_foot(&self, away: f64) -> bool {
        let [a, b] = &self.ends;
        let chord = [b[0] - a[0], b[1] - a[1]];
        let span = norm(chord);
        let (first, last) = ([a[2], a[3]], [b[2], b[3]]);
        // Control vectors of the derivative bound it, as its ends bound the second derivative.
        let inner = [0, 1].map(|i| 3.0 * chord[i] / self.length - first[i] - last[i]);
        let onward = [first, inner, last].map(|t| dot(t, chord) / span);
        let least = onward.into_iter().fold(f64::INFINITY, f64::min);
        let bend = norm(self.bend(0.0)).max(norm(self.bend(1.0)));
        least > 0.0 && least * least > (away + 2.0 * span) * bend
    }

    /// The share nearest to `y` of all. Where the element is bent so much that there may be several feet, each is looked for.
    fn nearest(&self, y: [f64; 2], side: f64) -> f64 {
        let away = |xi: f64| self.away(y, xi);
        let coarse: [f64; 5] = std::array::from_fn(|k| away(0.25 * k as f64));
        let (best, least) = least_of(&coarse);
        if self.has_one_foot(least + self.half_depth + (self.taper * self.length).max(0.0)) {
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
        for iteration in 0..PATIENCE + 55 {
            let (e, t, c) = (sub(self.position(xi), y), self.tangent(xi), self.bend(xi));
            let slope = self.onward(y, xi, side) * self.length;
            let leaning = if self.taper == 0.0 { 0.0 } else { self.leaning(e, t, side) };
            // Gauss-Newton where the square of the distance is not convex.
            let (full, safe) = (dot(t, t) + dot(e, c) - leaning, dot(t, t));
            let bend = if full > 0.1 * safe { full } else { safe } * self.length * self.length;
            if slope > 0.0 {
                high = xi
            } else {
                low = xi
            }
            let mut next = xi - slope / bend;
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
            let step = (next - xi).abs();
            xi = next;
            if step <= 1e-15 {
                break;
            }
        }
        xi
    }

    /// How the distance from `y` changes along the axis: negative where it is nearer further on.
    fn onward(&self, y: [f64; 2], xi: f64, side: f64) -> f64 {
        let (e, t) = (sub(self.position(xi), y), self.tangent(xi));
        let level = dot(e, t);
        if self.taper == 0.0 { level } else { level - self.taper * norm(e) * through(e, t, side) }
    }

    /// What the taper adds to the derivative of that.
    fn leaning(&self, e: [f64; 2], t: [f64; 2], side: f64) -> f64 {
        let away = norm(e);
        if away > 0.0 { self.taper * through(e, t, side) * dot(e, t) / away } else { 0.0 }
    }
}

/// Whether what an axis is away from by `-e` lies on the given side (1) or has gone through (-1); without a side it lies outside.
fn through(e: [f64; 2], tangent: [f64; 2], side: f64) -> f64 {
    if cross(e, tangent) * side < 0.0 { -1.0 } else { 1.0 }
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
    pub elements: &'a [AxisElement],
    /// Elements left out, for a beam against itself.
    pub skip: [usize; 2],
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
        for element in (0..self.elements.len()).filter(|k| !self.left_out(*k)) {
            let placed = self.placed(element, at);
            let deepest = self.elements[element].half_depths.into_iter().fold(0.0, f64::max);
            if placed.least_distance(y) > best.0
                || (Some(element) == found && placed.has_one_foot(best.0 + deepest))
            {
                continue;
            }
            let xi = placed.nearest(y, side);
            let away = placed.away(y, xi);
            // Of two as near, the one found first: at a node both elements say the same.
            if away + 1e-14 * norm(sub(placed.position(xi), y)) < best.0 {
                best = (away, Some(AxisPoint { element, xi }));
            }
        }
        let leapt_from = local.filter(|_| best.1 != local);
        best.1.map(|point| Nearest { point, leapt_from })
    }

    /// The point nearest to `y` in the neighbourhood of another one: downhill along the axis.
    pub fn near(&self, y: [f64; 2], at: &Configuration, from: AxisPoint, side: f64) -> AxisPoint {
        let (mut element, mut guess, mut way) = (from.element, from.xi, 0_i8);
        loop {
            let placed = self.placed(element, at);
            let xi = placed.descend(y, guess, side);
            let onward = placed.onward(y, xi, side);
            let (next, start) = if xi == 1.0 && onward < 0.0 && way >= 0 {
                way = 1;
                (element + 1, 0.0)
            } else if xi == 0.0 && onward > 0.0 && way <= 0 {
                way = -1;
                (element.wrapping_sub(1), 1.0)
            } else {
                return AxisPoint { element, xi };
            };
            if next >= self.elements.len() || self.left_out(next) {
                return AxisPoint { element, xi };
            }
            // At a corner the next element may lead away again: then the corner is nearest.
            let ahead = self.placed(next, at).onward(y, start, side);
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
        let away = sub(y, placed.position(point.xi));
        let mut tangent = placed.tangent(point.xi);
        let onward = dot(away, tangent);
        let beyond = |k: usize| k >= self.elements.len() || self.left_out(k);
        let neighbour = if point.xi == 1.0 && onward > 0.0 {
            Some((point.element + 1, 0.0))
        } else if point.xi == 0.0 && onward < 0.0 {
            Some((point.element.wrapping_sub(1), 1.0))
        } else {
            None
        };
        if let Some((k, xi)) = neighbour {
            if beyond(k) {
                return 0.0;
            }
            let other = self.placed(k, at).tangent(xi);
            tangent = add(scale(1.0 / norm(tangent), tangent), scale(1.0 / norm(other), other));
        }
        if cross(tangent, away) < 0.0 { -1.0 } else { 1.0 }
    }
}
