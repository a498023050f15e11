//! Faults of loads, their time functions, and projectiles.

use super::super::builder::ModelBuilder;
use super::super::definition::*;
use super::beams::{check_point, check_stretch};
use super::contacts::check_smooth;
use super::faults::{Faults, quantity};
use super::functions::check_function;
use super::given_strains::{check_expansion, check_length, check_strained};
use crate::math::vec2::{cross, dot, norm};

/// Line of motion of a projectile, not normalised; `None` if neither velocity nor direction gives one.
pub(in crate::model) fn line_of_motion(projectile: &Projectile) -> Option<[f64; 2]> {
    let line =
        if norm(projectile.velocity) > 0.0 { projectile.velocity } else { projectile.direction? };
    (norm(line) > 0.0).then_some(line)
}

pub(super) fn check_projectile(model: &ModelBuilder, projectile: &Projectile, out: &mut Faults) {
    let path = |field: &str| format!("projectile.{}.{field}", projectile.name);
    out.positive(path("mass"), projectile.mass, "a mass", "kg");
    check_point(model, &projectile.strikes, path("strikes"), out);
    match &projectile.kind {
        ProjectileKind::Elastic { law } => {
            check_smooth(law, &path, out);
        }
        ProjectileKind::Rigid { restitution } => {
            if !(0.0..=1.0).contains(restitution) {
                let found = quantity(*restitution, "");
                out.add(path("restitution"), found, "a coefficient from 0 to 1");
            }
        }
    }
    out.not_negative(path("local_mass"), projectile.local_mass, "a mass", "kg");
    if let Some(rear) = &projectile.rear {
        out.positive(path("rear.mass"), rear.mass, "a mass", "kg");
        out.positive(path("rear.stiffness"), rear.stiffness, "a stiffness", "N/m");
        out.not_negative(path("rear.damping"), rear.damping, "a damping", "N s/m");
    }
    if !(projectile.standoff >= 0.0 && projectile.standoff.is_finite()) {
        let found = if projectile.standoff < 0.0 {
            format!("an initial penetration of {} m", -projectile.standoff)
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
    } else if line_of_motion(projectile).is_none() {
        let field = if direction.is_some() { "direction" } else { "velocity" };
        let expected = "a velocity, or `direction` for a projectile at rest";
        out.add(path(field), "zero velocity", expected);
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

pub(super) fn check_load(model: &ModelBuilder, load: &Load, out: &mut Faults) {
    let path = |field: &str| format!("load.{}.{field}", load.name);
    match &load.kind {
        LoadKind::Gravity { acceleration } | LoadKind::Base { acceleration } => {
            out.finite(path("acceleration"), acceleration, "m/s^2");
        }
        LoadKind::Strain { beam, stretch, strain, curvature } => {
            out.finite(path("strain"), &[*strain], "");
            out.finite(path("curvature"), &[*curvature], "1/m");
            if *strain == 0.0 && *curvature == 0.0 {
                out.add(path("strain"), "no strain and no curvature", "a strain or a curvature");
            }
            if let Some(beam) = check_strained(model, *beam, *stretch, &path, out) {
                check_length(model, beam, load, out);
            }
        }
        LoadKind::Temperature { beam, stretch, change, gradient } => {
            out.finite(path("change"), &[*change], "K");
            out.finite(path("gradient"), &[*gradient], "K/m");
            if *change == 0.0 && *gradient == 0.0 {
                out.add(path("change"), "no change and no gradient", "a change or a gradient");
            }
            if let Some(beam) = check_strained(model, *beam, *stretch, &path, out) {
                check_expansion(model, beam, &path, out);
                check_length(model, beam, load, out);
            }
        }
        LoadKind::Distributed { beam, stretch, force, .. } => {
            out.finite(path("force"), force.as_flattened(), "N/m");
            let Some(beam) = model.beams.get(beam.0 as usize) else {
                out.add(path("on"), "an unknown beam", "a beam of this model");
                return;
            };
            check_stretch(beam, *stretch, &path, out);
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
