//! A study: everything that its runs follow from.

use percuss_scenario::Scenario;
use percuss_scenario::study::StudyContent;
use sha2::{Digest, Sha256};

use crate::column::{Column, Role, Values};
use crate::design::{Design, Kind};
use crate::parameter::{Input, Parameter, Variation};
use crate::result_path::ResultPath;

/// Runs of a shard at most.
const SHARD_RUNS: u64 = 256;
/// Runs of a shard at least: as many as go into the vector lanes of the solver.
const LANE_RUNS: u64 = 8;
/// Shards of a study of middling size, so that every core has some to do and an interruption costs little.
const SHARDS: u64 = 64;

/// What the columns of values that a closed contact leaves open are called, before the name of the result.
pub(crate) const OPEN: &str = "open.";

/// Many runs of one scenario, some of whose values change from run to run.
///
/// It needs no file: the text of the base scenario is part of it.
#[derive(Clone, Debug)]
pub struct Study {
    pub(crate) content: StudyContent,
    pub(crate) scenario: Scenario,
    /// Its parameters, shape (parameters).
    pub(crate) parameters: Vec<Parameter>,
    /// Its results, shape (results).
    pub(crate) results: Vec<ResultColumn>,
    pub(crate) design: Design,
    fingerprint: String,
}

/// A result wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultColumn {
    /// The user's name for it.
    pub name: String,
    /// Where it stands in a summary, or the column it is taken from.
    pub path: ResultPath,
}

impl Study {
    pub(crate) fn new(
        content: StudyContent,
        scenario: Scenario,
        parameters: Vec<Parameter>,
        results: Vec<ResultColumn>,
        design: Design,
    ) -> Self {
        let fingerprint = fingerprint(&content.to_toml(), &build());
        Self { content, scenario, parameters, results, design, fingerprint }
    }

    /// The study as one text that names no other file; read again it is the same study.
    pub fn to_toml(&self) -> String {
        self.content.to_toml()
    }

    /// One line about the study; empty if it has none.
    pub fn title(&self) -> &str {
        &self.content.title
    }

    /// What all its runs follow from, in 64 hexadecimal digits; another study, another version and another build of the mechanics have
    /// another one.
    pub fn fingerprint(&self) -> &str {
        &self.fingerprint
    }

    /// The base scenario.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// What varies.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The results wanted.
    pub fn results(&self) -> &[ResultColumn] {
        &self.results
    }

    /// Whether its runs are arranged for Sobol indices.
    pub fn has_sobol_indices(&self) -> bool {
        self.design.sobol_indices
    }

    /// Whether its points fill the ranges more evenly than independent draws would.
    pub fn is_spread_evenly(&self) -> bool {
        matches!(self.design.kind, Kind::Sobol | Kind::LatinHypercube)
    }

    /// Whether every combination of values is run.
    pub fn is_grid(&self) -> bool {
        self.design.kind == Kind::Grid
    }

    /// Points of the design; each one run, or with Sobol indices 2 runs and one more a parameter, one after the other.
    pub fn point_count(&self) -> u64 {
        self.design.points
    }

    /// The seed.
    pub fn seed(&self) -> u64 {
        self.design.seed
    }

    /// Number of runs.
    pub fn run_count(&self) -> u64 {
        self.design.runs()
    }

    /// Runs of every shard but the last one, which may have fewer.
    pub fn shard_runs(&self) -> u64 {
        let fair = self.run_count().div_ceil(SHARDS).next_multiple_of(LANE_RUNS);
        fair.clamp(LANE_RUNS, SHARD_RUNS)
    }

    /// Number of shards.
    pub fn shard_count(&self) -> u64 {
        self.run_count().div_ceil(self.shard_runs())
    }

    /// Numbers of the runs of a shard.
    pub fn runs_of(&self, shard: u64) -> std::ops::Range<u64> {
        let start = (shard * self.shard_runs()).min(self.run_count());
        start..(start + self.shard_runs()).min(self.run_count())
    }

    /// Values of the parameters in a run.
    pub fn inputs(&self, run: u64) -> Vec<Input<'_>> {
        if self.design.kind == Kind::Grid {
            let combination = self.design.combination(run);
            let levels = self.parameters.iter().zip(combination);
            return levels.map(|(p, k)| p.variation.level(k)).collect();
        }
        let point = self.design.point(run);
        self.parameters.iter().zip(point).map(|(p, u)| p.variation.at(u)).collect()
    }

    /// Columns of its tables.
    pub fn columns(&self) -> Vec<Column> {
        self.layout().into_iter().map(|(column, _)| column).collect()
    }

    /// Columns with an empty column of values each.
    pub(crate) fn layout(&self) -> Vec<(Column, Values)> {
        let column = |name: &str, unit: &str, role, about: &str| Column {
            name: name.into(),
            unit: unit.into(),
            role,
            about: about.into(),
        };
        let whole = Values::Whole(Vec::new());
        let (number, text) = (Values::Number(Vec::new()), Values::Text(Vec::new()));
        let mut all = vec![(column("run", "1", Role::Run, "number of the run"), whole.clone())];
        for parameter in &self.parameters {
            let values = match parameter.variation {
                Variation::Words(_) => text.clone(),
                _ => number.clone(),
            };
            let path = parameter.field.path();
            all.push((column(&parameter.name, &parameter.unit, Role::Input, path), values));
        }
        for result in &self.results {
            let (unit, path) = (result.path.unit(), result.path.path());
            all.push((column(&result.name, unit, Role::Result, path), number.clone()));
        }
        let status = "completed, failed (no convergence) or invalid (the scenario has errors)";
        all.push((column("status", "1", Role::Status, status), text.clone()));
        all.push((column("reason", "1", Role::Reason, "reason of a failed or invalid run"), text));
        for (name, unit, about, values) in [
            ("audit.time", "s", "time", &number),
            ("audit.energy_residual", "1", "energy.residual_max", &number),
            ("audit.linear_momentum_residual", "1", "momentum.linear_residual_max", &number),
            ("audit.angular_momentum_residual", "1", "momentum.angular_residual_max", &number),
            ("audit.steps", "1", "steps", &whole),
            ("audit.step_cuts", "1", "step_cuts", &whole),
            ("audit.newton_iterations", "1", "newton_iterations", &whole),
        ] {
            all.push((column(name, unit, Role::Audit, about), values.clone()));
        }
        for result in self.results.iter().filter(|result| result.path.may_stay_open()) {
            let about = match result.path.only_grows() {
                true => "least value where its contact is still closed at the end",
                false => "value at the end where a contact is still closed then",
            };
            let name = format!("{OPEN}{}", result.name);
            all.push((column(&name, result.path.unit(), Role::Open, about), number.clone()));
        }
        all
    }
}

/// Version and hashes of the sources that compute: those of single runs and those of runs side by side.
fn build() -> String {
    let hash = percuss_batch::BUILD.split_once('+').map_or("", |(_, hash)| hash);
    format!("{}+{hash}", percuss::BUILD)
}

/// What the runs of a study follow from: its text, and the program that runs them.
fn fingerprint(text: &str, build: &str) -> String {
    let mut hash = Sha256::new();
    for part in [text, env!("CARGO_PKG_VERSION"), build] {
        hash.update(part);
        hash.update([0]);
    }
    hex(&hash.finalize())
}

/// Bytes as hexadecimal digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_builds_of_one_version_have_two_fingerprints() {
        let [one, other] = ["0.1.0+a", "0.1.0+b"].map(|build| fingerprint("seed = 1", build));
        assert_ne!(one, other);
        assert_eq!(one, fingerprint("seed = 1", "0.1.0+a"));
        let build = build();
        let parts: Vec<&str> = build.split('+').collect();
        assert!(parts[0] == env!("CARGO_PKG_VERSION") && parts.len() == 3, "{build}");
        assert!(parts[1..].iter().all(|hash| hash.len() == 32), "{build}");
    }
}
