//! Tables of extremes: reactions of supports, section forces of beams; sums of the impulses of supports.

use serde_json::{Map, Value};

use super::html::{escape, table};
use super::quantity::{number, quantity, without_round_off};
use super::story::is_plateau;
use crate::round_off::{SMALL_IMPULSE, Scales, is_round_off};
use crate::shown::{NAMES, ROWS};

/// Joints with a strength, fractures, and impulses of supports.
pub(super) fn failures_and_impulses(summary: &Value) -> String {
    [joints(summary), partings(summary), impulses(summary)].concat()
}

/// Smallest and largest reactions and section forces.
pub(super) fn ranges(summary: &Value) -> String {
    reactions(summary) + &section_forces(summary)
}

/// Largest forces of joints with a strength, and when they failed.
fn joints(summary: &Value) -> String {
    let empty = Map::new();
    let all = summary["joint"].as_object().unwrap_or(&empty);
    if all.is_empty() {
        return String::new();
    }
    let row = |(name, joint): (&String, &Value)| {
        let most = |key: &str, unit: &str| quantity(joint[key]["value"].as_f64(), unit);
        let failed = match joint["parted"]["time"].as_f64() {
            Some(time) => quantity(Some(time), "s"),
            None => "intact".to_owned(),
        };
        vec![name.clone(), most("force_max", "N"), most("moment_max", "N*m"), failed]
    };
    let more = all.len().saturating_sub(ROWS);
    let rows: Vec<Vec<String>> = all.iter().take(ROWS).map(row).collect();
    let header = ["joint", "largest force", "largest moment", "failed at"];
    first_rows("Joints with breakaway strength", &header, &rows, more)
}

/// A table of the first rows, and how many more there are.
pub(super) fn first_rows(
    title: &str,
    header: &[&str],
    rows: &[Vec<String>],
    more: usize,
) -> String {
    let mut out = table(title, header, rows);
    if more > 0 {
        out.push_str(&format!("<p class=\"more\">and {more} more rows in summary.json</p>\n"));
    }
    out
}

/// Fractures of beams, in the order of time.
fn partings(summary: &Value) -> String {
    let empty = Map::new();
    let beams = summary["plastic"].as_object().unwrap_or(&empty);
    let mut all: Vec<(f64, Vec<String>)> = Vec::new();
    for (name, beam) in beams {
        for one in beam["parted"].as_array().into_iter().flatten() {
            let text_of = |key: &str, unit: &str| quantity(one[key].as_f64(), unit);
            let row =
                vec![name.clone(), metres(&one["s"]), text_of("time", "s"), text_of("energy", "J")];
            all.push((one["time"].as_f64().unwrap_or(0.0), row));
        }
    }
    if all.is_empty() {
        return String::new();
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let more = all.len().saturating_sub(ROWS);
    let rows: Vec<Vec<String>> = all.into_iter().take(ROWS).map(|(_, row)| row).collect();
    let header = ["beam", "at arc length", "at time", "energy released"];
    first_rows("Fractures", &header, &rows, more)
}

/// Impulses that supports and obstacles gave beyond their forces, where impacts or jumps of prescribed velocities asked for any.
fn impulses(summary: &Value) -> String {
    let quantities = [("impulse_1", "N*s"), ("impulse_2", "N*s"), ("impulse_moment", "N*m*s")];
    let empty = Map::new();
    let supports = summary["support"].as_object().unwrap_or(&empty);
    let of = |entry: &Value, key: &str| entry[key].as_f64().unwrap_or(0.0).abs();
    let largest = |keys: &[&str]| {
        let each = supports.values().flat_map(|e| keys.iter().map(move |key| of(e, key)));
        each.fold(0.0, f64::max)
    };
    let most = [largest(&["impulse_1", "impulse_2"]), largest(&["impulse_moment"])];
    let scales = Scales::of(summary);
    let least = [scales.momentum, scales.angular].map(|scale| SMALL_IMPULSE * scale);
    let is_nothing = |entry: &Value, k: usize| {
        let impulse = of(entry, quantities[k].0);
        impulse <= least[k / 2] || is_round_off(impulse, most[k / 2])
    };
    let mut rows = Vec::new();
    for (name, entry) in supports {
        if (0..3).all(|k| is_nothing(entry, k)) {
            continue;
        }
        let text_of = |k: usize| {
            let (key, unit) = quantities[k];
            let value = entry[key].as_f64();
            quantity(if is_nothing(entry, k) { value.map(|_| 0.0) } else { value }, unit)
        };
        rows.push([vec![name.clone()], (0..3).map(text_of).collect()].concat());
    }
    if rows.is_empty() {
        return String::new();
    }
    let more = rows.len().saturating_sub(ROWS);
    rows.truncate(ROWS);
    let caption =
        "Support impulses in impacts (on the structure; not included in the force history)";
    let header = ["support", "impulse x", "impulse y", "angular impulse"];
    first_rows(caption, &header, &rows, more)
}

fn reactions(summary: &Value) -> String {
    let quantities = [("Fx", "force_1", "N"), ("Fy", "force_2", "N"), ("M", "moment", "N*m")];
    let header = ["support", "reaction", "smallest", "at time", "largest", "at time"];
    listing(
        "Reactions (of the supports on the structure)",
        &header,
        &summary["support"],
        &quantities,
        false,
    )
}

fn section_forces(summary: &Value) -> String {
    let quantities = [
        ("axial force", "axial", "N"),
        ("shear force", "shear", "N"),
        ("bending moment", "moment", "N*m"),
        ("fibre stress", "stress", "Pa"),
        ("fibre strain", "strain", "1"),
        ("shear stress", "shear_stress", "Pa"),
        ("von Mises stress", "von_mises_max", "Pa"),
    ];
    let header = [
        "beam",
        "section force",
        "smallest",
        "at arc length",
        "at time",
        "largest",
        "at arc length",
        "at time",
    ];
    let beams = &summary["section_forces"];
    listing("Section forces", &header, beams, &quantities, true) + &without_shear_stress(beams)
}

/// Names beams whose shear stress is not known, although their fibre stress is.
fn without_shear_stress(beams: &Value) -> String {
    let known = |range: &Value| range["max"]["value"].is_number();
    let empty = Map::new();
    let all = beams.as_object().unwrap_or(&empty).iter();
    // Results of earlier versions have none.
    let without = all.filter(|(_, beam)| {
        known(&beam["stress"]) && beam["shear_stress"].is_object() && !known(&beam["shear_stress"])
    });
    let names: Vec<&str> = without.map(|(name, _)| name.as_str()).collect();
    if names.is_empty() {
        return String::new();
    }
    let shown = names[..names.len().min(NAMES)].join(", ");
    let more = match names.len().saturating_sub(NAMES) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let text = format!(
        "Shear stress and von Mises stress not available for {shown}{more}: they need an elastic section with a shape."
    );
    format!("<p class=\"more\">{}</p>\n", escape(&text))
}

/// A row a name and quantity; quantities that a name does not have are left out, and of things without a place those that are zero throughout beside
/// others that are not.
fn listing(
    caption: &str,
    header: &[&str],
    of: &Value,
    quantities: &[(&str, &str, &str)],
    place: bool,
) -> String {
    let empty = Map::new();
    let mut rows = Vec::new();
    for (name, entry) in of.as_object().unwrap_or(&empty) {
        for (label, key, unit) in quantities {
            let range = &entry[key];
            // What a support does not hold.
            let is_zero =
                |key: &str| ["min", "max"].iter().all(|end| entry[key][end]["value"] == 0.0);
            if !place && is_zero(key) && quantities.iter().any(|(_, other, _)| !is_zero(other)) {
                continue;
            }
            // A magnitude has no smallest value.
            let extreme = |end: &str| match (range.get("value"), end) {
                (None, _) => &range[end],
                (Some(_), "max") => range,
                _ => &Value::Null,
            };
            if !["min", "max"].iter().any(|end| extreme(end)["value"].is_number()) {
                continue;
            }
            let mut row = vec![name.clone(), (*label).to_owned()];
            let scale = scale_of(of, key);
            for end in ["min", "max"] {
                let peak = extreme(end);
                let value = peak["value"].as_f64().map(|v| without_round_off(v, scale));
                row.push(quantity(value, unit));
                // What is nothing has no place and no instant.
                let none = value == Some(0.0) && peak["value"] != 0.0
                    || *key == "stress" && value.is_some_and(|v| is_plateau(entry, v));
                let text_of = |text: String| if none { "\u{2013}".to_owned() } else { text };
                row.extend(place.then(|| text_of(metres(&peak["s"]))));
                row.push(text_of(quantity(peak["time"].as_f64(), "s")));
            }
            rows.push(row);
        }
    }
    if rows.is_empty() {
        return String::new();
    }
    let more = rows.len().saturating_sub(ROWS);
    rows.truncate(ROWS);
    first_rows(caption, header, &rows, more)
}

/// Size beside which a value is round-off: the largest force, or moment, or else the largest of its kind.
fn scale_of(of: &Value, key: &str) -> f64 {
    match key {
        "force_1" | "force_2" => magnitude(of, &["force_1", "force_2"]),
        "axial" | "shear" => magnitude(of, &["axial", "shear"]),
        other => magnitude(of, &[other]),
    }
}

/// An arc length without a prefix, so that places compare.
pub(super) fn metres(s: &Value) -> String {
    s.as_f64().map_or("\u{2013}".to_owned(), |s| format!("{}\u{a0}m", number(s)))
}

/// Largest magnitude of the forces of all supports.
pub(super) fn reaction(summary: &Value) -> f64 {
    magnitude(&summary["support"], &["force_1", "force_2"])
}

/// Largest magnitude of the moments of all supports.
pub(super) fn reaction_moment(summary: &Value) -> f64 {
    magnitude(&summary["support"], &["moment"])
}

/// Largest magnitude of section forces in all beams.
pub(super) fn section(summary: &Value, keys: &[&str]) -> f64 {
    magnitude(&summary["section_forces"], keys)
}

fn magnitude(of: &Value, keys: &[&str]) -> f64 {
    let empty = Map::new();
    let mut most = 0.0_f64;
    for entry in of.as_object().unwrap_or(&empty).values() {
        for key in keys {
            for end in ["min", "max"] {
                most = most.max(entry[key][end]["value"].as_f64().unwrap_or(0.0).abs());
            }
        }
    }
    most
}
