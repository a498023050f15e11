//! Faults of supports, joints and springs.

use super::super::builder::ModelBuilder;
use super::super::definition::*;
use super::actions::line_of_motion;
use super::beams::{arc, check_point, length, position};
use super::faults::{Faults, quantity};
use super::functions::check_function;
use super::yielding::{check_yielding_joint, check_yielding_length, check_yielding_spring};
use crate::math::vec2::{dot, norm, rot90, scale, sub};

pub(super) fn check_support(model: &ModelBuilder, support: &Support, out: &mut Faults) {
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
            out.add(path("components"), "no components", "at least one fixed component");
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

/// A displacement has no component along a direction if that is below this share of it: round-off of directions such as those of 45 degrees.
const ALONG: f64 = 1e-9;

/// The directions in which a support of a kind acts on displacements, unit vectors, and what its motions may be, where these are not all; a direction
/// that is none is another fault.
fn acting_along(kind: &SupportKind) -> Option<(Vec<[f64; 2]>, &'static str)> {
    let unit = |v: [f64; 2]| (norm(v) > 0.0).then(|| scale(1.0 / norm(v), v));
    match kind {
        SupportKind::Roller { direction } => {
            let expected = "a displacement across `direction`, along which it rolls freely";
            Some((vec![rot90(unit(*direction)?)], expected))
        }
        SupportKind::Stop { direction, .. } => {
            Some((vec![unit(*direction)?], "a displacement along `direction`, in which it stops"))
        }
        SupportKind::Elastic { direction, stiffness, damping, .. } => {
            let along = unit(*direction)?;
            let acts = |k: usize| stiffness[k] > 0.0 || damping[k] > 0.0;
            let axes = [(along, acts(0)), (rot90(along), acts(1))];
            let axes = axes.into_iter().filter(|(_, acts)| *acts).map(|(axis, _)| axis).collect();
            let expected = "a displacement along axes with a stiffness or a damping";
            Some((axes, expected))
        }
        SupportKind::Clamp | SupportKind::Pin | SupportKind::Fix { .. } => None,
    }
}

/// A motion can only be prescribed for fixed components.
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
        let expected = "displacements of fixed components only";
        out.add(path(), "a prescribed displacement of a free component", expected);
    }
    if let Some((directions, expected)) = acting_along(&support.kind) {
        let own = motion.displacement;
        let along = |rest, n: &[f64; 2]| sub(rest, scale(dot(*n, own), *n));
        let lost = norm(directions.iter().fold(own, along));
        if lost > ALONG * norm(own) {
            out.add(path(), "a prescribed displacement along a free direction", expected);
        }
    }
    if !turned && motion.rotation != 0.0 {
        let expected = "a clamp, or \"rotation\" among the fixed components";
        out.add(path(), "a prescribed rotation of a free rotation", expected);
    }
}

pub(super) fn check_spring(model: &ModelBuilder, spring: &Spring, out: &mut Faults) {
    let path = |field: &str| format!("spring.{}.{field}", spring.name);
    out.not_negative(path("stiffness"), spring.law.stiffness(), "a stiffness", "N/m");
    out.not_negative(path("damping"), spring.damping, "damping", "N*s/m");
    check_spring_law(spring, out);
    check_yielding_spring(spring, out);
    if let Some(length) = spring.length {
        out.not_negative(path("length"), length, "a length", "m");
    }
    let mut place = |anchor: &Anchor| match anchor {
        Anchor::Point(p) => check_point(model, p, path("between"), out)
            .then(|| position(&model.beams[p.beam.0 as usize], p.along)),
        Anchor::Projectile(name) => projectile(model, name, path("between"), out),
        Anchor::Ground(x) => {
            out.finite(path("between"), x, "m");
            Some(*x)
        }
    };
    let ends = [place(&spring.between[0]), place(&spring.between[1])];
    if spring.between.iter().all(|a| matches!(a, Anchor::Ground(_))) {
        out.add(
            path("between"),
            "two points of the ground",
            "at least one point of a beam, or a projectile",
        );
    } else if let [Some(a), Some(b)] = ends
        && norm(sub(a, b)) == 0.0
    {
        let expected = "two points apart from each other: a joint or an elastic support \
                        connects coincident points";
        out.add(path("between"), "a spring between points at the same place", expected);
    } else if let [Some(a), Some(b)] = ends {
        let distance = norm(sub(a, b));
        check_yielding_length(spring, distance, out);
        let length = spring.length.unwrap_or(distance);
        if let SpringLaw::Compression { gap, .. } = spring.law
            && gap >= length
        {
            let found =
                format!("{gap} m, and a length without force of {length} m: it never closes");
            out.add(path("gap"), found, "a gap below the length");
        }
    }
}

/// The centre of a projectile or a disc in the reference configuration, if a spring can end there.
fn projectile(
    model: &ModelBuilder,
    name: &str,
    path: String,
    out: &mut Faults,
) -> Option<[f64; 2]> {
    if let Some(disc) = model.discs.iter().find(|disc| disc.name == name) {
        return Some(disc.position);
    }
    let Some(guided) = model.projectiles.iter().find(|own| own.name == name) else {
        out.add(path, format!("the unknown projectile {name:?}"), "a projectile of this model");
        return None;
    };
    if guided.rear.is_some() {
        let found = format!("the projectile {name:?}, which has a rear mass");
        out.add(path, found, "a projectile of one mass");
        return None;
    }
    let strikes = &guided.strikes;
    let line = line_of_motion(guided)?;
    let beam = model.beams.get(strikes.beam.0 as usize)?;
    let place = beam.line_point(strikes.along)?.position;
    Some(sub(place, scale(guided.standoff / norm(line), line)))
}

/// What its law asks for.
fn check_spring_law(spring: &Spring, out: &mut Faults) {
    let path = |field: &str| format!("spring.{}.{field}", spring.name);
    match &spring.law {
        SpringLaw::Linear { stiffness } => {
            if *stiffness == 0.0 && spring.damping == 0.0 && spring.yielding.is_none() {
                let expected = "a stiffness or a damping above zero";
                out.add(path("stiffness"), "a spring without stiffness and damping", expected);
            }
        }
        SpringLaw::Tension { stiffness, slack: way }
        | SpringLaw::Compression { stiffness, gap: way } => {
            let tension = matches!(spring.law, SpringLaw::Tension { .. });
            let [key, what] = if tension { ["slack", "a slack"] } else { ["gap", "a gap"] };
            out.not_negative(path(key), *way, what, "m");
            if *stiffness == 0.0 {
                let expected = "a stiffness above zero";
                out.add(path("stiffness"), "a spring of one side without stiffness", expected);
            }
        }
        SpringLaw::Table { extension, force } => {
            let words = [
                ["extensions", "extensions", "m"],
                ["forces", "forces", "N"],
                ["a force", "extension", "no force without extension: `length` sets where that is"],
            ];
            check_force_table(&path, words, [extension, force], out);
        }
    }
    if let Some(strength) = spring.strength {
        out.positive(path("strength"), strength, "a strength", "N");
    }
    if spring.yielding.is_some() {
        if !matches!(spring.law, SpringLaw::Linear { .. }) {
            let found = "a yield force of a spring whose law is not linear";
            out.add(path("yield_force"), found, "a linear spring, or none");
        }
        if spring.strength.is_some() {
            let found = "a strength of a spring that yields";
            out.add(path("strength"), found, "`failure_extension` in its place");
        }
    }
}

/// A table of forces over extensions; by key, words and unit of both, and words of a force where there is no extension.
pub(super) fn check_force_table(
    path: &impl Fn(&str) -> String,
    words: [[&str; 3]; 3],
    [extension, force]: [&[f64]; 2],
    out: &mut Faults,
) {
    let [[extensions, of_extensions, m], [forces, of_forces, n], [a_force, way, at_rest]] = words;
    if extension.len() != force.len() || extension.len() < 2 {
        let found = format!("{} {of_extensions} and {} {of_forces}", extension.len(), force.len());
        out.add(path(forces), found, "as many of both, at least two");
        return;
    }
    out.finite(path(extensions), extension, m);
    out.finite(path(forces), force, n);
    if !extension.iter().chain(force).all(|x| x.is_finite()) {
        return;
    }
    if let Some(pair) = extension.windows(2).find(|pair| pair[1] <= pair[0]) {
        let found = format!("{} m after {} m", pair[1], pair[0]);
        out.add(path(extensions), found, &format!("{of_extensions} that increase"));
        return;
    }
    // On the line between the points about zero, or the force of the first or last one beyond them.
    let k = extension.partition_point(|e| *e <= 0.0);
    let at_zero = if k == 0 || k == extension.len() {
        force[k.min(extension.len() - 1)]
    } else {
        let rise = (force[k] - force[k - 1]) / (extension[k] - extension[k - 1]);
        force[k - 1] - rise * extension[k - 1]
    };
    let most = force.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
    if at_zero.abs() > 1e-12 * most {
        let found = format!("{a_force} of {at_zero} {n} without {way}");
        out.add(path(forces), found, at_rest);
    }
}

pub(super) fn check_joint(model: &ModelBuilder, joint: &Joint, out: &mut Faults) {
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
    check_yielding_joint(joint, out);
    check_strength(joint, out);
    if distance > 1e-9 * scale {
        let found = format!("{} and {}, {distance:.6} m apart", a.label, b.label);
        out.add(path(), found, "two points at the same place");
    } else if a.beam == b.beam
        && (arc(beam_a, a.along) - arc(beam_a, b.along)).abs() <= 1e-9 * scale
    {
        out.add(path(), "twice the same point", "points of two beams, or two points of one");
    }
}

/// Strength of a joint.
fn check_strength(joint: &Joint, out: &mut Faults) {
    let Some(strength) = joint.strength else { return };
    let path = |field: &str| format!("joint.{}.strength{field}", joint.name);
    if matches!(joint.kind, JointKind::ElasticHinge { .. }) {
        let found = "a strength of a hinge with a spring or a damper";
        out.add(path(""), found, "failure_rotation, or a hinge without them");
    }
    let none = strength.force.is_none() && strength.moment.is_none();
    if none {
        out.add(path(""), "a strength without a limit", "a force, a moment or both");
    }
    let rigid = joint.kind == JointKind::Rigid;
    if strength.moment.is_some() && !rigid {
        out.add(
            path(".moment"),
            "a moment strength of a hinge (hinges carry no moment)",
            "a rigid joint",
        );
    }
    for (field, limit, what, unit) in [
        (".force", strength.force, "a force", "N"),
        (".moment", strength.moment, "a moment", "N*m"),
    ] {
        if let Some(limit) = limit {
            out.positive(path(field), limit, what, unit);
        }
    }
}
