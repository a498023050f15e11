//! Friction of a disc that slides on rigid ground.

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::run;

const WEIGHT: f64 = 9.81;
const SPEED: f64 = 2.0;
const MASS: f64 = 1.5;
const RADIUS: f64 = 0.1;

/// A disc that slides along the ground, initially without spin.
fn sliding(friction: f64, inertia: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("far", 1e9, 1e3));
    let section = b.section(Section::new("far", 1e-2, 1e-5));
    let far = b.beam(Beam::new("far", &[[0.0, 9.0], [1.0, 9.0]], 1, material, section));
    for (name, at) in [("left", Along::Fraction(0.0)), ("right", Along::Fraction(1.0))] {
        let at = PointRef { label: name.into(), beam: far, along: at };
        b.support(Support::new(name, at, SupportKind::Clamp));
    }
    let shape = ObstacleShape::HalfPlane { point: [0.0; 2], normal: [0.0, 1.0] };
    let ground = b.obstacle(Obstacle { name: "ground".into(), shape, motion: None });
    let disc = b.disc(Disc {
        name: "disc".into(),
        mass: MASS,
        inertia: Some(inertia),
        radius: RADIUS,
        position: [0.0, RADIUS],
        velocity: [SPEED, 0.0],
        spin: 0.0,
    });
    let law = RigidLaw { friction, ..RigidLaw::frictionless(0.0) };
    let between = [ContactPartner::Disc(disc), ContactPartner::Obstacle(ground)];
    b.contact(Contact::new("slide", between, TouchLaw::Rigid(law)));
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -WEIGHT] }));
    b.build().expect("a valid model")
}

/// Impulse of friction and the last position of the disc in contact.
fn contact(summary: &RunSummary) -> (f64, f64) {
    match &summary.contacts[0].record {
        ContactRecord::Nonsmooth { intervals, .. } if intervals.len() == 1 => {
            (intervals[0].tangential_impulse, intervals[0].place_end.position[0])
        }
        _ => (f64::NAN, f64::NAN),
    }
}

/// A sliding disc decelerates by mu g with the angular acceleration `mu m g r / I`; a solid disc rolls after `v / (3 mu g)` with two thirds of its
/// speed and a third of its energy dissipated; a disc without rotation stops after `v^2 / (2 mu g)`.
pub fn sliding_disc() -> Report {
    let mut c = Checks::new();
    for friction in [0.15, 0.4] {
        let solid = 0.5 * MASS * RADIUS * RADIUS;
        let rolls = SPEED / (3.0 * friction * WEIGHT);
        let model = sliding(friction, solid);
        let settings = |end: f64| Settings::new(end, rolls / 400.0);
        let at = |what: &str| format!("mu = {friction}: {what}");
        let half = run(&model, &settings(0.5 * rolls));
        let [disc, ..] = half.projectiles.as_slice() else { unreachable!() };
        let (v, spin) = (disc.velocity_final[0], disc.spin_final);
        c.relative(at("speed halfway to rolling [m/s]"), v, SPEED * 5.0 / 6.0, 1e-9);
        c.relative(at("its spin [rad/s]"), spin, -SPEED / (3.0 * RADIUS), 1e-9);
        let whole = run(&model, &settings(2.0 * rolls));
        let [disc, ..] = whole.projectiles.as_slice() else { unreachable!() };
        let (v, spin) = (disc.velocity_final[0], disc.spin_final);
        c.relative(at("speed of rolling [m/s]"), v, SPEED * 2.0 / 3.0, 1e-9);
        c.relative(at("its spin [rad/s]"), spin * RADIUS, -SPEED * 2.0 / 3.0, 1e-9);
        let (energy, lost) = (0.5 * MASS * SPEED * SPEED, whole.energy.loss_impacts);
        c.relative(at("energy lost [J]"), lost, energy / 3.0, 1e-9);
        let (friction_impulse, _) = contact(&whole);
        let expected = MASS * SPEED / 3.0;
        c.relative(at("impulse of friction [N s]"), friction_impulse.abs(), expected, 1e-9);
        c.at_most(at("energy residual"), whole.energy.residual_max, 1e-12);

        let stops = SPEED / (friction * WEIGHT);
        let found = run(&sliding(friction, 1e9), &Settings::new(1.2 * stops, stops / 400.5));
        let (_, place) = contact(&found);
        let expected = SPEED * SPEED / (2.0 * friction * WEIGHT);
        // The disc stops within a step: the error is at most half of mu g h^2, compared with mu g (400 h)^2 / 2.
        c.relative(at("way until a block stops [m]"), place, expected, 1.0 / 400.0_f64.powi(2));
        c.absolute(at("its speed [m/s]"), found.projectiles[0].velocity_final[0], 0.0, 1e-9);
        c.relative(at("its energy lost [J]"), found.energy.loss_impacts, energy, 1e-9);
    }
    c.into_report()
}
