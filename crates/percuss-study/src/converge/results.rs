//! What is looked at while step and mesh are refined.

use percuss::{Fault, RunSummary};
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

/// The results asked for, or the usual ones.
pub(super) fn paths(
    scenario: &Scenario,
    wanted: &[String],
    summary: &RunSummary,
) -> Result<Vec<SummaryPath>, ConvergeError> {
    let mut faults = Vec::new();
    let mut find = |path: &str| match result(path, summary) {
        Ok(path) => Some(path),
        Err((found, expected)) => {
            faults.push(Fault::new(path, found, expected));
            None
        }
    };
    let found: Vec<SummaryPath> = if wanted.is_empty() {
        let all = summary_paths(summary).into_iter().map(|one| one.path);
        // Which interval or hinge is the first may change with the mesh.
        let listed =
            |path: &str| [".intervals[", ".hinges["].iter().any(|list| path.contains(list));
        let usual = |path: &String| USUAL.iter().any(|end| path.ends_with(end)) && !listed(path);
        let all = all.filter(usual).filter_map(|path| find(&path));
        // What is zero but for round-off says nothing.
        all.filter(|path| pick(std::slice::from_ref(path), summary)[0].abs() > 1e-12).collect()
    } else {
        wanted.iter().filter_map(|path| find(path)).collect()
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

/// Values as they are compared. What is largest in magnitude may be so in either direction, at two supports say, and which of them wins is
/// chance: magnitudes are compared, with the sign that the finest run gives.
pub(super) fn compared(path: &SummaryPath, values: &[f64], finest: f64) -> Vec<f64> {
    match path.path().contains("_max.") {
        true => values.iter().map(|value| value.abs().copysign(finest)).collect(),
        false => values.to_vec(),
    }
}
