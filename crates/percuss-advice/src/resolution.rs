//! Whether steps and rows show a contact.

use super::case::Meeting;
use super::duration::{From, Lasting};
use super::expected::{Expected, Stays};
use super::planned::{PlannedContact, STEPS, graded};
use super::words::{digits, quantity, round_down};
use super::{Advice, Topic, Verdict};
use percuss::inspect::ConnectorLaw;
use percuss::{ContactInterval, FoundationLaw};

/// Errors of a force that are fine, and that are worth a warning.
const OFF: [f64; 2] = [0.01, 0.05];
/// Steps of a contact below which its beginning and end are half of what is known of it.
const RESOLVED: f64 = ContactInterval::RESOLVED as f64;
/// Rows of the history that show the course of a contact, and that hardly do.
pub(super) const ROWS: [f64; 2] = [10.0, 4.0];
/// Deflections below this share of the radius of gyration (or of the length, where ends slide) leave the stiffness as it is.
const SMALL: f64 = 0.3;
const SMALL_SLIDING: f64 = 0.05;

impl PlannedContact<'_> {
    /// How long the contact lasts, and whether steps resolve it.
    pub fn duration(&self, expected: &Expected<'_>) -> Advice {
        let step = self.settings.step;
        let (about, contact) = match &expected.stays {
            Stays::About(time) => ("lasts about", *time),
            Stays::AtLeast(time) => ("lasts at least", *time),
            Stays::Untouched => {
                let text = "no contact before the end in a trial computation";
                return self.no_duration(Verdict::Fine, text.to_owned());
            }
            Stays::Unknown(why) => {
                let text = format!("contact duration not estimated: {why}");
                return self.no_duration(Verdict::Unchecked, text);
            }
        };
        let steps = contact / step;
        let mut text =
            format!("the contact {about} {}, {} steps", quantity(contact, "s"), digits(steps));
        match (&expected.stays, expected.otherwise) {
            (Stays::AtLeast(_), _) => text += ", where the trial computation ended",
            (_, Some(modes)) => {
                text += &format!(
                    " by a trial computation (linear structure with its modes: {})",
                    quantity(modes, "s")
                );
            }
            _ => (),
        }
        let off = expected.lasting.and_then(|lasting| lasting.off(step));
        let verdict = self.resolved(steps, off);
        if verdict != Verdict::Fine {
            text += &self.finer(expected.lasting, contact, off);
        }
        self.finding(Topic::ContactDuration, [contact, step], "s", verdict, text)
    }

    fn no_duration(&self, verdict: Verdict, text: String) -> Advice {
        let values = [f64::NAN, self.settings.step];
        self.finding(Topic::ContactDuration, values, "s", verdict, text)
    }

    fn resolved(&self, steps: f64, off: Option<f64>) -> Verdict {
        match off {
            _ if steps < 2.0 => Verdict::Warning,
            Some(off) if off < OFF[0] && steps < RESOLVED => Verdict::Note,
            Some(off) => graded(-off, OFF.map(|x| -x)),
            None => graded(steps, STEPS),
        }
    }

    /// What too few steps do to a contact, and how many would do.
    fn finer(&self, lasting: Option<&Lasting>, contact: f64, off: Option<f64>) -> String {
        let step = self.settings.step;
        let mut better = step.min(contact);
        for _ in 0..40 {
            better = round_down(0.5 * better);
            let off = lasting.and_then(|lasting| lasting.off(better));
            if contact / better >= STEPS[0] && off.is_none_or(|off| off < OFF[0]) {
                break;
            }
        }
        let better = quantity(better, "s");
        let few = match contact / step < STEPS[0] {
            true => format!("; {} are recommended", STEPS[0]),
            false => String::new(),
        };
        match off.filter(|_| contact / step >= 2.0) {
            Some(off) if off < OFF[0] => format!(
                "{few}: peak force accurate to 1 %, duration and velocities poorly resolved; set time.step to {better}"
            ),
            Some(off) => format!(
                "{few}: expected error of the peak force {} %; set time.step to {better}",
                digits((100.0 * off).round().max(1.0))
            ),
            None if contact / step >= 2.0 => format!("{few}: set time.step to {better}"),
            None => format!("{few}: the contact is not resolved; set time.step to {better}"),
        }
    }

    /// The deflection up to which the struck beam is linear, where the contact bends it farther: a third of the radius of gyration
    /// where ends cannot slide or the beam is curved, a twentieth of its length else. Stops that close count as a change, too.
    pub fn bends_beyond(&self, lasting: &Lasting) -> Option<f64> {
        let Meeting::Struck(struck) = &self.case.meeting else { return None };
        let (place, section) = (&struck.place, struck.place.section());
        let stiffens = place.is_held_lengthwise() || !place.is_uniform();
        let limit = match stiffens {
            true => SMALL * section.gyration(),
            false => SMALL_SLIDING * place.beam.length(),
        };
        let limit = limit.min(self.nearest_stop());
        (lasting.from == From::Modes && lasting.deflection > limit).then_some(limit)
    }

    /// Least gap of a stop, of a spring or a foundation of one side \[m\].
    fn nearest_stop(&self) -> f64 {
        let gaps = self.model.connectors().map(|one| match one.law() {
            ConnectorLaw::OneSided { gap, .. } => (gap - one.coordinate().reference()).abs(),
            ConnectorLaw::Linear { .. } | ConnectorLaw::Tabulated { .. } => f64::INFINITY,
        });
        let lifts = self.model.foundations().map(|one| match one.law() {
            FoundationLaw::Compression { gap, .. } => *gap,
            FoundationLaw::Linear { .. } | FoundationLaw::Table { .. } => f64::INFINITY,
        });
        gaps.chain(lifts).fold(f64::INFINITY, f64::min)
    }

    /// Rows of the history against the contact.
    pub fn recording(&self, contact: f64) -> Option<Advice> {
        let every = self.settings.record_every.max(1);
        let between = self.settings.step * every as f64;
        let rows = contact / between;
        // A row a step shows what there is.
        let verdict = if every == 1 { Verdict::Fine } else { graded(rows, ROWS) };
        let mut text = format!(
            "output interval {}, {} rows during the contact of {}",
            quantity(between, "s"),
            digits(rows),
            quantity(contact, "s")
        );
        if verdict != Verdict::Fine {
            let most = (contact / STEPS[0] / self.settings.step).floor().max(1.0);
            text += &format!(
                ": curves do not resolve the contact (peaks in the summary do); set record.every to {}",
                digits(most)
            );
        }
        let values = [between, contact];
        Some(self.finding(Topic::Recording, values, "s", verdict, text))
    }
}
