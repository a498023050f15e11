//! `percuss check`.

use std::time::{Duration, Instant};

use percuss::{EffectiveMass, Flow, Model, Recorder, Simulation, massless};
use percuss_advice::{Topic, advise};
use percuss_codes::{Caution, Code, RequestCode};
use percuss_scenario::content::LoadKind;
use percuss_study::Study;

use crate::arguments::Check;
use crate::number::{count, duration, number, quantity};
use crate::outcome::{Failure, Status};
use crate::scenario::{self, Ready};
use crate::stage_messages::StageMessages;
use crate::{advisor, effective_mass, terminal};
use percuss_output::shown::FEW;

/// Runs of a study that are looked at.
const SAMPLE: u64 = 1000;
/// Time for which a run is tried out, and the estimated run time from which on it is printed [s].
const TRIAL: Duration = Duration::from_millis(200);
const LONG: f64 = 60.0;
/// Validates a scenario, a study or a fit, and prints what it contains.
pub fn run(arguments: &Check) -> Result<Status, Failure> {
    // A file that cannot be read is reported below, where a scenario is read.
    let text = scenario::text(&arguments.file);
    let is = |kind: fn(&str) -> bool| text.as_deref().is_ok_and(kind);
    if is(percuss_scenario::is_study) {
        is_alone(arguments, "study")?;
        return study(arguments);
    }
    if is(percuss_scenario::is_fit) {
        is_alone(arguments, "fit")?;
        return super::fit::check(&arguments.file);
    }
    let stage_messages = StageMessages::new("the file and its model");
    let ready = scenario::read(&arguments.file, &arguments.set)?;
    let name = scenario::name(&arguments.file);
    terminal::print(&format!("{name}: no errors; {}\n", contents(&ready)))?;
    let (model, settings) = (&ready.compiled.model, &ready.compiled.settings);
    let mut denied = Vec::new();
    for fault in massless(model) {
        let text = format!("not valid for `percuss run`: {fault}");
        denied.extend(advisor::warn(Caution::NotForRuns, &text, &arguments.deny));
    }
    stage_messages.stage("estimating the contacts");
    let mut advice = advise(model, settings);
    stage_messages.stage("estimating the run time");
    let lasts = running_time(&ready);
    drop(stage_messages);
    advisor::judge(&mut advice, ready.scenario.content());
    for one in advice.iter().filter(|one| one.topic == Topic::EffectiveMass) {
        let mass = EffectiveMass { on_mesh: one.value, limit: one.reference };
        let line = effective_mass::line(&mass);
        terminal::tell(&format!("contact '{}': {line}", one.contact));
    }
    advisor::tell(&advice);
    if let Some(text) = lasts {
        terminal::tell(&text);
    }
    let content = ready.scenario.content();
    let before = |code: Code| Topic::of_code(code.code).is_some_and(|t| !t.is_found_after_a_run());
    advisor::tell_in_vain(content, &advisor::codes(&advice, &[]), before);
    denied.extend(advisor::denied(&advice, &arguments.deny));
    refuse(denied)
}

/// Refuses what a file that names its scenario does not go with: standard input, and changes of a scenario.
fn is_alone(arguments: &Check, kind: &str) -> Result<(), Failure> {
    let refused = |text: String| Err(Failure::input(RequestCode::NotOfStudies, text));
    if scenario::is_input(&arguments.file) {
        return refused(format!("a {kind} is read from a file, not from standard input"));
    }
    if !arguments.set.is_empty() {
        return refused(format!("--set changes scenarios; give the values in the {kind}"));
    }
    Ok(())
}

/// Validates a study, and a sample of its runs.
fn study(arguments: &Check) -> Result<Status, Failure> {
    let study = Study::load_with(&arguments.file, scenario::access())?;
    let (parameters, results) = (study.parameters().len(), study.results().len());
    let contents =
        [runs(study.run_count()), count(parameters, "parameter"), count(results, "result")];
    let file = arguments.file.display();
    terminal::print(&format!("{file}: no errors; {}\n", contents.join(", ")))?;
    terminal::print(&format!("{}\n", study.how_runs_go()))?;
    let stage_messages = StageMessages::new("a sample of its runs");
    let (invalid, looked_at) = study.check_sample(SAMPLE);
    drop(stage_messages);
    let mut denied = Vec::new();
    if !invalid.is_empty() {
        let of = if looked_at < study.run_count() { "a sample of " } else { "" };
        let bad = runs(invalid.len() as u64);
        let [are, have] = if invalid.len() == 1 { ["is", "has"] } else { ["are", "have"] };
        let text = format!(
            "{bad} of {of}{looked_at} {are} invalid and {have} a reason instead of results:"
        );
        denied.extend(advisor::warn(Caution::InvalidRuns, &text, &arguments.deny));
    }
    let mut printed: Vec<&str> = Vec::new();
    for one in &invalid {
        if printed.len() < FEW && !printed.contains(&one.reason.as_str()) {
            terminal::warning(Caution::InvalidRuns, &format!("run {}: {}", one.run, one.reason));
            printed.push(&one.reason);
        }
    }
    refuse(denied)
}

/// The estimated run time from the first steps, if it is long.
fn running_time(ready: &Ready) -> Option<String> {
    let (model, settings) = (&ready.compiled.model, &ready.compiled.settings);
    let mut run = Simulation::new(model, settings).ok()?;
    let mut watch = Watch(Instant::now());
    while !watch.is_over() && run.state().time < settings.end {
        run.advance(&mut watch).ok()?;
    }
    let seconds = watch.0.elapsed().as_secs_f64();
    let all = seconds * settings.end / run.state().time;
    (all > LONG).then(|| {
        let how_long = if all.is_finite() { duration(all) } else { "very long".to_owned() };
        format!("estimated run time {how_long} (from the first {})", duration(seconds))
    })
}

/// Stops a run that is tried out.
struct Watch(Instant);

impl Watch {
    fn is_over(&self) -> bool {
        self.0.elapsed() >= TRIAL
    }
}

impl Recorder for Watch {
    fn wants_rows(&self) -> bool {
        false
    }

    fn progress(&mut self, _: f64) -> Flow {
        if self.is_over() { Flow::Stop } else { Flow::Continue }
    }
}

/// Warnings that are denied fail the command.
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
    let nodes = model.beam_node_count();
    let settings = &ready.compiled.settings;
    let steps = match settings.accuracy {
        Some(accuracy) => format!("steps for an accuracy of {} %", number(100.0 * accuracy)),
        None => count(settings.step_count(), "step"),
    };
    let mut parts = vec![
        count(content.beam.len(), "beam"),
        format!("{}{}", count(model.element_count(), "element"), short_elements(model)),
        count(nodes, "node"),
    ];
    let present = |n: usize, noun: &str| (n > 0).then(|| count(n, noun));
    parts.extend(present(content.joint.len(), "joint"));
    parts.push(count(content.support.len(), "support"));
    parts.extend(present(content.spring.len(), "spring"));
    parts.extend(present(content.foundation.len(), "foundation"));
    match content.mass.len() {
        0 => {}
        1 => parts.push("1 point mass".to_owned()),
        masses => parts.push(format!("{masses} point masses")),
    }
    parts.push(count(content.projectile.len(), "projectile"));
    parts.extend(present(content.obstacle.len(), "obstacle"));
    parts.extend(loads(ready));
    if model.beam_count() > 0 {
        parts.push(format!("mass of the beams {}", quantity(beam_mass(model), "kg")));
    }
    parts.push(steps);
    parts.join(", ")
}

/// That elements are short where plastic hinges may form, with the number of such places.
fn short_elements(model: &Model) -> String {
    let beams = (0..model.beam_count()).map(|beam| model.beam(beam));
    let short = beams.filter(|beam| beam.has_short_elements());
    match short.map(|beam| beam.hinge_places().len()).sum() {
        0 => String::new(),
        places => format!(" (short at {}: `grading`)", count(places, "possible plastic hinge")),
    }
}

/// Loads by their kind.
fn loads(ready: &Ready) -> Vec<String> {
    let all = &ready.scenario.content().load;
    let of_kind = |is: fn(&LoadKind) -> bool| all.iter().filter(|one| is(&one.table.kind)).count();
    let gravity = of_kind(|kind| matches!(kind, LoadKind::Gravity { .. }));
    let point = of_kind(|kind| matches!(kind, LoadKind::Point { .. }));
    let distributed = of_kind(|kind| matches!(kind, LoadKind::Distributed { .. }));
    let heat = of_kind(|kind| matches!(kind, LoadKind::Temperature { .. }));
    let strain = of_kind(|kind| matches!(kind, LoadKind::Strain { .. }));
    let base = of_kind(|kind| matches!(kind, LoadKind::Base { .. }));
    let each = [
        (point, "point load"),
        (distributed, "distributed load"),
        (heat, "temperature load"),
        (strain, "given strain"),
        (base, "base acceleration"),
    ];
    let each = each.into_iter().filter(|(n, _)| *n > 0).map(|(n, noun)| count(n, noun));
    (gravity > 0).then(|| "gravity".to_owned()).into_iter().chain(each).collect()
}

/// Mass of all beams, without point masses \[kg\].
fn beam_mass(model: &Model) -> f64 {
    let spans = (0..model.beam_count()).flat_map(|beam| model.beam(beam).spans());
    let elements =
        spans.flat_map(|span| (0..span.element_count()).map(move |k| span.gauss_points(k)));
    elements.flatten().map(|point| point.weight * point.section.mass).sum()
}
