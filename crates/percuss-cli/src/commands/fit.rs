//! `percuss fit`.

use std::path::Path;

use percuss::Fault;
use percuss_codes::Caution;
use percuss_fit::{Fit, FitError, Problem, Supplied, fit_text, fit_value, write_fit};
use percuss_output::{Extent, Results};
use percuss_scenario::{FitFile, one_of};

use crate::fit_arguments::FitArguments;
use crate::interrupt;
use crate::number::count;
use crate::outcome::{Failure, Status};
use crate::stage_messages::StageMessages;
use crate::{scenario, terminal};

/// Finds parameters of a scenario from measured curves.
pub fn run(arguments: &FitArguments) -> Result<Status, Failure> {
    let file = FitFile::load_with(&arguments.file, scenario::access())?;
    let out = arguments.out.clone().unwrap_or_else(|| scenario::results(&arguments.file, "-fit"));
    let directory = interrupt::directory(Results::Fit, &out)?;
    let fit = match found(&file, arguments) {
        Ok(fit) => fit,
        Err(error) => return refused(error),
    };
    write_fit(directory.path(), &fit)
        .map_err(|(path, error)| Failure::system(&path, "write", &error))?;
    interrupt::commit(directory, Extent::Complete)?;
    if arguments.json {
        terminal::print(&format!("{:#}\n", fit_value(&fit)))?;
    } else if !arguments.quiet {
        terminal::print(&fit_text(&Fit { doubts: Vec::new(), ..fit.clone() }))?;
        terminal::tell(&format!("results  {}", out.display()));
    }
    fit.doubts.iter().for_each(|doubt| terminal::warning(Caution::Fit, &doubt.text));
    Ok(if fit.success { Status::Done } else { Status::GaveUp })
}

/// Validates the file of a fit, and prints what it contains. Tests that are aligned by their onset are run once.
pub fn check(path: &Path) -> Result<Status, Failure> {
    let file = FitFile::load_with(path, scenario::access())?;
    let goes_on = || true;
    match Problem::new(&file, &Supplied::default(), 0, &goes_on) {
        Ok(problem) => {
            let (free, values) = (problem.free().count(), problem.residual_count());
            let counts = [count(free, "free parameter"), count(file.content.test.len(), "test")];
            let text = format!(
                "{}: no errors; {}, {}\n",
                scenario::name(path),
                counts.join(", "),
                count(values, "residual")
            );
            terminal::print(&text)?;
            Ok(Status::Done)
        }
        Err(error) => refused(error),
    }
}

/// Tells why there is no fit.
fn refused(error: FitError) -> Result<Status, Failure> {
    match error {
        FitError::Faults(faults) => Err(Failure::Faults { faults, changed: false }),
        FitError::Run(code, why) => {
            terminal::error(code, &why);
            Ok(Status::GaveUp)
        }
        FitError::Interrupted => {
            terminal::warning(Caution::Interrupted, "interrupted; nothing is written");
            Ok(Status::Interrupted)
        }
        FitError::System(error) => Err(error.into()),
    }
}

/// Values on either side of a profile.
const POINTS: usize = 8;

fn found(file: &FitFile, arguments: &FitArguments) -> Result<Fit, FitError> {
    interrupt::end_between_steps();
    let goes_on = || !interrupt::requested();
    let saying =
        (!arguments.quiet).then(|| StageMessages::of("fitting", "runs at the starting values"));
    let stage = |stage| saying.iter().for_each(|one| one.stage(stage));
    let jobs = arguments.jobs.map_or(0, |jobs| jobs as usize);
    let problem = Problem::new(file, &Supplied::default(), jobs, &goes_on)?;
    file.settle(arguments.profile.iter().filter_map(|name| not_free(&problem, name)).collect())?;
    stage("minima from the starting points");
    let minima = problem.minima(&goes_on)?;
    stage("runs for the diagnosis");
    let mut fit = problem.diagnose(minima, &goes_on)?;
    for (k, name) in arguments.profile.iter().enumerate() {
        if arguments.profile[..k].contains(name) {
            continue;
        }
        stage("runs for a profile");
        if let Some(profile) = problem.profile(&fit, name, POINTS, &goes_on)? {
            fit.add(profile);
        }
    }
    fit.runs = problem.runs();
    Ok(fit)
}

/// What is wrong with the name of a parameter whose profile is wanted.
fn not_free(problem: &Problem, name: &str) -> Option<Fault> {
    let free: Vec<&str> = problem.free().map(|one| one.name.as_str()).collect();
    (!free.contains(&name)).then(|| {
        let found = format!("no free parameter `{name}` for --profile");
        Fault::new("parameter", found, one_of(name, free.iter().copied()))
    })
}
