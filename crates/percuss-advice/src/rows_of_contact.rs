//! Rows of the history during the contacts of a finished run.

use super::planned::graded;
use super::resolution::ROWS;
use super::words::{digits, quantity};
use super::{Advice, Topic};
use percuss::{ContactRecord, ContactSummary, Settings};

/// A contact that the history has few rows of, where nothing could be said of it before the run: its hardest interval that the steps resolve.
pub(super) fn coarse(
    contact: &ContactSummary,
    settings: &Settings,
    before: &[Advice],
) -> Option<Advice> {
    let every = settings.record_every;
    let known = |one: &Advice| one.topic == Topic::Recording && one.contact == contact.name;
    if every <= 1 || before.iter().any(known) {
        return None;
    }
    let ContactRecord::Smooth { intervals, .. } = &contact.record else { return None };
    let whole = intervals.iter().filter(|one| !one.end.is_nan() && one.steps > 1);
    let hardest = whole.max_by(|a, b| a.impulse.abs().total_cmp(&b.impulse.abs()))?;
    let (steps, duration) = (hardest.steps as f64, hardest.end - hardest.start);
    let rows = steps / every as f64;
    let verdict = graded(rows, ROWS);
    if verdict == super::Verdict::Fine {
        return None;
    }
    let better = (steps / ROWS[0]).floor().max(1.0);
    let text = format!(
        "a row every {every} steps, {} rows during the contact of {} at t = {}: curves do not resolve the contact (peaks in the summary do); set \
         record.every to {}",
        digits(rows),
        quantity(duration, "s"),
        quantity(hardest.start, "s"),
        digits(better)
    );
    let values = [duration / rows, duration];
    Some(Advice::new(&contact.name, Topic::Recording, values, "s", verdict, text))
}
