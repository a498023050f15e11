//! Every fault of a set of definitions, found at once.

use super::builder::ModelBuilder;
use super::definition::*;
use super::fault::Fault;
use crate::math::vec2::{cross, dot, norm, sub};

/// Collects faults; each check says what was found and what would be right.
#[derive(Default)]
struct Faults(Vec<Fault>);

impl Faults {
    fn add(&mut self, path: String, found: impl Into<String>, expected: &str) {
        self.0.push(Fault::new(path, found, expected));
    }

    fn positive(&mut self, path: String, value: f64, what: &str, unit: &str) {
        if !(value > 0.0 && value.is_finite()) {
            self.add(path, quantity(value, unit), &format!("{what} above zero"));
        }
    }

    fn finite(&mut self, path: String, values: &[f64], unit: &str) {
        if let Some(bad) = values.iter().find(|v| !v.is_finite()) {
            self.add(path, quantity(*bad, unit), "finite numbers");
        }
    }
}

fn quantity(value: f64, unit: &str) -> String {
    if unit.is_empty() { format!("{value}") } else { format!("{value} {unit}") }
}

/// All faults of the definitions, in the order of the definitions.
pub(super) fn faults(model: &ModelBuilder) -> Vec<Fault> {
    let mut out = Faults::default();
    names(model, &mut out);
    for m in &model.materials {
        let path = |field: &str| format!("material.{}.{field}", m.name);
        out.positive(path("young"), m.young, "a Young's modulus", "Pa");
        out.positive(path("density"), m.density, "a density", "kg/m^3");
    }
    for s in &model.sections {
        let path = |field: &str| format!("section.{}.{field}", s.name);
        out.positive(path("area"), s.area, "an area", "m^2");
        out.positive(path("inertia"), s.inertia, "a second moment of area", "m^4");
        if let RotaryInertia::Given(value) = s.rotary_inertia
            && !(value >= 0.0 && value.is_finite())
        {
            out.add(path("rotary_inertia"), quantity(value, "kg*m"), "a value of zero or above");
        }
    }
    if model.beams.is_empty() {
        out.add("beam".into(), "no beam", "at least one beam");
    }
    for beam in &model.beams {
        check_beam(model, beam, &mut out);
    }
    for support in &model.supports {
        check_support(model, support, &mut out);
    }
    for joint in &model.joints {
        check_joint(model, joint, &mut out);
    }
    for projectile in &model.projectiles {
        check_projectile(model, projectile, &mut out);
    }
    for load in &model.loads {
        check_load(model, load, &mut out);
    }
    for point in &model.points {
        check_point(model, point, "record.points".into(), &mut out);
    }
    out.0
}

fn names(model: &ModelBuilder, out: &mut Faults) {
    fn each<'a>(kind: &str, names: impl Iterator<Item = &'a String>, out: &mut Faults) {
        let mut seen = Vec::new();
        for name in names {
            if name.is_empty() {
                out.add(kind.into(), "an empty name", "a name");
            } else if seen.contains(&name) {
                out.add(format!("{kind}.{name}"), "a name used twice", "each name once");
            }
            seen.push(name);
        }
    }
    each("material", model.materials.iter().map(|x| &x.name), out);
    each("section", model.sections.iter().map(|x| &x.name), out);
    each("beam", model.beams.iter().map(|x| &x.name), out);
    each("support", model.supports.iter().map(|x| &x.name), out);
    each("joint", model.joints.iter().map(|x| &x.name), out);
    each("projectile", model.projectiles.iter().map(|x| &x.name), out);
    each("load", model.loads.iter().map(|x| &x.name), out);
}

fn check_beam(model: &ModelBuilder, beam: &Beam, out: &mut Faults) {
    let path = |field: &str| format!("beam.{}.{field}", beam.name);
    let ElementSize::Number(elements) = beam.mesh.size else { return };
    if elements == 0 {
        out.add(path("elements"), "0 elements", "at least 1 element");
    } else if elements > 10_000_000 {
        let found = format!("{elements} elements");
        out.add(path("elements"), found, "at most 10 million elements");
    }
    if beam.points.len() != 2 {
        let found = format!("{} points", beam.points.len());
        out.add(path("points"), found, "2 points: beams are straight in this version");
    } else if beam.points.as_flattened().iter().any(|c| !c.is_finite()) {
        out.finite(path("points"), beam.points.as_flattened(), "m");
    } else if length(beam) <= 0.0 || !length(beam).is_finite() {
        out.add(path("points"), "a beam of zero length", "two points apart from each other");
    }
    if beam.material.0 as usize >= model.materials.len() {
        out.add(path("material"), "an unknown material", "a material of this model");
    }
    if beam.section.0 as usize >= model.sections.len() {
        out.add(path("section"), "an unknown section", "a section of this model");
    }
}

fn length(beam: &Beam) -> f64 {
    if beam.points.len() == 2 { norm(sub(beam.points[1], beam.points[0])) } else { f64::NAN }
}

/// Whether the point exists; faults say where its beam ends.
fn check_point(model: &ModelBuilder, point: &PointRef, path: String, out: &mut Faults) -> bool {
    let Some(beam) = model.beams.get(point.beam.0 as usize) else {
        out.add(path, "a point on an unknown beam", "a beam of this model");
        return false;
    };
    let (value, limit, unit) = match point.along {
        Along::Fraction(f) => (f, 1.0, ""),
        Along::Distance(s) => (s, length(beam), " m"),
    };
    if limit.is_nan() {
        return false; // the beam's own fault
    }
    let slack = 1e-12 * limit;
    if (-slack..=limit + slack).contains(&value) {
        return true;
    }
    let found = format!("{} ({value}{unit} along the beam)", point.label);
    out.add(path, found, &format!("a point of `{}`, from 0 to {limit}{unit}", beam.name));
    false
}

fn check_support(model: &ModelBuilder, support: &Support, out: &mut Faults) {
    check_point(model, &support.at, format!("support.{}.at", support.name), out);
    match &support.kind {
        SupportKind::Roller { direction } => {
            let path = format!("support.{}.direction", support.name);
            if direction.iter().any(|c| !c.is_finite()) {
                out.finite(path, direction, "");
            } else if norm(*direction) == 0.0 {
                out.add(path, "a direction of zero length", "the direction it rolls along");
            }
        }
        SupportKind::Fix { components } if components.is_empty() => {
            let path = format!("support.{}.components", support.name);
            out.add(path, "no components", "at least one component to hold");
        }
        _ => {}
    }
}

fn check_joint(model: &ModelBuilder, joint: &Joint, out: &mut Faults) {
    let path = || format!("joint.{}.between", joint.name);
    let [a, b] = &joint.between;
    let exist = check_point(model, a, path(), out) & check_point(model, b, path(), out);
    if !exist {
        return;
    }
    let (beam_a, beam_b) = (&model.beams[a.beam.0 as usize], &model.beams[b.beam.0 as usize]);
    if length(beam_a).is_nan() || length(beam_b).is_nan() {
        return; // the beams' own faults
    }
    let (pa, pb) = (position(beam_a, a.along), position(beam_b, b.along));
    let distance = norm(sub(pa, pb));
    let scale = length(beam_a).max(length(beam_b));
    if distance > 1e-9 * scale {
        let found = format!("{} and {}, {distance:.6} m apart", a.label, b.label);
        out.add(path(), found, "two points at the same place");
    } else if a.beam == b.beam {
        out.add(path(), "twice the same beam", "points of two different beams");
    }
}

fn position(beam: &Beam, along: Along) -> [f64; 2] {
    let f = match along {
        Along::Fraction(f) => f,
        Along::Distance(s) => s / length(beam),
    };
    let (a, b) = (beam.points[0], beam.points[1]);
    [a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1])]
}

/// Line of flight of a projectile, not normalised; `None` if neither velocity nor direction gives one.
pub(super) fn line_of_flight(projectile: &Projectile) -> Option<[f64; 2]> {
    let line =
        if norm(projectile.velocity) > 0.0 { projectile.velocity } else { projectile.direction? };
    (norm(line) > 0.0).then_some(line)
}

fn check_projectile(model: &ModelBuilder, projectile: &Projectile, out: &mut Faults) {
    let path = |field: &str| format!("projectile.{}.{field}", projectile.name);
    out.positive(path("mass"), projectile.mass, "a mass", "kg");
    check_point(model, &projectile.strikes, path("strikes"), out);
    match projectile.kind {
        ProjectileKind::Elastic { stiffness, .. } => {
            out.positive(path("stiffness"), stiffness, "a stiffness", "N/m");
        }
        ProjectileKind::Rigid { restitution } => {
            if !(0.0..=1.0).contains(&restitution) {
                let found = quantity(restitution, "");
                out.add(path("restitution"), found, "a coefficient from 0 to 1");
            }
        }
    }
    if !(projectile.standoff >= 0.0 && projectile.standoff.is_finite()) {
        let found = if projectile.standoff < 0.0 {
            format!("a projectile that starts {} m inside the beam", -projectile.standoff)
        } else {
            quantity(projectile.standoff, "m")
        };
        out.add(path("standoff"), found, "a standoff of zero or above");
    }
    let velocity = projectile.velocity;
    let direction = projectile.direction;
    if velocity.iter().chain(direction.iter().flatten()).any(|c| !c.is_finite()) {
        out.finite(path("velocity"), &velocity, "m/s");
        out.finite(path("direction"), &direction.unwrap_or_default(), "");
    } else if line_of_flight(projectile).is_none() {
        let field = if direction.is_some() { "direction" } else { "velocity" };
        let expected = "a velocity, or for a projectile at rest `direction`, its line of flight";
        out.add(path(field), "no line of flight: zero velocity", expected);
    } else if let Some(d) = direction
        && norm(velocity) > 0.0
        && (norm(d) == 0.0
            || cross(d, velocity).abs() > 1e-9 * norm(d) * norm(velocity)
            || dot(d, velocity) < 0.0)
    {
        let found = format!("[{}, {}], not along the velocity", d[0], d[1]);
        out.add(path("direction"), found, "no direction, or that of the velocity");
    }
}

fn check_load(model: &ModelBuilder, load: &Load, out: &mut Faults) {
    let path = |field: &str| format!("load.{}.{field}", load.name);
    match &load.kind {
        LoadKind::Gravity { acceleration } => {
            out.finite(path("acceleration"), acceleration, "m/s^2");
        }
        LoadKind::Distributed { .. } => {}
        LoadKind::Point { at, force, moment, .. } => {
            check_point(model, at, path("at"), out);
            out.finite(path("force"), force, "N");
            out.finite(path("moment"), &[*moment], "N*m");
            if *force == [0.0; 2] && *moment == 0.0 {
                out.add(path("force"), "no force and no moment", "a force or a moment");
            }
        }
    }
    out.finite(path("from"), &[load.from], "s");
    if load.until.is_nan() || load.until <= load.from {
        out.add(path("until"), quantity(load.until, "s"), "a time after `from`");
    }
}
