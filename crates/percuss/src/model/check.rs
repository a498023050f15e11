//! Every fault of a set of definitions, found at once.

use super::builder::ModelBuilder;
use super::centre_line::CentreLine;
use super::definition::*;
use super::fault::Fault;
use super::mesh;
use super::time_function::TimeFunction;
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

    fn not_negative(&mut self, path: String, value: f64, what: &str, unit: &str) {
        if !(value >= 0.0 && value.is_finite()) {
            self.add(path, quantity(value, unit), &format!("{what} of zero or above"));
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
    for m in &model.materials {
        let path = |field: &str| format!("material.{}.{field}", m.name);
        out.not_negative(path("retardation"), m.retardation, "a time", "s");
        out.not_negative(path("mass_damping"), m.mass_damping, "a rate", "1/s");
    }
    for s in &model.sections {
        let path = |field: &str| format!("section.{}.{field}", s.name);
        out.positive(path("area"), s.area, "an area", "m^2");
        out.positive(path("inertia"), s.inertia, "a second moment of area", "m^4");
        if let Some(depth) = s.depth {
            out.positive(path("depth"), depth, "a depth", "m");
        }
        check_stations(s, &mut out);
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
    for spring in &model.springs {
        check_spring(model, spring, &mut out);
    }
    for mass in &model.masses {
        let path = |field: &str| format!("mass.{}.{field}", mass.name);
        check_point(model, &mass.at, path("at"), &mut out);
        out.positive(path("mass"), mass.mass, "a mass", "kg");
        let path = path("rotary_inertia");
        out.not_negative(path, mass.rotary_inertia, "a moment of inertia", "kg*m^2");
    }
    for ratio in &model.modal_damping {
        if !(0.0..1.0).contains(ratio) {
            out.add("damping.modal".into(), quantity(*ratio, ""), "ratios from 0 to below 1");
        }
    }
    let motion = &model.initial_motion;
    out.finite("initial.velocity".into(), &motion.velocity, "m/s");
    out.finite("initial.spin".into(), &[motion.spin], "rad/s");
    out.finite("initial.about".into(), &motion.about, "m");
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
    each("spring", model.springs.iter().map(|x| &x.name), out);
    each("mass", model.masses.iter().map(|x| &x.name), out);
}

fn check_stations(s: &Section, out: &mut Faults) {
    let path = || format!("section.{}.stations", s.name);
    let Some(last) = s.stations.last() else { return };
    let rising = s.stations.windows(2).all(|w| w[0].at < w[1].at);
    if !rising || s.stations[0].at != 0.0 || last.at != 1.0 || s.stations.len() < 2 {
        let list: Vec<String> = s.stations.iter().map(|x| x.at.to_string()).collect();
        out.add(
            path(),
            format!("stations [{}]", list.join(", ")),
            "fractions that increase from 0 to 1",
        );
    }
    for station in &s.stations {
        out.positive(path(), station.area, "areas", "m^2");
        out.positive(path(), station.inertia, "second moments of area", "m^4");
    }
}

fn check_beam(model: &ModelBuilder, beam: &Beam, out: &mut Faults) {
    let path = |field: &str| format!("beam.{}.{field}", beam.name);
    check_mesh(beam, out);
    if beam.points.len() < 2 {
        let found = count(beam.points.len(), "point");
        out.add(path("points"), found, "at least 2 points");
    } else if beam.points.as_flattened().iter().any(|c| !c.is_finite()) {
        out.finite(path("points"), beam.points.as_flattened(), "m");
    } else {
        check_line(beam, out);
    }
    for change in &beam.changes {
        let known = change.material.is_none_or(|m| (m.0 as usize) < model.materials.len())
            && change.section.is_none_or(|s| (s.0 as usize) < model.sections.len());
        if !known {
            out.add(path("changes"), "an unknown material or section", "those of this model");
        }
    }
    if beam.material.0 as usize >= model.materials.len() {
        out.add(path("material"), "an unknown material", "a material of this model");
    }
    if beam.section.0 as usize >= model.sections.len() {
        out.add(path("section"), "an unknown section", "a section of this model");
    }
}

fn count(n: usize, what: &str) -> String {
    if n == 1 { format!("1 {what}") } else { format!("{n} {what}s") }
}

fn check_mesh(beam: &Beam, out: &mut Faults) {
    let path = |field: &str| format!("beam.{}.{field}", beam.name);
    let most = "at most 10 million elements";
    match beam.mesh.size {
        ElementSize::Number(0) => out.add(path("elements"), "0 elements", "at least 1 element"),
        ElementSize::Number(n) if n > 10_000_000 => {
            out.add(path("elements"), format!("{n} elements"), most);
        }
        ElementSize::Number(n) => {
            let parts = CentreLine::new(beam).map_or(1, |line| mesh::parts(beam, &line));
            if n < parts {
                let found = format!("{} for {parts} straight parts", count(n, "element"));
                out.add(path("elements"), found, "at least one element for each");
            }
        }
        ElementSize::Length(h) => {
            out.positive(path("element_length"), h, "a length", "m");
            if h > 0.0 && length(beam) / h > 1e7 {
                out.add(path("element_length"), quantity(h, "m"), most);
            }
        }
    }
    if let Some(grading) = beam.mesh.grading {
        if !(grading.ratio > 1.0 && grading.ratio.is_finite()) {
            out.add(path("grading"), format!("a ratio of {}", grading.ratio), "a ratio above 1");
        }
        check_along(beam, grading.towards, path("grading"), "grading", out);
    }
}

/// Faults of the centre line: parts without length, corners that turn right back, points on no arc, changes off the beam.
fn check_line(beam: &Beam, out: &mut Faults) {
    let path = |field: &str| format!("beam.{}.{field}", beam.name);
    let points = &beam.points;
    let size = length_through(points);
    let zero = |w: &[[f64; 2]]| norm(sub(w[1], w[0])) <= 1e-12 * size;
    if let Some(i) = points.windows(2).position(zero) {
        let found = if points.len() == 2 {
            "a beam of zero length".into()
        } else {
            format!("a part of zero length between points {} and {}", i + 1, i + 2)
        };
        out.add(path("points"), found, "points apart from each other");
        return;
    }
    let back = |w: &[[f64; 2]]| {
        let (a, b) = (sub(w[1], w[0]), sub(w[2], w[1]));
        dot(a, b) < 0.0 && cross(a, b).abs() <= 1e-9 * norm(a) * norm(b)
    };
    if beam.curve != Curve::Arc
        && let Some(i) = points.windows(3).position(back)
    {
        let found = format!("a corner of 180 degrees at point {}", i + 2);
        out.add(path("points"), found, "a beam that does not run back upon itself");
    }
    if beam.curve == Curve::Arc {
        if points.len() != 3 {
            let found = count(points.len(), "point");
            out.add(path("points"), found, "3 points for an arc: start, a point between, end");
        } else if CentreLine::new(beam).is_none() {
            out.add(path("points"), "3 points on a straight line", "3 points on a circle");
        }
    }
    let mut before = 0.0;
    for change in &beam.changes {
        if !check_along(beam, change.at, path("changes"), "a change", out) {
            continue;
        }
        let s = arc(beam, change.at);
        if s <= before || s >= length(beam) * (1.0 - 1e-12) {
            let found = format!("a change at {s} m");
            out.add(path("changes"), found, "places inside the beam, in increasing order");
        }
        before = s;
    }
}

fn length_through(points: &[[f64; 2]]) -> f64 {
    points.windows(2).map(|w| norm(sub(w[1], w[0]))).sum()
}

/// Length of a beam; NaN if its points define no line.
fn length(beam: &Beam) -> f64 {
    CentreLine::new(beam).map_or(f64::NAN, |line| line.length())
}

fn arc(beam: &Beam, along: Along) -> f64 {
    CentreLine::new(beam).map_or(f64::NAN, |line| line.arc(along))
}

/// Whether a place lies on a beam.
fn check_along(beam: &Beam, along: Along, path: String, what: &str, out: &mut Faults) -> bool {
    let (value, limit, unit) = match along {
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
    let found = format!("{what} ({value}{unit} along the beam)");
    out.add(path, found, &format!("a point of `{}`, from 0 to {limit}{unit}", beam.name));
    false
}

/// Whether the point exists; faults say where its beam ends.
fn check_point(model: &ModelBuilder, point: &PointRef, path: String, out: &mut Faults) -> bool {
    let Some(beam) = model.beams.get(point.beam.0 as usize) else {
        out.add(path, "a point on an unknown beam", "a beam of this model");
        return false;
    };
    check_along(beam, point.along, path, &point.label, out)
}

fn check_support(model: &ModelBuilder, support: &Support, out: &mut Faults) {
    let path = |field: &str| format!("support.{}.{field}", support.name);
    check_point(model, &support.at, path("at"), out);
    let mut direct = |direction: &[f64; 2], what: &str| {
        if direction.iter().any(|c| !c.is_finite()) {
            out.finite(path("direction"), direction, "");
        } else if norm(*direction) == 0.0 {
            out.add(path("direction"), "a direction of zero length", what);
        }
    };
    match &support.kind {
        SupportKind::Roller { direction } => direct(direction, "the direction it rolls along"),
        SupportKind::Fix { components } if components.is_empty() => {
            out.add(path("components"), "no components", "at least one component to hold");
        }
        SupportKind::Elastic {
            direction,
            stiffness,
            damping,
            rotational_stiffness,
            rotational_damping,
        } => {
            direct(direction, "the first axis of the springs");
            for k in stiffness {
                out.not_negative(path("stiffness"), *k, "stiffnesses", "N/m");
            }
            for c in damping {
                out.not_negative(path("damping"), *c, "damping", "N*s/m");
            }
            let (k, c) = (*rotational_stiffness, *rotational_damping);
            out.not_negative(path("rotational_stiffness"), k, "a stiffness", "N*m");
            out.not_negative(path("rotational_damping"), c, "damping", "N*m*s");
            if stiffness.iter().chain(damping).chain([&k, &c]).all(|x| *x == 0.0) {
                let expected = "a stiffness or a damping above zero";
                out.add(path("stiffness"), "an elastic support without any stiffness", expected);
            }
        }
        SupportKind::Stop { direction, gap, stiffness, .. } => {
            direct(direction, "the direction of motion it stops");
            out.not_negative(path("gap"), *gap, "a gap", "m");
            out.positive(path("stiffness"), *stiffness, "a stiffness", "N/m");
        }
        _ => {}
    }
    if support.until.is_nan() || support.until <= 0.0 {
        out.add(path("until"), quantity(support.until, "s"), "a time after zero");
    }
    if let Some(motion) = &support.motion {
        check_motion(support, motion, out);
    }
}

/// A motion can only move what the support holds.
fn check_motion(support: &Support, motion: &Motion, out: &mut Faults) {
    let path = || format!("support.{}.motion", support.name);
    out.finite(path(), &motion.displacement, "m");
    out.finite(path(), &[motion.rotation], "rad");
    check_function(&motion.function, path(), out);
    let (mut held, mut turned) = ([true; 2], false);
    match &support.kind {
        SupportKind::Clamp => turned = true,
        SupportKind::Fix { components } => {
            held = [Component::Displacement1, Component::Displacement2]
                .map(|c| components.contains(&c));
            turned = components.contains(&Component::Rotation);
        }
        SupportKind::Pin
        | SupportKind::Roller { .. }
        | SupportKind::Elastic { .. }
        | SupportKind::Stop { .. } => {}
    }
    if (0..2).any(|i| !held[i] && motion.displacement[i] != 0.0) {
        let expected = "components of displacement among those held";
        out.add(path(), "a displacement of what the support does not hold", expected);
    }
    if !turned && motion.rotation != 0.0 {
        let expected = "a clamp, or \"rotation\" among the components held";
        out.add(path(), "a rotation of what the support leaves free to turn", expected);
    }
}

fn check_function(function: &TimeFunction, path: String, out: &mut Faults) {
    use TimeFunction::*;
    match function {
        Constant | Function(_) => {}
        Step { at } => out.finite(path, &[*at], "s"),
        Ramp { duration } | HalfSine { duration } | Triangle { duration } => {
            out.positive(path, *duration, "a duration", "s");
        }
        Harmonic { frequency, phase } => out.finite(path, &[*frequency, *phase], ""),
        Table { times, values, .. } => {
            if times.len() != values.len() || times.len() < 2 {
                let found = format!("{} times and {} values", times.len(), values.len());
                out.add(path, found, "at least two times, and as many values");
            } else if times.iter().chain(values).any(|x| !x.is_finite()) {
                out.add(path, "numbers that are not finite", "finite numbers");
            } else if let Some(i) = times.windows(2).position(|w| w[1] <= w[0]) {
                let found = format!("{} s after {} s", times[i + 1], times[i]);
                out.add(path, found, "times that increase");
            }
        }
    }
}

fn check_spring(model: &ModelBuilder, spring: &Spring, out: &mut Faults) {
    let path = |field: &str| format!("spring.{}.{field}", spring.name);
    out.not_negative(path("stiffness"), spring.stiffness, "a stiffness", "N/m");
    out.not_negative(path("damping"), spring.damping, "damping", "N*s/m");
    if spring.stiffness == 0.0 && spring.damping == 0.0 {
        let expected = "a stiffness or a damping above zero";
        out.add(path("stiffness"), "a spring without stiffness and damping", expected);
    }
    if let Some(length) = spring.length {
        out.not_negative(path("length"), length, "a length", "m");
    }
    let mut place = |anchor: &Anchor| match anchor {
        Anchor::Point(p) => check_point(model, p, path("between"), out)
            .then(|| position(&model.beams[p.beam.0 as usize], p.along)),
        Anchor::Ground(x) => {
            out.finite(path("between"), x, "m");
            Some(*x)
        }
    };
    let ends = [place(&spring.between[0]), place(&spring.between[1])];
    if spring.between.iter().all(|a| matches!(a, Anchor::Ground(_))) {
        out.add(path("between"), "two points of the ground", "at least one point of a beam");
    } else if let [Some(a), Some(b)] = ends
        && norm(sub(a, b)) == 0.0
    {
        let expected = "two points apart from each other: a joint or an elastic support \
                        connects what lies at one place";
        out.add(path("between"), "a spring between points at the same place", expected);
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
    if let JointKind::ElasticHinge { stiffness, damping } = joint.kind {
        let path = |field: &str| format!("joint.{}.{field}", joint.name);
        out.not_negative(path("stiffness"), stiffness, "a stiffness", "N*m");
        out.not_negative(path("damping"), damping, "damping", "N*m*s");
    }
    if distance > 1e-9 * scale {
        let found = format!("{} and {}, {distance:.6} m apart", a.label, b.label);
        out.add(path(), found, "two points at the same place");
    } else if a.beam == b.beam
        && (arc(beam_a, a.along) - arc(beam_a, b.along)).abs() <= 1e-9 * scale
    {
        out.add(path(), "twice the same point", "points of two beams, or two points of one");
    }
}

fn position(beam: &Beam, along: Along) -> [f64; 2] {
    CentreLine::new(beam).map_or([f64::NAN; 2], |line| line.position(line.arc(along)))
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
        LoadKind::Distributed { beam, stretch, force, .. } => {
            out.finite(path("force"), force.as_flattened(), "N/m");
            let Some(beam) = model.beams.get(beam.0 as usize) else {
                out.add(path("on"), "an unknown beam", "a beam of this model");
                return;
            };
            let on_beam = stretch.map(|along| {
                check_along(beam, along, path("stretch"), "an end of the stretch", out)
            });
            let [a, b] = stretch.map(|along| arc(beam, along));
            if on_beam == [true; 2] && a >= b {
                let found = format!("a stretch from {a} m to {b} m");
                out.add(path("stretch"), found, "a stretch whose end lies behind its start");
            }
        }
        LoadKind::Point { at, force, moment, .. } => {
            check_point(model, at, path("at"), out);
            out.finite(path("force"), force, "N");
            out.finite(path("moment"), &[*moment], "N*m");
            if *force == [0.0; 2] && *moment == 0.0 {
                out.add(path("force"), "no force and no moment", "a force or a moment");
            }
        }
    }
    check_function(&load.function, path("function"), out);
    out.finite(path("from"), &[load.from], "s");
    if load.until.is_nan() || load.until <= load.from {
        out.add(path("until"), quantity(load.until, "s"), "a time after `from`");
    }
}
