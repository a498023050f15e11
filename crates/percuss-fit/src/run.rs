//! Runs of tests: their columns.

use std::panic::{AssertUnwindSafe, catch_unwind};

use percuss::{Channel, Fault, Flow, Recorder, RecorderError, Settings, Simulation, Termination};
use percuss_codes::AnalysisCode;
use percuss_scenario::{Compiled, Scenario, in_one_line};

use crate::curve::Curve;
use crate::error::Stop;

/// Least accuracy that steps are chosen for.
const LEAST: f64 = 1e-6;

/// Whether to go on, asked after every step from any thread.
pub(crate) type GoesOn<'g> = &'g (dyn Fn() -> bool + Sync);

/// Stores some columns.
struct Columns<'g> {
    /// Their names, shape (columns).
    names: &'g [String],
    /// Their places in a row, shape (columns) \[index of a channel\].
    places: Vec<usize>,
    /// Times of the rows, shape (n_row) \[s\].
    time: Vec<f64>,
    /// Their values, shape (columns, n_row) \[unit of the column\].
    values: Vec<Vec<f64>>,
    goes_on: GoesOn<'g>,
}

impl Recorder for Columns<'_> {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        let place = |name: &String| channels.iter().position(|channel| channel.name == *name);
        self.places = self.names.iter().filter_map(place).collect();
        Ok(())
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        self.time.push(values[0]);
        for (column, place) in self.values.iter_mut().zip(&self.places) {
            column.push(values[*place]);
        }
        Ok(())
    }

    fn progress(&mut self, _: f64) -> Flow {
        if (self.goes_on)() { Flow::Continue } else { Flow::Stop }
    }
}

/// Columns of a run of a scenario whose step is multiplied by `share`, the output interval kept.
///
/// # Errors
/// If the scenario is invalid, the run fails or is stopped.
pub(crate) fn columns(
    scenario: &Scenario,
    share: Share,
    names: &[String],
    goes_on: GoesOn<'_>,
) -> Result<Vec<Curve>, Stop> {
    let compiled =
        scenario.compile().map_err(|faults| Stop::Failed(percuss_study::in_one_line(&faults)))?;
    catch_unwind(AssertUnwindSafe(|| recorded(&compiled, share, names, goes_on)))
        .unwrap_or_else(|_| Err(Stop::failed(AnalysisCode::Broken, "internal error in the solver")))
}

/// The step of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Share {
    /// As the scenario says.
    Whole,
    /// Half of it.
    Half,
}

fn recorded(
    compiled: &Compiled,
    share: Share,
    names: &[String],
    goes_on: GoesOn<'_>,
) -> Result<Vec<Curve>, Stop> {
    let Settings { step, accuracy, record_every, .. } = compiled.settings;
    let settings = match share {
        Share::Whole => compiled.settings,
        Share::Half => {
            let record_every = 2 * record_every;
            // Errors are of second order: a quarter of the accuracy takes half the steps.
            let accuracy = accuracy.map(|accuracy| (0.25 * accuracy).max(LEAST));
            Settings { step: 0.5 * step, accuracy, record_every, ..compiled.settings }
        }
    };
    let reported = |faults: Vec<Fault>| {
        let texts: Vec<String> = faults.iter().map(in_one_line).collect();
        Stop::Failed(texts.join("; "))
    };
    let simulation = Simulation::new(&compiled.model, &settings).map_err(reported)?;
    let values = vec![Vec::new(); names.len()];
    let mut columns = Columns { names, places: Vec::new(), time: Vec::new(), values, goes_on };
    let summary = simulation.run(&mut columns);
    match &summary.termination {
        Termination::Completed => {}
        Termination::Failed(error) => return Err(Stop::failed(error.code(), error)),
        Termination::Interrupted { .. } => return Err(Stop::Interrupted),
        Termination::Unsolved => {
            return Err(Stop::failed(AnalysisCode::Broken, "a run was not made"));
        }
    }
    let time = columns.time;
    Ok(columns.values.into_iter().map(|values| Curve { time: time.clone(), values }).collect())
}
