//! The contacts of a run in the table at its end: forces or impulses, the first impacts and intervals.

use percuss::{
    ContactInterval, ContactRecord, ContactSummary, Impact, NoRestitution, RunSummary, Sliding,
};
use percuss_output::report::taken_as_start;
use percuss_output::round_off::{Scales, is_round_off, without_round_off};
use percuss_output::shown::FEW;

use super::super::equivalent::{equivalent, without_equivalent};
use super::lines::listed;
use crate::effective_mass;
use crate::number::{count, quantity};

/// The rows of a contact.
pub(super) fn contact_lines(
    contact: &ContactSummary,
    run: &RunSummary,
    scales: &Scales,
) -> Vec<String> {
    let interval = |one: &ContactInterval| interval(one, run);
    match &contact.record {
        ContactRecord::Smooth { peak_force, intervals } => {
            let mut lines = Vec::new();
            if intervals.is_empty() {
                lines.push("not closed".to_owned());
            } else {
                let (value, time) =
                    (quantity(peak_force.value, "N"), quantity(peak_force.time, "s"));
                lines.push(format!("peak force {value} at t = {time}"));
            }
            // A contact that did not close has no indentation.
            if let Some(permanent) = contact.permanent_penetration.filter(|p| *p > 0.0) {
                lines.push(format!("permanent indentation {}", quantity(permanent, "m")));
            }
            lines.extend(listed(intervals, intervals.len(), FEW, interval));
            lines.extend(contact.equivalent_force.as_ref().map(equivalent));
            lines.extend(no_equivalent(contact));
            lines
        }
        ContactRecord::Nonsmooth {
            impacts,
            impact_count,
            fallback_count,
            impulse_total,
            impulse_resting,
            intervals,
            ..
        } => {
            let mut lines = Vec::new();
            if *impact_count > 0 {
                let struck = quantity((impulse_total - impulse_resting).max(0.0), "N*s");
                lines.push(format!("{}, total impulse {struck}", count(*impact_count, "impact")));
            } else if intervals.is_empty() {
                lines.push("not closed".to_owned());
            }
            if !intervals.is_empty() {
                let total = quantity(*impulse_resting, "N*s");
                lines.push(format!("persistent contact, total impulse {total}"));
            }
            lines.extend(contact.sliding.and_then(|sliding| slid(sliding, scales)));
            lines.extend(listed(impacts, *impact_count, FEW, |one| impact(one, run, scales)));
            lines.extend(listed(intervals, intervals.len(), FEW, interval));
            if *fallback_count > 0 {
                let law = "Moreau's law used (Newton's law would increase the energy)";
                lines.push(format!("{}: {law}", count(*fallback_count, "impact")));
            }
            lines.extend(contact.effective_mass.as_ref().map(effective_mass::line));
            lines.extend(contact.equivalent_force.as_ref().map(equivalent));
            lines.extend(no_equivalent(contact));
            lines
        }
    }
}

/// Why there is no equivalent static force; nothing of a contact that did not close, which the first of its lines states.
fn no_equivalent(contact: &ContactSummary) -> Option<String> {
    let reason = contact.no_equivalent_force.as_deref();
    reason.filter(|_| contact.record.has_closed()).map(without_equivalent)
}

/// How far a contact with friction slid; nothing where it stuck or rolled, or never closed.
fn slid(sliding: Sliding, scales: &Scales) -> Option<String> {
    let Sliding { distance, work } = sliding;
    let slides = !is_round_off(work, scales.energy) && !is_round_off(distance, scales.length);
    slides.then(|| {
        let (distance, work) = (quantity(distance, "m"), quantity(work, "J"));
        format!("sliding distance {distance}, friction work {work}")
    })
}

/// An instant; the first impact of a run that begins in contact ends as the run begins.
fn instant(time: f64, run: &RunSummary) -> String {
    quantity(if time <= taken_as_start(run.time, run.steps as f64) { 0.0 } else { time }, "s")
}

fn interval(interval: &ContactInterval, run: &RunSummary) -> String {
    let end = match interval.end.is_nan() {
        true => "the end".to_owned(),
        false => instant(interval.end, run),
    };
    let (start, impulse) = (instant(interval.start, run), quantity(interval.impulse, "N*s"));
    let why = match interval.restitution() {
        Err(why @ (NoRestitution::Steps(_) | NoRestitution::Unsteady)) => {
            format!(", restitution {why}")
        }
        _ => String::new(),
    };
    format!("closed from t = {start} to {end}, impulse {impulse}{why}")
}

fn impact(impact: &Impact, run: &RunSummary, scales: &Scales) -> String {
    let (approach, separation) = (impact.approach_velocity, impact.separation_velocity);
    // Round-off of a plastic impact, or of a touch without approach.
    let fast = approach.abs().max(separation.abs()).max(scales.velocity);
    let [approach, separation] = [approach, separation].map(|v| without_round_off(v, fast));
    let friction = match without_round_off(impact.tangential_impulse, impact.impulse) {
        0.0 => String::new(),
        impulse => format!(", friction impulse {}", quantity(impulse, "N*s")),
    };
    let points = match impact.points {
        0 | 1 => String::new(),
        points => format!(" at {points} points"),
    };
    format!(
        "t = {}: impulse {}{points}{friction}, approach {}, separation {}",
        instant(impact.time, run),
        quantity(impact.impulse, "N*s"),
        quantity(approach, "m/s"),
        quantity(separation, "m/s")
    )
}
