//! A row of the log.

use serde_json::Value;

use crate::report::quantity::quantity;

/// An impact, an interval of closed contact, a time in which a stop pressed, or several of them that follow one another.
pub(super) struct Entry {
    pub(super) contact: String,
    pub(super) between: Value,
    pub(super) start: f64,
    pub(super) end: f64,
    pub(super) value: Value,
    /// The touches of chatter; empty for one alone, shape (touches).
    pub(super) touches: Vec<Entry>,
}

/// A value with its unit, three significant digits.
pub(super) fn brief(value: f64, unit: &str) -> String {
    let power = 10_f64.powf(2.0 - value.abs().log10().floor());
    let rounded = (value * power).round() / power;
    quantity(Some(if rounded.is_finite() { rounded } else { value }), unit)
}
