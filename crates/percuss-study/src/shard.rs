//! Shards: a few hundred runs, the unit of work.

use std::panic::{AssertUnwindSafe, catch_unwind};

use percuss::{Fault, Model, RunSummary, Settings, Termination};
use percuss_batch::{Detail, simulate_batch};
use percuss_codes::{AnalysisCode, Code};
use percuss_output::{SummaryPath, pick};
use percuss_scenario::{Compiled, in_one_line};

use crate::column::{Table, Values};
use crate::detail::detail_for;
use crate::error::Error;
use crate::parameter::Input;
use crate::parquet;
use crate::prepare::Preparer;
use crate::study::Study;

/// Runs given to the solver together.
pub(crate) const GROUP_RUNS: usize = 64;

/// Rows of some consecutive runs of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Shard {
    /// Its number.
    pub index: u64,
    /// Its rows, one a run.
    pub table: Table,
}

/// A run before it has its row.
pub(crate) type Ready = Result<Compiled, String>;
/// What became of a run: its summary, or why there is none and whether the scenario is to blame.
pub(crate) type Outcome = Result<RunSummary, String>;

impl Study {
    /// Does the runs of a shard, one after the other; the same bits wherever and whenever it is called.
    pub fn run_shard(&self, index: u64) -> Shard {
        self.run_shard_while(index, &|| true).unwrap_or_else(|| Shard::empty(self, index))
    }

    /// The same, unless `goes_on` says no on the way; it is asked every few runs.
    pub fn run_shard_while(&self, index: u64, goes_on: &dyn Fn() -> bool) -> Option<Shard> {
        let mut shard = Shard::empty(self, index);
        let mut preparer = Preparer::new(self);
        let paths: Vec<SummaryPath> = self.results.iter().map(|r| r.path.clone()).collect();
        let detail = detail_for(&paths);
        let runs: Vec<u64> = self.runs_of(index).collect();
        for group in runs.chunks(GROUP_RUNS) {
            if !goes_on() {
                return None;
            }
            let inputs: Vec<Vec<Input<'_>>> = group.iter().map(|run| self.inputs(*run)).collect();
            let ready: Vec<Ready> = inputs.iter().map(|inputs| preparer.prepare(inputs)).collect();
            let outcomes = simulate(&ready, detail);
            for ((run, inputs), outcome) in group.iter().zip(&inputs).zip(outcomes) {
                shard.push(*run, inputs, outcome, &paths);
            }
        }
        Some(shard)
    }
}

/// Simulates those that are ready; the others keep their reasons.
pub(crate) fn simulate(ready: &[Ready], detail: Detail) -> Vec<(Outcome, &'static str)> {
    let valid: Vec<&Compiled> = ready.iter().filter_map(|run| run.as_ref().ok()).collect();
    let solve = |given: &Given<'_>| simulate_batch(given, detail);
    let mut done = batch(&valid, &solve).into_iter();
    let outcome = |run: &Ready| match run {
        Err(reason) => (Err(reason.clone()), "invalid"),
        Ok(_) => match done.next() {
            Some(Ok(summary)) => {
                let status = match summary.termination {
                    Termination::Completed => "completed",
                    _ => "failed",
                };
                (Ok(summary), status)
            }
            Some(Err((reason, status))) => (Err(reason), status),
            None => (Err(broken("no result")), "failed"),
        },
    };
    ready.iter().map(outcome).collect()
}

/// Models and settings, and what a solver makes of them.
type Given<'g> = [(&'g Model, &'g Settings)];
type Solved = Vec<Result<RunSummary, Vec<Fault>>>;

/// Simulates all; if the solver breaks down on one of them, each alone, so that only that one is lost.
fn batch(
    runs: &[&Compiled],
    solve: &dyn Fn(&Given<'_>) -> Solved,
) -> Vec<Result<RunSummary, (String, &'static str)>> {
    let given: Vec<(&Model, &Settings)> = runs.iter().map(|c| (&c.model, &c.settings)).collect();
    let refused = |faults: Vec<Fault>| {
        (faults.iter().map(in_one_line).collect::<Vec<_>>().join("; "), "invalid")
    };
    let done = catch_unwind(AssertUnwindSafe(|| solve(&given)));
    match (done, runs) {
        (Ok(done), _) => done.into_iter().map(|one| one.map_err(refused)).collect(),
        (Err(_), [_]) => vec![Err((broken("internal error in the solver"), "failed"))],
        (Err(_), _) => runs.iter().flat_map(|run| batch(&[run], solve)).collect(),
    }
}

/// A fault of this program, not of the scenario.
fn broken(text: &str) -> String {
    Code::from(AnalysisCode::Broken).behind(text)
}

impl Shard {
    fn empty(study: &Study, index: u64) -> Self {
        let (columns, values) = study.layout().into_iter().unzip();
        Self { index, table: Table { columns, values } }
    }

    /// Appends the row of a run.
    fn push(
        &mut self,
        run: u64,
        inputs: &[Input<'_>],
        (outcome, status): (Outcome, &str),
        paths: &[SummaryPath],
    ) {
        let mut row = Row(self.table.values.iter_mut());
        row.whole(i64::try_from(run).unwrap_or(i64::MAX));
        for input in inputs {
            match input {
                Input::Number(number) => row.number(*number),
                Input::Word(word) => row.text(word_of(word)),
            }
        }
        let summary = outcome.as_ref().ok();
        // What a run that failed has reached on its way is not a result.
        match summary.filter(|_| status == "completed") {
            Some(summary) => pick(paths, summary).into_iter().for_each(|x| row.number(x)),
            None => paths.iter().for_each(|_| row.number(f64::NAN)),
        }
        row.text(status.to_string());
        row.text(match &outcome {
            Err(reason) => reason.clone(),
            Ok(summary) => match &summary.termination {
                Termination::Failed(error) => Code::from(error.code()).behind(error),
                _ => String::new(),
            },
        });
        row.number(summary.map_or(f64::NAN, |s| s.time));
        row.number(summary.map_or(f64::NAN, |s| s.energy.residual_max));
        row.number(summary.map_or(f64::NAN, |s| s.momentum.linear_residual_max));
        row.number(summary.map_or(f64::NAN, |s| s.momentum.angular_residual_max));
        row.whole(summary.map_or(0, |s| s.steps as i64));
        row.whole(summary.map_or(0, |s| s.step_cuts as i64));
        row.whole(summary.map_or(0, |s| s.newton_iterations as i64));
        let ended = summary.filter(|_| status == "completed");
        for path in paths.iter().filter(|path| path.may_stay_open()) {
            row.number(ended.map_or(f64::NAN, |summary| path.open_value(summary)));
        }
    }

    /// The shard as a file.
    ///
    /// # Errors
    /// If the table cannot be encoded.
    pub fn to_parquet(&self, study: &Study) -> Result<Vec<u8>, Error> {
        parquet::shard_bytes(self.index, &self.table, study)
    }

    /// Reads the shard from a file.
    ///
    /// # Errors
    /// If it is damaged, or of another study.
    pub fn from_parquet(bytes: &[u8], study: &Study) -> Result<Self, Error> {
        let (index, table) = parquet::shard_from(bytes, study)?;
        Ok(Self { index, table })
    }
}

/// A text without its quotes; other values as they stand.
fn word_of(toml: &str) -> String {
    let bare = toml.trim();
    let quoted = |mark: char| bare.strip_prefix(mark)?.strip_suffix(mark);
    quoted('"').or_else(|| quoted('\'')).unwrap_or(bare).to_string()
}

/// A row being filled from left to right.
struct Row<'t>(std::slice::IterMut<'t, Values>);

impl Row<'_> {
    fn whole(&mut self, value: i64) {
        if let Some(Values::Whole(column)) = self.0.next() {
            column.push(value);
        }
    }

    fn number(&mut self, value: f64) {
        if let Some(Values::Number(column)) = self.0.next() {
            column.push(value);
        }
    }

    fn text(&mut self, value: String) {
        if let Some(Values::Text(column)) = self.0.next() {
            column.push(value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLIGHT: &str = r#"
        [projectile.ball]
        kind = "elastic"
        contact = "surface"
        mass = 1
        radius = "1 cm"
        position = [0, 0]
        velocity = [1, 0]
        stiffness = 1e6
        strikes = "wall"
        [obstacle.wall]
        kind = "half-plane"
        point = [1, 0]
        normal = [-1, 0]
        [time]
        end = "1 ms"
        step = "0.1 ms"
    "#;

    #[test]
    fn a_solver_that_breaks_down_loses_its_own_run_alone() {
        let compiled = [1.0, 2.0].map(|end| {
            let text = FLIGHT.replace("\"1 ms\"", &format!("\"{end} ms\""));
            let scenario =
                percuss_scenario::read(&text, "f.toml").unwrap_or_else(|f| panic!("{f}"));
            scenario.compile().unwrap_or_else(|f| panic!("{f}"))
        });
        let breaks = |settings: &Settings| settings.end > 1.5e-3;
        let solve = |given: &Given<'_>| {
            assert!(!given.iter().any(|(_, settings)| breaks(settings)), "meant");
            simulate_batch(given, Detail::Full)
        };
        let done = batch(&compiled.each_ref(), &solve);
        assert!(done[0].as_ref().is_ok_and(|run| run.steps == 10));
        let (reason, status) = done[1].as_ref().err().cloned().unwrap_or_default();
        assert_eq!((reason.as_str(), status), ("internal error in the solver [E114]", "failed"));
        assert_eq!(AnalysisCode::Broken.code(), "E114");
    }
}
