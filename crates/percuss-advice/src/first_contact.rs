//! Time of the first contact: for free motion where nothing else moves the two before, else by a trial computation, and by the run once
//! there is one.

use super::case::Struck;
use super::expected::{Expected, Stays};
use super::planned::PlannedContact;
use super::structure::{gravity, gravity_varies};
use super::surroundings::Surroundings;
use super::words::quantity;
use super::{Advice, Topic, Verdict};
use percuss::math::vec2::norm;
use percuss::{ContactRecord, ContactSummary, RunSummary, Settings, Start, Termination};

/// Where the time of a first touch is known from.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Known {
    /// Free flight, with nothing that acts before the touch.
    FreeMotion,
    /// A trial of the model, which saw it.
    Trial,
    /// Free flight, though something else acts as well: an estimate and no more.
    Guess(&'static str),
}

/// The first contact of a projectile or a disc.
pub fn finding(
    planned: &PlannedContact<'_>,
    struck: &Struck<'_>,
    contact: Option<f64>,
    expected: Option<&Expected<'_>>,
) -> Option<Advice> {
    let free_motion = free_motion(struck)?;
    let end = planned.settings.end;
    let seen = expected.and_then(|expected| expected.begins);
    let untouched = expected.is_some_and(|expected| expected.stays == Stays::Untouched);
    let (time, known) = match (acts(planned, struck), seen) {
        (None, _) => (free_motion, Known::FreeMotion),
        (Some(_), Some(seen)) => (seen, Known::Trial),
        (Some(_), None) if untouched => {
            let last = quantity(end, "s");
            let text = format!("no contact before the end ({last}) in a trial computation");
            return Some(planned.finding(
                Topic::FirstContact,
                [f64::NAN, end],
                "s",
                Verdict::Warning,
                text,
            ));
        }
        (Some(why), None) => (free_motion, Known::Guess(why)),
    };
    let (verdict, text) = assessed(time, end, contact.unwrap_or(0.0), known);
    Some(planned.finding(Topic::FirstContact, [time, end], "s", verdict, text))
}

/// Time of the first touch by the motion both start with and a steady gravity \[s\]; none if they touch already or something else has to
/// bring them together.
fn free_motion(struck: &Struck<'_>) -> Option<f64> {
    let (gap, speed, pull) = (struck.gap?, struck.speed, struck.pull());
    let root = (speed * speed + 2.0 * pull * gap).sqrt();
    let time = 2.0 * gap / (speed + root);
    (gap > 0.0 && time.is_finite() && time >= 0.0).then_some(time)
}

/// What else moves one of the two before they touch.
fn acts(planned: &PlannedContact<'_>, struck: &Struck<'_>) -> Option<&'static str> {
    let model = planned.model;
    let around = Surroundings::of(model, struck.place.index);
    let (pull, loads) = gravity(model);
    if loads || gravity_varies(model) {
        return Some("other loads act as well");
    }
    if model.supports().any(|support| support.moves) {
        return Some("a support has a prescribed motion");
    }
    if model.contacts().len() > 1 {
        return Some("other contacts are possible before");
    }
    let starts = around.start(model);
    if starts.is_none_or(|v| around.held && norm(v) > 0.0) {
        return Some("the beam has an initial motion");
    }
    if !around.is_relaxed(model) {
        return Some("a spring is strained at the start");
    }
    if norm(pull) > 0.0 && around.held && planned.settings.start != Start::Static {
        return Some("the beam vibrates under its own weight from the start");
    }
    None
}

/// The finding about a first contact that is still to come.
fn assessed(time: f64, end: f64, contact: f64, known: Known) -> (Verdict, String) {
    let (first, last) = (quantity(time, "s"), quantity(end, "s"));
    if let Known::Guess(why) = known {
        let side = if time >= end { "after" } else { "before" };
        let text = format!(
            "first contact at {first} for free motion, {side} the end ({last}); {why}, so that it may be earlier or later"
        );
        return (if time >= end { Verdict::Note } else { Verdict::Unchecked }, text);
    }
    let seen = if known == Known::Trial { " in a trial computation" } else { "" };
    if time >= end {
        let enough = quantity(time + 3.0 * contact, "s");
        let text = format!(
            "the run ends ({last}) before the first contact ({first}{seen}); set time.end > {enough}"
        );
        (Verdict::Warning, text)
    } else if time + contact > end {
        let over = quantity(time + contact, "s");
        let text = format!(
            "first contact at {first}{seen}, still closed at the end of the run ({last}); set time.end > {over}"
        );
        (Verdict::Note, text)
    } else {
        (Verdict::Fine, format!("first contact at {first} of {last}{seen}"))
    }
}

/// Replaces what was expected by what a run shows.
pub fn settle(advice: &mut [Advice], settings: &Settings, run: &RunSummary) {
    for one in advice.iter_mut().filter(|one| one.topic == Topic::FirstContact) {
        let Some(contact) = run.contacts.iter().find(|c| c.name == one.contact) else { continue };
        let expected = one.value;
        one.reason = None;
        one.value = first(contact).unwrap_or(f64::NAN);
        let completed = matches!(run.termination, Termination::Completed);
        (one.verdict, one.text) = match first(contact) {
            Some(time) => {
                let text = format!(
                    "first contact at {} of {}",
                    quantity(time, "s"),
                    quantity(settings.end, "s")
                );
                (Verdict::Fine, text)
            }
            None if completed => {
                let (verdict, later) = match expected < settings.end {
                    true => (Verdict::Note, String::new()),
                    false if expected.is_nan() => (Verdict::Warning, String::new()),
                    false => {
                        let later = format!(
                            " (expected at {}): set a later time.end",
                            quantity(expected, "s")
                        );
                        (Verdict::Warning, later)
                    }
                };
                let text = format!(
                    "no contact up to the end of the run ({}){later}",
                    quantity(settings.end, "s")
                );
                (verdict, text)
            }
            None => (Verdict::Fine, format!("no contact up to {}", quantity(run.time, "s"))),
        };
    }
}

/// When a contact closed first \[s\].
fn first(contact: &ContactSummary) -> Option<f64> {
    let began = contact.record.intervals().first().map(|interval| interval.start);
    let struck = match &contact.record {
        ContactRecord::Nonsmooth { impacts, .. } => impacts.first().map(|impact| impact.time),
        ContactRecord::Smooth { .. } => None,
    };
    began.into_iter().chain(struck).reduce(f64::min)
}
