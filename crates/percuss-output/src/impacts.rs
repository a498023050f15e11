//! `impacts.csv`: the impact log, one row an impact, an interval of closed contact or a time in which a stop pressed, in the order of
//! time.
//!
//! Forces and impulses have columns of their own: an impact has no force, and none is made up from its impulse. Fields that do
//! not apply are empty. Always CSV: it holds names, and it is small beside any history.

use std::fmt::Write as _;
use std::path::Path;

use percuss::{
    ContactInterval, ContactPlace, ContactRecord, ContactSummary, EnergySplit, Impact,
    NoRestitution, Peak, StopTouch, SupportSummary,
};

use crate::csv_text;
use crate::error::Error;
use crate::files;

const IMPACTS: &str = "impacts.csv";
const HEADER: &str = "contact,first,second,kind,start_s,end_s,impulse_N_s,friction_impulse_N_s,\
     force_peak_N,force_peak_time_s,approach_m_per_s,separation_m_per_s,restitution,place_m,x_m,y_m,\
     given_to_first_J,given_to_second_J,lost_J,stored_J,scheme_J,fallback_law,points,steps,no_restitution";

/// A row before it is written; NaN where something does not apply.
struct Row<'a> {
    /// The contact, or the stop, and the two between which it is: of a stop none.
    name: &'a str,
    /// Names of both partners, shape (2).
    between: [&'a str; 2],
    kind: &'static str,
    start: f64,
    /// Numbers between `start_s` and the places, shape (8) \[unit of the column\].
    numbers: [f64; 8],
    place: ContactPlace,
    energy: EnergySplit,
    fallback_law: Option<bool>,
    /// Points of an impact, steps of an interval, shape (2) \[-\].
    counts: [Option<usize>; 2],
    /// Why there is no coefficient of restitution.
    why: Option<NoRestitution>,
}

/// Writes `impacts.csv` into `dir`.
///
/// # Errors
/// If the file cannot be written.
pub fn write_impacts(
    dir: impl AsRef<Path>,
    contacts: &[ContactSummary],
    supports: &[SupportSummary],
) -> Result<(), Error> {
    let stops = supports.iter().flat_map(|support| {
        let touches = support.touches.as_deref().unwrap_or_default();
        touches.iter().map(move |touch| row_of_stop(support, touch))
    });
    let mut rows: Vec<Row<'_>> = contacts.iter().flat_map(rows).chain(stops).collect();
    rows.sort_by(|a, b| a.start.total_cmp(&b.start)); // stable: of one instant in the contacts' order
    let mut text = format!("{HEADER}\n");
    rows.iter().for_each(|row| row.write(&mut text));
    files::write(&dir.as_ref().join(IMPACTS), text.as_bytes())
}

fn rows(contact: &ContactSummary) -> Vec<Row<'_>> {
    let (impacts, intervals): (&[Impact], &[ContactInterval]) = match &contact.record {
        ContactRecord::Smooth { intervals, .. } => (&[], intervals),
        ContactRecord::Nonsmooth { impacts, intervals, .. } => (impacts, intervals),
    };
    let (name, between) = (contact.name.as_str(), contact.between.each_ref().map(String::as_str));
    let impact = |i: &Impact| Row {
        name,
        between,
        kind: "impact",
        start: i.time,
        numbers: [
            f64::NAN,
            i.impulse,
            i.tangential_impulse,
            f64::NAN,
            f64::NAN,
            i.approach_velocity,
            i.separation_velocity,
            i.restitution().unwrap_or(f64::NAN),
        ],
        place: i.place,
        energy: i.energy,
        fallback_law: Some(i.fallback_law),
        counts: [Some(i.points), None],
        why: i.restitution().err(),
    };
    let interval = |i: &ContactInterval| Row {
        name,
        between,
        kind: "interval",
        start: i.start,
        numbers: [
            i.end,
            i.impulse,
            i.tangential_impulse,
            i.peak_force.value,
            i.peak_force.time,
            i.approach_velocity,
            i.separation_velocity,
            i.restitution().unwrap_or(f64::NAN),
        ],
        place: i.place,
        energy: i.energy,
        fallback_law: None,
        counts: [None, Some(i.steps)],
        why: i.restitution().err(),
    };
    impacts.iter().map(impact).chain(intervals.iter().map(interval)).collect()
}

fn row_of_stop<'a>(support: &'a SupportSummary, touch: &StopTouch) -> Row<'a> {
    let nan = f64::NAN;
    let Peak { value, time } = touch.peak_force;
    let none = ContactPlace { s: nan, position: [nan; 2] };
    Row {
        name: &support.name,
        between: [""; 2],
        kind: "stop",
        start: touch.start,
        numbers: [touch.end.unwrap_or(nan), touch.impulse, nan, value, time, nan, nan, nan],
        place: none,
        energy: EnergySplit { given: [nan; 2], lost: nan, failure: nan, stored: nan, scheme: nan },
        fallback_law: None,
        counts: [None, None],
        why: None,
    }
}

impl Row<'_> {
    fn write(&self, text: &mut String) {
        let [first, second] = self.between;
        for name in [self.name, first, second] {
            if !name.is_empty() {
                text.push_str(&csv_text::quote(name));
            }
            text.push(',');
        }
        text.push_str(self.kind);
        let [x, y] = self.place.position;
        let EnergySplit { given: [to_first, to_second], lost, stored, scheme, .. } = self.energy;
        let behind = [self.place.s, x, y, to_first, to_second, lost, stored, scheme];
        let mut buffer = zmij::Buffer::new();
        for value in [self.start].into_iter().chain(self.numbers).chain(behind) {
            let number = if value.is_nan() { "" } else { buffer.format(value) };
            let _ = write!(text, ",{number}"); // a String never fails
        }
        let fallback_law = self.fallback_law.map_or("", |law| if law { "true" } else { "false" });
        let _ = write!(text, ",{fallback_law}");
        for count in self.counts {
            let _ = write!(text, ",{}", count.map_or(String::new(), |n| n.to_string()));
        }
        let why = self.why.map_or(String::new(), |why| csv_text::quote(&why.to_string()));
        let _ = writeln!(text, ",{why}");
    }
}
