//! Starting values with which a scenario is not valid.

use percuss::Fault;
use percuss_scenario::fit::FitContent;
use percuss_scenario::{Field, Scenario};

use crate::parameter::Adjustable;

/// Fields of a scenario that parameters change, each with the index of its parameter.
type ChangedFields = Vec<(usize, Field)>;

/// Faults of the scenarios of the tests at the starting values, each at the value that causes it. Scenarios that are not valid without them are
/// left out.
pub(super) fn starts_at_fault(
    content: &FitContent,
    (adjustables, fields): (&[Adjustable], &[ChangedFields]),
    scenarios: &[Scenario],
) -> Vec<Fault> {
    let mut faults = Vec::new();
    for (scenario, fields) in scenarios.iter().zip(fields) {
        let wrong = |which: &dyn Fn(usize) -> bool| {
            wrong(scenario, fields.iter().filter(|(k, _)| which(*k)), adjustables)
        };
        let Some(together) = wrong(&|_| true) else { continue };
        if scenario.compile().is_err() {
            continue;
        }
        let single = adjustables.iter().enumerate().filter_map(|(k, one)| {
            let fault = wrong(&|other| other == k)?;
            let given = content.parameter.iter().find(|given| given.name == one.name);
            let key = match given.map(|given| (&given.table.start, &given.table.path)) {
                Some((Some(_), _)) => "start",
                Some((None, Some(_))) => "path",
                _ => "paths",
            };
            Some(Fault { path: format!("parameter.{}.{key}", one.name), ..fault })
        });
        let single: Vec<Fault> = single.collect();
        let all = if single.is_empty() { vec![together] } else { single };
        let new: Vec<Fault> = all.into_iter().filter(|one| !faults.contains(one)).collect();
        faults.extend(new);
    }
    faults
}

/// What is wrong with a scenario in which some numbers have their starting values.
fn wrong<'f>(
    scenario: &Scenario,
    fields: impl Iterator<Item = &'f (usize, Field)>,
    adjustables: &[Adjustable],
) -> Option<Fault> {
    let mut scenario = scenario.clone();
    let mut paths = Vec::new();
    for (k, field) in fields {
        if let Err(fault) = scenario.set_number(field, adjustables[*k].start) {
            return Some(Fault { path: "parameter".into(), ..fault });
        }
        paths.push(field.path());
    }
    if paths.is_empty() {
        return None;
    }
    let faults = scenario.compile().err()?;
    let first = faults.all().first()?;
    let own = paths.contains(&first.path.as_str());
    let place = if own { String::new() } else { format!(" in `{}`", first.path) };
    Some(Fault::new("parameter", format!("{}{place}", first.message), first.help.clone()))
}
