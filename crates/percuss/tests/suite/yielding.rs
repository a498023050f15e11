//! Beams that yield: balances, closed forms, hinges.

use crate::common;

use common::*;
use percuss::*;

/// Steel that yields at 250 MPa, perfectly plastic unless changed.
fn steel(change: impl FnOnce(&mut Plasticity)) -> Material {
    let mut plasticity = Plasticity {
        curve: vec![Hardening { from: 0.0, stress: 250e6, modulus: 0.0 }],
        kinematic: 0.0,
        overstress: None,
        failure_strain: None,
    };
    change(&mut plasticity);
    let inelasticity = Some(Inelasticity::Plastic(plasticity));
    Material {
        strain: StrainMeasure::Engineering,
        inelasticity,
        ..Material::new("steel", 205e9, 7850.0)
    }
}

fn assert_balances(summary: &RunSummary, name: &str) {
    assert!(matches!(summary.termination, Termination::Completed), "{name}: {summary:?}");
    assert!(summary.energy.residual_max < 1e-10, "{name}: {:e}", summary.energy.residual_max);
    assert!(summary.momentum.linear_residual_max < 1e-10, "{name}");
    assert!(summary.momentum.angular_residual_max < 1e-10, "{name}");
}

/// A bar of 20 x 20 x 400 mm, clamped at both ends, thrown at 40 m/s.
fn thrown_bar(material: Material, step: f64) -> RunSummary {
    let mut b = ModelBuilder::new();
    let material = b.material(material);
    let section = b.section(Section::rectangle("square", 0.02, 0.02));
    let bar = b.beam(beam("bar", [0.0, 0.0], [0.4, 0.0], 10, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, bar, f), SupportKind::Clamp));
    }
    b.record_point(at("mid", bar, 0.5));
    let model = b.build().unwrap();
    let mut run = Simulation::new(&model, &Settings::new(2e-3, step)).unwrap();
    run.set_velocities(|_, x| if x[0] > 0.01 && x[0] < 0.39 { [0.0, 40.0] } else { [0.0; 2] });
    run.run(&mut NoRecorder)
}

#[test]
fn a_thrown_bar_closes_its_balance_whatever_it_yields_by() {
    let rate = Some(Overstress { rate: 40.4, exponent: 5.0 });
    let table = vec![
        Hardening { from: 0.0, stress: 250e6, modulus: 4e9 },
        Hardening { from: 0.02, stress: 330e6, modulus: 0.0 },
    ];
    let cases = [
        ("perfect", steel(|_| {})),
        ("isotropic", steel(|p| p.curve[0].modulus = 2e9)),
        ("kinematic", steel(|p| p.kinematic = 2e9)),
        ("rate", steel(|p| p.overstress = rate)),
        ("table", steel(|p| p.curve = table)),
        ("green", Material { strain: StrainMeasure::Green, ..steel(|_| {}) }),
        ("viscous", Material { retardation: 1e-6, ..steel(|_| {}) }),
        ("fails", steel(|p| p.failure_strain = Some(0.05))),
    ];
    for (name, material) in cases {
        let summary = thrown_bar(material, 1e-5);
        println!(
            "{name}: {:?} {} iterations {} steps",
            summary.energy, summary.newton_iterations, summary.steps
        );
        let bar = &summary.plastic[0];
        println!("   {:?}", bar);
        assert_balances(&summary, name);
        assert!(summary.energy.plastic > 0.5 * summary.energy.initial, "{name}");
        let own = bar.dissipated / summary.energy.plastic - 1.0;
        assert!(own.abs() < 1e-12, "{name}: {own:e}");
    }
}
