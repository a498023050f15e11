//! The tables of foundations: place, law, largest reaction, lift-off, plastic deflection.

use percuss::{FoundationKind, StaticFoundation};
use serde_json::{Map, Value};

use super::extremes::{first_rows, metres};
use super::quantity::{quantity, without_round_off};
use crate::shown::ROWS;

const NONE: &str = "\u{2013}";
const REACTION: &str = "largest reaction per length (negative: it pulls)";

/// The table; nothing without foundations.
pub(super) fn render(summary: &Value) -> String {
    let empty = Map::new();
    let all = summary["foundation"].as_object().unwrap_or(&empty);
    if all.is_empty() {
        return String::new();
    }
    let rows: Vec<Vec<String>> = all.iter().take(ROWS).map(row).collect();
    let header = [
        "foundation",
        "beam",
        "from s",
        "to s",
        "law",
        "stiffness per length",
        REACTION,
        "at s",
        "at time",
        "lift-off over",
        "largest final plastic deflection",
    ];
    first_rows("Foundations", &header, &rows, all.len().saturating_sub(ROWS))
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
        one["law"].as_str().map_or(NONE, law).to_owned(),
        quantity(one["stiffness"].as_f64(), "N/m^2"),
        quantity(most["value"].as_f64(), "N/m"),
        metres(&most["s"]),
        quantity(most["time"].as_f64(), "s"),
        quantity(lifted, "m"),
        quantity(one["plastic_deflection"]["value"].as_f64(), "m"),
    ]
}

/// The name of a law as a table says it.
fn law(name: &str) -> &str {
    if name == FoundationKind::Compression.name() { "compression only" } else { name }
}

/// Columns of foundations at rest.
pub(super) const AT_REST: [&str; 11] = [
    "foundation",
    "beam",
    "from s",
    "to s",
    "law",
    "stiffness per length",
    "force (x, y)",
    REACTION,
    "at s",
    "lift-off over",
    "largest plastic deflection",
];

/// Rows of foundations at rest.
pub(super) fn rows_at_rest(found: &[StaticFoundation]) -> Vec<Vec<String>> {
    found.iter().map(row_at_rest).collect()
}

fn row_at_rest(one: &StaticFoundation) -> Vec<String> {
    let of = &one.properties;
    let at = |s: f64| metres(&s.into());
    let size = one.force[0].hypot(one.force[1]);
    let force = one.force.map(|f| quantity(Some(without_round_off(f, size)), "N"));
    let largest = one.largest().filter(|(reaction, _)| *reaction != 0.0);
    let positive = |value: f64| quantity((value != 0.0).then_some(value), "m");
    vec![
        one.name.clone(),
        of.beam.clone(),
        at(of.stretch[0]),
        at(of.stretch[1]),
        law(of.kind.name()).to_owned(),
        quantity(of.stiffness, "N/m^2"),
        format!("({})", force.join(", ")),
        quantity(largest.map(|(reaction, _)| reaction), "N/m"),
        largest.map_or(NONE.to_owned(), |(_, s)| at(s)),
        positive(one.lifted),
        positive(one.plastic),
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
            "<td>compression only</td>",
            "<td>1.25 m</td><td>20 ms</td><td>1.5 m</td><td>4 mm</td>",
            "<td>\u{2013}</td><td>1000 N/m</td><td>0.5 m</td>",
        ] {
            assert!(page.contains(text), "no {text} in {page}");
        }
        assert!(render(&json!({ "foundation": {} })).is_empty());
    }

    #[test]
    fn foundations_at_rest_have_their_force_and_largest_reaction() {
        let bed = StaticFoundation {
            name: "bed".to_owned(),
            properties: percuss::FoundationProperties {
                beam: "rail".to_owned(),
                stretch: [0.0, 6.0],
                kind: FoundationKind::Compression,
                stiffness: Some(3e7),
            },
            force: [1e-12, 51_738.0],
            s: vec![0.5, 2.5],
            pressure: vec![0.0, 31_261.0],
            lifted: 1.5,
            energy: 20.0,
            plastic: 0.0,
        };
        let rows = rows_at_rest(std::slice::from_ref(&bed));
        let row: Vec<String> = rows[0].iter().map(|cell| cell.replace('\u{a0}', " ")).collect();
        assert_eq!(row.len(), AT_REST.len());
        let place = ["bed", "rail", "0 m", "6 m", "compression only", "30 MN/m\u{b2}"];
        assert_eq!(row[..6], place);
        let found = ["(0 N, 51.738 kN)", "31.261 kN/m", "2.5 m", "1.5 m", NONE];
        assert_eq!(row[6..], found);
        let idle = StaticFoundation { pressure: vec![0.0; 2], lifted: 0.0, ..bed };
        assert_eq!(rows_at_rest(&[idle])[0][7..], [NONE; 4]);
    }
}
