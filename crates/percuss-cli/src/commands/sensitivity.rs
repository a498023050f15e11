//! `percuss sensitivity`.

use percuss_batch::Onset;
use percuss_codes::{AnalysisCode, Caution};
use percuss_study::{Differentiated, OneSided, SensitivityError, Without, beyond, sensitivity};
use serde_json::{Value, json};

use crate::arguments::Sensitivity;
use crate::number::{number, small};
use crate::outcome::{Failure, Status};
use crate::{scenario, terminal};

/// Differentiates results of a scenario and prints them.
pub fn run(arguments: &Sensitivity) -> Result<Status, Failure> {
    let ready = scenario::read(&arguments.file, &arguments.set)?;
    let found = match sensitivity(&ready.scenario, &arguments.parameter, &arguments.result) {
        Ok(found) => found,
        Err(SensitivityError::Faults(faults)) => {
            let changed = !arguments.set.is_empty();
            return Err(Failure::Faults { faults: Box::new(faults), changed });
        }
        Err(SensitivityError::Refused(reason)) => {
            return Err(Failure::input(AnalysisCode::NoDerivative, reason));
        }
        Err(SensitivityError::Run(code, reason)) => {
            terminal::error(code, &reason);
            return Ok(Status::GaveUp);
        }
    };
    if arguments.json {
        terminal::print(&format!("{:#}\n", value(&found)))?;
    } else {
        terminal::print(&table(&found))?;
    }
    if let Some(horizon) = &found.horizon {
        terminal::warning(Caution::Horizon, &beyond(horizon));
    }
    let warn = |one: &OneSided| terminal::warning(Caution::OneSided, &one.text());
    found.one_sided.iter().for_each(warn);
    Ok(Status::Done)
}

fn value(found: &percuss_study::Sensitivity) -> Value {
    let one = |x: &Differentiated| json!({ "path": x.path, "value": x.value, "unit": x.unit });
    json!({
        "parameters": found.parameters.iter().map(one).collect::<Vec<_>>(),
        "results": found.results.iter().map(one).collect::<Vec<_>>(),
        "derivatives": found.derivatives,
        "uncertainties": found.uncertainties,
        "one_sided": found.one_sided.iter().map(one_sided).collect::<Vec<_>>(),
        "without": found.without.iter().map(without).collect::<Vec<_>>(),
        "horizon": found.horizon.as_ref().map(|h| json!({ "time": h.time, "why": h.why })),
    })
}

fn without(one: &Without) -> Value {
    json!({ "result": one.result, "parameter": one.parameter, "why": one.why })
}

fn one_sided(one: &OneSided) -> Value {
    let (kind, name) = match &one.onset {
        Onset::Contact(name) => ("contact", name),
        Onset::Yield(name) => ("beam", name),
    };
    json!({
        kind: name,
        "time": one.time,
        "appears": one.appears,
        "parameter": one.parameter,
        "change": one.change,
        "others": one.others,
        "text": one.text(),
    })
}

/// One block a result: its value, and a line for every parameter with the derivative, its uncertainty from the step and what one per
/// cent more would change, or why there is no derivative.
fn table(found: &percuss_study::Sensitivity) -> String {
    let width = found.parameters.iter().map(|p| p.path.len()).max().unwrap_or(0);
    let mut text = String::new();
    let rows = found.derivatives.iter().zip(&found.uncertainties);
    for (result, (derivatives, uncertainties)) in found.results.iter().zip(rows) {
        text += &format!("{} = {} {}\n", result.path, number(result.value), plain(&result.unit));
        let both = derivatives.iter().zip(uncertainties);
        for (parameter, both) in found.parameters.iter().zip(both) {
            let shown =
                missing(found, result, parameter).unwrap_or_else(|| known(result, parameter, both));
            text += &format!("  by {:width$}  {shown}\n", parameter.path);
        }
    }
    text
}

fn known(
    result: &Differentiated,
    parameter: &Differentiated,
    (derivative, uncertainty): (&f64, &f64),
) -> String {
    let share = 100.0 * derivative * 0.01 * parameter.value / result.value;
    let unit = quotient(&result.unit, &parameter.unit);
    let shown = format!("{:>13} +- {:<9}", number(*derivative), uncertain(*uncertainty));
    // Of nothing there is no per cent, nor of what one per cent of a parameter turns into its opposite or doubles.
    if share.abs() < 100.0 {
        format!("{shown} {unit:<14} effect of +1 %: {share:+.3} %")
    } else {
        format!("{shown} {unit}")
    }
}

fn missing(
    found: &percuss_study::Sensitivity,
    result: &Differentiated,
    parameter: &Differentiated,
) -> Option<String> {
    let is = |one: &&Without| one.result == result.path && one.parameter == parameter.path;
    found.without.iter().find(is).map(|one| format!("none: {}", one.why))
}

fn uncertain(x: f64) -> String {
    if x.is_nan() { "unknown".into() } else { small(x) }
}

fn plain(unit: &str) -> &str {
    if unit == "1" { "" } else { unit }
}

fn quotient(result: &str, parameter: &str) -> String {
    let result = if result.is_empty() { "1" } else { result };
    match plain(parameter) {
        "" => plain(result).into(),
        unit => format!("{result} per {unit}"),
    }
}
