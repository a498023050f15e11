//! Faults of discs, obstacles and contacts, and of contact laws.

use super::super::builder::ModelBuilder;
use super::super::definition::*;
use super::super::fault::Fault;
use super::beams::check_point;
use super::faults::{Faults, quantity};
use super::functions::check_function;
use crate::math::vec2::{cross, dot, norm, scale, sub};
use crate::model::TimeFunction;

pub(super) fn check_disc(disc: &Disc, out: &mut Faults) {
    let path = |field: &str| format!("disc.{}.{field}", disc.name);
    out.positive(path("mass"), disc.mass, "a mass", "kg");
    out.not_negative(path("radius"), disc.radius, "a radius", "m");
    if let Some(inertia) = disc.inertia {
        out.positive(path("inertia"), inertia, "a moment of inertia", "kg*m^2");
    }
    out.finite(path("position"), &disc.position, "m");
    out.finite(path("velocity"), &disc.velocity, "m/s");
    out.finite(path("spin"), &[disc.spin], "rad/s");
}

pub(super) fn check_obstacle(model: &ModelBuilder, obstacle: &Obstacle, out: &mut Faults) {
    let path = |field: &str| format!("obstacle.{}.{field}", obstacle.name);
    match &obstacle.shape {
        ObstacleShape::HalfPlane { point, normal } => {
            out.finite(path("point"), point, "m");
            if !(norm(*normal) > 0.0 && norm(*normal).is_finite()) {
                let found = format!("[{}, {}]", normal[0], normal[1]);
                out.add(path("normal"), found, "the outward normal");
            }
        }
        ObstacleShape::Disc { centre, radius } => {
            out.finite(path("centre"), centre, "m");
            out.positive(path("radius"), *radius, "a radius", "m");
        }
        ObstacleShape::Segment { ends, thickness } => {
            out.finite(path("ends"), ends.as_flattened(), "m");
            out.not_negative(path("thickness"), *thickness, "a thickness", "m");
            if ends[0] == ends[1] {
                out.add(path("ends"), "two ends at the same place", "ends that are apart");
            }
        }
        ObstacleShape::Clearance { at, width, gap, .. } => {
            check_point(model, at, path("at"), out);
            out.positive(path("width"), *width, "a width", "m");
            out.not_negative(path("gap"), *gap, "a gap", "m");
        }
    }
    if let Some(motion) = &obstacle.motion {
        out.finite(path("motion.displacement"), &motion.displacement, "m");
        check_function(&motion.function, path("motion.function"), out);
        if motion.rotation != 0.0 {
            let found = quantity(motion.rotation, "rad");
            out.add(path("motion.rotation"), found, "no rotation: obstacles do not turn");
        }
    }
    let touched = |c: &Contact| {
        c.between.iter().any(|partner| match partner {
            ContactPartner::Obstacle(id) => {
                model.obstacles.get(id.0 as usize).is_some_and(|o| o.name == obstacle.name)
            }
            _ => false,
        })
    };
    if !model.contacts.iter().any(touched) {
        let path = format!("obstacle.{}", obstacle.name);
        out.add(path, Fault::UNTOUCHED, "a contact between it and a beam or a projectile");
    }
}

pub(super) fn check_contact(model: &ModelBuilder, contact: &Contact, out: &mut Faults) {
    let path = |field: &str| format!("contact.{}.{field}", contact.name);
    for partner in contact.between {
        let known = match partner {
            ContactPartner::Disc(id) => (id.0 as usize) < model.discs.len(),
            ContactPartner::Beam(id) => (id.0 as usize) < model.beams.len(),
            ContactPartner::Obstacle(id) => (id.0 as usize) < model.obstacles.len(),
        };
        if !known {
            let expected = "beams, discs and obstacles of this model";
            out.add(path("between"), "an unknown name", expected);
        }
    }
    match contact.between {
        [ContactPartner::Obstacle(_), ContactPartner::Obstacle(_)] => {
            let expected = "a beam or a projectile, and another body";
            out.add(path("between"), "two fixed obstacles", expected);
        }
        [ContactPartner::Disc(a), ContactPartner::Disc(b)] if a == b => {
            out.add(path("between"), "a disc and itself", "two different bodies");
        }
        [one, other] => check_thickness(model, [one, other], path("between"), out),
    }
    if !(1..=100).contains(&contact.points_per_element) {
        let found = contact.points_per_element.to_string();
        out.add(path("points_per_element"), found, "from 1 to 100 points");
    }
    match &contact.law {
        TouchLaw::Smooth(law) => check_smooth(law, &path, out),
        TouchLaw::Rigid(law) => {
            check_rigid(law, &path, out);
            check_jumps(model, contact, out);
        }
    }
}

/// Two partners that end in points pass through each other in axial motion: only one path leads from one point to another. Two points, and two
/// beams, are rejected in any case; a partner with a side only if the other is exactly in front of its end.
fn check_thickness(
    model: &ModelBuilder,
    between: [ContactPartner; 2],
    path: String,
    out: &mut Faults,
) {
    let [Some(one), Some(other)] = between.map(|partner| bare(model, partner)) else { return };
    if !meets_end_on(model, between) {
        return;
    }
    let (both, cure) = if between[0] == between[1] {
        (format!("{} and itself", one.0), one.2.to_owned())
    } else if one == other {
        (format!("two {}", one.1), format!("{} for one of them", one.2))
    } else {
        (format!("{} and {}", one.0, other.0), format!("{}, or {}", one.2, other.2))
    };
    out.add(path, format!("{both}: end-to-end contact needs a depth or radius"), &cure);
}

/// Whether two bare things can meet in no other way, or will as they are placed.
fn meets_end_on(model: &ModelBuilder, between: [ContactPartner; 2]) -> bool {
    match between {
        [ContactPartner::Disc(disc), other] | [other, ContactPartner::Disc(disc)] => match other {
            ContactPartner::Disc(_) => true,
            ContactPartner::Beam(_) | ContactPartner::Obstacle(_) => {
                let at = model.discs.get(disc.0 as usize).map_or([f64::NAN; 2], |d| d.position);
                ends_of(model, other).iter().any(|end| is_right_before(at, end))
            }
        },
        [ContactPartner::Beam(_), ContactPartner::Beam(_)] => true,
        [one, other] => {
            let (one, other) = (ends_of(model, one), ends_of(model, other));
            one.iter().any(|a| other.iter().any(|b| is_right_before(a[0], b)))
        }
    }
}

/// Ends of a beam or a wall: place, and direction out of it.
fn ends_of(model: &ModelBuilder, partner: ContactPartner) -> Vec<[[f64; 2]; 2]> {
    match partner {
        ContactPartner::Beam(id) => {
            let Some(beam) = model.beams.get(id.0 as usize) else { return Vec::new() };
            let end = |fraction: f64| beam.line_point(Along::Fraction(fraction));
            let (start, last) = (end(0.0), end(1.0));
            let start = start.map(|p| [p.position, scale(-1.0, p.tangent)]);
            start.into_iter().chain(last.map(|p| [p.position, p.tangent])).collect()
        }
        ContactPartner::Obstacle(id) => {
            match model.obstacles.get(id.0 as usize).map(|o| &o.shape) {
                Some(ObstacleShape::Segment { ends: [a, b], .. }) => {
                    vec![[*a, sub(*a, *b)], [*b, sub(*b, *a)]]
                }
                _ => Vec::new(),
            }
        }
        ContactPartner::Disc(_) => Vec::new(),
    }
}

/// Whether a point is on the straight continuation of an end.
fn is_right_before(at: [f64; 2], [end, out]: &[[f64; 2]; 2]) -> bool {
    let away = sub(at, *end);
    dot(away, *out) > 0.0 && cross(*out, away).abs() <= 1e-9 * norm(*out) * norm(away)
}

/// Singular and plural names of a partner that ends in a point, and the property that would give it an extent there; `None` for all others.
fn bare(
    model: &ModelBuilder,
    partner: ContactPartner,
) -> Option<(&'static str, &'static str, &'static str)> {
    match partner {
        ContactPartner::Beam(id) => {
            let beam = model.beams.get(id.0 as usize)?;
            let cure = "a section with a `depth`, such as sqrt(12 I/A)";
            ends_bare(model, beam).then_some((
                "a beam whose end has no depth",
                "beams whose ends have no depth",
                cure,
            ))
        }
        ContactPartner::Disc(id) => {
            let disc = model.discs.get(id.0 as usize)?;
            let words = ("a disc of radius 0", "discs of radius 0", "a `radius` of the disc");
            (disc.radius == 0.0).then_some(words)
        }
        // A clearance is beside its beam.
        ContactPartner::Obstacle(id) => match model.obstacles.get(id.0 as usize)?.shape {
            ObstacleShape::Segment { thickness: 0.0, .. } => {
                Some(("a wall of thickness 0", "walls of thickness 0", "a `thickness` of the wall"))
            }
            _ => None,
        },
    }
}

/// Whether a beam has no depth at its start or at its end.
fn ends_bare(model: &ModelBuilder, beam: &Beam) -> bool {
    let last = beam.changes.iter().rev().find_map(|change| change.section);
    let ends = [(beam.section, 0.0), (last.unwrap_or(beam.section), 1.0)];
    let deep = |(id, fraction): (SectionId, f64)| {
        let section = model.sections.get(id.0 as usize);
        section.is_none_or(|section| section.at(fraction).depth.is_some_and(|depth| depth > 0.0))
    };
    !ends.into_iter().all(deep)
}

/// Impacts of rigid things follow from velocities, and a jump has none.
fn check_jumps(model: &ModelBuilder, contact: &Contact, out: &mut Faults) {
    for partner in contact.between {
        let ContactPartner::Obstacle(id) = partner else { continue };
        let Some(obstacle) = model.obstacles.get(id.0 as usize) else { continue };
        let function = obstacle.motion.as_ref().map(|m| &m.function);
        if let Some(TimeFunction::Step { at }) = function
            && *at > 0.0
        {
            let path = format!("obstacle.{}.motion.function", obstacle.name);
            let found = format!("a jump at {at} s, against the rigid contact `{}`", contact.name);
            let expected = "a motion with a velocity, such as a ramp, or a smooth law of contact";
            out.add(path, found, expected);
        }
    }
}

pub(super) fn check_smooth(law: &SmoothLaw, path: &impl Fn(&str) -> String, out: &mut Faults) {
    match &law.potential {
        Potential::Linear { stiffness } => {
            out.positive(path("stiffness"), *stiffness, "a stiffness", "N/m");
        }
        Potential::Hertz { stiffness } => {
            out.positive(path("stiffness"), *stiffness, "a Hertz stiffness", "N/m^1.5");
        }
        Potential::Table { penetration, force } => check_table(penetration, force, path, out),
        Potential::Function(own) => check_given(own, path, out),
    }
    out.not_negative(path("dissipation"), law.dissipation, "a factor", "s/m");
    check_unloading(law, path, out);
    if law.dissipation > 0.0 && law.force == ContactForce::Midpoint {
        let found = "dissipation with the force in the middle of the step";
        out.add(path("force"), found, "an energy-conserving force");
    }
}

/// The line of unloading of a law with crushing is no less steep than any part of its curve: energy would be created there.
fn check_unloading(law: &SmoothLaw, path: &impl Fn(&str) -> String, out: &mut Faults) {
    let Some(slope) = law.unloading else { return };
    if law.force == ContactForce::Midpoint {
        let found = "a contact that crushes with the force in the middle of the step";
        return out.add(path("force"), found, "an energy-conserving force");
    }
    let steepest = match &law.potential {
        Potential::Linear { stiffness } => *stiffness,
        Potential::Table { penetration, force } => {
            let slopes = penetration.windows(2).zip(force.windows(2));
            slopes.map(|(p, f)| (f[1] - f[0]) / (p[1] - p[0])).fold(0.0, f64::max)
        }
        Potential::Hertz { .. } | Potential::Function(_) => {
            let expected =
                "a linear law or a table: only of these is it known how steep they become";
            return out.add(
                path("unloading_stiffness"),
                "a law that becomes ever steeper",
                expected,
            );
        }
    };
    if !(slope.is_finite() && slope >= steepest && slope > 0.0) {
        let expected =
            format!("a stiffness of at least {steepest} N/m, the steepest part of the law");
        out.add(path("unloading_stiffness"), format!("{slope} N/m"), &expected);
    }
}

/// Penetrations at which functions are evaluated \[m\]; the widths of the differences there, and the accepted difference between these and the
/// force, relative. Enough to detect a wrong sign or factor, coarse enough for steep laws with kinks and few digits.
const LOOKED_AT: [f64; 3] = [1e-5, 1e-4, 1e-3];
const WIDTH: f64 = 0.02;
const SLOPE_ERROR: f64 = 0.1;

/// Whether a force given as code is that of its potential, and no pull.
fn check_given(law: &PotentialFunction, path: &impl Fn(&str) -> String, out: &mut Faults) {
    let expected =
        "a force of zero at no penetration, never a pull, and the derivative of the energy";
    let (energy, force) = (&law.energy, &law.force);
    let at_rest = force(0.0);
    if at_rest != 0.0 {
        return out.add(path("law"), format!("a force of {at_rest} N at no penetration"), expected);
    }
    for p in LOOKED_AT {
        let e = WIDTH * p;
        let slope = (energy(p + e) - energy(p - e)) / (2.0 * e);
        let rounding = 8.0 * f64::EPSILON * energy(p).abs() / e;
        let near = (force(p) - slope).abs() <= SLOPE_ERROR * force(p).abs() + rounding;
        if !(near && force(p) >= 0.0) {
            let found =
                format!("at {p} m a force of {} N and an energy of slope {slope} N", force(p));
            return out.add(path("law"), found, expected);
        }
    }
}

fn check_table(
    penetration: &[f64],
    force: &[f64],
    path: &impl Fn(&str) -> String,
    out: &mut Faults,
) {
    if penetration.len() != force.len() || penetration.len() < 2 {
        let found = format!("{} penetrations and {} forces", penetration.len(), force.len());
        let expected = "at least two penetrations, and as many forces";
        return out.add(path("penetration"), found, expected);
    }
    out.finite(path("penetration"), penetration, "m");
    out.finite(path("force"), force, "N");
    if penetration[0] != 0.0 || force[0] != 0.0 {
        let found = format!("a start at {} m and {} N", penetration[0], force[0]);
        out.add(path("penetration"), found, "a start at 0 m and 0 N");
    }
    if let Some(w) = penetration.windows(2).find(|w| w[1] <= w[0]) {
        let found = format!("{} m after {} m", w[1], w[0]);
        out.add(path("penetration"), found, "penetrations that increase");
    }
    if let Some(w) = force.windows(2).find(|w| w[1] < w[0]) {
        let found = format!("{} N after {} N", w[1], w[0]);
        out.add(path("force"), found, "forces that never fall");
    }
}

fn check_rigid(law: &RigidLaw, path: &impl Fn(&str) -> String, out: &mut Faults) {
    let coefficients =
        [("restitution", law.restitution), ("tangential_restitution", law.tangential_restitution)];
    for (field, value) in coefficients {
        if !(0.0..=1.0).contains(&value) {
            out.add(path(field), quantity(value, ""), "a coefficient from 0 to 1");
        }
    }
    out.not_negative(path("friction"), law.friction, "a coefficient of friction", "");
    if law.tangential_restitution > 0.0 && law.friction == 0.0 {
        let found = "tangential restitution without friction";
        out.add(path("tangential_restitution"), found, "friction that can carry it");
    }
}
