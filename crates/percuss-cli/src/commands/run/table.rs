//! The table at the end of a run.

mod contacts;
mod lines;

use std::path::Path;

use percuss::{
    FoundationSummary, JointSummary, Peak, PlasticSummary, PulseOf, PulseSummary, RunSummary,
    StepControl, SupportSummary, Termination, YieldingSummary,
};
use percuss_advice::Comparison;
use percuss_output::report::{RunState, story};
use percuss_output::round_off::{SMALL_IMPULSE, Scales, is_round_off, without_round_off};
use serde_json::Value;

use super::drift::{drift, unresolved};
use super::ended::Ended;
use crate::foundation_text::foundation_place;
use crate::number::{count, number, quantity, small};
use crate::plastic_text::{permanent_deflection, plastic_hinges};
use crate::terminal::{self, painted};
use contacts::contact_lines;
use lines::listed;
use percuss_output::shown::{BRIEF, NAMES};

/// The summary text, the balances and the results of a run, with the output directory.
pub(super) fn table(ended: &Ended, out: &Path) -> String {
    let run = &ended.summary;
    let mut rows = vec![("status".to_owned(), status(ended))];
    let scales = Scales::of(&ended.value);
    rows.push(("energy".into(), energy(run, &scales)));
    rows.push((
        "momentum".into(),
        format!(
            "residual linear {}, angular {} (relative)",
            small(run.momentum.linear_residual_max),
            small(run.momentum.angular_residual_max)
        ),
    ));
    rows.extend(drift(run, &ended.value));
    rows.extend(unresolved(run));
    let (touched, untouched): (Vec<_>, Vec<_>) =
        run.contacts.iter().partition(|c| c.record.has_closed());
    let alone = if untouched.len() == 1 { &untouched[..] } else { &[] };
    for contact in touched.iter().chain(alone) {
        let label = format!("contact '{}'", contact.name);
        let lines = contact_lines(contact, run, &scales);
        let labels = [label].into_iter().chain(std::iter::repeat(String::new()));
        rows.extend(labels.zip(lines));
    }
    if untouched.len() > 1 {
        let names: Vec<&str> = untouched.iter().map(|c| c.name.as_str()).collect();
        let names = listed(&names, names.len(), NAMES, |name| format!("'{name}'"));
        rows.push((count(untouched.len(), "contact"), format!("not closed: {}", names.join(", "))));
    }
    rows.extend(run.plastic.iter().filter_map(plastic));
    rows.extend(run.yielding.iter().filter_map(yielding));
    rows.extend(first_of(springs(run)));
    rows.extend(first_of(stops(run)));
    rows.extend(run.foundations.iter().map(foundation));
    rows.extend(run.joints.iter().map(joint));
    let labels =
        ["support impulses".to_owned()].into_iter().chain(std::iter::repeat(String::new()));
    rows.extend(labels.zip(impulses(run)));
    rows.extend(run.step_control.as_ref().map(|control| ("steps".into(), steps(control))));
    if run.accumulated_steps > 0 {
        let steps = count(run.accumulated_steps, "step");
        let what = "had more impacts than are followed one by one; their last impacts are without rebound (a smaller step follows more)";
        rows.push(("accumulation".into(), format!("{steps} {what}")));
    }
    let by_hand = ["hand formulas".to_owned()].into_iter().chain(std::iter::repeat(String::new()));
    let compared = comparisons(&ended.comparisons);
    rows.extend(by_hand.zip(listed(&compared, compared.len(), BRIEF, String::clone)));
    rows.push(("results".into(), out.display().to_string()));
    let width = rows.iter().map(|(label, _)| label.chars().count()).max().unwrap_or(0);
    let title = ended.value["title"].as_str().filter(|title| !title.is_empty());
    let mut text = title.map_or(String::new(), |title| format!("{}\n", painted(title, "1")));
    let columns = terminal::width().unwrap_or(100).saturating_sub(2);
    for line in wrapped(&story(&ended.value), columns) {
        text.push_str(&format!("  {line}\n"));
    }
    for (label, value) in rows {
        text.push_str(&format!("  {label:width$}  {value}\n"));
    }
    text
}

/// A text in lines of at most so many columns, broken at spaces.
fn wrapped(text: &str, columns: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        let word = word.replace('\u{a0}', " "); // a number keeps its unit
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= columns => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

/// Yield, plastic hinge, permanent deflection and fracture of a beam.
fn plastic(beam: &PlasticSummary) -> Option<(String, String)> {
    let first = beam.first_yield?;
    let mut parts = vec![
        format!("first yield at s = {}, t = {}", quantity(first.s, "m"), quantity(first.time, "s")),
        format!("largest plastic strain {}", number(beam.strain_max.value)),
        dissipated(beam.dissipated, beam.dissipated_by_preload),
    ];
    parts.extend(plastic_hinges(&beam.hinges));
    match beam.permanent_set {
        Err(reason) => parts.push(format!("permanent deflection not available: {reason}")),
        Ok(set) => parts.push(permanent_deflection(&set)),
    }
    if beam.failed > 0 {
        parts.push(format!("{} failed", count(beam.failed, "fibre")));
    }
    if let [first, others @ ..] = &beam.parted[..] {
        let more = if others.is_empty() {
            String::new()
        } else {
            format!(" and at {}", count(others.len(), "more place"))
        };
        let (s, time) = (quantity(first.s, "m"), quantity(first.time, "s"));
        parts.push(format!("fractured at s = {s}, t = {time}{more}"));
    }
    Some((format!("yield of '{}'", beam.name), parts.join(", ")))
}

/// Plastic dissipation, and the part of it in a static start.
fn dissipated(all: f64, by_preload: f64) -> String {
    match !is_round_off(by_preload, all) {
        true => format!(
            "{} dissipated ({} in the static start, {} in the run)",
            quantity(all, "J"),
            quantity(by_preload, "J"),
            quantity(without_round_off(all - by_preload, all), "J")
        ),
        false => format!("{} dissipated", quantity(all, "J")),
    }
}

/// Place, law, reaction, lift-off and yielding of a foundation.
fn foundation(found: &FoundationSummary) -> (String, String) {
    let most = found.pressure.largest();
    let (pressure, s) = (quantity(most.value, "N/m"), quantity(most.s, "m"));
    let time = quantity(most.time, "s");
    let mut parts = foundation_place(&found.properties);
    parts.push(match most.value {
        0.0 => "no elastic reaction".to_owned(),
        _ => format!("largest reaction {pressure} at s = {s}, t = {time}"),
    });
    if found.lifted.value > 0.0 {
        parts.push(format!("lifted off over up to {}", quantity(found.lifted.value, "m")));
    }
    if found.plastic.value != 0.0 {
        parts.push(format!("plastic deflection {}", quantity(found.plastic.value, "m")));
        parts.push(dissipated(found.dissipated, found.dissipated_by_preload));
    }
    (format!("foundation '{}'", found.name), parts.join(", "))
}

/// Failure of a joint of a given strength, or its largest loads.
fn joint(joint: &JointSummary) -> (String, String) {
    let load = |force: f64, moment: f64, joined: &str| {
        let moment = if moment > 0.0 {
            format!("{joined}{}", quantity(moment, "N*m"))
        } else {
            String::new()
        };
        format!("{}{moment}", quantity(force, "N"))
    };
    let text = match joint.parted {
        Some(one) if one.force.is_nan() => "failed in the static start".to_owned(),
        Some(one) => {
            let time = quantity(one.time, "s");
            format!("failed at t = {time} under {}", load(one.force, one.moment, " and "))
        }
        // The largest force and the largest moment may act at different times.
        None => {
            let most = load(joint.force_max.value, joint.moment_max.value, ", largest moment ");
            format!("intact; largest force {most}")
        }
    };
    (format!("joint '{}'", joint.name), text)
}

/// Yield, fracture and failure of a spring or hinge.
fn yielding(connector: &YieldingSummary) -> Option<(String, String)> {
    let Some(first) = connector.first_yield else {
        let time = quantity(connector.failed?, "s");
        let reached = reached_before(connector);
        return Some((
            format!("failure of '{}'", connector.name),
            format!("at t = {time}{reached}"),
        ));
    };
    let [what, unit] = if connector.turns { ["rotation", "rad"] } else { ["extension", "m"] };
    let mut parts = vec![
        format!("first yield at t = {}", quantity(first, "s")),
        format!("largest plastic {what} {}", quantity(connector.plastic_max.value, unit)),
    ];
    match connector.failed {
        Some(time) => parts.push(format!("failed at t = {}", quantity(time, "s"))),
        None => parts.push(format!("{} at the end", quantity(connector.plastic, unit))),
    }
    parts.push(dissipated(connector.dissipated, connector.dissipated_by_preload));
    Some((format!("yield of '{}'", connector.name), parts.join(", ")))
}

/// The largest force, or moment, at the end of a step before a spring or hinge failed; nothing of one that failed in the static start.
fn reached_before(connector: &YieldingSummary) -> String {
    let [what, unit] = if connector.turns { ["moment", "N*m"] } else { ["force", "N"] };
    match connector.force_max.value {
        0.0 => String::new(),
        most if most.is_nan() => String::new(),
        most => format!(", largest {what} before {}", quantity(most, unit)),
    }
}

/// The largest forces of springs that act on one side or along a table, and cannot yield or fail.
fn springs(run: &RunSummary) -> Vec<(String, String)> {
    let limited = |name: &str| run.yielding.iter().any(|one| one.name == format!("spring.{name}"));
    let of = |pulse: &PulseSummary| match &pulse.of {
        PulseOf::Spring(name) if !limited(name) => {
            let text = match pulse.force.value > 0.0 {
                true => peak_force(&pulse.force),
                false => "without force".to_owned(),
            };
            Some((format!("spring '{name}'"), text))
        }
        _ => None,
    };
    run.pulses.iter().filter_map(of).collect()
}

/// The largest forces of stops, and how often they were touched.
fn stops(run: &RunSummary) -> Vec<(String, String)> {
    let of = |support: &SupportSummary| {
        let touches = support.touches.as_ref()?;
        let most = touches.iter().map(|touch| touch.peak_force);
        let text = match most.max_by(|a, b| a.value.total_cmp(&b.value)) {
            Some(most) => format!("{}, {}", peak_force(&most), count(touches.len(), "contact")),
            None => "not touched".to_owned(),
        };
        Some((format!("stop '{}'", support.name), text))
    };
    run.supports.iter().filter_map(of).collect()
}

/// The first few rows of one kind, and how many more there are.
fn first_of(mut rows: Vec<(String, String)>) -> Vec<(String, String)> {
    let more = rows.len().saturating_sub(BRIEF);
    if more > 0 {
        rows.truncate(BRIEF);
        rows.push((String::new(), format!("and {more} more")));
    }
    rows
}

fn peak_force(peak: &Peak) -> String {
    format!("peak force {} at t = {}", quantity(peak.value, "N"), quantity(peak.time, "s"))
}

/// Impulses of supports and obstacles, in addition to their forces in the history.
fn impulses(run: &RunSummary) -> Vec<String> {
    let parts = |s: &SupportSummary| s.impulse.map(|i| if i.is_nan() { 0.0 } else { i.abs() });
    let most = run
        .supports
        .iter()
        .map(parts)
        .fold([0.0_f64; 2], |[force, moment], [a, b, c]| [force.max(a).max(b), moment.max(c)]);
    let momentum = &run.momentum;
    let least = [momentum.linear_scale, momentum.angular_scale].map(|scale| SMALL_IMPULSE * scale);
    let is_nothing =
        |impulse: f64, k: usize| impulse <= least[k / 2] || is_round_off(impulse, most[k / 2]);
    let counts =
        |s: &&SupportSummary| parts(s).into_iter().enumerate().any(|(k, i)| !is_nothing(i, k));
    let found: Vec<&SupportSummary> = run.supports.iter().filter(counts).collect();
    listed(&found, found.len(), BRIEF, |support| {
        let impulse = |k: usize, unit: &str| {
            let i = support.impulse[k];
            quantity(if is_nothing(i.abs(), k) { 0.0 } else { i }, unit)
        };
        let moment = match support.impulse[2].is_nan() {
            true => String::new(),
            false => format!(", moment {}", impulse(2, "N*m*s")),
        };
        let (x, y) = (impulse(0, "N*s"), impulse(1, "N*s"));
        format!(
            "'{}': (x, y) = ({x}, {y}){moment} (in addition to the force history)",
            support.name
        )
    })
}

/// How the run ended, in the words of its page, and what it cost.
fn status(ended: &Ended) -> String {
    let run = &ended.summary;
    let state = RunState::of(&ended.value);
    let style = match run.termination {
        Termination::Completed => "32",
        Termination::Interrupted { .. } => "33",
        Termination::Failed(_) | Termination::Unsolved => "31",
    };
    let mut parts = vec![
        painted(&state.words.replace('\u{a0}', " "), style),
        state.warnings_in_words(),
        count(run.steps, "step"),
        count(run.newton_iterations, "Newton iteration"),
        count(run.step_cuts, "step cut"),
    ];
    if let Value::Number(seconds) = &ended.value["wall_seconds"] {
        parts.push(format!("wall time {:.3} s", seconds.as_f64().unwrap_or(f64::NAN)));
    }
    parts.join(", ")
}

/// Sizes of steps chosen for an accuracy.
fn steps(control: &StepControl) -> String {
    let StepControl { accuracy, estimate, smallest, largest, mean, refused, .. } = control;
    format!(
        "{} to {}, mean {}, {} rejected; estimated error {} % (requested {} %)",
        quantity(*smallest, "s"),
        quantity(*largest, "s"),
        quantity(*mean, "s"),
        refused,
        number(100.0 * estimate),
        number(100.0 * accuracy),
    )
}

fn energy(run: &RunSummary, scales: &Scales) -> String {
    let (energy, scale) = (&run.energy, scales.energy);
    let plain = |x: f64| quantity(without_round_off(x, scale), "J");
    let mut parts = vec![format!("{} to {}", plain(energy.initial), plain(energy.final_))];
    let in_contacts = run.loss_contacts();
    let before = run.plastic.iter().map(|beam| beam.dissipated_by_preload);
    let before = before.chain(run.yielding.iter().map(|one| one.dissipated_by_preload));
    let plastic = match !is_round_off(before.sum::<f64>(), scale) {
        true => "dissipated by plastic flow in the run",
        false => "dissipated by plastic flow",
    };
    let terms = [
        ("lost in impacts and friction", energy.loss_impacts),
        ("dissipated by damping", energy.loss_damping - in_contacts),
        ("dissipated in contacts", in_contacts),
        (plastic, energy.plastic),
        ("stored in hardening", energy.hardening),
        ("lost in failed parts", energy.failure),
        ("work of loads", energy.work_loads),
        ("work of supports", energy.work_supports),
    ];
    let present = terms.iter().filter(|(_, value)| !is_round_off(*value, scale));
    parts.extend(present.map(|(label, value)| format!("{label} {}", quantity(*value, "J"))));
    parts.push(format!("residual {} (relative)", small(energy.residual_max)));
    parts.join(", ")
}

/// A result beside a hand formula, and which of the formula's assumptions are not met; those of equal bodies once, with their names.
fn comparisons(all: &[Comparison]) -> Vec<String> {
    let several = all.iter().any(|one| one.contact != all[0].contact);
    let mut rows: Vec<(Vec<&str>, String)> = Vec::new();
    for one in all {
        let text = comparison(one);
        match rows
            .iter_mut()
            .find(|(names, known)| *known == text && !names.contains(&&*one.contact))
        {
            Some((names, _)) => names.push(&one.contact),
            None => rows.push((vec![&one.contact], text)),
        }
    }
    let row = |(names, text): (Vec<&str>, String)| {
        let shown = listed(&names, names.len(), NAMES, |name| format!("'{name}'"));
        if several { format!("{}: {text}", shown.join(", ")) } else { text }
    };
    rows.into_iter().map(row).collect()
}

fn comparison(one: &Comparison) -> String {
    let met = match one.unmet().as_slice() {
        [] => String::new(),
        [only] => format!("; not met: {only}"),
        [first, others @ ..] => format!("; not met: {first}, and {} more", others.len()),
    };
    let value = |value: f64| quantity(value, &one.unit.replace(' ', "*"));
    let sign = if one.difference_percent >= 0.0 { "+" } else { "" };
    let digits = if one.difference_percent.abs() < 0.01 { 0.0 } else { one.difference_percent };
    let beside = match one.bound {
        true => format!("{:.1} % of it", 100.0 * one.simulated / one.by_hand),
        false => format!("{sign}{digits:.2} %"),
    };
    let most = if one.bound && one.unmet().is_empty() { "at most " } else { "" };
    format!(
        "{}, {}: {most}{}, simulated {} ({beside}{met})",
        one.formula,
        one.quantity,
        value(one.by_hand),
        value(one.simulated),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(contact: &str, simulated: f64, bound: bool, holds_if: &str) -> Comparison {
        Comparison {
            contact: contact.to_owned(),
            formula: "formula",
            source: "a book",
            quantity: "largest contact force",
            unit: "N",
            by_hand: 100.0,
            simulated,
            difference_percent: simulated - 100.0,
            bound,
            holds_if: holds_if.to_owned(),
        }
    }

    #[test]
    fn a_bound_has_no_error_and_unmet_assumptions_are_named() {
        let alone = |one: Comparison| comparisons(&[one]).remove(0);
        assert_eq!(
            alone(of("p", 14.0, true, "no losses (met)")),
            "formula, largest contact force: at most 100 N, simulated 14 N (14.0 % of it)"
        );
        assert_eq!(
            alone(of(
                "p",
                90.0,
                false,
                "no damping (not met); small slopes (met); one beam (not met)"
            )),
            "formula, largest contact force: 100 N, simulated 90 N (-10.00 %; not met: no damping, and 1 more)"
        );
    }

    #[test]
    fn dissipation_of_round_off_in_the_run_is_none() {
        let text = "2.763 J dissipated (2.763 J in the static start, 0 J in the run)";
        assert_eq!(dissipated(2.763 + 2e-11, 2.763), text);
        let text = "3 J dissipated (2 J in the static start, 1 J in the run)";
        assert_eq!(dissipated(3.0, 2.0), text);
    }

    #[test]
    fn equal_rows_of_several_contacts_are_one_with_their_names() {
        let all = ["a", "b", "c", "d"]
            .map(|name| of(name, if name == "d" { 80.0 } else { 90.0 }, false, ""));
        let rows = comparisons(&all);
        assert_eq!(rows.len(), 2);
        assert!(rows[0].starts_with("'a', 'b', 'c': formula, "), "{rows:?}");
        assert!(rows[1].starts_with("'d': formula, "), "{rows:?}");
    }
}
