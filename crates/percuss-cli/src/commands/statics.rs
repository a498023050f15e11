//! `percuss static`.

mod print;

use std::path::PathBuf;

use percuss::{
    AnalysisCode, Equilibrium, Error, LinearBuckling, Model, Path, buckling_in_contact,
    equilibrium, equilibrium_path_recorded,
};
use percuss_output::{
    EquilibriumInfo, Extent, PathInfo, PathShapes, Results, equilibrium_value, path_value,
    write_equilibrium, write_path,
};
use serde_json::Value;

use crate::advisor;
use crate::arguments::Static;
use crate::interrupt;
use crate::number::number;
use crate::outcome::{Failure, Status};
use crate::scenario::{self, Ready};
use crate::terminal;

/// Finds the static equilibrium of a scenario, or follows the path to it, and prints what it carries.
pub fn run(arguments: &Static) -> Result<Status, Failure> {
    let ready = scenario::read(&arguments.file, &arguments.set)?;
    ready.refuse_without_beam("static equilibria")?;
    ready.refuse_mechanism(&arguments.set)?;
    if arguments.path {
        return follow(arguments, &ready);
    }
    let model = &ready.compiled.model;
    let found = match equilibrium(model) {
        Ok(found) => found,
        Err(error) => return Ok(gave_up(&error)),
    };
    let linear = buckling_in_contact(model, &found, 1);
    let info = EquilibriumInfo {
        title: &ready.compiled.title,
        scene: &ready.scenario.scene(model),
        found: &found,
        linear: &linear,
        model,
    };
    let out = out(arguments, "-static");
    let directory = interrupt::directory(Results::Static, &out)?;
    write_equilibrium(directory.path(), &info)?;
    interrupt::commit(directory, Extent::Complete)?;
    if arguments.json {
        terminal::print(&format!("{:#}\n", equilibrium_value(model, &found, &linear)))?;
    } else {
        terminal::print(&print::table(model, &found, &linear))?;
        terminal::tell(&format!("results  {}", out.display()));
    }
    warn(&ready, &found);
    Ok(Status::Done)
}

/// Warns of stresses that the materials of the scenario do not bear.
fn warn(ready: &Ready, found: &Equilibrium) {
    let mut advice = percuss_advice::at_rest(&ready.compiled.model, found);
    advisor::judge(&mut advice, ready.scenario.content());
    advisor::tell(&advice);
}

/// Where the results go.
fn out(arguments: &Static, suffix: &str) -> PathBuf {
    arguments.out.clone().unwrap_or_else(|| scenario::results(&arguments.file, suffix))
}

/// Why load steps found nothing; the core says why, here is what to do about it.
fn gave_up(error: &Error) -> Status {
    terminal::error(error.code(), &error.to_string());
    if error.is_no_convergence() {
        terminal::tell(
            "`percuss static --path` follows the equilibrium by arc length and shows how far it goes",
        );
    }
    Status::GaveUp
}

/// Follows the equilibrium path; what was found is written even if its end was not reached.
fn follow(arguments: &Static, ready: &Ready) -> Result<Status, Failure> {
    let compiled = &ready.compiled;
    let scene = ready.scenario.scene(&compiled.model);
    let mut shapes = PathShapes::new(&scene);
    let found = equilibrium_path_recorded(&compiled.model, &compiled.path, &mut shapes);
    let path = match found {
        Ok(path) => path,
        Err(error) => {
            terminal::error(error.code(), &error.to_string());
            terminal::tell("a path begins with the response to the loads that act at time zero");
            return Ok(Status::GaveUp);
        }
    };
    let linear = buckling_in_contact(&compiled.model, &path.end, 1);
    let value = as_json(&compiled.model, &path, &linear);
    let out = out(arguments, "-path");
    let directory = interrupt::directory(Results::Path, &out)?;
    let info = PathInfo { title: &compiled.title, scene: &scene, path: &path, linear: &linear };
    write_path(directory.path(), &info, shapes, &value)?;
    interrupt::commit(directory, Extent::Complete)?;
    if arguments.json {
        terminal::print(&format!("{value:#}\n"))?;
    } else {
        terminal::print(&print::path(&path))?;
        terminal::print(&print::table(&compiled.model, &path.end, &linear))?;
        terminal::tell(&format!("results  {}", out.display()));
    }
    warn(ready, &path.end);
    if path.reached {
        return Ok(Status::Done);
    }
    let factor = path.points.last().map_or(0.0, |p| p.factor);
    let why = match &path.torn {
        Some(what) => format!("'{what}' would fail beyond it"),
        None => "see [path] in the scenario for its first arc, end and number of points".to_owned(),
    };
    let text = format!(
        "the path stopped at load factor {}, after {} points: {why}",
        number(factor),
        path.points.len() - 1,
    );
    terminal::error(AnalysisCode::PathEnds, &text);
    Ok(Status::GaveUp)
}

fn as_json(model: &Model, path: &Path, linear: &LinearBuckling) -> Value {
    let mut value = equilibrium_value(model, &path.end, linear);
    value["path"] = path_value(path);
    value
}
