//! What yielded, fractured or failed.

use serde_json::{Map, Value};

use super::words::{capital, instant, place, quantity};

/// First yield, largest plastic strain and permanent deflection of beams, each of the beam with the largest value.
pub(super) fn beams(summary: &Value) -> Option<String> {
    let all = summary["plastic"].as_object()?;
    let most =
        |size: &dyn Fn(&Value) -> f64| all.iter().max_by(|a, b| size(a.1).total_cmp(&size(b.1)));
    let strain = |beam: &Value| beam["strain_max"].as_f64().map_or(0.0, f64::abs);
    let began = |beam: &Value| beam["first_yield"]["time"].as_f64();
    let (first, beam) = most(&|beam| began(beam).map_or(f64::NEG_INFINITY, |time| -time))?;
    let Some(time) = began(beam) else {
        return Some(match all.len() {
            1 => format!("Beam '{first}' did not yield."),
            n => format!("No beam yielded ({n} can yield)."),
        });
    };
    let (time, s) = (instant(Some(time)), place(beam["first_yield"]["s"].as_f64()));
    let (strained, strongly) = most(&strain)?;
    let largest = quantity(strongly["strain_max"].as_f64(), "");
    let largest = largest.trim_end();
    let others = others(all, first);
    let mut out = match others {
        0 => format!(
            "First yield of beam '{first}' at {s}, {time}; largest plastic strain {largest}."
        ),
        n => format!(
            "First yield: beam '{first}', {s}, {time}; {n} other {} also yielded. Largest plastic strain {largest} in '{strained}'.",
            if n == 1 { "beam" } else { "beams" },
        ),
    };
    let set = |beam: &Value| beam["permanent_set"].as_f64().unwrap_or(f64::NEG_INFINITY);
    if let Some((name, beam)) = most(&set) {
        let length = summary["section_forces"][name]["length"].as_f64();
        let of = (all.len() > 1).then_some(name.as_str());
        out.extend(deflection(beam, of, length).map(|sentence| format!(" {sentence}")));
    }
    Some(out)
}

/// Share of the largest dissipation of a beam below which another one has dissipated nothing worth a word.
const NOTHING: f64 = 1e-9;

/// Beams besides that of a name that yielded, and dissipated more than round-off.
fn others(all: &Map<String, Value>, first: &str) -> usize {
    let lost = |beam: &Value| beam["dissipated"].as_f64();
    let most = all.values().filter_map(lost).fold(0.0, f64::max);
    let worth = |beam: &Value| lost(beam).is_none_or(|own| own > NOTHING * most);
    let yielded = |beam: &Value| beam["first_yield"]["time"].is_number() && worth(beam);
    all.iter().filter(|(name, beam)| *name != first && yielded(beam)).count()
}

/// The permanent deflection of a beam, or why it is not available; nothing of a beam that fractured, since that is stated elsewhere.
fn deflection(beam: &Value, name: Option<&str>, length: Option<f64>) -> Option<String> {
    let of = name.map_or(String::new(), |name| format!(" of beam '{name}'"));
    if let Some(size) = permanent_deflection(beam, length) {
        return Some(format!("Permanent deflection{of} after unloading: {size}."));
    }
    let whole = super::list(beam, "parted").is_empty();
    let reason = beam["permanent_set_note"].as_str().filter(|_| whole)?;
    Some(format!("The permanent deflection{of} is not available: {reason}."))
}

/// The direction of a permanent deflection is given if its component across is no more than this share of it.
const ASIDE: f64 = 0.1;
/// A place closer to the middle of a beam than this share of its length is its mid-span.
const MIDDLE: f64 = 1e-6;

/// Size, direction and place of a permanent deflection: `162.7 mm downwards at mid-span`.
fn permanent_deflection(beam: &Value, length: Option<f64>) -> Option<String> {
    let size = beam["permanent_set"].as_f64()?;
    let at = &beam["permanent_set_at"];
    let across = |i: usize| {
        let other = at["displacement"][1 - i].as_f64();
        other.is_some_and(|x| size > 0.0 && x.abs() <= ASIDE * size)
    };
    let along =
        (0..2).find(|i| across(*i)).and_then(|i| Some((i, at["displacement"][i].as_f64()?)));
    let mut out = match along {
        Some((axis, component)) => {
            let direction = match (axis, component < 0.0) {
                (0, true) => "to the left",
                (0, false) => "to the right",
                (_, true) => "downwards",
                (_, false) => "upwards",
            };
            format!("{} {direction}", quantity(Some(component.abs()), "m"))
        }
        None => quantity(Some(size), "m"),
    };
    if let Some(s) = at["s"].as_f64().filter(|_| size > 0.0) {
        let middle = length.is_some_and(|length| (2.0 * s - length).abs() <= MIDDLE * length);
        out += &if middle { " at mid-span".to_owned() } else { format!(" at {}", place(Some(s))) };
    }
    Some(out)
}

/// The joints that failed, in the order of time.
pub(super) fn joints(summary: &Value) -> Option<String> {
    let all = summary["joint"].as_object()?;
    let time = |joint: &Value| joint["parted"]["time"].as_f64();
    let mut failed: Vec<(&String, &Value)> =
        all.iter().filter(|(_, joint)| time(joint).is_some()).collect();
    failed.sort_by(|a, b| time(a.1).unwrap_or(0.0).total_cmp(&time(b.1).unwrap_or(0.0)));
    let (name, first) = failed.first()?;
    let under = |key: &str, unit: &str| {
        let size = first["parted"][key].as_f64().filter(|size| *size > 0.0);
        size.map(|size| quantity(Some(size), unit))
    };
    let under: Vec<String> =
        [under("force", "N"), under("moment", "N*m")].into_iter().flatten().collect();
    let sentence = match &under[..] {
        // The load at which a joint fails in a static start is not known.
        [] => format!("Joint '{name}' failed in the static start."),
        under => {
            format!(
                "Joint '{name}' failed at {} under {}.",
                instant(time(first)),
                under.join(" and ")
            )
        }
    };
    Some(match failed.len() - 1 {
        0 => sentence,
        1 => format!("{sentence} One more joint failed."),
        more => format!("{sentence} {more} more joints failed."),
    })
}

/// A fracture of a beam, as its sentence names it.
struct Fracture<'v> {
    beam: &'v str,
    /// Its place, or both ends of the elements of a fracture at the node between them, shape (1 or 2) \[m\].
    places: Vec<f64>,
    /// Ends of the elements, shape (2) \[m\]; NaN in results of earlier versions.
    stretch: [f64; 2],
    time: f64,
}

impl Fracture<'_> {
    fn sentence(&self) -> String {
        let places: Vec<String> = self.places.iter().map(|s| place(Some(*s))).collect();
        let (places, time) = (places.join(" and "), instant(Some(self.time)));
        format!("Beam '{}' fractured at {places}, {time}.", self.beam)
    }
}

/// Fractures of a beam, along it at each instant; elements on both sides of a node that fracture at the same instant are one.
fn fractures_of<'v>(beam: &'v str, summary: &'v Value) -> Vec<Fracture<'v>> {
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let one = |parting: &Value| Fracture {
        beam,
        places: vec![number(&parting["s"])],
        stretch: [0, 1].map(|end| number(&parting["stretch"][end])),
        time: parting["time"].as_f64().unwrap_or(0.0),
    };
    let mut all: Vec<Fracture<'v>> = super::list(summary, "parted").iter().map(one).collect();
    let along = |one: &Fracture<'_>| one.places[0];
    all.sort_by(|a, b| a.time.total_cmp(&b.time).then(along(a).total_cmp(&along(b))));
    let mut out: Vec<Fracture<'v>> = Vec::new();
    for next in all {
        match out.last_mut() {
            Some(last) if last.time == next.time && last.stretch[1] == next.stretch[0] => {
                last.places.truncate(1);
                last.places.extend(next.places);
                last.stretch[1] = next.stretch[1];
            }
            _ => out.push(next),
        }
    }
    out
}

/// Where and when beams fractured: each place while they are few.
pub(super) fn fractures(summary: &Value) -> Option<String> {
    let all = summary["plastic"].as_object()?;
    let mut places: Vec<Fracture<'_>> =
        all.iter().flat_map(|(name, beam)| fractures_of(name, beam)).collect();
    places.sort_by(|a, b| a.time.total_cmp(&b.time));
    let first = places.first()?.sentence();
    Some(match places.len() - 1 {
        0 => first,
        1 => format!("{first} {}", places[1].sentence()),
        more => format!("{first} {more} more fractures."),
    })
}

/// The spring or hinge with the largest dissipation.
pub(super) fn connectors(summary: &Value) -> Option<String> {
    let lost = |one: &Value| one["dissipated"].as_f64().unwrap_or(0.0);
    let first = |one: &Value| one["first_yield"]["time"].as_f64();
    let all = summary["yielding"].as_object().filter(|all| !all.is_empty())?;
    let (name, most) = all.iter().max_by(|a, b| lost(a.1).total_cmp(&lost(b.1)))?;
    let Some(began) = first(most) else {
        return Some(capital(&elastic(all)));
    };
    let [what, unit] = if most.get("plastic_rotation").is_some() {
        ["rotation", "rad"]
    } else {
        ["extension", "m"]
    };
    let yielded = all.values().filter(|one| first(one).is_some()).count();
    let began = instant(Some(began));
    let mut out = match all.len() {
        1 => format!("First yield of {} at {began}", connector(name)),
        n => format!(
            "{yielded} of {n} springs and joints with a limit yielded. Largest dissipation in {}: first yield at {began}",
            connector(name)
        ),
    };
    match most["failure"]["time"].as_f64() {
        Some(failed) => out.push_str(&format!(", failure at {}", instant(Some(failed)))),
        None => {
            let plastic = most[format!("plastic_{what}").as_str()].as_f64();
            out.push_str(&format!(", plastic {what} {}", quantity(plastic, unit)));
        }
    }
    let preload = most["dissipated_by_preload"].as_f64().filter(|energy| *energy > 0.0);
    let preload = preload.map_or(String::new(), |energy| {
        format!(", {} of it in the static start", quantity(Some(energy), "J"))
    });
    out.push_str(&format!(", {} dissipated{preload}.", quantity(Some(lost(most)), "J")));
    out.push_str(&failed_besides(all, name));
    Some(out)
}

/// Failures of springs and joints besides that of a name; a space precedes the sentence.
fn failed_besides(all: &Map<String, Value>, name: &str) -> String {
    let failed = failures(all.iter().filter(|(other, _)| *other != name));
    let Some((first, time)) = failed.iter().min_by(|a, b| a.1.total_cmp(&b.1)) else {
        return String::new();
    };
    let at = instant(Some(*time));
    match failed.len() {
        1 => format!(" {} failed at {at}.", capital(first)),
        n => format!(" {n} others failed, {first} first at {at}."),
    }
}

/// Springs and joints that failed, as sentences name them, and when \[s\].
fn failures<'v>(all: impl Iterator<Item = (&'v String, &'v Value)>) -> Vec<(String, f64)> {
    all.filter_map(|(name, one)| Some((connector(name), one["failure"]["time"].as_f64()?)))
        .collect()
}

/// Springs and joints with a limit of yield or failure, none of which yielded: which failed first, or how far a single one was extended.
fn elastic(all: &Map<String, Value>) -> String {
    let failed = failures(all.iter());
    let first = failed.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    match (all.len(), all.iter().next(), first) {
        (1, Some((_, one)), Some((name, time))) => {
            format!("{name} failed at {}{}.", instant(Some(*time)), reached_before(one))
        }
        (1, Some((name, one)), None) => {
            let largest =
                [("force", "N"), ("moment", "N*m"), ("extension", "m"), ("rotation", "rad")];
            let shown = largest.into_iter().filter_map(|(what, unit)| {
                let peak = &one[format!("{what}_max").as_str()];
                let value = quantity(Some(peak["value"].as_f64()?), unit);
                let time = instant(Some(peak["time"].as_f64()?));
                Some(format!("; largest {what} {value} at {time}"))
            });
            let shown: String = shown.collect();
            format!("{} neither yielded nor failed{shown}.", connector(name))
        }
        (n, _, Some((name, time))) => format!(
            "{} of {n} springs and joints with a limit failed, {name} first at {}.",
            failed.len(),
            instant(Some(*time))
        ),
        (n, ..) => format!("None of the {n} springs and joints with a limit yielded or failed."),
    }
}

/// The largest force or moment before a failure, where one is known.
fn reached_before(one: &Value) -> String {
    let reached = [("force", "N"), ("moment", "N*m")].into_iter().find_map(|(what, unit)| {
        let most = one[format!("{what}_max").as_str()]["value"].as_f64()?;
        (most != 0.0).then(|| format!("; largest {what} before {}", quantity(Some(most), unit)))
    });
    reached.unwrap_or_default()
}

/// The largest force of a stop that was touched.
pub(super) fn stops(summary: &Value) -> Option<String> {
    let supports = summary["support"].as_object()?;
    let touches = supports.iter().flat_map(|(name, support)| {
        super::list(support, "intervals").iter().map(move |touch| (name, &touch["peak_force"]))
    });
    let size = |peak: &Value| peak["value"].as_f64().unwrap_or(0.0);
    let (name, peak) = touches.max_by(|a, b| size(a.1).total_cmp(&size(b.1)))?;
    let (force, time) = (quantity(peak["value"].as_f64(), "N"), instant(peak["time"].as_f64()));
    Some(format!("Peak force of stop '{name}': {force} at {time}."))
}

/// `spring.brace` as a sentence names it: spring 'brace'.
fn connector(name: &str) -> String {
    match name.split_once('.') {
        Some((kind @ ("spring" | "joint"), name)) => format!("{kind} '{name}'"),
        _ => format!("'{name}'"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// The words, without what keeps a number and its unit on one line.
    fn plain(beam: &Value) -> Option<String> {
        permanent_deflection(beam, Some(1.0)).map(|text| text.replace('\u{a0}', " "))
    }

    /// Of several beams each figure is that of the beam that it is largest of.
    #[test]
    fn each_sentence_names_the_beam_with_the_largest_value() {
        let beam = |time: f64, strain: f64, set: f64| {
            json!({
                "first_yield": { "time": time, "s": 0.5 },
                "strain_max": strain,
                "permanent_set": set,
                "permanent_set_at": { "s": 1.0, "displacement": [set, 0.0] },
            })
        };
        let untouched = json!({ "first_yield": null, "strain_max": 0.0, "permanent_set": null });
        let summary = json!({ "plastic": {
            "girder": beam(0.024, -0.02, 15.6e-3), "left": beam(0.008, 0.01, 24.6e-3), "right": untouched,
        } });
        let text = beams(&summary).unwrap().replace('\u{a0}', " ");
        assert_eq!(
            text,
            "First yield: beam 'left', s = 500 mm, t = 8 ms; 1 other beam also yielded. Largest plastic strain -0.02 in 'girder'. \
             Permanent deflection of beam 'left' after unloading: 24.6 mm to the right at s = 1 m."
        );
        let none = json!({ "plastic": { "a": untouched, "b": untouched } });
        assert_eq!(beams(&none).as_deref(), Some("No beam yielded (2 can yield)."));
    }

    /// A beam whose fibres reached the yield stress without flowing has not yielded in any sense of the word.
    #[test]
    fn beams_that_dissipated_nothing_are_not_counted() {
        let beam = |time: f64, lost: f64| json!({ "first_yield": { "time": time, "s": 0.5 }, "strain_max": 1e-3, "dissipated": lost });
        let text = |lost: f64| {
            let all = json!({ "plastic": { "a": beam(0.01, 64.6), "b": beam(0.02, lost) } });
            beams(&all).unwrap()
        };
        assert!(text(1.0).contains("1 other beam also yielded"));
        assert!(!text(1e-12).contains("also yielded") && !text(0.0).contains("also yielded"));
    }

    /// Springs of a given strength fail without yielding.
    #[test]
    fn a_spring_that_breaks_is_named_with_the_time() {
        let spring = |failed: Option<f64>| {
            json!({
                "first_yield": { "time": null }, "dissipated": 0.0, "failure": { "time": failed },
            })
        };
        let story = |all: Value| connectors(&all).unwrap().replace('\u{a0}', " ");
        let one = json!({ "yielding": { "spring.rope": spring(Some(0.032)) } });
        assert_eq!(story(one), "Spring 'rope' failed at t = 32 ms.");
        let two = json!({ "yielding": {
            "spring.a": spring(Some(0.05)), "spring.b": spring(Some(0.032)), "spring.c": spring(None),
        } });
        assert_eq!(
            story(two),
            "2 of 3 springs and joints with a limit failed, spring 'b' first at t = 32 ms."
        );
        let none = json!({ "yielding": { "spring.rope": spring(None) } });
        assert_eq!(story(none), "Spring 'rope' neither yielded nor failed.");
    }

    /// The sentence is of the largest dissipation; what failed elsewhere is named, too.
    #[test]
    fn failures_besides_the_largest_dissipation_are_named() {
        let of = |energy: f64, failed: Option<f64>| {
            json!({
                "first_yield": { "time": 0.01 }, "dissipated": energy, "plastic_extension": 0.002,
                "failure": { "time": failed },
            })
        };
        let story = |all: Value| {
            let text = connectors(&json!({ "yielding": all })).unwrap();
            text.replace('\u{a0}', " ").split_once("dissipated.").unwrap().1.to_owned()
        };
        let strut = of(90.0, None);
        let one = json!({ "spring.strut": strut, "spring.tie": of(5.0, Some(0.019)) });
        assert_eq!(story(one), " Spring 'tie' failed at t = 19 ms.");
        let two = json!({
            "spring.strut": strut, "spring.tie": of(5.0, Some(0.019)), "joint.foot": of(1.0, Some(0.012)),
        });
        assert_eq!(story(two), " 2 others failed, joint 'foot' first at t = 12 ms.");
        assert_eq!(story(json!({ "spring.strut": strut, "spring.tie": of(5.0, None) })), "");
    }

    #[test]
    fn a_permanent_deflection_has_its_direction_and_place() {
        let words = |x: f64, y: f64| {
            let at = json!({ "s": 0.5, "displacement": [x, y] });
            plain(&json!({ "permanent_set": x.hypot(y), "permanent_set_at": at }))
        };
        assert_eq!(words(1e-17, -6.9e-3).as_deref(), Some("6.9 mm downwards at mid-span"));
        assert_eq!(words(1e-3, 6.9e-2).as_deref(), Some("69 mm upwards at mid-span"));
        assert_eq!(words(30e-3, -1e-3).as_deref(), Some("30 mm to the right at mid-span"));
        assert_eq!(words(-30e-3, 1e-3).as_deref(), Some("30 mm to the left at mid-span"));
        assert_eq!(words(3e-3, 4e-3).as_deref(), Some("5 mm at mid-span"));
        assert_eq!(words(0.0, 0.0).as_deref(), Some("0 m"));
        // A result of an earlier version has the size alone.
        let old = json!({ "permanent_set": 2e-3 });
        assert_eq!(plain(&old).as_deref(), Some("2 mm"));
        assert!(plain(&json!({ "permanent_set": null })).is_none());
    }

    /// Joints, fractures and springs; names are those of the user.
    #[test]
    fn failures_are_described_with_time_and_load() {
        let plain = |text: Option<String>| text.map(|text| text.replace('\u{a0}', " "));
        let joint = |time: f64, force: f64| json!({ "parted": { "time": time, "force": force, "moment": 0.0 } });
        let summary =
            json!({ "joint": { "weld": joint(0.002, 4e3), "pin": joint(0.001, 2e3), "knee": {} } });
        let text = "Joint 'pin' failed at t = 1 ms under 2000 N. One more joint failed.";
        assert_eq!(plain(joints(&summary)).as_deref(), Some(text));
        let early = json!({ "joint": { "pin": { "parted": { "time": 0.0, "force": null, "moment": null } } } });
        let text = "Joint 'pin' failed in the static start.";
        assert_eq!(plain(joints(&early)).as_deref(), Some(text));
        let broken = json!({ "plastic": { "g": { "parted": [{ "s": 0.5, "time": 0.003 }] } } });
        let text = "Beam 'g' fractured at s = 500 mm, t = 3 ms.";
        assert_eq!(plain(fractures(&broken)).as_deref(), Some(text));
        let side = |s: f64, stretch: [f64; 2], time: f64| json!({ "s": s, "stretch": stretch, "time": time });
        let both = [side(0.2503, [0.25, 0.26], 0.003), side(0.2497, [0.24, 0.25], 0.003)];
        let torn = json!({ "plastic": { "g": { "parted": both } } });
        let text = "Beam 'g' fractured at s = 249.7 mm and s = 250.3 mm, t = 3 ms.";
        assert_eq!(plain(fractures(&torn)).as_deref(), Some(text));
        // Not at one instant: two fractures.
        let later = [side(0.2503, [0.25, 0.26], 0.003), side(0.2497, [0.24, 0.25], 0.004)];
        let torn = json!({ "plastic": { "g": { "parted": later } } });
        let text = "Beam 'g' fractured at s = 250.3 mm, t = 3 ms. Beam 'g' fractured at s = 249.7 mm, t = 4 ms.";
        assert_eq!(plain(fractures(&torn)).as_deref(), Some(text));
        let brace = json!({
            "first_yield": { "time": 0.0 }, "plastic_extension": -2e-3, "dissipated": 12.0, "dissipated_by_preload": 3.0,
        });
        let text = "First yield of spring 'brace' at t = 0 s, plastic extension -2 mm, 12 J dissipated, 3 J of it in the static start.";
        let summary = json!({ "yielding": { "spring.brace": brace } });
        assert_eq!(plain(connectors(&summary)).as_deref(), Some(text));
        let calm = json!({ "yielding": { "spring.brace": { "first_yield": null }, "joint.knee": { "first_yield": null } } });
        let text = "None of the 2 springs and joints with a limit yielded or failed.";
        assert_eq!(plain(connectors(&calm)).as_deref(), Some(text));
        let rope = |failure: Value| {
            json!({
                "first_yield": { "time": null }, "failure": { "time": failure },
                "extension_max": { "value": 0.29, "time": 0.55 }, "force_max": { "value": 8.7e3, "time": 0.55 },
            })
        };
        let whole = json!({ "yielding": { "spring.rope": rope(Value::Null) } });
        let text = "Spring 'rope' neither yielded nor failed; largest force 8700 N at t = 550 ms; largest extension 290 mm at t = 550 ms.";
        assert_eq!(plain(connectors(&whole)).as_deref(), Some(text));
        let broken = json!({ "yielding": { "spring.rope": rope(json!(0.6)) } });
        let text = "Spring 'rope' failed at t = 600 ms; largest force before 8700 N.";
        assert_eq!(plain(connectors(&broken)).as_deref(), Some(text));
        let touch =
            |force: f64, time: f64| json!({ "peak_force": { "value": force, "time": time } });
        let held = json!({ "support": {
            "anchor": {}, "restraint": { "intervals": [touch(288e3, 0.011), touch(37e3, 0.1)] },
        } });
        let text = "Peak force of stop 'restraint': 288 kN at t = 11 ms.";
        assert_eq!(plain(stops(&held)).as_deref(), Some(text));
        assert_eq!(stops(&json!({ "support": { "stop": { "intervals": [] } } })), None);
        let one =
            json!({ "yielding": { "spring.a": rope(Value::Null), "spring.b": rope(json!(0.6)) } });
        let text = "1 of 2 springs and joints with a limit failed, spring 'b' first at t = 600 ms.";
        assert_eq!(plain(connectors(&one)).as_deref(), Some(text));
    }

    /// Where no permanent deflection is known its reason is given, but not for a beam in pieces.
    #[test]
    fn a_missing_permanent_deflection_has_its_reason() {
        let beam = |parted: Value| json!({ "permanent_set": null, "permanent_set_note": "it is free to move", "parted": parted });
        let text = "The permanent deflection of beam 'g' is not available: it is free to move.";
        assert_eq!(deflection(&beam(json!([])), Some("g"), None).as_deref(), Some(text));
        assert!(deflection(&beam(json!([{ "s": 0.5 }])), Some("g"), None).is_none());
    }
}
