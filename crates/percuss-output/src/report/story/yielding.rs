//! What yielded.

use serde_json::Value;

use super::words::quantity;

/// What the beams that can yield did: which one began, how far it went, what stays. Each is told of the beam that it is largest of.
pub(super) fn beams(summary: &Value) -> Option<String> {
    let all = summary["plastic"].as_object()?;
    let most =
        |size: &dyn Fn(&Value) -> f64| all.iter().max_by(|a, b| size(a.1).total_cmp(&size(b.1)));
    let strain = |beam: &Value| beam["strain_max"].as_f64().map_or(0.0, f64::abs);
    let began = |beam: &Value| beam["first_yield"]["time"].as_f64();
    let (first, beam) = most(&|beam| began(beam).map_or(f64::NEG_INFINITY, |time| -time))?;
    let Some(time) = began(beam) else {
        return Some(match all.len() {
            1 => format!("{first} did not yield."),
            n => format!("None of {n} beams that can yield did."),
        });
    };
    let (time, place) =
        (quantity(Some(time), "s"), quantity(beam["first_yield"]["s"].as_f64(), "m"));
    let (strained, strongly) = most(&strain)?;
    let largest = quantity(strongly["strain_max"].as_f64(), "");
    let largest = largest.trim_end();
    let others = all.values().filter(|beam| began(beam).is_some()).count() - 1;
    let mut out = match others {
        0 => format!(
            "{first} began to yield at {time}, {place} from its start, and reached a plastic strain of {largest}."
        ),
        n => format!(
            "{first} began to yield at {time}, {place} from its start, {n} other {} later; the largest plastic strain is {largest}, in {strained}.",
            if n == 1 { "beam" } else { "beams" },
        ),
    };
    let set = |beam: &Value| beam["permanent_set"].as_f64().unwrap_or(f64::NEG_INFINITY);
    let kept = most(&set).map(|(name, beam)| (name, beam, permanent_set(beam)));
    match kept {
        Some((name, _, Some(set))) if all.len() > 1 => {
            out.push_str(&format!(" Unloaded {name} keeps {set}."));
        }
        Some((.., Some(set))) => out.push_str(&format!(" Unloaded it keeps {set}.")),
        Some((name, beam, None)) => {
            // Of a beam in pieces it is told that it parted.
            let whole = super::list(beam, "parted").is_empty();
            if let Some(reason) = beam["permanent_set_note"].as_str().filter(|_| whole) {
                out.push_str(&format!(" No permanent set of {name} is told: {reason}."));
            }
        }
        None => {}
    }
    Some(out)
}

/// A permanent set is told along an axis if what it has across is no more than this share of it; else by its size.
const ASIDE: f64 = 0.1;

/// What a beam keeps for good, and which way.
fn permanent_set(beam: &Value) -> Option<String> {
    let size = beam["permanent_set"].as_f64()?;
    let at = &beam["permanent_set_at"]["displacement"];
    let across =
        |i: usize| at[1 - i].as_f64().is_some_and(|x| size > 0.0 && x.abs() <= ASIDE * size);
    let along = (0..2).find(|i| across(*i)).and_then(|i| Some((i + 1, at[i].as_f64()?)));
    Some(match along {
        Some((axis, set)) => format!("a set of {} along e{axis}", quantity(Some(set), "m")),
        None => format!("a set of {}", quantity(Some(size), "m")),
    })
}

/// The joints that parted, in the order of time.
pub(super) fn joints(summary: &Value) -> Option<String> {
    let all = summary["joint"].as_object()?;
    let time = |joint: &Value| joint["parted"]["time"].as_f64();
    let mut parted: Vec<(&String, &Value)> =
        all.iter().filter(|(_, joint)| time(joint).is_some()).collect();
    parted.sort_by(|a, b| time(a.1).unwrap_or(0.0).total_cmp(&time(b.1).unwrap_or(0.0)));
    let (name, first) = parted.first()?;
    let under = |key: &str, unit: &str| {
        let size = first["parted"][key].as_f64().filter(|size| *size > 0.0);
        size.map(|size| quantity(Some(size), unit))
    };
    let under: Vec<String> =
        [under("force", "N"), under("moment", "N*m")].into_iter().flatten().collect();
    let told = match &under[..] {
        // Of what parts in a static start no load is known.
        [] => format!("The joint {name} parted in the static start."),
        under => format!(
            "The joint {name} parted after {} under {}.",
            quantity(time(first), "s"),
            under.join(" and ")
        ),
    };
    Some(match parted.len() - 1 {
        0 => told,
        1 => format!("{told} So did another joint, later."),
        more => format!("{told} So did {more} other joints, later."),
    })
}

/// Where and when beams parted: each place while they are few.
pub(super) fn partings(summary: &Value) -> Option<String> {
    let all = summary["plastic"].as_object()?;
    let mut places: Vec<(&String, &Value)> = all
        .iter()
        .flat_map(|(name, beam)| super::list(beam, "parted").iter().map(move |one| (name, one)))
        .collect();
    places.sort_by(|a, b| {
        a.1["time"].as_f64().unwrap_or(0.0).total_cmp(&b.1["time"].as_f64().unwrap_or(0.0))
    });
    let told = |(name, one): &(&String, &Value)| {
        let (s, time) = (quantity(one["s"].as_f64(), "m"), quantity(one["time"].as_f64(), "s"));
        format!("The beam {name} parted at s = {s} after {time}.")
    };
    let first = told(places.first()?);
    Some(match places.len() - 1 {
        0 => first,
        1 => format!("{first} {}", told(&places[1])),
        more => format!("{first} Beams parted at {more} more places."),
    })
}

/// The first of the springs that failed without yielding, those of a given strength.
fn failed(all: &serde_json::Map<String, Value>) -> Option<String> {
    let times = all.iter().filter_map(|(name, one)| Some((name, one["failure"]["time"].as_f64()?)));
    let mut failed: Vec<(&String, f64)> = times.collect();
    failed.sort_by(|a, b| a.1.total_cmp(&b.1));
    let (name, time) = failed.first()?;
    let time = quantity(Some(*time), "s");
    Some(match failed.len() - 1 {
        0 => format!("{name} failed at {time}."),
        1 => format!("{name} failed at {time}, another spring later."),
        more => format!("{name} failed at {time}, {more} other springs later."),
    })
}

/// The spring or hinge that dissipated most.
pub(super) fn connectors(summary: &Value) -> Option<String> {
    let lost = |one: &Value| one["dissipated"].as_f64().unwrap_or(0.0);
    let first = |one: &Value| one["first_yield"]["time"].as_f64();
    let all = summary["yielding"].as_object().filter(|all| !all.is_empty())?;
    let (name, most) = all.iter().max_by(|a, b| lost(a.1).total_cmp(&lost(b.1)))?;
    let Some(began) = first(most) else {
        if let Some(failed) = failed(all) {
            return Some(failed);
        }
        return Some(match all.len() {
            1 => format!("{name} did not yield."),
            n => format!("None of {n} springs and joints that can yield did."),
        });
    };
    let [what, unit] = if most.get("plastic_rotation").is_some() {
        ["rotation", "rad"]
    } else {
        ["extension", "m"]
    };
    let time = |t: f64| quantity(Some(t), "s");
    let yielded = all.values().filter(|one| first(one).is_some()).count();
    let began = time(began);
    let mut out = match all.len() {
        1 => format!("{name} began to yield at {began}"),
        n => format!(
            "{yielded} of {n} springs and joints that can yield did. {name} took most: it began to yield at {began}"
        ),
    };
    match most["failure"]["time"].as_f64() {
        Some(failed) => out.push_str(&format!(" and failed at {}", time(failed))),
        None => {
            let plastic = most[format!("plastic_{what}").as_str()].as_f64();
            out.push_str(&format!(", keeps a plastic {what} of {}", quantity(plastic, unit)));
        }
    }
    let preload = most["dissipated_by_preload"].as_f64().filter(|energy| *energy > 0.0);
    let preload = preload.map_or(String::new(), |energy| {
        format!(", {} of it by the preload", quantity(Some(energy), "J"))
    });
    out.push_str(&format!(", and dissipated {}{preload}.", quantity(Some(lost(most)), "J")));
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// The words, without what keeps a number and its unit on one line.
    fn plain(beam: &Value) -> Option<String> {
        permanent_set(beam).map(|text| text.replace('\u{a0}', " "))
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
        let told = beams(&summary).unwrap().replace('\u{a0}', " ");
        assert_eq!(
            told,
            "left began to yield at 8 ms, 500 mm from its start, 1 other beam later; the largest plastic strain is -0.02, in girder. \
             Unloaded left keeps a set of 24.6 mm along e1."
        );
        let none = json!({ "plastic": { "a": untouched, "b": untouched } });
        assert_eq!(beams(&none).as_deref(), Some("None of 2 beams that can yield did."));
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
        assert_eq!(story(one), "spring.rope failed at 32 ms.");
        let two = json!({ "yielding": {
            "spring.a": spring(Some(0.05)), "spring.b": spring(Some(0.032)), "spring.c": spring(None),
        } });
        assert_eq!(story(two), "spring.b failed at 32 ms, another spring later.");
        let none = json!({ "yielding": { "spring.rope": spring(None) } });
        assert_eq!(story(none), "spring.rope did not yield.");
    }

    #[test]
    fn a_set_is_told_along_the_axis_that_it_lies_on() {
        let told = |x: f64, y: f64| {
            let at = json!({ "s": 0.5, "displacement": [x, y] });
            plain(&json!({ "permanent_set": x.hypot(y), "permanent_set_at": at }))
        };
        assert_eq!(told(1e-17, -6.9e-3).as_deref(), Some("a set of -6.9 mm along e2"));
        assert_eq!(told(30e-3, -1e-3).as_deref(), Some("a set of 30 mm along e1"));
        assert_eq!(told(3e-3, 4e-3).as_deref(), Some("a set of 5 mm"));
        assert_eq!(told(0.0, 0.0).as_deref(), Some("a set of 0 m"));
        // A result of an earlier version says no more than how much.
        let old = json!({ "permanent_set": 2e-3 });
        assert_eq!(plain(&old).as_deref(), Some("a set of 2 mm"));
        assert!(plain(&json!({ "permanent_set": null })).is_none());
    }
}
