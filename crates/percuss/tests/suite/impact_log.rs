//! Results of contacts: velocities for any step, penetrations, gaps; and invalid starts of a run.

use crate::common;

use common::{beam, disc};
use percuss::*;

fn plank(b: &mut ModelBuilder, elements: usize) -> BeamId {
    let material = b.material(Material::new("titanium", 110e9, 4430.0));
    let section = Section { depth: Some(0.008), ..Section::new("flat", 2e-4, 1.0667e-9) };
    let section = b.section(section);
    b.beam(beam("plank", [0.0, 0.0], [0.7, 0.0], elements, material, section))
}

fn held(b: &mut ModelBuilder, girder: BeamId) {
    for (name, fraction) in [("left", 0.0), ("right", 1.0)] {
        let at = PointRef { label: name.into(), beam: girder, along: Along::Fraction(fraction) };
        b.support(Support::new(name, at, SupportKind::Pin));
    }
}

/// A rigid disc that moves near a plank.
fn with_disc(radius: f64, position: [f64; 2], velocity: [f64; 2]) -> Model {
    let mut b = ModelBuilder::new();
    let girder = plank(&mut b, 7);
    held(&mut b, girder);
    let ball = b.disc(disc("ball", 0.01, radius, position, velocity));
    let law = TouchLaw::Rigid(RigidLaw::frictionless(0.0));
    b.contact(Contact::new(
        "touch",
        [ContactPartner::Disc(ball), ContactPartner::Beam(girder)],
        law,
    ));
    b.build().unwrap()
}

fn faults(b: &ModelBuilder) -> Vec<String> {
    b.build().err().map_or(Vec::new(), |f| f.iter().map(ToString::to_string).collect())
}

/// Intervals of the first contact.
fn intervals(run: &RunSummary) -> &[ContactInterval] {
    match &run.contacts[0].record {
        ContactRecord::Smooth { intervals, .. } | ContactRecord::Nonsmooth { intervals, .. } => {
            intervals
        }
    }
}

fn penetration(run: &RunSummary) -> f64 {
    let depth = |contact: &ContactSummary| match contact.record {
        ContactRecord::Nonsmooth { penetration, .. } => penetration.value,
        ContactRecord::Smooth { .. } => 0.0,
    };
    run.contacts.iter().map(depth).fold(0.0, f64::max)
}

/// A ball thrown at a plank, guided; the contact lasts about 70 us.
fn thrown(gravity: f64) -> Model {
    let mut b = ModelBuilder::new();
    let girder = plank(&mut b, 7);
    held(&mut b, girder);
    let at = PointRef { label: "place".into(), beam: girder, along: Along::Fraction(0.43) };
    let hertz = SmoothLaw::elastic(Potential::Hertz { stiffness: 1e10 });
    let kind = ProjectileKind::Elastic { law: hertz };
    let ball = Projectile::new("ball", kind, 0.05, [0.0, -3.0], at);
    b.projectile(Projectile { standoff: 0.002, ..ball });
    b.load(Load::new("gravity", LoadKind::Gravity { acceleration: [0.0, -gravity] }));
    b.build().unwrap()
}

#[test]
fn velocities_of_approach_do_not_depend_on_the_step() {
    let free = thrown(0.0);
    for step in [1e-4, 5e-5, 7e-6, 1e-6] {
        let run = simulate(&free, &Settings::new(2e-3, step), &mut NoRecorder).unwrap();
        let first = &intervals(&run)[0];
        assert!((first.approach_velocity - 3.0).abs() < 1e-12, "{step}: {first:?}");
        assert!((first.start - 0.002 / 3.0).abs() < 1e-12, "{step}: {first:?}");
    }
}

/// A projectile that arrives at the very end of a run has not touched, whichever side of zero round-off leaves its gap on.
#[test]
fn a_contact_that_closes_at_the_end_is_none() {
    for standoff in [0.2, 0.02, 0.07, 0.3, 0.1] {
        for (elements, steps) in [(2, 100.0), (6, 100.0), (7, 130.0)] {
            let mut b = ModelBuilder::new();
            let girder = plank(&mut b, elements);
            held(&mut b, girder);
            let at = PointRef { label: "mid".into(), beam: girder, along: Along::Fraction(0.5) };
            let mass = common::elastic("mass", at, [0.0, -20.0]);
            b.projectile(Projectile { standoff, ..mass });
            let (model, end) = (b.build().unwrap(), standoff / 20.0);
            let settings = Settings::new(end, end / steps);
            let run = simulate(&model, &settings, &mut NoRecorder).unwrap();
            assert!(intervals(&run).is_empty(), "{standoff}: {:?}", intervals(&run));
            let ContactRecord::Smooth { peak_force, .. } = run.contacts[0].record else { panic!() };
            assert!(peak_force.value.is_nan(), "{standoff}: {peak_force:?}");
        }
    }
}

#[test]
fn a_ball_that_falls_on_a_floor_leaves_as_it_came() {
    // Energy is kept at every end of a step, so the flight after the contact is that before it, mirrored, however coarse the step.
    for step in [2e-3, 5e-4, 1e-4] {
        let mut b = ModelBuilder::new();
        let ball = b.disc(disc("ball", 2.0, 0.1, [0.0, 0.6], [0.0, 0.0]));
        let floor = b.obstacle(Obstacle {
            name: "floor".into(),
            shape: ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] },
            motion: None,
        });
        let girder = plank(&mut b, 2);
        held(&mut b, girder);
        let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 2e4 }));
        b.contact(Contact::new(
            "drop",
            [ContactPartner::Disc(ball), ContactPartner::Obstacle(floor)],
            law,
        ));
        b.load(Load::new("gravity", LoadKind::Gravity { acceleration: [0.0, -10.0] }));
        let run =
            simulate(&b.build().unwrap(), &Settings::new(0.5, step), &mut NoRecorder).unwrap();
        let first = &intervals(&run)[0];
        let fall = 10.0_f64.sqrt();
        assert!((first.approach_velocity - fall).abs() < 1e-12, "{step}: {first:?}");
        let missing = (first.separation_velocity - fall).abs();
        assert!(missing < 1e-10, "{step}: {missing} {first:?}");
    }
}

#[test]
fn a_ball_leaves_a_floor_that_falls_away_faster_than_it_does() {
    // It rests on a floor that moves by A (1 - cos w t) and leaves it when A w^2 cos w t = -g.
    let (amplitude, omega, gravity) = (0.05_f64, 20.0_f64, 9.81_f64);
    let expected = (-gravity / (amplitude * omega * omega)).acos() / omega;
    for step in [1e-3, 1e-4] {
        let mut b = ModelBuilder::new();
        let ball = b.disc(disc("ball", 2.0, 0.1, [0.0, 0.1], [0.0, 0.0]));
        let rise = move |t: f64| amplitude * (1.0 - (omega * t).cos());
        let floor = b.obstacle(Obstacle {
            name: "floor".into(),
            shape: ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] },
            motion: Some(Motion {
                displacement: [0.0, 1.0],
                rotation: 0.0,
                function: TimeFunction::function(rise),
            }),
        });
        let girder = plank(&mut b, 2);
        held(&mut b, girder);
        let law = TouchLaw::Rigid(RigidLaw::frictionless(0.5));
        b.contact(Contact::new(
            "lift",
            [ContactPartner::Disc(ball), ContactPartner::Obstacle(floor)],
            law,
        ));
        b.load(Load::new("gravity", LoadKind::Gravity { acceleration: [0.0, -gravity] }));
        let run =
            simulate(&b.build().unwrap(), &Settings::new(0.15, step), &mut NoRecorder).unwrap();
        let first = &intervals(&run)[0];
        assert!((first.end - expected).abs() < 0.6 * step, "{step}: {} {expected}", first.end);
        assert!(first.separation_velocity.abs() < 1e-3 * amplitude * omega, "{first:?}");
    }
}

#[test]
fn a_jump_against_a_rigid_contact_is_refused() {
    let at = |at: f64, law: TouchLaw| {
        let mut b = ModelBuilder::new();
        let girder = plank(&mut b, 8);
        let floor = b.obstacle(Obstacle {
            name: "floor".into(),
            shape: ObstacleShape::HalfPlane { point: [0.0, -0.02], normal: [0.0, 1.0] },
            motion: Some(Motion {
                displacement: [0.0, 0.01],
                rotation: 0.0,
                function: TimeFunction::Step { at },
            }),
        });
        b.contact(Contact::new(
            "touch",
            [ContactPartner::Beam(girder), ContactPartner::Obstacle(floor)],
            law,
        ));
        faults(&b)
    };
    let rigid = || TouchLaw::Rigid(RigidLaw::frictionless(0.5));
    let found = at(0.01, rigid());
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("a jump at 0.01 s, against the rigid contact `touch`"), "{found:?}");
    assert!(at(0.0, rigid()).is_empty());
    let soft = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e5 }));
    assert!(at(0.01, soft).is_empty());
}

#[test]
fn an_obstacle_that_darts_within_a_step_strikes() {
    // 30 mm in a thousandth of a step, from below a free beam to well above where it lay.
    let mut b = ModelBuilder::new();
    let girder = plank(&mut b, 8);
    let floor = b.obstacle(Obstacle {
        name: "floor".into(),
        shape: ObstacleShape::HalfPlane { point: [0.0, -0.02], normal: [0.0, 1.0] },
        motion: Some(Motion {
            displacement: [0.0, 0.03],
            rotation: 0.0,
            function: TimeFunction::Table {
                times: vec![0.0, 0.01, 0.010001],
                values: vec![0.0, 0.0, 1.0],
                smooth: false,
            },
        }),
    });
    let law = TouchLaw::Rigid(RigidLaw::frictionless(0.0));
    b.contact(Contact::new(
        "touch",
        [ContactPartner::Beam(girder), ContactPartner::Obstacle(floor)],
        law,
    ));
    let run = simulate(&b.build().unwrap(), &Settings::new(0.012, 1e-3), &mut NoRecorder).unwrap();
    let ContactRecord::Nonsmooth { impact_count, .. } = run.contacts[0].record else { panic!() };
    assert!(impact_count > 0);
    assert!(penetration(&run) < 1e-6, "{}", penetration(&run));
    assert!(run.energy.residual_max < 1e-10, "{}", run.energy.residual_max);
}

#[test]
fn a_wall_across_a_beam_is_refused_with_a_cure() {
    let built = |shift: [f64; 2]| {
        let mut b = ModelBuilder::new();
        let girder = plank(&mut b, 7);
        let ends = [[0.53, 0.3], [0.53, -0.2]].map(|p| [p[0] + shift[0], p[1] + shift[1]]);
        let wall = b.obstacle(Obstacle {
            name: "wall".into(),
            shape: ObstacleShape::Segment { ends, thickness: 0.002 },
            motion: None,
        });
        let law = TouchLaw::Rigid(RigidLaw::frictionless(0.5));
        b.contact(Contact::new(
            "touch",
            [ContactPartner::Beam(girder), ContactPartner::Obstacle(wall)],
            law,
        ));
        faults(&b)
    };
    let found = built([0.0, 0.0]);
    assert_eq!(found.len(), 1, "{found:?}");
    // The nearest end is that of the plank, 0.17 m beyond the middle of the wall.
    assert!(found[0].contains("`plank` starts 0.171 m inside `wall`, at [0.53, "), "{found:?}");
    assert!(found[0].contains("move `plank` by [-0.1710002, 0] m"), "{found:?}");
    assert!(built([0.1710002, 0.0]).is_empty());
    assert_eq!(built([0.17, 0.0]).len(), 1);

    let mut b = ModelBuilder::new();
    let girder = plank(&mut b, 7);
    let material = b.material(Material::new("other", 1e9, 1e3));
    let section = Section { depth: Some(0.002), ..Section::new("thin", 1e-5, 1e-12) };
    let section = b.section(section);
    let other = beam("other", [0.37, -0.3], [0.33, 0.25], 5, material, section);
    let other = b.beam(other);
    let law = TouchLaw::Rigid(RigidLaw::frictionless(0.5));
    b.contact(Contact::new(
        "crossing",
        [ContactPartner::Beam(girder), ContactPartner::Beam(other)],
        law,
    ));
    let found = faults(&b);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("contact.crossing.between"), "{found:?}");
}

/// Gaps of the first contact in every row.
#[derive(Default)]
struct Gaps {
    column: usize,
    values: Vec<f64>,
}

impl Recorder for Gaps {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        self.column = channels.iter().position(|c| c.name.ends_with(".gap")).unwrap();
        Ok(())
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        self.values.push(values[self.column]);
        Ok(())
    }
}

#[test]
fn a_source_at_the_other_face_is_not_inside() {
    // A free plank rotates one and a half times in front of a disc above its middle: both faces turn towards it.
    let mut b = ModelBuilder::new();
    let girder = plank(&mut b, 7);
    b.initial_motion(InitialMotion { spin: 30.0, about: [0.35, 0.0], ..InitialMotion::default() });
    let ball = b.disc(disc("ball", 0.01, 0.02, [0.35, 3.0], [0.0; 2]));
    let law = TouchLaw::Rigid(RigidLaw::frictionless(0.5));
    b.contact(Contact::new(
        "miss",
        [ContactPartner::Disc(ball), ContactPartner::Beam(girder)],
        law,
    ));
    let mut gaps = Gaps::default();
    let model = b.build().unwrap();
    simulate(&model, &Settings::new(0.3, 1e-3), &mut gaps).unwrap();
    assert!(gaps.values.len() > 250);
    // The plank's ends come within 0.35 m of its middle, and both have a depth.
    let (least, most) = gaps
        .values
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(low, high), gap| (low.min(*gap), high.max(*gap)));
    assert!(least > 3.0 - 0.36 - 0.024 && most < 3.0, "{least} {most}");
}

#[test]
fn depths_are_reported() {
    // Time stepping evaluates contacts once per step, and stops penetrations over the next: a disc penetrates by at most its travel in both.
    let model = with_disc(0.01, [0.2, 0.02], [0.0, -2.0]);
    let located = Settings::new(4e-3, 1e-4);
    let stepped = ImpactResolution::TimeStepping { closed_tolerance: 0.0 };
    let stepped = Settings { impacts: stepped, ..located };
    let depth =
        |settings: &Settings| penetration(&simulate(&model, settings, &mut NoRecorder).unwrap());
    assert!(depth(&located) < 1e-9, "{}", depth(&located));
    assert!(depth(&stepped) > 1e-6 && depth(&stepped) < 4e-4, "{}", depth(&stepped));
}

#[test]
fn parts_that_move_against_each_other_have_a_scale_of_momentum() {
    // Equal and opposite forces on two halves: momenta of the whole vanish, those of the parts do not.
    let mut b = ModelBuilder::new();
    let girder = plank(&mut b, 10);
    for (name, stretch, force) in
        [("up", [0.0, 0.25], 50.0), ("middle", [0.25, 0.75], -50.0), ("up too", [0.75, 1.0], 50.0)]
    {
        let kind = LoadKind::Distributed {
            beam: girder,
            stretch: stretch.map(Along::Fraction),
            force: [[0.0, force]; 2],
            follower: false,
        };
        b.load(Load::new(name, kind));
    }
    let run = simulate(&b.build().unwrap(), &Settings::new(0.02, 1e-4), &mut NoRecorder).unwrap();
    let momentum = &run.momentum;
    assert!(momentum.linear_scale > 1e-3, "{momentum:?}");
    assert!(momentum.linear_residual_max < 1e-12, "{momentum:?}");
    assert!(momentum.angular_residual_max < 1e-12, "{momentum:?}");
}

/// A disc that moves obliquely past a wall and strikes it under a smooth law.
fn oblique(stiffness: f64, step: f64) -> RunSummary {
    let mut b = ModelBuilder::new();
    let ball = b.disc(disc("ball", 0.01, 0.02, [0.1, 0.05], [7.0, -3.0]));
    let girder = plank(&mut b, 7);
    held(&mut b, girder);
    let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness }));
    b.contact(Contact::new(
        "touch",
        [ContactPartner::Disc(ball), ContactPartner::Beam(girder)],
        law,
    ));
    simulate(&b.build().unwrap(), &Settings::new(0.02, step), &mut NoRecorder).unwrap()
}

#[test]
fn a_contact_begins_where_it_closed_whatever_the_step() {
    // The gap of 26 mm closes at 3 m/s; along the plank the disc moves at 7 m/s.
    let (time, s) = (0.026 / 3.0, 0.1 + 7.0 * 0.026 / 3.0);
    for step in [5e-4, 1e-4, 1e-5] {
        let run = oblique(1e4, step);
        let first = &intervals(&run)[0];
        assert!((first.start - time).abs() < 1e-12, "{step}: {first:?}");
        // The deflection of the plank at the end of the step inclines its face, negligibly within it; the end of the step is up to 3.5 mm farther
        // along.
        assert!((first.place.s - s).abs() < 1e-6, "{step}: {:?} {s}", first.place);
        assert!((first.place.position[1] - 0.004).abs() < 1e-5, "{step}: {:?}", first.place);
        // It leaves farther along, and not later than it has flown by then.
        let flown = s + 7.0 * (first.end - first.start);
        assert!((first.place_end.s - flown).abs() < 0.02 * (flown - s) + 1e-6, "{first:?} {flown}");
    }
}

#[test]
fn a_contact_that_the_step_does_not_resolve_has_no_restitution() {
    let restitution = |stiffness: f64, step: f64| {
        let run = oblique(stiffness, step);
        let first = intervals(&run)[0];
        (first.restitution(), first)
    };
    // A half period of pi sqrt(0.01 kg / 1e4 N/m) = 3 ms, in 300 steps and in two or three.
    let (found, first) = restitution(1e4, 1e-5);
    assert!(found.is_ok_and(|e| e > 0.0 && e < 1.0), "{first:?}");
    let (found, first) = restitution(1e6, 2.5e-4);
    assert!(matches!(found, Err(NoRestitution::Steps(1..=3))), "{first:?}");
    // Every reported number is a possible one.
    for stiffness in [1e4, 1e5, 1e6, 1e7, 1e8] {
        for step in [5e-4, 2e-4, 1e-4, 5e-5] {
            for interval in intervals(&oblique(stiffness, step)) {
                let impossible = |e: f64| !(0.0..=1e6).contains(&e);
                assert!(!interval.restitution().is_ok_and(impossible), "{interval:?}");
                assert!(
                    interval.separation_velocity.is_nan() || interval.separation_velocity >= 0.0
                );
            }
        }
    }
}
