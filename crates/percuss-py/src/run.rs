//! A run for Python.

use std::path::PathBuf;
use std::time::Instant;

use percuss::{RunSummary, Simulation, Termination};
use percuss_advice::{advise, compare, conclude};
use percuss_output::fields::FrameStore;
use percuss_output::{RunInfo, RunSource, scenario_summary};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::directory::{Directory, Left};
use crate::error::{output_error, recorder_error};
use crate::fields::to_python;
use crate::ready::{Ready, Source};
use crate::recorder::RunRecorder;
use crate::structure::array;

/// Runs a scenario.
///
/// Parameters
/// ----------
/// source : tuple
///     What `Scenario._source` gives.
/// progress : callable or None
///     Called with the time reached and that of the end [s], some times a second.
/// out : str, path or None
///     A directory for the files of the run.
/// report : bool
///     Whether `report.html` is one of them.
/// shapes : int or None
///     Largest number of frames of either kind kept, touching or not; None leaves it to `record.shapes`.
///
/// Returns
/// -------
/// dict
///     `names`, `units`, `descriptions`, `columns`, `summary` (JSON), `scenario` (TOML), `fields` (the scene and how it moved), `seconds` [s].
///
/// Raises
/// ------
/// ScenarioError
///     If anything is wrong: every fault.
/// FileError
///     If files cannot be written.
///
/// Examples
/// --------
/// >>> native = percuss._percuss.run(percuss.load("plank.toml")._source(), None, None, False, 0)
/// >>> len(native["names"]), len(native["columns"])
/// (49, 49)
#[pyfunction]
#[pyo3(signature = (source, progress, out, report, shapes))]
pub fn run<'py>(
    py: Python<'py>,
    source: Source,
    progress: Option<Py<PyAny>>,
    out: Option<PathBuf>,
    report: bool,
    shapes: Option<usize>,
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
    let megabytes = ready.scenario.content().record.shapes;
    let frames = FrameStore::new(ready.scenario.scene(model), settings.end, megabytes);
    let frames = match shapes {
        Some(shapes) => frames.at_most(shapes),
        None => frames,
    };
    let mut recorder = RunRecorder::new(frames, history, progress.as_ref(), source.given(), extent);
    let origin = source.run_source();
    let ended = py.detach(|| simulate(&ready, origin, simulation, &mut recorder));

    let RunRecorder { columns, frames, history, raised, .. } = recorder;
    if let Termination::Failed(error) = &ended.summary.termination
        && error.is_recorder()
    {
        return Err(recorder_error(error));
    }
    let mut fields = frames.finish();
    fields.part(&ended.summary);
    if let Some((directory, history)) = directory.zip(history) {
        let left = Left { run: &ended.summary, summary: &ended.value, fields: &fields };
        let finished = py.detach(|| directory.finish(history, left));
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
    result.set_item("fields", to_python(py, &fields)?)?;
    result.set_item("seconds", ended.seconds)?;
    Ok(result)
}

/// A run that has ended, one way or the other.
struct Ended {
    summary: RunSummary,
    value: serde_json::Value,
    seconds: f64,
}

fn simulate(
    ready: &Ready,
    source: RunSource<'_>,
    simulation: Simulation<'_>,
    recorder: &mut RunRecorder<'_>,
) -> Ended {
    let compiled = &ready.compiled;
    let content = ready.scenario.content();
    let mut advice = advise(&compiled.model, &compiled.settings);
    percuss_advice::allow(&mut advice, |code| content.reason_to_allow(code));
    let begun = Instant::now();
    let summary = simulation.run(recorder);
    let seconds = begun.elapsed().as_secs_f64();
    let reason = |code| content.reason_to_allow(code);
    let found = conclude(&compiled.model, &compiled.settings, &summary, advice, reason);
    let comparisons = compare(&compiled.model, &compiled.settings, &summary);
    let info = RunInfo {
        title: &compiled.title,
        settings: &compiled.settings,
        wall_seconds: seconds,
        advice: &found.advice,
        warnings: &found.warnings,
        comparisons: &comparisons,
    };
    let value = scenario_summary(&summary, info, &content.allowances(), source);
    Ended { summary, value, seconds }
}
