//! `percuss check`.

use percuss::Simulation;

use crate::arguments::Check;
use crate::number::count;
use crate::outcome::{Failure, Status};
use crate::scenario::{self, Ready};
use crate::{effective_mass, terminal};

/// Says what is wrong with a scenario, or what is in it.
pub fn run(arguments: &Check) -> Result<Status, Failure> {
    let ready = scenario::read(&arguments.file, &arguments.set)?;
    terminal::print(&format!("{}: sound: {}\n", arguments.file.display(), contents(&ready)))?;
    let model = &ready.compiled.model;
    for ((name, rigid), mass) in model.projectile_names().zip(model.effective_masses()) {
        if rigid {
            terminal::tell(&format!("projectile `{name}`: {}", effective_mass::line(&mass)));
            if let Some(text) = effective_mass::warning(name, &mass) {
                terminal::warning(&text);
            }
        }
    }
    Ok(Status::Done)
}

fn contents(ready: &Ready) -> String {
    let (content, model) = (ready.scenario.content(), &ready.compiled.model);
    let steps = Simulation::new(model, &ready.compiled.settings).map_or(0, |s| s.step_count());
    [
        count(content.beam.len(), "beam"),
        count(model.element_count(), "element"),
        count(model.node_count(), "node"),
        count(content.projectile.len(), "projectile"),
        count(steps, "step"),
    ]
    .join(", ")
}
