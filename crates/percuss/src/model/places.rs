//! Places along beams that require a node: at points of action section forces jump.
//!
//! The slope of a beam's interpolation is continuous at its nodes, and with it the membrane strain. Where the axial force jumps
//! that is wrong to first order in the element's size: there spans end. At a station of a tapered section its constants have a kink,
//! which quadrature and faces within an element would round off.

use super::builder::ModelBuilder;
use super::centre_line::CentreLine;
use super::definition::*;
use super::mesh::BeamPlace;
use crate::math::vec2::{dot, norm, rot90};

/// Forces across a beam to this share are across it.
const ACROSS: f64 = 1e-9;

/// Actions at a place of a beam that decide whether the axial force jumps there.
enum Acts<'b> {
    /// It jumps.
    Along,
    /// It does not jump.
    Across,
    /// A support, with its fixed components.
    Support(&'b SupportKind),
    /// A force, shape (2) \[N\], in the axes of the plane or, of a follower, along and across the beam.
    Force {
        /// The force, shape (2) \[N\].
        force: [f64; 2],
        /// Whether it follows the beam.
        follower: bool,
    },
}

impl Acts<'_> {
    /// Whether the axial force jumps where the beam has this tangent.
    fn ends_span(&self, tangent: [f64; 2]) -> bool {
        match self {
            Self::Along => true,
            Self::Across => false,
            Self::Support(kind) => holds_along(kind, tangent),
            Self::Force { force, follower: true } => force[0] != 0.0,
            Self::Force { force, follower: false } => acts_along(*force, tangent),
        }
    }
}

/// Actions at places of each beam: determined once, since every definition names its beams.
pub struct Places<'b> {
    builder: &'b ModelBuilder,
    /// By beam, in the order of the definitions, shape (beams, places of a beam).
    of: Vec<Vec<(Along, Acts<'b>)>>,
}

impl<'b> Places<'b> {
    /// Goes through all definitions.
    pub fn new(builder: &'b ModelBuilder) -> Self {
        let of = std::iter::repeat_with(Vec::new).take(builder.beams.len()).collect();
        let mut places = Self { builder, of };
        for support in &builder.supports {
            places.add(&support.at, Acts::Support(&support.kind));
        }
        for joint in &builder.joints {
            joint.between.iter().for_each(|at| places.add(at, Acts::Along));
        }
        for spring in &builder.springs {
            for anchor in &spring.between {
                if let Anchor::Point(at) = anchor {
                    places.add(at, Acts::Along);
                }
            }
        }
        for foundation in &builder.foundations {
            for along in foundation.stretch {
                places.add_at(foundation.beam, along, Acts::Across);
            }
        }
        for mass in &builder.masses {
            places.add(&mass.at, Acts::Along);
        }
        builder.loads.iter().for_each(|load| places.add_load(&load.kind));
        places
    }

    fn add(&mut self, at: &PointRef, acts: Acts<'b>) {
        self.add_at(at.beam, at.along, acts);
    }

    fn add_at(&mut self, beam: BeamId, along: Along, acts: Acts<'b>) {
        if let Some(own) = self.of.get_mut(beam.0 as usize) {
            own.push((along, acts));
        }
    }

    fn add_load(&mut self, load: &LoadKind) {
        match load {
            LoadKind::Gravity { .. } | LoadKind::Base { .. } => {}
            LoadKind::Point { at, force, follower, .. } => {
                self.add(at, Acts::Force { force: *force, follower: *follower });
            }
            // The strain jumps where given ones begin and end.
            LoadKind::Strain { beam, stretch, .. }
            | LoadKind::Temperature { beam, stretch, .. } => {
                stretch.iter().for_each(|along| self.add_at(*beam, *along, Acts::Along));
            }
            LoadKind::Distributed { beam, stretch, .. } => {
                stretch.iter().for_each(|along| self.add_at(*beam, *along, Acts::Across));
            }
        }
    }

    /// Places of the beam of number `index`, in their order along it.
    pub fn of_beam(&self, index: usize, line: &CentreLine) -> Vec<BeamPlace> {
        let place = |(along, acts): &(Along, Acts<'_>)| {
            let s = line.arc(*along);
            BeamPlace { s, ends_span: acts.ends_span(line.tangent(s)) }
        };
        let mut found: Vec<BeamPlace> = self.of[index].iter().map(place).collect();
        found.extend(stations(self.builder, index, line));
        found.sort_by(|a, b| a.s.total_cmp(&b.s));
        found
    }
}

/// Stations of tapered sections on the parts of the beam that have them.
fn stations<'a>(
    builder: &'a ModelBuilder,
    index: usize,
    line: &'a CentreLine,
) -> impl Iterator<Item = BeamPlace> + 'a {
    let beam = &builder.beams[index];
    let parts = std::iter::once((0.0, beam.section))
        .chain(beam.changes.iter().filter_map(|c| c.section.map(|s| (line.arc(c.at), s))));
    let ends = beam.changes.iter().filter(|c| c.section.is_some()).map(|c| line.arc(c.at));
    parts.zip(ends.chain([line.length()])).flat_map(move |((from, id), to)| {
        let stations = &builder.sections[id.0 as usize].stations;
        let places = stations.iter().map(move |station| line.arc(Along::Fraction(station.at)));
        places.filter(move |s| *s > from && *s < to).map(|s| BeamPlace { s, ends_span: false })
    })
}

fn acts_along(force: [f64; 2], tangent: [f64; 2]) -> bool {
    dot(force, tangent).abs() > ACROSS * norm(force)
}

fn holds_along(kind: &SupportKind, tangent: [f64; 2]) -> bool {
    match kind {
        SupportKind::Clamp | SupportKind::Pin => true,
        SupportKind::Roller { direction } => acts_along(rot90(*direction), tangent),
        SupportKind::Fix { components } => components.iter().any(|c| match c {
            Component::Displacement1 => acts_along([1.0, 0.0], tangent),
            Component::Displacement2 => acts_along([0.0, 1.0], tangent),
            Component::Rotation | Component::Stretch => false,
        }),
        SupportKind::Elastic { direction, stiffness, damping, .. } => {
            let acts = |k: usize, axis| {
                (stiffness[k] != 0.0 || damping[k] != 0.0) && acts_along(axis, tangent)
            };
            acts(0, *direction) || acts(1, rot90(*direction))
        }
        SupportKind::Stop { direction, .. } => acts_along(*direction, tangent),
    }
}
