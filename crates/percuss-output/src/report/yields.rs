//! Tables of what has yielded: beams with their plastic strain and permanent deflection, plastic hinges, springs and joints.

use serde_json::{Map, Value};

use super::extremes::{first_rows, metres};
use super::html::escape;
use super::quantity::{quantity, without_round_off};
use crate::round_off::HINGE;
use crate::shown::ROWS;

const NONE: &str = "\u{2013}";

/// All tables; nothing where nothing has yielded or failed.
pub(super) fn render(summary: &Value) -> String {
    let (beams, connectors) = (yielded(&summary["plastic"]), yielded(&summary["yielding"]));
    let bent = |(_, entry): &&Named<'_>| entry["first_yield"]["time"].is_number();
    let notes: String = beams.iter().chain(&connectors).filter(bent).filter_map(note).collect();
    [beam_table(&beams), hinge_table(&beams), connector_table(&connectors), notes].concat()
}

/// Something that yielded or failed.
type Named<'s> = (&'s String, &'s Value);

fn yielded(part: &Value) -> Vec<Named<'_>> {
    let entries = part.as_object().into_iter().flat_map(Map::iter);
    // A spring of a given strength alone fails without having yielded.
    let when = |entry: &Value, what: &str| entry[what]["time"].is_number();
    entries.filter(|(_, entry)| when(entry, "first_yield") || when(entry, "failure")).collect()
}

/// The first rows under a caption; nothing where there are none.
fn table(caption: &str, header: &[&str], mut rows: Vec<Vec<String>>) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let more = rows.len().saturating_sub(ROWS);
    rows.truncate(ROWS);
    first_rows(caption, header, &rows, more)
}

fn beam_table(beams: &[Named<'_>]) -> String {
    let row = |(name, beam): &Named<'_>| {
        let set = deflection(beam, &beam["permanent_set_at"]["s"]);
        let mut row = vec![
            (*name).clone(),
            quantity(beam["first_yield"]["time"].as_f64(), "s"),
            metres(&beam["first_yield"]["s"]),
            quantity(beam["strain_max"].as_f64(), "1"),
            metres(&beam["strain_max_at"]["s"]),
        ];
        row.extend(set);
        row.push(quantity(beam["dissipated"].as_f64(), "J"));
        row
    };
    let header = [
        "beam",
        "first yield",
        "at s",
        "largest plastic strain",
        "at s",
        "permanent deflection",
        "components (x, y)",
        "at s",
        "plastic dissipation",
    ];
    table("Yielded beams", &header, beams.iter().map(row).collect())
}

/// Size, components and place of a permanent deflection.
fn deflection(entry: &Value, s: &Value) -> [String; 3] {
    let Some(size) = entry["permanent_set"].as_f64() else {
        return [NONE; 3].map(str::to_owned);
    };
    let component = |k: usize| {
        let value = entry["permanent_set_at"]["displacement"][k].as_f64();
        quantity(value.map(|v| without_round_off(v, size)), "m")
    };
    [quantity(Some(size), "m"), format!("({}, {})", component(0), component(1)), metres(s)]
}

fn hinge_table(beams: &[Named<'_>]) -> String {
    let of_one = |(name, beam): &Named<'_>| -> Vec<Vec<String>> {
        let row = |hinge: &Value| {
            vec![
                (*name).clone(),
                quantity(hinge["rotation"].as_f64(), "rad"),
                metres(&hinge["s"]),
                metres(&hinge["length"]),
                metres(&hinge["element_length"]),
                quantity(hinge["dissipated"].as_f64(), "J"),
            ]
        };
        let reported = |hinge: &&Value| hinge["rotation"].as_f64().is_none_or(|r| r.abs() >= HINGE);
        beam["hinges"].as_array().into_iter().flatten().filter(reported).map(row).collect()
    };
    let header =
        ["beam", "rotation", "centre s", "length", "element length", "plastic dissipation"];
    table("Plastic hinges", &header, beams.iter().flat_map(of_one).collect())
}

fn connector_table(connectors: &[Named<'_>]) -> String {
    let row = |(name, one): &Named<'_>| {
        let turns = one["plastic_rotation_max"].is_object();
        let (what, unit) = if turns { ("rotation", "rad") } else { ("extension", "m") };
        let most = one[format!("plastic_{what}_max")]["value"].as_f64();
        let size = most.map_or(0.0, f64::abs);
        let left = one[format!("plastic_{what}")].as_f64().map(|v| without_round_off(v, size));
        let failed = match one["failure"]["time"].as_f64() {
            Some(time) => quantity(Some(time), "s"),
            None => "intact".to_owned(),
        };
        vec![
            (*name).clone(),
            quantity(one["first_yield"]["time"].as_f64(), "s"),
            quantity(most, unit),
            quantity(left, unit),
            failed,
            quantity(one["dissipated"].as_f64(), "J"),
        ]
    };
    let header = [
        "spring or joint",
        "first yield",
        "largest plastic extension or rotation",
        "final",
        "failed at",
        "plastic dissipation",
    ];
    table(
        "Springs and joints that yielded or failed",
        &header,
        connectors.iter().map(row).collect(),
    )
}

/// Why there is no permanent deflection.
fn note((name, entry): &Named<'_>) -> Option<String> {
    let why = entry["permanent_set_note"].as_str()?;
    let text = format!("Permanent deflection not available for '{name}': {why}");
    Some(format!("<p class=\"more\">{}</p>\n", escape(&text)))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    /// A post with one hinge at its foot, bent by 20 mm along x.
    #[test]
    fn hinges_plastic_strain_and_permanent_deflection_stand_in_tables() {
        let post = json!({
            "strain_max": -0.025, "strain_max_at": { "s": 0.005, "time": 0.1 },
            "first_yield": { "time": 0.002, "s": 0.005 }, "dissipated": 500.0,
            "hinges": [{ "s": 0.04, "length": 0.15, "element_length": 0.05, "rotation": -0.0312, "dissipated": 480.0 }],
            "permanent_set": 0.02, "permanent_set_at": { "s": 1.0, "displacement": [0.02, -1e-14] },
        });
        let elastic = json!({ "first_yield": null, "hinges": [] });
        let loose = json!({ "first_yield": { "time": 0.001, "s": 0.5 }, "permanent_set": null, "permanent_set_note": "nothing holds it" });
        let knee = json!({ "first_yield": { "time": 0.003 }, "plastic_rotation": 0.01, "plastic_rotation_max": { "value": 0.012 }, "failure": { "time": null }, "dissipated": 3.0 });
        let unyielding = |failed: Option<f64>| json!({ "first_yield": { "time": null }, "plastic_extension": 0.0, "plastic_extension_max": { "value": 0.0 }, "failure": { "time": failed }, "dissipated": 0.0 });
        let (rope, slack) = (unyielding(Some(0.039)), unyielding(None));
        let summary = json!({ "plastic": { "post": post, "rail": elastic, "loose": loose }, "yielding": { "joint.knee": knee, "spring.rope": rope, "spring.slack": slack } });
        let page = render(&summary).replace('\u{a0}', " ");
        for text in [
            "<td>2 ms</td><td>0.005 m</td><td>-0.025</td><td>0.005 m</td><td>20 mm</td><td>(20 mm, 0 m)</td><td>1 m</td><td>500 J</td>",
            "<td>-0.0312 rad</td><td>0.04 m</td><td>0.15 m</td><td>0.05 m</td><td>480 J</td>",
            "<td>3 ms</td><td>0.012 rad</td><td>0.01 rad</td><td>intact</td><td>3 J</td>",
            "spring.rope</th><td>\u{2013}</td><td>0 m</td><td>0 m</td><td>39 ms</td><td>0 J</td>",
            "Permanent deflection not available for &#39;loose&#39;: nothing holds it",
        ] {
            assert!(page.contains(text), "no {text} in {page}");
        }
        assert!(
            !page.contains("spring.slack"),
            "what has neither yielded nor failed is not listed"
        );
        assert!(!page.contains("rail"), "what has not yielded is not listed");
        assert!(render(&json!({ "plastic": 3 })).is_empty());
    }
}
