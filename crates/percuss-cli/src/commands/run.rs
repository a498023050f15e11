//! `percuss run`.

mod balance;
mod checkpoints;
mod comparison;
mod conclude;
mod drift;
mod ended;
mod equivalent;
mod recorder;
mod table;

use std::path::Path;
use std::time::{Instant, SystemTime};

use percuss::{Checkpoint, ResumeError, RunSummary, Simulation, Termination};
use percuss_advice::{Advice, Findings, advise, compare};
use percuss_codes::{Caution, FileCode, RequestCode};
use percuss_output::checkpoint::{CheckpointFolder, Rows, Saved};
use percuss_output::fields::{self, FrameStore};
use percuss_output::report::{self, ReportData};
use percuss_output::{
    Extent, HistoryWriter, Results, RunDirectory, RunInfo, RunSource, scenario_summary,
    write_comparison, write_envelopes, write_impacts, write_new, write_summary,
};
use serde_json::Value;

use crate::advisor;
use crate::interrupt;
use crate::outcome::{Failure, Status};
use crate::progress::Progress;
use crate::run_arguments::{Every, Extend, History, Run};
use crate::scenario::{self, Ready};
use crate::terminal;
use checkpoints::{Checkpoints, without_end};
use comparison::Comparison;
use conclude::conclude;
use ended::{Ended, shown};
use recorder::{EnergySeries, RunRecorder};

/// Where a run begins, and its checkpoints.
struct Beginning {
    earlier: Option<(Saved, Rows)>,
    checkpoints: Option<Checkpoints>,
}

/// Checkpoints of a run that goes on are written this often unless the user says otherwise.
const EVERY: Every = Every::Seconds(60.0);

/// Simulates a scenario and writes its results.
pub fn run(arguments: &Run) -> Result<Status, Failure> {
    let ready = scenario::read(&arguments.file, &arguments.set)?;
    interrupt::end_between_steps();
    let out = arguments.out.clone().unwrap_or_else(|| scenario::results(&arguments.file, ""));
    refuse_own_input(&arguments.file, &out)?;
    let directory = interrupt::directory(Results::Run, &out)?;
    let text = without_end(&ready.scenario.to_toml());
    let mut folder = CheckpointFolder::beside(directory.target(), text);
    let earlier = goes_on(&mut folder, arguments)?;
    let every = often(arguments);
    let seconds = seconds(earlier.as_ref());
    let checkpoints =
        every.map(|every| Checkpoints::new(folder, Some(every), directory.path(), seconds));
    go(&ready, arguments, directory, Beginning { earlier, checkpoints })
}

/// The checkpoint beside the results to go on from, if that is asked for; else a place for those to come.
fn goes_on(
    folder: &mut CheckpointFolder,
    arguments: &Run,
) -> Result<Option<(Saved, Rows)>, percuss_output::Error> {
    // With both, as a queue starts a job time and again, the first one begins.
    if arguments.resume && (arguments.checkpoint.is_none() || folder.time().is_some()) {
        return folder.resume().map(Some);
    }
    if arguments.checkpoint.is_some() {
        folder.begin()?;
    }
    Ok(None)
}

/// How often checkpoints are written, if they are.
fn often(arguments: &Run) -> Option<Every> {
    arguments.checkpoint.or(arguments.resume.then_some(EVERY))
}

/// Seconds that a run took up to a checkpoint.
fn seconds(earlier: Option<&(Saved, Rows)>) -> f64 {
    earlier.map_or(0.0, |(saved, _)| saved.seconds)
}

/// Lets a complete run go on to a later end.
pub fn extend(arguments: &Extend) -> Result<Status, Failure> {
    let file = arguments.dir.join("scenario.toml");
    let before = scenario::read(&file, &[])?.compiled.settings.end;
    // A queue starts a job time and again, the last time after it has ended.
    let again = arguments.checkpoint.is_some() && arguments.resume;
    let out = arguments.out.as_deref().unwrap_or(&arguments.dir);
    if again && is_whole(out, arguments.end) {
        if !arguments.quiet {
            let end = crate::number::quantity(arguments.end, "s");
            terminal::tell(&format!("{}: reached t = {end}; nothing to do", out.display()));
        }
        return Ok(Status::Done);
    }
    if arguments.end <= before {
        return Err(Failure::input(
            RequestCode::EndReached,
            format!(
                "--end: the run in {} already reaches t = {}; choose a later time",
                arguments.dir.display(),
                crate::number::quantity(before, "s")
            ),
        ));
    }
    let set = vec![format!("time.end={:e}", arguments.end)];
    let ready = scenario::read(&file, &set)?;
    interrupt::end_between_steps();
    let text = without_end(&ready.scenario.to_toml());
    let kept = CheckpointFolder::kept(&arguments.dir, &text)?;
    let out = arguments.out.clone().unwrap_or_else(|| arguments.dir.clone());
    let directory = interrupt::directory(Results::Run, &out)?;
    let is_csv = arguments.dir.join("history.csv").is_file();
    let run = Run {
        file,
        out: Some(out),
        set,
        strict: arguments.strict,
        json: arguments.json,
        history: if is_csv { History::Csv } else { History::Parquet },
        no_report: arguments.no_report,
        figures: false,
        open: false,
        checkpoint: arguments.checkpoint,
        resume: arguments.resume,
        deny: Vec::new(),
        quiet: arguments.quiet,
    };
    let mut folder = CheckpointFolder::beside(directory.target(), text);
    let earlier = Some(goes_on(&mut folder, &run)?.unwrap_or(kept));
    let seconds = seconds(earlier.as_ref());
    let checkpoints = Some(Checkpoints::new(folder, often(&run), directory.path(), seconds));
    go(&ready, &run, directory, Beginning { earlier, checkpoints })
}

/// Whether a directory holds the results of a run that was completed and ends at a time.
fn is_whole(dir: &Path, end: f64) -> bool {
    let summary = std::fs::read_to_string(dir.join("summary.json")).unwrap_or_default();
    let summary: Value = serde_json::from_str(&summary).unwrap_or_default();
    let reached = scenario::read(&dir.join("scenario.toml"), &[]);
    let reached = reached.map_or(f64::NAN, |ready| ready.compiled.settings.end);
    summary["status"] == "completed" && (reached - end).abs() <= 1e-12 * end
}

/// Simulates, and puts the results in their place.
fn go(
    ready: &Ready,
    arguments: &Run,
    mut directory: RunDirectory,
    beginning: Beginning,
) -> Result<Status, Failure> {
    let out = arguments.out.clone().unwrap_or_else(|| scenario::results(&arguments.file, ""));
    let mut ended = simulate(ready, arguments, directory.path(), beginning)?;
    ["history.parquet", "history.csv"].iter().for_each(|name| directory.finished(name));
    let report = match arguments.no_report {
        true => Ok(()),
        false => write_report(ready, arguments, directory.path(), &mut ended),
    };
    let whole = matches!(ended.summary.termination, Termination::Completed) && report.is_ok();
    let extent = if whole { Extent::Complete } else { Extent::Partial };
    let asked = directory.target().to_owned();
    let place = interrupt::commit(directory, extent)?;
    if !matches!(ended.summary.termination, Termination::Interrupted { .. })
        && let Some(checkpoints) = ended.checkpoints.take()
    {
        checkpoints.remove();
    }
    if place == asked {
        return conclude(&ended, arguments, &out, report);
    }
    let (place, earlier) = (shown(&place), out.display());
    let text = format!(
        "the incomplete results are in {}; the complete ones in {earlier} are unchanged",
        place.display()
    );
    ended.denied.extend(advisor::warn(Caution::Incomplete, &text, &arguments.deny));
    conclude(&ended, arguments, &place, report)
}

/// A scenario inside the directory of results would be replaced by its own echo.
fn refuse_own_input(file: &Path, out: &Path) -> Result<(), Failure> {
    let (Ok(file), Ok(dir)) = (file.canonicalize(), out.canonicalize()) else { return Ok(()) };
    match file.starts_with(dir) {
        false => Ok(()),
        true => Err(Failure::input(
            FileCode::OwnInput,
            format!(
                "{}: this directory contains the scenario; choose another --out",
                out.display()
            ),
        )),
    }
}

/// Simulates; scenario, history and summary are then in `dir`.
fn simulate(
    ready: &Ready,
    arguments: &Run,
    dir: &Path,
    beginning: Beginning,
) -> Result<Ended, Failure> {
    let compiled = &ready.compiled;
    let text = ready.scenario.to_toml();
    let file = dir.join("scenario.toml");
    write_new(&file, text.as_bytes()).map_err(|error| Failure::system(&file, "write", &error))?;

    let Beginning { earlier, checkpoints } = beginning;
    let (saved, rows) = earlier.map_or((None, None), |(saved, rows)| (Some(saved), Some(rows)));
    let (checkpoint, kept, before) = match saved {
        Some(Saved { checkpoint, frames, seconds, .. }) => {
            (Some(checkpoint), Some(frames), seconds)
        }
        None => (None, None, 0.0),
    };
    let done = checkpoint.as_ref().map_or(0, |c| c.step());
    let simulation = begin(ready, arguments, checkpoint)?;
    let content = ready.scenario.content();
    let advice = advice_before(ready, arguments)?;
    let end = compiled.settings.end;
    let mut progress =
        Progress::of_settings("run".into(), &compiled.settings, shows_progress(arguments));
    progress.begin_at(done);
    let history = HistoryWriter::new(dir, arguments.history.into(), text);
    let keeps_energy = !arguments.no_report && comparison::has_part_for(ready);
    let scene = ready.scenario.scene(&compiled.model);
    let mut frames = FrameStore::new(scene, end, ready.scenario.content().record.shapes);
    kept.into_iter().for_each(|kept| frames.go_on(kept));
    let energy = keeps_energy.then(EnergySeries::default);
    let mut recorder =
        RunRecorder::new(history, energy, frames, progress).with_checkpoints(checkpoints, rows);
    recorder = recorder.estimating_time(shows_progress(arguments));
    let (begun, started) = (Instant::now(), SystemTime::now());
    let summary = simulation.run(&mut recorder);
    let wall_seconds = before + begun.elapsed().as_secs_f64();

    let (history, energy, frames, checkpoints) = recorder.into_parts();
    if let Termination::Failed(error) = &summary.termination
        && error.is_recorder()
    {
        return Err(Failure::System(error.code().into(), error.to_string()));
    }
    history.finish()?;
    let (found, denied) = judge(ready, arguments, &summary, advice);
    let comparisons = compare(&compiled.model, &compiled.settings, &summary);
    let info = RunInfo {
        title: &compiled.title,
        settings: &compiled.settings,
        wall_seconds,
        advice: &found.advice,
        warnings: &found.warnings,
        comparisons: &comparisons,
    };
    let file = arguments.file.display().to_string();
    let source = RunSource { scenario: &file, overrides: &arguments.set, started };
    let value = scenario_summary(&summary, info, &content.allowances(), source);
    write_summary(dir, &value)?;
    write_envelopes(dir, &summary.section_forces)?;
    write_impacts(dir, &summary.contacts, &summary.supports)?;
    if ready.scenario.content().record.shapes > 0.0 {
        let mut shapes = frames.finish();
        shapes.note(&summary);
        fields::write(dir, &shapes)?;
    }
    Ok(Ended {
        summary,
        value,
        comparisons,
        energy: energy.unwrap_or_default(),
        checkpoints,
        warnings: found.warnings,
        denied,
    })
}

/// What the advisor says before the run, reported unless it is to be quiet.
///
/// # Errors
/// Advice that is denied.
fn advice_before(ready: &Ready, arguments: &Run) -> Result<Vec<Advice>, Failure> {
    let compiled = &ready.compiled;
    let mut advice = advise(&compiled.model, &compiled.settings);
    advisor::judge(&mut advice, ready.scenario.content());
    if !arguments.quiet {
        advisor::tell(&advice);
    }
    let denied = advisor::denied(&advice, &arguments.deny);
    if denied.is_empty() { Ok(advice) } else { Err(Failure::Denied(denied)) }
}

/// The run, from a checkpoint on or from the beginning.
fn begin<'a>(
    ready: &'a Ready,
    arguments: &Run,
    checkpoint: Option<Checkpoint>,
) -> Result<Simulation<'a>, Failure> {
    let compiled = &ready.compiled;
    let simulation = match checkpoint {
        Some(checkpoint) => Simulation::resume(&compiled.model, &compiled.settings, checkpoint),
        None => Simulation::new(&compiled.model, &compiled.settings).map_err(ResumeError::Faults),
    };
    simulation.map_err(|error| match error {
        ResumeError::Faults(faults) => ready.refuse(faults, &arguments.set),
        ResumeError::Foreign => Failure::input(
            FileCode::OtherCheckpoint,
            "the checkpoint does not match the scenario, or is later than its end; run from the start",
        ),
    })
}

/// Findings of a finished run, printed unless it is to be quiet, and those that are denied.
fn judge(
    ready: &Ready,
    arguments: &Run,
    run: &RunSummary,
    before: Vec<Advice>,
) -> (Findings, Vec<String>) {
    let content = ready.scenario.content();
    let (model, settings) = (&ready.compiled.model, &ready.compiled.settings);
    let found = percuss_advice::conclude(model, settings, run, before, |code| {
        content.reason_to_allow(code)
    });
    if !arguments.quiet {
        advisor::tell(found.after());
    }
    let mut denied = advisor::denied(found.after(), &arguments.deny);
    denied.extend(advisor::denied_of_audit(&found.warnings, &arguments.deny));
    if !arguments.quiet && matches!(run.termination, Termination::Completed) {
        let codes = advisor::codes(&found.advice, &found.warnings);
        advisor::tell_in_vain(content, &codes, |_| true);
    }
    (found, denied)
}

/// Writes the report and, before it, the comparison that belongs into it.
fn write_report(
    ready: &Ready,
    arguments: &Run,
    dir: &Path,
    ended: &mut Ended,
) -> Result<(), Failure> {
    if matches!(ended.summary.termination, Termination::Completed) {
        let comparison = Comparison { ready, shows_progress: shows_progress(arguments) };
        let denied = &mut ended.denied;
        let mut warn = |text: String| {
            denied.extend(advisor::warn(Caution::Comparison, &text, &arguments.deny));
        };
        let series = comparison.run(&ended.energy, &mut warn);
        if !series.is_empty() {
            write_comparison(dir, &series)?;
        }
    }
    let data = ReportData::read(dir)?;
    match arguments.figures {
        true => report::write_with_figures(dir, &data)?,
        false => report::write(dir, &data)?,
    }
    Ok(())
}

fn shows_progress(arguments: &Run) -> bool {
    !arguments.quiet
}
