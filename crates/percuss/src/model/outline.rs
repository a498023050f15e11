//! The outline of a beam: its touching circles, and its surface.
//!
//! Faces are half a depth from the axis and end at the end of the beam, with a straight edge across or a half circle from face to face.

use super::Fault;
use super::builder::ModelBuilder;
use super::definition::Ends;
use super::frozen::{MaterialPoint, Model};
use super::material_points::point_at;
use crate::geometry::axis::{AxisEnd, LONGEST_CAP};
use crate::geometry::pair::{Carrier, Centre, Target, carried};
use crate::math::vec2::add;

/// Radius of the corners of a flat end against beams, as a share of half the depth there. Two sharp corners that face each other, as for axially
/// aligned bars, have no defined side of passing; arcs of circles always have a normal.
const CORNERS: f64 = 0.1;
/// Circles closer to an end than half a depth have this share of their distance from it as radius: they touch the faces, but no body that the end
/// reaches first with its corners. Otherwise the contact stiffness of a flat end with a wall would grow with the number of elements within half a
/// depth. Between beams these circles share the impact: axially aligned bars under a rigid law lose 4e-10 of their energy in the impact with the
/// corners alone, and less than 1e-10 with them.
const INSIDE: f64 = 0.5;
/// Places along a beam that differ by less than this share of its length are one.
const SAME: f64 = 1e-9;

/// The outline of a beam.
pub(super) struct BeamOutline<'a> {
    model: &'a Model,
    beam: usize,
    /// Start and end of its axis, shape (2).
    ends: [AxisEnd; 2],
    /// Largest radius of a circle towards an end, as a share of the distance to it.
    inside: f64,
}

/// A circle that moves with a section, by which a beam touches other bodies.
pub(super) struct Source {
    /// Its centre.
    pub centre: Centre,
    /// Its radius \[m\].
    pub radius: f64,
    /// Arc length along the beam \[m\].
    pub s: f64,
    /// Whether it belongs to an end of the beam.
    pub at_end: bool,
}

/// Beams too short for the half circles that are to end them.
pub(super) fn too_short(builder: &ModelBuilder, model: &Model) -> Vec<Fault> {
    let mut faults = Vec::new();
    for (given, data) in builder.beams.iter().zip(&model.beams) {
        let depths = [
            data.axis.first().map(|e| e.half_depths[0]),
            data.axis.last().map(|e| e.half_depths[1]),
        ];
        let most = depths.into_iter().flatten().fold(0.0, f64::max);
        let least = most / LONGEST_CAP;
        if given.ends == Ends::Round && data.length < least {
            let found =
                format!("round ends of {} m depth on a beam of {} m", 2.0 * most, data.length);
            let expected = format!("a length of {least:.4} m or more, or ends = \"flat\"");
            faults.push(Fault::new(format!("beam.{}.ends", given.name), found, expected));
        }
    }
    faults
}

impl<'a> BeamOutline<'a> {
    /// For contact with obstacles and discs.
    pub fn exact(builder: &ModelBuilder, model: &'a Model, beam: usize) -> Self {
        Self::new(builder, model, beam, 0.0)
    }

    /// For contact with beams: its corners are slightly rounded.
    pub fn rounded(builder: &ModelBuilder, model: &'a Model, beam: usize) -> Self {
        Self::new(builder, model, beam, CORNERS)
    }

    fn new(builder: &ModelBuilder, model: &'a Model, beam: usize, corners: f64) -> Self {
        let axis = &model.beams[beam].axis;
        let share = match builder.beams[beam].ends {
            Ends::Flat => corners,
            Ends::Round => 1.0,
        };
        let depths =
            [axis.first().map(|e| e.half_depths[0]), axis.last().map(|e| e.half_depths[1])];
        let ends = axis.ends(depths.map(|depth| share * depth.unwrap_or(0.0)));
        let inside = if corners > 0.0 { 1.0 } else { INSIDE };
        Self { model, beam, ends, inside }
    }

    /// Radii of the arcs that close it at both ends, shape (2) \[m\].
    pub fn roundings(&self) -> [f64; 2] {
        self.ends.each_ref().map(|end| end.rounding)
    }

    /// Its surface, which other bodies touch.
    pub fn target(&self, skip: [usize; 2]) -> Target {
        Target::Axis { beam: self.beam, skip, ends: self.ends }
    }

    /// Its touching circles: from face to face, evenly in each element; towards both ends smaller ones that stay within the outline, and the
    /// corners themselves.
    pub fn sources(&self, points: usize) -> Vec<Source> {
        let data = &self.model.beams[self.beam];
        let [first, last] = &self.ends;
        let slack = SAME * data.length;
        let mut out = Vec::new();
        self.add(first.s, [first.half_width, first.rounding], true, &mut out);
        for element in data.axis.iter() {
            for k in 0..points {
                let share = k as f64 / points as f64;
                let s = element.s + element.length * share;
                let inner = s > first.s + slack && s < last.s - slack;
                if !inner {
                    continue;
                }
                let half_depth = element.half_depth(share);
                let to_end = s.min(data.length - s);
                let radius = half_depth.min(self.inside * to_end);
                self.add(s, [half_depth - radius, radius], false, &mut out);
            }
        }
        self.add(last.s, [last.half_width, last.rounding], true, &mut out);
        out
    }

    /// The circles at a section: two off the axis, or one about it.
    fn add(&self, s: f64, [across, radius]: [f64; 2], at_end: bool, out: &mut Vec<Source>) {
        let on_axis = beam_centre(&point_at(self.model, self.beam, s));
        let sides: &[f64] = if across > 0.0 { &[1.0, -1.0] } else { &[0.0] };
        for side in sides {
            let mut centre = on_axis;
            if let Carrier::Beam { tangent, offset, .. } = &mut centre.carrier
                && *side != 0.0
            {
                *offset = [0.0, side * across];
                centre.position = add(centre.position, carried(*tangent, *offset));
            }
            out.push(Source { centre, radius, s, at_end });
        }
    }
}

pub(super) fn beam_centre(point: &MaterialPoint) -> Centre {
    let MaterialPoint { shape, slope, tangent, .. } = *point;
    let carrier = Carrier::Beam { shape, slope, along: slope, tangent, offset: [0.0; 2] };
    Centre { position: point.position, node: point.node, carrier }
}
