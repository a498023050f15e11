//! The table at the end of a run.

mod contacts;
mod lines;

use std::path::Path;

use percuss::{
    JointSummary, PlasticHinge, PlasticSummary, RunSummary, StepControl, SupportSummary,
    Termination, YieldingSummary,
};
use percuss_advice::Comparison;
use percuss_output::report::story;
use serde_json::Value;

use super::drift::{drift, unresolved};
use super::ended::Ended;
use crate::number::{count, number, small};
use crate::terminal::{self, painted};
use contacts::{contact_lines, touched};
use lines::listed;

/// Results beside hand formulas listed for a contact.
const HANDED: usize = 6;
/// Contacts named that never closed.
const NAMED: usize = 6;
/// Terms of the balance below this share of the energy scale are nothing but rounding.
const ROUNDING: f64 = 1e-13;
/// Impulses beyond forces below this share of the momentum of the run are those of the instants in which a motion begins.
const SMALL_IMPULSE: f64 = 1e-6;
/// Impulses below this share of it are round-off.
const NO_IMPULSE: f64 = 1e-9;

/// What happened, whether the balances closed, where the results lie.
pub(super) fn table(ended: &Ended, out: &Path) -> String {
    let run = &ended.summary;
    let mut rows = vec![("status".to_owned(), status(ended))];
    rows.push(("energy".into(), energy(run)));
    rows.push((
        "momentum".into(),
        format!(
            "residual linear {}, angular {} (relative)",
            small(run.momentum.linear_residual_max),
            small(run.momentum.angular_residual_max)
        ),
    ));
    rows.push(("drift".into(), drift(run)));
    rows.extend(unresolved(run));
    let (touched, untouched): (Vec<_>, Vec<_>) = run.contacts.iter().partition(|c| touched(c));
    let alone = if untouched.len() == 1 { &untouched[..] } else { &[] };
    for contact in touched.iter().chain(alone) {
        let label = format!("contact {}", contact.name);
        let lines = contact_lines(contact, run);
        let labels = [label].into_iter().chain(std::iter::repeat(String::new()));
        rows.extend(labels.zip(lines));
    }
    if untouched.len() > 1 {
        let names: Vec<&str> = untouched.iter().map(|c| c.name.as_str()).collect();
        let names = listed(&names, names.len(), NAMED, |name| (*name).to_owned());
        rows.push((
            count(untouched.len(), "contact"),
            format!("never closed: {}", names.join(", ")),
        ));
    }
    rows.extend(run.plastic.iter().filter_map(plastic));
    rows.extend(run.yielding.iter().filter_map(yielding));
    rows.extend(run.joints.iter().map(joint));
    let labels = ["impulses".to_owned()].into_iter().chain(std::iter::repeat(String::new()));
    rows.extend(labels.zip(impulses(run)));
    rows.extend(run.step_control.as_ref().map(|control| ("steps".into(), steps(control))));
    if run.accumulated_steps > 0 {
        let steps = count(run.accumulated_steps, "step");
        let what = "with more impacts than are followed one by one, without restitution in the rest of the step";
        rows.push(("accumulation".into(), format!("{steps} {what}")));
    }
    let by_hand = ["by hand".to_owned()].into_iter().chain(std::iter::repeat(String::new()));
    rows.extend(by_hand.zip(listed(
        &ended.comparisons,
        ended.comparisons.len(),
        HANDED,
        comparison,
    )));
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

/// What became of a beam that yielded.
fn plastic(beam: &PlasticSummary) -> Option<(String, String)> {
    let first = beam.first_yield?;
    let mut parts = vec![
        format!("first at s = {} m, t = {} s", number(first.s), number(first.time)),
        format!("plastic strain up to {}", number(beam.strain_max.value)),
        dissipated(beam.dissipated, beam.dissipated_by_preload),
    ];
    let larger =
        |a: &&PlasticHinge, b: &&PlasticHinge| a.rotation.abs().total_cmp(&b.rotation.abs());
    if let Some(hinge) = beam.hinges.iter().max_by(larger) {
        parts.push(format!(
            "bent by {} rad about s = {} m over {} m (elements of {} m)",
            number(hinge.rotation),
            number(hinge.s),
            number(hinge.length),
            number(hinge.element_length)
        ));
    }
    match beam.permanent_set {
        Err(reason) => parts.push(format!("no permanent set told: {reason}")),
        Ok(set) => {
            // What is round-off beside the other component is none.
            let plain = |x: f64| number(if x.abs() < 1e-9 * set.size() { 0.0 } else { x });
            let [x, y] = set.displacement.map(plain);
            let (size, s) = (number(set.size()), number(set.s));
            parts.push(format!("permanent set {size} m, ({x}, {y}) m at s = {s} m"));
        }
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
        let (s, time) = (number(first.s), number(first.time));
        parts.push(format!("parted at s = {s} m, t = {time} s{more}"));
    }
    Some((format!("yield of {}", beam.name), parts.join(", ")))
}

/// What plastic flow dissipated, and how much of it the preload of a static start.
fn dissipated(all: f64, by_preload: f64) -> String {
    match by_preload > ROUNDING * all {
        true => format!(
            "{} J dissipated ({} J by the preload, {} J in the run)",
            number(all),
            number(by_preload),
            number(all - by_preload)
        ),
        false => format!("{} J dissipated", number(all)),
    }
}

/// What became of a joint of a given strength.
fn joint(joint: &JointSummary) -> (String, String) {
    let told = |force: f64, moment: f64| {
        let moment =
            if moment > 0.0 { format!(" and {} N m", number(moment)) } else { String::new() };
        format!("{} N{moment}", number(force))
    };
    let text = match joint.parted {
        Some(one) if one.force.is_nan() => "parted in the static start".to_owned(),
        Some(one) => {
            format!("parted at t = {} s under {}", number(one.time), told(one.force, one.moment))
        }
        None => format!("held up to {}", told(joint.force_max.value, joint.moment_max.value)),
    };
    (format!("joint {}", joint.name), text)
}

/// What became of a spring or hinge that yielded or broke.
fn yielding(connector: &YieldingSummary) -> Option<(String, String)> {
    let Some(first) = connector.first_yield else {
        let time = number(connector.failed?);
        return Some((format!("failure of {}", connector.name), format!("at t = {time} s")));
    };
    let [what, unit] = if connector.turns { ["rotation", "rad"] } else { ["extension", "m"] };
    let mut parts = vec![
        format!("first at t = {} s", number(first)),
        format!("plastic {what} up to {} {unit}", number(connector.plastic_max.value)),
    ];
    match connector.failed {
        Some(time) => parts.push(format!("failed at t = {} s", number(time))),
        None => parts.push(format!("{} {unit} at the end", number(connector.plastic))),
    }
    parts.push(dissipated(connector.dissipated, connector.dissipated_by_preload));
    Some((format!("yield of {}", connector.name), parts.join(", ")))
}

/// What supports and obstacles gave beyond their forces.
fn impulses(run: &RunSummary) -> Vec<String> {
    let parts = |s: &SupportSummary| s.impulse.map(|i| if i.is_nan() { 0.0 } else { i.abs() });
    let most = run
        .supports
        .iter()
        .map(parts)
        .fold([0.0_f64; 2], |[force, moment], [a, b, c]| [force.max(a).max(b), moment.max(c)]);
    let gave = |s: &&SupportSummary| {
        let [a, b, c] = parts(s);
        let least =
            [SMALL_IMPULSE * run.momentum.linear_scale, SMALL_IMPULSE * run.momentum.angular_scale];
        a.max(b) > least[0].max(ROUNDING * most[0]) || c > least[1].max(ROUNDING * most[1])
    };
    let momentum = &run.momentum;
    let nothing = [momentum.linear_scale, momentum.angular_scale].map(|scale| NO_IMPULSE * scale);
    let found: Vec<&SupportSummary> = run.supports.iter().filter(gave).collect();
    listed(&found, found.len(), HANDED, |support| {
        let told = |k: usize| {
            let i = support.impulse[k];
            let none = nothing[k / 2].max(ROUNDING * most[k / 2]);
            number(if i.abs() <= none { 0.0 } else { i })
        };
        let moment = match support.impulse[2].is_nan() {
            true => String::new(),
            false => format!(", moment {} N m s", told(2)),
        };
        let (x, y) = (told(0), told(1));
        format!("{} gave {x} N s, {y} N s{moment}, beyond its forces", support.name)
    })
}

fn status(ended: &Ended) -> String {
    let run = &ended.summary;
    let (word, style) = match run.termination {
        Termination::Completed => ("completed", "32"),
        Termination::Interrupted { .. } => ("interrupted", "33"),
        Termination::Failed(_) => ("failed", "31"),
        Termination::Unsolved => ("unsolved", "31"),
    };
    let mut parts = vec![
        format!("{} at t = {} s", painted(word, style), number(run.time)),
        count(run.steps, "step"),
        count(run.newton_iterations, "Newton iteration"),
        count(run.step_cuts, "step cut"),
    ];
    if let Value::Number(seconds) = &ended.value["wall_seconds"] {
        parts.push(format!("{:.3} s", seconds.as_f64().unwrap_or(f64::NAN)));
    }
    parts.join(", ")
}

/// Sizes of steps chosen for an accuracy.
fn steps(control: &StepControl) -> String {
    let StepControl { accuracy, estimate, smallest, largest, mean, refused, .. } = control;
    format!(
        "{} s to {} s, {} s in the mean, {} refused; error estimated as {} % ({} % asked for)",
        number(*smallest),
        number(*largest),
        number(*mean),
        refused,
        number(100.0 * estimate),
        number(100.0 * accuracy),
    )
}

fn energy(run: &RunSummary) -> String {
    let energy = &run.energy;
    let plain = |x: f64| number(if x.abs() < ROUNDING * energy.scale { 0.0 } else { x });
    let mut parts = vec![format!("{} J to {} J", plain(energy.initial), plain(energy.final_))];
    let in_contacts = run.loss_contacts();
    let before = run.plastic.iter().map(|beam| beam.dissipated_by_preload);
    let before = before.chain(run.yielding.iter().map(|one| one.dissipated_by_preload));
    let plastic = match before.sum::<f64>() > ROUNDING * energy.scale {
        true => "dissipated by plastic flow in the run",
        false => "dissipated by plastic flow",
    };
    let terms = [
        ("lost in impacts", energy.loss_impacts),
        ("taken by damping", energy.loss_damping - in_contacts),
        ("dissipated in contacts", in_contacts),
        (plastic, energy.plastic),
        ("stored by hardening", energy.hardening),
        ("lost with what failed", energy.failure),
        ("work of loads", energy.work_loads),
        ("work of supports", energy.work_supports),
    ];
    let present = terms.iter().filter(|(_, value)| value.abs() > ROUNDING * energy.scale);
    parts.extend(present.map(|(label, value)| format!("{label} {} J", number(*value))));
    parts.push(format!("residual {} (relative)", small(energy.residual_max)));
    parts.join(", ")
}

/// A result beside a hand formula, and whether the formula's assumptions are met.
fn comparison(one: &Comparison) -> String {
    let unmet = one.holds_if.matches("(not met)").count();
    let met = match unmet {
        0 => String::new(),
        _ => format!("; {} not met", count(unmet, "assumption")),
    };
    let unit = if one.unit == "1" { String::new() } else { format!(" {}", one.unit) };
    let sign = if one.difference_percent >= 0.0 { "+" } else { "" };
    let digits = if one.difference_percent.abs() < 0.01 { 0.0 } else { one.difference_percent };
    format!(
        "{}, {}: {}{unit}, simulated {}{unit} ({sign}{digits:.2} %{met})",
        one.formula,
        one.quantity,
        number(one.by_hand),
        number(one.simulated),
    )
}
