//! Places along beams where a node has to stand: where something acts at a point, section forces jump.
//!
//! The slope of a beam's interpolation is continuous at its nodes, and with it the membrane strain. Where the axial force jumps
//! that is wrong to first order in the element's size: there spans end. At a station of a tapered section its constants have a kink,
//! which quadrature and faces within an element would round off.

use super::builder::ModelBuilder;
use super::centre_line::CentreLine;
use super::definition::*;
use crate::math::vec2::{dot, norm, rot90};

/// A place along a beam.
#[derive(Clone, Copy, Debug)]
pub struct BeamPlace {
    /// Arc length from the start of the beam \[m\].
    pub s: f64,
    /// Whether the axial force may jump there.
    pub ends_span: bool,
}

/// Forces across a beam to this share are across it.
const ACROSS: f64 = 1e-9;

/// Places of the beam of number `index`, in no order.
pub fn of_beam(builder: &ModelBuilder, index: usize, line: &CentreLine) -> Vec<BeamPlace> {
    let mut found = Vec::new();
    let mut add = |at: &PointRef, ends_span: &dyn Fn([f64; 2]) -> bool| {
        if at.beam.0 as usize == index {
            let s = line.arc(at.along);
            found.push(BeamPlace { s, ends_span: ends_span(line.tangent(s)) });
        }
    };
    for support in &builder.supports {
        add(&support.at, &|tangent| holds_along(&support.kind, tangent));
    }
    for joint in &builder.joints {
        joint.between.iter().for_each(|at| add(at, &|_| true));
    }
    for spring in &builder.springs {
        for anchor in &spring.between {
            if let Anchor::Point(at) = anchor {
                add(at, &|_| true);
            }
        }
    }
    for mass in &builder.masses {
        add(&mass.at, &|_| true);
    }
    for load in &builder.loads {
        match &load.kind {
            LoadKind::Gravity { .. } => {}
            LoadKind::Point { at, force, follower, .. } => {
                add(at, &|t| if *follower { force[0] != 0.0 } else { acts_along(*force, t) });
            }
            LoadKind::Distributed { beam, stretch, .. } => {
                for along in stretch {
                    add(&PointRef { label: String::new(), beam: *beam, along: *along }, &|_| false);
                }
            }
        }
    }
    found.extend(stations(builder, index, line));
    found
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
