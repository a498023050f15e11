//! Sliding distance and friction work of contacts, what wear goes by.

use crate::common;

use common::rows::Rows;
use common::*;
use percuss::*;

const WEIGHT: f64 = 9.81;
const SPEED: f64 = 2.0;
const MASS: f64 = 1.5;
const RADIUS: f64 = 0.1;

/// A disc that slides along the ground without spin at first; a beam far away that nothing touches.
fn on_the_ground(friction: f64, inertia: f64) -> Model {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    b.beam(beam("aside", [50.0, 50.0], [53.0, 50.0], 1, material, section));
    let shape = ObstacleShape::HalfPlane { point: [0.0; 2], normal: [0.0, 1.0] };
    let ground = b.obstacle(Obstacle { name: "ground".into(), shape, motion: None });
    let disc =
        Disc { inertia: Some(inertia), ..disc("disc", MASS, RADIUS, [0.0, RADIUS], [SPEED, 0.0]) };
    let disc = b.disc(disc);
    let law = RigidLaw { friction, ..RigidLaw::frictionless(0.0) };
    let between = [ContactPartner::Disc(disc), ContactPartner::Obstacle(ground)];
    b.contact(Contact::new("slide", between, TouchLaw::Rigid(law)));
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -WEIGHT] }));
    b.build().unwrap()
}

fn slid(model: &Model, end: f64, step: f64) -> (Sliding, RunSummary) {
    let (_, run) = Rows::of(model, &Settings::new(end, step));
    (run.contacts[0].sliding.expect("a contact with friction"), run)
}

#[test]
fn a_block_slides_to_rest_over_its_stopping_distance_and_loses_its_energy_to_friction() {
    for friction in [0.15, 0.4] {
        // One that cannot be spun up is a block. In the step in which it stops it rests in part: mu g h^2 / 2 at most.
        let stops = SPEED / (friction * WEIGHT);
        let (found, run) = slid(&on_the_ground(friction, 1e9), 1.2 * stops, stops / 400.5);
        let distance = SPEED * SPEED / (2.0 * friction * WEIGHT);
        let energy = 0.5 * MASS * SPEED * SPEED;
        assert!((found.distance / distance - 1.0).abs() < 400.0_f64.powi(-2), "{found:?}");
        assert!((found.work / energy - 1.0).abs() < 1e-9, "{found:?} {energy}");
        assert!((found.work - run.energy.loss_impacts).abs() < 1e-9 * energy);
    }
}

#[test]
fn a_disc_slides_until_it_rolls_and_no_farther() {
    // The surfaces meet at v at first, which falls by 3 mu g: v^2 / (6 mu g) in all, and m v^2 / 6 are lost.
    let (friction, solid) = (0.4, 0.5 * MASS * RADIUS * RADIUS);
    let rolls = SPEED / (3.0 * friction * WEIGHT);
    for end in [rolls, 2.0 * rolls] {
        let (found, _) = slid(&on_the_ground(friction, solid), end, rolls / 400.0);
        let distance = SPEED * SPEED / (6.0 * friction * WEIGHT);
        let energy = MASS * SPEED * SPEED / 6.0;
        assert!((found.distance / distance - 1.0).abs() < 1e-5, "{found:?} {distance}");
        assert!((found.work / energy - 1.0).abs() < 1e-5, "{found:?} {energy}");
    }
}

#[test]
fn contacts_without_friction_have_no_sliding() {
    let model = on_the_ground(0.0, 1e-2);
    let (_, run) = Rows::of(&model, &Settings::new(0.1, 1e-3));
    assert_eq!(run.contacts[0].sliding, None);
}
