//! Columns of the impact log, and what they say of an entry.

use std::fmt::Write as _;

use serde_json::Value;

use super::entry::{Entry, brief};
use crate::report::figure::largest;
use crate::report::html::{Cell, escape};
use crate::report::quantity::{Scale, fine_number, number, without_round_off};
use crate::round_off::is_round_off;

/// Parts of the energy below this share are not named beside their bar.
const NAMED: f64 = 5e-3;

/// A column.
pub(super) struct Column {
    pub(super) header: String,
    content: Content,
}

/// Content of a column.
enum Content {
    /// Numbers on one scale, so that they compare.
    Number {
        value: fn(&Entry) -> Option<f64>,
        factor: f64,
        /// Beside which a number is round-off.
        size: f64,
        /// Whether neighbouring rows are equal in five digits.
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

    pub(super) fn cell(&self, entry: &Entry, folded: bool) -> Cell {
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
pub(super) fn columns(entries: &[Entry], several: bool) -> Vec<Column> {
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
        numbers("friction impulse", "N*s", |e| e.value["tangential_impulse"].as_f64())
            .filter(|_| any(&slides)),
        numbers("peak force", "N", |e| e.value["peak_force"]["value"].as_f64()),
        numbers("approach", "m/s", |e| e.value["approach_velocity"].as_f64()),
        numbers("separation", "m/s", |e| e.value["separation_velocity"].as_f64()),
        Some(Column::other("restitution", restitution)),
        any(&|v| v["energy"].is_object())
            .then(|| Column::other("energy transferred", move |e| energy(e, most))),
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
        return Cell::Text(format!("{count}\u{a0}contacts in {length}{still}"));
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
    let text = value.map_or("\u{2013}".to_owned(), |e| match is_round_off(e, 1.0) {
        true => "0".to_owned(),
        false => significant(e),
    });
    let mark = if entry.value["fallback_law"] == true { "*" } else { "" };
    Cell::Text(format!("{text}{mark}"))
}

/// Parts of the energy that a contact transferred: label, energy, class of the bar's piece.
fn parts(entry: &Entry) -> Vec<(&str, f64, &'static str)> {
    let energy = &entry.value["energy"];
    let partner = |k: usize| entry.between[k].as_str().unwrap_or("?");
    let all = [
        (partner(0), energy["given"][0].as_f64(), "first"),
        (partner(1), energy["given"][1].as_f64(), "second"),
        ("dissipated", energy["lost"].as_f64(), "lost"),
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
pub(super) fn legend(entries: &[Entry]) -> String {
    let mut out = "<p class=\"note\">Times and normal velocities, resolved within the step; an \
         impact has an impulse and no force. Energy transferred to "
        .to_owned();
    out.push_str(
        "<span class=\"split key\"><i class=\"first\"></i></span>\u{a0}body 1, \
         <span class=\"split key\"><i class=\"second\"></i></span>\u{a0}body 2, \
         <span class=\"split key\"><i class=\"lost\"></i></span>\u{a0}dissipated",
    );
    if entries.iter().any(|e| e.value["energy"]["stored"].as_f64().is_some_and(|v| v > 0.0)) {
        out.push_str(
            ", <span class=\"split key\"><i class=\"stored\"></i></span>\u{a0}stored in the contact",
        );
    }
    out.push('.');
    if entries.iter().any(|e| e.value["fallback_law"] == true) {
        out.push_str(" *\u{a0}Moreau's law used: Newton's law would increase the energy.");
    }
    out + "</p>\n"
}
