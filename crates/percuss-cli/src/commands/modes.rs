//! `percuss modes`.

use percuss::{
    AnalysisCode, Caution, Equilibrium, Frame, Mode, ModeKind, Start, equilibrium, modes_about,
    modes_about_equilibrium, reference_state, slack_members, stops,
};
use percuss_output::{Extent, ModesInfo, Results, modes_value, write_modes};

use crate::arguments::{About, Modes};
use crate::interrupt;
use crate::number::number;
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
        let text = "no modes: nothing has mass, or the tangent is singular";
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
        terminal::print(&table(about, loaded.as_ref().is_some_and(presses), &modes))?;
        for member in slack_members(model, &state) {
            terminal::tell(&format!(
                "slack    {}, {} m of {} m: no stiffness there, its mass alone takes part",
                member.beam,
                number(member.slack),
                number(member.length)
            ));
        }
        for stop in stops(model, &state) {
            let (stands, takes) = if stop.closed {
                ("closed", "its stiffness takes part")
            } else {
                ("open", "no stiffness there")
            };
            terminal::tell(&format!("stop     {}, {stands}: {takes}", stop.name));
        }
        terminal::tell(&format!("results  {}", out.display()));
    }
    let unstable = modes.iter().filter(|m| m.growth() > 0.0).count();
    if unstable > 0 {
        let grow = if unstable == 1 { "1 mode grows" } else { &format!("{unstable} modes grow") };
        terminal::warning(Caution::Unstable, &format!("the equilibrium is unstable: {grow}"));
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

fn table(about: About, pressed: bool, modes: &[Mode]) -> String {
    let about = match about {
        About::Reference => "the reference configuration",
        About::Static if pressed => {
            "static equilibrium, contacts that press held closed, those of discs left out"
        }
        About::Static => "static equilibrium",
    };
    let mut text = format!("natural modes about {about}\n  mode  frequency [Hz]    period [s]\n");
    for (k, mode) in modes.iter().enumerate() {
        let told = || (number(mode.frequency()), number(1.0 / mode.frequency()));
        let ((frequency, period), note) = match mode.kind() {
            ModeKind::Vibration => (told(), String::new()),
            ModeKind::RigidBody => {
                (("0".into(), "-".into()), "motion of a rigid body, or of a mechanism".to_owned())
            }
            ModeKind::Unstable => {
                (("-".into(), "-".into()), "grows: the equilibrium is unstable".to_owned())
            }
            ModeKind::Flutter => (
                told(),
                format!(
                    "flutter: grows at {} 1/s, fed by loads that follow",
                    number(mode.growth())
                ),
            ),
        };
        let line = format!("  {:>4}  {frequency:>14}  {period:>12}  {note}", k + 1);
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}
