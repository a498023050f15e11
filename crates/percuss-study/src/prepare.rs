//! From the inputs of a run to its model.

use std::collections::HashMap;

use percuss_codes::Code;
use percuss_scenario::{Compiled, Diagnostics, Scenario};

use crate::detail::{detail_for, is_known_alone};
use crate::parameter::{Input, Variation};
use crate::study::Study;

/// Prepares runs one after the other.
///
/// Numbers are set in a scenario kept for the purpose; only where words change is the text read again, once for each combination.
pub(crate) struct Preparer<'s> {
    study: &'s Study,
    /// Scenarios read so far, by the words that a run sets, shape (words of a run).
    scenarios: HashMap<Vec<&'s str>, Result<Scenario, String>>,
}

impl<'s> Preparer<'s> {
    pub fn new(study: &'s Study) -> Self {
        Self { study, scenarios: HashMap::new() }
    }

    /// The model of a run.
    ///
    /// # Errors
    /// Why there is none, in one line.
    pub fn prepare(&mut self, inputs: &[Input<'s>]) -> Result<Compiled, String> {
        self.scenario(inputs)?.compile().map_err(|diagnostics| in_one_line(&diagnostics))
    }

    /// The scenario of a run.
    ///
    /// # Errors
    /// Why there is none, in one line.
    pub fn scenario(&mut self, inputs: &[Input<'s>]) -> Result<&Scenario, String> {
        let word = |input: &Input<'s>| match input {
            Input::Word(word) => Some(*word),
            Input::Number(_) => None,
        };
        let words: Vec<&str> = inputs.iter().filter_map(word).collect();
        let study = self.study;
        let scenario = self.scenarios.entry(words).or_insert_with(|| with_words(study, inputs));
        let scenario = scenario.as_mut().map_err(|reason| reason.clone())?;
        for (parameter, input) in self.study.parameters.iter().zip(inputs) {
            if let Input::Number(number) = input {
                scenario
                    .set_number(&parameter.field, *number)
                    .map_err(|fault| percuss_scenario::in_one_line(&fault))?;
            }
        }
        Ok(scenario)
    }
}

/// A run that cannot be simulated, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Invalid {
    /// Its number.
    pub run: u64,
    /// Why, in one line.
    pub reason: String,
}

impl Study {
    /// The scenario of a run as a file that names no other one.
    ///
    /// # Errors
    /// Why there is none, in one line.
    pub fn scenario_of(&self, run: u64) -> Result<String, String> {
        let inputs = self.inputs(run);
        Preparer::new(self).scenario(&inputs).map(Scenario::to_toml)
    }

    /// Why the first run that can be prepared would be made alone and not side by side with others in vector registers, many times as
    /// fast; none if nothing is against it, or no run can be prepared.
    pub fn runs_alone(&self) -> Option<String> {
        if let Some(result) = self.results.iter().find(|result| is_known_alone(&result.path)) {
            return Some(format!("`{}` is requested ({})", result.name, result.path.path()));
        }
        let mut preparer = Preparer::new(self);
        let mut valid =
            (0..self.run_count().min(8)).filter_map(|run| preparer.prepare(&self.inputs(run)).ok());
        let first = valid.next()?;
        let paths: Vec<_> = self.results.iter().map(|result| result.path.clone()).collect();
        let detail = detail_for(&paths);
        percuss_batch::runs_alone(&first.model, &first.settings, detail).map(str::to_owned)
    }

    /// Whether runs go side by side or one by one, and why, in words.
    pub fn how_runs_go(&self) -> String {
        match self.runs_alone() {
            Some(why) => format!("runs are computed one at a time: {why}"),
            None => "runs are computed in SIMD batches".to_owned(),
        }
    }

    /// Prepares at most so many runs, evenly chosen, and tells of those that are no valid scenario; and how many were prepared.
    pub fn check_sample(&self, most: u64) -> (Vec<Invalid>, u64) {
        let runs = self.run_count();
        let looked_at = runs.min(most.max(1));
        let mut preparer = Preparer::new(self);
        let mut invalid = Vec::new();
        for k in 0..looked_at {
            let run = (u128::from(k) * u128::from(runs) / u128::from(looked_at)) as u64;
            if let Err(reason) = preparer.prepare(&self.inputs(run)) {
                invalid.push(Invalid { run, reason });
            }
        }
        (invalid, looked_at)
    }
}

/// The scenario with the words of a run.
fn with_words(study: &Study, inputs: &[Input<'_>]) -> Result<Scenario, String> {
    let change = |(parameter, input): (&'_ crate::Parameter, &Input<'_>)| match input {
        Input::Word(word) => Some((parameter.field.path().to_string(), word.to_string())),
        Input::Number(_) => None,
    };
    let changes: Vec<_> = study.parameters.iter().zip(inputs).filter_map(change).collect();
    if changes.is_empty() {
        return Ok(study.scenario.clone());
    }
    let changes: Vec<(&str, &str)> =
        changes.iter().map(|(p, v)| (p.as_str(), v.as_str())).collect();
    let mut scenario = study.scenario.reread(&changes).map_err(|d| in_one_line(&d))?;
    // A number along a beam is a fraction or a length, as in the study.
    for parameter in &study.parameters {
        if !matches!(parameter.variation, Variation::Words(_)) {
            scenario
                .set_toml(&parameter.field, &parameter.example)
                .map_err(|fault| percuss_scenario::in_one_line(&fault))?;
        }
    }
    Ok(scenario)
}

/// Faults with their codes, without their places: the text they lie in is not the user's file.
pub(crate) fn in_one_line(diagnostics: &Diagnostics) -> String {
    let one = |d: &percuss_scenario::Diagnostic| {
        let path = if d.path.is_empty() { String::new() } else { format!("{}: ", d.path) };
        Code::from(d.code).behind(format!("{path}found {}, expected {}", d.message, d.help))
    };
    diagnostics.all().iter().map(one).collect::<Vec<_>>().join("; ")
}
