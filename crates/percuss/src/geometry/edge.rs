//! End of the outline of a beam: a straight edge across the axis, its corners, and the surface between inclined faces.

use super::axis::{Axis, AxisEnd, ClosestPoint};
use super::configuration::Configuration;
use super::placed::Placed;
use crate::math::vec2::{add, dot, norm, rot90, scale, sub};

/// Part of an end that is closest to a point.
#[derive(Clone, Copy, Debug)]
pub struct EdgeTouch {
    /// Signed distance from it \[m\].
    pub distance: f64,
    /// Unit normal, shape (2) \[-\].
    pub normal: [f64; 2],
    /// The closest point, relative to the end of the axis along and across it, shape (2) \[m\].
    pub offset: [f64; 2],
    /// Its position, shape (2) \[m\].
    pub place: [f64; 2],
    /// The face it belongs to, as a sign; zero for the edge and its corners.
    pub side: f64,
    /// Whether it is a corner.
    pub corner: bool,
}

/// The part of an outline that is nearest, in the frame of the end.
enum Feature {
    /// The edge.
    Edge,
    /// A corner.
    Corner,
    /// The adjacent face, outside of all circles about the axis.
    Face,
}

/// The frame of an end: outward and across.
struct EndFrame {
    /// Place of the axis' end, shape (2) \[m\].
    origin: [f64; 2],
    /// Unit vector out of the beam, shape (2) \[-\].
    out: [f64; 2],
    /// Unit vector across the axis, shape (2) \[-\].
    across: [f64; 2],
}

impl EndFrame {
    /// At an end of an axis, whose closest point is `closest`.
    fn of(axis: &Axis, end: &AxisEnd, closest: &ClosestPoint, at: &Configuration) -> Self {
        if end.point.element == closest.point.element {
            return Self::new(end, &closest.placed);
        }
        Self::new(end, &axis.placed_end(end, at))
    }

    fn new(end: &AxisEnd, placed: &Placed) -> Self {
        let tangent = placed.section(end.point.xi);
        let tangent = scale(1.0 / norm(tangent), tangent);
        let origin = placed.position(end.point.xi);
        Self { origin, out: scale(end.out, tangent), across: rot90(tangent) }
    }

    fn vector(&self, [d, e]: [f64; 2]) -> [f64; 2] {
        add(scale(d, self.out), scale(e, self.across))
    }
}

/// The point of an end that is closest to `y`; `None` if it is on the faces of the axis. `closest` is the closest point of the axis, `beyond` is
/// true for `y` beyond its end, `side` is the face on the side of `y`.
pub fn nearest(
    axis: &Axis,
    end: &AxisEnd,
    closest: &ClosestPoint,
    y: [f64; 2],
    at: &Configuration,
    [side, seen]: [f64; 2],
) -> Option<EdgeTouch> {
    let frame = EndFrame::of(axis, end, closest, at);
    let away = sub(y, frame.origin);
    let (d, e) = (dot(away, frame.out), dot(away, frame.across));
    let (w, sign) = (end.half_width, 1.0_f64.copysign(e));
    // The face is inclined away from a thick end; its normal, and the position of the place along it beyond the corner.
    let (sine, cosine) = (end.lean, (1.0 - end.lean * end.lean).sqrt());
    let height = e.abs() * cosine - d * sine - w * cosine;
    let past = d * cosine + (e.abs() - w) * sine;
    let through = side * seen < 0.0;
    // An end that is rounded from face to face has no edge: a place straight ahead is equally close to its one corner.
    let feature = if d > 0.0 && w > 0.0 && e.abs() <= w {
        Feature::Edge
    } else if (past > 0.0 && (d > 0.0 || height > 0.0)) || seen == 0.0 {
        Feature::Corner
    } else if height < 0.0 && d > height && !through {
        Feature::Edge
    } else if end.lean > 0.0 && closest.point == end.point && !through {
        Feature::Face
    } else {
        return None;
    };
    let (distance, normal, local) = match feature {
        Feature::Edge => (d, [1.0, 0.0], [0.0, e]),
        Feature::Face => {
            let normal = [-sine, sign * cosine];
            (height, normal, sub([d, e], scale(height, normal)))
        }
        Feature::Corner => {
            let corner = [0.0, sign * w];
            let away = sub([d, e], corner);
            let distance = norm(away);
            let normal = if distance > 0.0 { scale(1.0 / distance, away) } else { [1.0, 0.0] };
            (distance, normal, corner)
        }
    };
    Some(EdgeTouch {
        distance,
        normal: frame.vector(normal),
        offset: [end.out * local[0], local[1]],
        place: add(frame.origin, frame.vector(local)),
        side: if matches!(feature, Feature::Face) { sign } else { 0.0 },
        corner: matches!(feature, Feature::Corner),
    })
}

/// The section at an end of an axis, as the closure of a beam whose cap belongs to other pairs; `side` is the face on the side of `y`.
pub fn section(
    axis: &Axis,
    end: &AxisEnd,
    closest: &ClosestPoint,
    y: [f64; 2],
    at: &Configuration,
    side: f64,
) -> EdgeTouch {
    let frame = EndFrame::of(axis, end, closest, at);
    let away = sub(y, frame.origin);
    let (distance, across) = (dot(away, frame.out), dot(away, frame.across));
    EdgeTouch {
        distance,
        normal: frame.out,
        offset: [0.0, across],
        place: add(frame.origin, scale(across, frame.across)),
        side,
        corner: false,
    }
}
