//! The impact log: impacts, intervals of closed contact and of stops in the order of time, chatter as one row, the first of them on
//! the page.

mod columns;
mod entry;
#[cfg(test)]
mod tests;

use serde_json::{Map, Value, json};

use super::html::{Cell, Row, table_of_rows};
use crate::shown::EVENTS;
use columns::{Column, columns, legend};
use entry::Entry;

/// Touches that follow one another within this share of the run are chatter, if there are so many at least.
const CLOSE: f64 = 1.0 / 250.0;
const CHATTER: usize = 4;

/// The log with its heading; nothing where nothing touched.
pub(super) fn render(summary: &Value) -> String {
    let empty = Map::new();
    let end = summary["time"].as_f64().unwrap_or(0.0);
    let contacts = summary["contact"].as_object().unwrap_or(&empty);
    let stops = summary["support"].as_object().unwrap_or(&empty);
    let stops = stops.iter().filter(|(_, s)| !list(s, "intervals").is_empty());
    let partners: Vec<(&String, &Value)> = contacts.iter().chain(stops).collect();
    let mut total = 0;
    let mut kept = 0;
    let mut log = Vec::new();
    for (name, partner) in &partners {
        let touches = touches(name, partner, end);
        total += happened(partner).max(touches.len());
        kept += touches.len();
        log.extend(grouped(touches, CLOSE * end));
    }
    if log.is_empty() {
        return String::new();
    }
    log.sort_by(|a, b| a.start.total_cmp(&b.start));
    let shown = &log[..log.len().min(EVENTS)];
    let listed: usize = shown.iter().map(|e| e.touches.len().max(1)).sum();
    let columns = columns(shown, partners.len() > 1);
    let mut rows = Vec::new();
    for (k, entry) in shown.iter().enumerate() {
        rows.extend(rows_of(k + 1, entry, &columns));
    }
    let header: Vec<&str> =
        std::iter::once("no.").chain(columns.iter().map(|c| c.header.as_str())).collect();
    let mut out = format!("<h2>Impact log</h2>\n{}{}", legend(shown), sorting(shown.len()));
    out += "<div class=\"log\">\n";
    out += &table_of_rows(&caption(&partners), &header, &rows);
    out += "</div>\n";
    out + &more(total, kept, listed)
}

/// Buttons that put the rows in another order.
fn sorting(rows: usize) -> String {
    if rows < 2 {
        return String::new();
    }
    let button = |key: &str, pressed: bool| {
        format!(
            "<button type=\"button\" data-sort=\"{key}\" aria-pressed=\"{pressed}\">by {key}</button> "
        )
    };
    format!("<p class=\"sorting\">{}{}</p>\n", button("time", true), button("impulse", false))
}

/// The row of an entry, and below it, folded, those of the touches it consists of.
fn rows_of(number: usize, entry: &Entry, columns: &[Column]) -> Vec<Row> {
    let impulse = entry.value["impulse"].as_f64().unwrap_or(0.0).abs();
    let cells = |entry: &Entry, first: Cell, folded: bool| {
        let all = columns.iter().map(|column| column.cell(entry, folded));
        std::iter::once(first).chain(all).collect()
    };
    let attributes = format!("data-time=\"{:e}\" data-impulse=\"{impulse:e}\"", entry.start);
    if entry.touches.is_empty() {
        return vec![Row {
            cells: cells(entry, Cell::Text(number.to_string()), false),
            attributes,
        }];
    }
    let fold = format!(
        "<button type=\"button\" class=\"fold\" aria-expanded=\"false\" aria-label=\"Show the single contacts of row {number}\">{number}</button>"
    );
    let mut rows = vec![Row { cells: cells(entry, Cell::Markup(fold), false), attributes }];
    for (k, touch) in entry.touches.iter().take(EVENTS).enumerate() {
        let attributes = "class=\"touch\" hidden".to_owned();
        rows.push(Row {
            cells: cells(touch, Cell::Text(format!("{number}.{}", k + 1)), true),
            attributes,
        });
    }
    if let Some(left) = entry.touches.len().checked_sub(EVENTS).filter(|left| *left > 0) {
        let text = Cell::Text(format!("and {left} more, in impacts.csv"));
        rows.push(Row { cells: vec![text], attributes: "class=\"touch\" hidden".to_owned() });
    }
    rows
}

/// Touches of one contact in the order of time, those that follow one another closely as one entry.
fn grouped(mut touches: Vec<Entry>, close: f64) -> Vec<Entry> {
    touches.sort_by(|a, b| a.start.total_cmp(&b.start));
    let mut groups: Vec<Vec<Entry>> = Vec::new();
    for touch in touches {
        match groups.last_mut().filter(|g| g.last().is_some_and(|l| touch.start - l.end <= close)) {
            Some(group) => group.push(touch),
            None => groups.push(vec![touch]),
        }
    }
    groups.into_iter().flat_map(|g| if g.len() < CHATTER { g } else { vec![chatter(g)] }).collect()
}

/// Several touches as one: sums of what they passed on, the largest force, the fastest approach.
fn chatter(touches: Vec<Entry>) -> Entry {
    let first = &touches[0];
    let numbers = |key: &'static str| touches.iter().filter_map(move |t| t.value[key].as_f64());
    let sum_of = |path: &str| -> Option<f64> {
        let each: Vec<f64> =
            touches.iter().filter_map(|t| t.value.pointer(path)?.as_f64()).collect();
        (!each.is_empty()).then(|| each.iter().sum())
    };
    let peaks = touches.iter().map(|t| &t.value["peak_force"]);
    let force = |peak: &&Value| peak["value"].as_f64().unwrap_or(f64::NEG_INFINITY);
    let peak =
        peaks.filter(|p| p["value"].is_number()).max_by(|a, b| force(a).total_cmp(&force(b)));
    let open = touches.iter().any(|t| t.value["start"].is_number() && t.value["end"].is_null());
    let end = touches.iter().map(|t| t.end).fold(first.end, f64::max);
    let value = json!({
        "start": first.start,
        "end": if open { None } else { Some(end) },
        "impulse": numbers("impulse").sum::<f64>(),
        "tangential_impulse": sum_of("/tangential_impulse"),
        "peak_force": peak,
        "approach_velocity": numbers("approach_velocity").reduce(f64::max),
        "place": first.value["place"],
        "fallback_law": touches.iter().any(|t| t.value["fallback_law"] == true),
        "energy": {
            "given": [sum_of("/energy/given/0"), sum_of("/energy/given/1")],
            "lost": sum_of("/energy/lost"),
            "stored": touches.last().and_then(|t| t.value["energy"]["stored"].as_f64()),
        },
    });
    let (contact, between, start) = (first.contact.clone(), first.between.clone(), first.start);
    Entry { contact, between, start, end, value, touches }
}

fn list<'a>(contact: &'a Value, key: &str) -> &'a [Value] {
    contact[key].as_array().map_or(&[], Vec::as_slice)
}

/// Impacts and intervals of a contact or a stop; `end` is that of the run.
fn touches(name: &str, partner: &Value, end: f64) -> Vec<Entry> {
    let entry = |value: &Value, key: &str| {
        let start = value[key].as_f64()?;
        let end = match key {
            "time" => start,
            _ => value["end"].as_f64().unwrap_or(end),
        };
        let (contact, between, value) =
            (name.to_owned(), partner["between"].clone(), value.clone());
        Some(Entry { contact, between, start, end, value, touches: Vec::new() })
    };
    let impacts = list(partner, "impacts").iter().filter_map(|v| entry(v, "time"));
    let intervals = list(partner, "intervals").iter().filter_map(|v| entry(v, "start"));
    impacts.chain(intervals).collect()
}

/// Impacts and intervals of a contact, kept in the summary or not.
fn happened(contact: &Value) -> usize {
    let kept = list(contact, "impacts").len();
    let impacts = contact["impact_count"].as_u64().map_or(kept, |n| n as usize);
    impacts + list(contact, "intervals").len()
}

fn caption(partners: &[(&String, &Value)]) -> String {
    match partners {
        [(name, _)] => format!("Contact '{name}'"),
        _ => "All contacts and stops".to_owned(),
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
