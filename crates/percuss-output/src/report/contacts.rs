//! Figures of contacts between things that are not guided, and of discs.

use serde_json::Value;

use super::canvas::{Canvas, names};
use super::draft::{Curve, Draft, Entry, Omit};
use super::figure::{Section, largest};
use super::impact;
use super::quantity::quantity;
use crate::history::HistorySource;
use crate::shown::LARGE_FIGURES;

/// Names of guided projectiles: they do not turn.
pub(super) fn guided(history: &HistorySource) -> Vec<String> {
    let turns = |name: &String| history.position(&format!("projectile.{name}.angle")).is_some();
    let mut all = names(history, "projectile.", ".position_1");
    all.retain(|name| !turns(name));
    all
}

/// Names of contacts that are not those of guided projectiles.
fn pairs(history: &HistorySource) -> Vec<String> {
    let guided = guided(history);
    let mut all = names(history, "contact.", ".gap");
    all.retain(|name| !guided.contains(name));
    all
}

/// Values on the page per bin that [`discs`] and [`between`] may need.
pub(super) fn values_per_bin(history: &HistorySource) -> usize {
    let discs = names(history, "projectile.", ".angle").len().min(LARGE_FIGURES);
    // Two figures of two curves and one of one; three of one.
    70 * discs + 40 * pairs(history).len().min(LARGE_FIGURES)
}

/// Position, velocity and spin of discs.
pub(super) fn discs(canvas: &Canvas<'_>) -> Vec<Entry> {
    let mut all = Vec::new();
    for name in names(canvas.history, "projectile.", ".angle").iter().take(LARGE_FIGURES) {
        let both = |what: &str| -> Vec<Curve> {
            let curve = |i: usize| {
                let channel = format!("projectile.{name}.{what}_{i}");
                Some(Curve::new(
                    format!("along {}", ["x", "y"][i - 1]),
                    i,
                    canvas.history.position(&channel)?,
                ))
            };
            (1..=2).filter_map(curve).collect()
        };
        let spin = canvas.history.position(&format!("projectile.{name}.spin"));
        let spin = spin.map(|channel| Curve::new("angular velocity", 4, channel));
        let figures = [
            ("position", "Position", "position", "m", both("position")),
            ("velocity", "Velocity", "velocity", "m/s", both("velocity")),
            ("spin", "Angular velocity", "angular velocity", "rad/s", spin.into_iter().collect()),
        ];
        for (id, title, label, unit, curves) in figures {
            let (id, title) = (format!("{id}-{name}"), format!("{title} of {name}"));
            let mut draft = canvas.over_time((&id, &title, label), Section::Impact, unit, curves);
            draft.figure.picture = true;
            draft.omit = if unit == "rad/s" { Omit::Zeros } else { Omit::Nothing };
            draft.apart = true;
            all.push(Entry::Draft(draft));
        }
    }
    all
}

/// Gap, force or impulses, and place of contacts between two things.
pub(super) fn between(canvas: &Canvas<'_>, summary: &Value) -> Vec<Entry> {
    let mut all = Vec::new();
    let found = pairs(canvas.history);
    for name in found.iter().take(LARGE_FIGURES) {
        let contact = &summary["contact"][name];
        all.extend(curve(canvas, name, GAP, contact));
        all.extend(curve(canvas, name, FORCE, contact));
        let some = |key: &str| contact[key].as_array().is_some_and(|list| !list.is_empty());
        if contact["impacts"].is_array() && (some("impacts") || some("intervals")) {
            let figure = impact::impulses(canvas, &format!("impulse-{name}"), name, contact);
            all.push(Entry::Ready(figure));
        }
        all.extend(place(canvas, name));
    }
    if let Some(Entry::Draft(first)) = all.first_mut().filter(|_| found.len() > LARGE_FIGURES) {
        first.figure.note += &format!(" First {LARGE_FIGURES} of {} contacts shown.", found.len());
    }
    all
}

/// A quantity of a contact: channel, title, label, unit, style.
type Quantity = (&'static str, &'static str, &'static str, &'static str, usize);

const GAP: Quantity = ("gap", "Gap", "gap", "m", 5);
const FORCE: Quantity = ("force", "Contact force", "contact force", "N", 2);
const PLACE: Quantity = ("place", "Contact location", "arc length", "m", 6);
/// The place is drawn where the gap is below this share of its largest value.
const NEAR: f64 = 0.05;

fn curve(canvas: &Canvas<'_>, name: &str, what: Quantity, contact: &Value) -> Option<Entry> {
    let (channel, title, label, unit, style) = what;
    let position = canvas.history.position(&format!("contact.{name}.{channel}"))?;
    let (id, title) = (format!("{channel}-{name}"), format!("{title}, {name}"));
    let curves = vec![Curve::new(label, style, position)];
    let mut draft = canvas.over_time((&id, &title, label), Section::Impact, unit, curves);
    draft.figure.picture = true;
    draft.omit = Omit::Nothing;
    let partner = |k: usize| contact["between"][k].as_str();
    if let (GAP, Some(first), Some(second)) = (what, partner(0), partner(1)) {
        draft.figure.note = format!("Between '{first}' and '{second}', at their closest points.");
    }
    Some(Entry::Draft(Draft { floor: 0.0, ..draft }))
}

/// Where the two are nearest, drawn where they are near: far apart the nearest places jump about.
fn place(canvas: &Canvas<'_>, name: &str) -> Option<Entry> {
    let gap = canvas.history.position(&format!("contact.{name}.gap"))?;
    let near = NEAR * largest(&canvas.sample[gap]);
    let Entry::Draft(mut draft) = curve(canvas, name, PLACE, &Value::Null)? else { return None };
    draft.curves.iter_mut().for_each(|curve| curve.where_below = Some((gap, near)));
    let within = quantity((near > 0.0).then_some(near), "m");
    draft.figure.note = format!("Closest point, shown where the gap is below {within}.");
    Some(Entry::Draft(draft))
}
