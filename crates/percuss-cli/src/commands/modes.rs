//! `percuss modes`.

use percuss::{
    AnalysisCode, Caution, Equilibrium, Frame, ModeKind, Start, equilibrium, modes_about,
    modes_about_equilibrium, reference_state, slack_members, stops,
};
use percuss_output::{Extent, ModesInfo, Results, modes_value, write_modes};

use crate::arguments::{About, Modes};
use crate::interrupt;
use crate::number::{number, quantity};
use crate::outcome::{Failure, Status};
use crate::scenario;
use crate::terminal;

/// Finds the natural modes of a scenario, prints and draws them.
pub fn run(arguments: &Modes) -> Result<Status, Failure> {
    let ready = scenario::read(&arguments.file, &arguments.set)?;
    ready.refuse_without_beam("natural modes")?;
    let compiled = &ready.compiled;
    let model = &compiled.model;
    let about = arguments.about.unwrap_or(match compiled.settings.start {
        Start::Reference => About::Reference,
        Start::Static => About::Static,
    });
    let count = arguments.count as usize;
    let (modes, state, loaded) = match about {
        About::Reference => {
            let state =
                reference_state(model).map_err(|faults| ready.refuse(faults, &arguments.set))?;
            (modes_about(model, &state, count), state, None)
        }
        About::Static => {
            ready.refuse_mechanism(&arguments.set)?;
            match equilibrium(model) {
                Ok(found) => {
                    let modes = modes_about_equilibrium(model, &found, count);
                    (modes, found.state.clone(), Some(found))
                }
                Err(error) => return Ok(gave_up(error.code(), &error.to_string())),
            }
        }
    };
    if modes.is_empty() {
        let text = "no modes: the model has no mass, or the tangent is singular";
        return Ok(gave_up(AnalysisCode::NoModes, text));
    }
    let info = ModesInfo {
        title: &compiled.title,
        about: word(about),
        model,
        displacement: &state.displacement,
        modes: &modes,
    };
    let out = arguments.out.clone().unwrap_or_else(|| scenario::results(&arguments.file, "-modes"));
    let directory = interrupt::directory(Results::Modes, &out)?;
    let unloaded = Frame {
        time: 0.0,
        displacement: &state.displacement,
        velocity: &[],
        spin: &[],
        section_points: &[],
        section_forces: &[],
        contact_forces: &[],
        load_factors: &[],
    };
    let frame = loaded.as_ref().map_or(unloaded, Equilibrium::frame);
    write_modes(directory.path(), &info, (&ready.scenario.scene(model), &frame))?;
    interrupt::commit(directory, Extent::Complete)?;
    if arguments.json {
        terminal::print(&format!("{:#}\n", modes_value(&info)))?;
    } else {
        let presses = |found: &Equilibrium| found.contacts.iter().any(|c| c.force > 0.0);
        terminal::print(&table(about, loaded.as_ref().is_some_and(presses), &info))?;
        for member in slack_members(model, &state) {
            terminal::tell(&format!(
                "slack    '{}': {} of {} (mass only, no stiffness)",
                member.beam,
                quantity(member.slack, "m"),
                quantity(member.length, "m")
            ));
        }
        for stop in stops(model, &state) {
            let state = match stop.closed {
                true => "closed, included as a spring",
                false => "open, no stiffness",
            };
            terminal::tell(&format!("stop     '{}': {state}", stop.name));
        }
        terminal::tell(&format!("results  {}", out.display()));
    }
    let unstable = modes.iter().filter(|m| m.growth() > 0.0).count();
    if unstable > 0 {
        let modes = crate::number::count(unstable, "unstable mode");
        terminal::warning(Caution::Unstable, &format!("unstable equilibrium: {modes}"));
    }
    Ok(Status::Done)
}

fn gave_up(code: AnalysisCode, text: &str) -> Status {
    terminal::error(code, text);
    Status::GaveUp
}

fn word(about: About) -> &'static str {
    match about {
        About::Reference => "reference",
        About::Static => "static",
    }
}

fn table(about: About, pressed: bool, info: &ModesInfo<'_>) -> String {
    let about = match about {
        About::Reference => "the reference configuration",
        About::Static if pressed => {
            "static equilibrium; active contacts closed, contacts of discs omitted"
        }
        About::Static => "static equilibrium",
    };
    let mut text = format!("natural modes about {about}\n  mode  frequency [Hz]    period [s]\n");
    for (k, mode) in info.modes.iter().enumerate() {
        let values = || (number(mode.frequency()), number(1.0 / mode.frequency()));
        let ((frequency, period), note) = match mode.kind() {
            ModeKind::Vibration if mode.is_second_spectrum(info.model) => {
                (values(), "second spectrum (rotation of shear-flexible sections)".to_owned())
            }
            ModeKind::Vibration => (values(), String::new()),
            ModeKind::RigidBody => {
                (("0".into(), "-".into()), "rigid-body mode or mechanism".to_owned())
            }
            ModeKind::Unstable => (("-".into(), "-".into()), "unstable mode".to_owned()),
            ModeKind::Flutter => (
                values(),
                format!("flutter: growth rate {} 1/s (follower loads)", number(mode.growth())),
            ),
        };
        let line = format!("  {:>4}  {frequency:>14}  {period:>12}  {note}", k + 1);
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}
