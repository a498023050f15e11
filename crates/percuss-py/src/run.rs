//! A run for Python.

use std::path::PathBuf;
use std::time::Instant;

use percuss::{RunSummary, Simulation, Termination, advise, compare, review};
use percuss_output::{RunInfo, summary_value};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::directory::Directory;
use crate::error::output_error;
use crate::ready::{Ready, Source};
use crate::recorder::RunRecorder;
use crate::structure::{array, beams, shaped};

/// Runs a scenario: `names`, `units`, `descriptions`, `columns`, `summary` (JSON), `scenario` (TOML), `shape_times`, `shapes`,
/// `beams`, `seconds`.
///
/// `progress` is called with the time reached and that of the end, some times a second; `out` is a directory for the files of the run; `shapes` is
/// the largest number of shapes kept.
#[pyfunction]
#[pyo3(signature = (source, progress, out, report, shapes))]
pub fn run<'py>(
    py: Python<'py>,
    source: Source,
    progress: Option<Py<PyAny>>,
    out: Option<PathBuf>,
    report: bool,
    shapes: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let ready = source.ready(py)?;
    let model = &ready.compiled.model;
    let simulation = Simulation::new(model, &ready.compiled.settings)
        .map_err(|faults| source.raised().unwrap_or_else(|| ready.refuse(py, faults)))?;
    let text = ready.scenario.to_toml();
    let directory = out.map(|out| Directory::create(&out, &text, report)).transpose()?;
    let history = directory.as_ref().map(|directory| directory.history(text.clone()));
    let settings = &ready.compiled.settings;
    let extent = (simulation.step_count() / settings.record_every + 2, settings.end);
    let mut recorder = RunRecorder::new(shapes, history, progress.as_ref(), source.given(), extent);
    let ended = py.detach(|| simulate(&ready, simulation, &mut recorder));

    let RunRecorder { columns, mut shapes, history, raised, .. } = recorder;
    if let Termination::Failed(error) = &ended.summary.termination
        && error.is_recorder()
    {
        return Err(pyo3::exceptions::PyOSError::new_err(error.to_string()));
    }
    if let Some((directory, history)) = directory.zip(history) {
        let finished = py.detach(|| directory.finish(history, &ended.summary, &ended.value));
        finished.map_err(|error| output_error(&error))?;
    }
    if let Some(error) = raised.or_else(|| source.raised()) {
        return Err(error);
    }
    let result = PyDict::new(py);
    let names: Vec<&str> = columns.channels.iter().map(|c| c.name.as_str()).collect();
    let units: Vec<&str> = columns.channels.iter().map(|c| c.unit).collect();
    let about: Vec<&str> = columns.channels.iter().map(|c| c.description.as_str()).collect();
    result.set_item("names", names)?;
    result.set_item("units", units)?;
    result.set_item("descriptions", about)?;
    let columns = columns.values.into_iter().map(|values| array(py, values));
    result.set_item("columns", PyList::new(py, columns.collect::<Vec<_>>())?)?;
    result.set_item("summary", ended.value.to_string())?;
    result.set_item("scenario", text)?;
    shapes.close();
    let (times, values) = (shapes.times, shapes.values);
    let nodes = values.len().checked_div(4 * times.len()).unwrap_or(0);
    let shape = [times.len(), nodes, 4];
    result.set_item("shape_times", array(py, times))?;
    result.set_item("shapes", shaped(py, values, &shape)?)?;
    result.set_item("beams", beams(py, model)?)?;
    result.set_item("seconds", ended.seconds)?;
    Ok(result)
}

/// A run that has ended, one way or the other.
struct Ended {
    summary: RunSummary,
    value: serde_json::Value,
    seconds: f64,
}

fn simulate(ready: &Ready, simulation: Simulation<'_>, recorder: &mut RunRecorder<'_>) -> Ended {
    let compiled = &ready.compiled;
    let mut advice = advise(&compiled.model, &compiled.settings);
    let begun = Instant::now();
    let summary = simulation.run(recorder);
    let seconds = begun.elapsed().as_secs_f64();
    advice.extend(review(&compiled.model, &compiled.settings, &summary));
    let comparisons = compare(&compiled.model, &compiled.settings, &summary);
    let info = RunInfo {
        title: &compiled.title,
        settings: &compiled.settings,
        wall_seconds: seconds,
        advice: &advice,
        comparisons: &comparisons,
    };
    let value = summary_value(&summary, info);
    Ended { summary, value, seconds }
}
