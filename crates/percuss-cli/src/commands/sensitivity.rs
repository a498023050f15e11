//! `percuss sensitivity`.

use percuss_study::{Differentiated, SensitivityError, sensitivity};
use serde_json::{Value, json};

use crate::arguments::Sensitivity;
use crate::number::number;
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
        Err(SensitivityError::Run(reason)) => {
            terminal::error(&reason);
            return Ok(Status::GaveUp);
        }
    };
    if arguments.json {
        terminal::print(&format!("{:#}\n", value(&found)))?;
    } else {
        terminal::print(&table(&found))?;
    }
    Ok(Status::Done)
}

fn value(found: &percuss_study::Sensitivity) -> Value {
    let one = |x: &Differentiated| json!({ "path": x.path, "value": x.value, "unit": x.unit });
    json!({
        "parameters": found.parameters.iter().map(one).collect::<Vec<_>>(),
        "results": found.results.iter().map(one).collect::<Vec<_>>(),
        "derivatives": found.derivatives,
    })
}

/// One block a result: its value, and a line for every parameter with the derivative and what one per cent more would change.
fn table(found: &percuss_study::Sensitivity) -> String {
    let width = found.parameters.iter().map(|p| p.path.len()).max().unwrap_or(0);
    let mut text = String::new();
    for (result, derivatives) in found.results.iter().zip(&found.derivatives) {
        text += &format!("{} = {} {}\n", result.path, number(result.value), plain(&result.unit));
        for (parameter, derivative) in found.parameters.iter().zip(derivatives) {
            let share = 100.0 * derivative * 0.01 * parameter.value / result.value;
            let unit = quotient(&result.unit, &parameter.unit);
            text += &format!(
                "  by {:width$}  {:>13} {unit:<14} 1 % more: {share:+.3} %\n",
                parameter.path,
                number(*derivative),
            );
        }
    }
    text
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
