//! What yielded.

use serde_json::Value;

use super::quantity;

/// The beam that yielded most, in terms of plastic strain.
pub(super) fn beams(summary: &Value) -> Option<String> {
    let strain = |beam: &Value| beam["strain_max"].as_f64().map_or(0.0, f64::abs);
    let all = summary["plastic"].as_object()?;
    let (name, most) = all.iter().max_by(|a, b| strain(a.1).total_cmp(&strain(b.1)))?;
    let Some(time) = most["first_yield"]["time"].as_f64() else {
        return Some(format!("{name} did not yield."));
    };
    let metres = |value: &Value| quantity(value.as_f64(), "m");
    let mut out = format!(
        "{name} began to yield at {}, {} from its start, and reached a plastic strain of {}.",
        quantity(Some(time), "s"),
        metres(&most["first_yield"]["s"]),
        quantity(most["strain_max"].as_f64(), "").trim_end()
    );
    let others = all.values().filter(|beam| strain(beam) > 0.0).count() - 1;
    if others > 0 {
        let beams = if others == 1 { "beam" } else { "beams" };
        out.push_str(&format!(" So did {others} other {beams}, by less."));
    }
    if let Some(set) = permanent_set(most) {
        out.push_str(&format!(" Unloaded it keeps {set}."));
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
    let told = format!(
        "The joint {name} parted after {} under {}.",
        quantity(time(first), "s"),
        under.join(" and ")
    );
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

/// The spring or hinge that dissipated most.
pub(super) fn connectors(summary: &Value) -> Option<String> {
    let lost = |one: &Value| one["dissipated"].as_f64().unwrap_or(0.0);
    let first = |one: &Value| one["first_yield"]["time"].as_f64();
    let all = summary["yielding"].as_object().filter(|all| !all.is_empty())?;
    let (name, most) = all.iter().max_by(|a, b| lost(a.1).total_cmp(&lost(b.1)))?;
    let Some(began) = first(most) else {
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
    out.push_str(&format!(", and dissipated {}.", quantity(Some(lost(most)), "J")));
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
