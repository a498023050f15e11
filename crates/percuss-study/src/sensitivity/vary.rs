//! Models in which a parameter is changed.

use percuss::{Fault, Settings};
use percuss_batch::Difference;
use percuss_scenario::{Compiled, Diagnostics, Field, Scenario};

use super::Differentiated;
use crate::prepare::in_one_line;

/// Largest change of a parameter over which the numbers of the model are differentiated, as a share of its size. Where they follow from its size
/// alone, the error of the fourth-order difference lies at round-off.
const SHARE: f64 = 1e-3;

/// Share of a change that the next smaller one has, and number of changes at most, where the first do not agree: numbers that change over a length far
/// below the coordinate that is the parameter. The error of a difference becomes 4096 times smaller, its round-off 8 times larger.
const CLOSER: f64 = 0.125;
const MOST_DIFFERENCES: i32 = 8;

/// The parameters, and how each of them is varied, in their order.
pub(super) fn vary_all(
    scenario: &Scenario,
    compiled: &Compiled,
    parameters: &[String],
) -> Result<(Vec<Differentiated>, Vec<percuss_batch::Variation>), Diagnostics> {
    let (mut differentiated, mut variations) = (Vec::new(), Vec::new());
    let mut faults = Vec::new();
    for path in parameters {
        match vary(scenario, compiled, path) {
            Ok((parameter, variation)) => {
                differentiated.push(parameter);
                variations.push(variation);
            }
            Err(fault) => faults.push(fault),
        }
    }
    if !faults.is_empty() {
        return Err(scenario.diagnostics(faults));
    }
    Ok((differentiated, variations))
}

/// A parameter, and the models it makes when it changes: ever less, until the differences of their numbers agree.
fn vary(
    scenario: &Scenario,
    compiled: &Compiled,
    path: &str,
) -> Result<(Differentiated, percuss_batch::Variation), Fault> {
    let field = scenario.field(path)?;
    let mut scenario = scenario.clone();
    let Some((value, unit)) = scenario.number(&field) else {
        return Err(Fault::new(path, "no number of this scenario", "a number it has"));
    };
    let size = if value == 0.0 { 1.0 } else { value.abs() };
    let mut variation = percuss_batch::Variation { size, differences: Vec::new() };
    let mut refused = None;
    for closer in 0..MOST_DIFFERENCES {
        let change = SHARE * CLOSER.powi(closer) * size;
        match changed(&mut scenario, &field, value, change) {
            Ok(difference) => variation.differences.push(difference),
            Err(fault) => {
                refused.get_or_insert(fault);
                continue;
            }
        }
        if variation.agrees(&compiled.model, &compiled.settings) {
            break;
        }
    }
    match refused {
        Some(fault) if variation.differences.is_empty() => Err(fault),
        _ => {
            let parameter = Differentiated { path: path.into(), value, unit: unit.into() };
            Ok((parameter, variation))
        }
    }
}

/// The models of a number changed to either side.
fn changed(
    scenario: &mut Scenario,
    field: &Field,
    value: f64,
    change: f64,
) -> Result<Difference, Fault> {
    let path = field.path();
    let mut made = |k: f64| {
        scenario.set_number(field, value + k * change)?;
        scenario.compile().map_err(|faults| {
            let found = format!(
                "a value next to one that the scenario cannot have ({})",
                in_one_line(&faults)
            );
            Fault::new(path, found, "a value that may change to either side")
        })
    };
    let all = [made(-2.0)?, made(-1.0)?, made(1.0)?, made(2.0)?];
    let ends = all.each_ref().map(|one| one.settings.end);
    let settings = all.each_ref().map(|one| Settings { end: ends[0], ..one.settings });
    if settings.iter().any(|one| *one != settings[0]) {
        let found = "a setting of the computation, whose effect on a result is an error";
        let expected =
            "a number of the model, or the end of the run (for steps see `percuss converge`)";
        return Err(Fault::new(path, found, expected));
    }
    Ok(Difference { models: all.map(|one| one.model), ends, change })
}
