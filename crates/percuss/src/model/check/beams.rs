//! Faults of sections and beams, and of places on beams.

use super::super::builder::ModelBuilder;
use super::super::centre_line::CentreLine;
use super::super::definition::*;
use super::super::mesh;
use super::faults::{Faults, quantity};
use crate::math::vec2::{cross, dot, norm, sub};

pub(super) fn check_stations(s: &Section, out: &mut Faults) {
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

pub(super) fn check_beam(model: &ModelBuilder, beam: &Beam, out: &mut Faults) {
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
        out.add(path("points"), found, "a beam without a 180 degree corner");
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
pub(super) fn length(beam: &Beam) -> f64 {
    CentreLine::new(beam).map_or(f64::NAN, |line| line.length())
}

pub(super) fn arc(beam: &Beam, along: Along) -> f64 {
    CentreLine::new(beam).map_or(f64::NAN, |line| line.arc(along))
}

/// Whether a place is on a beam.
pub(super) fn check_along(
    beam: &Beam,
    along: Along,
    path: String,
    what: &str,
    out: &mut Faults,
) -> bool {
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

/// Whether the point exists; faults contain the length of its beam.
pub(super) fn check_point(
    model: &ModelBuilder,
    point: &PointRef,
    path: String,
    out: &mut Faults,
) -> bool {
    let Some(beam) = model.beams.get(point.beam.0 as usize) else {
        out.add(path, "a point on an unknown beam", "a beam of this model");
        return false;
    };
    check_along(beam, point.along, path, &point.label, out)
}

pub(super) fn position(beam: &Beam, along: Along) -> [f64; 2] {
    CentreLine::new(beam).map_or([f64::NAN; 2], |line| line.position(line.arc(along)))
}

/// A stretch of a beam from one place to another behind it.
pub(super) fn check_stretch(
    beam: &Beam,
    stretch: [Along; 2],
    path: &impl Fn(&str) -> String,
    out: &mut Faults,
) {
    let on_beam = stretch
        .map(|along| check_along(beam, along, path("stretch"), "an end of the stretch", out));
    let [a, b] = stretch.map(|along| arc(beam, along));
    if on_beam == [true; 2] && a >= b {
        let found = format!("a stretch from {a} m to {b} m");
        out.add(path("stretch"), found, "a stretch whose end lies behind its start");
    }
}
