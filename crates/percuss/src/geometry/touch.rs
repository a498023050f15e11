//! Gap, normal and point of contact of a pair in a configuration (theory, page 8).
//!
//! The gap is signed by the previous side of the source: a source that has passed the axis is deep inside, not on the other side.

use super::Axes;
use super::axis::{Axis, AxisEnd, AxisPoint, ClosestPoint};
use super::configuration::Configuration;
use super::edge::{self, EdgeTouch};
use super::pair::{Carrier, Centre, Memory, Pair, Target, carried};
use super::row::Row;
use crate::math::vec2::{add, cross, dot, norm, rot90, scale, sub};

/// Below this distance of centre and axis the normal is that of the axis \[m\].
pub(super) const COINCIDENT: f64 = 1e-9;

/// Bound of the ratio of the initial length of a piece of an axis to its length under any realistic compression.
const LONGEST_WAY: f64 = 2.0;

/// A pair where it is nearest.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// Gap \[m\]; negative inside, infinite at an end that is left to other pairs.
    pub gap: f64,
    /// Distance of the surfaces \[m\].
    pub apart: f64,
    /// Unit normal, from target to source, shape (2) \[-\].
    pub normal: [f64; 2],
    /// Point of the target's axis that is nearest.
    pub closest: Centre,
    /// Position of the closest point, shape (2) \[m\].
    pub closest_place: [f64; 2],
    /// Distance of the target's surface from the closest point \[m\].
    pub radius: f64,
    /// History to be stored.
    pub memory: Memory,
    /// Arc length of the closest point along its beam; NaN elsewhere \[m\].
    pub s: f64,
    /// Rotation of the normal.
    pub bend: Bend,
}

/// Rotation of the normal with the motion of source and target.
#[derive(Clone, Copy, Debug)]
pub enum Bend {
    /// No rotation.
    Flat,
    /// About the closest point, at this signed distance.
    Round { distance: f64 },
    /// With the section at the end of an axis, at this signed distance.
    Edge { distance: f64 },
    /// The closest point slides along an axis.
    Curve {
        distance: f64,
        /// Tangent x' there, shape (2) \[-\].
        tangent: [f64; 2],
        /// Second derivative x'' there, shape (2) \[1/m\].
        bend: [f64; 2],
    },
}

/// Region of the search for the closest point of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SearchRegion {
    /// Everywhere.
    All,
    /// In the neighbourhood of where it was.
    Near,
}

impl Pair {
    /// Arc length of a contact along its beam; of two beams, along the first one \[m\].
    pub fn along(&self, touch: &Touch) -> f64 {
        let on_source = self.source_partner == 0 && !self.s.is_nan();
        if on_source || touch.s.is_nan() { self.s } else { touch.s }
    }

    /// Position along the target's face of the closest point \[m\]; NaN if it is independent of the motion: the indented body is a point of a beam,
    /// or the struck point of a guided projectile, or round.
    pub fn place_on_face(&self, touch: &Touch, at: &Configuration) -> f64 {
        let from = |start: &Centre| sub(touch.closest_place, start.place(at));
        match &self.target {
            _ if !self.s.is_nan() => f64::NAN,
            Target::Axis { .. } => touch.s,
            Target::Line { point, normal } => dot(tangent_of(*normal), from(point)),
            Target::Segment { ends } => norm(from(&ends[0])),
            Target::Guided { .. } | Target::Round { .. } => f64::NAN,
        }
    }

    /// The pair in a configuration; `None` if no part of the target can be in contact.
    pub fn touch(
        &self,
        axes: &impl Axes,
        at: &Configuration,
        memory: &Memory,
        reach: SearchRegion,
    ) -> Option<Touch> {
        if self.source.is_parted(at) {
            return None;
        }
        let moved = self.source.displacement(at);
        let y = add(self.source.position, moved);
        match &self.target {
            Target::Guided { point, .. } if point.is_parted(at) => None,
            Target::Guided { point, normal, standoff } => {
                let closest = point.displacement(at);
                let gap = standoff + dot(*normal, sub(moved, closest));
                Some(self.flat(*point, add(point.position, closest), *normal, gap, memory))
            }
            Target::Line { point, normal } => {
                let away = dot(*normal, sub(y, point.place(at)));
                let place = sub(y, scale(away, *normal));
                Some(self.flat(*point, place, *normal, away - self.reach, memory))
            }
            Target::Round { centre } => Some(self.round(*centre, 1.0, y, at, memory)),
            Target::Segment { ends } => Some(self.segment(ends, y, at, memory)),
            Target::Axis { beam, skip, ends } => {
                let axis = axis_of(axes, at, *beam, *skip, ends);
                let lost = at.is_parted(axis.elements[memory.near.element].node);
                let (closest, leapt_from) = match reach {
                    SearchRegion::Near if !lost => {
                        (axis.near(y, at, memory.near, memory.side), None)
                    }
                    _ => {
                        let found = axis.nearest(y, at, memory.near, memory.side)?;
                        (found.closest, found.leapt_from)
                    }
                };
                let side = leapt_from.map_or(memory.side, |from| {
                    // A point outside of one arm is outside of the other, for either direction of that one.
                    let [before, after] = [from, closest.point].map(|p| axis.side(y, at, p));
                    if before * memory.side < 0.0 { -after } else { after }
                });
                let known = Memory { side, ..*memory };
                Some(self.on_axis(&axis, &closest, y, at, &known))
            }
        }
    }

    /// Whether another place of the target is closer than the stored closest point.
    pub fn leaps(&self, axes: &impl Axes, at: &Configuration, memory: &Memory) -> bool {
        let Target::Axis { beam, skip, ends } = &self.target else { return false };
        let y = self.source.place(at);
        axis_of(axes, at, *beam, *skip, ends).has_nearer(y, at, memory.near, memory.side)
    }

    fn flat(
        &self,
        closest: Centre,
        closest_place: [f64; 2],
        normal: [f64; 2],
        gap: f64,
        memory: &Memory,
    ) -> Touch {
        let radius = self.target_radius;
        let (memory, s) = (*memory, f64::NAN);
        Touch {
            gap,
            apart: gap,
            normal,
            closest,
            closest_place,
            radius,
            memory,
            s,
            bend: Bend::Flat,
        }
    }

    fn round(
        &self,
        centre: Centre,
        sign: f64,
        y: [f64; 2],
        at: &Configuration,
        memory: &Memory,
    ) -> Touch {
        let closest_place = centre.place(at);
        let away = sub(y, closest_place);
        let distance = norm(away);
        let normal = if distance > 0.0 { scale(sign / distance, away) } else { [0.0, 1.0] };
        Touch {
            gap: sign * distance - self.reach,
            apart: distance - self.reach,
            normal,
            closest: centre,
            closest_place,
            radius: self.target_radius,
            memory: *memory,
            s: f64::NAN,
            bend: Bend::Round { distance: sign * distance },
        }
    }

    fn segment(
        &self,
        ends: &[Centre; 2],
        y: [f64; 2],
        at: &Configuration,
        memory: &Memory,
    ) -> Touch {
        let (a, b) = (ends[0].place(at), ends[1].place(at));
        let along = sub(b, a);
        let share = dot(sub(y, a), along) / dot(along, along);
        if !(0.0..=1.0).contains(&share) {
            let end = ends[usize::from(share > 1.0)];
            let open = Memory { side: 0.0, ..*memory };
            return self.round(end, 1.0, y, at, &open);
        }
        let left = scale(1.0 / norm(along), rot90(along));
        let height = dot(left, sub(y, a));
        let side = if memory.side == 0.0 { 1.0_f64.copysign(height) } else { memory.side };
        let gap = side * height - self.reach;
        let seen = Memory { side, ..*memory };
        self.flat(ends[0], sub(y, scale(height, left)), scale(side, left), gap, &seen)
    }

    fn on_axis(
        &self,
        axis: &Axis,
        closest: &ClosestPoint,
        y: [f64; 2],
        at: &Configuration,
        memory: &Memory,
    ) -> Touch {
        let ClosestPoint { point, placed } = *closest;
        let element = &axis.elements[point.element];
        let (tangent, closest_place) = (placed.tangent(point.xi), placed.position(point.xi));
        let away = sub(y, closest_place);
        let distance = norm(away);
        let seen = axis.side_of(away, &placed, at, point);
        let s = element.s + point.xi * element.length;
        if let Some(end) = axis.end_near(s)
            && (end.point == point || distance < element.half_depth(point.xi))
            && !axis.is_parted(end.point.element)
            && let Some(found) = edge::nearest(axis, end, closest, y, at, [memory.side, seen])
        {
            return self.on_edge(axis, end, &found, point);
        }
        // Beyond an end there are no sides; a known face does not change.
        let side = if seen == 0.0 || memory.side == 0.0 { seen } else { memory.side };
        let sign = if seen == 0.0 { 1.0 } else { side * seen };
        let normal = if distance > COINCIDENT {
            scale(sign / distance, away)
        } else {
            let side = if side == 0.0 { 1.0 } else { side };
            scale(side / norm(tangent), rot90(tangent))
        };
        let (distance, half_depth) = (sign * distance, element.half_depth(point.xi));
        let slides = point.xi > 0.0 && point.xi < 1.0;
        // The start of omitted elements is no end.
        let border = side == 0.0 && axis.is_border(point);
        let gap = distance - self.reach - half_depth;
        if gap < 0.0
            && seen != 0.0
            && let Some(end) = self.left_end(axis, s, gap)
        {
            let found = edge::section(axis, end, closest, y, at, side);
            if found.distance > gap {
                let touch = self.on_edge(axis, end, &found, point);
                return Touch { gap: found.distance, apart: found.distance, radius: 0.0, ..touch };
            }
        }
        Touch {
            gap: if border { f64::INFINITY } else { gap },
            apart: distance.abs() - self.reach - half_depth,
            normal,
            closest: centre_on(axis, point, [0.0; 2]),
            closest_place,
            radius: half_depth,
            memory: Memory { side, near: point },
            s,
            bend: if slides {
                Bend::Curve { distance, tangent, bend: placed.bend(point.xi) }
            } else {
                Bend::Round { distance }
            },
        }
    }

    /// The end whose cap belongs to other pairs, if the distance of the point at arc length `s` to it is about the depth of the gap: a source that
    /// moves from the cap between the faces starts with zero depth, and its depth is at most the distance from the section at which they begin.
    /// Otherwise the gap would jump there, from zero to its full depth.
    fn left_end<'a>(&self, axis: &'a Axis, s: f64, gap: f64) -> Option<&'a AxisEnd> {
        let left = |end: &&AxisEnd| {
            end.half_width == 0.0
                && (end.s - s).abs() < -LONGEST_WAY * gap
                && !axis.is_parted(end.point.element)
        };
        axis.ends.iter().filter(|_| self.skips_ends).find(left)
    }

    /// At the end of an axis, whose closest point is `near`.
    fn on_edge(&self, axis: &Axis, end: &AxisEnd, found: &EdgeTouch, near: AxisPoint) -> Touch {
        let apart = found.distance - self.reach - end.rounding;
        let left = found.corner && self.skips_ends && end.half_width == 0.0;
        let distance = found.distance;
        Touch {
            gap: if left { f64::INFINITY } else { apart },
            apart,
            normal: found.normal,
            closest: centre_on(axis, end.point, found.offset),
            closest_place: found.place,
            radius: end.rounding,
            memory: Memory { side: found.side, near },
            s: end.s,
            bend: if found.corner { Bend::Round { distance } } else { Bend::Edge { distance } },
        }
    }

    /// Gradient of the gap: the source moves along the normal, the target opposite to it.
    pub fn normal_row(&self, touch: &Touch, at: &Configuration) -> Row {
        let mut row = Row::default();
        let n = touch.normal;
        self.source.add_force(&mut row, n, at);
        touch.closest.add_force(&mut row, [-n[0], -n[1]], at);
        match &self.target {
            // The guide carries the couple of a force off the line of motion.
            Target::Guided { .. } => {
                let arm = sub(touch.closest_place, self.source.place(at));
                self.source.add_couple(&mut row, cross(arm, n), at);
            }
            // A closest point that is not a point of the body: the force acts at the closest point.
            Target::Line { point, .. } | Target::Segment { ends: [point, _] } => {
                let arm = sub(touch.closest_place, point.place(at));
                if touch.closest == *point {
                    touch.closest.add_couple(&mut row, -cross(arm, n), at);
                }
            }
            _ => {}
        }
        row
    }

    /// Row of the sliding velocity: a unit force along the tangent at the target's surface, on the source, and back on the target.
    pub fn tangent_row(&self, touch: &Touch, at: &Configuration) -> Row {
        let mut row = Row::default();
        let t = tangent_of(touch.normal);
        let surface = [0, 1].map(|i| touch.closest_place[i] + touch.radius * touch.normal[i]);
        self.source.add_force_at(&mut row, t, surface, at);
        touch.closest.add_force_at(&mut row, [-t[0], -t[1]], surface, at);
        row
    }
}

/// A point of an axis, or a point off it that moves with its section.
fn centre_on(axis: &Axis, point: AxisPoint, offset: [f64; 2]) -> Centre {
    let element = &axis.elements[point.element];
    let inside = element.inside();
    let (shape, slope) = (inside.axis(point.xi), inside.section(point.xi));
    let frames = [&axis.nodes[element.node], &axis.nodes[element.node + 1]];
    let reference = |n: &[f64; 4]| {
        [0, 1].map(|i| {
            n[0] * frames[0].position[i]
                + n[1] * frames[0].tangent[i]
                + n[2] * frames[1].position[i]
                + n[3] * frames[1].tangent[i]
        })
    };
    let (mut position, tangent) = (reference(&shape), reference(&slope));
    if offset != [0.0; 2] {
        position = add(position, carried(tangent, offset));
    }
    let carrier = Carrier::Beam { shape, slope, along: inside.along(point.xi), tangent, offset };
    Centre { position, node: element.node, carrier }
}

/// The axis of a beam with a surface.
fn axis_of<'a>(
    axes: &'a impl Axes,
    at: &Configuration<'a>,
    beam: usize,
    skip: [usize; 2],
    ends: &'a [AxisEnd; 2],
) -> Axis<'a> {
    let arc = at.arcs.get(beam).copied().unwrap_or(f64::INFINITY);
    Axis { nodes: axes.frames(), elements: axes.axis(beam), skip, ends, arc, parted: at.parted }
}

/// The tangent for a normal: rotated by -90 degrees.
pub fn tangent_of(normal: [f64; 2]) -> [f64; 2] {
    [normal[1], -normal[0]]
}
