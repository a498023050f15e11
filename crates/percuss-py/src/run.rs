//! A run for Python.

use std::path::PathBuf;
use std::time::Instant;

use percuss::{RunSummary, Simulation, Termination};
use percuss_advice::{Advice, advise, allow, compare, conclude};
use percuss_output::fields::{Fields, FrameStore};
use percuss_output::{RunInfo, RunSource, scenario_summary};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::directory::{Directory, Left};
use crate::error::Refusal;
use crate::fields::to_python;
use crate::given::Raised;
use crate::ready::{Origin, Ready, Source};
use crate::recorder::{Columns, Reached, RunRecorder};
use crate::structure::array;
use crate::watch::Stop;

/// Runs a scenario.
///
/// Parameters
/// ----------
/// source : tuple
///     What `Scenario._source` gives.
/// progress : callable or None
///     Called with the time reached and that of the end [s], some times a second; without it an estimate of the time left is logged.
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
///     `names`, `units`, `descriptions`, `columns`, `summary` (JSON), `scenario` (TOML), `fields` (the scene and how it moved), `seconds` [s],
///     `path` of its files or None.
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
/// (50, 50)
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
    let wanted = Wanted {
        out,
        report,
        shapes,
        origin: source.origin(),
        is_reported: progress.is_some(),
        reached: Reached::default(),
        raised: source.given().raised().clone(),
    };
    let reached = wanted.reached.clone();
    let tell = |py: Python<'_>| match (&progress, reached.get()) {
        (Some(progress), Some([time, end])) => progress.call1(py, (time, end)).map(drop),
        _ => Ok(()),
    };
    let work = move |ready: &Ready, stop: &Stop| wanted.run(ready, stop);
    let Done { columns, fields, text, place, ended } = source.attend_reporting(py, work, tell)?;
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
    result.set_item("path", place)?;
    Ok(result)
}

/// What is wanted of a run.
struct Wanted {
    out: Option<PathBuf>,
    report: bool,
    shapes: Option<usize>,
    origin: Origin,
    /// Whether someone is reported how far the run is.
    is_reported: bool,
    reached: Reached,
    raised: Raised,
}

/// A run with all that is kept of it.
struct Done {
    /// Columns of the history, shape (channels, rows) \[unit of the channel\].
    columns: Columns,
    fields: Fields,
    /// The scenario with every default written out.
    text: String,
    /// Where its files lie.
    place: Option<PathBuf>,
    ended: Ended,
}

impl Wanted {
    fn run(self, ready: &Ready, stop: &Stop) -> Result<Done, Refusal> {
        let (model, settings) = (&ready.compiled.model, &ready.compiled.settings);
        let simulation = Simulation::new(model, settings).map_err(|faults| ready.refuse(faults))?;
        let content = ready.scenario.content();
        let mut advice = advise(model, settings);
        allow(&mut advice, |code| content.reason_to_allow(code));
        if stop.is_wanted() {
            return Err(Refusal::Stopped);
        }
        let text = ready.scenario.to_toml();
        let create = |out: PathBuf| Directory::create(&out, &text, self.report);
        let directory = self.out.map(create).transpose()?;
        if directory.is_some() {
            stop.writes();
        }
        let history = directory.as_ref().map(|directory| directory.history(text.clone()));
        let extent = (simulation.step_count() / settings.record_every + 2, settings.end);
        let megabytes = content.record.shapes;
        let frames = FrameStore::new(ready.scenario.scene(model), settings.end, megabytes);
        let frames = match self.shapes {
            Some(shapes) => frames.at_most(shapes),
            None => frames,
        };
        let mut recorder = RunRecorder::new(frames, history, self.reached, self.raised, extent);
        recorder.says_estimate = !self.is_reported;
        let origin = self.origin.started_now();
        let ended = simulate(ready, origin, simulation, advice, &mut recorder);
        let RunRecorder { columns, frames, history, .. } = recorder;
        let mut fields = frames.finish();
        fields.note(&ended.summary);
        let mut place = None;
        if let Termination::Failed(error) = &ended.summary.termination
            && error.is_recorder()
        {
            return Err(Refusal::Recorder(error.code(), error.to_string()));
        }
        if let Some((directory, history)) = directory.zip(history) {
            let left = Left { run: &ended.summary, summary: &ended.value, fields: &fields };
            place = Some(directory.finish(history, left)?);
        }
        Ok(Done { columns, fields, text, place, ended })
    }
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
    advice: Vec<Advice>,
    recorder: &mut RunRecorder,
) -> Ended {
    let compiled = &ready.compiled;
    let content = ready.scenario.content();
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
