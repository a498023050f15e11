//! Contacts in the summary text: what struck what, peak force or impulses, separation. Values that are round-off beside the run are left out.

use serde_json::{Map, Value};

use crate::round_off::{ROUND_OFF, Scales};
use crate::summary::kind_of_body;

use super::words::{capital, instant, list, quantity};

/// Instants within less than this share of a step after the start are the start: impacts take as long.
const AT_START: f64 = 1e-3;

/// Instants up to this one count as the start of a run that took so many steps up to `time` \[s\].
pub fn taken_as_start(time: f64, steps: f64) -> f64 {
    if steps > 0.0 { AT_START * time / steps } else { 0.0 }
}

/// A contact that closed.
struct Touched<'v> {
    name: &'v str,
    contact: &'v Value,
    /// Largest force, or total impulse of a rigid contact: the contact with the largest is described.
    size: f64,
    /// Velocities up to this one are round-off \[m/s\].
    still: f64,
    /// Instants up to this one are the start \[s\].
    start: f64,
}

impl Touched<'_> {
    /// A velocity that is more than round-off, in the sense of its name.
    fn velocity(&self, of: &Value, key: &str) -> Option<f64> {
        of[key].as_f64().filter(|v| *v > self.still)
    }
}

/// Velocities up to this one are round-off: beside twice the energy over the momentum of the run, and beside those of a contact \[m/s\].
fn round_off(summary: &Value, contact: &Value) -> f64 {
    let of_run = Scales::of(summary).velocity;
    let events = list(contact, "impacts").iter().chain(list(contact, "intervals"));
    let each = events.flat_map(|one| ["approach_velocity", "separation_velocity"].map(|k| &one[k]));
    let largest = each.filter_map(Value::as_f64).map(f64::abs).fold(of_run, f64::max);
    ROUND_OFF * largest
}

/// The sentences on contacts.
pub(super) fn contacts(summary: &Value) -> String {
    let empty = Map::new();
    let all = summary["contact"].as_object().unwrap_or(&empty);
    if all.is_empty() {
        return String::new();
    }
    let number = |key: &str| summary[key].as_f64().unwrap_or(0.0);
    let start = taken_as_start(number("time"), number("steps"));
    let mut touched: Vec<Touched<'_>> = all
        .iter()
        .filter(|(_, c)| !list(c, "intervals").is_empty() || !list(c, "impacts").is_empty())
        .map(|(name, contact)| {
            let force = contact["peak_force"]["value"].as_f64();
            let size = force.or(contact["impulse_total"].as_f64()).unwrap_or(0.0).abs();
            Touched { name, contact, size, still: round_off(summary, contact), start }
        })
        .collect();
    if touched.is_empty() {
        return String::new();
    }
    // Forces and impulses do not compare: contacts with a force come first.
    let has_force = |t: &Touched<'_>| t.contact["peak_force"].is_object();
    touched.sort_by(|a, b| has_force(b).cmp(&has_force(a)).then(b.size.total_cmp(&a.size)));
    let main = &touched[0];
    let mut out = vec![strike(main, summary), largest(main), ending(main)];
    let others: Vec<&str> = touched[1..].iter().map(|t| t.name).collect();
    match others.as_slice() {
        [] => {}
        [one] => out.push(format!("Contact '{one}' also closed.")),
        [some @ .., last] if some.len() < 3 => {
            let some: Vec<String> = some.iter().map(|name| format!("'{name}'")).collect();
            out.push(format!("Contacts {} and '{last}' also closed.", some.join(", ")));
        }
        more => out.push(format!("{} other contacts also closed.", more.len())),
    }
    out.retain(|sentence| !sentence.is_empty());
    out.join(" ")
}

/// That no contact closed, where none did; nothing else.
pub(super) fn none_closed(summary: &Value) -> Option<String> {
    let all = summary["contact"].as_object().filter(|all| !all.is_empty())?;
    let closed = |c: &Value| !list(c, "intervals").is_empty() || !list(c, "impacts").is_empty();
    if all.values().any(closed) {
        return None;
    }
    Some(match all.len() {
        1 => format!("Contact '{}' did not close.", all.keys().next().map_or("?", |name| name)),
        n => format!("None of the {n} contacts closed."),
    })
}

/// What struck what, at which velocity and when.
fn strike(main: &Touched<'_>, summary: &Value) -> String {
    let partner = |k: usize| main.contact["between"][k].as_str().unwrap_or("?");
    let (a, b) = (partner(0), partner(1));
    let first = first_touch(main.contact);
    let velocity = main.velocity(first, "approach_velocity");
    let time = first["start"].as_f64().or(first["time"].as_f64()).filter(|t| *t > main.start);
    let when = instant(Some(time.unwrap_or(0.0)));
    let named = |name: &str| named(name, summary);
    let sentence = match velocity.map(|v| quantity(Some(v), "m/s")) {
        Some(v) => match struck_first(a, b, summary) {
            Some([struck, striker]) => {
                format!("{} was struck by {} at {v}, {when}.", named(struck), named(striker))
            }
            None => format!("{} and {} collided at {v}, {when}.", named(a), named(b)),
        },
        None if time.is_none() => {
            format!("{} and {} are in contact from the start.", named(a), named(b))
        }
        None => format!(
            "Contact between {} and {} closed at {when} without an approach velocity.",
            named(a),
            named(b)
        ),
    };
    capital(&sentence)
}

/// The struck body and the one that struck it, where their kinds decide that: a projectile strikes, an obstacle is struck, and so is a
/// beam by anything else. Of two beams or two discs either may have moved.
fn struck_first<'n>(a: &'n str, b: &'n str, summary: &Value) -> Option<[&'n str; 2]> {
    let is = |part: &str, name: &str| summary[part].get(name).is_some();
    let order = |struck: &dyn Fn(&str) -> bool| match (struck(a), struck(b)) {
        (true, false) => Some([a, b]),
        (false, true) => Some([b, a]),
        _ => None,
    };
    order(&|name| !is("projectile", name))
        .or_else(|| order(&|name| is("support", name)))
        .or_else(|| order(&|name| is("section_forces", name)))
}

/// A body as a sentence names it, with its kind where the summary has it.
fn named(name: &str, summary: &Value) -> String {
    let is = |part: &str| summary[part].get(name).is_some();
    match (is("projectile"), is("section_forces")) {
        (true, false) => format!("{} '{name}'", kind_of_body(&summary["projectile"][name])),
        (false, true) => format!("beam '{name}'"),
        _ => format!("'{name}'"),
    }
}

/// The earlier of the first impact and the first interval.
fn first_touch(contact: &Value) -> &Value {
    let (impact, interval) = (&contact["impacts"][0], &contact["intervals"][0]);
    match (impact["time"].as_f64(), interval["start"].as_f64()) {
        (Some(a), Some(b)) if b < a => interval,
        (Some(_), _) => impact,
        _ => interval,
    }
}

/// The peak force, or the impulses of impacts and of persistent contact.
fn largest(main: &Touched<'_>) -> String {
    let peak = &main.contact["peak_force"];
    if let Some(force) = peak["value"].as_f64() {
        let (force, time) = (quantity(Some(force), "N"), instant(peak["time"].as_f64()));
        let permanent = main.contact["permanent_penetration"].as_f64().filter(|p| *p > 0.0);
        let crushed =
            permanent.map(|p| format!("; permanent indentation {}", quantity(Some(p), "m")));
        let crushed = crushed.unwrap_or_default();
        let which = which_interval(main, peak["time"].as_f64());
        return format!("Peak contact force {force} at {time}{which}{crushed}.");
    }
    let count = main.contact["impact_count"].as_u64().unwrap_or(0);
    let rested = main.contact["impulse_resting"].as_f64().unwrap_or(0.0);
    let struck = main.contact["impulse_total"].as_f64().map(|total| (total - rested).max(0.0));
    let total = quantity(struck, "N*s");
    let resting = quantity(Some(rested), "N*s");
    let by_size = |a: &&Value, b: &&Value| impulse(a).total_cmp(&impulse(b));
    let greatest = list(main.contact, "impacts").iter().max_by(by_size);
    let impacts = match (count, greatest) {
        (0, _) | (_, None) => String::new(),
        (1, _) => format!("Impulse of the impact: {total}."),
        (n, Some(one)) => {
            let size = quantity(one["impulse"].as_f64(), "N*s");
            let time = one["time"].as_f64().filter(|t| *t > main.start).unwrap_or(0.0);
            let when = instant(Some(time));
            // The sentence before tells the velocity of the first.
            let first = one["time"] == first_touch(main.contact)["time"];
            let approach = main.velocity(one, "approach_velocity").filter(|_| !first);
            let approach = approach.map(|v| format!(", approach {}", quantity(Some(v), "m/s")));
            let approach = approach.unwrap_or_default();
            format!(
                "{n} impacts, total impulse {total}; largest impulse {size} at {when}{approach}."
            )
        }
    };
    // An impulse that is round-off of the sum of both is left out.
    match (rested > ROUND_OFF * main.size, impacts.is_empty()) {
        (false, _) => impacts,
        (true, true) => format!("Impulse of persistent contact: {resting}."),
        (true, false) => format!("{impacts} Impulse of persistent contact: {resting}."),
    }
}

/// In which of several contact intervals an instant is, and at which velocity that one began, unless it is the first, of which that is reported.
fn which_interval(main: &Touched<'_>, time: Option<f64>) -> String {
    let intervals = list(main.contact, "intervals");
    let holds = |one: &&Value| {
        let end = one["end"].as_f64().unwrap_or(f64::INFINITY);
        time.zip(one["start"].as_f64()).is_some_and(|(time, start)| start <= time && time <= end)
    };
    // At the end of one and the start of the next it is of the first of them.
    let Some(k) = intervals.iter().position(|one| holds(&one)).filter(|k| *k > 0) else {
        return String::new();
    };
    let approach = main.velocity(&intervals[k], "approach_velocity");
    let approach = approach.map(|v| format!(", at {}", quantity(Some(v), "m/s")));
    let approach = approach.unwrap_or_default();
    format!(", in contact {} of {}{approach}", k + 1, intervals.len())
}

fn impulse(impact: &Value) -> f64 {
    impact["impulse"].as_f64().map_or(0.0, f64::abs)
}

/// Whether the bodies separated, when and at which velocity.
fn ending(main: &Touched<'_>) -> String {
    let (intervals, impacts) = (list(main.contact, "intervals"), list(main.contact, "impacts"));
    let (last, struck) = (intervals.last(), impacts.last());
    if last.is_some_and(|i| i["end"].is_null()) {
        return "The contact is closed at the end of the run.".into();
    }
    if let Some(torn) = last.filter(|i| i["torn"] == true) {
        let when = instant(torn["end"].as_f64());
        return format!("The contact ended at {when} with the fracture of the beam.");
    }
    let separated = |one: &Value, time: &Value| {
        let left = one["separation_velocity"].as_f64()?;
        let when = instant(Some(time.as_f64().filter(|t| *t > main.start).unwrap_or(0.0)));
        let what = if times_closed(main.contact) == 1 { "Separation" } else { "Final separation" };
        Some(match main.velocity(one, "separation_velocity") {
            Some(v) => {
                let v = quantity(Some(v), "m/s");
                format!("{what} at {when} with a separation velocity of {v}.")
            }
            None if one["end"].is_number() => format!("{what} at {when}."),
            // The bodies of a multiple impact may approach each other after it.
            None if left < -main.still => {
                format!("The last impact, at {when}, did not separate the bodies.")
            }
            None => format!("The last impact, at {when}, was plastic (no separation velocity)."),
        })
    };
    let after = |i: &&Value| {
        let end = i["end"].as_f64().unwrap_or(f64::NEG_INFINITY);
        struck.is_none_or(|s| s["time"].as_f64().is_none_or(|time| time < end))
    };
    let sentence = match last.filter(after) {
        Some(interval) => separated(interval, &interval["end"]),
        None => struck.and_then(|impact| separated(impact, &impact["time"])),
    };
    sentence.unwrap_or_default()
}

/// Impacts and intervals of a contact.
fn times_closed(contact: &Value) -> usize {
    let impacts = contact["impact_count"].as_u64().unwrap_or(0) as usize;
    impacts + list(contact, "intervals").len()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn plain(summary: &Value) -> String {
        contacts(summary).replace('\u{a0}', " ")
    }

    /// A rigid contact in a run of 1000 steps of 50 us, of 200 kg at 2 m/s.
    fn rigid(impacts: &Value, intervals: &Value, total: f64) -> String {
        plain(&json!({
            "projectile": {},
            "contact": { "p": {
                "between": ["b", "p"], "impact_count": list(&json!({ "i": impacts }), "i").len(),
                "impulse_total": total, "impacts": impacts, "intervals": intervals,
                "impulse_resting": list(&json!({ "i": intervals }), "i").iter().map(impulse).sum::<f64>(),
            } },
            "energy": { "residual_max": 0.0, "scale": 400.0 },
            "momentum": { "linear_scale": 400.0 },
            "status": "completed", "time": 0.05, "steps": 1000,
        }))
    }

    #[test]
    fn impulses_of_impacts_and_of_persistent_contact_are_separate() {
        let impact = json!([{ "time": 0.001, "impulse": 24.73, "approach_velocity": 2.0, "separation_velocity": 0.0 }]);
        let rest =
            json!([{ "start": 0.001, "end": 0.04, "impulse": 756.77, "separation_velocity": 1.5 }]);
        let text = rigid(&impact, &rest, 781.5);
        assert!(
            text.contains(
                "Impulse of the impact: 24.73 N s. Impulse of persistent contact: 756.8 N s."
            ),
            "{text}"
        );
        assert!(
            text.contains("Final separation at t = 40 ms with a separation velocity of 1.5 m/s."),
            "{text}"
        );
        let text = rigid(&json!([]), &rest, 756.77);
        assert!(text.contains("Impulse of persistent contact: 756.8 N s."), "{text}");
        assert!(!text.contains("impact"), "{text}");
    }

    #[test]
    fn velocities_and_instants_of_round_off_are_left_out() {
        let rest = json!([{
            "start": 2.5e-11, "end": 0.04, "impulse": 3.0,
            "approach_velocity": 4e-17, "separation_velocity": 2.8e-17,
        }]);
        let text = rigid(&json!([]), &rest, 3.0);
        assert!(
            text.starts_with(
                "'b' and 'p' are in contact from the start. Impulse of persistent contact: 3 N s. Separation at t = 40 ms."
            ),
            "{text}"
        );
        let impact = json!([{ "time": 2.5e-11, "impulse": 3.0, "approach_velocity": 2.0, "separation_velocity": -3e-17 }]);
        let text = rigid(&impact, &json!([]), 3.0);
        assert!(text.starts_with("'b' and 'p' collided at 2 m/s, t = 0 s."), "{text}");
        assert!(text.contains("was plastic (no separation velocity)"), "{text}");
        let impact = json!([{ "time": 0.01, "impulse": 3.0, "approach_velocity": 2.0, "separation_velocity": -0.5 }]);
        let text = rigid(&impact, &json!([]), 3.0);
        assert!(
            text.contains("The last impact, at t = 10 ms, did not separate the bodies."),
            "{text}"
        );
    }

    /// Two buildings pound ten times: the velocity beside the largest force is that of its own contact, and that of the first is reported of the first.
    #[test]
    fn the_velocity_beside_a_largest_force_is_that_of_its_own_contact() {
        let interval = |k: usize| {
            json!({
                "start": k as f64, "end": k as f64 + 0.03, "approach_velocity": 0.1 * (k + 1) as f64,
                "separation_velocity": 0.05,
            })
        };
        let pounding = |peak: f64| {
            plain(&json!({
                "section_forces": { "a": {}, "b": {} },
                "contact": { "pounding": {
                    "between": ["a", "b"], "peak_force": { "value": 886e3, "time": peak },
                    "intervals": (0..10).map(interval).collect::<Vec<_>>(),
                } },
                "time": 20.0, "steps": 10_000,
            }))
        };
        let text = pounding(3.01);
        assert!(
            text.starts_with(
                "Beam 'a' and beam 'b' collided at 0.1 m/s, t = 0 s. Peak contact force 886 kN at t = 3.01 s, in contact 4 of 10, at \
                 0.4 m/s."
            ),
            "{text}"
        );
        assert!(pounding(0.01).contains("886 kN at t = 10 ms."), "{}", pounding(0.01));
    }

    /// The kinds of two bodies decide which one was struck; two beams collide.
    #[test]
    fn the_struck_body_is_the_one_that_the_other_moved_against() {
        let between = |a: &str, b: &str| {
            plain(&json!({
                "projectile": { "car": { "direction": [1.0, 0.0] }, "ball": { "direction": null } },
                "support": { "stop": {} },
                "section_forces": { "left": {}, "right": {} },
                "contact": { "c": {
                    "between": [a, b], "peak_force": { "value": 10.0, "time": 0.002 },
                    "intervals": [{ "start": 0.001, "end": 0.004, "approach_velocity": 4.0, "separation_velocity": 3.0 }],
                } },
                "time": 0.01, "steps": 100,
            }))
        };
        for (a, b, said) in [
            ("left", "car", "Beam 'left' was struck by projectile 'car' at 4 m/s, t = 1 ms."),
            ("car", "left", "Beam 'left' was struck by projectile 'car' at 4 m/s, t = 1 ms."),
            ("left", "stop", "'stop' was struck by beam 'left' at 4 m/s, t = 1 ms."),
            ("rope", "left", "Beam 'left' was struck by 'rope' at 4 m/s, t = 1 ms."),
            ("left", "right", "Beam 'left' and beam 'right' collided at 4 m/s, t = 1 ms."),
            ("left", "ball", "Beam 'left' was struck by disc 'ball' at 4 m/s, t = 1 ms."),
            ("rope", "cord", "'rope' and 'cord' collided at 4 m/s, t = 1 ms."),
        ] {
            let text = between(a, b);
            assert!(text.starts_with(said), "{text}");
        }
    }
}
