//! `percuss static`.

use percuss::{Equilibrium, SectionPeak, equilibrium, mechanism};
use serde_json::{Map, Value, json};

use crate::arguments::Static;
use crate::number::{count, number};
use crate::outcome::{Failure, Status};
use crate::{scenario, terminal};

/// Finds the static equilibrium of a scenario and prints displacements and section forces.
pub fn run(arguments: &Static) -> Result<Status, Failure> {
    let ready = scenario::read(&arguments.file, &arguments.set)?;
    let model = &ready.compiled.model;
    if let Some(fault) = mechanism(model) {
        let faults = Box::new(ready.scenario.diagnostics(vec![fault]));
        return Err(Failure::Faults { faults, changed: !arguments.set.is_empty() });
    }
    match equilibrium(model) {
        Ok(found) if arguments.json => terminal::print(&format!("{:#}\n", as_json(&found)))?,
        Ok(found) => terminal::print(&as_table(&found))?,
        Err(error) => {
            terminal::error(&error.to_string());
            return Ok(Status::GaveUp);
        }
    }
    Ok(Status::Done)
}

fn as_json(found: &Equilibrium) -> Value {
    let peak = |p: &SectionPeak| json!({ "value": p.value, "s": p.s });
    let points = found.points.iter().map(|(name, u)| (name.clone(), json!({ "displacement": u })));
    let forces = found.section_forces.iter().map(|b| {
        let all = json!({
            "moment_max": peak(&b.moment_max),
            "axial_max": peak(&b.axial_max),
            "shear_max": peak(&b.shear_max),
        });
        (b.name.clone(), all)
    });
    json!({
        "load_steps": found.load_steps,
        "newton_iterations": found.newton_iterations,
        "point": points.collect::<Map<_, _>>(),
        "section_forces": forces.collect::<Map<_, _>>(),
    })
}

fn as_table(found: &Equilibrium) -> String {
    let steps = count(found.load_steps, "load step");
    let mut text =
        format!("equilibrium in {steps}, {} Newton iterations\n", found.newton_iterations);
    for (name, [u1, u2]) in &found.points {
        text.push_str(&format!("  {name}: displacement {} m, {} m\n", number(*u1), number(*u2)));
    }
    if found.points.is_empty() {
        text.push_str("  no points recorded: `[record] points = [\"beam.mid\"]` names some\n");
    }
    for b in &found.section_forces {
        let line = |what: &str, p: &SectionPeak, unit: &str| {
            format!("{what} {} {unit} at {} m", number(p.value), number(p.s))
        };
        text.push_str(&format!(
            "  {}: largest {}, {}, {}\n",
            b.name,
            line("moment", &b.moment_max, "N m"),
            line("axial force", &b.axial_max, "N"),
            line("shear force", &b.shear_max, "N"),
        ));
    }
    text
}
