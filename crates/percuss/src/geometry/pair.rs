//! A pair of contact partners: a round one, the source, and a target of some shape.
//!
//! Every contact consists of such pairs: a disc against a beam, a point of a beam against a half-plane, the end of a wall against a beam. The
//! source has a centre and a radius; the gap is the distance to the target.

use serde::{Deserialize, Serialize};

use super::Axes;
use super::axis::{AxisEnd, AxisPoint};
use super::configuration::Configuration;
use super::row::{Row, Turning};
use crate::math::vec2::{add, cross, dot, norm, rot90, scale, sub};

/// A point that follows one node, or the two of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Centre {
    /// Position in the reference configuration, shape (2) \[m\].
    pub position: [f64; 2],
    /// Node, or node `a` of the element.
    pub node: usize,
    /// Motion of the point.
    pub carrier: Carrier,
}

/// Owner of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carrier {
    /// A rigid body: its third degree of freedom is an angle. The point is off its centre by `offset`; that of a body that
    /// turns is its centre.
    Body {
        /// From its centre to the point, shape (2) \[m\].
        offset: [f64; 2],
    },
    /// A beam: shape functions at a point of its axis and those of its section, whose direction in the reference is `tangent`. The point itself
    /// is off the axis by `offset`, along the normal of the section and across it, and turns with the section.
    Beam {
        /// Shape functions, on (u_a, u_a', u_b, u_b'), shape (4) \[-, m, -, m\].
        shape: [f64; 4],
        /// Coefficients of the direction of its section: of a slender beam their slopes, shape (4) \[1/m, -, 1/m, -\].
        slope: [f64; 4],
        /// Slopes of the shape functions, shape (4) \[1/m, -, 1/m, -\].
        along: [f64; 4],
        /// Reference tangent, shape (2) \[-\].
        tangent: [f64; 2],
        /// From the axis to the point, along it and across it, shape (2) \[m\].
        offset: [f64; 2],
    },
}

/// A section of a beam in a configuration.
struct PlacedSection<'a> {
    /// Slopes of the shape functions, on (u_a, u_a', u_b, u_b'), shape (4) \[1/m, -, 1/m, -\].
    slope: &'a [f64; 4],
    /// Unit tangent of the axis, shape (2) \[-\].
    tangent: [f64; 2],
    /// Unit normal of the axis, shape (2) \[-\].
    normal: [f64; 2],
    /// Length of the derivative due to the slopes.
    stretch: f64,
    /// From the axis to the point, shape (2) \[m\].
    arm: [f64; 2],
}

impl Centre {
    /// Displacement.
    pub fn displacement(&self, at: &Configuration) -> [f64; 2] {
        let a = at.node(self.node);
        match &self.carrier {
            Carrier::Body { .. } => [a[0], a[1]],
            Carrier::Beam { shape, slope, tangent, offset, .. } => {
                let b = at.node(self.node + 1);
                let moved = combine(shape, &a, &b);
                if *offset == [0.0; 2] {
                    return moved;
                }
                let now = add(*tangent, combine(slope, &a, &b));
                add(moved, sub(carried(now, *offset), carried(*tangent, *offset)))
            }
        }
    }

    /// Position.
    pub fn place(&self, at: &Configuration) -> [f64; 2] {
        let u = self.displacement(at);
        [self.position[0] + u[0], self.position[1] + u[1]]
    }

    /// Adds a force at the point.
    pub fn add_force(&self, row: &mut Row, force: [f64; 2], at: &Configuration) {
        match &self.carrier {
            Carrier::Body { offset } => {
                row.add(self.node, [force[0], force[1], cross(*offset, force), 0.0]);
            }
            Carrier::Beam { shape, .. } => {
                add_weighted(row, self.node, shape, force);
                if let Some(section) = self.section(at) {
                    section.add_turn(row, self.node, cross(section.arm, force));
                }
            }
        }
    }

    /// Adds a force at the point over the whole step of `at`: on the increment the row gives the point's displacement along the force exactly, for
    /// any rotation of its section.
    ///
    /// With unit tangents t0 and t1 of the axis, t1 - t0 = 2 (n . dg)/(|g0| + |g1|) n, where n is normal to t0 + t1 and dg the
    /// increment of the derivative g.
    pub fn add_force_over(&self, row: &mut Row, force: [f64; 2], at: &Configuration) {
        let Some(section) = self.section_over(at) else {
            return self.add_force(row, force, at);
        };
        if let Carrier::Beam { shape, .. } = &self.carrier {
            add_weighted(row, self.node, shape, force);
        }
        section.add_turn(row, self.node, cross(section.arm, force));
    }

    /// Whether it no longer belongs to a piece of a beam: its element has fractured, and at a node the adjacent one too.
    pub fn is_parted(&self, at: &Configuration) -> bool {
        let Carrier::Beam { shape, .. } = &self.carrier else { return false };
        if !at.is_parted(self.node) {
            return false;
        }
        if shape[0] == 1.0 {
            return self.node.checked_sub(1).is_none_or(|before| at.is_parted(before));
        }
        shape[2] != 1.0 || at.is_parted(self.node + 1)
    }

    /// Adds the turn of the section that the point is off the axis of.
    pub fn add_turn(&self, row: &mut Row, factor: f64, at: &Configuration) {
        if let Some(section) = self.section(at) {
            section.add_turn(row, self.node, factor);
        }
    }

    /// Second derivative of `force . place`; `None` for a point that is not off an axis.
    pub fn turning(&self, force: [f64; 2], at: &Configuration) -> Option<Turning> {
        let section = self.section(at)?;
        let mut forms = [Row::default(); 2];
        section.add_turn(&mut forms[0], self.node, 1.0);
        let along = scale(1.0 / section.stretch, section.tangent);
        add_weighted(&mut forms[1], self.node, section.slope, along);
        // The turn O of the derivative g changes by -2 O (x) (t . dg)/|g|; an arm r that turns by O has the second derivative -r.
        let mixed = -dot(force, rot90(section.arm));
        Some(Turning { forms, weights: [[-dot(force, section.arm), mixed], [mixed, 0.0]] })
    }

    /// Its section in the current configuration, if the point is off the axis.
    fn section(&self, at: &Configuration) -> Option<PlacedSection<'_>> {
        let Carrier::Beam { slope, tangent, offset, .. } = &self.carrier else { return None };
        if *offset == [0.0; 2] {
            return None;
        }
        let (a, b) = (at.node(self.node), at.node(self.node + 1));
        let g = add(*tangent, combine(slope, &a, &b));
        let stretch = norm(g);
        let tangent = scale(1.0 / stretch, g);
        let arm = carried(g, *offset);
        Some(PlacedSection { slope, tangent, normal: rot90(tangent), stretch, arm })
    }

    /// Its section between start and end of the step, if the point is off the axis.
    fn section_over(&self, at: &Configuration) -> Option<PlacedSection<'_>> {
        let [first, last] = [0.0, 1.0].map(|share| self.section(&at.at(share)));
        let (first, last) = (first?, last?);
        let along = add(first.tangent, last.tangent);
        let tangent = scale(1.0 / norm(along), along);
        let stretch = 0.5 * (first.stretch + last.stretch);
        let Carrier::Beam { offset, .. } = &self.carrier else { return None };
        let arm = carried(tangent, *offset);
        Some(PlacedSection { tangent, normal: rot90(tangent), stretch, arm, ..first })
    }

    /// Adds a force conjugate to the derivative of the point along its axis; zero on a body.
    pub fn add_slope(&self, row: &mut Row, force: [f64; 2]) {
        if let Carrier::Beam { along, .. } = &self.carrier {
            add_weighted(row, self.node, along, force);
        }
    }

    /// The node it follows, and the second one if it is on an element.
    pub fn nodes(&self) -> impl Iterator<Item = usize> {
        let more = usize::from(matches!(self.carrier, Carrier::Beam { .. }));
        self.node..=self.node + more
    }

    /// Adds a couple; on a beam, by the slopes of its tangent.
    pub fn add_couple(&self, row: &mut Row, couple: f64, at: &Configuration) {
        match &self.carrier {
            Carrier::Body { .. } => row.add(self.node, [0.0, 0.0, couple, 0.0]),
            Carrier::Beam { slope, tangent, .. } => {
                let u = combine(slope, &at.node(self.node), &at.node(self.node + 1));
                let g = add(*tangent, u);
                add_weighted(row, self.node, slope, scale(couple / dot(g, g), rot90(g)));
            }
        }
    }

    /// Adds a force that acts at a place `p`, off the point.
    pub fn add_force_at(&self, row: &mut Row, force: [f64; 2], p: [f64; 2], at: &Configuration) {
        let x = self.place(at);
        self.add_force(row, force, at);
        self.add_couple(row, cross([p[0] - x[0], p[1] - x[1]], force), at);
    }
}

impl PlacedSection<'_> {
    fn add_turn(&self, row: &mut Row, node: usize, factor: f64) {
        add_weighted(row, node, self.slope, scale(factor / self.stretch, self.normal));
    }
}

/// An offset along and across an axis whose derivative is `g`.
pub fn carried(g: [f64; 2], offset: [f64; 2]) -> [f64; 2] {
    let t = scale(1.0 / norm(g), g);
    add(scale(offset[0], t), scale(offset[1], rot90(t)))
}

fn combine(n: &[f64; 4], a: &[f64; 4], b: &[f64; 4]) -> [f64; 2] {
    [0, 1].map(|i| n[0] * a[i] + n[1] * a[2 + i] + n[2] * b[i] + n[3] * b[2 + i])
}

fn add_weighted(row: &mut Row, node: usize, n: &[f64; 4], force: [f64; 2]) {
    let on = |v: f64, s: f64| [v * force[0], v * force[1], s * force[0], s * force[1]];
    row.add(node, on(n[0], n[1]));
    row.add(node + 1, on(n[2], n[3]));
}

/// Target of a gap.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A material point, along a fixed direction: that of a guided projectile.
    Guided {
        /// The point.
        point: Centre,
        /// Unit vector from the point back to the projectile, shape (2) \[-\].
        normal: [f64; 2],
        /// Gap in the reference configuration \[m\].
        standoff: f64,
    },
    /// The rim of a disc.
    Round { centre: Centre },
    /// A straight line and the half-plane behind it.
    Line {
        point: Centre,
        /// Unit normal, away from the half-plane behind the line, shape (2) \[-\].
        normal: [f64; 2],
    },
    /// A wall between two points, from either side.
    Segment {
        /// Both ends, shape (2).
        ends: [Centre; 2],
    },
    /// The outline of a beam: faces at half a depth from its axis, and closures at both ends.
    Axis {
        beam: usize,
        /// Omitted elements: the first of them, and the first after them, shape (2) \[index of an element of the beam\].
        skip: [usize; 2],
        /// Start and end of the axis, shape (2).
        ends: [AxisEnd; 2],
    },
}

/// A pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Its contact.
    pub contact: usize,
    /// The round body.
    pub source: Centre,
    /// Its target.
    pub target: Target,
    /// Radii of both, but for the half depth of an axis \[m\].
    pub reach: f64,
    /// Radius of the target, a part of it \[m\].
    pub target_radius: f64,
    /// Whether ends of an axis that are points, or rounded from face to face, are left to other pairs.
    pub skips_ends: bool,
    /// The obstacle among the two, if one is.
    pub obstacle: Option<usize>,
    /// Movers, source and target: beams first, then bodies, shape (2) \[index of a mover\].
    pub movers: [usize; 2],
    /// Number of the source among the contact's two partners.
    pub source_partner: usize,
    /// Arc length of the source along its beam; NaN for a body \[m\].
    pub s: f64,
    /// Whether the source belongs to an end of its beam.
    pub at_end: bool,
}

/// History of a pair: the side of the source, and its last closest point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// Sign of the face it is on; zero where it may still go to either, beyond an end.
    pub side: f64,
    /// Last closest point on the axis.
    pub near: AxisPoint,
}

impl Pair {
    /// Distance of the source's centre from the target's middle where they touch \[m\].
    pub fn thickness(&self, axes: &impl Axes, memory: &Memory) -> f64 {
        let Some(beam) = self.target.beam() else { return self.reach };
        let element = axes.axis(beam).get(memory.near.element);
        self.reach + element.map_or(0.0, |e| e.half_depth(memory.near.xi))
    }
}

impl Target {
    /// Whether it is that of a guided projectile.
    pub fn is_guided(&self) -> bool {
        matches!(self, Self::Guided { .. })
    }

    /// Whether it is the rim of a disc.
    pub fn is_round(&self) -> bool {
        matches!(self, Self::Round { .. })
    }

    /// The beam whose outline it is, if it is one.
    pub fn beam(&self) -> Option<usize> {
        match self {
            Self::Axis { beam, .. } => Some(*beam),
            _ => None,
        }
    }

    /// Whether it is the outline of a beam.
    pub fn is_outline(&self) -> bool {
        self.beam().is_some()
    }

    /// Both ends of the wall that it is, if it is one.
    pub fn wall(&self) -> Option<&[Centre; 2]> {
        match self {
            Self::Segment { ends } => Some(ends),
            _ => None,
        }
    }

    /// Omits elements of a beam's outline: from the first of them up to the first after them.
    pub fn leave_out(&mut self, elements: [usize; 2]) {
        if let Self::Axis { skip, .. } = self {
            *skip = elements;
        }
    }

    /// Whether it can be touched from two sides.
    pub fn has_sides(&self) -> bool {
        matches!(self, Self::Segment { .. } | Self::Axis { .. })
    }
}
