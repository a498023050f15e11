//! Impact on several touching bodies: simultaneous, or one after another.

use crate::common;

use common::disc;
use percuss::*;

/// Balls of the given masses in a row, the first `flying` of them moving towards the others.
fn row(masses: &[f64], flying: usize, law: RigidLaw) -> Model {
    let mut b = ModelBuilder::new();
    let mut balls = Vec::new();
    for (i, mass) in masses.iter().enumerate() {
        let x = 0.2 * i as f64 - if i < flying { 0.01 } else { 0.0 };
        let speed = if i < flying { 1.0 } else { 0.0 };
        balls.push(b.disc(disc(&format!("ball {i}"), *mass, 0.1, [x, 0.0], [speed, 0.0])));
    }
    let material = b.material(Material::new("stuff", 1e9, 1e3));
    let section = b.section(Section::new("bar", 0.01, 1e-5));
    b.beam(common::beam("far", [0.0, 9.0], [1.0, 9.0], 1, material, section));
    for (i, two) in balls.windows(2).enumerate() {
        let between = [ContactPartner::Disc(two[0]), ContactPartner::Disc(two[1])];
        b.contact(Contact::new(format!("touch {i}"), between, TouchLaw::Rigid(law)));
    }
    b.build().unwrap()
}

fn run(model: &Model, multiple_impacts: MultipleImpacts) -> RunSummary {
    let settings = Settings { multiple_impacts, ..Settings::new(0.03, 1e-4) };
    simulate(model, &settings, &mut NoRecorder).unwrap()
}

fn speeds(run: &RunSummary) -> Vec<f64> {
    run.projectiles.iter().map(|p| p.velocity_final[0]).collect()
}

fn near(found: &[f64], expected: &[f64]) {
    let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(found.len() == expected.len() && off < 1e-12, "{found:?} {expected:?}");
}

/// Newton's cradle: the numbers of incoming and leaving balls are equal.
#[test]
fn a_cradle_sends_out_as_many_as_came_in() {
    for balls in 1..5 {
        let model = row(&[1.0; 5], balls, RigidLaw::frictionless(1.0));
        let found = run(&model, MultipleImpacts::Sequential);
        let expected: Vec<f64> = (0..5).map(|i| f64::from(u8::from(i >= 5 - balls))).collect();
        near(&speeds(&found), &expected);
        assert_eq!(found.multiple_impacts.count, 0);
        assert!(found.energy.loss_impacts.abs() < 1e-14 && found.energy.residual_max < 1e-14);
        assert!(found.momentum.linear_residual_max < 1e-14);
    }
}

/// Along a row of touching balls of masses m_i the last one leaves with prod (1 + e) m_i / (m_i + m_i+1), as along one with gaps.
#[test]
fn an_impact_is_passed_on_through_unequal_balls() {
    let (masses, e) = ([2.0, 1.0, 0.5, 0.25_f64], 0.8);
    let model = row(&masses, 1, RigidLaw::frictionless(e));
    let found = run(&model, MultipleImpacts::Sequential);
    let last: f64 = masses.windows(2).map(|m| (1.0 + e) * m[0] / (m[0] + m[1])).product();
    assert!((speeds(&found)[3] - last).abs() < 1e-12, "{:?} {last}", speeds(&found));
    let kinetic = |v: &[f64]| masses.iter().zip(v).map(|(m, v)| 0.5 * m * v * v).sum::<f64>();
    let lost = 1.0 - kinetic(&speeds(&found));
    assert!((found.energy.loss_impacts - lost).abs() < 1e-14, "{:?} {lost}", found.energy);
    // Every impact of the sequence has its own row, whose velocities obey the law.
    for contact in &found.contacts {
        let ContactRecord::Nonsmooth { impacts, .. } = &contact.record else { continue };
        for impact in impacts.iter().filter(|i| i.approach_velocity > 1e-6) {
            assert!(impact.restitution().is_ok_and(|r| (r - e).abs() < 1e-9), "{impact:?}");
        }
    }
}

/// Without restitution touching balls move on together, for both laws.
#[test]
fn a_plastic_impact_takes_the_row_along() {
    for how in [MultipleImpacts::Simultaneous, MultipleImpacts::Sequential] {
        let found = run(&row(&[1.0; 5], 1, RigidLaw::frictionless(0.0)), how);
        let off = speeds(&found).iter().map(|v| (v - 0.2).abs()).fold(0.0, f64::max);
        // A sequence ends when no approach is faster than a millionth of the impact velocity, and the rest is concluded by a simultaneous impact.
        assert!(off < 1e-12, "{how:?} {:?}", speeds(&found));
        assert_eq!(found.multiple_impacts.count, 0, "nothing bounces: both laws say the same");
    }
}

/// Newton's law for a simultaneous impact: (-1/2, 1/2, 1/2, 1/2) for three balls at rest. The summary reports it.
#[test]
fn a_shared_impact_is_reported() {
    let model = row(&[1.0; 4], 1, RigidLaw::frictionless(1.0));
    let found = run(&model, MultipleImpacts::Simultaneous);
    near(&speeds(&found), &[-0.5, 0.5, 0.5, 0.5]);
    let shared = found.multiple_impacts;
    assert_eq!((shared.count, shared.contacts), (1, [0, 1]), "{shared:?}");
    assert!((shared.first - 0.01).abs() < 1e-8, "{shared:?}");
    // With one impact after another there is no simultaneous impact.
    let alone = run(&row(&[1.0; 2], 1, RigidLaw::frictionless(1.0)), MultipleImpacts::Simultaneous);
    assert_eq!(alone.multiple_impacts.count, 0);
}

/// Friction acts in each impact of a sequence by itself and never gives energy; balances stay closed.
#[test]
fn sequences_with_friction_and_weight_keep_their_balances() {
    let mut b = ModelBuilder::new();
    let law = RigidLaw { friction: 0.4, ..RigidLaw::frictionless(0.6) };
    let floor = b.obstacle(Obstacle {
        name: "floor".into(),
        shape: ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] },
        motion: None,
    });
    let material = b.material(Material::new("stuff", 1e9, 1e3));
    let section = b.section(Section::new("bar", 0.01, 1e-5));
    b.beam(common::beam("far", [0.0, 9.0], [1.0, 9.0], 1, material, section));
    let centres = [[0.0, 0.1], [0.2, 0.1], [0.4, 0.1], [-0.25, 0.1]];
    let balls: Vec<DiscId> = (0..4)
        .map(|i| {
            let velocity = if i == 3 { [3.0, 0.0] } else { [0.0; 2] };
            b.disc(disc(&format!("ball {i}"), 1.0 + 0.3 * i as f64, 0.1, centres[i], velocity))
        })
        .collect();
    for (i, two) in [[0, 1], [1, 2], [3, 0]].iter().enumerate() {
        let between = two.map(|k| ContactPartner::Disc(balls[k]));
        b.contact(Contact::new(format!("touch {i}"), between, TouchLaw::Rigid(law)));
    }
    for (i, ball) in balls.iter().enumerate() {
        let between = [ContactPartner::Disc(*ball), ContactPartner::Obstacle(floor)];
        b.contact(Contact::new(format!("floor {i}"), between, TouchLaw::Rigid(law)));
    }
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    let settings =
        Settings { multiple_impacts: MultipleImpacts::Sequential, ..Settings::new(0.2, 2e-4) };
    let found = simulate(&b.build().unwrap(), &settings, &mut NoRecorder).unwrap();
    assert!(matches!(found.termination, Termination::Completed), "{:?}", found.termination);
    assert!(found.energy.residual_max < 1e-12, "{:?}", found.energy);
    assert!(found.momentum.linear_residual_max < 1e-12, "{:?}", found.momentum);
    assert!(found.energy.loss_impacts > 0.0);
    let order: Vec<f64> = [3, 0, 1, 2].iter().map(|k| speeds(&found)[*k]).collect();
    assert!(order.is_sorted() && order[3] > 1.0, "{order:?}");
}

/// Contacts with equal approach share an impact of the sequence: a ball that falls between two equal ones rebounds in the opposite direction.
#[test]
fn a_ball_that_falls_between_two_equal_ones_goes_back_straight() {
    for e in [1.0, 0.5] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("stuff", 1e9, 1e3));
        let section = b.section(Section::new("bar", 0.01, 1e-5));
        b.beam(common::beam("far", [0.0, 9.0], [1.0, 9.0], 1, material, section));
        let ball = b.disc(disc("ball", 1.0, 0.1, [0.0, 0.15], [0.0, -1.0]));
        for (name, x) in [("left", -0.15), ("right", 0.15)] {
            let shape = ObstacleShape::Disc { centre: [x, 0.0], radius: 0.1 };
            let stone = b.obstacle(Obstacle { name: name.into(), shape, motion: None });
            let between = [ContactPartner::Disc(ball), ContactPartner::Obstacle(stone)];
            b.contact(Contact::new(name, between, TouchLaw::Rigid(RigidLaw::frictionless(e))));
        }
        let found = run(&b.build().unwrap(), MultipleImpacts::Sequential);
        near(&found.projectiles[0].velocity_final, &[0.0, e]);
    }
}

#[test]
fn sequences_need_the_instant_of_contact() {
    let model = row(&[1.0; 3], 1, RigidLaw::frictionless(1.0));
    let settings = Settings {
        multiple_impacts: MultipleImpacts::Sequential,
        impacts: ImpactResolution::TimeStepping { closed_tolerance: 1e-9 },
        ..Settings::new(0.01, 1e-4)
    };
    let faults = settings.validate(&model);
    assert_eq!(faults.len(), 1);
    assert!(faults[0].to_string().contains("time.multiple_impacts"), "{}", faults[0]);
}

/// A stiff stick that falls obliquely on a floor without losses: the effective mass of its mesh is far larger than that of a slender beam, so that
/// the motion depends on the mesh. The summary reports it.
#[test]
fn the_effective_mass_of_a_stick_on_a_floor_is_in_the_summary() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("stiff", 1e12, 1000.0));
    let section = Section { depth: Some(0.02), ..Section::new("rod", 4e-4, 1.3333e-8) };
    let section = b.section(section);
    let stick = b.beam(common::beam("stick", [0.0, 0.02], [0.9, 0.2], 4, material, section));
    let floor = b.obstacle(Obstacle {
        name: "floor".into(),
        shape: ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] },
        motion: None,
    });
    let law = TouchLaw::Rigid(RigidLaw::frictionless(1.0));
    b.contact(Contact::new(
        "drop",
        [ContactPartner::Beam(stick), ContactPartner::Obstacle(floor)],
        law,
    ));
    b.initial_motion(InitialMotion { velocity: [0.0, -1.0], ..InitialMotion::default() });
    let model = b.build().unwrap();
    let settings = Settings::new(0.02, 1e-5);
    let found = simulate(&model, &settings, &mut NoRecorder).unwrap();
    let mass = found.contacts[0].effective_mass.unwrap();
    assert!(mass.depends_on_mesh(), "{mass:?}");
    // The impulse of the first impact is (1 + e) m v.
    let ContactRecord::Nonsmooth { impacts, .. } = &found.contacts[0].record else { panic!() };
    let first = impacts[0];
    let expected = 2.0 * mass.on_mesh * first.approach_velocity;
    assert!((first.impulse / expected - 1.0).abs() < 1e-4, "{first:?} {mass:?}");
}
