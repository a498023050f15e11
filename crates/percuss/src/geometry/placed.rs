//! An element of a beam's axis in a configuration, and the points of it nearest to a place.

use super::configuration::Configuration;
use crate::element::beam::NodeFrame;
use crate::element::shear::InsideField;
use crate::math::vec2::{cross, dot, norm, scale, sub};

/// Iterations after which a closest point is closed in on by halves.
const PATIENCE: usize = 40;
/// Step at which Newton's iteration for a closest point has converged: it converges quadratically, so the remainder is round-off.
const SETTLED: f64 = 1e-9;
/// Steps to a closest point shorter than this do not leap over a crest of the distance.
const CREST: f64 = 1e-6;
/// Starting points of the search for closest points on a strongly bent element.
const SAMPLES: usize = 32;

/// An element of a beam's axis.
#[derive(Clone, Copy, Debug)]
pub struct AxisElement {
    /// Node `a`; node `b` is the next one.
    pub node: usize,
    /// Length \[m\].
    pub length: f64,
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Share of bending in the difference of its chord and its sections: one of a slender element \[-\].
    pub bent: f64,
    /// Distance of either face from the axis at both ends, linear between, shape (2) \[m\].
    pub half_depths: [f64; 2],
    /// Distance to the left from the element to the original curve at its quarter points, shape (3) \[m\]: a cubic is no arc.
    pub deviations: [f64; 3],
}

impl AxisElement {
    /// The field inside it.
    pub fn inside(&self) -> InsideField {
        InsideField { length: self.length, bent: self.bent }
    }

    /// Distance to the left from the element to the original curve at a share of it \[m\]; both meet at its ends with the same tangent.
    pub fn deviation(&self, xi: f64) -> f64 {
        let bubble = |xi: f64| (xi * (1.0 - xi)).powi(2);
        let [a, b, c] = [0, 1, 2].map(|k| self.deviations[k] / bubble(0.25 * (k + 1) as f64));
        // The parabola through the three shares of the bubble.
        let t = 4.0 * xi - 2.0;
        (b + 0.5 * t * (c - a) + 0.5 * t * t * (a - 2.0 * b + c)) * bubble(xi)
    }

    /// The largest of the deviations \[m\].
    pub fn largest_deviation(&self) -> f64 {
        self.deviations.iter().fold(0.0, |most, x| x.abs().max(most))
    }

    /// Distance of either face from the axis at a share of the element \[m\].
    pub fn half_depth(&self, xi: f64) -> f64 {
        let [a, b] = self.half_depths;
        a + xi * (b - a)
    }
}

/// An element in a configuration: position and slope at both ends.
#[derive(Clone, Copy)]
pub struct ElementEnds {
    /// Position and tangent x' at both ends, shape (2, 4) \[m, -\].
    nodes: [[f64; 4]; 2],
    length: f64,
    /// Inclination of its axis against its sections, x' less their vectors d, shape (2) \[-\].
    shear: [f64; 2],
}

impl ElementEnds {
    /// Of an element.
    pub fn new(element: &AxisElement, nodes: &[NodeFrame], at: &Configuration) -> Self {
        let end = |n: usize| {
            let (frame, u) = (&nodes[n], at.node(n));
            let (x, g) = (frame.position, frame.tangent);
            [x[0] + u[0], x[1] + u[1], g[0] + u[2], g[1] + u[3]]
        };
        let mut nodes = [end(element.node), end(element.node + 1)];
        let mut shear = [0.0; 2];
        if element.bent != 1.0 {
            // Sections are inclined against the axis by the shear.
            let places = nodes.map(|[x1, x2, ..]| [x1, x2]);
            let directors = nodes.map(|[_, _, d1, d2]| [d1, d2]);
            shear = element.inside().sheared(places, directors);
            nodes.iter_mut().for_each(|node| (0..2).for_each(|i| node[2 + i] += shear[i]));
        }
        Self { nodes, length: element.length, shear }
    }

    /// A bound from above of its length, squared: control vectors of the derivative bound it.
    pub fn longest_squared(&self) -> f64 {
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

    /// A lower bound of the distance of its axis from `y`, squared: the axis is inside the box about its control points.
    pub fn least_distance_squared(&self, y: [f64; 2]) -> f64 {
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
    pub fn has_one_closest_point(&self, away: f64) -> bool {
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
/// Its faces envelop the circles about its points with the half depth as their radius. The closest point to a place belongs to the closest circle,
/// so on a tapered element the normal is inclined away from the thick end.
#[derive(Clone, Copy)]
pub struct Placed {
    /// Coefficients of the powers of the share, shape (4, 2) \[m\].
    powers: [[f64; 2]; 4],
    length: f64,
    /// Inclination of the axis against the sections, shape (2) \[-\].
    shear: [f64; 2],
    /// Half depth at the first end, and its growth to the other.
    half_depth: f64,
    growth: f64,
}

/// A point of an element relative to a point in space.
#[derive(Clone, Copy)]
struct SeenPlace {
    /// From the point to the place, shape (2) \[m\].
    away: [f64; 2],
    /// Derivative with respect to the share, shape (2) \[m\].
    tangent: [f64; 2],
}

impl Placed {
    /// Of an element.
    pub fn new(element: &AxisElement, nodes: &[NodeFrame], at: &Configuration) -> Self {
        Self::between(element, &ElementEnds::new(element, nodes, at))
    }

    /// Of an element whose ends are known.
    pub fn between(element: &AxisElement, ends: &ElementEnds) -> Self {
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
        let growth = last - half_depth;
        Self { powers, length: ends.length, shear: ends.shear, half_depth, growth }
    }

    /// Distance of `y` from the circle about a point.
    pub fn away(&self, y: [f64; 2], xi: f64) -> f64 {
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

    /// Normal of the section: the tangent of a slender element.
    pub fn section(&self, xi: f64) -> [f64; 2] {
        sub(self.tangent(xi), self.shear)
    }

    /// Second derivative with respect to arc length of the reference.
    pub fn bend(&self, xi: f64) -> [f64; 2] {
        scale(1.0 / (self.length * self.length), self.turning(xi))
    }

    fn seen(&self, y: [f64; 2], xi: f64) -> SeenPlace {
        SeenPlace { away: sub(self.position(xi), y), tangent: self.onward(xi) }
    }

    /// The share closest to `y` between two `limits`. On an element with large bending, which may have several closest points, all are determined.
    pub fn nearest(&self, ends: &ElementEnds, y: [f64; 2], side: f64, limits: [f64; 2]) -> f64 {
        let away = |xi: f64| self.away(y, xi);
        let [low, high] = limits;
        let at = |k: usize, of: usize| low + (high - low) * (k as f64 / of as f64);
        let coarse: [f64; 5] = std::array::from_fn(|k| away(at(k, 4)));
        let (best, least) = least_of(&coarse);
        if ends.has_one_closest_point(least + self.half_depth + self.growth.max(0.0)) {
            return self.descend(y, at(best, 4), side, limits);
        }
        let fine: [f64; SAMPLES + 1] = std::array::from_fn(|k| away(at(k, SAMPLES)));
        let nearer = |k: usize, other: Option<&f64>| other.is_none_or(|other| fine[k] <= *other);
        let valleys = (0..=SAMPLES).filter(|k| {
            nearer(*k, k.checked_sub(1).map(|before| &fine[before])) && nearer(*k, fine.get(k + 1))
        });
        let closest = valleys.map(|k| self.descend(y, at(k, SAMPLES), side, limits));
        closest.min_by(|a, b| away(*a).total_cmp(&away(*b))).unwrap_or(0.5 * (low + high))
    }

    /// The share closest to `y` in the neighbourhood of another one: Newton's iteration on the square of the distance, with descent, between two
    /// `limits`. A point on the other side of the axis than `side` has penetrated: its closest point is the deepest.
    pub fn descend(&self, y: [f64; 2], guess: f64, side: f64, limits: [f64; 2]) -> f64 {
        let [mut low, mut high] = limits;
        let mut xi = guess.clamp(low, high);
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
            // If the distance hardly changes, near a centre of curvature, Newton's iteration is slow.
            let crawls = iteration >= PATIENCE;
            if crawls {
                next = 0.5 * (low + high);
            } else if !(next >= low && next <= high) {
                // Out of the bracket: to its end if that is the element's, else to its middle.
                next = if next < low && low == limits[0] {
                    low
                } else if next > high && high == limits[1] {
                    high
                } else {
                    0.5 * (low + high)
                };
            }
            let mut there = self.seen(y, next);
            // Beyond a crest begins the neighbourhood of another closest point.
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

    /// Function with a minimum at a closest point.
    fn distance(&self, seen: &SeenPlace, xi: f64, side: f64) -> f64 {
        let depth = if self.growth == 0.0 { 0.0 } else { self.growth * xi * through(seen, side) };
        norm(seen.away) - depth
    }

    /// Derivative of half the square of the distance from `y` with respect to the share: negative if later points are closer.
    pub fn slope_at(&self, y: [f64; 2], xi: f64, side: f64) -> f64 {
        self.slope(&self.seen(y, xi), side)
    }

    fn slope(&self, seen: &SeenPlace, side: f64) -> f64 {
        let level = dot(seen.away, seen.tangent);
        if self.growth == 0.0 {
            return level;
        }
        level - self.growth * norm(seen.away) * through(seen, side)
    }

    /// Contribution of the taper to its derivative.
    fn leaning(&self, seen: &SeenPlace, side: f64) -> f64 {
        if self.growth == 0.0 {
            return 0.0;
        }
        let distance = norm(seen.away);
        let level = dot(seen.away, seen.tangent);
        if distance > 0.0 { self.growth * through(seen, side) * level / distance } else { 0.0 }
    }
}

/// Whether a point is on the given side of an axis (1) or has penetrated beyond it (-1); without a side it is outside.
fn through(seen: &SeenPlace, side: f64) -> f64 {
    if cross(seen.away, seen.tangent) * side < 0.0 { -1.0 } else { 1.0 }
}

/// Index and value of the least.
fn least_of(values: &[f64]) -> (usize, f64) {
    let least = values.iter().copied().enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
    least.unwrap_or((0, f64::INFINITY))
}
