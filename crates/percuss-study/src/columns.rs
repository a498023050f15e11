//! Numbers taken from columns of the history, and their derivatives: what a fit to measurements needs.

use percuss::{Fault, Settings, Termination};
use percuss_batch::{ColumnSample, has_derivatives, simulate_with_columns};
use percuss_codes::AnalysisCode;
use percuss_scenario::{Compiled, Diagnostics, Scenario};
use rayon::prelude::*;

use crate::history_columns::{columns_of, unknown_column};
use crate::means::{Means, SHARE};
use crate::sensitivity::{
    ExactColumns, OneSided, SensitivityError, beyond, exact_columns, unknown_derivatives,
};
use crate::workers::Workers;

/// Numbers taken from columns, and their derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnJacobian {
    /// The numbers, shape (samples) \[SI unit of the column\]; NaN where the run has none.
    pub values: Vec<f64>,
    /// Their derivatives, shape (samples, parameters) \[SI unit of the column by that of the parameter\].
    pub derivatives: Vec<Vec<f64>>,
    /// How they were found.
    pub means: Means,
    /// Contacts, and yielding, that a small change of a parameter adds or removes: derivatives are valid on the side of the run,
    /// shape (such events).
    pub one_sided: Vec<OneSided>,
}

/// Numbers taken from columns of the history of a run, shape (samples) \[SI unit of the column\]; NaN where the run has none.
///
/// # Errors
/// Faults of the scenario, a column that it does not have, a run that fails.
pub fn column_values(
    scenario: &Scenario,
    samples: &[ColumnSample],
) -> Result<Vec<f64>, SensitivityError> {
    let compiled = scenario.compile()?;
    check(scenario, &compiled, samples)?;
    values(scenario, &compiled, samples)
}

/// The same with the derivatives by numbers of the scenario at given paths: exact ones where they are known, else differences of runs on up to
/// `threads` threads (0: one for each core).
///
/// # Errors
/// Faults of the scenario and of the paths, a column that it does not have, a run that fails.
pub fn column_jacobian(
    scenario: &Scenario,
    parameters: &[String],
    samples: &[ColumnSample],
    threads: usize,
) -> Result<ColumnJacobian, SensitivityError> {
    let compiled = scenario.compile()?;
    check(scenario, &compiled, samples)?;
    let known = |sample: &ColumnSample| has_derivatives(&sample.column, &compiled.model);
    if let Some(first) = samples.first()
        && !samples.iter().any(known)
    {
        let why = unknown_derivatives(&first.column);
        return differenced(scenario, &compiled, parameters, samples, (why, threads));
    }
    match exact_columns(scenario, parameters, samples) {
        Ok(exact) => complete(exact, scenario, parameters, samples, threads),
        Err(SensitivityError::Run(code, why)) => Err(SensitivityError::Run(code, why)),
        Err(SensitivityError::Refused(why)) => {
            differenced(scenario, &compiled, parameters, samples, (why, threads))
        }
        // A value that cannot change to one side may be differenced to the other.
        Err(SensitivityError::Faults(faults)) => {
            let why = crate::prepare::in_one_line(&faults);
            let found = differenced(scenario, &compiled, parameters, samples, (why, threads));
            found.map_err(|_| SensitivityError::Faults(faults))
        }
    }
}

/// Exact derivatives with differences where there are none.
fn complete(
    exact: ExactColumns,
    scenario: &Scenario,
    parameters: &[String],
    samples: &[ColumnSample],
    threads: usize,
) -> Result<ColumnJacobian, SensitivityError> {
    let ExactColumns { values, derivatives, one_sided, horizon } = exact;
    let mut found = ColumnJacobian { values, derivatives, means: Means::Exact, one_sided };
    let lacks = |k: usize| {
        !found.values[k].is_nan() && found.derivatives[k].iter().any(|slope| slope.is_nan())
    };
    let without: Vec<usize> = (0..samples.len()).filter(|k| lacks(*k)).collect();
    let Some(first) = without.first() else { return Ok(found) };
    let compiled = scenario.compile()?;
    let why = match horizon {
        _ if !has_derivatives(&samples[*first].column, &compiled.model) => {
            unknown_derivatives(&samples[*first].column)
        }
        Some(horizon) => beyond(&horizon),
        None => "an extreme of a column moves from row to row".into(),
    };
    let some: Vec<ColumnSample> = without.iter().map(|k| samples[*k].clone()).collect();
    let why = format!("{} of {} numbers: {why}", some.len(), samples.len());
    let other = differenced(scenario, &compiled, parameters, &some, (why, threads))?;
    for (k, row) in without.iter().zip(other.derivatives) {
        found.derivatives[*k] = row;
    }
    found.means = other.means;
    Ok(found)
}

/// Derivatives as differences of runs.
fn differenced(
    scenario: &Scenario,
    compiled: &Compiled,
    parameters: &[String],
    samples: &[ColumnSample],
    (why, threads): (String, usize),
) -> Result<ColumnJacobian, SensitivityError> {
    let mut faults = Vec::new();
    let mut sides = Vec::new();
    for path in parameters {
        match sides_of(scenario, compiled, path) {
            Ok(both) => sides.push(both),
            Err(fault) => faults.push(fault),
        }
    }
    if !faults.is_empty() {
        return Err(scenario.diagnostics(faults).into());
    }
    let runs: Vec<Option<&Compiled>> = std::iter::once(Some(compiled))
        .chain(sides.iter().flat_map(|side| side.models.each_ref().map(Option::as_ref)))
        .collect();
    let run = |one: &Option<&Compiled>| one.map(|one| values(scenario, one, samples)).transpose();
    let found: Vec<_> = match threads {
        1 => runs.iter().map(run).collect::<Result<_, _>>(),
        _ => Workers::new(threads)
            .map_err(|error| SensitivityError::Refused(error.to_string()))?
            .install(|| runs.par_iter().map(run).collect::<Result<_, _>>()),
    }?;
    let own = found[0].clone().unwrap_or_default();
    let slope = |k: usize, j: usize| {
        let [below, above] = [1, 2].map(|side| found[2 * j + side].as_ref().map(|run| run[k]));
        let [low, high] = [below, above].map(|value| value.unwrap_or(own[k]));
        let steps = [below, above].iter().flatten().count() as f64;
        (high - low) / (steps * sides[j].change)
    };
    let derivatives =
        (0..samples.len()).map(|k| (0..parameters.len()).map(|j| slope(k, j)).collect());
    let derivatives = derivatives.collect();
    let means = Means::Differences { why };
    Ok(ColumnJacobian { values: own, derivatives, means, one_sided: Vec::new() })
}

/// The scenario with a parameter changed to both sides.
struct Sides {
    /// Below and above, shape (2); none where the scenario cannot have the value.
    models: [Option<Compiled>; 2],
    change: f64,
}

fn sides_of(scenario: &Scenario, compiled: &Compiled, path: &str) -> Result<Sides, Fault> {
    let field = scenario.field(path)?;
    let mut scenario = scenario.clone();
    let Some((value, _)) = scenario.number(&field) else {
        return Err(Fault::new(path, "no number of this scenario", "a number it has"));
    };
    let change = SHARE * if value == 0.0 { 1.0 } else { value.abs() };
    let mut side = |sign: f64| {
        scenario.set_number(&field, value + sign * change).ok()?;
        scenario.compile().ok()
    };
    let models = [side(-1.0), side(1.0)];
    let end = compiled.settings.end;
    let differs = |one: &Compiled| Settings { end, ..one.settings } != compiled.settings;
    if models.iter().flatten().any(differs) {
        let found = "a setting of the computation, whose effect on a result is an error";
        return Err(Fault::new(path, found, "a number of the model, or the end of the run"));
    }
    if models.iter().all(Option::is_none) {
        let found = "a value that cannot change to either side";
        return Err(Fault::new(path, found, "a value within the limits of the scenario"));
    }
    Ok(Sides { models, change })
}

fn values(
    scenario: &Scenario,
    compiled: &Compiled,
    samples: &[ColumnSample],
) -> Result<Vec<f64>, SensitivityError> {
    let (model, settings) = (&compiled.model, &compiled.settings);
    let (summary, values) = simulate_with_columns(model, settings, samples)
        .map_err(|faults| SensitivityError::Faults(scenario.diagnostics(faults)))?;
    match &summary.termination {
        Termination::Completed => Ok(values),
        Termination::Failed(error) => Err(SensitivityError::Run(error.code(), error.to_string())),
        _ => Err(SensitivityError::Run(AnalysisCode::Broken, "the run was not completed".into())),
    }
}

/// Columns that the history does not have.
pub(crate) fn check(
    scenario: &Scenario,
    compiled: &Compiled,
    samples: &[ColumnSample],
) -> Result<(), Diagnostics> {
    let channels = columns_of(compiled).map_err(|faults| scenario.diagnostics(faults))?;
    let known = |name: &str| channels.iter().any(|channel| channel.name == name);
    let mut faults: Vec<Fault> = Vec::new();
    for sample in samples.iter().filter(|sample| !known(&sample.column)) {
        let fault = unknown_column(&sample.column, &channels);
        if !faults.contains(&fault) {
            faults.push(fault);
        }
    }
    if faults.is_empty() { Ok(()) } else { Err(scenario.diagnostics(faults)) }
}
