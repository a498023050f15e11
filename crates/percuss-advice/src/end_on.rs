//! Beams that are struck, or strike, end on.

use std::f64::consts::PI;

use super::case::{Beams, Struck, force, rigid_impact};
use super::formulas::BarOnWall;
use super::planned::{PlannedContact, graded};
use super::structure::BeamPlace;
use super::words::{digits, quantity, round_down};
use super::{Advice, Topic, Verdict};
use percuss::math::vec2::dot;
use percuss::{FirstTouches, Model};

/// Elements, or steps, in which the force of a bar rises: those that follow it, and those that make it too large by half.
const RISES: [f64; 2] = [1.0, 0.3];
const STEPS: [f64; 2] = [4.0, 1.0];
/// An impact with this share of its direction along a straight beam is end on.
const END_ON: f64 = 0.99;

/// A beam that meets a wall end on: how long it stays (as a trial expects it, where there is one), and whether the mesh and the step follow its force.
pub fn on_wall(
    planned: &PlannedContact<'_>,
    beams: &Beams<'_>,
    expected: Option<f64>,
) -> Vec<Option<Advice>> {
    let (place, settings) = (&beams.place, planned.settings);
    let speed = beams.wall.map_or(0.0, |normal| -dot(normal, beams.velocity));
    if speed <= 0.0 || !place.is_uniform() || planned.case.law.crushes() {
        return Vec::new();
    }
    let (section, length) = (place.section(), place.beam.length());
    let wave = section.bar_impact(length, speed);
    let Some(law) = planned.case.law.smooth() else {
        return vec![Some(stays(planned, wave.duration)), strut_under(planned, place, wave.force)];
    };
    let points = points_of_end(planned.model, planned.case.index);
    let found = section.bar_on_wall(length, speed, |p, rate| points * force(law, p, rate));
    let duration = match found {
        Some(BarOnWall::Waves(impact)) => Some(impact.duration),
        Some(BarOnWall::OnePiece) => {
            // Each point has its share of the mass.
            let mass = section.mass * length / points;
            rigid_impact(planned.case.law, mass, speed, 0.0).map(|impact| impact.duration)
        }
        None => None,
    };
    let peak = match found {
        Some(BarOnWall::Waves(impact)) => impact.force,
        _ => 0.0,
    };
    let duration = expected.or(duration);
    // What takes longer than the contact never rises so far: the bar moves as one piece.
    let rise = section.rise_time(speed, |p| points * force(law, p, 0.0));
    let rise = rise.filter(|rise| duration.is_none_or(|lasts| *rise < lasts)).map(|rise| {
        let transit = place.element_length() / section.bar_speed();
        let (in_elements, in_steps) = (rise / transit, rise / settings.step);
        let verdict = graded(in_elements, RISES).max(graded(in_steps, STEPS));
        let mut text = format!(
            "force rise time {}: {} times the transit time {} of a wave through an element, {} steps; largest force {} (EA v/c)",
            quantity(rise, "s"),
            digits(in_elements),
            quantity(transit, "s"),
            digits(in_steps),
            quantity(wave.force, "N")
        );
        if verdict != Verdict::Fine {
            let shorter = quantity(round_down(rise * section.bar_speed()), "m");
            let step = quantity(round_down(rise / STEPS[0]), "s");
            text += &format!(
                ": a higher peak depends on mesh and step; use elements of {shorter} and a step of {step} or less, or a softer contact"
            );
        }
        planned.finding(Topic::ForceRise, [rise, transit], "s", verdict, text)
    });
    vec![duration.map(|duration| stays(planned, duration)), rise, strut_under(planned, place, peak)]
}

/// Points of a bar that meet a wall at once, each under the law of the contact: the corners of a flat end.
pub fn points_of_end(model: &Model, contact: usize) -> f64 {
    FirstTouches::new(model).simultaneous(contact) as f64
}

fn stays(planned: &PlannedContact<'_>, duration: f64) -> Advice {
    let steps = duration / planned.settings.step;
    let verdict = graded(steps, [20.0, 8.0]);
    let mut text =
        format!("contact duration about {}, {} steps", quantity(duration, "s"), digits(steps));
    let points = match planned.case.law.is_rigid() {
        false => points_of_end(planned.model, planned.case.index),
        true => 1.0,
    };
    if points > 1.0 {
        text += &format!(
            " (the flat end has {} contact points: for an end stiffness k use {} per point)",
            digits(points),
            format_args!("k/{}", digits(points))
        );
    }
    if verdict != Verdict::Fine {
        text +=
            &format!(": set time.step to {} or less", quantity(round_down(duration / 20.0), "s"));
    }
    planned.finding(Topic::ContactDuration, [duration, planned.settings.step], "s", verdict, text)
}

/// A beam struck along its axis: whether the force is above that under which it buckles.
///
/// The force is at most that of the wave that the striker sends into the beam, `EA v/c`, or of a rigid target, whichever is less, until
/// the wave is back.
pub fn strut(planned: &PlannedContact<'_>, struck: &Struck<'_>) -> Option<Advice> {
    if dot(struck.direction, struck.place.tangent()).abs() < END_ON || !struck.place.is_uniform() {
        return None;
    }
    let section = struck.place.section();
    let wave = section.bar_impedance() * struck.speed;
    let rigid = rigid_impact(planned.case.law, struck.mass, struck.speed, 0.0);
    let force = rigid.map_or(wave, |impact| impact.peak_force.min(wave));
    strut_under(planned, &struck.place, force)
}

fn strut_under(planned: &PlannedContact<'_>, place: &BeamPlace<'_>, force: f64) -> Option<Advice> {
    let (section, length) = (place.section(), place.beam.length());
    let euler = PI * PI * section.bending / (length * length);
    if force.is_nan() || force <= euler {
        return None;
    }
    let text = format!(
        "axial force of about {} is {} times the Euler load {} (pinned ends): a straight mesh does not buckle; add an imperfection \
         (a slight curvature, an eccentricity of the impact)",
        quantity(force, "N"),
        digits(force / euler),
        quantity(euler, "N")
    );
    Some(planned.finding(Topic::Stability, [force, euler], "N", Verdict::Warning, text))
}
