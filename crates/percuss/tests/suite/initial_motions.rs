//! Motions at the start that parts have of their own.

use crate::common;

use common::{at, beam, plank};
use percuss::*;

fn started(b: &ModelBuilder) -> (f64, [f64; 2]) {
    let model = b.build().unwrap();
    let simulation = Simulation::new(&model, &Settings::new(1e-3, 1e-4)).unwrap();
    let measures = simulation.measures();
    (measures.total(), measures.linear)
}

/// Two free planks of 300 kg/m, one in translation, one turning about its middle: each has the energy of its own motion.
#[test]
fn beams_start_each_in_a_motion_of_its_own() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    b.beam(beam("first", [0.0, 0.0], [2.0, 0.0], 4, material, section));
    b.beam(beam("second", [0.0, 1.0], [1.0, 1.0], 3, material, section));
    b.initial_motion(InitialMotion { velocity: [0.0, -3.0], ..InitialMotion::default() });
    let turns = InitialMotion { velocity: [0.0, 0.0], spin: 4.0, about: [0.5, 1.0] };
    b.initial_motion_of("second", turns);
    let (energy, momentum) = started(&b);
    let rotary = 3e3 * 8.33e-5;
    let exact = 0.5 * 600.0 * 9.0 + 0.5 * (300.0 / 12.0 + rotary) * 16.0;
    assert!((energy - exact).abs() < 1e-9 * exact, "{energy} instead of {exact}");
    assert!((momentum[1] + 1800.0).abs() < 1e-9 && momentum[0].abs() < 1e-9);
}

/// A mass at the tip of a beam at rest: its energy, and that of the element it drags along.
#[test]
fn a_point_mass_starts_by_itself() {
    let scene = |elements: usize| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let g = b.beam(beam("g", [0.0, 0.0], [1.0, 0.0], elements, material, section));
        b.support(Support::new("left", at("left", g, 0.0), SupportKind::Clamp));
        let mass = PointMass {
            name: "bob".into(),
            at: at("tip", g, 1.0),
            mass: 50.0,
            rotary_inertia: 0.0,
        };
        b.point_mass(mass);
        b.initial_motion_of(
            "bob",
            InitialMotion { velocity: [0.0, 2.0], ..InitialMotion::default() },
        );
        started(&b).0
    };
    let own = 0.5 * 50.0 * 4.0;
    let drags = [scene(4) - own, scene(8) - own];
    // The additional mass is a share of one element (13/35 of its mass), and its rotation, which does not decrease with it.
    let share = [13.0 / 35.0 * 150.0, 13.0 / 35.0 * 75.0];
    assert!(drags[1] > 0.0 && drags[0] > drags[1], "{drags:?}");
    assert!((0..2).all(|k| (1.0..1.2).contains(&(drags[k] / share[k]))), "{drags:?}");
}

/// A moving plank, hinged to one at rest: the lost energy is the dissipation of the impulse in the hinge, never more than the initial energy, and
/// both have the same velocity at the hinge.
#[test]
fn joined_beams_take_the_nearest_motions_that_their_joint_allows() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let first = b.beam(beam("first", [0.0, 0.0], [1.0, 0.0], 4, material, section));
    let second = b.beam(beam("second", [1.0, 0.0], [2.0, 0.0], 4, material, section));
    let between = [at("first.end", first, 1.0), at("second.start", second, 0.0)];
    b.joint(Joint::new("hinge", JointKind::Hinge, between));
    b.initial_motion_of(
        "first",
        InitialMotion { velocity: [0.0, 1.0], ..InitialMotion::default() },
    );
    let (energy, momentum) = started(&b);
    assert!(energy < 150.0 && energy > 100.0, "{energy}");
    assert!((momentum[1] - 300.0).abs() < 1e-9, "{momentum:?}");
}

/// The velocity of a place is unique: contradicting motions of a mass and its beam, or of two masses at one place, are rejected.
#[test]
fn motions_that_contradict_each_other_at_a_mass_are_refused() {
    let built = |of_mass: InitialMotion, beam_too: bool, masses: usize| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let g = b.beam(beam("g", [0.0, 0.0], [1.0, 0.0], 4, material, section));
        for name in ["bob", "bib"].into_iter().take(masses) {
            let at = at("tip", g, 1.0);
            b.point_mass(PointMass { name: name.into(), at, mass: 50.0, rotary_inertia: 0.0 });
        }
        let turns = InitialMotion { spin: 2.0, ..InitialMotion::default() };
        if beam_too {
            b.initial_motion_of("g", turns);
        }
        b.initial_motion_of("bob", of_mass);
        if masses > 1 {
            b.initial_motion_of("bib", turns);
        }
        b.build()
            .map(|_| ())
            .map_err(|faults| faults.iter().map(ToString::to_string).collect::<Vec<_>>())
    };
    let along = |velocity, spin| InitialMotion { velocity, spin, about: [1.0, 0.0] };
    // The tip of the turning beam moves at 2 m/s: the same motion about another centre is no contradiction, and one alone is none.
    assert_eq!(built(along([0.0, 2.0], 2.0), true, 1), Ok(()));
    assert_eq!(built(along([0.0, 1.0], 0.0), false, 1), Ok(()));
    for other in [along([0.0, 1.0], 2.0), along([0.0, 2.0], 0.0)] {
        let faults = built(other, true, 1).unwrap_err();
        assert_eq!(faults.len(), 1, "{faults:?}");
        let parts = [
            "initial.bob",
            "but (0, 2) m/s at 2 rad/s by [initial.g]",
            "one velocity at this location",
        ];
        assert!(parts.iter().all(|part| faults[0].contains(part)), "{faults:?}");
    }
    let faults = built(along([0.0, 1.0], 2.0), false, 2).unwrap_err();
    assert!(faults.len() == 1 && faults[0].contains("[initial.bob]"), "{faults:?}");
}

#[test]
fn names_of_nothing_and_masses_between_nodes_are_refused() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    b.beam(beam("g", [0.0, 0.0], [1.0, 0.0], 4, material, section));
    b.initial_motion_of("nobody", InitialMotion::default());
    let faults = b.build().unwrap_err();
    assert_eq!(faults[0].path, "initial.nobody");
}
