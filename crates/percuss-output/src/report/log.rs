//! The impact log: impacts and intervals of closed contact in the order of time, the first of them on the page.

use std::fmt::Write as _;

use serde_json::{Map, Value};

use super::figure::largest;
use super::html::{Cell, escape, table_of_cells};
use super::quantity::{Scale, number, quantity};

/// Rows shown; all of them are in `impacts.csv`.
const LISTED: usize = 40;
/// Parts of the energy below this share are not named beside their bar.
const NAMED: f64 = 5e-3;

/// An impact or an interval.
struct Entry<'a> {
    contact: &'a str,
    between: &'a Value,
    start: f64,
    value: &'a Value,
}

/// The log with its heading; nothing where nothing touched.
pub(super) fn render(summary: &Value) -> String {
    let empty = Map::new();
    let contacts = summary["contact"].as_object().unwrap_or(&empty);
    let mut entries: Vec<Entry<'_>> = contacts.iter().flat_map(|(k, v)| entries(k, v)).collect();
    if entries.is_empty() {
        return String::new();
    }
    entries.sort_by(|a, b| a.start.total_cmp(&b.start));
    let total = contacts.values().map(happened).sum::<usize>().max(entries.len());
    let kept = entries.len();
    entries.truncate(LISTED);
    let columns = columns(&entries, contacts.len() > 1);
    let row = |(k, entry): (usize, &Entry<'_>)| {
        let cells = columns.iter().map(|column| column.cell(entry));
        std::iter::once(Cell::Text((k + 1).to_string())).chain(cells).collect()
    };
    let rows: Vec<Vec<Cell>> = entries.iter().enumerate().map(row).collect();
    let header: Vec<&str> =
        std::iter::once("").chain(columns.iter().map(|c| c.header.as_str())).collect();
    let mut out = format!("<h2>Impact log</h2>\n{}", legend(&entries));
    out += "<div class=\"log\">\n";
    out += &table_of_cells(&caption(contacts), &header, &rows);
    out += "</div>\n";
    out + &more(total, kept, rows.len())
}

fn list<'a>(contact: &'a Value, key: &str) -> &'a [Value] {
    contact[key].as_array().map_or(&[], Vec::as_slice)
}

fn entries<'a>(name: &'a str, contact: &'a Value) -> Vec<Entry<'a>> {
    let entry = |value: &'a Value, key: &str| {
        let start = value[key].as_f64()?;
        Some(Entry { contact: name, between: &contact["between"], start, value })
    };
    let impacts = list(contact, "impacts").iter().filter_map(|v| entry(v, "time"));
    let intervals = list(contact, "intervals").iter().filter_map(|v| entry(v, "start"));
    impacts.chain(intervals).collect()
}

/// A value with its unit, three significant digits.
fn brief(value: f64, unit: &str) -> String {
    let power = 10_f64.powf(2.0 - value.abs().log10().floor());
    let rounded = (value * power).round() / power;
    quantity(Some(if rounded.is_finite() { rounded } else { value }), unit)
}

/// Impacts and intervals of a contact, kept in the summary or not.
fn happened(contact: &Value) -> usize {
    let kept = list(contact, "impacts").len();
    let impacts = contact["impact_count"].as_u64().map_or(kept, |n| n as usize);
    impacts + list(contact, "intervals").len()
}

fn caption(contacts: &Map<String, Value>) -> String {
    let mut names = contacts.iter();
    match (names.next(), names.next()) {
        (Some((name, _)), None) => format!("Contact of {name}"),
        _ => "All contacts, in the order of time".to_owned(),
    }
}

/// Says how many rows are not shown and where they are.
fn more(total: usize, kept: usize, shown: usize) -> String {
    if total <= shown {
        return String::new();
    }
    let left = total - shown;
    let where_ = if kept < total {
        let kept = kept - shown;
        format!("and {left} more, the first {kept} of them in impacts.csv")
    } else {
        format!("and {left} more, in impacts.csv")
    };
    format!("<p class=\"more\">{where_}</p>\n")
}

/// A column.
struct Column {
    header: String,
    content: Content,
}

/// What stands in a column.
enum Content {
    /// Numbers on one scale, so that they compare.
    Number {
        value: fn(&Entry<'_>) -> Option<f64>,
        factor: f64,
    },
    Other(fn(&Entry<'_>) -> Cell),
}

impl Column {
    fn other(header: &str, cell: fn(&Entry<'_>) -> Cell) -> Self {
        Self { header: header.to_owned(), content: Content::Other(cell) }
    }

    /// Numbers with the unit in the header; nothing where no row has one.
    fn number(
        entries: &[Entry<'_>],
        header: &str,
        unit: &str,
        value: fn(&Entry<'_>) -> Option<f64>,
    ) -> Option<Self> {
        let values: Vec<f64> = entries.iter().filter_map(value).collect();
        let scale = Scale::new(largest(&values), unit);
        let unit = if scale.unit.is_empty() { String::new() } else { format!(" [{}]", scale.unit) };
        let header = format!("{header}{unit}").replace(' ', "\u{a0}");
        let content = Content::Number { value, factor: scale.factor };
        (!values.is_empty()).then_some(Self { header, content })
    }

    fn cell(&self, entry: &Entry<'_>) -> Cell {
        match &self.content {
            Content::Number { value, factor } => {
                // Instants may lie close together.
                let text = if self.header.starts_with("time") { number } else { significant };
                let shown = value(entry).map(|v| text(v * factor));
                Cell::Text(shown.unwrap_or("\u{2013}".to_owned()))
            }
            Content::Other(cell) => cell(entry),
        }
    }
}

/// Five significant digits.
fn significant(value: f64) -> String {
    let power = 10_f64.powf(4.0 - value.abs().log10().floor());
    let rounded = (value * power).round() / power;
    number(if rounded.is_finite() { rounded } else { value })
}

/// The columns that have something to say.
fn columns(entries: &[Entry<'_>], several: bool) -> Vec<Column> {
    let any = |has: &dyn Fn(&Value) -> bool| entries.iter().any(|e| has(e.value));
    let elsewhere = |v: &Value| v["place"]["s"].is_null() && v["place"]["position"][0].is_number();
    let slides = |v: &Value| v["tangential_impulse"].as_f64().is_some_and(|t| t != 0.0);
    let numbers = |header: &str, unit: &str, value| Column::number(entries, header, unit, value);
    let all = [
        several.then(|| Column::other("contact", contact)),
        numbers("time", "s", |e| Some(e.start)),
        any(&|v| v["start"].is_number()).then(|| Column::other("lasts", lasts)),
        numbers("arc length", "m", |e| e.value["place"]["s"].as_f64()),
        any(&elsewhere).then(|| Column::other("place", place)),
        numbers("impulse", "N*s", |e| e.value["impulse"].as_f64()),
        numbers("of friction", "N*s", |e| e.value["tangential_impulse"].as_f64())
            .filter(|_| any(&slides)),
        numbers("peak force", "N", |e| e.value["peak_force"]["value"].as_f64()),
        numbers("approach", "m/s", |e| e.value["approach_velocity"].as_f64()),
        numbers("separation", "m/s", |e| e.value["separation_velocity"].as_f64()),
        Some(Column::other("restitution", restitution)),
        any(&|v| v["energy"].is_object()).then(|| Column::other("energy passed on", energy)),
    ];
    all.into_iter().flatten().collect()
}

fn contact(entry: &Entry<'_>) -> Cell {
    Cell::Text(entry.contact.to_owned())
}

fn lasts(entry: &Entry<'_>) -> Cell {
    let (start, end) = (entry.value["start"].as_f64(), entry.value["end"].as_f64());
    match (start, end) {
        (None, _) => Cell::Text("instant".to_owned()),
        (Some(_), None) => Cell::Text("still closed".to_owned()),
        (Some(start), Some(end)) => Cell::Text(brief(end - start, "s")),
    }
}

/// The position of what touches on no beam.
fn place(entry: &Entry<'_>) -> Cell {
    let place = &entry.value["place"];
    let position = |k: usize| place["position"][k].as_f64().map(significant);
    Cell::Text(match (place["s"].as_f64(), position(0), position(1)) {
        (None, Some(x), Some(y)) => format!("({x},\u{a0}{y})\u{a0}m"),
        _ => "\u{2013}".to_owned(),
    })
}

fn restitution(entry: &Entry<'_>) -> Cell {
    let value = entry.value["restitution"].as_f64();
    let why = entry.value["restitution_why"].as_str();
    if let Some(why) = why.filter(|why| why.starts_with("not resolved")) {
        return Cell::Text(why.to_owned());
    }
    // The round-off of a plastic impact is nothing worth reading.
    let text = value.map_or("\u{2013}".to_owned(), |e| match e.abs() < 1e-11 {
        true => "0".to_owned(),
        false => significant(e),
    });
    let mark = if entry.value["tamed"] == true { "*" } else { "" };
    Cell::Text(format!("{text}{mark}"))
}

/// Parts of what a contact passed on: label, energy, class of the bar's piece.
fn parts<'a>(entry: &'a Entry<'_>) -> Vec<(&'a str, f64, &'static str)> {
    let energy = &entry.value["energy"];
    let party = |k: usize| entry.between[k].as_str().unwrap_or("?");
    let all = [
        (party(0), energy["given"][0].as_f64(), "first"),
        (party(1), energy["given"][1].as_f64(), "second"),
        ("lost", energy["lost"].as_f64(), "lost"),
        ("stored", energy["stored"].as_f64(), "stored"),
    ];
    let positive = all.into_iter().filter_map(|(label, value, class)| {
        value.filter(|v| *v > 0.0 && v.is_finite()).map(|v| (label, v, class))
    });
    positive.collect()
}

/// A bar of the shares, and the shares worth naming in numbers.
fn energy(entry: &Entry<'_>) -> Cell {
    let parts = parts(entry);
    let sum: f64 = parts.iter().map(|(_, value, _)| value).sum();
    if !(sum > 0.0 && sum.is_finite()) {
        return Cell::Text("\u{2013}".to_owned());
    }
    let mut pieces = String::new();
    let mut named = Vec::new();
    for (label, value, class) in parts {
        let share = value / sum;
        let _ = write!(pieces, "<i class=\"{class}\" style=\"width:{:.2}%\"></i>", 100.0 * share);
        if share >= NAMED {
            named.push(format!("{}\u{a0}{label}", brief(value, "J")));
        }
    }
    let words = escape(&named.join(", "));
    Cell::Markup(format!(
        "<span class=\"split\" role=\"img\" aria-label=\"{words}\">{pieces}</span> {words}"
    ))
}

/// What the colours and marks mean.
fn legend(entries: &[Entry<'_>]) -> String {
    let mut out = "<p class=\"note\">Times and velocities along the normal, resolved within the step; an \
         impact has an impulse and no force. Energy passed on: what the contact took from one of the two and gave to "
        .to_owned();
    out.push_str(
        "<span class=\"split key\"><i class=\"first\"></i></span>\u{a0}the first, \
         <span class=\"split key\"><i class=\"second\"></i></span>\u{a0}the second, or \
         <span class=\"split key\"><i class=\"lost\"></i></span>\u{a0}lost",
    );
    if entries.iter().any(|e| e.value["energy"]["stored"].as_f64().is_some_and(|v| v > 0.0)) {
        out.push_str(
            ", and <span class=\"split key\"><i class=\"stored\"></i></span>\u{a0}what its spring still holds",
        );
    }
    out.push('.');
    if entries.iter().any(|e| e.value["tamed"] == true) {
        out.push_str(" *\u{a0}Newton's law would have given energy; Moreau's was used.");
    }
    out + "</p>\n"
}
