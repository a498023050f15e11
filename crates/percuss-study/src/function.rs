//! A study as a function: numbers for its parameters in, its results out, with their derivatives.
//!
//! What programs for uncertainty and optimisation ask for. They choose the points; the design of the study plays no part.

use percuss_codes::{Code, RequestCode};
use percuss_output::{SummaryPath, pick};

use percuss_scenario::one_of;

use crate::detail::detail_for;
use crate::error::Error;
use crate::parameter::{Input, Parameter, Variation};
use crate::prepare::Preparer;
use crate::sensitivity::{SensitivityError, Without, differentiate};
use crate::shard::{GROUP_RUNS, simulate};
use crate::study::{ResultColumn, Study};

/// A study as a function of the numbers that vary in it.
pub struct Function<'s> {
    study: &'s Study,
    preparer: Preparer<'s>,
    /// Of the results, shape (results).
    paths: Vec<SummaryPath>,
}

/// Results at a point and their derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Jacobian {
    /// Results, shape (n_result) \[SI unit of the result\].
    pub values: Vec<f64>,
    /// Derivatives, shape (n_result, n_parameter) \[SI unit of the result by that of the parameter\].
    pub derivatives: Vec<Vec<f64>>,
}

impl Study {
    /// The study as a function.
    ///
    /// # Errors
    /// If words vary in it: a function is one of numbers.
    pub fn function(&self) -> Result<Function<'_>, Error> {
        let words = |p: &&Parameter| matches!(p.variation, Variation::Words(_));
        if let Some(parameter) = self.parameters.iter().find(words) {
            let text = format!(
                "`{}` varies over words or lists ({}), and a function takes numbers: give it a study in which only numbers vary",
                parameter.name,
                parameter.field.path()
            );
            return Err(Error::unfit(RequestCode::NoFunction, text));
        }
        Ok(Function {
            study: self,
            preparer: Preparer::new(self),
            paths: self.results.iter().map(|r| r.path.clone()).collect(),
        })
    }
}

impl<'s> Function<'s> {
    /// What goes in: numbers in SI units, one for each of these, in their order.
    pub fn parameters(&self) -> &'s [Parameter] {
        &self.study.parameters
    }

    /// What comes out.
    pub fn results(&self) -> &'s [ResultColumn] {
        &self.study.results
    }

    /// The point in the middle of what varies: the median of each parameter.
    pub fn middle(&self) -> Vec<f64> {
        let median = |p: &Parameter| match p.variation.at(0.5) {
            Input::Number(number) => number,
            Input::Word(_) => f64::NAN,
        };
        self.parameters().iter().map(median).collect()
    }

    /// The place of each parameter among these names, each of which has to be one of them.
    ///
    /// # Errors
    /// A name that no parameter has, with the nearest one, a parameter without a name among them, or one that occurs twice.
    pub fn places(&self, names: &[&str]) -> Result<Vec<usize>, String> {
        let own: Vec<&str> = self.parameters().iter().map(|p| p.name.as_str()).collect();
        if let Some(name) = names.iter().find(|name| !own.contains(name)) {
            return Err(self.no_parameter(name));
        }
        let place = |name: &&str| {
            let mut places = (0..names.len()).filter(|k| names[*k] == *name);
            match (places.next(), places.next()) {
                (Some(place), None) => Ok(place),
                (None, _) => {
                    let listed = own.join(", ");
                    Err(format!("no value for `{name}`; the study's parameters are {listed}"))
                }
                _ => Err(format!("two values for `{name}`")),
            }
        };
        own.iter().map(place).collect()
    }

    /// What is said of a name that no parameter has.
    pub fn no_parameter(&self, name: &str) -> String {
        let known = one_of(name, self.parameters().iter().map(|p| p.name.as_str()));
        format!("`{name}` is no parameter of the study, expected {known}")
    }

    /// The point at shares of the distributions, from 0 to 1, shape (n_parameter), in SI units: correlated parameters by a Gaussian copula,
    /// as in designs.
    ///
    /// # Errors
    /// If the shares are not as many as parameters, or not from 0 to 1.
    pub fn at(&self, shares: &[f64]) -> Result<Vec<f64>, String> {
        self.inputs(shares)?;
        if let Some(k) = shares.iter().position(|u| !(0.0..=1.0).contains(u)) {
            let name = &self.parameters()[k].name;
            return Err(unfit(format!("`{name}` at {}: a share from 0 to 1 is needed", shares[k])));
        }
        let shares = self.study.design.copula(shares.to_vec());
        let number = |(p, u): (&Parameter, &f64)| match p.variation.at(*u) {
            Input::Number(number) => number,
            Input::Word(_) => f64::NAN,
        };
        Ok(self.parameters().iter().zip(&shares).map(number).collect())
    }

    /// Correlation matrix of the Gaussian variables behind the parameters, shape (n_parameter, n_parameter) \[-\]; none if they are independent.
    pub fn correlation(&self) -> Option<Vec<Vec<f64>>> {
        let lower = self.study.design.correlation.as_ref()?;
        let matrix = lower * lower.transpose();
        Some(matrix.row_iter().map(|row| row.iter().copied().collect()).collect())
    }

    /// Results at some points, each of shape (n_parameter) in SI units; runs go side by side where they fit.
    ///
    /// # Errors
    /// Of each point: what is wrong with it, or why its run does not complete, in one line with its code.
    pub fn values(&mut self, points: &[Vec<f64>]) -> Vec<Result<Vec<f64>, String>> {
        let detail = detail_for(&self.paths);
        let mut all = Vec::with_capacity(points.len());
        for group in points.chunks(GROUP_RUNS) {
            let ready: Vec<_> = group.iter().map(|point| self.prepare(point)).collect();
            let outcomes = simulate(&ready, detail);
            let picked = outcomes.into_iter().map(|(outcome, status)| {
                let summary = outcome?;
                if let percuss::Termination::Failed(error) = &summary.termination {
                    return Err(Code::from(error.code()).behind(error));
                }
                if status != "completed" {
                    return Err(unfit(format!("the run is {status}")));
                }
                self.known(pick(&self.paths, &summary))
            });
            all.extend(picked);
        }
        all
    }

    /// Results at a point of shape (n_parameter) and their derivatives: exact ones of the steps that are made, no differences of runs.
    ///
    /// # Errors
    /// What is wrong with the point, why its run does not complete, or what has no derivative and why; in one line with its code.
    pub fn jacobian(&mut self, point: &[f64]) -> Result<Jacobian, String> {
        let inputs = self.inputs(point)?;
        let parameters: Vec<String> =
            self.parameters().iter().map(|p| p.field.path().to_string()).collect();
        let results: Vec<String> = self.paths.iter().map(|path| path.path().to_string()).collect();
        let scenario = self.preparer.scenario(&inputs)?;
        let found =
            differentiate(scenario, &parameters, &results).map_err(|why| in_one_line(&why))?;
        let values = self.known(found.values())?;
        let derivatives = found.derivatives();
        match found.without(&derivatives).first() {
            None => Ok(Jacobian { values, derivatives }),
            Some(Without { result, parameter, why }) => {
                Err(Code::from(percuss_codes::AnalysisCode::NoDerivative)
                    .behind(format!("`{result}` has no derivative by `{parameter}`: {why}")))
            }
        }
    }

    fn prepare(&mut self, point: &[f64]) -> Result<percuss_scenario::Compiled, String> {
        let inputs = self.inputs(point)?;
        self.preparer.prepare(&inputs)
    }

    /// The inputs of a run at a point.
    fn inputs(&self, point: &[f64]) -> Result<Vec<Input<'s>>, String> {
        let (given, wanted) = (point.len(), self.parameters().len());
        if given != wanted {
            let names: Vec<&str> = self.parameters().iter().map(|p| p.name.as_str()).collect();
            let text = format!("{given} numbers for {wanted} parameters ({})", names.join(", "));
            return Err(unfit(text));
        }
        let finite = |(x, parameter): (&f64, &Parameter)| match x.is_finite() {
            true => Ok(Input::Number(*x)),
            false => Err(unfit(format!("`{}` is {x}: a number is needed", parameter.name))),
        };
        point.iter().zip(self.parameters()).map(finite).collect()
    }

    /// Results of a run, if it has all of them.
    fn known(&self, values: Vec<f64>) -> Result<Vec<f64>, String> {
        match values.iter().position(|x| x.is_nan()) {
            None => Ok(values),
            Some(k) => {
                let ResultColumn { name, path } = &self.results()[k];
                let text = format!("the run at this point has no `{}` (`{name}`)", path.path());
                Err(unfit(text))
            }
        }
    }
}

/// A point at which the function has no value.
fn unfit(text: String) -> String {
    Code::from(RequestCode::NoValue).behind(text)
}

fn in_one_line(why: &SensitivityError) -> String {
    match why {
        SensitivityError::Faults(faults) => crate::prepare::in_one_line(faults),
        SensitivityError::Refused(text) => {
            Code::from(percuss_codes::AnalysisCode::NoDerivative).behind(text)
        }
        SensitivityError::Run(code, text) => Code::from(*code).behind(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STUDY: &str = r#"
        scenario = """
[material.m]
young = 2e9
density = 3e3
[section.s]
area = 0.1
inertia = 8e-5
[beam.b]
points = [[0, 0], [3, 0]]
elements = 4
material = "m"
section = "s"
[support.left]
at = "b.start"
kind = "clamp"
[projectile.p]
kind = "elastic"
mass = 100
stiffness = 1e6
velocity = [0, 10]
strikes = "b.end"
[time]
end = 0.02
step = 2e-4
"""
        [parameter.speed]
        path = "projectile.p.velocity[1]"
        range = { from = "5 m/s", to = "20 m/s" }
        [parameter.mass]
        path = "projectile.p.mass"
        range = { from = "50 kg", to = "200 kg" }
        [design]
        kind = "sobol"
        runs = 4
        [results]
        force = "contact.p.peak_force.value"
        exit = "projectile.p.velocity_final[1]"
    "#;

    fn study() -> Study {
        Study::from_toml(STUDY, "study.toml").unwrap_or_else(|faults| panic!("{faults}"))
    }

    #[test]
    fn values_are_those_of_the_runs_of_a_design() {
        let study = study();
        let shard = study.run_shard(0);
        let column = |name| shard.table.numbers(name).unwrap_or_default();
        let points: Vec<Vec<f64>> =
            column("speed").iter().zip(column("mass")).map(|(v, m)| vec![*v, m]).collect();
        let mut function = study.function().expect("numbers");
        for (k, values) in function.values(&points).into_iter().enumerate() {
            assert_eq!(values, Ok(vec![column("force")[k], column("exit")[k]]));
        }
    }

    #[test]
    fn a_jacobian_is_what_differences_tend_to() {
        let study = study();
        let mut function = study.function().expect("numbers");
        let at = [12.0, 90.0];
        let jacobian = function.jacobian(&at).expect("derivatives");
        for k in 0..2 {
            let moved = |sign: f64| {
                let mut point = at.to_vec();
                point[k] += sign * 1e-4 * at[k];
                point
            };
            let ends = function.values(&[moved(-1.0), moved(1.0)]);
            let [Ok(low), Ok(high)] = &ends[..] else { panic!("{ends:?}") };
            for (row, (a, b)) in jacobian.derivatives.iter().zip(low.iter().zip(high)) {
                let difference = (b - a) / (2e-4 * at[k]);
                assert!((row[k] / difference - 1.0).abs() < 1e-4, "{} {difference}", row[k]);
            }
        }
    }

    #[test]
    fn names_of_parameters_are_matched_or_refused() {
        let study = study();
        let function = study.function().expect("numbers");
        assert_eq!(function.places(&["mass", "speed"]), Ok(vec![1, 0]));
        for (names, evaluated) in [
            (["sped", "mass"], "expected one of `speed`, `mass` (did you mean `speed`?)"),
            (["mass", "mass"], "no value for `speed`; the study's parameters are speed, mass"),
        ] {
            let found = function.places(&names).expect_err(evaluated);
            assert!(found.ends_with(evaluated), "{found}");
        }
        let twice = function.places(&["mass", "speed", "mass"]);
        assert_eq!(twice, Err("two values for `mass`".to_owned()));
    }

    #[test]
    fn shares_become_values_of_the_distributions_and_their_copula() {
        let study = study();
        let function = study.function().expect("numbers");
        assert_eq!(function.at(&[0.0, 1.0]), Ok(vec![5.0, 200.0]));
        assert!(function.at(&[0.5, 1.5]).is_err_and(|why| why.contains("a share from 0 to 1")));
        assert_eq!(function.correlation(), None);
        let text = STUDY.replace(
            "[design]",
            "[[correlation]]\nbetween = [\"speed\", \"mass\"]\ncoefficient = 0.6\n[design]",
        );
        let study = Study::from_toml(&text, "study.toml").unwrap_or_else(|e| panic!("{e}"));
        let function = study.function().expect("numbers");
        let matrix = function.correlation().expect("a matrix");
        assert!((matrix[0][1] - 0.6).abs() < 1e-12 && (matrix[1][1] - 1.0).abs() < 1e-12);
        // The median of the speed, and a standard score of z1 = 1: the mass at a score of 0.6 * 0 + 0.8 * 1.
        let share = |z| crate::distribution::standard_share(z);
        let point = function.at(&[0.5, share(1.0)]).expect("a point");
        // Quantiles are inverses to some ten digits.
        assert!((point[0] - 12.5).abs() < 1e-6, "{point:?}");
        assert!((point[1] - (50.0 + 150.0 * share(0.8))).abs() < 1e-6, "{point:?}");
    }

    #[test]
    fn points_outside_a_study_are_refused() {
        let study = study();
        let mut function = study.function().expect("numbers");
        let evaluated =
            function.values(&[vec![1.0], vec![1.0, f64::NAN], vec![10.0, -1.0], vec![12.0, 90.0]]);
        let reason = |k: usize| evaluated[k].as_ref().err().map_or("", String::as_str);
        assert_eq!(reason(0), "1 numbers for 2 parameters (speed, mass) [E319]");
        assert_eq!(reason(1), "`mass` is NaN: a number is needed [E319]");
        assert!(reason(2).contains("projectile.p.mass"), "{}", reason(2));
        assert!(evaluated[3].is_ok(), "faults of one point leave the others alone");
        let lists =
            STUDY.replace("range = { from = \"50 kg\", to = \"200 kg\" }", "values = [\"a\"]");
        let lists = lists
            .replace("projectile.p.mass", "projectile.p.kind")
            .replace("[\"a\"]", "[\"elastic\"]");
        let lists = lists
            .replace("kind = \"sobol\"\n        runs = 4", "kind = \"latin-hypercube\"\n runs = 4");
        let study =
            Study::from_toml(&lists, "study.toml").unwrap_or_else(|faults| panic!("{faults}"));
        assert!(study.function().is_err_and(|error| error.code().to_string() == "E318"));
    }
}
