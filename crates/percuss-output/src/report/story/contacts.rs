//! What is told of contacts: who struck what, what they gave, and how they parted. What is round-off beside the run is not told.

use serde_json::{Map, Value};

use super::words::{list, quantity};

/// Beside those of the run, smaller velocities are none.
const ROUND_OFF: f64 = 1e-9;
/// Instants within less than this share of a step after the start are the start: impacts take as long.
const AT_START: f64 = 1e-3;

/// Instants up to this one are told as the start of a run that took so many steps up to `time` \[s\].
pub fn told_as_start(time: f64, steps: f64) -> f64 {
    if steps > 0.0 { AT_START * time / steps } else { 0.0 }
}

/// A contact that closed, with what is told of it.
struct Touched<'v> {
    name: &'v str,
    contact: &'v Value,
    /// Largest force, or total impulse of a rigid contact: which contact is told first.
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
    let number = |pointer: &str| summary.pointer(pointer).and_then(Value::as_f64).unwrap_or(0.0);
    let (energy, momentum) = (number("/energy/scale"), number("/momentum/linear_scale"));
    let of_run = if momentum > 0.0 { 2.0 * energy / momentum } else { 0.0 };
    let told = list(contact, "impacts").iter().chain(list(contact, "intervals"));
    let each = told.flat_map(|one| ["approach_velocity", "separation_velocity"].map(|k| &one[k]));
    let largest = each.filter_map(Value::as_f64).map(f64::abs).fold(of_run, f64::max);
    ROUND_OFF * largest
}

/// What happened at contacts.
pub(super) fn told(summary: &Value) -> String {
    let empty = Map::new();
    let all = summary["contact"].as_object().unwrap_or(&empty);
    if all.is_empty() {
        return String::new();
    }
    let number = |key: &str| summary[key].as_f64().unwrap_or(0.0);
    let start = told_as_start(number("time"), number("steps"));
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
        return match all.len() {
            1 => "Nothing touched: the one contact never closed.".into(),
            n => format!("Nothing touched: none of the {n} contacts closed."),
        };
    }
    // Forces and impulses do not compare: contacts with a force come first.
    let has_force = |t: &Touched<'_>| t.contact["peak_force"].is_object();
    touched.sort_by(|a, b| has_force(b).cmp(&has_force(a)).then(b.size.total_cmp(&a.size)));
    let main = &touched[0];
    let projectiles = summary["projectile"].as_object().unwrap_or(&empty);
    let mut out = vec![strike(main, projectiles), largest(main), ending(main)];
    let others: Vec<&str> = touched[1..].iter().map(|t| t.name).collect();
    match others.as_slice() {
        [] => {}
        [one] => out.push(format!("Contact {one} closed as well.")),
        [some @ .., last] if some.len() < 3 => {
            out.push(format!("Contacts {} and {last} closed as well.", some.join(", ")));
        }
        more => out.push(format!("{} other contacts closed as well.", more.len())),
    }
    out.retain(|sentence| !sentence.is_empty());
    out.join(" ")
}

/// Who struck what, how fast and when; what flies at something is named first.
fn strike(main: &Touched<'_>, projectiles: &Map<String, Value>) -> String {
    let partner = |k: usize| main.contact["between"][k].as_str().unwrap_or("?");
    let flies = |name: &str| projectiles.contains_key(name);
    let (a, b) = match (partner(0), partner(1)) {
        (a, b) if flies(b) && !flies(a) => (b, a),
        partners => partners,
    };
    let first = first_touch(main.contact);
    let velocity = main.velocity(first, "approach_velocity");
    let time = first["start"].as_f64().or(first["time"].as_f64()).filter(|t| *t > main.start);
    let when = match time {
        Some(time) => format!("{} after the start", quantity(Some(time), "s")),
        None => "at the start".into(),
    };
    match velocity {
        Some(v) => format!("{a} struck {b} at {}, {when}.", quantity(Some(v), "m/s")),
        None if time.is_none() => format!("{a} touched {b} from the start."),
        None => format!("{a} came to touch {b} {when}."),
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

/// The largest force, or how many impacts gave what, and what resting contact gave beside them.
fn largest(main: &Touched<'_>) -> String {
    let peak = &main.contact["peak_force"];
    if let Some(force) = peak["value"].as_f64() {
        let (force, time) = (quantity(Some(force), "N"), quantity(peak["time"].as_f64(), "s"));
        let permanent = main.contact["permanent_penetration"].as_f64().filter(|p| *p > 0.0);
        let crushed = permanent.map(|p| format!("; {} stay crushed", quantity(Some(p), "m")));
        let crushed = crushed.unwrap_or_default();
        return format!("The contact force reached {force} at {time}{crushed}.");
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
        (1, _) => format!("The impact gave {total}."),
        (n, Some(one)) => {
            let size = quantity(one["impulse"].as_f64(), "N*s");
            let when = match one["time"].as_f64().filter(|t| *t > main.start) {
                Some(time) => format!("at {}", quantity(Some(time), "s")),
                None => "at the start".into(),
            };
            format!("{n} impacts gave {total} in all, the hardest {size} {when}.")
        }
    };
    // Neither can be told beside the other where it is round-off of their sum.
    match (rested > ROUND_OFF * main.size, impacts.is_empty()) {
        (false, _) => impacts,
        (true, true) => format!("Resting contact gave {resting}."),
        (true, false) => format!("{impacts} Resting contact gave {resting}."),
    }
}

fn impulse(impact: &Value) -> f64 {
    impact["impulse"].as_f64().map_or(0.0, f64::abs)
}

/// Whether the two let go, when and how fast.
fn ending(main: &Touched<'_>) -> String {
    let (intervals, impacts) = (list(main.contact, "intervals"), list(main.contact, "impacts"));
    let (last, struck) = (intervals.last(), impacts.last());
    if last.is_some_and(|i| i["end"].is_null()) {
        return "They are still in contact at the end.".into();
    }
    let parted = |one: &Value, time: &Value| {
        one["separation_velocity"].as_f64()?;
        let time = time.as_f64().filter(|t| *t > main.start);
        let t = time.map_or_else(|| "the start".into(), |t| quantity(Some(t), "s"));
        let last = if times_closed(main.contact) == 1 { "" } else { "last " };
        Some(match main.velocity(one, "separation_velocity") {
            Some(v) => {
                let v = quantity(Some(v), "m/s");
                format!("They {last}parted at {t}, moving apart at {v}.")
            }
            None if one["end"].is_number() => format!("They {last}parted at {t}."),
            None => format!("The last impact, at {t}, left no velocity of separation."),
        })
    };
    let after = |i: &&Value| {
        let end = i["end"].as_f64().unwrap_or(f64::NEG_INFINITY);
        struck.is_none_or(|s| s["time"].as_f64().is_none_or(|time| time < end))
    };
    let told = match last.filter(after) {
        Some(interval) => parted(interval, &interval["end"]),
        None => struck.and_then(|impact| parted(impact, &impact["time"])),
    };
    told.unwrap_or_default()
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
        told(summary).replace('\u{a0}', " ")
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
    fn impacts_and_resting_contact_are_told_apart() {
        let impact = json!([{ "time": 0.001, "impulse": 24.73, "approach_velocity": 2.0, "separation_velocity": 0.0 }]);
        let rest =
            json!([{ "start": 0.001, "end": 0.04, "impulse": 756.77, "separation_velocity": 1.5 }]);
        let text = rigid(&impact, &rest, 781.5);
        assert!(
            text.contains("The impact gave 24.73 N s. Resting contact gave 756.8 N s."),
            "{text}"
        );
        assert!(text.contains("They last parted at 40 ms, moving apart at 1.5 m/s."), "{text}");
        let text = rigid(&json!([]), &rest, 756.77);
        assert!(text.contains("Resting contact gave 756.8 N s."), "{text}");
        assert!(!text.contains("impact"), "{text}");
    }

    #[test]
    fn velocities_instants_and_approaches_of_round_off_are_not_told() {
        let rest = json!([{
            "start": 2.5e-11, "end": 0.04, "impulse": 3.0,
            "approach_velocity": 4e-17, "separation_velocity": 2.8e-17,
        }]);
        let text = rigid(&json!([]), &rest, 3.0);
        assert!(
            text.starts_with(
                "b touched p from the start. Resting contact gave 3 N s. They parted at 40 ms."
            ),
            "{text}"
        );
        let impact = json!([{ "time": 2.5e-11, "impulse": 3.0, "approach_velocity": 2.0, "separation_velocity": -3e-17 }]);
        let text = rigid(&impact, &json!([]), 3.0);
        assert!(text.starts_with("b struck p at 2 m/s, at the start."), "{text}");
        assert!(text.contains("left no velocity of separation"), "{text}");
    }
}
