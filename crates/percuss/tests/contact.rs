//! Discs, obstacles and beams that touch: books that close while contact slides, opens and closes; nothing passes through.

mod common;

use common::{beam, plank};
use percuss::*;

/// A free beam of 3 m, soft, along e1, and a disc above it.
fn thrown(radius: f64, velocity: [f64; 2], law: TouchLaw) -> ModelBuilder {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("soft", 2e8, 1e3));
    let section = b.section(Section { depth: Some(0.1), ..Section::new("bar", 0.01, 8.33e-6) });
    let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 12, material, section));
    let disc = b.disc(Disc {
        name: "ball".into(),
        mass: 5.0,
        inertia: None,
        radius,
        position: [0.6, radius + 0.08],
        velocity,
        spin: 0.0,
    });
    b.contact(Contact::new("throw", [Party::Disc(disc), Party::Beam(girder)], law));
    b
}

fn linear(stiffness: f64) -> Potential {
    Potential::Linear { stiffness }
}

fn run(b: &ModelBuilder, end: f64, step: f64) -> RunSummary {
    let model = b.build().unwrap();
    let summary = simulate(&model, &Settings::new(end, step), &mut NoRecorder).unwrap();
    assert!(matches!(summary.termination, Termination::Completed), "{:?}", summary.termination);
    summary
}

fn books_close(summary: &RunSummary, tolerance: f64) {
    let residuals = [
        summary.energy.residual_max,
        summary.momentum.linear_residual_max,
        summary.momentum.angular_residual_max,
    ];
    assert!(residuals.iter().all(|r| *r < tolerance), "{residuals:?}");
}

fn intervals(summary: &RunSummary, i: usize) -> &[ContactInterval] {
    match &summary.contacts[i].record {
        ContactRecord::Smooth { intervals, .. } | ContactRecord::Nonsmooth { intervals, .. } => {
            intervals
        }
    }
}

#[test]
fn a_disc_that_slides_over_element_borders_keeps_energy_and_momenta() {
    for potential in [
        linear(2e4),
        Potential::Hertz { stiffness: 1e5 },
        Potential::Table { penetration: vec![0.0, 0.02, 0.1], force: vec![0.0, 200.0, 3000.0] },
    ] {
        let law = TouchLaw::Smooth(SmoothLaw::elastic(potential));
        let summary = run(&thrown(0.05, [8.0, -4.0], law), 0.3, 1e-3);
        books_close(&summary, 1e-11);
        let first = intervals(&summary, 0)[0];
        let slid = (first.place_end.s - first.place.s).abs();
        assert!(slid > 0.3, "slid by {slid} m only, from {}", first.place.s);
        let v = summary.projectiles[0].velocity_final;
        assert!(v[1] > -3.0, "was not thrown back: {v:?}");
    }
}

#[test]
fn the_plain_midpoint_gradient_shows_its_error() {
    let law = |force| TouchLaw::Smooth(SmoothLaw { force, ..SmoothLaw::elastic(linear(2e4)) });
    let residual =
        |force| run(&thrown(0.05, [8.0, -4.0], law(force)), 0.3, 1e-3).energy.residual_max;
    let (exact, plain) =
        (residual(ContactForce::Conserving), residual(ContactForce::PlainGradient));
    println!("{exact:e} {plain:e}");
    assert!(plain > 1e-6 && exact < 1e-12, "{exact:e} {plain:e}");
}

#[test]
fn dissipation_takes_what_the_books_say() {
    let law =
        SmoothLaw { dissipation: 0.1, ..SmoothLaw::elastic(Potential::Hertz { stiffness: 1e6 }) };
    let summary = run(&thrown(0.05, [3.0, -4.0], TouchLaw::Smooth(law)), 0.2, 2e-4);
    books_close(&summary, 1e-11);
    assert!(summary.energy.loss_damping > 0.5);
    let lost: f64 = intervals(&summary, 0).iter().map(|i| i.energy.lost).sum();
    assert!((lost - summary.energy.loss_damping).abs() < 1e-9 * lost);
}

#[test]
fn rigid_discs_bounce_slide_and_rub_with_closed_books() {
    for (restitution, friction, tangential) in
        [(1.0, 0.0, 0.0), (0.5, 0.0, 0.0), (0.0, 0.0, 0.0), (0.6, 0.3, 0.0), (0.9, 0.8, 0.5)]
    {
        let law = RigidLaw {
            friction,
            tangential_restitution: tangential,
            ..RigidLaw::frictionless(restitution)
        };
        let summary = run(&thrown(0.05, [5.0, -4.0], TouchLaw::Rigid(law)), 0.2, 1e-4);
        books_close(&summary, 1e-11);
        assert!(summary.energy.loss_impacts >= -1e-12 * summary.energy.scale);
        if restitution == 1.0 {
            assert!(summary.energy.loss_impacts.abs() < 1e-12 * summary.energy.scale);
        }
        let spin = summary.projectiles[0].spin_final;
        assert!(if friction > 0.0 { spin.abs() > 1.0 } else { spin.abs() < 1e-9 }, "{spin}");
        assert!(summary.contact_residual_max < 1e-10);
    }
}

#[test]
fn two_beams_that_collide_freely_keep_energy_and_momenta() {
    for law in [
        TouchLaw::Smooth(SmoothLaw::elastic(linear(1e6))),
        TouchLaw::Rigid(RigidLaw::frictionless(1.0)),
    ] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("soft", 2e9, 1e3));
        let section = b.section(Section { depth: Some(0.1), ..Section::new("bar", 0.01, 8.33e-6) });
        let a = b.beam(beam("lower", [0.0, 0.0], [3.0, 0.0], 10, material, section));
        let c = b.beam(beam("upper", [1.0, 0.15], [2.5, 1.6], 10, material, section));
        b.contact(Contact::new("blow", [Party::Beam(a), Party::Beam(c)], law));
        let model = b.build().unwrap();
        let mut simulation = Simulation::new(&model, &Settings::new(0.1, 1e-4)).unwrap();
        simulation.set_velocities(|name, _| if name == "upper" { [1.0, -5.0] } else { [0.0; 2] });
        let summary = simulation.run(&mut NoRecorder);
        assert!(matches!(summary.termination, Termination::Completed), "{:?}", summary.termination);
        books_close(&summary, 1e-11);
        let touched = match &summary.contacts[0].record {
            ContactRecord::Smooth { intervals, .. } => !intervals.is_empty(),
            ContactRecord::Nonsmooth { impact_count, .. } => *impact_count > 0,
        };
        assert!(touched);
    }
}

#[test]
fn a_disc_rolls_down_an_incline_without_slipping() {
    // Pure rolling of a solid disc: two thirds of the acceleration of sliding.
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    b.beam(beam("aside", [50.0, 50.0], [53.0, 50.0], 1, material, section));
    let slope = 0.3_f64;
    let normal = [slope.sin(), slope.cos()];
    let floor = b.obstacle(Obstacle {
        name: "incline".into(),
        shape: ObstacleShape::HalfPlane { point: [0.0, 0.0], normal },
        motion: None,
    });
    let radius = 0.1;
    let disc = b.disc(Disc {
        name: "wheel".into(),
        mass: 2.0,
        inertia: None,
        radius,
        position: [radius * normal[0], radius * normal[1]],
        velocity: [0.0; 2],
        spin: 0.0,
    });
    let law = RigidLaw { friction: 0.5, ..RigidLaw::frictionless(0.0) };
    let between = [Party::Disc(disc), Party::Obstacle(floor)];
    b.contact(Contact::new("roll", between, TouchLaw::Rigid(law)));
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let summary = run(&b, 1.0, 1e-3);
    books_close(&summary, 1e-10);
    let v = summary.projectiles[0].velocity_final;
    let expected = 2.0 / 3.0 * 9.81 * slope.sin();
    assert!((v[0].hypot(v[1]) - expected).abs() < 1e-3 * expected, "{v:?} {expected}");
    assert!(
        (summary.projectiles[0].spin_final + expected / radius).abs() < 1e-2 * expected / radius
    );
}
