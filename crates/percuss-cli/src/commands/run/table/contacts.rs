//! The contacts of a run in the table at its end: forces or impulses, the first impacts and intervals.

use percuss::{ContactInterval, ContactRecord, ContactSummary, Impact, NoRestitution, RunSummary};
use percuss_output::report::taken_as_start;

use super::super::equivalent::{equivalent, without_equivalent};
use super::lines::{LISTED, listed};
use crate::effective_mass;
use crate::number::{count, number};

/// Velocities below this share of the other one of an impact are round-off of a plastic impact, or of a touch without approach.
const NO_VELOCITY: f64 = 1e-8;

/// Whether the contact ever closed.
pub(super) fn touched(contact: &ContactSummary) -> bool {
    match &contact.record {
        ContactRecord::Smooth { intervals, .. } => !intervals.is_empty(),
        ContactRecord::Nonsmooth { impact_count, intervals, .. } => {
            *impact_count > 0 || !intervals.is_empty()
        }
    }
}

/// What happened at a contact.
pub(super) fn contact_lines(contact: &ContactSummary, run: &RunSummary) -> Vec<String> {
    let interval = |one: &ContactInterval| interval(one, run);
    match &contact.record {
        ContactRecord::Smooth { peak_force, intervals } => {
            let mut lines = Vec::new();
            if intervals.is_empty() {
                lines.push("never closed".to_owned());
            } else {
                let (value, time) = (number(peak_force.value), number(peak_force.time));
                lines.push(format!("peak force {value} N at {time} s"));
            }
            // What has not been touched is not pushed in.
            if let Some(permanent) = contact.permanent_penetration.filter(|p| *p > 0.0) {
                lines.push(format!("stays pushed in by {} m", number(permanent)));
            }
            lines.extend(listed(intervals, intervals.len(), LISTED, interval));
            lines.extend(contact.equivalent_force.as_ref().map(equivalent));
            lines.extend(contact.no_equivalent_force.map(without_equivalent));
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
            let counted = count(*impact_count, "impact");
            let struck = (impulse_total - impulse_resting).max(0.0);
            let mut lines = vec![format!("{counted}, impulse {} N s in all", number(struck))];
            if !intervals.is_empty() {
                lines.push(format!(
                    "resting contact, impulse {} N s in all",
                    number(*impulse_resting)
                ));
            }
            lines.extend(listed(impacts, *impact_count, LISTED, |one| impact(one, run)));
            lines.extend(listed(intervals, intervals.len(), LISTED, interval));
            if *fallback_count > 0 {
                let law = "under Moreau's law, where Newton's would have given energy";
                lines.push(format!("{} {law}", count(*fallback_count, "impact")));
            }
            lines.extend(contact.effective_mass.as_ref().map(effective_mass::line));
            lines.extend(contact.equivalent_force.as_ref().map(equivalent));
            lines.extend(contact.no_equivalent_force.map(without_equivalent));
            lines
        }
    }
}

/// An instant \[s\]; the first impact of a run that begins in contact ends as the run begins.
fn instant(time: f64, run: &RunSummary) -> String {
    number(if time <= taken_as_start(run.time, run.steps as f64) { 0.0 } else { time })
}

fn interval(interval: &ContactInterval, run: &RunSummary) -> String {
    let end = match interval.end.is_nan() {
        true => "the end".to_owned(),
        false => format!("{} s", instant(interval.end, run)),
    };
    let (start, impulse) = (instant(interval.start, run), number(interval.impulse));
    let why = match interval.restitution() {
        Err(why @ (NoRestitution::Steps(_) | NoRestitution::Unsteady)) => {
            format!(", restitution {why}")
        }
        _ => String::new(),
    };
    format!("closed from {start} s to {end}, impulse {impulse} N s{why}")
}

fn impact(impact: &Impact, run: &RunSummary) -> String {
    let beside = |a: f64, b: f64| if a.abs() <= NO_VELOCITY * b.abs() { 0.0 } else { a };
    let approach = beside(impact.approach_velocity, impact.separation_velocity);
    let separation = beside(impact.separation_velocity, impact.approach_velocity);
    let friction = match impact.tangential_impulse {
        0.0 => String::new(),
        impulse => format!(", of friction {} N s", number(impulse)),
    };
    let points = match impact.points {
        0 | 1 => String::new(),
        points => format!(" at {points} points"),
    };
    format!(
        "at {} s: impulse {} N s{points}{friction}, approach {} m/s, separation {} m/s",
        instant(impact.time, run),
        number(impact.impulse),
        number(approach),
        number(separation)
    )
}
