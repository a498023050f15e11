//! Free motion of a shear-flexible beam: its balances, and the schemes that refuse it.

use super::*;

/// A free beam that turns by half a radian a step, and vibrates.
fn tumbling() -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material { poisson: Some(0.2), ..Material::new("m", 400.0, 1.0) });
    let section = b.section(Section { shear_factor: Some(0.9), ..Section::new("s", 1.0, 0.01) });
    let arm = b.beam(shear(1.0, 6, material, section));
    b.point_mass(PointMass {
        name: "bob".into(),
        at: at("bob", arm, 0.7),
        mass: 0.2,
        rotary_inertia: 0.003,
    });
    b.initial_motion(InitialMotion { velocity: [1.0, 0.5], spin: 10.0, about: [0.3, 0.1] });
    b.build().unwrap()
}

#[test]
fn a_tumbling_beam_keeps_energy_and_momenta_and_its_vectors_their_length() {
    let model = tumbling();
    let settings = Settings::new(30.0, 0.05);
    let summary = run(&model, &settings);
    assert!(worst(&summary) < 1e-11, "{:e}", worst(&summary));
    let mut simulation = Simulation::new(&model, &settings).unwrap();
    let mut strained = 0.0_f64;
    while simulation.state().step < simulation.step_count() {
        simulation.advance(&mut NoRecorder).unwrap();
        for u in &simulation.state().displacement {
            let length = (1.0 + u[2]).hypot(u[3]);
            assert!((length - 1.0).abs() < 1e-12, "{:e}", length - 1.0);
        }
        let u = &simulation.state().displacement;
        let last = u[u.len() - 1];
        strained = strained.max(((1.0 + last[0] - u[0][0]).hypot(last[1] - u[0][1]) - 1.0).abs());
    }
    assert!(strained > 0.01, "the beam is rigid: {strained:e}");
}

#[test]
fn balances_hold_over_many_steps() {
    let steps = if whole() { 100_000 } else { 5_000 };
    let summary = run(&tumbling(), &Settings::new(0.05 * f64::from(steps), 0.05));
    assert!(worst(&summary) < 1e-10, "{:e}", worst(&summary));
}

#[test]
fn other_schemes_refuse_shear_flexible_beams() {
    let model = tumbling();
    for scheme in [Scheme::StrainRate, Scheme::Midpoint, Scheme::Newmark] {
        let settings = Settings { scheme, ..Settings::new(1.0, 0.05) };
        let faults = Simulation::new(&model, &settings).err().unwrap();
        assert!(faults.iter().any(|f| f.path == "integrator.scheme"), "{faults:?}");
    }
}
