//! What can be adjusted in a fit: numbers of the scenario, and offsets of records.

/// A number that a fit may adjust.
///
/// Optimisers see it as a coordinate of size one: its logarithm, or its quotient by a scale.
#[derive(Clone, Debug, PartialEq)]
pub struct Adjustable {
    /// Its name.
    pub name: String,
    /// SI unit, `1` for a pure number.
    pub unit: String,
    /// Paths in the scenario; none for an offset of a record, shape (paths).
    pub paths: Vec<String>,
    /// Starting value.
    pub start: f64,
    /// Smallest and largest value, infinite where there is none, shape (2) \[unit of the parameter\].
    pub bounds: [f64; 2],
    /// Whether it is varied on a logarithmic scale.
    pub logarithmic: bool,
    /// Whether it keeps its starting value.
    pub fixed: bool,
    /// Mean and standard deviation known from elsewhere, shape (2) \[unit of the parameter\].
    pub prior: Option<[f64; 2]>,
}

impl Adjustable {
    /// Size that its coordinate is measured by.
    fn scale(&self) -> f64 {
        let width = 0.5 * (self.bounds[1] - self.bounds[0]);
        match (self.paths.is_empty() && width.is_finite(), self.start.abs()) {
            // Zero says nothing of the size of an offset.
            (true, _) if width > 0.0 => width,
            (_, size) if size > 0.0 => size,
            _ if width.is_finite() && width > 0.0 => width,
            _ => 1.0,
        }
    }

    /// A value with its unit; a pure number has none.
    pub fn in_words(&self, value: f64) -> String {
        match self.unit.as_str() {
            "1" => format!("{value:.6e}"),
            unit => format!("{value:.6e} {unit}"),
        }
    }

    /// Its coordinate at a value.
    pub fn coordinate(&self, value: f64) -> f64 {
        if self.logarithmic { value.ln() } else { value / self.scale() }
    }

    /// Its value at a coordinate.
    pub fn value(&self, coordinate: f64) -> f64 {
        let value = if self.logarithmic { coordinate.exp() } else { coordinate * self.scale() };
        // Round-off does not lead out of bounds.
        value.clamp(self.bounds[0], self.bounds[1])
    }

    /// Change of its value by that of its coordinate, at a value.
    pub fn rate(&self, value: f64) -> f64 {
        if self.logarithmic { value } else { self.scale() }
    }

    /// Smallest and largest coordinate.
    pub fn coordinates(&self) -> [f64; 2] {
        match (self.logarithmic, self.bounds) {
            (true, [low, high]) => {
                [if low > 0.0 { low.ln() } else { f64::NEG_INFINITY }, high.ln()]
            }
            (false, bounds) => bounds.map(|bound| bound / self.scale()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_lead_back_to_values() {
        let linear = Adjustable {
            name: "k".into(),
            unit: "N/m".into(),
            paths: vec!["p".into()],
            start: 2e5,
            bounds: [1e5, 1e6],
            logarithmic: false,
            fixed: false,
            prior: None,
        };
        let logarithmic = Adjustable { logarithmic: true, ..linear.clone() };
        let open =
            Adjustable { bounds: [f64::NEG_INFINITY, f64::INFINITY], start: 0.0, ..linear.clone() };
        for one in [&linear, &logarithmic, &open] {
            for value in [1e5, 3.3e5, 1e6] {
                let z = one.coordinate(value);
                assert!((one.value(z) / value - 1.0).abs() < 1e-14);
                let h = 1e-6;
                let rate = (one.value(z + h) - one.value(z - h)) / (2.0 * h);
                let inside = value > 1e5 && value < 1e6;
                assert!(!inside || (rate / one.rate(value) - 1.0).abs() < 1e-5, "{rate}");
            }
        }
        assert_eq!(linear.coordinates(), [0.5, 5.0]);
        assert_eq!(open.coordinates(), open.bounds);
        let ratio = Adjustable { unit: "1".into(), ..open.clone() };
        assert_eq!([open.in_words(0.25), ratio.in_words(0.25)], ["2.500000e-1 N/m", "2.500000e-1"]);
    }
}
