//! Gap, normal and point of contact of a pair in a configuration (theory, section 6).
//!
//! The gap is signed by the side the source was on: what has gone through is deep inside, not on the other side.

use super::axis::{Axis, AxisPoint};
use super::configuration::Configuration;
use super::pair::{Centre, Hold, Memory, Pair, Target};
use super::placed::Placed;
use super::row::Row;
use crate::math::hermite;
use crate::math::vec2::{add, cross, dot, norm, rot90, scale, sub};
use crate::model::Model;

/// Below this distance of centre and axis the normal is that of the axis \[m\].
const COINCIDENT: f64 = 1e-9;

/// A pair where it is nearest.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// Gap \[m\]; negative inside, infinite at an end that is left to other pairs.
    pub gap: f64,
    /// How far the surfaces are apart \[m\].
    pub apart: f64,
    /// Unit normal, from target to source.
    pub normal: [f64; 2],
    /// Point of the target's axis that is nearest.
    pub foot: Centre,
    /// Position of the foot \[m\].
    pub foot_place: [f64; 2],
    /// Distance of the target's surface from the foot \[m\].
    pub radius: f64,
    /// What to remember.
    pub memory: Memory,
    /// Arc length of the foot along its beam; NaN elsewhere \[m\].
    pub s: f64,
    /// How the normal turns.
    pub bend: Bend,
}

/// How the normal turns as source and target move.
#[derive(Clone, Copy, Debug)]
pub enum Bend {
    /// Not at all.
    Flat,
    /// About the foot, at this signed distance.
    Round { distance: f64 },
    /// The foot slides along an axis.
    Curve { distance: f64, tangent: [f64; 2], bend: [f64; 2] },
}

/// Where the foot of an axis is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// Everywhere.
    All,
    /// In the neighbourhood of where it was.
    Near,
}

impl Pair {
    /// The pair in a configuration; `None` where nothing of the target can be touched.
    pub fn touch(
        &self,
        model: &Model,
        at: &Configuration,
        memory: &Memory,
        reach: Reach,
    ) -> Option<Touch> {
        let moved = self.source.displacement(at);
        let y = add(self.source.position, moved);
        match &self.target {
            Target::Guided { point, normal, standoff } => {
                let foot = point.displacement(at);
                let gap = standoff + dot(*normal, sub(moved, foot));
                Some(self.flat(*point, add(point.position, foot), *normal, gap, memory))
            }
            Target::Line { point, normal } => {
                let away = dot(*normal, sub(y, point.place(at)));
                let place = sub(y, scale(away, *normal));
                Some(self.flat(*point, place, *normal, away - self.reach, memory))
            }
            Target::Round { centre } => Some(self.round(*centre, 1.0, y, at, memory)),
            Target::Segment { ends } => Some(self.segment(ends, y, at, memory)),
            Target::Axis { beam, skip } => {
                let elements = &model.beams[*beam].axis;
                let arc = at.arcs.get(*beam).copied().unwrap_or(f64::INFINITY);
                let axis = Axis { nodes: &model.nodes, elements, skip: *skip, arc };
                let (point, leapt_from) = match reach {
                    Reach::All => {
                        let found = axis.nearest(y, at, memory.near, memory.side)?;
                        (found.point, found.leapt_from)
                    }
                    Reach::Near => (axis.near(y, at, memory.near, memory.side), None),
                };
                let side = leapt_from.map_or(memory.side, |from| {
                    // What was outside of one arm is outside of the other, whichever way that one runs.
                    let [before, after] = [from, point].map(|p| axis.side(y, at, p));
                    if before * memory.side < 0.0 { -after } else { after }
                });
                let known = Memory { side, ..*memory };
                let mut touch = self.on_axis(&axis, point, y, at, &known);
                if touch.memory.side == 0.0 && (self.skips_ends || axis.is_border(point)) {
                    touch.gap = f64::INFINITY;
                }
                Some(touch)
            }
        }
    }

    fn flat(
        &self,
        foot: Centre,
        foot_place: [f64; 2],
        normal: [f64; 2],
        gap: f64,
        memory: &Memory,
    ) -> Touch {
        let radius = self.target_radius;
        let (memory, s) = (*memory, f64::NAN);
        Touch { gap, apart: gap, normal, foot, foot_place, radius, memory, s, bend: Bend::Flat }
    }

    fn round(
        &self,
        centre: Centre,
        sign: f64,
        y: [f64; 2],
        at: &Configuration,
        memory: &Memory,
    ) -> Touch {
        let foot_place = centre.place(at);
        let away = sub(y, foot_place);
        let distance = norm(away);
        let normal = if distance > 0.0 { scale(sign / distance, away) } else { [0.0, 1.0] };
        Touch {
            gap: sign * distance - self.reach,
            apart: distance - self.reach,
            normal,
            foot: centre,
            foot_place,
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
        point: AxisPoint,
        y: [f64; 2],
        at: &Configuration,
        memory: &Memory,
    ) -> Touch {
        let element = &axis.elements[point.element];
        let placed = Placed::new(element, axis.nodes, at);
        let (tangent, foot_place) = (placed.tangent(point.xi), placed.position(point.xi));
        let away = sub(y, foot_place);
        let seen = axis.side_of(away, tangent, at, point);
        // Beyond an end there are no sides; a face once known stays known.
        let side = if seen == 0.0 || memory.side == 0.0 { seen } else { memory.side };
        let sign = if seen == 0.0 { 1.0 } else { side * seen };
        let distance = norm(away);
        let normal = if distance > COINCIDENT {
            scale(sign / distance, away)
        } else {
            let side = if side == 0.0 { 1.0 } else { side };
            scale(side / norm(tangent), rot90(tangent))
        };
        let shape = hermite::shape(point.xi, element.length);
        let slope = hermite::slope(point.xi, element.length);
        let frames = [&axis.nodes[element.node], &axis.nodes[element.node + 1]];
        let reference = |n: &[f64; 4]| {
            [0, 1].map(|i| {
                n[0] * frames[0].position[i]
                    + n[1] * frames[0].tangent[i]
                    + n[2] * frames[1].position[i]
                    + n[3] * frames[1].tangent[i]
            })
        };
        let hold = Hold::Beam { shape, slope, tangent: reference(&slope) };
        let (distance, half_depth) = (sign * distance, element.half_depth(point.xi));
        let slides = point.xi > 0.0 && point.xi < 1.0;
        Touch {
            gap: distance - self.reach - half_depth,
            apart: distance.abs() - self.reach - half_depth,
            normal,
            foot: Centre { position: reference(&shape), node: element.node, hold },
            foot_place,
            radius: half_depth,
            memory: Memory { side, near: point },
            s: element.s + point.xi * element.length,
            bend: if slides {
                Bend::Curve { distance, tangent, bend: placed.bend(point.xi) }
            } else {
                Bend::Round { distance }
            },
        }
    }

    /// Gradient of the gap: the source is pushed along the normal, the target back.
    pub fn normal_row(&self, touch: &Touch, at: &Configuration) -> Row {
        let mut row = Row::default();
        let n = touch.normal;
        self.source.add_force(&mut row, n);
        touch.foot.add_force(&mut row, [-n[0], -n[1]]);
        match &self.target {
            // The guide carries the couple of a force off the line of flight.
            Target::Guided { .. } => {
                let arm = sub(touch.foot_place, self.source.place(at));
                self.source.add_couple(&mut row, cross(arm, n), at);
            }
            // A foot that is not a point of the body: the force acts at the foot.
            Target::Line { point, .. } | Target::Segment { ends: [point, _] } => {
                let arm = sub(touch.foot_place, point.place(at));
                if touch.foot == *point {
                    touch.foot.add_couple(&mut row, -cross(arm, n), at);
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
        let surface = [0, 1].map(|i| touch.foot_place[i] + touch.radius * touch.normal[i]);
        self.source.add_force_at(&mut row, t, surface, at);
        touch.foot.add_force_at(&mut row, [-t[0], -t[1]], surface, at);
        row
    }

    /// Derivative of the gradient in the direction of increments of its nodes, as a form on them.
    pub fn turning(&self, touch: &Touch, nodal: &dyn Fn(usize) -> [f64; 4]) -> Row {
        let moved = |c: &Centre| match &c.hold {
            Hold::Body { .. } => {
                let a = nodal(c.node);
                [a[0], a[1]]
            }
            Hold::Beam { shape, .. } => weigh(shape, c.node, nodal),
        };
        let mut row = Row::default();
        let n = touch.normal;
        let drift = sub(moved(&self.source), moved(&touch.foot));
        match touch.bend {
            Bend::Flat => {}
            Bend::Round { distance } => {
                if distance.abs() > COINCIDENT {
                    let turn = scale(1.0 / distance, sub(drift, scale(dot(n, drift), n)));
                    self.source.add_force(&mut row, turn);
                    touch.foot.add_force(&mut row, [-turn[0], -turn[1]]);
                }
            }
            Bend::Curve { distance, tangent, bend } => {
                let Hold::Beam { shape, slope, .. } = &touch.foot.hold else { return row };
                let onward = weigh(slope, touch.foot.node, nodal);
                // Across the normal; on a tapered beam the tangent is not.
                let across = rot90(n);
                let level = dot(across, tangent);
                let slack = level * level - distance * dot(n, bend);
                if slack <= 1e-3 * level * level {
                    return row;
                }
                let slide = (level * dot(across, drift) + distance * dot(n, onward)) / slack;
                let turned = dot(n, [onward[0] + slide * bend[0], onward[1] + slide * bend[1]]);
                let turn = scale(-turned / level, across);
                self.source.add_force(&mut row, turn);
                let on = |v: f64, s: f64| {
                    let f = [0, 1].map(|i| -v * turn[i] - s * slide * n[i]);
                    [f[0], f[1]]
                };
                let curvature = [0, 1].map(|half| {
                    let (value, slope_of_value) = (
                        on(shape[2 * half], slope[2 * half]),
                        on(shape[2 * half + 1], slope[2 * half + 1]),
                    );
                    [value[0], value[1], slope_of_value[0], slope_of_value[1]]
                });
                row.add(touch.foot.node, curvature[0]);
                row.add(touch.foot.node + 1, curvature[1]);
            }
        }
        row
    }
}

fn weigh(n: &[f64; 4], node: usize, nodal: &dyn Fn(usize) -> [f64; 4]) -> [f64; 2] {
    let (a, b) = (nodal(node), nodal(node + 1));
    [0, 1].map(|i| n[0] * a[i] + n[1] * a[2 + i] + n[2] * b[i] + n[3] * b[2 + i])
}

/// The tangent that goes with a normal: turned by -90 degrees.
pub fn tangent_of(normal: [f64; 2]) -> [f64; 2] {
    [normal[1], -normal[0]]
}
