//! The results wanted: paths into the summary, and numbers taken from columns of the history.

use serde_json::{Value as Json, json};

use crate::code::FaultCode;
use crate::format::{Format, Inline, List, Maybe, Pair, Text, Written};
use crate::layout::{Described, Inner, TableForm};
use crate::measure::Time;
use crate::node::{Body, Node, Reader};
use crate::quantity::Quantity;
use crate::table::{Braces, Named, is_name};
use crate::write::{self, Writer};

/// A result wanted.
#[derive(Clone, Debug, PartialEq)]
pub enum WantedResult {
    /// A path into summary.json.
    Path(String),
    /// Numbers taken from a column of the history.
    Column(ColumnResult),
}

table! {
    /// Numbers taken from a column of the history, which is linear between its rows.
    pub struct ColumnResult {
        /// Name of the column, such as `contact.mass.force`.
        column: String as Text,
        /// Times at which the value is taken; several give a result for each of them, `NAME[0]`, `NAME[1]`.
        at: Option<Vec<f64>> as Maybe<Times> = None,
        /// Window between two times whose largest value is taken.
        max: Option<[f64; 2]> as Maybe<Pair<Quantity<Time>>> = None,
        /// Window between two times whose smallest value is taken.
        min: Option<[f64; 2]> as Maybe<Pair<Quantity<Time>>> = None,
    }
    either at | max | min
    then settle_column
}

/// Exactly one kind of number.
fn settle_column(own: &mut ColumnResult, body: &Body<'_>, reader: &mut Reader<'_>) {
    let keys = ["at", "max", "min"];
    for pair in [[keys[0], keys[1]], [keys[0], keys[2]], [keys[1], keys[2]]] {
        crate::table::exclude(body, pair, reader);
    }
    if !keys.iter().any(|key| body.get(key).is_some() || reader.excuses(body, key)) {
        let expected = "`at`, such as [\"5 ms\", \"10 ms\"], or a window `max` or `min`";
        reader.missing(body, "at", "no time", expected);
    }
    for (key, window) in [("max", own.max), ("min", own.min)] {
        let (Some([from, to]), Some(node)) = (window, body.get(key)) else { continue };
        if from > to {
            reader.wrong(&node, "a window that ends before it begins", "its start, then its end");
        } else if to < 0.0 {
            reader.wrong(&node, "a window that ends before the run", "times from zero on");
        }
    }
    if let (Some(times), Some(node)) = (&own.at, body.get("at"))
        && let Some((found, expected)) = at_fault(times)
    {
        reader.wrong(&node, found, expected);
    }
}

/// What is wrong with the times of values, and what would be right.
fn at_fault(times: &[f64]) -> Option<(String, &'static str)> {
    if let Some(time) = times.iter().find(|time| **time < 0.0) {
        return Some((format!("the time {time} s before the run"), "times from zero on"));
    }
    let pair = times.windows(2).find(|pair| pair[1] <= pair[0])?;
    let found = format!("the time {} s behind {} s", pair[1], pair[0]);
    Some((found, "times in increasing order"))
}

/// A time, or several.
pub(crate) struct Times;

impl Format for Times {
    type Value = Vec<f64>;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Vec<f64>> {
        match node.elements() {
            None => Quantity::<Time>::read(node, reader).map(|time| vec![time]),
            Some(times) if times.is_empty() => {
                reader.wrong(node, "an empty list", Self::expected());
                None
            }
            Some(_) => List::<Quantity<Time>>::read(node, reader),
        }
    }

    fn placeholder() -> Vec<f64> {
        vec![0.0]
    }

    fn expected() -> String {
        "a time, such as \"5 ms\", or a list of times".into()
    }

    fn schema() -> Json {
        json!({ "anyOf": [Quantity::<Time>::schema(), List::<Quantity<Time>>::schema()] })
    }

    fn described() -> Described {
        Described { expected: Self::expected(), ..Quantity::<Time>::described() }
    }
}

impl Inline for Times {
    const UNIT: &'static str = <Quantity<Time> as Inline>::UNIT;

    fn text(value: &Vec<f64>) -> Option<String> {
        match value.as_slice() {
            [one] => Quantity::<Time>::text(one),
            _ => List::<Quantity<Time>>::text(value),
        }
    }
}

/// Results with names of the user's: `[results]`.
pub(crate) struct WantedResults;

impl WantedResults {
    fn read_one(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<WantedResult> {
        if node.value.is_table() {
            return Braces::<ColumnResult>::read(node, reader).map(WantedResult::Column);
        }
        if let Some(text) = node.value.as_str() {
            return Some(WantedResult::Path(text.to_string()));
        }
        let expected = "a path into summary.json, such as \"contact.mass.peak_force.value\", or a table such as { column = \"contact.mass.force\", at = \"5 ms\" }";
        reader.wrong(node, node.found(), expected);
        None
    }
}

impl Format for WantedResults {
    type Value = Vec<Named<WantedResult>>;

    fn read(node: &Node<'_>, reader: &mut Reader<'_>) -> Option<Self::Value> {
        let Some(body) = Body::of(node) else {
            reader.wrong(node, node.found(), Self::expected());
            return None;
        };
        let mut all = Vec::new();
        for (name, span) in body.keys() {
            let Some(node) = body.get(name) else { continue };
            if !is_name(name) {
                let found = format!("the name {name:?}");
                let expected = "a name of letters, digits, `_` and `-`";
                reader.misplaced_as(FaultCode::InvalidName, &node.path, span, (found, expected));
            }
            match Self::read_one(&node, reader) {
                Some(table) => all.push(Named { name: name.to_string(), table }),
                None => {
                    reader.tainted.insert(node.path.clone());
                }
            }
        }
        Some(all)
    }

    fn placeholder() -> Self::Value {
        Vec::new()
    }

    fn expected() -> String {
        "a table of names of your own, each with a path into summary.json or a column of the history".into()
    }

    fn missing(key: &str) -> (String, String) {
        (format!("no [{key}]"), Self::expected())
    }

    fn schema() -> Json {
        let one = json!({ "anyOf": [{ "type": "string" }, Braces::<ColumnResult>::schema()] });
        json!({ "type": "object", "additionalProperties": one })
    }

    fn described() -> Described {
        let table = Some(Inner::of::<ColumnResult>(TableForm::Braces));
        Described { expected: Self::expected(), table, ..Described::default() }
    }
}

impl Written for WantedResults {
    fn write(value: &Self::Value, key: &str, out: &mut Writer) {
        out.header(key, None);
        for one in value {
            let text = match &one.table {
                WantedResult::Path(path) => Some(write::text(path)),
                WantedResult::Column(column) => Braces::<ColumnResult>::text(column),
            };
            if let Some(text) = text {
                out.line(&write::key(&one.name), &text, "");
            }
        }
    }

    fn default_text(_: &Self::Value) -> Option<String> {
        None
    }
}
