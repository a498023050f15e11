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
    thrown_bar_until(2e-3, material, step)
}

fn thrown_bar_until(end: f64, material: Material, step: f64) -> RunSummary {
    let mut b = ModelBuilder::new();
    let material = b.material(material);
    let section = b.section(Section::rectangle("square", 0.02, 0.02));
    let bar = b.beam(beam("bar", [0.0, 0.0], [0.4, 0.0], 10, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, bar, f), SupportKind::Clamp));
    }
    b.record_point(at("mid", bar, 0.5));
    let model = b.build().unwrap();
    let mut run = Simulation::new(&model, &Settings::new(end, step)).unwrap();
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

/// A cantilever of 50 x 3 x 5 mm under an end moment, elastic and perfectly plastic.
fn bent_cantilever(moment: f64, fibres: usize) -> Result<Equilibrium, Error> {
    let mut b = ModelBuilder::new();
    let first = Hardening { from: 0.0, stress: 1300e6, modulus: 0.0 };
    let material = steel(|p| p.curve[0] = first);
    let material = b.material(Material { young: 200e9, ..material });
    let section = b.section(Section { fibres, ..Section::rectangle("r", 3e-3, 5e-3) });
    let arm = beam("arm", [0.0, 0.0], [0.05, 0.0], 8, material, section);
    bent_by_end_moment(b, arm, moment)
}

#[test]
fn a_plastic_cantilever_bends_to_the_closed_form_as_fibres_are_added() {
    // kappa = (2 sy / (E h)) / sqrt(3 (1 - M / M0)), M0 = sy b h^2 / 4; a circular arc.
    let (young, limit, h, length, moment) = (200e9_f64, 1300e6_f64, 5e-3_f64, 0.05_f64, 22.0);
    let most = limit * 3e-3 * h * h / 4.0;
    let bent = 2.0 * limit / (young * h) / (3.0 * (1.0 - moment / most)).sqrt();
    let exact = [(bent * length).sin() / bent - length, (1.0 - (bent * length).cos()) / bent];
    // ANSYS LS-DYNA verification case 003: 49.52 and 5.982 mm.
    assert!(
        (exact[0] + length - 49.519593e-3).abs() < 1e-8 && (exact[1] - 5.982322e-3).abs() < 1e-8
    );
    let miss = |fibres: usize| {
        let found = bent_cantilever(moment, fibres).unwrap();
        let stress = found.section_forces[0].stress.largest().value;
        assert!((stress.abs() / limit - 1.0).abs() < 1e-9, "{stress:e}");
        (found.points[0].1[1] / exact[1] - 1.0).abs()
    };
    let (coarse, fine) = (miss(16), miss(96));
    assert!(coarse < 1e-2 && fine < 2e-4, "{coarse:e} {fine:e}");
    // No moment exceeds the plastic moment, which Gauss points represent to a share of their area.
    assert!(bent_cantilever(0.99 * most, 48).is_ok());
    assert!(bent_cantilever(1.001 * most, 48).is_err());
}

#[test]
fn a_bar_stretched_beyond_yield_has_no_hinges() {
    let mut b = ModelBuilder::new();
    let material = b.material(steel(|p| p.kinematic = 1e9));
    let section = b.section(Section::rectangle("r", 0.03, 0.01));
    let bar = b.beam(beam("bar", [0.0, 0.0], [0.5, 0.1], 20, material, section));
    b.support(Support::new("root", at("root", bar, 0.0), SupportKind::Clamp));
    let kind = LoadKind::Point {
        at: at("tip", bar, 1.0),
        force: [100e3, 20e3],
        moment: 0.0,
        follower: false,
    };
    b.load(Load::new("pull", kind));
    let model = b.build().unwrap();
    let summary = simulate(&model, &Settings::new(3e-4, 2e-6), &mut NoRecorder).unwrap();
    let bar = &summary.plastic[0];
    assert!(bar.accumulated_max.value > 1e-4, "{bar:?}");
    assert!(bar.hinges.is_empty(), "{:?}", bar.hinges);
}

#[test]
fn a_beam_thrown_off_its_supports_keeps_its_momenta_and_stays_bent() {
    let mut b = ModelBuilder::new();
    let material = b.material(steel(|p| p.kinematic = 1e9));
    let section = b.section(Section::i_shape("i", 0.05, 0.08, 0.006, 0.004));
    let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 12, material, section));
    for (i, f) in [0.3, 0.8].into_iter().enumerate() {
        b.projectile(Projectile {
            mass: 8.0,
            ..rigid(&format!("ball{i}"), at(&format!("p{i}"), bar, f), [0.0, -30.0], 0.5)
        });
    }
    let model = b.build().unwrap();
    let summary = simulate(&model, &Settings::new(0.01, 2e-5), &mut NoRecorder).unwrap();
    assert_balances(&summary, "free");
    let bar = &summary.plastic[0];
    assert!(bar.first_yield.is_some() && !bar.hinges.is_empty(), "{bar:?}");
    assert_eq!(bar.permanent_set, Err(NoPermanentSet::NotHeld), "{bar:?}");
    assert!(summary.energy.plastic > 1.0 && summary.energy.loss_impacts > 0.0);
}

#[test]
fn rigid_plastic_throw_of_a_simply_supported_beam_nears_its_closed_form() {
    // A velocity V on all of a beam of half span L: it comes to rest with m V^2 L^2 / (3 M0) in the middle, bending alone.
    let (half, h, v) = (0.5, 0.02, 12.0);
    let mut b = ModelBuilder::new();
    let material = b.material(steel(|_| {}));
    let section = b.section(Section::rectangle("r", 0.02, h));
    let bar = b.beam(beam("bar", [0.0, 0.0], [2.0 * half, 0.0], 20, material, section));
    b.support(Support::new("left", at("left", bar, 0.0), SupportKind::Pin));
    b.support(Support::new(
        "right",
        at("right", bar, 1.0),
        SupportKind::Roller { direction: [1.0, 0.0] },
    ));
    b.record_point(at("mid", bar, 0.5));
    let model = b.build().unwrap();
    let mut run = Simulation::new(&model, &Settings::new(0.03, 2e-5)).unwrap();
    run.set_velocities(|_, x| if x[0] > 1e-3 && x[0] < 0.999 { [0.0, v] } else { [0.0; 2] });
    let summary = run.run(&mut NoRecorder);
    assert_balances(&summary, "thrown");
    let mass = 7850.0 * 0.02 * h;
    let rigid = mass * v * v * half * half / (3.0 * 250e6 * 0.02 * h * h / 4.0);
    let set = summary.plastic[0].permanent_set.unwrap();
    // Thrown upwards it stays bent upwards, most of all in the middle.
    assert!((set.s - half).abs() < 1e-9 && set.displacement[1] > 0.0, "{set:?}");
    let set = set.size();
    // Elastic energy, a twelfth of the supplied energy, and rotations of 0.15 rad limit the agreement.
    assert!((set / rigid - 1.0).abs() < 0.06, "{set} {rigid} {:?}", summary.energy);
}

#[test]
fn an_elastic_bar_tells_when_and_where_it_first_passes_its_strength() {
    let bar = |end: f64, tension: f64, compression: f64| {
        let strength = Some(Strength { tension, compression });
        let material = Material { strength, inelasticity: None, ..steel(|_| {}) };
        thrown_bar_until(end, material, 1e-5).section_forces.remove(0)
    };
    let (end, none) = (2e-3, f64::INFINITY);
    let whole = bar(end, none, none);
    let most = [-whole.stress.min.value, whole.stress.max.value];
    assert!(whole.beyond.is_none() && most.iter().all(|s| *s > 300e6), "{most:?}");
    // A usual yield stress above the largest stress is not exceeded; a smaller one is first exceeded no later than the largest stress is reached.
    assert!(bar(end, 1.001 * most[1], 1.001 * most[0]).beyond.is_none());
    let least = 0.9 * most[1];
    let first = bar(end, least, none).beyond.unwrap();
    assert!(first.value > least && first.time <= whole.stress.max.time, "{first:?}");
    assert!((0.0..=0.4).contains(&first.s), "{first:?}");
    // Up to the previous step it is not exceeded.
    assert!(bar(first.time - 1e-5, least, none).beyond.is_none());
    assert!(bar(first.time, least, none).beyond.is_some());
    assert!(bar(end, none, 300e6).beyond.unwrap().value < -300e6);
}

/// The paper's elastic projectile on its plank as a rectangle, of elements no longer than 50 radii of gyration and of longer ones, with a
/// yield stress that is never reached and without one.
#[test]
fn below_yield_a_beam_that_may_yield_is_the_beam_that_may_not() {
    for (elements, depth) in [(6, 0.1), (6, 0.01), (24, 0.1)] {
        for strain in [StrainMeasure::Green, StrainMeasure::Engineering] {
            let run = |inelasticity| {
                let mut b = ModelBuilder::new();
                let material = Material { strain, ..Material::new("composite", 0.2e10, 3e3) };
                let material = b.material(Material { inelasticity, ..material });
                let section = b.section(Section::rectangle("plank", 1.0, depth));
                let girder =
                    b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], elements, material, section));
                for (name, f) in [("left", 0.0), ("right", 1.0)] {
                    b.support(Support::new(name, at(name, girder, f), SupportKind::Clamp));
                }
                b.projectile(elastic("mass", at("mid", girder, 0.5), [0.0, 20.0]));
                let model = b.build().unwrap();
                let summary = simulate(&model, &Settings::new(0.05, 2e-4), &mut NoRecorder);
                let summary = summary.unwrap();
                assert_balances(&summary, "plank");
                let mid = &summary.points[0];
                (mid.displacement_max[1].value, summary.projectiles[0].velocity_final[1])
            };
            let far = Hardening { from: 0.0, stress: 1.9e9, modulus: 0.0 };
            let yields = steel(|p| p.curve[0] = far).inelasticity;
            let (with, without) = (run(yields), run(None));
            for (a, b) in [(with.0, without.0), (with.1, without.1)] {
                let name = format!("{elements} elements, {depth} m, {strain:?}");
                assert!((a / b - 1.0).abs() < 1e-9, "{name}: {a} {b}");
            }
        }
    }
}
