//! Reference values of the residuals of balances.

use crate::common;

use common::*;
use percuss::*;

fn run(model: &Model, settings: &Settings) -> RunSummary {
    Simulation::new(model, settings).unwrap().run(&mut NoRecorder)
}

/// A steel cantilever of 50 x 50 mm, 1 m long, that leaves its clamp in a direction.
fn cantilever(b: &mut ModelBuilder, from: [f64; 2], to: [f64; 2]) -> BeamId {
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = b.section(Section::new("square", 2.5e-3, 5.208e-7));
    let beam = b.beam(beam("beam", from, to, 8, material, section));
    b.support(Support::new("root", at("root", beam, 0.0), SupportKind::Clamp));
    beam
}

#[test]
fn motion_towards_the_origin_has_a_scale_of_angular_momentum() {
    // A bar along the first axis, pulled axially: no part of it has an angular momentum about the origin, unlike a mass of 20 kg that moves at 0.1
    // m/s at a distance of half a metre.
    let mut b = ModelBuilder::new();
    let beam = cantilever(&mut b, [0.0, 0.0], [1.0, 0.0]);
    let tip = at("tip", beam, 1.0);
    b.load(Load::new(
        "pull",
        LoadKind::Point { at: tip, force: [1e4, 0.0], moment: 0.0, follower: false },
    ));
    let found = run(&b.build().unwrap(), &Settings::new(5e-3, 5e-6)).momentum;
    assert!(found.angular_scale > 0.5, "{found:?}");
    assert!(found.angular_residual_max < 1e-11, "{found:?}");
}

#[test]
fn a_structure_at_rest_closes_its_balances() {
    for loaded in [false, true] {
        let mut b = ModelBuilder::new();
        let beam = cantilever(&mut b, [0.3, 0.2], [0.9, 1.0]);
        if loaded {
            let tip = at("tip", beam, 1.0);
            b.load(Load::new(
                "push",
                LoadKind::Point { at: tip, force: [30.0, -400.0], moment: 0.0, follower: false },
            ));
        }
        let settings = Settings { start: Start::Static, ..Settings::new(2e-3, 1e-5) };
        let found = run(&b.build().unwrap(), &settings);
        let reported = format!("{loaded}: {:?} {:?}", found.energy, found.momentum);
        assert!(found.energy.residual_max < 1e-10, "{reported}");
        assert!(found.momentum.linear_residual_max < 1e-10, "{reported}");
        assert!(found.momentum.angular_residual_max < 1e-10, "{reported}");
    }
}

#[test]
fn momentum_passed_through_is_a_scale() {
    // A cantilever at rest under its weight: no momentum, and weight and clamp have opposite impulses in each step.
    let mut b = ModelBuilder::new();
    let _ = cantilever(&mut b, [0.0, 0.0], [1.0, 0.0]);
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let settings = Settings { start: Start::Static, ..Settings::new(2.0, 1e-3) };
    let found = run(&b.build().unwrap(), &settings).momentum;
    let passed = 2.0 * 7850.0 * 2.5e-3 * 9.81 * 2.0;
    assert!((found.linear_scale / passed - 1.0).abs() < 1e-6, "{found:?}");
    assert!(found.linear_residual_max < 1e-14, "{found:?}");
}
