//! A profile: least costs over the values of one parameter.

use crate::doubts::SAME;

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
    /// What the profile says against a minimum of some cost: one of lower cost that it leads to.
    pub fn lower_minimum(&self, cost: f64) -> Option<String> {
        let both = self.values.iter().zip(&self.costs).filter(|(_, cost)| cost.is_finite());
        let (value, least) = both.min_by(|a, b| a.1.total_cmp(b.1))?;
        let unit = if self.unit == "1" { String::new() } else { format!(" {}", self.unit) };
        (*least < cost * (1.0 - SAME) - SAME).then(|| {
            format!(
                "the profile of `{}` has the cost {least:.5} at {value:.6e}{unit}, below that of the minimum found ({cost:.5}): start there, or from \
                 more starting points",
                self.name
            )
        })
    }

    /// Its interval in words.
    pub(crate) fn words(&self) -> String {
        let unit = if self.unit == "1" { "" } else { &self.unit };
        let end = |x: f64| if x.is_finite() { format!("{x:.7e}") } else { "?".into() };
        let [low, high] = self.interval.map(end);
        let open = self.interval.iter().any(|end| !end.is_finite());
        let beyond = if open { " (?: beyond three standard errors or a bound)" } else { "" };
        format!("95 %: {low} to {high} {unit}{beyond}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_profile_below_the_minimum_says_where() {
        let profile = |costs: [f64; 3]| Profile {
            name: "k".into(),
            unit: "N/m".into(),
            values: vec![1.0, 2.0, 3.0],
            costs: costs.into(),
            interval: [f64::NAN; 2],
        };
        assert_eq!(profile([12.0, 10.0, f64::NAN]).lower_minimum(10.0), None);
        let found = profile([12.0, 10.0, 7.0]).lower_minimum(10.0).expect("a lower one");
        assert!(found.contains("`k` has the cost 7.00000 at 3.000000e0 N/m"), "{found}");
    }
}
