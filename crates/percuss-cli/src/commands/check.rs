//! `percuss check`.

use percuss::{EffectiveMass, Simulation, Topic, advise};

use crate::arguments::Check;
use crate::number::count;
use crate::outcome::{Failure, Status};
use crate::scenario::{self, Ready};
use crate::{advisor, effective_mass, terminal};

/// Says what is wrong with a scenario, or what is in it.
pub fn run(arguments: &Check) -> Result<Status, Failure> {
    let ready = scenario::read(&arguments.file, &arguments.set)?;
    terminal::print(&format!("{}: sound: {}\n", arguments.file.display(), contents(&ready)))?;
    let (model, settings) = (&ready.compiled.model, &ready.compiled.settings);
    let advice = advise(model, settings);
    for one in advice.iter().filter(|one| one.topic == Topic::EffectiveMass) {
        let mass = EffectiveMass { on_mesh: one.value, limit: one.reference };
        let line = effective_mass::line(&mass);
        terminal::tell(&format!("projectile `{}`: {line}", one.contact));
    }
    advisor::tell(&advice);
    Ok(Status::Done)
}

fn contents(ready: &Ready) -> String {
    let (content, model) = (ready.scenario.content(), &ready.compiled.model);
    // The model's own count has a node for every projectile and obstacle.
    let nodes = model.beam_names().filter_map(|name| model.beam_nodes(name)).map(|n| n.len()).sum();
    let steps = Simulation::new(model, &ready.compiled.settings).map_or(0, |s| s.step_count());
    [
        count(content.beam.len(), "beam"),
        count(model.element_count(), "element"),
        count(nodes, "node"),
        count(content.projectile.len(), "projectile"),
        count(steps, "step"),
    ]
    .join(", ")
}
