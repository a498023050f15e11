//! The centre line of a beam: smooth pieces between corners, each with position and tangent by arc length.

use super::definition::{Along, Beam, Curve};
use crate::math::spline::Spline;
use crate::math::vec2::{add, cross, dot, norm, rot90, scale, sub};

/// A smooth part of a centre line.
#[derive(Clone, Debug)]
pub enum Piece {
    /// From a point along a unit tangent.
    Straight {
        /// Start, shape (2) \[m\].
        start: [f64; 2],
        /// Unit tangent, shape (2) \[-\].
        tangent: [f64; 2],
        length: f64,
    },
    /// About a centre from an angle on, of signed curvature.
    Arc {
        /// Its centre, shape (2) \[m\].
        centre: [f64; 2],
        from: f64,
        curvature: f64,
        length: f64,
    },
    /// Splines of both coordinates over a parameter, and the arc length at fine steps of it.
    Smooth {
        x: Spline,
        y: Spline,
        /// Fine steps of the parameter, from zero on, shape (steps) \[parameter of the splines\].
        parameter: Vec<f64>,
        /// Arc length at these, shape (steps) \[m\].
        arc: Vec<f64>,
    },
}

/// Steps of the parameter between two points of a smooth curve, for its arc length.
const STEPS: usize = 64;

/// The centre line of a beam whose points have been checked.
#[derive(Clone, Debug)]
pub struct CentreLine {
    /// Its smooth parts, from its start on, shape (pieces).
    pub pieces: Vec<Piece>,
    /// Arc length at which each ends, shape (pieces) \[m\].
    ends: Vec<f64>,
}

impl CentreLine {
    /// The line through the points of `beam`; `None` if they define none.
    pub fn new(beam: &Beam) -> Option<Self> {
        let points = &beam.points;
        if points.len() < 2 || points.as_flattened().iter().any(|c| !c.is_finite()) {
            return None;
        }
        if points.windows(2).any(|w| w[0] == w[1]) {
            return None;
        }
        let pieces: Vec<Piece> = match beam.curve {
            Curve::Polyline => points.windows(2).map(|w| straight(w[0], w[1])).collect(),
            Curve::Arc => vec![arc(points)?],
            Curve::Spline if points.len() == 2 => vec![straight(points[0], points[1])],
            Curve::Spline => vec![smooth(points)],
        };
        let sum = |total: &mut f64, piece: &Piece| {
            *total += piece.length();
            Some(*total)
        };
        let ends = pieces.iter().scan(0.0, sum).collect();
        Some(Self { pieces, ends })
    }

    /// Length of the line \[m\].
    pub fn length(&self) -> f64 {
        self.ends.last().copied().unwrap_or(0.0)
    }

    /// Arc length of a place \[m\].
    pub fn arc(&self, along: Along) -> f64 {
        match along {
            Along::Fraction(f) => f * self.length(),
            Along::Distance(s) => s,
        }
    }

    /// Unit tangent at arc length `s` \[m\]; at a corner that of the part before it.
    pub fn tangent(&self, s: f64) -> [f64; 2] {
        self.at(s).1
    }

    /// Position at arc length `s` \[m\].
    pub fn position(&self, s: f64) -> [f64; 2] {
        self.at(s).0
    }

    fn at(&self, s: f64) -> ([f64; 2], [f64; 2]) {
        let piece = self.ends.partition_point(|end| *end < s).min(self.pieces.len() - 1);
        let start = if piece > 0 { self.ends[piece - 1] } else { 0.0 };
        self.pieces[piece].at(s - start)
    }
}

impl Piece {
    /// Length \[m\].
    pub fn length(&self) -> f64 {
        match self {
            Self::Straight { length, .. } | Self::Arc { length, .. } => *length,
            Self::Smooth { arc, .. } => arc[arc.len() - 1],
        }
    }

    /// Position and unit tangent at arc length `s` from its start.
    pub fn at(&self, s: f64) -> ([f64; 2], [f64; 2]) {
        match self {
            Self::Straight { start, tangent, .. } => (add(*start, scale(s, *tangent)), *tangent),
            Self::Arc { centre, from, curvature, .. } => {
                let angle = from + s * curvature;
                let outward = [angle.cos(), angle.sin()];
                let tangent = scale(curvature.signum(), rot90(outward));
                (add(*centre, scale(1.0 / curvature.abs(), outward)), tangent)
            }
            Self::Smooth { x, y, parameter, arc } => {
                let t = parameter_at(x, y, parameter, arc, s);
                let slope = [x.slope(t), y.slope(t)];
                ([x.value(t), y.value(t)], scale(1.0 / norm(slope), slope))
            }
        }
    }
}

fn straight(start: [f64; 2], end: [f64; 2]) -> Piece {
    let length = norm(sub(end, start));
    Piece::Straight { start, tangent: scale(1.0 / length, sub(end, start)), length }
}

/// The arc through three points; `None` if they are on a line.
fn arc(points: &[[f64; 2]]) -> Option<Piece> {
    let &[a, b, c] = points else { return None };
    let (ab, ac) = (sub(b, a), sub(c, a));
    let area = cross(ab, ac);
    if area.abs() <= 1e-12 * dot(ac, ac).max(dot(ab, ab)) {
        return None;
    }
    // Centre from a: equidistant from all three points.
    let (bb, cc) = (dot(ab, ab), dot(ac, ac));
    let to_centre = scale(0.5 / area, [ac[1] * bb - ab[1] * cc, ab[0] * cc - ac[0] * bb]);
    let centre = add(a, to_centre);
    let angle = |p: [f64; 2]| {
        let d = sub(p, centre);
        d[1].atan2(d[0])
    };
    let radius = norm(to_centre);
    let turn = std::f64::consts::TAU;
    let sense = area.signum();
    let span = (sense * (angle(c) - angle(a))).rem_euclid(turn);
    Some(Piece::Arc { centre, from: angle(a), curvature: sense / radius, length: radius * span })
}

/// A natural spline through all points over the length of the chords.
fn smooth(points: &[[f64; 2]]) -> Piece {
    let mut chord = vec![0.0];
    for w in points.windows(2) {
        chord.push(chord[chord.len() - 1] + norm(sub(w[1], w[0])));
    }
    let coordinate = |i: usize| points.iter().map(|p| p[i]).collect::<Vec<f64>>();
    let (x, y) = (Spline::natural(&chord, &coordinate(0)), Spline::natural(&chord, &coordinate(1)));
    let (mut parameter, mut arc) = (vec![0.0], vec![0.0]);
    for w in chord.windows(2) {
        for k in 0..STEPS {
            let share = |k: usize| w[0] + (w[1] - w[0]) * k as f64 / STEPS as f64;
            let (a, b) = (share(k), share(k + 1));
            arc.push(arc[arc.len() - 1] + length_between(&x, &y, a, b));
            parameter.push(b);
        }
    }
    Piece::Smooth { x, y, parameter, arc }
}

/// Arc length between two close parameters, by three Gauss points.
fn length_between(x: &Spline, y: &Spline, a: f64, b: f64) -> f64 {
    use crate::math::hermite::{GAUSS_WEIGHTS, gauss_points};
    let speed = |t: f64| x.slope(t).hypot(y.slope(t));
    (b - a)
        * gauss_points()
            .into_iter()
            .zip(GAUSS_WEIGHTS)
            .map(|(g, w)| w * speed(a + g * (b - a)))
            .sum::<f64>()
}

/// Parameter at arc length `s`, by Newton's iteration from the step that contains it.
fn parameter_at(x: &Spline, y: &Spline, parameter: &[f64], arc: &[f64], s: f64) -> f64 {
    let i = arc.partition_point(|a| *a <= s).clamp(1, arc.len() - 1) - 1;
    let share = (s - arc[i]) / (arc[i + 1] - arc[i]);
    let mut t = parameter[i] + share * (parameter[i + 1] - parameter[i]);
    for _ in 0..4 {
        let miss = arc[i] + length_between(x, y, parameter[i], t) - s;
        t -= miss / x.slope(t).hypot(y.slope(t));
    }
    t
}

#[cfg(test)]
mod tests {
    use super::super::definition::{MaterialId, SectionId};
    use super::*;

    fn line(points: &[[f64; 2]], curve: Curve) -> CentreLine {
        let beam = Beam { curve, ..Beam::new("b", points, 1, MaterialId(0), SectionId(0)) };
        CentreLine::new(&beam).unwrap()
    }

    #[test]
    fn an_arc_passes_through_its_points() {
        let half = line(&[[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]], Curve::Arc);
        assert!((half.length() - std::f64::consts::PI).abs() < 1e-14);
        let (x, t) = half.pieces[0].at(0.5 * half.length());
        assert!(norm(sub(x, [0.0, 1.0])) < 1e-14 && norm(sub(t, [-1.0, 0.0])) < 1e-14);
        let back = line(&[[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0]], Curve::Arc);
        let (x, t) = back.pieces[0].at(0.0);
        assert!(norm(sub(x, [-1.0, 0.0])) < 1e-14 && norm(sub(t, [0.0, 1.0])) < 1e-14);
    }

    #[test]
    fn a_smooth_curve_is_measured_by_its_arc_length() {
        let points: Vec<[f64; 2]> = (0..=40)
            .map(|i| {
                let a = f64::from(i) * std::f64::consts::PI / 40.0;
                [a, a.sin()]
            })
            .collect();
        let sine = line(&points, Curve::Spline);
        // Length of one arch of the sine: 2 sqrt(2) E(1/2) = 3.8201977890 (an elliptic integral).
        assert!((sine.length() - 3.820_197_789).abs() < 1e-5);
        let (h, s) = (1e-4, 1.3);
        let (a, b) = (sine.pieces[0].at(s).0, sine.pieces[0].at(s + h).0);
        assert!((norm(sub(b, a)) / h - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_polyline_has_corners() {
        let l = line(&[[0.0, 0.0], [0.0, 2.0], [3.0, 2.0]], Curve::Polyline);
        assert_eq!((l.pieces.len(), l.length()), (2, 5.0));
        assert_eq!(l.position(3.0), [1.0, 2.0]);
    }
}
