//! Faults as they are found.

use crate::model::fault::Fault;

/// Collects faults, shape (faults); each check gives the value found and a valid one.
#[derive(Default)]
pub(super) struct Faults(pub(super) Vec<Fault>);

impl Faults {
    pub(super) fn add(&mut self, path: String, found: impl Into<String>, expected: &str) {
        self.0.push(Fault::new(path, found, expected));
    }

    pub(super) fn positive(&mut self, path: String, value: f64, what: &str, unit: &str) {
        if !(value > 0.0 && value.is_finite()) {
            self.add(path, quantity(value, unit), &format!("{what} above zero"));
        }
    }

    pub(super) fn not_negative(&mut self, path: String, value: f64, what: &str, unit: &str) {
        if !(value >= 0.0 && value.is_finite()) {
            self.add(path, quantity(value, unit), &format!("{what} of zero or above"));
        }
    }

    pub(super) fn finite(&mut self, path: String, values: &[f64], unit: &str) {
        if let Some(bad) = values.iter().find(|v| !v.is_finite()) {
            self.add(path, quantity(*bad, unit), "finite numbers");
        }
    }
}

pub(super) fn quantity(value: f64, unit: &str) -> String {
    if unit.is_empty() { format!("{value}") } else { format!("{value} {unit}") }
}
