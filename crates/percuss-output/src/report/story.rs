//! Summary text of a run, in a few sentences: what struck what, the peak force, the separation, the peak displacement, moment and
//! stress, what yielded, and the error of the energy balance. Every number in it is in `summary.json`.

mod contacts;
mod foundations;
mod words;
mod yielding;

pub use contacts::taken_as_start;

use serde_json::Value;

use crate::round_off::{ROUND_OFF, Scales, is_round_off, is_still, is_unstrained};
use words::{instant, list, place, quantity};

/// Stresses closer to the yield stress, relative, are on it.
const PLATEAU: f64 = 1e-6;
/// A larger relative error of the energy balance is a warning.
const CLOSED: f64 = 1e-8;

/// The summary text of a run, without markup.
pub fn story(summary: &Value) -> String {
    let mut out = vec![contacts::contacts(summary)];
    out.extend(deflection(summary));
    out.extend(sections(summary));
    out.extend(yielding::joints(summary));
    out.extend(yielding::fractures(summary));
    out.extend(yielding::beams(summary));
    out.extend(yielding::connectors(summary));
    out.extend(yielding::stops(summary));
    out.extend(foundations::foundations(summary));
    // What did not happen comes last.
    out.extend(contacts::none_closed(summary));
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
    if is_round_off(value, Scales::of(summary).length) {
        return None;
    }
    let axis = if component == "component_1" { "x" } else { "y" };
    let (value, time) = (quantity(Some(value), "m"), instant(time));
    // Other points of the structure may move further.
    let of = if points.len() > 1 { "points" } else { "point" };
    let more = match further(summary, points) {
        true => " Places that are not recorded moved further (permanent deflection).",
        false => "",
    };
    let base = if points[name]["relative_to_base"] == true { " relative to the base" } else { "" };
    Some(format!(
        "Largest displacement{base} of the recorded {of}: {value} in {axis} at '{name}', {time}.{more}"
    ))
}

/// Whether a permanent deflection is larger than any displacement of a recorded point may have been.
fn further(summary: &Value, points: &serde_json::Map<String, Value>) -> bool {
    let most = |point: &Value| {
        let of = |c: &str| point["displacement_max"][c]["value"].as_f64().unwrap_or(0.0);
        f64::hypot(of("component_1"), of("component_2"))
    };
    let recorded = points.values().map(most).fold(0.0, f64::max);
    let beams = summary["plastic"].as_object().into_iter().flat_map(|all| all.values());
    let sets = beams.filter_map(|beam| beam["permanent_set"].as_f64());
    sets.fold(0.0, f64::max) > recorded
}

/// The peak bending moment, and the peak fibre stress where one is known; where shear governs, the peak shear stress and von Mises stress.
fn sections(summary: &Value) -> Option<String> {
    let all = summary["section_forces"].as_object()?;
    // What a beam bears that is not strained is round-off.
    let beams: Vec<(&String, &Value)> =
        all.iter().filter(|(_, beam)| !is_unstrained(beam)).collect();
    let parting = last_parting(summary);
    let largest = |quantity: &str| {
        beams
            .iter()
            .copied()
            .flat_map(|(name, beam)| ["min", "max"].map(|end| (name, &beam[quantity][end])))
            .filter_map(|(name, one)| Some((name, one, one["value"].as_f64()?)))
            .max_by(|a, b| a.2.abs().total_cmp(&b.2.abs()))
            .filter(|(_, _, value)| *value != 0.0)
    };
    let peak = |what: &str, (name, one, value): (&String, &Value, f64), unit: &str| {
        let (s, time) = (place(one["s"].as_f64()), instant(one["time"].as_f64()));
        // The reader expects a peak within the contact; one of the free vibration after it is marked.
        let after = parting.zip(one["time"].as_f64()).is_some_and(|(end, time)| time > end);
        let after = if after { ", after the contact" } else { "" };
        format!("{what}: {} in '{name}' at {s}, {time}{after}.", quantity(Some(value.abs()), unit))
    };
    // A moment below the round-off of the energy scale is zero.
    let floor = ROUND_OFF * summary["energy"]["scale"].as_f64().unwrap_or(0.0);
    let moment = largest("moment")
        .filter(|m| m.2.abs() > floor)
        .map(|one| peak("Peak bending moment", one, "N*m"));
    let stress = largest("stress");
    let equivalent = beams
        .iter()
        .copied()
        .filter_map(|(name, beam)| {
            let one = &beam["von_mises_max"];
            Some((name, one, one["value"].as_f64()?))
        })
        .max_by(|a, b| a.2.total_cmp(&b.2))
        .filter(|one| one.2 > stress.map_or(0.0, |stress| stress.2.abs()));
    let shear = largest("shear_stress").filter(|_| equivalent.is_some());
    let sentences = [
        moment,
        stress.map(|one| match is_plateau(&all[one.0], one.2) {
            true => {
                let value = quantity(Some(one.2.abs()), "Pa");
                format!("Peak fibre stress: {value} in '{}' (yield stress).", one.0)
            }
            false => peak("Peak fibre stress", one, "Pa"),
        }),
        shear.map(|one| peak("Peak shear stress", one, "Pa")),
        equivalent.map(|one| peak("Peak von Mises stress", one, "Pa")),
    ];
    let reported: Vec<String> = sentences.into_iter().flatten().collect();
    (!reported.is_empty()).then(|| reported.join(" "))
}

/// Whether a fibre stress is the yield stress of a beam without hardening, which it reaches at many places and times.
pub(super) fn is_plateau(beam: &Value, stress: f64) -> bool {
    let limit = beam["yield_stress"].as_f64();
    limit.is_some_and(|limit| stress.abs() >= (1.0 - PLATEAU) * limit)
}

/// The error of the energy balance, and how the run ended where it did not reach its end.
fn balance(summary: &Value) -> String {
    let energy = &summary["energy"];
    let still = is_still(summary);
    let scale = quantity(energy["scale"].as_f64(), "J");
    let error = energy["residual_max"].as_f64().filter(|_| energy["scale"] != 0.0 && !still);
    let error = error.map(|error| {
        let begin = if error < CLOSED { "Energy" } else { "Warning: energy" };
        let error = if error == 0.0 { "0".to_owned() } else { format!("{error:.0e}") };
        format!("{begin} balance error {error} of {scale}.")
    });
    let time = instant(summary["time"].as_f64());
    let ended = match summary["status"].as_str() {
        Some("failed") => Some(format!("The run stopped with an error at {time}.")),
        Some("interrupted") => Some(format!("The run was interrupted at {time}.")),
        _ => None,
    };
    let nothing = still.then(|| "Nothing moved.".to_owned());
    let both: Vec<String> = ended.into_iter().chain(nothing).chain(error).collect();
    both.join(" ")
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn plain(summary: &Value) -> String {
        story(summary).replace('\u{a0}', " ")
    }

    /// Perfect plasticity has one stress at many places: which of them comes first is round-off.
    #[test]
    fn a_stress_on_the_plateau_of_its_material_has_no_place() {
        let at = |value: f64| json!({ "value": value, "s": 1.155, "time": 0.1962 });
        let beam = |most: f64| {
            json!({ "section_forces": { "b": {
            "stress": { "min": at(-1e8), "max": at(most) }, "yield_stress": 3.55e8,
        } } })
        };
        let reported = |most: f64| sections(&beam(most)).unwrap().replace('\u{a0}', " ");
        assert_eq!(reported(3.55e8 - 0.1), "Peak fibre stress: 355 MPa in 'b' (yield stress).");
        let elastic = "Peak fibre stress: 200 MPa in 'b' at s = 1.155 m, t = 196.2 ms.";
        assert_eq!(reported(2e8), elastic);
    }

    #[test]
    fn an_impact_is_described_from_first_contact_to_separation() {
        let summary = json!({
            "projectile": { "car": { "direction": [0.0, -1.0] } },
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
            "'left@0.5m' was struck by projectile 'car' at 8.333 m/s, t = 10 ms. Peak contact force 176.6 kN at t = 111.2 ms, in contact 2 of 2, at 1 m/s. \
             Final separation at t = 222.3 ms with a separation velocity of 8.326 m/s. \
             Largest displacement of the recorded point: -20 mm in y at 'mid', t = 300 ms. \
             Peak bending moment: 63 kN m in 'left' at s = 0 m, t = 100 ms. Energy balance error 9e-15 of 52.93 kJ."
        );
    }

    /// A structure at rest has moments, stresses and displacements of round-off, and a balance of nothing.
    #[test]
    fn a_structure_at_rest_is_told_to_be_so() {
        let range = |value: f64| {
            let at = |value: f64| json!({ "value": value, "s": 0.5, "time": 0.1 });
            json!({ "min": at(-value), "max": at(value) })
        };
        let run = |times: f64| {
            let beam = json!({
                "length": 2.0, "moment": range(6e-9 * times), "stress": range(8e-4 * times), "strain": range(4e-15 * times),
                "shear_stress": range(1e-5 * times), "von_mises_max": { "value": 0.0, "s": 0.0, "time": 0.0 },
            });
            let moved = json!({ "value": 3e-16 * times, "time": 0.07 });
            plain(&json!({
                "point": { "a.mid": { "displacement_max": { "component_1": moved, "component_2": moved } } },
                "section_forces": { "a": beam }, "energy": { "residual_max": 2e-6, "scale": 1e-16 },
            }))
        };
        assert_eq!(run(1.0), "Nothing moved.");
        assert!(run(1e6).contains("Peak fibre stress: 800 Pa in 'a'"), "{}", run(1e6));
    }

    #[test]
    fn a_permanent_deflection_beyond_the_recorded_displacements_is_no_contradiction() {
        let run = |set: f64| {
            let moved = |value: f64| json!({ "value": value, "time": 0.09 });
            plain(&json!({
                "point": { "rail@7m": { "displacement_max": { "component_1": moved(0.05), "component_2": moved(0.6011) } } },
                "plastic": { "rail": { "permanent_set": set } }, "energy": {},
            }))
        };
        let more = "Places that are not recorded moved further (permanent deflection).";
        assert!(run(0.7682).contains(more) && !run(0.5).contains(more), "{}", run(0.7682));
    }

    #[test]
    fn displacements_on_an_accelerated_base_are_relative_to_it() {
        let moved = json!({ "value": 0.05, "time": 0.09 });
        let of = |relative: bool| {
            let point = json!({ "displacement_max": { "component_1": moved }, "relative_to_base": relative });
            plain(&json!({ "point": { "mast.end": point }, "energy": {} }))
        };
        let text = "Largest displacement relative to the base of the recorded point: 50 mm in x at 'mast.end', t = 90 ms.";
        assert_eq!(of(true), text);
        assert_eq!(of(false), text.replace(" relative to the base", ""));
    }

    #[test]
    fn stresses_of_shear_are_named_where_they_govern() {
        let run = |equivalent: f64| {
            let at = |value: f64| json!({ "value": value, "s": 0.5, "time": 0.1 });
            let range = |value: f64| json!({ "min": at(0.0), "max": at(value) });
            let beam = json!({ "moment": range(3.0), "stress": range(2e6), "shear_stress": range(-4e6), "von_mises_max": at(equivalent) });
            plain(&json!({ "section_forces": { "stub": beam }, "energy": {} }))
        };
        let text = run(7e6);
        assert!(
            text.contains(
                "Peak shear stress: 4 MPa in 'stub' at s = 500 mm, t = 100 ms. \
                 Peak von Mises stress: 7 MPa in 'stub' at s = 500 mm, t = 100 ms."
            ),
            "{text}"
        );
        let text = run(2e6);
        assert!(text.contains("fibre stress") && !text.contains("shear"), "{text}");
        assert!(!text.contains("Mises"), "{text}");
    }

    #[test]
    fn impacts_are_described_by_their_impulses() {
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
            text.contains("2 impacts, total impulse 7 N s; largest impulse 5 N s at t = 200 ms, approach 4 m/s."),
            "{text}"
        );
        assert!(
            text.contains("The last impact, at t = 200 ms, was plastic (no separation velocity)."),
            "{text}"
        );
        assert!(
            text.contains(
                "The run stopped with an error at t = 500 ms. Warning: energy balance error 1e-3 of 1 J."
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
        assert!(
            text.contains("Separation at t = 200 ms with a separation velocity of 1 m/s."),
            "{text}"
        );
        assert!(text.contains("s = 1 m, t = 300 ms, after the contact."), "{text}");
        assert!(several(&["x", "y", "z"]).contains("Contacts 'y' and 'z' also closed."));
        assert!(several(&["v", "w", "x", "y", "z"]).contains("4 other contacts also closed."));
        let resting = json!([{ "start": 0.2, "end": null }]);
        let text = plain(&run(vec![impact(0.1, 7.0, 4.0)], resting));
        assert!(text.contains("The contact is closed at the end of the run."), "{text}");
        let nothing = json!({ "contact": { "tap": { "between": ["a", "b"], "intervals": [] } }, "energy": {} });
        assert_eq!(plain(&nothing), "Contact 'tap' did not close.");
    }
}
