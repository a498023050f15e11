//! `percuss check`.

use percuss::{ContactRecord, Simulation};

use crate::arguments::Check;
use crate::number::count;
use crate::outcome::{Failure, Status};
use crate::scenario::{self, Ready};
use crate::{effective_mass, terminal};

/// Says what is wrong with a scenario, or what is in it.
pub fn run(arguments: &Check) -> Result<Status, Failure> {
    let ready = scenario::read(&arguments.file, &arguments.set)?;
    terminal::print(&format!("{}: sound: {}\n", arguments.file.display(), contents(&ready)))?;
    let compiled = &ready.compiled;
    for contact in effective_mass::of_model(&compiled.model, &compiled.settings) {
        if matches!(contact.record, ContactRecord::Nonsmooth { .. }) {
            terminal::tell(&format!(
                "projectile `{}`: {}",
                contact.name,
                effective_mass::line(&contact)
            ));
            if let Some(text) = effective_mass::warning(&contact) {
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
