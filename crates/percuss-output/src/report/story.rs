//! What happened, in a few sentences: who struck what, the largest force, how it ended, the largest deflection, moment and
//! stress, and how the balance closed. Everything in them stands in `summary.json`.

mod contacts;
mod words;
mod yielding;

pub use contacts::told_as_start;

use serde_json::Value;

use words::{list, quantity};

/// Relative amounts below this are none.
const NOTHING: f64 = 1e-12;

/// What happened in a run, in plain text.
pub fn story(summary: &Value) -> String {
    let mut out = vec![contacts::told(summary)];
    out.extend(deflection(summary));
    out.extend(sections(summary));
    out.extend(yielding::joints(summary));
    out.extend(yielding::partings(summary));
    out.extend(yielding::beams(summary));
    out.extend(yielding::connectors(summary));
    out.push(balance(summary));
    out.retain(|sentence| !sentence.is_empty());
    out.join(" ")
}

/// When the last contact of all opened; none where one is still closed or none ever was.
fn last_parting(summary: &Value) -> Option<f64> {
    let contacts = summary["contact"].as_object()?;
    let of_one = |contact: &Value| {
        let ends = list(contact, "intervals").iter().map(|i| i["end"].as_f64().unwrap_or(f64::NAN));
        let impacts = list(contact, "impacts").iter().filter_map(|i| i["time"].as_f64());
        ends.chain(impacts)
            .reduce(|a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
    };
    let last = contacts.values().filter_map(of_one);
    last.reduce(|a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
        .filter(|time| time.is_finite())
}

/// The largest displacement of a recorded point.
fn deflection(summary: &Value) -> Option<String> {
    let points = summary["point"].as_object()?;
    let each = points.iter().flat_map(|(name, point)| {
        ["component_1", "component_2"].map(|component| {
            let peak = &point["displacement_max"][component];
            (name, component, peak["value"].as_f64().unwrap_or(0.0), peak["time"].as_f64())
        })
    });
    let (name, component, value, time) = each.max_by(|a, b| a.2.abs().total_cmp(&b.2.abs()))?;
    if value == 0.0 {
        return None;
    }
    let along = if component == "component_1" { "e1" } else { "e2" };
    let (value, time) = (quantity(Some(value), "m"), quantity(time, "s"));
    let of = if points.len() > 1 { "of the recorded points " } else { "" };
    Some(format!("The largest displacement {of}is {value} along {along}, of {name} at {time}."))
}

/// The largest moment, and the largest stress where one is known.
fn sections(summary: &Value) -> Option<String> {
    let beams = summary["section_forces"].as_object()?;
    let parting = last_parting(summary);
    let largest = |quantity: &str| {
        beams
            .iter()
            .flat_map(|(name, beam)| ["min", "max"].map(|end| (name, &beam[quantity][end])))
            .filter_map(|(name, one)| Some((name, one, one["value"].as_f64()?)))
            .max_by(|a, b| a.2.abs().total_cmp(&b.2.abs()))
            .filter(|(_, _, value)| *value != 0.0)
    };
    let place = |(name, one, value): (&String, &Value, f64), unit: &str| {
        let (s, time) = (quantity(one["s"].as_f64(), "m"), quantity(one["time"].as_f64(), "s"));
        // What rings after the blow is worth saying.
        let after = parting.zip(one["time"].as_f64()).is_some_and(|(end, time)| time > end);
        let after = if after { ", after the contact" } else { "" };
        format!("{} in {name} at s = {s}, {time}{after}", quantity(Some(value.abs()), unit))
    };
    // A moment is told beside the energy scale: what is nothing but round-off of it is none.
    let floor = 1e-12 * summary["energy"]["scale"].as_f64().unwrap_or(0.0);
    let moment = largest("moment")
        .filter(|m| m.2.abs() > floor)
        .map(|m| format!("the largest moment {}", place(m, "N*m")));
    let stress = largest("stress").map(|s| format!("the largest stress {}", place(s, "Pa")));
    let both: Vec<String> = [moment, stress].into_iter().flatten().collect();
    let mut text = both.join("; ");
    if text.is_empty() {
        return None;
    }
    text.replace_range(..1, "T");
    Some(text + ".")
}

/// How the balance of energy closed, and how the run ended if not as it should.
fn balance(summary: &Value) -> String {
    let energy = &summary["energy"];
    let scale = quantity(energy["scale"].as_f64(), "J");
    let mut out = match energy["residual_max"].as_f64() {
        Some(r) if r < NOTHING => {
            format!("The energy balance closes to round-off, relative to {scale}.")
        }
        Some(r) if r < 1e-8 => {
            format!("The energy balance closes to {r:.0e}, relative to {scale}.")
        }
        Some(r) => format!("The energy balance is off by {r:.0e}, relative to {scale}."),
        None => String::new(),
    };
    if let Some(status @ ("failed" | "interrupted")) = summary["status"].as_str() {
        let time = quantity(summary["time"].as_f64(), "s");
        out = format!(
            "The run {} at {time}. {out}",
            match status {
                "failed" => "failed",
                _ => "was interrupted",
            }
        );
    }
    out
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn plain(summary: &Value) -> String {
        story(summary).replace('\u{a0}', " ")
    }

    #[test]
    fn a_blow_is_told_from_first_touch_to_last() {
        let summary = json!({
            "projectile": { "car": {} },
            "contact": {
                "car": {
                    "between": ["left@0.5m", "car"],
                    "peak_force": { "value": 176_632.0, "time": 0.1112 },
                    "intervals": [
                        { "start": 0.01, "end": 0.05, "approach_velocity": 8.3333, "separation_velocity": 1.0 },
                        { "start": 0.06, "end": 0.2223, "approach_velocity": 1.0, "separation_velocity": 8.326 },
                    ],
                },
                "other": { "between": ["a", "b"], "peak_force": { "value": 0.0, "time": 0.0 }, "intervals": [] },
            },
            "point": {
                "mid": { "displacement_max": {
                    "component_1": { "value": 0.001, "time": 0.1 }, "component_2": { "value": -0.02, "time": 0.3 } } },
            },
            "section_forces": { "left": {
                "moment": { "min": { "value": -63e3, "s": 0.0, "time": 0.1 }, "max": { "value": 20e3, "s": 1.0, "time": 0.2 } },
                "stress": { "min": { "value": null }, "max": { "value": null } } } },
            "energy": { "residual_max": 9e-15, "scale": 52_930.0 },
            "status": "completed",
        });
        assert_eq!(
            plain(&summary),
            "car struck left@0.5m at 8.333 m/s, 10 ms after the start. The contact force reached 176.6 kN at 111.2 ms. \
             They last parted at 222.3 ms, moving apart at 8.326 m/s. The largest displacement is -20 mm along e2, of mid at 300 ms. \
             The largest moment 63 kN m in left at s = 0 m, 100 ms. The energy balance closes to round-off, relative to 52.93 kJ."
        );
    }

    #[test]
    fn impacts_are_told_by_impulse_and_what_cannot_be_is_not_told() {
        let impact = |time: f64, impulse: f64, after: f64| json!({ "time": time, "impulse": impulse, "approach_velocity": 4.0, "separation_velocity": after });
        let run = |impacts: Vec<Value>, intervals: Value| {
            json!({
                "projectile": {},
                "contact": { "tap": {
                    "between": ["strip", "stop"], "impact_count": impacts.len(), "impulse_total": 7.0,
                    "impacts": impacts, "intervals": intervals,
                } },
                "energy": { "residual_max": 1e-3, "scale": 1.0 },
                "status": "failed", "time": 0.5,
            })
        };
        let text = plain(&run(vec![impact(0.1, 2.0, 4.0), impact(0.2, 5.0, 3e-16)], json!([])));
        assert!(
            text.contains("2 impacts gave 7 N s in all, the hardest 5 N s at 200 ms."),
            "{text}"
        );
        assert!(text.contains("left no velocity of separation"), "{text}");
        assert!(
            text.contains(
                "The run failed at 500 ms. The energy balance is off by 1e-3, relative to 1 J."
            ),
            "{text}"
        );
        let two = |name: &str| {
            json!({ "between": ["a", name], "peak_force": { "value": 1.0, "time": 0.1 },
            "intervals": [{ "start": 0.1, "end": 0.2, "separation_velocity": 1.0 }] })
        };
        let moment =
            json!({ "b": { "moment": { "max": { "value": 5.0, "s": 1.0, "time": 0.3 } } } });
        let several = |names: &[&str]| {
            let contacts: serde_json::Map<String, Value> =
                names.iter().map(|n| ((*n).into(), two(n))).collect();
            plain(&json!({ "contact": contacts, "energy": {}, "section_forces": moment }))
        };
        let text = several(&["x"]);
        assert!(text.contains("They parted at 200 ms, moving apart at 1 m/s."), "{text}");
        assert!(text.contains("s = 1 m, 300 ms, after the contact."), "{text}");
        assert!(several(&["x", "y", "z"]).contains("Contacts y and z closed as well."));
        assert!(several(&["v", "w", "x", "y", "z"]).contains("4 other contacts closed as well."));
        let resting = json!([{ "start": 0.2, "end": null }]);
        let text = plain(&run(vec![impact(0.1, 7.0, 4.0)], resting));
        assert!(text.contains("still in contact at the end"), "{text}");
        let nothing = json!({ "contact": { "tap": { "between": ["a", "b"], "intervals": [] } }, "energy": {} });
        assert_eq!(plain(&nothing), "Nothing touched: the one contact never closed.");
    }
}
