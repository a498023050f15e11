//! Convergence with step, mesh and fibres, for Python.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use percuss_codes::RequestCode;
use percuss_study::{ConvergeError, Ladder, Refined, Sequence};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;

use crate::error::Refusal;
use crate::ready::{Ready, Source};
use crate::watch::Stop;

/// Words for what is refined.
const WORDS: [(&str, Refined); 4] = [
    ("step", Refined::Step),
    ("mesh", Refined::Mesh),
    ("fibres", Refined::Fibres),
    ("together", Refined::Together),
];

/// What is refined, values, order, limit and uncertainty.
type Found = (String, Vec<f64>, Option<f64>, f64, f64);

/// A quantity on finer steps, meshes and fibres, as `percuss converge` computes it.
///
/// Parameters
/// ----------
/// source : tuple
///     What `Scenario._source` gives.
/// quantity : str or None
///     Path in the summary, or column; by default the largest displacement of the point that moves most.
/// refine : list of str
///     "step", "mesh", "fibres", "together".
/// levels : int
///     Runs of each, the given one included.
/// tell : callable
///     Called some times a second with the number of runs done and of all.
///
/// Returns
/// -------
/// tuple
///     Name of the quantity, and for each refinement its word, values, order or None, limit and uncertainty.
///
/// Raises
/// ------
/// KeyError
///     If the quantity is neither a column nor a number of the summary.
/// ScenarioError
///     If the scenario has faults.
/// InputError
///     If there are too few levels, or the runs would cost too much.
/// AnalysisError
///     If a run does not complete.
///
/// Examples
/// --------
/// >>> source = percuss.load("plank.toml")._source()
/// >>> name, found = percuss._percuss.converged(source, "contact.bag.peak_force.value", ["step"], 3, lambda *_: None)
/// >>> name, found[0][0], round(found[0][2], 1)
/// ('contact.bag.peak_force.value', 'step', 2.0)
#[pyfunction]
#[pyo3(signature = (source, quantity, refine, levels, tell))]
pub fn converged(
    py: Python<'_>,
    source: Source,
    quantity: Option<String>,
    refine: Vec<String>,
    levels: usize,
    tell: Py<PyAny>,
) -> PyResult<(String, Vec<Found>)> {
    let known = |word: &String| WORDS.iter().find(|(name, _)| name == word).map(|one| one.1);
    let words: Option<Vec<Refined>> = refine.iter().map(known).collect();
    let Some(words) = words else {
        let text = "refine: expected \"step\", \"mesh\", \"fibres\" or \"together\"";
        return Err(PyValueError::new_err(text));
    };
    let results = quantity.iter().cloned().collect();
    let ladder = Ladder { results, refine: words, levels, accuracy: None };
    let counts = Arc::new(Mutex::new(None));
    let reached = Arc::clone(&counts);
    let work = move |ready: &Ready, stop: &Stop| {
        let goes_on = || !stop.is_wanted();
        let progress = |done: usize, all: usize| *locked(&reached) = Some((done, all));
        Ok(percuss_study::converge(&ready.scenario, &ladder, &goes_on, &progress))
    };
    let mut before = None;
    let report = |py: Python<'_>| {
        let now = *locked(&counts);
        match now {
            Some(counts) if now != before => {
                before = now;
                tell.call1(py, counts).map(drop)
            }
            _ => Ok(()),
        }
    };
    let found = source.attend_reporting(py, work, report)?;
    let found = found.map_err(|error| exception(py, quantity.as_deref(), error))?;
    let results = found.results.iter();
    let chosen = match &quantity {
        Some(_) => results.clone().next(),
        None => results
            .clone()
            .filter(|one| one.path.contains(".displacement_max."))
            .max_by(|a, b| a.value.abs().total_cmp(&b.value.abs())),
    };
    let Some(chosen) = chosen else {
        let text = "no point is recorded: give a quantity, or record.points = [\"beam.mid\"]";
        return Err(PyValueError::new_err(text));
    };
    let sequence = |word: &String| {
        let one: &Sequence = match known(word) {
            Some(Refined::Step) => &chosen.step,
            Some(Refined::Mesh) => &chosen.mesh,
            Some(Refined::Fibres) => &chosen.fibres,
            _ => &chosen.together,
        };
        let order = one.found.order.filter(|_| !one.no_limit);
        let (limit, uncertainty) = match one.no_limit {
            true => (f64::NAN, f64::NAN),
            false => (one.found.limit, one.found.uncertainty),
        };
        (word.clone(), one.compared().to_vec(), order, limit, uncertainty)
    };
    Ok((chosen.path.clone(), refine.iter().map(sequence).collect()))
}

/// Runs done and their number, as far as the study is.
fn locked(counts: &Mutex<Option<(usize, usize)>>) -> MutexGuard<'_, Option<(usize, usize)>> {
    counts.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The exception for it.
fn exception(py: Python<'_>, quantity: Option<&str>, error: ConvergeError) -> PyErr {
    match error {
        ConvergeError::Faults(faults) => match quantity {
            Some(name)
                if faults
                    .all()
                    .iter()
                    .any(|one| one.path == name || one.message.contains(name)) =>
            {
                let help = faults.all().first().map_or("", |one| one.help.as_str());
                let text = format!(
                    "'{name}' is neither a column nor a number of the summary; expected {help}"
                );
                PyKeyError::new_err(text)
            }
            _ => Refusal::Faults(faults).exception(py),
        },
        ConvergeError::Refused(reason) => {
            Refusal::Request(RequestCode::Levels, reason).exception(py)
        }
        ConvergeError::Run(code, reason) => {
            let text = format!("a run did not complete: {reason}");
            Refusal::Analysis(code, text).exception(py)
        }
        ConvergeError::Interrupted => Refusal::Stopped.exception(py),
    }
}
