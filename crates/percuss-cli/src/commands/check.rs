//! `percuss check`.

use percuss::{EffectiveMass, Simulation, massless};
use percuss_advice::{Topic, advise};
use percuss_codes::{Caution, Code, RequestCode};
use percuss_study::Study;

use crate::arguments::Check;
use crate::number::{count, number};
use crate::outcome::{Failure, Status};
use crate::scenario::{self, Ready};
use crate::{advisor, effective_mass, terminal};

/// Runs of a study that are looked at.
const SAMPLE: u64 = 1000;
/// Reasons told why runs of a study are no sound scenarios.
const REASONS: usize = 5;

/// Says what is wrong with a scenario or a study, or what is in it.
pub fn run(arguments: &Check) -> Result<Status, Failure> {
    // What cannot be read is told of below, where a scenario is read.
    let text = scenario::text(&arguments.file);
    if text.as_deref().is_ok_and(percuss_scenario::is_study) {
        if scenario::is_input(&arguments.file) {
            let text = "a study is read from a file, not from standard input";
            return Err(Failure::input(RequestCode::NotOfStudies, text));
        }
        return study(arguments);
    }
    let ready = scenario::read(&arguments.file, &arguments.set)?;
    let name = scenario::name(&arguments.file);
    terminal::print(&format!("{name}: sound: {}\n", contents(&ready)))?;
    let (model, settings) = (&ready.compiled.model, &ready.compiled.settings);
    let mut denied = Vec::new();
    for fault in massless(model) {
        let text = format!("`percuss run` refuses it: {fault}");
        denied.extend(advisor::warn(Caution::NotForRuns, &text, &arguments.deny));
    }
    let mut advice = advise(model, settings);
    advisor::judge(&mut advice, ready.scenario.content());
    for one in advice.iter().filter(|one| one.topic == Topic::EffectiveMass) {
        let mass = EffectiveMass { on_mesh: one.value, limit: one.reference };
        let line = effective_mass::line(&mass);
        terminal::tell(&format!("projectile `{}`: {line}", one.contact));
    }
    advisor::tell(&advice);
    let content = ready.scenario.content();
    let before = |code: Code| Topic::of_code(code.code).is_some_and(|t| !t.is_found_after_a_run());
    advisor::tell_in_vain(content, &advisor::codes(&advice, &[]), before);
    denied.extend(advisor::denied(&advice, &arguments.deny));
    refuse(denied)
}

/// Says what is wrong with a study, and which of its runs are no sound scenarios as far as a sample shows.
fn study(arguments: &Check) -> Result<Status, Failure> {
    if !arguments.set.is_empty() {
        let text = "--set changes scenarios; give the values in the study";
        return Err(Failure::input(RequestCode::NotOfStudies, text));
    }
    let study = Study::load_with(&arguments.file, scenario::access())?;
    let (parameters, results) = (study.parameters().len(), study.results().len());
    let contents =
        [runs(study.run_count()), count(parameters, "parameter"), count(results, "result")];
    let file = arguments.file.display();
    terminal::print(&format!("{file}: sound: {}\n", contents.join(", ")))?;
    let how = match study.runs_alone() {
        Some(why) => format!("runs go one by one: {why}"),
        None => "runs go side by side in vector registers".to_owned(),
    };
    terminal::print(&format!("{how}\n"))?;
    let (invalid, looked_at) = study.check_sample(SAMPLE);
    let mut denied = Vec::new();
    if !invalid.is_empty() {
        let of = if looked_at < study.run_count() { "a sample of " } else { "" };
        let bad = runs(invalid.len() as u64);
        let text =
            format!("{bad} of {of}{looked_at} will be rows with a reason instead of results:");
        denied.extend(advisor::warn(Caution::UnsoundRuns, &text, &arguments.deny));
    }
    let mut told: Vec<&str> = Vec::new();
    for one in &invalid {
        if told.len() < REASONS && !told.contains(&one.reason.as_str()) {
            terminal::warning(Caution::UnsoundRuns, &format!("run {}: {}", one.run, one.reason));
            told.push(&one.reason);
        }
    }
    refuse(denied)
}

/// What was found and is denied fails the command.
fn refuse(denied: Vec<String>) -> Result<Status, Failure> {
    match denied.is_empty() {
        true => Ok(Status::Done),
        false => Err(Failure::Denied(denied)),
    }
}

fn runs(number: u64) -> String {
    count(usize::try_from(number).unwrap_or(usize::MAX), "run")
}

fn contents(ready: &Ready) -> String {
    let (content, model) = (ready.scenario.content(), &ready.compiled.model);
    // The model's own count has a node for every projectile and obstacle.
    let nodes = model.beam_names().filter_map(|name| model.beam_nodes(name)).map(|n| n.len()).sum();
    let settings = &ready.compiled.settings;
    let steps = match settings.accuracy {
        Some(accuracy) => format!("steps for an accuracy of {} %", number(100.0 * accuracy)),
        None => count(Simulation::new(model, settings).map_or(0, |s| s.step_count()), "step"),
    };
    [
        count(content.beam.len(), "beam"),
        count(model.element_count(), "element"),
        count(nodes, "node"),
        count(content.projectile.len(), "projectile"),
        steps,
    ]
    .join(", ")
}
