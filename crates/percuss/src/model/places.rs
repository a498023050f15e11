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

/// Places closer to an end than this share of the length are at it.
const SAME: f64 = 1e-9;
/// Forces across a beam to this share are across it.
const ACROSS: f64 = 1e-9;

/// Actions at a place of a beam that decide whether the axial force jumps there, and whether a plastic hinge may form.
enum Acts<'b> {
    /// The axial force jumps: a joint, of which this is the kind.
    Joint(JointKind),
    /// The axial force jumps: a spring or a mass.
    Along,
    /// The axial force jumps, and the moment has no peak: the end of a given strain.
    Strain,
    /// It does not jump, and the moment has no peak: the end of a foundation or of a distributed load.
    Across,
    /// A soft strike across or along the beam, which ends no span.
    Struck,
    /// A support, with its fixed components.
    Support(&'b SupportKind),
    /// A force, shape (2) \[N\], in the axes of the plane or, of a follower, along and across the beam.
    Force {
        /// The force, shape (2) \[N\].
        force: [f64; 2],
        /// Whether it follows the beam.
        follower: bool,
        /// Its moment \[N m\].
        moment: f64,
    },
}

/// Where along a beam an action makes the bending moment largest: a plastic hinge may form there.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Bends {
    Nowhere,
    /// Inside: forces.
    Inside,
    /// At its ends, too: moments.
    Anywhere,
}

impl Acts<'_> {
    /// Where it makes the bending moment largest.
    fn bends(&self) -> Bends {
        let with = |moment: bool| if moment { Bends::Anywhere } else { Bends::Inside };
        match self {
            Self::Across | Self::Strain => Bends::Nowhere,
            Self::Along | Self::Struck => Bends::Inside,
            Self::Joint(kind) => with(!matches!(kind, JointKind::Hinge)),
            Self::Support(kind) => with(holds_rotation(kind)),
            Self::Force { moment, .. } => with(*moment != 0.0),
        }
    }

    /// Whether the axial force jumps where the beam has this tangent.
    fn ends_span(&self, tangent: [f64; 2]) -> bool {
        match self {
            Self::Joint(_) | Self::Along | Self::Strain => true,
            Self::Across | Self::Struck => false,
            Self::Support(kind) => holds_along(kind, tangent),
            Self::Force { force, follower: true, .. } => force[0] != 0.0,
            Self::Force { force, follower: false, .. } => acts_along(*force, tangent),
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
            joint.between.iter().for_each(|at| places.add(at, Acts::Joint(joint.kind)));
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
        // A rigid strike has the mass of short elements, and its impulses would depend on them.
        let soft = |p: &&Projectile| matches!(p.kind, ProjectileKind::Elastic { .. });
        for projectile in builder.projectiles.iter().filter(soft) {
            places.add(&projectile.strikes, Acts::Struck);
        }
        builder.struck.iter().for_each(|at| places.add(at, Acts::Struck));
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
            LoadKind::Point { at, force, follower, moment } => {
                let (force, follower, moment) = (*force, *follower, *moment);
                self.add(at, Acts::Force { force, follower, moment });
            }
            // The strain jumps where given ones begin and end.
            LoadKind::Strain { beam, stretch, .. }
            | LoadKind::Temperature { beam, stretch, .. } => {
                stretch.iter().for_each(|along| self.add_at(*beam, *along, Acts::Strain));
            }
            LoadKind::Distributed { beam, stretch, .. } => {
                stretch.iter().for_each(|along| self.add_at(*beam, *along, Acts::Across));
            }
        }
    }

    /// Places of the beam of number `index`, in their order along it; without places that are only struck, unless they are asked for.
    pub fn of_beam(&self, index: usize, line: &CentreLine, struck: bool) -> Vec<BeamPlace> {
        let length = line.length();
        let place = |(along, acts): &(Along, Acts<'_>)| {
            let s = line.arc(*along);
            let inside = s > SAME * length && s < (1.0 - SAME) * length;
            let hinge = match acts.bends() {
                Bends::Nowhere => false,
                Bends::Inside => inside,
                Bends::Anywhere => true,
            };
            BeamPlace { s, ends_span: acts.ends_span(line.tangent(s)), hinge }
        };
        let wanted = |(_, acts): &&(Along, Acts<'_>)| struck || !matches!(acts, Acts::Struck);
        let mut found: Vec<BeamPlace> = self.of[index].iter().filter(wanted).map(place).collect();
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
        places.filter(move |s| *s > from && *s < to).map(|s| BeamPlace {
            s,
            ends_span: false,
            hinge: false,
        })
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

/// Whether a support bends the end of a beam that it holds.
fn holds_rotation(kind: &SupportKind) -> bool {
    match kind {
        SupportKind::Clamp => true,
        SupportKind::Pin | SupportKind::Roller { .. } | SupportKind::Stop { .. } => false,
        SupportKind::Fix { components } => components.contains(&Component::Rotation),
        SupportKind::Elastic { rotational_stiffness, rotational_damping, .. } => {
            *rotational_stiffness != 0.0 || *rotational_damping != 0.0
        }
    }
}
