//! What is looked at while step and mesh are refined.

use percuss::{Channel, Fault, RunSummary};
use percuss_output::{SummaryPath, pick, summary_paths};
use percuss_scenario::Scenario;

use super::converged::ConvergeError;
use crate::resolve::result;

/// Results looked at where none are named: how their paths end.
const USUAL: [&str; 11] = [
    ".displacement_max.component_1.value",
    ".displacement_max.component_2.value",
    ".velocity_final[0]",
    ".velocity_final[1]",
    ".peak_force.value",
    ".impulse_total",
    ".moment_max.value",
    ".axial_max.value",
    ".shear_max.value",
    ".permanent_set",
    ".rotation",
];

/// A result: a number of the summary, or the value of largest magnitude of a column.
pub(super) struct Looked {
    /// Path in the summary, or name of the column.
    pub name: String,
    pub unit: &'static str,
    /// The path; none of a column.
    path: Option<SummaryPath>,
}

/// The results asked for, or the usual ones.
pub(super) fn results(
    scenario: &Scenario,
    wanted: &[String],
    summary: &RunSummary,
    channels: &[Channel],
) -> Result<Vec<Looked>, ConvergeError> {
    let mut faults = Vec::new();
    let of_summary = |path: SummaryPath| Looked {
        name: path.path().into(),
        unit: path.unit(),
        path: Some(path),
    };
    let mut find = |path: &str| match result(path, summary) {
        Ok(path) => Some(path),
        Err((found, expected)) => {
            faults.push(Fault::new(path, found, expected));
            None
        }
    };
    let found: Vec<Looked> = if wanted.is_empty() {
        let all = summary_paths(summary).into_iter().map(|one| one.path);
        // Which interval or hinge is the first may change with the mesh.
        let listed =
            |path: &str| [".intervals[", ".hinges["].iter().any(|list| path.contains(list));
        let usual = |path: &String| USUAL.iter().any(|end| path.ends_with(end)) && !listed(path);
        let all = all.filter(usual).filter_map(|path| find(&path));
        // What is zero but for round-off says nothing.
        let all = all.filter(|path| pick(std::slice::from_ref(path), summary)[0].abs() > 1e-12);
        all.map(of_summary).collect()
    } else {
        let one = |name: &String| match channels.iter().find(|channel| channel.name == *name) {
            Some(channel) => Some(Looked { name: name.clone(), unit: channel.unit, path: None }),
            None => find(name).map(of_summary),
        };
        wanted.iter().filter_map(one).collect()
    };
    if !faults.is_empty() {
        return Err(scenario.diagnostics(faults).into());
    }
    if found.is_empty() {
        let text = "the run has no usual results: name some, such as point.girder.mid.displacement_max.component_2.value";
        return Err(ConvergeError::Refused(text.into()));
    }
    Ok(found)
}

/// The results of a run, from its summary and its columns, in their order, shape (results).
pub(super) fn pick_all(all: &[Looked], summary: &RunSummary, columns: &[f64]) -> Vec<f64> {
    let paths: Vec<SummaryPath> = all.iter().filter_map(|one| one.path.clone()).collect();
    let (mut numbers, mut columns) = (pick(&paths, summary).into_iter(), columns.iter().copied());
    let next = |one: &Looked| match one.path {
        Some(_) => numbers.next(),
        None => columns.next(),
    };
    all.iter().filter_map(next).collect()
}

/// Values as they are compared. What is largest in magnitude may be so in either direction, at two supports say, and which of them wins is
/// chance: magnitudes are compared, with the sign that the finest run gives.
pub(super) fn compared(one: &Looked, values: &[f64], finest: f64) -> Vec<f64> {
    match one.path.is_none() || one.name.contains("_max.") {
        true => values.iter().map(|value| value.abs().copysign(finest)).collect(),
        false => values.to_vec(),
    }
}
