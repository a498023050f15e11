//! Quantities, names and lists as sentences take them.

use serde_json::Value;

use crate::report::quantity;

/// Four digits: a sentence is no table.
pub(super) fn quantity(value: Option<f64>, unit: &str) -> String {
    let rounded = value.and_then(|v| format!("{v:.3e}").parse().ok());
    quantity::quantity(rounded, unit)
}

/// An instant: `t = 12 ms`.
pub(super) fn instant(time: Option<f64>) -> String {
    format!("t\u{a0}=\u{a0}{}", quantity(time, "s"))
}

/// A place along a beam: `s = 1.5 m`.
pub(super) fn place(s: Option<f64>) -> String {
    format!("s\u{a0}=\u{a0}{}", quantity(s, "m"))
}

/// A sentence begins with a capital letter.
pub(super) fn capital(sentence: &str) -> String {
    let mut letters = sentence.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

pub(super) fn list<'v>(value: &'v Value, key: &str) -> &'v [Value] {
    value[key].as_array().map_or(&[], Vec::as_slice)
}
