//! Two things that can touch, one to one: a round one, the source, against a target of some shape.
//!
//! Every contact is made of such pairs: a disc against a beam, a point of a beam against a half-plane, the end of a wall against a
//! beam. The source has a centre and a radius; the target is where the gap is measured to.

use super::axis::AxisPoint;
use super::configuration::Configuration;
use super::row::Row;
use crate::math::vec2::{cross, scale};
use crate::model::Model;

/// A point that follows one node, or the two of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Centre {
    /// Position in the reference configuration \[m\].
    pub position: [f64; 2],
    /// Node, or node `a` of the element.
    pub node: usize,
    /// How it follows.
    pub hold: Hold,
}

/// What a point belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hold {
    /// A rigid body: its third degree of freedom is an angle. The point is off its centre by `offset`; that of a body that
    /// turns is its centre.
    Body { offset: [f64; 2] },
    /// A beam: shape functions and their slopes at the point, and the reference tangent there.
    Beam { shape: [f64; 4], slope: [f64; 4], tangent: [f64; 2] },
}

impl Centre {
    /// Displacement.
    pub fn displacement(&self, at: &Configuration) -> [f64; 2] {
        let a = at.node(self.node);
        match &self.hold {
            Hold::Body { .. } => [a[0], a[1]],
            Hold::Beam { shape, .. } => combine(shape, &a, &at.node(self.node + 1)),
        }
    }

    /// Position.
    pub fn place(&self, at: &Configuration) -> [f64; 2] {
        let u = self.displacement(at);
        [self.position[0] + u[0], self.position[1] + u[1]]
    }

    /// Adds a force at the point.
    pub fn add_force(&self, row: &mut Row, force: [f64; 2]) {
        match &self.hold {
            Hold::Body { offset } => {
                row.add(self.node, [force[0], force[1], cross(*offset, force), 0.0]);
            }
            Hold::Beam { shape, .. } => add_weighted(row, self.node, shape, force),
        }
    }

    /// Adds a force that does work on the derivative of the point along its axis; nothing on a body.
    pub fn add_slope(&self, row: &mut Row, force: [f64; 2]) {
        if let Hold::Beam { slope, .. } = &self.hold {
            add_weighted(row, self.node, slope, force);
        }
    }

    /// The node it follows, and the second one if it is on an element.
    pub fn nodes(&self) -> impl Iterator<Item = usize> {
        let more = usize::from(matches!(self.hold, Hold::Beam { .. }));
        self.node..=self.node + more
    }

    /// Adds a couple; on a beam, by the slopes of its tangent.
    pub fn add_couple(&self, row: &mut Row, couple: f64, at: &Configuration) {
        match &self.hold {
            Hold::Body { .. } => row.add(self.node, [0.0, 0.0, couple, 0.0]),
            Hold::Beam { slope, tangent, .. } => {
                let u = combine(slope, &at.node(self.node), &at.node(self.node + 1));
                let g = [tangent[0] + u[0], tangent[1] + u[1]];
                let a = g[0] * g[0] + g[1] * g[1];
                add_weighted(row, self.node, slope, scale(couple / a, [-g[1], g[0]]));
            }
        }
    }

    /// Adds a force that acts at a place `p`, off the point.
    pub fn add_force_at(&self, row: &mut Row, force: [f64; 2], p: [f64; 2], at: &Configuration) {
        let x = self.place(at);
        self.add_force(row, force);
        self.add_couple(row, cross([p[0] - x[0], p[1] - x[1]], force), at);
    }
}

fn combine(n: &[f64; 4], a: &[f64; 4], b: &[f64; 4]) -> [f64; 2] {
    [0, 1].map(|i| n[0] * a[i] + n[1] * a[2 + i] + n[2] * b[i] + n[3] * b[2 + i])
}

fn add_weighted(row: &mut Row, node: usize, n: &[f64; 4], force: [f64; 2]) {
    let on = |v: f64, s: f64| [v * force[0], v * force[1], s * force[0], s * force[1]];
    row.add(node, on(n[0], n[1]));
    row.add(node + 1, on(n[2], n[3]));
}

/// What a gap is measured to.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A material point, along a fixed direction: that of a guided projectile.
    Guided {
        /// The point.
        point: Centre,
        /// Unit vector from the point back to the projectile.
        normal: [f64; 2],
        /// Gap in the reference configuration \[m\].
        standoff: f64,
    },
    /// The rim of a disc.
    Round { centre: Centre },
    /// A straight line, with what lies behind it.
    Line { point: Centre, normal: [f64; 2] },
    /// A wall between two points, from either side.
    Segment { ends: [Centre; 2] },
    /// A face of a beam.
    Axis { beam: usize, skip: [usize; 2] },
}

/// A pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Its contact.
    pub contact: usize,
    /// What is round.
    pub source: Centre,
    /// What it touches.
    pub target: Target,
    /// Radii of both, but for the half depth of an axis \[m\].
    pub reach: f64,
    /// Of it, the target's own radius \[m\].
    pub target_radius: f64,
    /// Whether the ends of an axis are left to other pairs.
    pub skips_ends: bool,
    /// The obstacle among the two, if one is.
    pub obstacle: Option<usize>,
    /// Things that move: beams first, then bodies. Source and target.
    pub movers: [usize; 2],
    /// Which of the contact's two parties the source is.
    pub source_party: usize,
    /// Arc length of the source along its beam; NaN for a body \[m\].
    pub s: f64,
}

/// What a pair remembers: which side the source is on, and where it was nearest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Memory {
    /// Sign of the face it is on; zero where it may still go to either, beyond an end.
    pub side: f64,
    /// Where on the axis it was nearest.
    pub near: AxisPoint,
}

impl Pair {
    /// Distance of the source's centre from the target's middle where they touch \[m\].
    pub fn thickness(&self, model: &Model, memory: &Memory) -> f64 {
        let Target::Axis { beam, .. } = &self.target else { return self.reach };
        let element = model.beams[*beam].axis.get(memory.near.element);
        self.reach + element.map_or(0.0, |e| e.half_depth(memory.near.xi))
    }
}

impl Target {
    /// Whether it can be touched from two sides.
    pub fn has_sides(&self) -> bool {
        matches!(self, Self::Segment { .. } | Self::Axis { .. })
    }
}
