//! The impact log: impacts, intervals of closed contact and of stops in the order of time, chatter as one row, the first of them on
//! the page.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::figure::largest;
use super::html::{Cell, Row, escape, table_of_rows};
use super::quantity::{Scale, fine_number, number, quantity, without_round_off};

/// Rows shown; all of them are in `impacts.csv`.
const LISTED: usize = 40;
/// Parts of the energy below this share are not named beside their bar.
const NAMED: f64 = 5e-3;

/// Touches that follow one another within this share of the run are chatter, if there are so many at least.
const CLOSE: f64 = 1.0 / 250.0;
const CHATTER: usize = 4;

/// An impact, an interval of closed contact, a time in which a stop pressed, or several of them that follow one another.
struct Entry {
    contact: String,
    between: Value,
    start: f64,
    end: f64,
    value: Value,
    /// The touches of chatter; empty for one alone.
    touches: Vec<Entry>,
}

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
    let shown = &log[..log.len().min(LISTED)];
    let told: usize = shown.iter().map(|e| e.touches.len().max(1)).sum();
    let columns = columns(shown, partners.len() > 1);
    let mut rows = Vec::new();
    for (k, entry) in shown.iter().enumerate() {
        rows.extend(rows_of(k + 1, entry, &columns));
    }
    let header: Vec<&str> =
        std::iter::once("").chain(columns.iter().map(|c| c.header.as_str())).collect();
    let mut out = format!("<h2>Impact log</h2>\n{}{}", legend(shown), sorting(shown.len()));
    out += "<div class=\"log\">\n";
    out += &table_of_rows(&caption(&partners), &header, &rows);
    out += "</div>\n";
    out + &more(total, kept, told)
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
        "<button type=\"button\" class=\"fold\" aria-expanded=\"false\" aria-label=\"Show the touches of row {number}\">{number}</button>"
    );
    let mut rows = vec![Row { cells: cells(entry, Cell::Markup(fold), false), attributes }];
    for (k, touch) in entry.touches.iter().take(LISTED).enumerate() {
        let attributes = "class=\"touch\" hidden".to_owned();
        rows.push(Row {
            cells: cells(touch, Cell::Text(format!("{number}.{}", k + 1)), true),
            attributes,
        });
    }
    if let Some(left) = entry.touches.len().checked_sub(LISTED).filter(|left| *left > 0) {
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

fn caption(partners: &[(&String, &Value)]) -> String {
    match partners {
        [(name, _)] => format!("Contact of {name}"),
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

/// A column.
struct Column {
    header: String,
    content: Content,
}

/// What stands in a column.
enum Content {
    /// Numbers on one scale, so that they compare.
    Number {
        value: fn(&Entry) -> Option<f64>,
        factor: f64,
        /// Beside which a number is round-off.
        size: f64,
        /// Whether five digits would not tell the rows apart.
        fine: bool,
    },
    Other(Box<dyn Fn(&Entry) -> Cell>),
}

impl Column {
    fn other(header: &str, cell: impl Fn(&Entry) -> Cell + 'static) -> Self {
        Self { header: header.to_owned(), content: Content::Other(Box::new(cell)) }
    }

    /// Numbers with the unit in the header; nothing where no row has one.
    fn number(
        entries: &[Entry],
        header: &str,
        unit: &str,
        value: fn(&Entry) -> Option<f64>,
    ) -> Option<Self> {
        let values: Vec<f64> = entries.iter().filter_map(value).collect();
        let scale = Scale::new(largest(&values), unit);
        let unit = if scale.unit.is_empty() { String::new() } else { format!(" [{}]", scale.unit) };
        let header = format!("{header}{unit}").replace(' ', "\u{a0}");
        let close =
            |pair: &[f64]| pair[0] != pair[1] && significant(pair[0]) == significant(pair[1]);
        let fine = values.windows(2).any(close);
        let content = Content::Number { value, factor: scale.factor, size: largest(&values), fine };
        (!values.is_empty()).then_some(Self { header, content })
    }

    fn cell(&self, entry: &Entry, folded: bool) -> Cell {
        match &self.content {
            Content::Number { value, factor, size, fine } => {
                // Instants may lie close together, those of chatter do.
                let instants = self.header.starts_with("time") && (*fine || folded);
                let text = if instants { fine_number } else { significant };
                let shown = value(entry).map(|v| text(without_round_off(v, *size) * factor));
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
fn columns(entries: &[Entry], several: bool) -> Vec<Column> {
    let any = |has: &dyn Fn(&Value) -> bool| entries.iter().any(|e| has(&e.value));
    let elsewhere = |v: &Value| v["place"]["s"].is_null() && v["place"]["position"][0].is_number();
    let slides = |v: &Value| v["tangential_impulse"].as_f64().is_some_and(|t| t != 0.0);
    let energies: Vec<f64> =
        entries.iter().flat_map(|e| parts(e).into_iter().map(|(_, v, _)| v)).collect();
    let most = largest(&energies);
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
        any(&|v| v["energy"].is_object())
            .then(|| Column::other("energy passed on", move |e| energy(e, most))),
    ];
    all.into_iter().flatten().collect()
}

fn contact(entry: &Entry) -> Cell {
    Cell::Text(entry.contact.clone())
}

fn lasts(entry: &Entry) -> Cell {
    let (start, end) = (entry.value["start"].as_f64(), entry.value["end"].as_f64());
    if !entry.touches.is_empty() {
        let (count, length) = (entry.touches.len(), brief(entry.end - entry.start, "s"));
        let still = if end.is_none() { ", still closed" } else { "" };
        return Cell::Text(format!("{count}\u{a0}touches in {length}{still}"));
    }
    match (start, end) {
        (None, _) => Cell::Text("instant".to_owned()),
        (Some(_), None) => Cell::Text("still closed".to_owned()),
        (Some(start), Some(end)) => Cell::Text(brief(end - start, "s")),
    }
}

/// The position of what touches on no beam.
fn place(entry: &Entry) -> Cell {
    let place = &entry.value["place"];
    let position = |k: usize| place["position"][k].as_f64().map(significant);
    Cell::Text(match (place["s"].as_f64(), position(0), position(1)) {
        (None, Some(x), Some(y)) => format!("({x},\u{a0}{y})\u{a0}m"),
        _ => "\u{2013}".to_owned(),
    })
}

fn restitution(entry: &Entry) -> Cell {
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
    let mark = if entry.value["fallback_law"] == true { "*" } else { "" };
    Cell::Text(format!("{text}{mark}"))
}

/// Parts of what a contact passed on: label, energy, class of the bar's piece.
fn parts(entry: &Entry) -> Vec<(&str, f64, &'static str)> {
    let energy = &entry.value["energy"];
    let partner = |k: usize| entry.between[k].as_str().unwrap_or("?");
    let all = [
        (partner(0), energy["given"][0].as_f64(), "first"),
        (partner(1), energy["given"][1].as_f64(), "second"),
        ("lost", energy["lost"].as_f64(), "lost"),
        ("stored", energy["stored"].as_f64(), "stored"),
    ];
    let positive = all.into_iter().filter_map(|(label, value, class)| {
        value.filter(|v| *v > 0.0 && v.is_finite()).map(|v| (label, v, class))
    });
    positive.collect()
}

/// A bar of the shares, and the shares worth naming in numbers; beside `most`, the largest of the log, the least are none.
fn energy(entry: &Entry, most: f64) -> Cell {
    let parts = parts(entry);
    let sum: f64 = parts.iter().map(|(_, value, _)| value).sum();
    if !(sum > 0.0 && sum.is_finite()) {
        return Cell::Text("\u{2013}".to_owned());
    }
    if without_round_off(sum, most) == 0.0 {
        return Cell::Text("0\u{a0}J".to_owned());
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
fn legend(entries: &[Entry]) -> String {
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
    if entries.iter().any(|e| e.value["fallback_law"] == true) {
        out.push_str(" *\u{a0}Newton's law would have given energy; Moreau's was used.");
    }
    out + "</p>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run() -> Value {
        let impact = |k: i32| {
            json!({ "time": 0.1 + 1e-4 * f64::from(k), "impulse": 0.5, "approach_velocity": 1.0 / f64::from(1 + k),
                "separation_velocity": 0.1, "restitution": 0.1, "place": {}, "energy": { "lost": 0.25 } })
        };
        let impacts: Vec<Value> = (0..10).chain([5000]).map(impact).collect();
        json!({
            "time": 1.0,
            "contact": { "tap": { "between": ["strip", "floor"], "impacts": impacts, "impact_count": 11, "intervals": [] } },
            "support": { "bracket": { "intervals": [
                { "start": 0.3, "end": 0.31, "impulse": 7.0, "peak_force": { "value": 900.0, "time": 0.305 } }] } },
        })
    }

    #[test]
    fn chatter_is_one_row_with_its_touches_folded_below() {
        let page = render(&run());
        assert!(
            page.contains("10\u{a0}touches in 0.9\u{a0}ms")
                || page.contains("10\u{a0}touches in 900\u{a0}\u{b5}s"),
            "{page}"
        );
        assert_eq!(page.matches("data-time").count(), 3, "{page}");
        assert_eq!(page.matches("class=\"touch\" hidden").count(), 10);
        let row = page.split("<tr ").find(|row| row.contains("10\u{a0}touches")).unwrap();
        assert!(row.contains("data-impulse=\"5e0\""), "{row}");
        assert!(row.contains("2.5\u{a0}J\u{a0}lost"), "{row}");
    }

    #[test]
    fn numbers_have_five_digits_and_round_off_is_nothing() {
        let impact = |time: f64, impulse: f64| json!({ "time": time, "impulse": impulse, "place": {}, "energy": { "lost": impulse } });
        let of = |impacts: [Value; 2]| {
            render(&json!({ "time": 100.0, "contact": { "tap": {
                "between": ["a", "b"], "impacts": impacts, "impact_count": 2, "intervals": [] } } }))
        };
        let page = of([impact(1.2345678, 0.5), impact(9.8765432, 1e-14)]);
        assert!(page.contains("<td>1.2346</td>") && page.contains("<td>9.8765</td>"), "{page}");
        assert!(page.contains("<td>0</td>") && page.contains("<td>0\u{a0}J</td>"), "{page}");
        // Instants that five digits would not tell apart have more.
        let page = of([impact(1.2345678, 0.5), impact(1.2345687, 0.5)]);
        assert!(page.contains("<td>1.234568</td>") && page.contains("<td>1.234569</td>"), "{page}");
    }

    #[test]
    fn stops_are_in_the_log() {
        let page = render(&run());
        let row = page.split("<tr ").find(|row| row.contains("bracket")).unwrap();
        assert!(
            row.contains("900") && row.contains("<td>7</td>") && row.contains("10\u{a0}ms"),
            "{row}"
        );
    }
}
