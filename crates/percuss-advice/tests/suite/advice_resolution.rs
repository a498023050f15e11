//! What the advisor says of a contact's duration and of the error of its force, against refinement of 30 scenes.

use crate::common;

use common::at;
use percuss::*;
use percuss_advice::*;

/// Steps of the half period of mass and spring, as in the table of docs/results.md.
const STEPS: [f64; 3] = [3.0, 5.0, 8.0];
/// Errors below this are reported as fine.
const REPORTED: f64 = 0.015;

fn scene(held: &str, kind: ProjectileKind, mass: f64, speed: f64, standoff: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(Section::rectangle("bar", 0.05, 0.05));
    let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [2.0, 0.0]], 40, material, section));
    let roller = SupportKind::Roller { direction: [1.0, 0.0] };
    let supports = match held {
        "pinned" => vec![(0.0, SupportKind::Pin), (1.0, roller)],
        "clamped" => vec![(0.0, SupportKind::Clamp), (1.0, SupportKind::Clamp)],
        "propped" => vec![(0.0, SupportKind::Clamp), (1.0, roller)],
        "cantilever" => vec![(0.0, SupportKind::Clamp)],
        _ => Vec::new(),
    };
    for (end, kind) in supports {
        b.support(Support::new(format!("at {end}"), at("end", beam, end), kind));
    }
    let place = if held == "cantilever" { 1.0 } else { 0.5 };
    let one = Projectile::new("mass", kind, mass, [0.0, -speed], at("place", beam, place));
    b.projectile(Projectile { standoff, ..one });
    b.build().unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// Peak force and duration of the first contact.
fn impact(model: &Model, end: f64, step: f64) -> [f64; 2] {
    let run = simulate(model, &Settings::new(end, step), &mut NoRecorder);
    let run = run.unwrap_or_else(|faults| panic!("{faults:?}"));
    match &run.contacts[0].record {
        ContactRecord::Smooth { intervals, .. } => {
            let first = &intervals[0];
            [first.peak_force.value, first.end - first.start]
        }
        ContactRecord::Nonsmooth { .. } => [f64::NAN; 2],
    }
}

/// The error in per cent that a text foretells.
fn predicted(text: &str) -> Option<f64> {
    let (_, rest) = text.split_once("error of the peak force ")?;
    rest.split_once(" %")?.0.parse::<f64>().ok().map(|percent| 0.01 * percent)
}

#[test]
fn durations_and_errors_are_those_that_refinement_shows() {
    let linear = |k: f64| ProjectileKind::spring(k);
    let hertz = |stiffness: f64| {
        let law = SmoothLaw::elastic(Potential::Hertz { stiffness });
        ProjectileKind::Elastic { law }
    };
    let pi = std::f64::consts::PI;
    let rigid = |m: f64, k: f64| pi * (m / k).sqrt();
    let ball = |m: f64, k: f64, v: f64| 3.218_07 * (m * m / (k * k * v)).powf(0.2);
    let blows = [
        (linear(1e6), 1.0, 0.1, rigid(1.0, 1e6)),
        (linear(5e7), 1.0, 0.1, rigid(1.0, 5e7)),
        (linear(1e6), 20.0, 0.1, rigid(20.0, 1e6)),
        (linear(5e5), 300.0, 0.05, rigid(300.0, 5e5)),
        (linear(5e7), 300.0, 0.05, rigid(300.0, 5e7)),
        (hertz(2e10), 0.5, 0.5, ball(0.5, 2e10, 0.5)),
        (hertz(1e9), 30.0, 0.1, ball(30.0, 1e9, 0.1)),
    ];
    let mut reported = 0;
    let mut scenes = 0;
    for held in ["pinned", "clamped", "cantilever", "free", "propped"] {
        // Two more of a propped beam make thirty.
        let these = if held == "propped" { &blows[2..4] } else { &blows[..] };
        for (kind, mass, speed, half) in these {
            scenes += 1;
            let at = |standoff| scene(held, kind.clone(), *mass, *speed, standoff);
            let fine = at(0.0);
            let [force, duration] = impact(&fine, 2.0 * half, half / 150.0);
            let name = format!("{held}, {kind:?}, {mass} kg");
            let mut row = format!("| {name} | {:.3} ms |", 1e3 * duration);
            for steps in STEPS {
                let step = half / steps;
                let advice = advise(&fine, &Settings::new(3.0 * half, step));
                let found = advice.iter().find(|a| a.topic == Topic::ContactDuration);
                let found = found.unwrap_or_else(|| panic!("{name}"));
                if duration.is_finite() {
                    assert!((found.value / duration - 1.0).abs() < 0.05, "{name}: {found:?}");
                }
                let squares: f64 = [0.0, 0.37, 0.74]
                    .map(|early| impact(&at(early * step * speed), 3.0 * half, step)[0])
                    .map(|found| (found / force - 1.0).powi(2))
                    .iter()
                    .sum();
                let off = (squares / 3.0).sqrt();
                let says = predicted(&found.text)
                    .map_or(found.verdict.name().to_owned(), |x| (100.0 * x).to_string());
                row += &format!(" {says}, {:.2} |", 100.0 * off);
                match predicted(&found.text) {
                    // Rounded to a per cent.
                    Some(says) => {
                        reported += 1;
                        let ratio = says / off;
                        let near = (says - off).abs() < 0.006;
                        assert!(
                            (0.5..=2.0).contains(&ratio) || near,
                            "{name}, {steps}: {says} {off}"
                        );
                    }
                    None if found.verdict == Verdict::Fine
                        || found.text.contains("accurate to 1 %") =>
                    {
                        assert!(off < REPORTED, "{name}, {steps}: {off} is told as fine");
                    }
                    None => {
                        assert!(duration / step < 2.05 || duration.is_nan(), "{name}: {found:?}")
                    }
                }
            }
            println!("{row}");
        }
    }
    assert_eq!(scenes, 30);
    assert!(reported >= 30, "{reported}");
}
