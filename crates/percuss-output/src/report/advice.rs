//! Model and result checks, and the results beside closed-form estimates.

use serde_json::Value;

use super::html::{Cell, escape, table, table_of_cells};
use super::quantity::{number, quantity};
use crate::shown::FINDINGS;

/// All checks of the model and the results, with their heading; nothing where there are none.
pub(super) fn checks(summary: &Value) -> String {
    let tables = format!("{}{}{}", warnings(summary), findings(summary), in_vain(summary));
    if tables.is_empty() {
        return String::new();
    }
    format!("<h2 id=\"checks\">Model and result checks</h2>\n{tables}")
}

/// Place of an entry in a list, the weightiest first.
fn weight(entry: &Value) -> usize {
    let order = ["warning", "note", "allowed"];
    order.iter().position(|verdict| entry["verdict"] == *verdict).unwrap_or(order.len())
}

/// Checks of the model before the run and of its results, the weightiest first.
fn findings(summary: &Value) -> String {
    let mut list: Vec<&Value> = summary["advice"].as_array().into_iter().flatten().collect();
    if list.is_empty() {
        return String::new();
    }
    list.sort_by_key(|entry| weight(entry));
    let row = |entry: &Value| -> Vec<Cell> {
        let value = |key: &str| quantity(entry[key].as_f64(), &unit(entry));
        vec![
            Cell::Text(text(entry, "contact")),
            Cell::Text(format!("{} {}", text(entry, "topic"), text(entry, "code"))),
            badge(&text(entry, "verdict")),
            Cell::Text(value("value")),
            Cell::Text(value("reference")),
            Cell::Text(meaning(entry)),
        ]
    };
    let rows: Vec<Vec<Cell>> = list.iter().take(FINDINGS).map(|entry| row(entry)).collect();
    let header = ["subject", "topic", "verdict", "value", "limit", "comment"];
    let table = table_of_cells("Checks", &header, &rows);
    format!("<div class=\"prose\">\n{table}</div>\n{}", more(list.len(), rows.len()))
}

/// Warnings of the finished run.
fn warnings(summary: &Value) -> String {
    let list = summary["warnings"].as_array().map_or(&[][..], Vec::as_slice);
    if list.is_empty() {
        return String::new();
    }
    let row = |entry: &Value| -> Vec<Cell> {
        let about = format!("{} {}", text(entry, "topic"), text(entry, "code"));
        vec![Cell::Text(about), badge(&text(entry, "verdict")), Cell::Text(meaning(entry))]
    };
    let rows: Vec<Vec<Cell>> = list.iter().map(row).collect();
    let header = ["topic", "verdict", "comment"];
    let table = table_of_cells("Warnings of the finished run", &header, &rows);
    format!("<div class=\"prose\">\n{table}</div>\n")
}

fn text(entry: &Value, key: &str) -> String {
    entry[key].as_str().unwrap_or_default().to_owned()
}

fn badge(verdict: &str) -> Cell {
    let class = match verdict {
        "fine" | "allowed" | "not checked" => "verdict",
        _ => "verdict mark",
    };
    Cell::Markup(format!("<span class=\"{class}\">{}</span>", escape(verdict)))
}

/// What was found, and why it is allowed.
fn meaning(entry: &Value) -> String {
    match text(entry, "reason") {
        reason if reason.is_empty() => text(entry, "text"),
        reason => format!("accepted: {reason} ({})", text(entry, "text")),
    }
}

/// Codes that the scenario allows though nothing of them was found.
fn in_vain(summary: &Value) -> String {
    let all = summary["allow"].as_array().map_or(&[][..], Vec::as_slice);
    let missing = all.iter().filter(|one| one["found"] == false);
    let codes: Vec<&str> = missing.filter_map(|one| one["code"].as_str()).collect();
    match codes.is_empty() {
        true => String::new(),
        false => format!(
            "<p class=\"more\">Allowed in the scenario but not raised: {}</p>\n",
            escape(&codes.join(", "))
        ),
    }
}

/// Results beside hand formulas: one table a formula, its assumptions below.
pub(super) fn hand_formulas(summary: &Value) -> String {
    let list = summary["hand_formulas"].as_array().map_or(&[][..], Vec::as_slice);
    if list.is_empty() {
        return String::new();
    }
    let shown = &list[..list.len().min(FINDINGS)];
    let mut out =
        "<h2>Comparison with closed-form estimates</h2>\n<div class=\"tables\">\n".to_owned();
    let same = |a: &Value, b: &Value| {
        ["contact", "formula", "holds_if"].iter().all(|key| a[*key] == b[*key])
    };
    for group in shown.chunk_by(same) {
        out += &formula(group);
    }
    out += "</div>\n";
    out + &more(list.len(), shown.len())
}

fn more(total: usize, shown: usize) -> String {
    match total - shown {
        0 => String::new(),
        left => format!("<p class=\"more\">and {left} more, in summary.json</p>\n"),
    }
}

/// The unit as channels spell it.
fn unit(entry: &Value) -> String {
    entry["unit"].as_str().unwrap_or_default().replace(' ', "*")
}

fn formula(group: &[Value]) -> String {
    let first = &group[0];
    let text = |key: &str| first[key].as_str().unwrap_or_default();
    let row = |entry: &Value| {
        let value = |key: &str| quantity(entry[key].as_f64(), &unit(entry));
        vec![
            entry["quantity"].as_str().unwrap_or_default().to_owned(),
            value("by_hand"),
            value("simulated"),
            match entry["bound"] == true {
                true => of_bound(entry),
                false => percent(entry["difference_percent"].as_f64()),
            },
        ]
    };
    let rows: Vec<Vec<String>> = group.iter().map(row).collect();
    let caption = format!("{}: {}", text("contact"), text("formula"));
    let header = ["quantity", "estimate", "simulation", "difference"];
    let assumption = |text: &str| {
        let class = if text.ends_with("(not met)") { " class=\"unmet\"" } else { "" };
        format!("<li{class}>{}</li>", escape(text))
    };
    let assumptions: String =
        text("holds_if").split("; ").filter(|t| !t.is_empty()).map(assumption).collect();
    format!(
        "<div class=\"formula\">\n{}<p class=\"note\">{}. Assumptions:</p>\n<ul>{assumptions}</ul>\n</div>\n",
        table(&caption, &header, &rows),
        escape(text("source")),
    )
}

/// A result as a share of its upper bound, which is no error of either.
fn of_bound(entry: &Value) -> String {
    let share = entry["simulated"].as_f64().zip(entry["by_hand"].as_f64()).map(|(a, b)| a / b);
    share.map_or("\u{2013}".to_owned(), |share| {
        format!("{}\u{a0}% of it", number((1000.0 * share).round() / 10.0))
    })
}

/// A difference, signed, three significant digits.
fn percent(value: Option<f64>) -> String {
    let Some(value) = value.filter(|v| v.is_finite()) else { return "\u{2013}".to_owned() };
    if value.abs() < 5e-4 {
        return "0\u{a0}%".to_owned();
    }
    let digits = (2.0 - value.abs().log10().floor()).clamp(0.0, 3.0);
    let rounded = (value * 10_f64.powf(digits)).round() / 10_f64.powf(digits);
    let sign = if value > 0.0 { "+" } else { "\u{2212}" };
    format!("{sign}{}\u{a0}%", number(rounded.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_keep_their_sign_and_three_digits() {
        let shown = |x| percent(Some(x)).replace('\u{a0}', " ");
        assert_eq!(shown(31.6539), "+31.7 %");
        assert_eq!(shown(-1.0567), "\u{2212}1.06 %");
        assert_eq!(shown(1e-6), "0 %");
        assert_eq!(shown(0.0123), "+0.012 %");
        assert_eq!(shown(4054.0), "+4054 %");
        assert_eq!(percent(None), "\u{2013}");
    }
}
