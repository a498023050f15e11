//! Quantities and lists as sentences take them.

use serde_json::Value;

use crate::report::quantity;

/// Four digits: a sentence is no table.
pub(super) fn quantity(value: Option<f64>, unit: &str) -> String {
    let rounded = value.and_then(|v| format!("{v:.3e}").parse().ok());
    quantity::quantity(rounded, unit)
}

pub(super) fn list<'v>(value: &'v Value, key: &str) -> &'v [Value] {
    value[key].as_array().map_or(&[], Vec::as_slice)
}
