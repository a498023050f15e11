//! The table of foundations: place, law, largest reaction, lift-off, plastic deflection.

use serde_json::{Map, Value};

use super::extremes::{first_rows, metres};
use super::quantity::quantity;

/// Rows shown of the table.
const LISTED: usize = 200;
const NONE: &str = "\u{2013}";

/// The table; nothing without foundations.
pub(super) fn render(summary: &Value) -> String {
    let empty = Map::new();
    let all = summary["foundation"].as_object().unwrap_or(&empty);
    if all.is_empty() {
        return String::new();
    }
    let rows: Vec<Vec<String>> = all.iter().take(LISTED).map(row).collect();
    let header = [
        "foundation",
        "beam",
        "from s",
        "to s",
        "law",
        "stiffness per length",
        "largest reaction per length",
        "at s",
        "at time",
        "lift-off over",
        "largest final plastic deflection",
    ];
    first_rows("Foundations", &header, &rows, all.len().saturating_sub(LISTED))
}

fn row((name, one): (&String, &Value)) -> Vec<String> {
    let text = |value: &Value| value.as_str().unwrap_or(NONE).to_owned();
    let (most, lifted) = (&one["pressure_max"], &one["lifted_max"]["value"]);
    let lifted = lifted.as_f64().filter(|lifted| *lifted > 0.0);
    vec![
        name.clone(),
        text(&one["beam"]),
        metres(&one["stretch"][0]),
        metres(&one["stretch"][1]),
        text(&one["law"]),
        quantity(one["stiffness"].as_f64(), "N/m^2"),
        quantity(most["value"].as_f64(), "N/m"),
        metres(&most["s"]),
        quantity(most["time"].as_f64(), "s"),
        quantity(lifted, "m"),
        quantity(one["plastic_deflection"]["value"].as_f64(), "m"),
    ]
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn foundations_stand_in_a_table_with_their_laws_and_reactions() {
        let bed = json!({
            "beam": "rail", "stretch": [0.0, 6.0], "law": "linear", "stiffness": 5e6,
            "pressure_max": { "value": 30e3, "s": 2.5, "time": 5e-3 },
            "lifted_max": { "value": 0.0, "time": 0.0 }, "plastic_deflection": null,
        });
        let pile = json!({
            "beam": "pile", "stretch": [1.0, 4.0], "law": "compression", "stiffness": 2e7,
            "pressure_max": { "value": 40e3, "s": 1.25, "time": 0.02 },
            "lifted_max": { "value": 1.5, "time": 0.0 }, "plastic_deflection": { "value": 4e-3 },
        });
        let earlier = json!({ "pressure_max": { "value": 1e3, "s": 0.5, "time": 0.1 } });
        let all = json!({ "foundation": { "bed": bed, "pile": pile, "old": earlier } });
        let page = render(&all).replace('\u{a0}', " ");
        for text in [
            "<td>rail</td><td>0 m</td><td>6 m</td><td>linear</td>",
            "<td>5 MN/m\u{b2}</td><td>30 kN/m</td><td>2.5 m</td><td>5 ms</td><td>\u{2013}</td><td>\u{2013}</td>",
            "<td>compression</td>",
            "<td>1.25 m</td><td>20 ms</td><td>1.5 m</td><td>4 mm</td>",
            "<td>\u{2013}</td><td>1 kN/m</td><td>0.5 m</td>",
        ] {
            assert!(page.contains(text), "no {text} in {page}");
        }
        assert!(render(&json!({ "foundation": {} })).is_empty());
    }
}
