//! Derivatives of a run's results with respect to values of its scenario.

mod differentiated;
mod one_sided;
mod vary;

use percuss::{Fault, Settings};
use percuss_batch::{
    ColumnSample, Horizon, Sensitivities, Undifferentiated, sensitivities,
    sensitivities_with_columns,
};
use percuss_codes::AnalysisCode;
use percuss_output::{SummaryPath, pick, pick_derivatives, summary_paths};
use percuss_scenario::{Compiled, Diagnostics, Scenario};

use crate::resolve::result;

pub use differentiated::Differentiated;
pub use one_sided::OneSided;
use one_sided::one_sided;
use vary::vary_all;

/// Shares of the step at which the run is made again, to see what its size does to derivatives.
const OTHER_STEPS: [f64; 2] = [0.5, 0.8];

/// What half the step changes is half the error of a derivative of first order in the step. Twice that was exceeded by up to a quarter in
/// ten of a hundred derivatives of ordinary scenes, for no order is exact at any step; three times it in one of a hundred, behind impacts.
const MARGIN: f64 = 3.0;

/// What results are differentiated where none are named: how their paths end.
const USUAL: [&str; 8] = [
    ".displacement_max.component_1.value",
    ".displacement_max.component_2.value",
    ".velocity_final[0]",
    ".velocity_final[1]",
    ".peak_force.value",
    ".impulse_total",
    // Known wherever derivatives reach.
    ".impacts[0].impulse",
    ".intervals[0].impulse",
];

/// Results of a run and their derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    /// Parameters, shape (n_parameter).
    pub parameters: Vec<Differentiated>,
    /// Results, shape (n_result).
    pub results: Vec<Differentiated>,
    /// Derivatives, shape (n_result, n_parameter) \[SI unit of the result by that of the parameter\]; NaN for those of `without`.
    pub derivatives: Vec<Vec<f64>>,
    /// Uncertainty of each derivative from the size of the step, shape and units of `derivatives`: three times what half the
    /// step changes, or what four fifths of it change, if that is more: instants of impacts then lie elsewhere in their steps.
    /// NaN where other steps do not tell, shape (n_result, n_parameter) \[SI unit of the result by that of the parameter\].
    pub uncertainties: Vec<Vec<f64>>,
    /// Contacts that a small change of a parameter makes or ends, shape (contacts).
    pub one_sided: Vec<OneSided>,
    /// Derivatives that there are not, shape (derivatives).
    pub without: Vec<Without>,
    /// How far derivatives reach, if not to the end of the run.
    pub horizon: Option<Horizon>,
}

/// A derivative that there is not.
#[derive(Clone, Debug, PartialEq)]
pub struct Without {
    /// Path of the result.
    pub result: String,
    /// Path of the parameter.
    pub parameter: String,
    /// Why.
    pub why: String,
    /// Whether differences of runs would not help: of counts, and of errors of the computation.
    pub never: bool,
}

/// Why there are no derivatives.
#[derive(Debug)]
pub enum SensitivityError {
    /// The scenario, or a path.
    Faults(Diagnostics),
    /// Something that has no derivatives.
    Refused(String),
    /// The run fails: as what, and why.
    Run(AnalysisCode, String),
}

impl From<Undifferentiated> for SensitivityError {
    fn from(why: Undifferentiated) -> Self {
        match why {
            Undifferentiated::Refused(why) => Self::Refused(why),
            Undifferentiated::Failed(code, why) => Self::Run(code, why),
        }
    }
}

impl From<Diagnostics> for SensitivityError {
    fn from(faults: Diagnostics) -> Self {
        Self::Faults(faults)
    }
}

/// Runs a scenario, and again at other steps, and differentiates results, by their paths in the summary, with respect to numbers of the scenario, by
/// theirs. Without results, peaks, impulses and velocities at the end.
///
/// # Errors
/// Faults of the scenario and of the paths, with the names that would lead on; what of the model cannot be differentiated.
pub fn sensitivity(
    scenario: &Scenario,
    parameters: &[String],
    results: &[String],
) -> Result<Sensitivity, SensitivityError> {
    let one = differentiate(scenario, parameters, results, &[])?;
    let derivatives = one.derivatives();
    let without = one.without(&derivatives);
    // What nobody asked for is reported with its reason; only results that were named are missed.
    let missed = !results.is_empty() && derivatives.iter().flatten().all(|x| x.is_nan());
    if let Some(first) = without.first().filter(|_| missed) {
        let why = format!("`{}` has no derivative: {}", first.result, first.why);
        return Err(SensitivityError::Refused(why));
    }
    // Another step that fails leaves the derivatives as they are, and their uncertainty unknown.
    let others = OTHER_STEPS.map(|share| {
        let step = share * one.compiled.settings.step;
        let settings = Settings { step, ..one.compiled.settings };
        let other = sensitivities(&one.compiled.model, &settings, &one.variations).ok()?;
        Some(self::derivatives(&one.paths, &other))
    });
    let uncertainties = uncertainties(&derivatives, &others);
    let one_sided = one_sided(&one.found.grazing, &one.parameters);
    let results = one.paths.iter().zip(one.values()).map(|(path, value)| Differentiated {
        path: path.path().into(),
        value,
        unit: path.unit().into(),
    });
    let results = results.collect();
    Ok(Sensitivity {
        parameters: one.parameters,
        results,
        derivatives,
        uncertainties,
        one_sided,
        without,
        horizon: one.found.horizon,
    })
}

/// A run and its derivatives, with what was asked of it.
pub(crate) struct DifferentiatedRun {
    compiled: Compiled,
    /// Its parameters, shape (parameters).
    parameters: Vec<Differentiated>,
    /// How each of them is varied, shape (parameters).
    variations: Vec<percuss_batch::Variation>,
    /// Of the results, shape (n_result).
    paths: Vec<SummaryPath>,
    found: Sensitivities,
}

/// Runs a scenario and differentiates it, with numbers taken from columns of the history; other arguments and errors are those of [`sensitivity`].
pub(crate) fn differentiate(
    scenario: &Scenario,
    parameters: &[String],
    results: &[String],
    samples: &[ColumnSample],
) -> Result<DifferentiatedRun, SensitivityError> {
    let compiled = scenario.compile()?;
    let (differentiated, variations) = vary_all(scenario, &compiled, parameters)?;
    let mut faults = Vec::new();
    let (model, settings) = (&compiled.model, &compiled.settings);
    let found = sensitivities_with_columns(model, settings, &variations, samples)?;
    let mut paths = Vec::new();
    let wanted = match samples {
        [] => wanted(results, &found.summary),
        _ => results.to_vec(),
    };
    for path in wanted {
        match result(&path, &found.summary) {
            Ok(path) if path.is_of_forces() => {
                return Err(SensitivityError::Refused(format!(
                    "derivatives are not known for section forces and reactions (`{}`)",
                    path.path()
                )));
            }
            Ok(path) => paths.push(path),
            Err((found, expected)) => faults.push(Fault::new(path, found, expected)),
        }
    }
    if !faults.is_empty() {
        return Err(scenario.diagnostics(faults).into());
    }
    Ok(DifferentiatedRun { compiled, parameters: differentiated, variations, paths, found })
}

/// Numbers taken from columns of the history, and their exact derivatives.
pub(crate) struct ExactColumns {
    /// The numbers, shape (samples) \[SI unit of the column\].
    pub values: Vec<f64>,
    /// Derivatives, shape (samples, parameters) \[SI unit of the column by that of the parameter\]; NaN where there are none.
    pub derivatives: Vec<Vec<f64>>,
    /// Contacts, and yielding, that a small change of a parameter adds or removes, shape (such events).
    pub one_sided: Vec<OneSided>,
    /// Time up to which derivatives are valid, if it is before the end.
    pub horizon: Option<Horizon>,
}

/// Numbers taken from columns of the history, and their exact derivatives; NaN where there are none. Errors are those of [`sensitivity`].
pub(crate) fn exact_columns(
    scenario: &Scenario,
    parameters: &[String],
    samples: &[ColumnSample],
) -> Result<ExactColumns, SensitivityError> {
    differentiate(scenario, parameters, &[], samples).map(|one| one.columns())
}

fn exact(found: &Sensitivities, parameters: &[Differentiated]) -> ExactColumns {
    let (values, by) = (found.columns.values.clone(), &found.columns.derivatives);
    let row = |k: usize| by.iter().map(|column| column[k]).collect();
    let derivatives = (0..values.len()).map(row).collect();
    let one_sided = one_sided(&found.grazing, parameters);
    ExactColumns { values, derivatives, one_sided, horizon: found.horizon.clone() }
}

impl DifferentiatedRun {
    /// Results, shape (n_result), in SI units.
    pub fn values(&self) -> Vec<f64> {
        pick(&self.paths, &self.found.summary)
    }

    /// Their derivatives, shape (n_result, n_parameter); NaN where there is none.
    pub fn derivatives(&self) -> Vec<Vec<f64>> {
        derivatives(&self.paths, &self.found)
    }

    /// Numbers taken from columns, and their derivatives, shape (samples), each of shape (n_parameter) \[SI unit of the column by that of the
    /// parameter\]; NaN where there is none.
    pub fn columns(&self) -> ExactColumns {
        exact(&self.found, &self.parameters)
    }

    /// The derivatives that there are not, and why.
    pub fn without(&self, derivatives: &[Vec<f64>]) -> Vec<Without> {
        without(&self.paths, &self.values(), derivatives, &self.parameters, &self.found)
    }
}

/// The derivatives that there are not, and why.
fn without(
    paths: &[SummaryPath],
    values: &[f64],
    derivatives: &[Vec<f64>],
    parameters: &[Differentiated],
    found: &Sensitivities,
) -> Vec<Without> {
    let mut all = Vec::new();
    for ((path, value), row) in paths.iter().zip(values).zip(derivatives) {
        let missing = row.iter().zip(parameters).filter(|(derivative, _)| derivative.is_nan());
        for (_, parameter) in missing {
            all.push(Without {
                result: path.path().into(),
                parameter: parameter.path.clone(),
                why: why(path, *value, found),
                never: path.is_count(&found.summary) || path.is_of_errors(),
            });
        }
    }
    all
}

/// Why a result has no derivative.
fn why(path: &SummaryPath, value: f64, found: &Sensitivities) -> String {
    let crest = "steps do not resolve when it is largest";
    if path.is_count(&found.summary) {
        return "it is a count".into();
    }
    if path.is_of_errors() {
        return "it measures errors of the computation".into();
    }
    if value.is_nan() {
        return "the run has no such result".into();
    }
    match &found.horizon {
        Some(horizon) => beyond(horizon),
        None if path.path().contains(".impacts[") => {
            "it is one of many slight impacts, of which round-off makes one more or less".into()
        }
        None if path.path().ends_with(".time") => crest.into(),
        None => "it does not follow from what is differentiated".into(),
    }
}

/// What it means that derivatives do not reach to the end of the run, in words.
pub fn beyond(horizon: &Horizon) -> String {
    format!("derivatives are available up to t = {:.6e} s, {}", horizon.time, horizon.why)
}

/// Why a column has no derivatives.
pub(crate) fn unknown_derivatives(column: &str) -> String {
    format!("derivatives are not available for the column `{column}`")
}

/// Derivatives of the results at these paths, shape (n_result, n_parameter).
fn derivatives(paths: &[SummaryPath], found: &Sensitivities) -> Vec<Vec<f64>> {
    let by: Vec<Vec<f64>> =
        found.derivatives.iter().map(|d| pick_derivatives(paths, &found.summary, d)).collect();
    (0..paths.len()).map(|k| by.iter().map(|column| column[k]).collect()).collect()
}

/// [`MARGIN`] times the largest of what other steps change.
fn uncertainties(own: &[Vec<f64>], others: &[Option<Vec<Vec<f64>>>]) -> Vec<Vec<f64>> {
    let of = |row: usize, column: usize| {
        let off = |other: &Option<Vec<Vec<f64>>>| -> f64 {
            let other = other.as_ref().map_or(f64::NAN, |other| other[row][column]);
            MARGIN * (own[row][column] - other).abs()
        };
        // What one of them does not know is unknown.
        let larger = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) };
        others.iter().map(off).fold(0.0, larger)
    };
    own.iter()
        .enumerate()
        .map(|(row, values)| (0..values.len()).map(|column| of(row, column)).collect())
        .collect()
}

/// The results asked for, or the usual ones.
fn wanted(results: &[String], summary: &percuss::RunSummary) -> Vec<String> {
    if !results.is_empty() {
        return results.to_vec();
    }
    let usual = |path: &String| {
        let inner = path.contains("intervals") && !path.ends_with(".intervals[0].impulse");
        USUAL.iter().any(|end| path.ends_with(end)) && !inner && moves(path, summary)
    };
    summary_paths(summary).into_iter().map(|one| one.path).filter(usual).collect()
}

/// Whether a result can have a derivative and is more than round-off.
fn moves(path: &str, summary: &percuss::RunSummary) -> bool {
    let found = result(path, summary).ok().filter(|path| !path.is_of_forces());
    found.is_some_and(|path| pick(&[path], summary)[0].abs() > 1e-12)
}
