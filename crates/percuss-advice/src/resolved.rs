//! Whether the steps of a finished run resolve its largest forces: of contacts, stops, springs and foundations, judged by their own
//! steps.

use super::after::rigid_duration;
use super::planned::{STEPS, graded};
use super::words::{digits, quantity, round_down};
use super::{Advice, Topic, Verdict};
use percuss::{ContactInterval, ContactRecord, ContactSummary, Peak, PulseOf, PulseSummary};
use percuss::{Model, RunSummary, Settings, StepControl};

/// Forces whose work is less than this share of the energy of the run are round-off, or matter to nobody.
const SLIGHT: f64 = 1e-9;
/// Steps of a half wave about its largest value that resolve it, and that hardly show it: between steps the value is larger by up to
/// `1 - cos(pi/2N)`, one and two per cent, and the motion that leads to it is off by about as much.
const HALF_WAVE: [f64; 2] = [12.0, STEPS[1]];
/// Steps that show of a contact no more than that it closed.
const NEXT_TO_NONE: f64 = 3.5;
/// A damper's force at the closing that exceeds the largest one at the end of a step by this share is lost in the step; with so many steps in the time
/// in which it falls it is not.
const ONSET: f64 = 0.03;
const STEPS_IN_FALL: f64 = 50.0;
/// With fewer steps than this the duration of a closed interval is not known by their number.
const SEEN: f64 = STEPS[1];

/// Findings about all of them; `before` are those before the run.
pub fn findings(
    model: &Model,
    settings: &Settings,
    run: &RunSummary,
    before: &[Advice],
) -> Vec<Advice> {
    let others = run.pulses.iter().filter_map(|pulse| of_connector(settings, run, pulse));
    let contact = |(index, contact)| of_contact((model, settings, run), before, index, contact);
    let contacts = run.contacts.iter().enumerate().filter_map(contact);
    let accuracy = run.step_control.as_ref().and_then(accuracy);
    accuracy.into_iter().chain(contacts).chain(others).collect()
}

/// Steps of a contact that resolve it, and that hardly show it; `given` are those of a given step. Steps for an accuracy follow the forces of contacts
/// (not those of stops, springs and foundations) with as few as that takes, `pi / sqrt(12 a)` in a half wave: of less than two thirds of that number,
/// or next to none, they know nothing.
fn enough(run: &RunSummary, given: [f64; 2]) -> [f64; 2] {
    match &run.step_control {
        None => given,
        Some(control) => {
            let planned = std::f64::consts::PI / (12.0 * control.accuracy).sqrt();
            [(planned / 1.5).clamp(NEXT_TO_NONE, SEEN); 2]
        }
    }
}

/// The contact duration that was not known before a run and is known after it.
pub fn is_settled(before: &Advice, after: &[Advice]) -> bool {
    let same = |one: &Advice| one.topic == before.topic && one.contact == before.contact;
    before.verdict == Verdict::Unchecked
        && before.topic == Topic::ContactDuration
        && after.iter().any(same)
}

/// An accuracy that was requested and not reached.
fn accuracy(control: &StepControl) -> Option<Advice> {
    if control.is_reached() {
        return None;
    }
    let percent = |share: f64| digits(100.0 * share);
    let text = format!(
        "the requested accuracy of {} % is not reached: estimated error {} %, since steps are not made shorter than a hundredth of the first; request an accuracy of \
         {} %, or give a time.step and compare two of them (percuss converge)",
        percent(control.accuracy),
        percent(control.estimate),
        percent(round_up(control.estimate))
    );
    let values = [control.estimate, control.accuracy];
    Some(Advice::new("steps", Topic::Accuracy, values, "1", Verdict::Warning, text))
}

/// A value rounded up to one digit.
fn round_up(value: f64) -> f64 {
    let power = 10_f64.powf(value.log10().floor());
    (value / power * (1.0 - 1e-9)).ceil() * power
}

/// The steps of the interval with the largest force of a contact, and those about this force.
struct Seen<'a> {
    hardest: &'a ContactInterval,
    /// Steps of the interval, if it has ended.
    whole: Option<f64>,
    /// Steps of the half wave of the force about its largest value, and their size \[s\].
    half_wave: f64,
    step: f64,
}

impl<'a> Seen<'a> {
    fn of(run: &'a RunSummary, index: usize, contact: &'a ContactSummary) -> Option<Self> {
        let ContactRecord::Smooth { intervals, .. } = &contact.record else { return None };
        let force = |one: &&ContactInterval| one.peak_force.value;
        let known = intervals.iter().filter(|one| !one.peak_force.value.is_nan());
        let hardest = known.max_by(|a, b| force(a).total_cmp(&force(b)))?;
        let pulse = run.pulses.iter().find(|pulse| pulse.of == PulseOf::Contact(index));
        let [half_wave, step] = pulse.map_or([f64::NAN; 2], |pulse| [pulse.steps, pulse.step]);
        let whole = (!hardest.end.is_nan()).then_some(hardest.steps as f64);
        Some(Self { hardest, whole, half_wave, step })
    }

    /// The worse verdict of the two, as far as they are known, and whether it is that of the half wave.
    fn verdict(&self, run: &RunSummary) -> Option<(Verdict, bool)> {
        let whole = self.whole.map(|steps| (graded(steps, enough(run, STEPS)), false));
        let half_wave = Some(self.half_wave).filter(|steps| !steps.is_nan());
        let half_wave = half_wave.map(|steps| (graded(steps, enough(run, HALF_WAVE)), true));
        whole.into_iter().chain(half_wave).max_by_key(|(verdict, is_half)| (*verdict, !is_half))
    }
}

/// A contact by the interval with its largest force. What an estimate before the run knows of the first interval is not said again.
fn of_contact(
    (model, settings, run): (&Model, &Settings, &RunSummary),
    before: &[Advice],
    index: usize,
    contact: &ContactSummary,
) -> Option<Advice> {
    let seen = Seen::of(run, index, contact)?;
    let mut reported = (before.iter())
        .filter(|one| one.topic == Topic::ContactDuration && one.contact == contact.name);
    let first = contact.record.intervals().first().map(|one| one.start);
    let is_first = first == Some(seen.hardest.start);
    let advice = |verdict, text| {
        let duration = seen.hardest.end - seen.hardest.start;
        let values = [duration, settings.step];
        Some(Advice::new(&contact.name, Topic::ContactDuration, values, "s", verdict, text))
    };
    let unchecked = reported.clone().any(|one| one.verdict == Verdict::Unchecked);
    let Some((verdict, is_half)) = seen.verdict(run) else {
        let text = "the run ends at the largest force: its steps are not checked".to_owned();
        return if unchecked { advice(Verdict::Unchecked, text) } else { None };
    };
    // An estimate that found the steps fine knows more than their number, unless they are next to none.
    let known = reported.any(|one| match one.verdict {
        Verdict::Unchecked => false,
        Verdict::Fine => one.value.is_finite() && is_first && verdict != Verdict::Warning,
        _ => is_first,
    });
    if known || (verdict == Verdict::Fine && !unchecked) {
        return None;
    }
    let Peak { value, time } = seen.hardest.peak_force;
    let (what, time, steps) = match seen.whole {
        Some(whole) if !is_half => {
            let duration = quantity(seen.hardest.end - seen.hardest.start, "s");
            (format!("contact of {duration}"), seen.hardest.start, whole)
        }
        _ => (format!("largest contact force, {}", quantity(value, "N")), time, seen.half_wave),
    };
    let alone = rigid_duration(model, index, contact, seen.hardest);
    // Steps for an accuracy have no size of their own.
    let step = match seen.whole {
        _ if settings.accuracy.is_none() => settings.step,
        Some(whole) if !is_half => (seen.hardest.end - seen.hardest.start) / whole,
        _ => seen.step,
    };
    let sizes = [step, alone.unwrap_or(f64::NAN)];
    advice(verdict, in_words(&what, time, steps, sizes, verdict) + instead(settings))
}

/// What a step replaces that is asked for.
fn instead(settings: &Settings) -> &'static str {
    match settings.accuracy {
        Some(_) => " in place of time.accuracy, or request a higher one",
        None => "",
    }
}

/// Subject and words for a stop, a spring or a foundation.
pub fn named(of: &PulseOf) -> Option<(String, String)> {
    match of {
        PulseOf::Contact(_) => None,
        PulseOf::Stop(name) => Some((format!("support {name}"), format!("stop '{name}'"))),
        PulseOf::Spring(name) => Some((format!("spring {name}"), format!("spring '{name}'"))),
        PulseOf::Foundation(name) => {
            Some((format!("foundation {name}"), format!("foundation '{name}'")))
        }
    }
}

/// Whether the work of the largest force is round-off.
pub fn is_slight(pulse: &PulseSummary, run: &RunSummary) -> bool {
    pulse.energy <= SLIGHT * run.energy.scale
}

/// Unit of its force.
fn unit(of: &PulseOf) -> &'static str {
    if matches!(of, PulseOf::Foundation(_)) { "N/m" } else { "N" }
}

/// A damper whose force at the closing is lost in the first step.
fn of_damper(settings: &Settings, pulse: &PulseSummary) -> Option<Advice> {
    let (subject, what) = named(&pulse.of)?;
    let Peak { value, time } = pulse.onset;
    let lost = value > (1.0 + ONSET) * pulse.force.value;
    if !lost || !pulse.falls.is_finite() {
        return None;
    }
    let [jump, seen] = [value, pulse.force.value].map(|force| quantity(force, unit(&pulse.of)));
    let text = format!(
        "{what} closes at t = {}, where the force of its damper jumps to {jump} (damping times closing velocity) and falls within about {}: the largest \
         force of a step, {seen}, is too small; set time.step to {}{}",
        quantity(time, "s"),
        quantity(pulse.falls, "s"),
        quantity(round_down(pulse.falls / STEPS_IN_FALL), "s"),
        instead(settings)
    );
    let values = [pulse.falls, settings.step];
    Some(Advice::new(subject, Topic::ContactDuration, values, "s", Verdict::Warning, text))
}

/// A stop, a spring or a foundation by the steps about its largest force, and by that at the closing.
fn of_connector(settings: &Settings, run: &RunSummary, pulse: &PulseSummary) -> Option<Advice> {
    let (subject, what) = named(&pulse.of)?;
    if is_slight(pulse, run) {
        return None;
    }
    if let Some(found) = of_damper(settings, pulse) {
        return Some(found);
    }
    if pulse.steps.is_nan() {
        return None;
    }
    let verdict = graded(pulse.steps, HALF_WAVE);
    if verdict == Verdict::Fine {
        return None;
    }
    let Peak { value, time } = pulse.force;
    let what = format!("largest force of {what}, {}", quantity(value, unit(&pulse.of)));
    let text = in_words(&what, time, pulse.steps, [pulse.step, pulse.lasts], verdict);
    let values = [pulse.steps * pulse.step, pulse.step];
    let text = text + instead(settings);
    Some(Advice::new(subject, Topic::ContactDuration, values, "s", verdict, text))
}

/// What so few steps mean, and the step that would be enough; `step` and the duration by the law and the mass alone \[s\], NaN if unknown.
fn in_words(
    what: &str,
    time: f64,
    steps: f64,
    [step, alone]: [f64; 2],
    verdict: Verdict,
) -> String {
    let (time, count) = (quantity(time, "s"), digits(steps));
    if verdict == Verdict::Fine {
        return format!("{what} at t = {time}: {count} steps");
    }
    let shown = steps * step;
    let lasts = if steps < SEEN { shown.min(alone) } else { shown };
    let better = quantity(round_down(lasts / STEPS[0]), "s");
    format!(
        "{what} at t = {time} resolved by {count} steps ({} recommended): peak force and velocities are inaccurate; set time.step to {better}",
        STEPS[0]
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_accuracy_that_is_not_reached_is_a_warning() {
        let control = StepControl {
            accuracy: 0.01,
            estimate: 0.0348769,
            smallest: 2e-8,
            largest: 5e-5,
            mean: 1e-6,
            steps: 700_000,
            refused: 0,
        };
        let found = accuracy(&control).expect("a warning");
        assert_eq!((found.verdict, found.topic), (Verdict::Warning, Topic::Accuracy));
        assert_eq!(
            found.text,
            "the requested accuracy of 1 % is not reached: estimated error 3.49 %, since steps are not made shorter than a hundredth of the first; request an \
             accuracy of 4 %, or give a time.step and compare two of them (percuss converge)"
        );
        assert_eq!(accuracy(&StepControl { estimate: 0.01, ..control }), None);
    }
}
