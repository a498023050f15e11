//! A profile: least costs over the values of one parameter.

/// The least cost at given values of one parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Name of the parameter.
    pub name: String,
    /// SI unit of the parameter.
    pub unit: String,
    /// Values, increasing, shape (n_point) \[unit of the parameter\].
    pub values: Vec<f64>,
    /// Least costs, NaN where no run succeeds, shape (n_point) \[-\].
    pub costs: Vec<f64>,
    /// Interval in which twice the cost lies less than 3.84 above its minimum: 95 %; NaN at an end that the profile does not reach,
    /// shape (2) \[unit of the parameter\].
    pub interval: [f64; 2],
}

impl Profile {
    /// Its interval in words.
    pub(crate) fn words(&self) -> String {
        let unit = if self.unit == "1" { "" } else { &self.unit };
        let end = |x: f64| if x.is_finite() { format!("{x:.7e}") } else { "?".into() };
        let [low, high] = self.interval.map(end);
        let open = self.interval.iter().any(|end| !end.is_finite());
        let beyond = if open { " (?: beyond the values of the profile)" } else { "" };
        format!("95 %: {low} to {high} {unit}{beyond}")
    }
}
