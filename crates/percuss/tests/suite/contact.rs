//! Contact of discs, obstacles and beams: energy and momentum balances for sliding, opening and closing contacts, and no passing through.

use crate::common;

use common::{beam, disc, plank};
use percuss::*;

/// A free beam of 3 m, soft, along e1.
fn soft_bar(b: &mut ModelBuilder) -> BeamId {
    let material = b.material(Material::new("soft", 2e8, 1e3));
    let section = b.section(Section { depth: Some(0.1), ..Section::new("bar", 0.01, 8.33e-6) });
    b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 12, material, section))
}

/// The beam and a disc above it.
fn thrown(radius: f64, velocity: [f64; 2], law: TouchLaw) -> ModelBuilder {
    let mut b = ModelBuilder::new();
    let girder = soft_bar(&mut b);
    let disc = b.disc(disc("ball", 5.0, radius, [0.6, radius + 0.08], velocity));
    b.contact(Contact::new(
        "throw",
        [ContactPartner::Disc(disc), ContactPartner::Beam(girder)],
        law,
    ));
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

fn balances_close(summary: &RunSummary, tolerance: f64) {
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
        Potential::function(|p| 2e5 * p.powi(3), |p| 6e5 * p * p),
    ] {
        let law = TouchLaw::Smooth(SmoothLaw::elastic(potential));
        let summary = run(&thrown(0.05, [8.0, -4.0], law), 0.3, 1e-3);
        balances_close(&summary, 1e-11);
        let first = intervals(&summary, 0)[0];
        let slid = (first.place_end.s - first.place.s).abs();
        assert!(slid > 0.3, "slid by {slid} m only, from {}", first.place.s);
        let v = summary.projectiles[0].velocity_final;
        assert!(v[1] > -3.0, "was not thrown back: {v:?}");
    }
}

#[test]
fn a_tapered_beam_is_struck_across_its_leaning_face() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("stiff", 2e11, 1e3));
    // Half depth from 50 mm to 300 mm over the first two metres, then constant.
    let station = |at: f64, half: f64| Station {
        at,
        area: 0.01,
        inertia: 1e-4,
        depth: Some(2.0 * half),
        profile: Profile::Unknown,
        properties: Default::default(),
    };
    let stations = vec![station(0.0, 0.05), station(2.0 / 3.0, 0.3), station(1.0, 0.3)];
    let section = b.section(Section { stations, ..Section::new("club", 0.01, 1e-4) });
    let club = b.beam(beam("club", [0.0, 0.0], [3.0, 0.0], 12, material, section));
    let speed = 10.0;
    let disc = b.disc(disc("ball", 0.01, 0.1, [1.1, 0.4], [0.0, -speed]));
    let law = TouchLaw::Smooth(SmoothLaw::elastic(linear(1e5)));
    b.contact(Contact::new("blow", [ContactPartner::Disc(disc), ContactPartner::Beam(club)], law));
    let summary = run(&b, 0.02, 1e-5);
    balances_close(&summary, 1e-11);
    // The face encloses circles whose radii grow by an eighth: it leans by asin(1/8), and the disc, a three-thousandth of
    // the beam's mass, is thrown back from it as from a mirror.
    let lean = (0.125_f64).asin();
    let expected = [-speed * (2.0 * lean).sin(), speed * (2.0 * lean).cos()];
    let found = summary.projectiles[0].velocity_final;
    for i in 0..2 {
        assert!((found[i] - expected[i]).abs() < 0.01 * speed, "{found:?}, {expected:?}");
    }
}

#[test]
fn a_disc_slides_over_the_stations_of_a_tapered_beam() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("soft", 2e9, 1e3));
    let station = |at: f64, half: f64| Station {
        at,
        area: 0.02 * half,
        inertia: 2e-3 * half * half,
        depth: Some(2.0 * half),
        profile: Profile::Unknown,
        properties: Default::default(),
    };
    let stations =
        vec![station(0.0, 0.03), station(0.3, 0.03), station(0.6, 0.12), station(1.0, 0.08)];
    let section = b.section(Section { stations, ..Section::new("club", 0.01, 1e-5) });
    let club = b.beam(beam("club", [0.0, 0.0], [3.0, 0.0], 20, material, section));
    let disc = b.disc(disc("ball", 2.0, 0.1, [0.5, 0.15], [20.0, -2.0]));
    let law = TouchLaw::Smooth(SmoothLaw::elastic(linear(2e5)));
    b.contact(Contact::new("slide", [ContactPartner::Disc(disc), ContactPartner::Beam(club)], law));
    let summary = run(&b, 0.15, 1e-4);
    balances_close(&summary, 1e-11);
    let first = &intervals(&summary, 0)[0];
    assert!(first.place_end.s - first.place.s > 0.15, "{first:?}");
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
fn dissipation_takes_what_the_balance_says() {
    let law =
        SmoothLaw { dissipation: 0.1, ..SmoothLaw::elastic(Potential::Hertz { stiffness: 1e6 }) };
    let summary = run(&thrown(0.05, [3.0, -4.0], TouchLaw::Smooth(law)), 0.2, 2e-4);
    balances_close(&summary, 1e-11);
    assert!(summary.energy.loss_damping > 0.5);
    let lost: f64 = intervals(&summary, 0).iter().map(|i| i.energy.lost).sum();
    assert!((lost - summary.energy.loss_damping).abs() < 1e-9 * lost);
}

#[test]
fn rigid_discs_bounce_slide_and_rub_with_closed_balances() {
    for (restitution, friction, tangential) in
        [(1.0, 0.0, 0.0), (0.5, 0.0, 0.0), (0.0, 0.0, 0.0), (0.6, 0.3, 0.0), (0.9, 0.8, 0.5)]
    {
        let law = RigidLaw {
            friction,
            tangential_restitution: tangential,
            ..RigidLaw::frictionless(restitution)
        };
        let summary = run(&thrown(0.05, [5.0, -4.0], TouchLaw::Rigid(law)), 0.2, 1e-4);
        balances_close(&summary, 1e-11);
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
fn contacts_without_thickness_are_refused_with_the_cure() {
    let built = |depths: [Option<f64>; 2]| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("soft", 2e9, 1e3));
        let mut section =
            |name: &str, depth| b.section(Section { depth, ..Section::new(name, 1e-2, 8.33e-6) });
        let (near, far) = (section("near", depths[0]), section("far", depths[1]));
        let a = b.beam(beam("a", [0.0, 0.0], [1.0, 0.0], 4, material, near));
        let c = b.beam(beam("c", [1.2, 0.0], [2.0, 0.0], 4, material, far));
        let law = TouchLaw::Rigid(RigidLaw::frictionless(1.0));
        b.contact(Contact::new("blow", [ContactPartner::Beam(a), ContactPartner::Beam(c)], law));
        b.build().map(|_| ())
    };
    let reported = built([None, None]).expect_err("no depth");
    let text = reported.iter().map(|f| f.to_string()).collect::<String>();
    assert!(
        text.contains("two beams whose ends have no depth") && text.contains("`depth`"),
        "{text}"
    );
    assert!(built([None, Some(0.05)]).is_ok());
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
        b.contact(Contact::new("blow", [ContactPartner::Beam(a), ContactPartner::Beam(c)], law));
        let model = b.build().unwrap();
        let mut simulation = Simulation::new(&model, &Settings::new(0.1, 1e-4)).unwrap();
        simulation.set_velocities(|name, _| if name == "upper" { [1.0, -5.0] } else { [0.0; 2] });
        let summary = simulation.run(&mut NoRecorder);
        assert!(matches!(summary.termination, Termination::Completed), "{:?}", summary.termination);
        balances_close(&summary, 1e-11);
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
    let place = normal.map(|n| radius * n);
    let disc = b.disc(disc("wheel", 2.0, radius, place, [0.0; 2]));
    let law = RigidLaw { friction: 0.5, ..RigidLaw::frictionless(0.0) };
    let between = [ContactPartner::Disc(disc), ContactPartner::Obstacle(floor)];
    b.contact(Contact::new("roll", between, TouchLaw::Rigid(law)));
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let summary = run(&b, 1.0, 1e-3);
    balances_close(&summary, 1e-10);
    let v = summary.projectiles[0].velocity_final;
    let expected = 2.0 / 3.0 * 9.81 * slope.sin();
    assert!((v[0].hypot(v[1]) - expected).abs() < 1e-3 * expected, "{v:?} {expected}");
    assert!(
        (summary.projectiles[0].spin_final + expected / radius).abs() < 1e-2 * expected / radius
    );
    // Friction carries a third of the weight's part along the slope.
    let friction = intervals(&summary, 0)[0].tangential_impulse;
    let expected = 2.0 * 9.81 * slope.sin() / 3.0;
    assert!((friction.abs() - expected).abs() < 1e-2 * expected, "{friction} {expected}");
}

/// Faults as `path: found; expected`.
fn faults(b: &ModelBuilder) -> Vec<String> {
    match b.build() {
        Ok(_) => Vec::new(),
        Err(faults) => faults.iter().map(ToString::to_string).collect(),
    }
}

#[test]
fn a_start_inside_is_refused_with_depth_place_and_cure() {
    let law = || TouchLaw::Rigid(RigidLaw::frictionless(0.5));
    let mut b = ModelBuilder::new();
    let girder = soft_bar(&mut b);
    let disc = b.disc(disc("deep", 1.0, 0.1, [2.0, 0.12], [0.0; 2]));
    let floor = b.obstacle(Obstacle {
        name: "floor".into(),
        shape: ObstacleShape::HalfPlane { point: [0.0, 0.05], normal: [0.0, 2.0] },
        motion: None,
    });
    b.contact(Contact::new(
        "floor",
        [ContactPartner::Disc(disc), ContactPartner::Obstacle(floor)],
        law(),
    ));
    b.contact(Contact::new(
        "deep",
        [ContactPartner::Disc(disc), ContactPartner::Beam(girder)],
        law(),
    ));
    let found = faults(&b);
    assert_eq!(found.len(), 2, "{found:#?}");
    assert!(found[0].contains("`deep` starts 0.03 m inside `floor`, at [2, 0.05]"));
    assert!(found[1].contains("`deep` starts 0.03 m inside `girder`, at [2, 0]"));
    assert!(found[1].contains("move `deep` by [0, 0.03000003] m"), "{}", found[1]);
}

#[test]
fn a_force_given_as_code_is_that_of_its_potential() {
    let law = |force: fn(f64) -> f64| {
        TouchLaw::Smooth(SmoothLaw::elastic(Potential::function(|p| 1.0 + 1e4 * p * p, force)))
    };
    let found = |force| faults(&thrown(0.05, [0.0, -1.0], law(force))).join("\n");
    assert!(thrown(0.05, [0.0, -1.0], law(|p| 2e4 * p)).build().is_ok());
    assert!(found(|p| 1e4 * p).contains("contact.throw.law: found at"), "{}", found(|p| 1e4 * p));
    assert!(found(|p| -2e4 * p).contains("never tensile"));
    assert!(found(|p| 5.0 + 2e4 * p).contains("a force of 5 N at zero penetration"));
    assert!(found(|_| f64::NAN).contains("contact.throw.law"));
}

#[test]
fn contradictory_laws_are_faults() {
    let mut b = thrown(
        -0.05,
        [0.0, -1.0],
        TouchLaw::Rigid(RigidLaw {
            friction: -0.1,
            tangential_restitution: 0.5,
            ..RigidLaw::frictionless(1.5)
        }),
    );
    b.obstacle(Obstacle {
        name: "lonely".into(),
        shape: ObstacleShape::Segment { ends: [[1.0, 1.0]; 2], thickness: -1.0 },
        motion: None,
    });
    let found = faults(&b).join("\n");
    for path in [
        "disc.ball.radius",
        "obstacle.lonely.ends",
        "obstacle.lonely.thickness",
        "obstacle.lonely: found no contact",
        "contact.throw.restitution",
        "contact.throw.friction",
    ] {
        assert!(found.contains(path), "{path} is missing in\n{found}");
    }
}

#[test]
fn a_moving_wall_does_its_work_on_the_balance() {
    // A wall that comes at 2 m/s throws a disc at rest off at 4 m/s, and works 8 J on a mass of 1 kg.
    for law in [
        TouchLaw::Rigid(RigidLaw::frictionless(1.0)),
        TouchLaw::Smooth(SmoothLaw::elastic(linear(1e6))),
    ] {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        b.beam(beam("aside", [50.0, 50.0], [53.0, 50.0], 1, material, section));
        let wall = b.obstacle(Obstacle {
            name: "wall".into(),
            shape: ObstacleShape::Segment { ends: [[0.0, -1.0], [0.0, 1.0]], thickness: 0.02 },
            motion: Some(Motion {
                displacement: [2.0, 0.0],
                rotation: 0.0,
                function: TimeFunction::Table {
                    times: vec![0.0, 1.0],
                    values: vec![0.0, 1.0],
                    smooth: false,
                },
            }),
        });
        let disc = b.disc(disc("ball", 1.0, 0.1, [0.2, 0.3], [0.0; 2]));
        b.contact(Contact::new(
            "throw",
            [ContactPartner::Disc(disc), ContactPartner::Obstacle(wall)],
            law,
        ));
        let summary = run(&b, 0.2, 1e-4);
        balances_close(&summary, 1e-11);
        let v = summary.projectiles[0].velocity_final;
        assert!((v[0] - 4.0).abs() < 1e-6 && v[1].abs() < 1e-12, "{v:?}");
        assert!((summary.energy.work_supports - 8.0).abs() < 1e-5);
        // The reaction of the wall on the striking body.
        assert_eq!(summary.supports[0].name, "wall");
    }
}

#[test]
fn a_stop_gives_what_it_was_given_and_nothing_before_and_after() {
    // A disc of 2 kg at 3 m/s strikes one wall of two elastically: half a sine of sqrt(k m) v = 3000 sqrt(2) N.
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    b.beam(beam("aside", [50.0, 50.0], [53.0, 50.0], 1, material, section));
    let ball = b.disc(disc("ball", 2.0, 0.1, [0.0, 0.0], [3.0, 0.0]));
    for (name, x) in [("struck", 0.2), ("far", 9.0)] {
        let shape = ObstacleShape::HalfPlane { point: [x, 0.0], normal: [-1.0, 0.0] };
        let wall = b.obstacle(Obstacle { name: name.into(), shape, motion: None });
        let law = TouchLaw::Smooth(SmoothLaw::elastic(linear(1e6)));
        b.contact(Contact::new(
            name,
            [ContactPartner::Disc(ball), ContactPartner::Obstacle(wall)],
            law,
        ));
    }
    let summary = run(&b, 0.1, 1e-5);
    balances_close(&summary, 1e-11);
    let support = |name: &str| summary.supports.iter().find(|s| s.name == name).unwrap();
    let [along, across] = support("struck").force;
    let peak = 3000.0 * 2.0_f64.sqrt();
    assert!((along.min.value + peak).abs() < 1e-4 * peak, "{along:?}");
    assert_eq!(along.max.value, 0.0);
    let first = 0.1 / 3.0; // touches, then half a period of contact
    let quarter = 0.5 * std::f64::consts::PI * (2.0_f64 / 1e6).sqrt();
    assert!((along.min.time - first - quarter).abs() < 2e-5);
    assert_eq!((across.min.value, across.max.value), (0.0, 0.0));
    for range in support("far").force {
        assert_eq!((range.min.value, range.max.value), (0.0, 0.0));
    }
}

#[test]
fn a_beam_that_is_folded_onto_itself_stops_at_its_own_face() {
    // A hairpin whose arms oscillate in phase: each arm stops the other.
    let closest = |touches: bool| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("soft", 2e8, 1e3));
        let section =
            b.section(Section { depth: Some(0.02), ..Section::new("wire", 4e-4, 1.3e-8) });
        let points = [[0.0, 0.1], [1.0, 0.1], [1.0, -0.1], [0.0, -0.1]];
        let pin = b.beam(Beam::new("pin", &points, 8, material, section));
        let law = TouchLaw::Smooth(SmoothLaw::elastic(linear(1e5)));
        if touches {
            b.contact(Contact::new(
                "self",
                [ContactPartner::Beam(pin), ContactPartner::Beam(pin)],
                law,
            ));
        }
        let model = b.build().unwrap();
        let mut simulation = Simulation::new(&model, &Settings::new(0.2, 1e-4)).unwrap();
        simulation.set_velocities(|_, x| [0.0, -4.0 * x[1].signum() * (1.0 - x[0])]);
        let mut least = f64::INFINITY;
        while simulation.state().step < simulation.step_count() {
            simulation.advance(&mut NoRecorder).unwrap();
            let last = simulation.state().displacement.len() - 1;
            let u = &simulation.state().displacement;
            least = least.min(0.2 + u[0][1] - u[last][1]);
        }
        let summary = simulation.run(&mut NoRecorder);
        balances_close(&summary, 1e-10);
        least
    };
    let (free, stopped) = (closest(false), closest(true));
    assert!(free < -0.05 && stopped > 0.0, "{free} {stopped}");
}

#[test]
fn two_masses_strike_one_after_the_other() {
    // A stiff spring between the masses: together they are the single mass of the paper's example.
    let rebound = |mass: f64, rear: Option<RearMass>| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let girder = b.beam(beam("girder", [0.0, 0.0], [3.0, 0.0], 6, material, section));
        let mid = common::at("mid", girder, 0.5);
        let kind = ProjectileKind::spring(7.5e5);
        b.projectile(Projectile { rear, ..Projectile::new("mass", kind, mass, [0.0, 20.0], mid) });
        let summary = run(&b, 0.15, 1e-4);
        balances_close(&summary, 1e-11);
        assert!(summary.momentum.linear_residual_max < 1e-12);
        summary.projectiles[0].clone()
    };
    let single = rebound(500.0, None);
    let stiff = RearMass { mass: 400.0, stiffness: 1e9, damping: 0.0 };
    let double = rebound(100.0, Some(stiff));
    let ratio = double.momentum_transferred / single.momentum_transferred;
    assert!((ratio - 1.0).abs() < 1e-3, "{ratio}");
    let damped = RearMass { mass: 400.0, stiffness: 5e5, damping: 2e3 };
    let soft = rebound(100.0, Some(damped));
    assert!((soft.momentum_transferred / single.momentum_transferred - 1.0).abs() > 1e-2);
}

#[test]
fn wild_steps_of_a_wall_and_clearances_keep_their_balances() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("tube", 2e11, 7.8e3));
    let section = b.section(Section::tube("tube", 0.02, 0.002));
    let tube = b.beam(beam("tube", [0.0, 0.0], [1.5, 0.0], 15, material, section));
    b.support(Support::new("left", common::at("left", tube, 0.0), SupportKind::Clamp));
    b.support(Support::new("right", common::at("right", tube, 1.0), SupportKind::Clamp));
    for (k, law) in [
        TouchLaw::Rigid(RigidLaw { friction: 0.2, ..RigidLaw::frictionless(0.7) }),
        TouchLaw::Smooth(SmoothLaw {
            dissipation: 0.5,
            ..SmoothLaw::elastic(Potential::Linear { stiffness: 1e6 })
        }),
    ]
    .into_iter()
    .enumerate()
    {
        let at = common::at("baffle", tube, 0.4 + 0.2 * k as f64);
        let shape = ObstacleShape::Clearance { at, width: 0.03, gap: 4e-4, sides: Sides::Both };
        let function = TimeFunction::Harmonic { frequency: 30.0, phase: 0.0 };
        let motion = Motion { displacement: [0.0, 2e-4], rotation: 0.0, function };
        let plate = b.obstacle(Obstacle { name: format!("b{k}"), shape, motion: Some(motion) });
        let between = [ContactPartner::Beam(tube), ContactPartner::Obstacle(plate)];
        b.contact(Contact { points_per_element: 4, ..Contact::new(format!("c{k}"), between, law) });
    }
    let kind = LoadKind::Distributed {
        beam: tube,
        stretch: [Along::Fraction(0.0), Along::Fraction(1.0)],
        force: [[0.0, 60.0]; 2],
        follower: false,
    };
    let function = TimeFunction::Harmonic { frequency: 40.0, phase: 0.0 };
    b.load(Load { function, ..Load::new("flow", kind) });
    let summary = run(&b, 0.2, 2e-4);
    balances_close(&summary, 1e-10);
    let impacts = match &summary.contacts[0].record {
        ContactRecord::Nonsmooth { impact_count, .. } => *impact_count,
        ContactRecord::Smooth { .. } => 0,
    };
    assert!(impacts > 3 && !intervals(&summary, 1).is_empty(), "{impacts}");
}
