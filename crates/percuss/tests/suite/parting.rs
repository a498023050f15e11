//! Fracture of beams: released energy, subsequent motion, remaining contact.

use crate::common;

use common::{at, beam, disc};
use percuss::*;

/// A metal that yields at 300 MPa, perfectly plastic, and fails at a strain.
fn metal(failure_strain: f64) -> Material {
    let plasticity = Plasticity {
        curve: vec![Hardening { from: 0.0, stress: 300e6, modulus: 0.0 }],
        kinematic: 0.0,
        overstress: None,
        failure_strain: Some(failure_strain),
    };
    Material {
        strain: StrainMeasure::Engineering,
        inelasticity: Some(Inelasticity::Plastic(plasticity)),
        ..Material::new("metal", 200e9, 7800.0)
    }
}

fn assert_balances(summary: &RunSummary) {
    assert!(matches!(summary.termination, Termination::Completed), "{:?}", summary.termination);
    assert!(summary.energy.residual_max < 1e-10, "{:e}", summary.energy.residual_max);
    let m = &summary.momentum;
    let worst = m.linear_residual_max.max(m.angular_residual_max);
    assert!(worst < 1e-10, "{m:?}");
}

/// A strip of 10 mm clamped at both ends, struck eccentrically by a disc that moves on.
fn struck(speed: f64, law: TouchLaw) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(metal(0.08));
    let section = b.section(Section { fibres: 6, ..Section::rectangle("strip", 0.03, 0.01) });
    let strip = b.beam(beam("strip", [0.0, 0.0], [0.4, 0.0], 20, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, strip, f), SupportKind::Clamp));
    }
    let ball = b.disc(disc("ball", 2.0, 0.02, [0.17, 0.026], [0.0, -speed]));
    let between = [ContactPartner::Disc(ball), ContactPartner::Beam(strip)];
    b.contact(Contact::new("blow", between, law));
    b.build().unwrap()
}

fn spring() -> TouchLaw {
    TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 3e7 }))
}

fn run(model: &Model, settings: &Settings) -> (RunSummary, MemoryRecorder) {
    let mut rows = MemoryRecorder::default();
    let summary = Simulation::new(model, settings).unwrap().run(&mut rows);
    (summary, rows)
}

/// The strip fractures below the disc, for any contact law: the disc passes through the gap, and no force pulls it back.
#[test]
fn a_disc_flies_through_the_strip_that_it_has_broken() {
    for law in [spring(), TouchLaw::Rigid(RigidLaw::frictionless(0.3))] {
        let model = struck(80.0, law);
        let (summary, rows) = run(&model, &Settings::new(4e-3, 2e-6));
        assert_balances(&summary);
        let strip = &summary.plastic[0];
        assert!(!strip.parted.is_empty(), "{strip:?}");
        // Stubs are clamped and recover separately; a piece between two fractures has no place.
        match strip.permanent_set {
            Ok(set) => assert!(set.displacement[1] < 0.0 && strip.parted.len() == 1, "{strip:?}"),
            Err(reason) => {
                assert_eq!(reason, NoPermanentSet::Parted);
                assert!(strip.parted.len() > 1, "{strip:?}");
            }
        }
        let heights = rows.column("projectile.ball.position_2").unwrap();
        assert!(*heights.last().unwrap() < -0.1, "{:?}", heights.last());
        // Long after its passage it moves uniformly.
        let speeds = rows.column("projectile.ball.velocity_2").unwrap();
        let late = &speeds[3 * speeds.len() / 4..];
        assert!(late.iter().all(|v| (v - late[0]).abs() < 1e-9 * late[0].abs()), "{late:?}");
        let failure = rows.column("energy.failure").unwrap();
        assert!(failure.windows(2).all(|w| w[1] >= w[0] - 1e-12), "nothing is given back");
    }
}

/// The bar below a disc fractures while they touch: the contact ends there, within the run and without a velocity of separation, and what its
/// spring had stored is lost, so that nothing is left to the scheme.
#[test]
fn a_contact_ends_with_the_fracture_below_it() {
    let mut b = ModelBuilder::new();
    let curve = vec![Hardening { from: 0.0, stress: 250e6, modulus: 0.0 }];
    let failure_strain = Some(0.01);
    let law = Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain };
    let material = b.material(Material {
        strain: StrainMeasure::Engineering,
        inelasticity: Some(Inelasticity::Plastic(law)),
        ..Material::new("metal", 200e9, 7850.0)
    });
    let section = b.section(Section::rectangle("bar", 0.02, 0.02));
    let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 7, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, bar, f), SupportKind::Clamp));
    }
    let ball = b.disc(disc("ball", 20.0, 0.2, [0.5, 0.215], [0.0, -100.0]));
    let between = [ContactPartner::Disc(ball), ContactPartner::Beam(bar)];
    let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e7 }));
    b.contact(Contact::new("blow", between, law));
    let (end, step) = (1e-2, 1e-5);
    let (summary, rows) = run(&b.build().unwrap(), &Settings::new(end, step));
    assert_balances(&summary);
    let ContactRecord::Smooth { intervals, .. } = &summary.contacts[0].record else {
        unreachable!()
    };
    let torn: Vec<_> = intervals.iter().filter(|interval| interval.torn).collect();
    assert!(!torn.is_empty(), "{intervals:?}");
    for interval in intervals {
        assert!(interval.end <= end && interval.start < interval.end, "{interval:?}");
        let all = summary.energy.scale;
        assert!(interval.energy.scheme.abs() < 1e-12 * all, "{:?}", interval.energy);
        assert!(interval.energy.stored.abs() < 1e-12 * all, "{:?}", interval.energy);
    }
    for interval in torn {
        assert!(interval.separation_velocity.is_nan(), "{interval:?}");
        assert_eq!(interval.restitution(), Err(NoRestitution::Torn));
        assert!(interval.energy.failure > 0.0, "{:?}", interval.energy);
        // The force of the rows is there before that instant, and not at it.
        let [time, force] = ["time", "contact.blow.force"].map(|c| rows.column(c).unwrap());
        let at = time.iter().position(|t| *t > interval.end - 0.5 * step).unwrap();
        assert!(force[at - 1] > 0.0 && force[at] == 0.0, "{} {}", force[at - 1], force[at]);
    }
    assert!(summary.loss_contacts().abs() < 1e-9 * summary.energy.scale);
}

/// The energy released at a place does not exceed that of all failures, and each is reported once, in the order of time.
#[test]
fn each_place_is_reported_once() {
    let model = struck(80.0, spring());
    let (summary, _) = run(&model, &Settings::new(4e-3, 2e-6));
    let parted = &summary.plastic[0].parted;
    let mut stretches: Vec<[u64; 2]> =
        parted.iter().map(|one| one.stretch.map(|s| (1e6 * s).round() as u64)).collect();
    stretches.sort_unstable();
    stretches.dedup();
    assert_eq!(stretches.len(), parted.len());
    assert!(parted.windows(2).all(|w| w[0].time <= w[1].time));
    assert!(parted.iter().all(|one| one.stretch[0] < one.s && one.s < one.stretch[1]));
    let released: f64 = parted.iter().map(|one| one.energy).sum();
    assert!(released > 0.0 && released <= summary.energy.failure * (1.0 + 1e-12));
}

/// A gap is not a strain of the material: strains end where fibres fail, however far the halves move apart, and stresses are those of whole fibres.
#[test]
fn strains_are_those_of_fibres_that_have_not_failed() {
    let failure_strain = 0.08;
    let model = struck(80.0, spring());
    let (summary, _) = run(&model, &Settings::new(4e-3, 2e-6));
    assert!(!summary.plastic[0].parted.is_empty());
    let strain = summary.section_forces[0].strain.largest().value;
    assert!(strain.is_finite() && strain.abs() <= failure_strain * (1.0 + 1e-9), "{strain}");
}

/// A free bar whose halves separate: it fractures, and both momenta and the kinetic energy do not change.
#[test]
fn a_free_bar_keeps_its_momenta_as_it_parts() {
    let mut b = ModelBuilder::new();
    let material = b.material(metal(0.02));
    let section = b.section(Section::rectangle("bar", 0.02, 0.02));
    b.beam(beam("bar", [0.0, 0.0], [0.3, 0.0], 9, material, section));
    let model = b.build().unwrap();
    let mut run = Simulation::new(&model, &Settings::new(1e-3, 1e-6)).unwrap();
    run.set_velocities(|_, x| [400.0 * (x[0] - 0.1), 30.0 * x[0]]);
    let mut rows = MemoryRecorder::default();
    let summary = run.run(&mut rows);
    assert_balances(&summary);
    assert!(!summary.plastic[0].parted.is_empty(), "{:?}", summary.plastic);
    let column = |name: &str| rows.column(name).unwrap();
    for name in ["momentum.linear_1", "momentum.linear_2", "momentum.angular"] {
        let values = column(name);
        let drift = values.iter().map(|v| (v - values[0]).abs()).fold(0.0, f64::max);
        assert!(drift < 1e-9 * summary.momentum.linear_scale, "{name}: {drift:e}");
    }
    assert!(*column("energy.failure").last().unwrap() > 0.0);
}

/// Stopped between two steps and resumed, before and after a fracture: the same to the last bit.
#[test]
fn a_run_that_goes_on_from_a_checkpoint_remembers_its_gaps() {
    let model = struck(80.0, spring());
    let settings = Settings::new(1.5e-3, 2e-6);
    let (whole, rows) = run(&model, &settings);
    let first = whole.plastic[0].parted[0].time;
    for share in [0.5, 1.5] {
        let mut part = Simulation::new(&model, &settings).unwrap();
        let mut before = MemoryRecorder::default();
        for _ in 0..(share * first / settings.step) as usize {
            part.advance(&mut before).unwrap();
        }
        let resumed = Simulation::resume(&model, &settings, part.checkpoint());
        let mut after = MemoryRecorder::default();
        let end = resumed.unwrap().run(&mut after);
        assert_eq!(end.energy, whole.energy);
        assert_eq!(end.plastic, whole.plastic);
        let name = "projectile.ball.velocity_2";
        let (rows, after) = (rows.column(name).unwrap(), after.column(name).unwrap());
        assert_eq!(rows[rows.len() - after.len()..], after[..]);
    }
}

/// A bar of one element between two separating masses: dissipation, released energy and remaining energy of the masses. Hardening keeps its strain
/// uniform.
#[test]
fn a_bar_between_two_masses_releases_what_it_stored() {
    let (area, length, mass, speed, limit) = (4e-4, 0.5, 20.0, 6.0, 0.01);
    let (stress, young, modulus) = (300e6_f64, 200e9, 2e9);
    let mut b = ModelBuilder::new();
    let mut metal = Material { density: 1.0, ..metal(limit) };
    if let Some(Inelasticity::Plastic(law)) = &mut metal.inelasticity {
        law.curve[0].modulus = modulus;
    }
    let material = b.material(metal);
    let section = b.section(Section::rectangle("bar", 0.02, 0.02));
    let bar = b.beam(beam("bar", [0.0, 0.0], [length, 0.0], 1, material, section));
    for f in [0.0, 1.0] {
        let (name, rotary_inertia) = (format!("m{f}"), 1.0);
        b.point_mass(PointMass { name, at: at("m", bar, f), mass, rotary_inertia });
    }
    let model = b.build().unwrap();
    let step = 5e-7;
    let mut run = Simulation::new(&model, &Settings::new(2e-3, step)).unwrap();
    run.set_velocities(|_, x| [speed * (4.0 * x[0] - 1.0), 0.0]);
    let summary = run.run(&mut NoRecorder);
    assert_balances(&summary);
    let parted = &summary.plastic[0].parted;
    assert_eq!(parted.len(), 1, "{parted:?}");
    let volume = area * length;
    let plastic = (young * limit - stress) / (young + modulus);
    let last = stress + modulus * plastic;
    let stored = volume * (0.5 * last * last / young + 0.5 * modulus * plastic * plastic);
    let flowed = volume * stress * plastic;
    // It fails at the end of the step in which it passes its limit: the strain exceeds it by at most the increment of a step.
    let within = 2.0 * speed * step / length / limit;
    for (found, expected) in [
        (parted[0].energy, stored),
        (summary.energy.failure, stored),
        (summary.energy.plastic, flowed),
    ] {
        let off = found / expected - 1.0;
        assert!((-1e-6..2.0 * within).contains(&off), "{found} {expected} {off:e} {within:e}");
    }
}
