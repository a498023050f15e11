//! Headers of CSV files: what each column holds, and in which unit.

use crate::measure::{self, Measure};
use crate::units::{self, Dimension};

/// What a column holds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Column {
    /// Headers that say so without a unit: its values are in SI, shape (names).
    pub names: &'static [&'static str],
    /// What it measures.
    pub dimension: Dimension,
    /// What it may hold instead, if its header says so.
    pub other: Option<&'static Column>,
}

/// An acceleration, as of an accelerogram; `g` is standard gravity there, not the gram.
pub(crate) const ACCELERATION: Column =
    Column::of::<measure::Acceleration>(&["acceleration", "accelerations", "acc", "a"]);

/// Units of two columns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Units<'h> {
    /// The unit of each column, none where values are in SI, shape (2).
    pub of: [Option<&'h str>; 2],
    /// Whether the second column holds its other quantity.
    pub other: bool,
}

impl Column {
    /// A column of a measure.
    pub const fn of<M: Measure>(names: &'static [&'static str]) -> Self {
        Self { names, dimension: M::DIMENSION, other: None }
    }

    /// The same column, which may hold another quantity where its header says so.
    pub const fn or(self, other: &'static Column) -> Self {
        Self { other: Some(other), ..self }
    }

    /// The headers that need no unit, in a list.
    pub fn known(&self) -> String {
        let other = self.other.map_or(&[][..], |other| other.names);
        let names = self.names.iter().chain(other).map(|name| format!("`{name}`"));
        names.collect::<Vec<_>>().join(", ")
    }

    /// The unit that a header gives, none where it gives none but the name of the column.
    ///
    /// # Errors
    /// What was found, where it is another quantity or not known as one.
    fn unit<'h>(&self, header: &'h str) -> Result<Option<&'h str>, String> {
        let (name, unit) = parts(header);
        let known = self.names.contains(&name.to_lowercase().as_str());
        let unit = match unit {
            Some("" | "-" | "1") if self.dimension == Dimension::default() => return Ok(None),
            Some(unit) => unit,
            None if known => return Ok(None),
            None => name,
        };
        if unit == "g" && self.dimension == measure::Acceleration::DIMENSION {
            return Ok(Some("kgf/kg"));
        }
        match units::parse(&format!("1 {unit}")) {
            Ok(one) if one.dimension == self.dimension => Ok(Some(unit)),
            Ok(one) => {
                Err(format!("a header in {unit:?}, which is {},", measure::name(one.dimension)))
            }
            Err(_) => Err("a header without a unit that is known".to_owned()),
        }
    }
}

/// Name and unit of a header: `time [ms]`, `time (ms)`, `time / ms`, `time in ms`, `time_ms`.
pub(crate) fn parts(header: &str) -> (&str, Option<&str>) {
    let header = header.trim();
    for [open, close] in [["[", "]"], ["(", ")"]] {
        if let Some((name, rest)) = header.split_once(open)
            && let Some(unit) = rest.trim_end().strip_suffix(close)
        {
            return (name.trim(), Some(unit.trim()));
        }
    }
    for between in [" / ", " in ", ", ", "_"] {
        if let Some((name, unit)) = header.rsplit_once(between)
            && units::parse(&format!("1 {unit}")).is_ok()
        {
            return (name.trim(), Some(unit.trim()));
        }
    }
    (header, None)
}

/// Units of both columns.
///
/// # Errors
/// What was found in the header.
pub(crate) fn units<'h>(cells: [&'h str; 2], columns: &[Column; 2]) -> Result<Units<'h>, String> {
    let first = columns[0].unit(cells[0])?;
    let (second, other) = match (columns[1].unit(cells[1]), columns[1].other) {
        (Err(found), Some(other)) => (other.unit(cells[1]).map_err(|_| found)?, true),
        (own, _) => (own?, false),
    };
    Ok(Units { of: [first, second], other })
}

/// Whether one of two cells is a header of its column, or has a unit, though not both are headers.
pub(crate) fn is_half(cells: [&str; 2], columns: &[Column; 2]) -> bool {
    let known = |k: usize| {
        let own = &columns[k];
        own.unit(cells[k]).is_ok() || own.other.is_some_and(|other| other.unit(cells[k]).is_ok())
    };
    known(0) || known(1)
}

/// A number of a column in SI; `unit` is that of its header.
pub(crate) fn value(cell: &str, unit: Option<&str>) -> Option<f64> {
    let plain: f64 = cell.parse().ok().filter(|v: &f64| v.is_finite())?;
    match unit {
        None => Some(plain),
        Some(unit) => units::parse(&format!("{cell} {unit}")).ok().map(|found| found.value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TIME: Column = Column::of::<measure::Time>(&["t", "time"]);
    const FACTOR: Column = Column::of::<measure::Ratio>(&["value", "factor"]);

    #[test]
    fn units_of_headers_are_read_however_they_stand() {
        for header in ["time [ms]", "time (ms)", "Time / ms", "time in ms", "t_ms", "ms", "[ms]"] {
            let found = units([header, "factor"], &[TIME, FACTOR]);
            assert_eq!(found, Ok(Units { of: [Some("ms"), None], other: false }), "{header}");
        }
        for header in ["t", "Time"] {
            assert_eq!(
                units([header, "value (-)"], &[TIME, FACTOR]),
                Ok(Units::default()),
                "{header}"
            );
        }
        let either = [TIME, FACTOR.or(&ACCELERATION)];
        for (header, unit) in [
            ("acceleration (m/s^2)", Some("m/s^2")),
            ("acceleration (g)", Some("kgf/kg")),
            ("Acceleration", None),
        ] {
            let found = units(["t", header], &either);
            assert_eq!(found, Ok(Units { of: [None, unit], other: true }), "{header}");
        }
        assert_eq!(units(["t", "factor"], &either), Ok(Units::default()));
        assert_eq!(value("0.5", Some("kgf/kg")), Some(0.5 * 9.80665));
        // To the very bits of a value with its unit in a scenario.
        assert_eq!(value("20", Some("ms")), Some(0.02));
    }

    #[test]
    fn a_header_of_something_else_is_refused() {
        for header in ["m", "time (mm)", "frames", ""] {
            assert!(units([header, "factor"], &[TIME, FACTOR]).is_err(), "{header}");
        }
        let reported = units(["ms", "g"], &[TIME, FACTOR]).unwrap_err();
        assert!(reported.contains("\"g\", which is a mass"), "{reported}");
    }
}
