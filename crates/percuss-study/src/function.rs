//! A study as a function: numbers for its parameters in, its results out.
//!
//! What programs for uncertainty and optimisation ask for. They choose the points; the design of the study plays no part.

use percuss_codes::{Code, RequestCode};
use percuss_scenario::one_of;

use crate::detail::detail_for;
use crate::error::Error;
use crate::parameter::{Input, Parameter, Variation};
use crate::prepare::Preparer;
use crate::result_path::{ResultPath, samples};
use crate::shard::{GROUP_RUNS, simulate};
use crate::study::{ResultColumn, Study};

/// A study as a function of the numbers that vary in it.
pub struct Function<'s> {
    study: &'s Study,
    pub(crate) preparer: Preparer<'s>,
    /// Of the results, shape (results).
    pub(crate) paths: Vec<ResultPath>,
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

    /// The study.
    pub fn study(&self) -> &'s Study {
        self.study
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
        self.evaluated(points).into_iter().map(|one| one.map(|found| found.values)).collect()
    }

    /// The same, with the results that are not final.
    ///
    /// # Errors
    /// As [`Self::values`].
    pub fn evaluated(&mut self, points: &[Vec<f64>]) -> Vec<Result<Evaluated, String>> {
        let (detail, samples) = (detail_for(&self.paths), samples(&self.paths));
        let mut all = Vec::with_capacity(points.len());
        for group in points.chunks(GROUP_RUNS) {
            let ready: Vec<_> = group.iter().map(|point| self.prepare(point)).collect();
            let outcomes = simulate(&ready, detail, &samples);
            let picked = outcomes.into_iter().map(|(outcome, status)| {
                let made = outcome?;
                if let percuss::Termination::Failed(error) = &made.summary.termination {
                    return Err(Code::from(error.code()).behind(error));
                }
                if status != "completed" {
                    return Err(unfit(format!("the run is {status}")));
                }
                let values = self.known(made.pick(&self.paths))?;
                let open = |k: &usize| !self.paths[*k].open_value(&made.summary).is_nan();
                Ok(Evaluated { values, open: (0..self.paths.len()).filter(open).collect() })
            });
            all.extend(picked);
        }
        all
    }

    /// The run at a point.
    pub(crate) fn prepare(&mut self, point: &[f64]) -> Result<percuss_scenario::Compiled, String> {
        let inputs = self.inputs(point)?;
        self.preparer.prepare(&inputs)
    }

    /// The inputs of a run at a point.
    pub(crate) fn inputs(&self, point: &[f64]) -> Result<Vec<Input<'s>>, String> {
        let (given, wanted) = (point.len(), self.parameters().len());
        if given != wanted {
            let names: Vec<&str> = self.parameters().iter().map(|p| p.name.as_str()).collect();
            let text = format!("{given} numbers for {wanted} parameters ({})", names.join(", "));
            return Err(unfit(text));
        }
        Ok(point.iter().map(|x| Input::Number(*x)).collect())
    }

    /// Results of a run, if it has all of them.
    pub(crate) fn known(&self, values: Vec<f64>) -> Result<Vec<f64>, String> {
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

/// Results at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluated {
    /// The results, shape (n_result) \[SI unit of the result\].
    pub values: Vec<f64>,
    /// Those that a contact, stop, spring or foundation which is still closed at the end of the run leaves open: they are what they had come to by then, shape (such results)
    /// \[index of a result\].
    pub open: Vec<usize>,
}

impl Study {
    /// What is said of results that are not final; `None` if all are.
    pub fn not_final(&self, open: &[usize]) -> Option<String> {
        if open.is_empty() {
            return None;
        }
        let names: Vec<String> =
            open.iter().map(|k| format!("`{}`", self.results[*k].name)).collect();
        let are = if names.len() == 1 { "is not final" } else { "are not final" };
        Some(format!(
            "{} {are}: a contact, stop, spring or foundation is still closed at the end of the run, set a later time.end",
            names.join(", ")
        ))
    }
}

/// A point at which the function has no value.
pub(crate) fn unfit(text: String) -> String {
    Code::from(RequestCode::NoValue).behind(text)
}
