//! How far results depend on step, mesh and fibres: the run repeated on finer ones, one after the other and all at once, orders, limits, and
//! the cheapest settings for an accuracy.

mod cheapest;
mod converged;
mod meaning;
mod results;
mod run;
mod rungs;
mod sequence;

pub use cheapest::Cheapest;
pub use converged::{ConvergeError, Converged, Refined, Sequence};
pub use sequence::{Extrapolation, extrapolate};

use percuss::{Fault, Model, RunSummary, Settings, Simulation, Termination};
use percuss_codes::AnalysisCode;
use percuss_scenario::Scenario;

use crate::history_columns::columns_of;

use meaning::Meaning;
use results::{Looked, compared, pick_all, results};
use run::Ear;
use rungs::{Rung, Rungs};

/// What to look at, and how far.
#[derive(Clone, Debug)]
pub struct Ladder {
    /// Paths in the summary, or columns of the history, of which the value of largest magnitude is taken; the usual results if there are none,
    /// shape (results).
    pub results: Vec<String>,
    /// What is refined; everything if nothing is named, shape (refinements).
    pub refine: Vec<Refined>,
    /// Levels, each twice as fine as the one before, the given settings first; three at least.
    pub levels: usize,
    /// Relative accuracy for which the cheapest settings are wanted.
    pub accuracy: Option<f64>,
}

impl Ladder {
    /// Levels if no number is given: with one level more than an order needs, limits of neighbouring levels can be compared.
    pub const LEVELS: usize = 4;
}

/// How the results of a scenario converge.
#[derive(Clone, Debug, PartialEq)]
pub struct Convergence {
    /// Steps of the levels, shape (levels) \[s\].
    pub steps: Vec<f64>,
    /// Numbers of elements of the levels, shape (levels) \[-\].
    pub elements: Vec<usize>,
    /// Fibres of the section with the most, of the levels; one where no section yields, shape (levels) \[-\].
    pub fibres: Vec<usize>,
    /// Results, shape (results).
    pub results: Vec<Converged>,
    /// The cheapest settings for the accuracy wanted, if one is.
    pub cheapest: Option<Cheapest>,
}

/// Runs a scenario, then with halved steps, doubled meshes and, where sections yield, doubled fibres, level after level: each alone, and all
/// at once.
///
/// `goes_on` is asked after every step; `tell` hears before each run how many of how many are done.
///
/// # Errors
/// Faults of scenario and paths, a ladder that costs too much, a run that fails, or the wish to stop.
pub fn converge(
    scenario: &Scenario,
    ladder: &Ladder,
    goes_on: &dyn Fn() -> bool,
    tell: &dyn Fn(usize, usize),
) -> Result<Convergence, ConvergeError> {
    if ladder.levels < 3 {
        return Err(ConvergeError::Refused("an order needs three levels or more".into()));
    }
    let compiled = scenario.compile()?;
    let (base, settings) = (&compiled.model, &compiled.settings);
    if settings.accuracy.is_some() {
        let why = "`time.accuracy` chooses steps as it goes, and what is halved here is one that is given: give a `time.step`";
        return Err(ConvergeError::Refused(why.into()));
    }
    let rungs = Rungs::of(scenario, base, settings, ladder.levels)?.only(&ladder.refine);
    tell(0, rungs.runs());
    let channels = columns_of(&compiled)
        .map_err(|faults| ConvergeError::Faults(scenario.diagnostics(faults)))?;
    let columns: Vec<&str> = ladder.results.iter().map(String::as_str).collect();
    let columns: Vec<&str> =
        columns.into_iter().filter(|name| channels.iter().any(|c| c.name == *name)).collect();
    let every = settings.record_every.max(1);
    let (first, largest) = completed(base, settings, &columns, every, goes_on)?;
    let rungs = rungs.after(&first).only(&ladder.refine);
    let paths = results(scenario, &ladder.results, &first, &channels)?;
    let given = pick_all(&paths, &first, &largest);
    let mut done = 0;
    let mut climb = |all: &[Rung]| -> Result<Vec<Vec<f64>>, ConvergeError> {
        let mut values = vec![given.clone()];
        for rung in all {
            done += 1;
            tell(done, rungs.runs());
            let model = rung.model(scenario)?;
            let step = settings.step / f64::from(rung.step);
            let finer = Settings { step, ..*settings };
            let interval = every * rung.step as usize;
            let (summary, largest) = completed(&model, &finer, &columns, interval, goes_on)?;
            values.push(pick_all(&paths, &summary, &largest));
        }
        Ok(values)
    };
    let alone = [climb(&rungs.step)?, climb(&rungs.mesh)?, climb(&rungs.fibres)?];
    // With nothing but the step to refine, all at once is the step.
    let together =
        if rungs.together.is_empty() { alone[0].clone() } else { climb(&rungs.together)? };
    tell(rungs.runs(), rungs.runs());
    let results: Vec<Converged> = paths
        .iter()
        .enumerate()
        .map(|(k, path)| {
            let of = |runs: &Vec<Vec<f64>>| runs.iter().map(|run| run[k]).collect();
            let meaning = Meaning { path: &path.name, model: base, summary: &first };
            converged(path, &meaning, alone.each_ref().map(of), of(&together))
        })
        .collect();
    let (steps, elements, fibres) =
        (rungs.steps(settings.step), rungs.elements(base), rungs.fibre_counts());
    let cheapest = ladder
        .accuracy
        .map(|accuracy| Cheapest::of(&results, accuracy, &steps, &elements, &fibres));
    Ok(Convergence { steps, elements, fibres, results, cheapest })
}

/// A result from its values on finer steps, meshes and fibres, and on all of them at once.
fn converged(
    path: &Looked,
    meaning: &Meaning<'_>,
    [step, mesh, fibres]: [Vec<f64>; 3],
    together: Vec<f64>,
) -> Converged {
    let finest = together.last().copied().unwrap_or(f64::NAN);
    let sequence = |refined, values: Vec<f64>| {
        meaning.sequence(refined, compared(path, &values, finest), values)
    };
    let value = compared(path, &step, finest)[0];
    let [step, mesh, fibres] = [
        sequence(Refined::Step, step),
        sequence(Refined::Mesh, mesh),
        sequence(Refined::Fibres, fibres),
    ];
    let mut together = sequence(Refined::Together, together);
    together.found = together.found.with_parts([&step.found, &mesh.found, &fibres.found]);
    let none = [&step, &mesh, &fibres].iter().any(|one| one.no_limit);
    together.no_limit = none || together.found.uncertainty.is_nan();
    let (limit, uncertainty) = match together.no_limit {
        true => (f64::NAN, f64::NAN),
        false => (together.found.limit, together.found.uncertainty),
    };
    let (path, unit) = (path.name.clone(), path.unit.into());
    Converged { path, unit, value, limit, uncertainty, step, mesh, fibres, together }
}

/// The summary of a run that completes, and the values of largest magnitude of columns, shape (columns) \[unit of the column\]; `interval` is the
/// number of steps in an output interval of the given run.
fn completed(
    model: &Model,
    settings: &Settings,
    columns: &[&str],
    interval: usize,
    goes_on: &dyn Fn() -> bool,
) -> Result<(RunSummary, Vec<f64>), ConvergeError> {
    if !goes_on() {
        return Err(ConvergeError::Interrupted);
    }
    let refused = |faults: Vec<Fault>| {
        let texts: Vec<String> = faults.iter().map(ToString::to_string).collect();
        ConvergeError::Refused(texts.join("; "))
    };
    let mut ear = Ear::new(goes_on, columns, interval);
    // Every step is a row: largest values are those of the run, not of its output.
    let settings = &Settings { record_every: 1, ..*settings };
    let summary = Simulation::new(model, settings).map_err(refused)?.run(&mut ear);
    match &summary.termination {
        Termination::Completed => Ok((summary, ear.largest())),
        Termination::Interrupted { .. } => Err(ConvergeError::Interrupted),
        Termination::Failed(error) => {
            let (step, elements) = (settings.step, model.element_count());
            let text = format!("with a step of {step:e} s and {elements} elements: {error}");
            Err(ConvergeError::Run(error.code(), text))
        }
        Termination::Unsolved => {
            Err(ConvergeError::Run(AnalysisCode::Broken, "a run was not made".into()))
        }
    }
}
