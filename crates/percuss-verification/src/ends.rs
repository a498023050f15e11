//! Ends of beams in impact and under a rolling disc: rigid bodies in closed form.

use std::f64::consts::PI;

use percuss::*;

use crate::check::{Checks, Report};
use crate::structure::at;

fn run(b: &ModelBuilder, end: f64, step: f64) -> RunSummary {
    let model = b.build().expect("a verification case builds");
    simulate(&model, &Settings::new(end, step), &mut NoRecorder).expect("valid settings")
}

/// A stiff bar that falls on its corner, and a disc that slides over the end of another bar.
///
/// A rigid body that meets a smooth floor elastically receives the impulse 2 v / (1/m + x^2/J), where x is the horizontal distance of the corner
/// from its middle. A disc of radius R that slides off a corner at v rotates about it like a point on a circle: it separates where the cosine of
/// the angle is c = (2 + v^2/(g R))/3, with the horizontal velocity sqrt(g R) c^1.5.
pub fn beam_ends() -> Report {
    let mut c = Checks::new();
    let (depth, speed) = (0.1, 0.05);
    let spring = |stiffness| TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness }));
    for degrees in [30.0, 60.0, 80.0] {
        let angle: f64 = degrees * PI / 180.0;
        let (sine, cosine) = angle.sin_cos();
        let height = 0.5 * (sine + depth * cosine) + 1e-4;
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("stiff", 5e13, 1e3));
        let section = b.section(Section::rectangle("square", depth, depth));
        let half = [0.5 * cosine, 0.5 * sine];
        let points = [[-half[0], height - half[1]], [half[0], height + half[1]]];
        let bar = b.beam(Beam::new("bar", &points, 4, material, section));
        let shape = ObstacleShape::HalfPlane { point: [0.0; 2], normal: [0.0, 1.0] };
        let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
        let between = [ContactPartner::Beam(bar), ContactPartner::Obstacle(floor)];
        b.contact(Contact::new("fall", between, spring(1e6)));
        let velocity = [0.0, -speed];
        b.initial_motion(InitialMotion { velocity, spin: 0.0, about: [0.0; 2] });
        let summary = run(&b, 0.012, 2e-6);
        let found = match &summary.contacts[0].record {
            ContactRecord::Smooth { intervals, .. } => intervals.first().map(|i| i.impulse),
            ContactRecord::Nonsmooth { .. } => None,
        };
        let mass = 1e3 * depth * depth;
        let inertia = mass * (1.0 + depth * depth) / 12.0;
        let x = 0.5 * (cosine - depth * sine);
        let impulse = 2.0 * speed / (1.0 / mass + x * x / inertia);
        let what = format!("bar under {degrees} degrees: impulse of its corner [N s]");
        // It rotates by some milliradians during contact.
        c.relative(what, found.unwrap_or(f64::NAN), impulse, 3e-3);
        c.at_most("energy residual", summary.energy.residual_max, 1e-10);
    }
    let (radius, gravity) = (0.1, 9.81);
    for (name, law) in
        [("rigid", TouchLaw::Rigid(RigidLaw::frictionless(0.0))), ("stiff potential", spring(1e7))]
    {
        let speed = 0.2;
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("stiff", 2e11, 1e3));
        let section = b.section(Section::rectangle("square", depth, depth));
        let points = [[-1.0, -0.5 * depth], [0.0, -0.5 * depth]];
        let bar = b.beam(Beam::new("bar", &points, 4, material, section));
        for (name, end) in [("left", 0.0), ("right", 1.0)] {
            b.support(Support::new(name, at(name, bar, end), SupportKind::Clamp));
        }
        let ball = b.disc(Disc {
            name: "ball".into(),
            mass: 1.0,
            inertia: None,
            radius,
            position: [-0.002, radius],
            velocity: [speed, 0.0],
            spin: 0.0,
        });
        b.contact(Contact::new(
            "slide",
            [ContactPartner::Disc(ball), ContactPartner::Beam(bar)],
            law,
        ));
        let weight = LoadKind::Gravity { acceleration: [0.0, -gravity] };
        b.load(Load::new("weight", weight));
        let summary = run(&b, 0.4, 1e-4);
        let cosine = (2.0 + speed * speed / (gravity * radius)) / 3.0;
        let expected = (gravity * radius).sqrt() * cosine.powf(1.5);
        let found = summary.projectiles[0].velocity_final[0];
        c.relative(
            format!("{name}: disc off the end, level velocity [m/s]"),
            found,
            expected,
            2e-3,
        );
        c.at_most(format!("{name}: energy residual"), summary.energy.residual_max, 1e-10);
    }
    c.into_report()
}
