//! `percuss converge`.

use percuss_codes::{Caution, RequestCode};
use percuss_study::{Cheapest, ConvergeError, Converged, Convergence, Ladder, Sequence, converge};
use serde_json::{Value, json};

use crate::arguments::Converge;
use crate::interrupt;
use crate::number::number;
use crate::outcome::{Failure, Status};
use crate::progress::Progress;
use crate::{scenario, terminal};

/// Repeats a run with smaller steps and finer meshes, and prints the limits of its results.
pub fn run(arguments: &Converge) -> Result<Status, Failure> {
    let ready = scenario::read(&arguments.file, &arguments.set)?;
    interrupt::end_between_steps();
    let ladder = Ladder {
        results: arguments.result.clone(),
        refine: Vec::new(),
        levels: usize::from(arguments.levels),
        accuracy: arguments.accuracy,
    };
    let bar = (!arguments.quiet).then(|| Progress::of_things("converge", 1));
    let tell = |done: usize, runs: usize| {
        let Some(bar) = &bar else { return };
        bar.expect(runs as u64);
        bar.reach(done as u64);
    };
    let found = converge(&ready.scenario, &ladder, &|| !interrupt::requested(), &tell);
    drop(bar);
    let found = match found {
        Ok(found) => found,
        Err(ConvergeError::Faults(faults)) => {
            let changed = !arguments.set.is_empty();
            return Err(Failure::Faults { faults: Box::new(faults), changed });
        }
        Err(ConvergeError::Refused(reason)) => {
            return Err(Failure::input(RequestCode::Levels, reason));
        }
        Err(ConvergeError::Run(code, reason)) => {
            terminal::error(code, &format!("a finer run did not converge: {reason}"));
            return Ok(Status::GaveUp);
        }
        Err(ConvergeError::Interrupted) => {
            let text = "interrupted; too few levels for an estimate";
            terminal::warning(Caution::Interrupted, text);
            return Ok(Status::Interrupted);
        }
    };
    if arguments.json {
        terminal::print(&format!("{:#}\n", value(&found)))?;
    } else {
        terminal::print(&table(&found))?;
    }
    Ok(Status::Done)
}

fn value(found: &Convergence) -> Value {
    json!({
        "steps": found.steps,
        "elements": found.elements,
        "fibres": found.fibres,
        "results": found.results.iter().map(result).collect::<Vec<_>>(),
        "cheapest": found.cheapest.as_ref().map(cheapest),
    })
}

fn result(one: &Converged) -> Value {
    json!({
        "path": one.path,
        "unit": one.unit,
        "value": one.value,
        "limit": one.limit,
        "uncertainty": one.uncertainty,
        "step": sequence(&one.step),
        "mesh": sequence(&one.mesh),
        "fibres": sequence(&one.fibres),
        "together": sequence(&one.together),
    })
}

fn sequence(one: &Sequence) -> Value {
    let limit = if one.no_limit { f64::NAN } else { one.found.limit };
    json!({
        "values": one.values,
        "order": one.found.order.filter(|_| !one.no_limit),
        "limit": limit,
        "uncertainty": if one.no_limit { f64::NAN } else { one.found.uncertainty },
        "words": one.words,
    })
}

fn cheapest(one: &Cheapest) -> Value {
    json!({
        "accuracy": one.accuracy,
        "step": one.step,
        "mesh_factor": one.mesh_factor,
        "elements": one.elements,
        "fibre_factor": one.fibre_factor,
        "cost": one.cost,
        "out_of_reach": one.out_of_reach,
    })
}

fn table(found: &Convergence) -> String {
    let ends = |all: Vec<String>| format!("{} to {}", all[0], all[all.len() - 1]);
    let steps = ends(found.steps.iter().map(|step| number(*step)).collect());
    let elements = ends(found.elements.iter().map(ToString::to_string).collect());
    let yields = found.fibres.len() > 1;
    let mut text = format!("steps of {steps} s; {elements} elements");
    if yields {
        text +=
            &format!("; {} fibres", ends(found.fibres.iter().map(ToString::to_string).collect()));
    }
    text += "\n";
    for one in &found.results {
        let unit = if one.unit == "1" { String::new() } else { one.unit.replace('*', " ") };
        let value = format!("{} = {} {unit}", one.path, number(one.value));
        text += &match one.limit.is_nan() {
            true => format!("{}: no limit\n", value.trim_end()),
            false => {
                let off = format!("{:.1e}", one.uncertainty).parse().unwrap_or(one.uncertainty);
                let (limit, off) = (number(one.limit), number(off));
                format!("{}, limit {limit} +- {off}\n", value.trim_end())
            }
        };
        text += &format!("  step: {}\n  mesh: {}\n", one.step.words, one.mesh.words);
        if yields {
            text += &format!("  fibres: {}\n", one.fibres.words);
        }
        text += &format!("  together: {}\n", one.together.words);
    }
    if let Some(cheapest) = &found.cheapest {
        text += &advice(cheapest, found.results.len());
    }
    text
}

fn advice(cheapest: &Cheapest, results: usize) -> String {
    let percent = number(100.0 * cheapest.accuracy);
    let fibres = match cheapest.fibre_factor {
        1.0 => String::new(),
        times => format!("{} times the fibres, ", number(times)),
    };
    let of = match cheapest.out_of_reach.len() {
        0 => String::new(),
        more => format!(", for {} of {results} results", results.saturating_sub(more)),
    };
    let mut text = match cheapest.step.is_nan() {
        true => format!("no settings found for {percent} %\n"),
        false => format!(
            "least work for an error of {percent} %{of}: time.step = {}, {} elements ({}), {fibres}{}\n",
            number(cheapest.step),
            number(cheapest.elements),
            times(cheapest.mesh_factor, "as in the file", "times as many"),
            times(cheapest.cost, "as much work as with the file's settings", "times the work"),
        ),
    };
    for one in &cheapest.out_of_reach {
        text += &format!("  not {one}\n");
    }
    text
}

/// A factor in words: `as it is` for one.
fn times(factor: f64, same: &str, more: &str) -> String {
    match number(factor).as_str() {
        "1" => same.to_owned(),
        factor => format!("{factor} {more}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Settings for some of the results are not given as if they held for all.
    #[test]
    fn settings_name_how_many_results_they_hold_for() {
        let cheapest = |out_of_reach: Vec<String>| Cheapest {
            accuracy: 0.02,
            step: 1e-4,
            mesh_factor: 1.0,
            elements: 20.0,
            fibre_factor: 1.0,
            cost: 1.0,
            out_of_reach,
        };
        let all = advice(&cheapest(Vec::new()), 3);
        assert_eq!(
            all,
            "least work for an error of 2 %: time.step = 1e-4, 20 elements (as in the file), as much work as with the file's settings\n"
        );
        let some = advice(&cheapest(vec!["a: no order".into(), "b: no order".into()]), 3);
        let begins = "least work for an error of 2 %, for 1 of 3 results: time.step = ";
        assert!(some.starts_with(begins), "{some}");
        assert!(some.ends_with("  not a: no order\n  not b: no order\n"), "{some}");
    }
}
