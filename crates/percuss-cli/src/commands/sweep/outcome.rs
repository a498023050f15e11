//! What a study came to, on the terminal.

use std::collections::BTreeMap;
use std::path::Path;

use percuss_codes::Caution;
use percuss_study::analysis::{Estimate, NoIndices, Population, SobolIndices};
use percuss_study::{RESULTS, Study, Table};
use serde_json::{Map, Value, json};

use crate::arguments::Sweep;
use crate::number::{count, quantity};
use crate::outcome::Failure;
use crate::terminal;
use percuss_output::shown::FEW;

/// Says how the runs went and where the results are.
pub fn tell(
    study: &Study,
    table: &Table,
    indices: &[(String, Result<SobolIndices, NoIndices>)],
    arguments: &Sweep,
    out: &Path,
) -> Result<(), Failure> {
    let statuses = statuses(table);
    if arguments.json {
        let results: Map<String, Value> = ranges(study, table)
            .map(|(name, unit, values, [min, mean, max])| {
                let open = open(study, table, name);
                let range = json!({
                    "unit": unit, "values": values, "min": min, "mean": mean, "max": max,
                    "open": open.len(), "open_max": open.last()
                });
                (name.to_string(), range)
            })
            .collect();
        let mut value = json!({ "runs": table.rows(), "status": statuses, "results": results });
        if study.has_sobol_indices() {
            value["sobol_indices"] = sobol(study, indices);
            let whys = indices.iter().filter_map(|(name, found)| {
                found.as_ref().err().map(|why| (name.clone(), Value::from(why.to_string())))
            });
            value["sobol_indices_why"] = Value::Object(whys.collect());
        }
        terminal::print(&format!("{value:#}\n"))?;
    } else if !arguments.quiet {
        let completed = statuses.get("completed").copied().unwrap_or(0);
        let runs = count(table.rows(), "run");
        terminal::tell(&format!("{runs}, {completed} completed"));
        for (name, unit, values, [min, mean, max]) in ranges(study, table) {
            let [min, mean, max] = [min, mean, max].map(|value| quantity(value, unit));
            // A contact that did not close has no peak force.
            let of = match table.rows() {
                all if all == values => String::new(),
                _ => format!(" ({} with a value)", count(values, "run")),
            };
            terminal::tell(&format!("  '{name}': {min} to {max}, mean {mean}{of}"));
            let open = open(study, table, name);
            if let (Some(first), Some(last)) = (open.first(), open.last()) {
                let runs = count(open.len(), "run");
                let [first, last] = [first, last].map(|value| quantity(*value, unit));
                terminal::tell(&format!(
                    "    contact closed at the end in {runs}, values then {first} to {last}"
                ));
            }
        }
        for line in sobol_lines(study, indices) {
            terminal::tell(&line);
        }
        terminal::tell(&format!("{} and report.html", out.join(RESULTS).display()));
    }
    if !arguments.quiet {
        warn(table);
        for result in study.results() {
            let values = table.numbers(&result.name).unwrap_or_default();
            if statuses.contains_key("completed") && values.iter().all(|x| x.is_nan()) {
                let path = result.path.path();
                let text = format!("'{}': no run has {path}", result.name);
                terminal::warning(Caution::NoValues, &text);
            }
        }
    }
    Ok(())
}

/// Indices of every result as lines, or why it has none; nothing of a study that asks for none.
fn sobol_lines(
    study: &Study,
    indices: &[(String, Result<SobolIndices, NoIndices>)],
) -> Vec<String> {
    if !study.has_sobol_indices() {
        return Vec::new();
    }
    let line = |(name, found): &(String, Result<SobolIndices, NoIndices>)| match found {
        Err(why) => format!("  {name}: no Sobol' indices: {why}"),
        Ok(found) => {
            let both = found.first.iter().zip(&found.total);
            let each = study.parameters().iter().zip(both).map(|(parameter, (first, total))| {
                format!("{} {:.2}, {:.2}", parameter.name, first.value, total.value)
            });
            format!(
                "  {name}: Sobol' indices (first, total): {}",
                each.collect::<Vec<_>>().join("; ")
            )
        }
    };
    indices.iter().map(line).collect()
}

/// Indices of every result, by parameter; null of one that has none.
fn sobol(study: &Study, indices: &[(String, Result<SobolIndices, NoIndices>)]) -> Value {
    let estimate = |e: &Estimate| json!({ "value": e.value, "low": e.low, "high": e.high });
    let of = |found: &SobolIndices| -> Value {
        let both = found.first.iter().zip(&found.total);
        let each = study.parameters().iter().zip(both).map(|(parameter, (first, total))| {
            let one = json!({ "first": estimate(first), "total": estimate(total) });
            (parameter.name.clone(), one)
        });
        let parameters: Map<String, Value> = each.collect();
        json!({ "variance": found.variance, "points": found.points, "parameter": parameters })
    };
    let each = |found: &Result<SobolIndices, NoIndices>| found.as_ref().map_or(Value::Null, of);
    let all = indices.iter().map(|(name, found)| (name.clone(), each(found)));
    Value::Object(all.collect())
}

/// How often each status occurs.
fn statuses(table: &Table) -> BTreeMap<&str, usize> {
    let mut out = BTreeMap::new();
    for status in table.texts("status").unwrap_or_default() {
        *out.entry(status.as_str()).or_default() += 1;
    }
    out
}

/// What a result had come to in the runs that ended while a contact that leaves it open was closed, in ascending order.
fn open(study: &Study, table: &Table, result: &str) -> Vec<f64> {
    Population::of(study, table, result).map_or_else(Vec::new, |population| population.open)
}

/// Name, unit, number of values, and smallest, mean and largest one of every result that has values.
fn ranges<'s>(
    study: &'s Study,
    table: &'s Table,
) -> impl Iterator<Item = (&'s str, &'static str, usize, [f64; 3])> {
    study.results().iter().filter_map(|result| {
        let values = table.numbers(&result.name)?;
        let values: Vec<f64> = values.into_iter().filter(|x| x.is_finite()).collect();
        let min = values.iter().copied().reduce(f64::min)?;
        let max = values.iter().copied().reduce(f64::max)?;
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        Some((result.name.as_str(), result.path.unit(), values.len(), [min, mean, max]))
    })
}

/// The most frequent reasons why runs did not end well.
fn warn(table: &Table) {
    let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
    for reason in table.texts("reason").unwrap_or_default().iter().filter(|r| !r.is_empty()) {
        *reasons.entry(reason).or_default() += 1;
    }
    let mut reasons: Vec<(&str, usize)> = reasons.into_iter().collect();
    reasons.sort_by_key(|(_, times)| std::cmp::Reverse(*times));
    for (reason, times) in reasons.iter().take(FEW) {
        let text = format!("{}: {reason}", count(*times, "run"));
        terminal::warning(Caution::FailedRuns, &text);
    }
    if reasons.len() > FEW {
        let more = reasons[FEW..].iter().map(|(_, times)| times).sum();
        let text = format!("{} for other reasons; see the column `reason`", count(more, "run"));
        terminal::warning(Caution::FailedRuns, &text);
    }
}
