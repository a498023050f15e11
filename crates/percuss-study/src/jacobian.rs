//! Derivatives of a study as a function: exact ones of the steps of a run where they are known, else differences of runs.

use percuss::Settings;
use percuss_codes::{AnalysisCode, Code};

use crate::function::{Function, unfit};
use crate::means::{Means, SHARE};
use crate::result_path::{ResultPath, merged, samples};
use crate::sensitivity::{
    DifferentiatedRun, SensitivityError, Without, beyond, differentiate, unknown_derivatives,
};

/// Results at a point and their derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Jacobian {
    /// Results, shape (n_result) \[SI unit of the result\].
    pub values: Vec<f64>,
    /// Derivatives, shape (n_result, n_parameter) \[SI unit of the result by that of the parameter\].
    pub derivatives: Vec<Vec<f64>>,
    /// How they were found.
    pub means: Means,
}

impl Function<'_> {
    /// Results at a point of shape (n_parameter) and their derivatives: exact ones of the steps of the run where they are known, else central
    /// differences of runs; the answer says which.
    ///
    /// # Errors
    /// What is wrong with the point, why its run does not complete, or what has no derivative and why; in one line with its code.
    pub fn jacobian(&mut self, point: &[f64]) -> Result<Jacobian, String> {
        let inputs = self.inputs(point)?;
        let parameters: Vec<String> =
            self.parameters().iter().map(|p| p.field.path().to_string()).collect();
        let of_summary = self.paths.iter().filter_map(ResultPath::summary);
        let results: Vec<String> = of_summary.map(|path| path.path().to_string()).collect();
        let samples = samples(&self.paths);
        let scenario = self.preparer.scenario(&inputs)?;
        match differentiate(scenario, &parameters, &results, &samples) {
            Ok(found) => self.complete(point, &found),
            Err(SensitivityError::Refused(why)) => self.differences(point, why),
            // A value that cannot change to one side may be differenced to the other.
            Err(SensitivityError::Faults(faults)) => {
                let why = crate::prepare::in_one_line(&faults);
                self.differences(point, why.clone()).map_err(|_| why)
            }
            Err(why) => Err(in_one_line(&why)),
        }
    }

    /// Exact derivatives, and differences of those results that have none.
    fn complete(&mut self, point: &[f64], found: &DifferentiatedRun) -> Result<Jacobian, String> {
        let (own, columns) = (found.derivatives(), found.columns());
        let values = self.known(merged(&self.paths, &found.values(), &columns.values))?;
        let without = found.without(&own);
        if let Some(Without { result, parameter, why, .. }) = without.iter().find(|w| w.never) {
            return Err(Code::from(AnalysisCode::NoDerivative)
                .behind(format!("`{result}` has no derivative by `{parameter}`: {why}")));
        }
        let mut derivatives = merged(&self.paths, &own, &columns.derivatives);
        let lacks = |row: &Vec<f64>| row.iter().any(|slope| slope.is_nan());
        let Some(first) = derivatives.iter().position(lacks) else {
            return Ok(Jacobian { values, derivatives, means: Means::Exact });
        };
        let result = &self.results()[first];
        let why = match (without.first(), columns.horizon) {
            (Some(without), _) => without.why.clone(),
            (None, Some(horizon)) => beyond(&horizon),
            (None, None) => unknown_derivatives(result.path.path()),
        };
        let why = format!("`{}`: {why}", result.name);
        let other = self.differences(point, why)?;
        for (row, other) in derivatives.iter_mut().zip(other.derivatives) {
            if lacks(row) {
                *row = other;
            }
        }
        Ok(Jacobian { values, derivatives, means: other.means })
    }

    /// Central differences of runs; where a parameter cannot change to one side, differences to the other.
    fn differences(&mut self, point: &[f64], why: String) -> Result<Jacobian, String> {
        let change = |x: f64| SHARE * if x == 0.0 { 1.0 } else { x.abs() };
        let mut points = vec![point.to_vec()];
        for (k, x) in point.iter().enumerate() {
            for sign in [-1.0, 1.0] {
                let mut moved = point.to_vec();
                moved[k] = x + sign * change(*x);
                points.push(moved);
            }
        }
        self.refuse_settings(&points)?;
        let mut found = self.values(&points).into_iter();
        let values = found.next().unwrap_or_else(|| Err(unfit("no run".into())))?;
        let sides: Vec<_> = found.collect();
        let mut derivatives = vec![Vec::new(); values.len()];
        for (both, x) in sides.chunks(2).zip(point) {
            let [below, above] = both else { continue };
            let (below, above, count) = match (below, above) {
                (Ok(below), Ok(above)) => (below, above, 2.0),
                (Err(_), Ok(above)) => (&values, above, 1.0),
                (Ok(below), Err(_)) => (below, &values, 1.0),
                (Err(why), Err(_)) => return Err(why.clone()),
            };
            for (row, (low, high)) in derivatives.iter_mut().zip(below.iter().zip(above)) {
                row.push((high - low) / (count * change(*x)));
            }
        }
        Ok(Jacobian { values, derivatives, means: Means::Differences { why } })
    }

    /// Refuses parameters that are settings of the computation, given the point and points beside it: their effect on a result is its error.
    fn refuse_settings(&mut self, points: &[Vec<f64>]) -> Result<(), String> {
        let own = self.prepare(&points[0])?.settings;
        for (k, point) in points[1..].iter().enumerate() {
            let Ok(other) = self.prepare(point) else { continue };
            if (Settings { end: own.end, ..other.settings }) != own {
                let path = self.parameters()[k / 2].field.path();
                return Err(Code::from(AnalysisCode::NoDerivative).behind(format!(
                    "`{path}` is a setting of the computation, whose effect on a result is an error"
                )));
            }
        }
        Ok(())
    }
}

fn in_one_line(why: &SensitivityError) -> String {
    match why {
        SensitivityError::Faults(faults) => crate::prepare::in_one_line(faults),
        SensitivityError::Refused(text) => Code::from(AnalysisCode::NoDerivative).behind(text),
        SensitivityError::Run(code, text) => Code::from(*code).behind(text),
    }
}
