//! Contact forces of frames: forces of contacts that have one, impulses of impacts, and never one for the other.

use crate::common;

use common::{at, beam, disc, elastic, plank, rigid};
use percuss::*;

/// A frame as it was shown.
struct Shown {
    time: f64,
    contact_forces: Vec<FrameForce>,
}

impl Shown {
    /// Magnitude of the resultant of a contact, its force or its impulse; zero without one.
    fn of(&self, contact: usize, impulsive: bool) -> f64 {
        let own = self.contact_forces.iter();
        let own = own.filter(|f| f.contact == contact && f.impulsive == impulsive);
        let sum = own.fold([0.0; 2], |sum, f| [sum[0] + f.force[0], sum[1] + f.force[1]]);
        f64::hypot(sum[0], sum[1])
    }
}

/// Keeps every frame. A frame is offered by the sums of its forces and of its impulses.
#[derive(Default)]
struct Frames {
    offered: [f64; 2],
    frames: Vec<Shown>,
}

impl Recorder for Frames {
    fn wants_frame(&mut self, _time: f64, force: f64, impulse: f64) -> bool {
        self.offered = [force, impulse];
        true
    }

    fn frame(&mut self, frame: &Frame<'_>) {
        for (offered, impulsive) in self.offered.into_iter().zip([false, true]) {
            let own = frame.contact_forces.iter().filter(|f| f.impulsive == impulsive);
            let sum: f64 = own.map(|f| f64::hypot(f.force[0], f.force[1])).sum();
            assert!((sum - offered).abs() <= 1e-9 * offered, "{sum} {offered} at {}", frame.time);
        }
        let contact_forces = frame.contact_forces.to_vec();
        self.frames.push(Shown { time: frame.time, contact_forces });
    }
}

impl Frames {
    fn of(model: &Model, settings: &Settings) -> (Vec<Shown>, RunSummary) {
        let mut frames = Self::default();
        let run = simulate(model, settings, &mut frames).unwrap();
        assert!(matches!(run.termination, Termination::Completed), "{:?}", run.termination);
        (frames.frames, run)
    }
}

/// Impacts, total impulse and that of persistent contact.
fn reported(run: &RunSummary, contact: usize) -> (&[Impact], f64, f64) {
    match &run.contacts[contact].record {
        ContactRecord::Nonsmooth { impacts, impulse_total, impulse_resting, .. } => {
            (impacts, *impulse_total, *impulse_resting)
        }
        ContactRecord::Smooth { .. } => panic!("a compliant contact"),
    }
}

/// The paper's rigid projectile on a clamped beam.
fn struck(restitution: f64) -> Model {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0; 2], [3.0, 0.0], 6, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, girder, f), SupportKind::Clamp));
    }
    b.projectile(rigid("hammer", at("girder.mid", girder, 0.5), [0.0, -40.0], restitution));
    b.build().unwrap()
}

fn time_stepping(end: f64, step: f64) -> Settings {
    let impacts = ImpactResolution::TimeStepping { closed_tolerance: 1e-9 };
    Settings { impacts, ..Settings::new(end, step) }
}

/// In the paper's time-stepping an impulse acts over a step: divided by its length it would be a force that grows as steps become shorter.
#[test]
fn an_impact_of_time_stepping_is_an_impulse_at_any_step() {
    for e in [1.0, 0.5] {
        let first = [1e-5, 2.5e-6].map(|step| {
            let (frames, run) = Frames::of(&struck(e), &time_stepping(1e-3, step));
            let (impacts, ..) = reported(&run, 0);
            let k = frames.iter().position(|f| !f.contact_forces.is_empty()).unwrap();
            let size = frames[k].of(0, true);
            assert!((size - impacts[0].impulse).abs() < 1e-9 * size, "{size} {:?}", impacts[0]);
            // The impulse belongs to the step from the frame before to this one, and to no other.
            assert!(frames[k - 1].time <= impacts[0].time && impacts[0].time < frames[k].time);
            assert!(frames[k + 1].contact_forces.is_empty());
            assert!(frames.iter().all(|f| f.of(0, false) == 0.0));
            size
        });
        assert!((first[0] / first[1] - 1.0).abs() < 0.01, "{e}: {first:?}");
    }
}

/// Without restitution the projectile moves on with the beam: persistent contact has a force, the impact before it an impulse.
#[test]
fn forces_and_impulses_of_time_stepping_are_those_of_the_summary() {
    for (e, rests) in [(0.0, true), (0.5, false), (1.0, false)] {
        let h = 1e-5;
        let (frames, run) = Frames::of(&struck(e), &time_stepping(0.02, h));
        let (_, total, resting) = reported(&run, 0);
        let impulses: f64 = frames.iter().map(|f| f.of(0, true)).sum();
        let forces: f64 = frames.iter().map(|f| h * f.of(0, false)).sum();
        assert_eq!(forces > 0.0, rests, "{e}");
        assert!((impulses - (total - resting)).abs() < 1e-9 * total, "{e}: {impulses}");
        assert!((forces - resting).abs() < 1e-9 * total, "{e}: {forces} {resting}");
    }
}

/// Before the instant of an impact nothing touches, at it there is an impulse, and after it a force where the contact stays closed.
#[test]
fn frames_before_at_and_after_an_impact() {
    for e in [0.0, 0.5, 1.0] {
        let first = [1e-5, 2.5e-6].map(|step| {
            let (frames, run) = Frames::of(&struck(e), &Settings::new(1e-3, step));
            let (impacts, ..) = reported(&run, 0);
            let k = frames.iter().position(|f| f.of(0, true) > 0.0).unwrap();
            let (before, at, after) = (&frames[k - 1], &frames[k], &frames[k + 1]);
            assert!(before.time < impacts[0].time && impacts[0].time < at.time);
            assert!(at.time - before.time < 2e-6 * step, "rows on both sides of the impact");
            assert!(frames[..k].iter().all(|f| f.contact_forces.is_empty()), "{e}");
            let size = at.of(0, true);
            assert!((size - impacts[0].impulse).abs() < 1e-9 * size, "{e}: {size}");
            assert_eq!(at.of(0, false), 0.0, "{e}");
            assert_eq!(after.of(0, true), 0.0, "{e}");
            assert_eq!(after.of(0, false) > 0.0, e == 0.0, "{e}");
            let force = frames.iter().map(|f| f.of(0, false)).fold(0.0, f64::max);
            // The force of persistent contact is that of the beam's deceleration, not the impulse over a step.
            assert!(force < 0.1 * size / step, "{e}: {force}");
            size
        });
        assert!((first[0] / first[1] - 1.0).abs() < 1e-3, "{e}: {first:?}");
    }
}

/// Balls on a floor: one rests, one falls beside it, one falls on the first.
fn balls() -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("stuff", 1e9, 1e3));
    let section = b.section(Section::new("bar", 0.01, 1e-5));
    b.beam(beam("far", [0.0, 9.0], [1.0, 9.0], 1, material, section));
    let shape = ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] };
    let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
    let resting = b.disc(disc("resting", 2.0, 0.1, [0.0, 0.1], [0.0; 2]));
    let beside = b.disc(disc("beside", 2.0, 0.1, [1.0, 0.12], [0.0, -1.0]));
    let above = b.disc(disc("above", 1.0, 0.1, [0.0, 0.33], [0.0, -1.0]));
    let (floor, under) = (ContactPartner::Obstacle(floor), ContactPartner::Disc(resting));
    for (name, between, e) in [
        ("resting", [under, floor], 0.0),
        ("beside", [ContactPartner::Disc(beside), floor], 0.5),
        ("above", [ContactPartner::Disc(above), under], 0.5),
    ] {
        b.contact(Contact::new(name, between, TouchLaw::Rigid(RigidLaw::frictionless(e))));
    }
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
    b.build().unwrap()
}

/// An impact elsewhere does not hide the force of a contact at rest and gives it no impulse; one that it transmits gives it both.
#[test]
fn a_contact_at_rest_keeps_its_force_in_the_impacts_of_others() {
    let weight = 2.0 * 9.81;
    let (frames, run) = Frames::of(&balls(), &Settings::new(0.04, 1e-4));
    for frame in &frames[1..] {
        let force = frame.of(0, false);
        assert!((force - weight).abs() < 1e-6 * weight, "{force} at {}", frame.time);
    }
    let struck: Vec<&Shown> =
        frames.iter().filter(|f| f.contact_forces.iter().any(|c| c.impulsive)).collect();
    let [beside, above] = struck[..] else { panic!("{} impacts", struck.len()) };
    let impulse = |contact: usize| reported(&run, contact).0[0].impulse;
    assert!((beside.of(1, true) - impulse(1)).abs() < 1e-9);
    assert_eq!((beside.of(0, true), beside.of(2, true)), (0.0, 0.0));
    assert!((above.of(2, true) - impulse(2)).abs() < 1e-9);
    assert!((above.of(0, true) - impulse(2)).abs() < 1e-6, "transmitted to the floor");
    assert_eq!(above.of(1, true), 0.0);
    assert!([1, 2].iter().all(|c| frames.iter().all(|f| f.of(*c, false) == 0.0)));
}

/// The impacts of a sequence take place at one instant: its frame has the impulses of all.
#[test]
fn a_frame_has_all_impulses_of_a_sequence() {
    let mut b = ModelBuilder::new();
    let balls: Vec<DiscId> = (0..4)
        .map(|i| {
            let (x, v) = if i == 0 { (-0.01, 1.0) } else { (0.2 * f64::from(i), 0.0) };
            b.disc(disc(&format!("ball {i}"), 1.0, 0.1, [x, 0.0], [v, 0.0]))
        })
        .collect();
    let material = b.material(Material::new("stuff", 1e9, 1e3));
    let section = b.section(Section::new("bar", 0.01, 1e-5));
    b.beam(beam("far", [0.0, 9.0], [1.0, 9.0], 1, material, section));
    for (i, two) in balls.windows(2).enumerate() {
        let between = [ContactPartner::Disc(two[0]), ContactPartner::Disc(two[1])];
        let law = TouchLaw::Rigid(RigidLaw::frictionless(1.0));
        b.contact(Contact::new(format!("touch {i}"), between, law));
    }
    let multiple_impacts = MultipleImpacts::Sequential;
    let settings = Settings { multiple_impacts, ..Settings::new(0.03, 1e-4) };
    let (frames, _) = Frames::of(&b.build().unwrap(), &settings);
    // Balls that touch at rest carry nothing but round-off.
    let strikes = |f: &&Shown| (0..3).any(|contact| f.of(contact, true) > 1e-9);
    let mut struck = frames.iter().filter(strikes);
    let frame = struck.next().unwrap();
    // A ball of 1 kg at 1 m/s passes on all of its momentum, three times.
    assert!((0..3).all(|contact| (frame.of(contact, true) - 1.0).abs() < 1e-9));
    assert!(struck.next().is_none());
}

/// Where impacts accumulate, contacts are held over the rest of a step: what stops a ball then is an impulse, however long that rest is.
#[test]
fn contacts_held_after_the_zeno_limit_have_impulses() {
    for h in [1e-3, 2.5e-4] {
        let model = common::ball_above_floor(0.2 * h);
        let mut simulation = Simulation::new(&model, &Settings::new(10.0 * h, h)).unwrap();
        simulation.advance_held(h).unwrap();
        let mut frames = Frames::default();
        simulation.run(&mut frames);
        let first = &frames.frames[0];
        assert!((first.of(0, true) - 6.0).abs() < 1e-6, "{h}: {}", first.of(0, true));
        assert_eq!(first.of(0, false), 0.0);
        // Afterwards it is at rest without weight; what is left is round-off.
        let left = frames.frames[1..].iter().map(|f| f.of(0, false) * h + f.of(0, true));
        assert!(left.fold(0.0, f64::max) < 1e-9, "{h}");
    }
}

/// Compliant contacts have forces in the frames of rigid impacts, too.
#[test]
fn a_compliant_and_a_rigid_contact_in_one_run() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0; 2], [3.0, 0.0], 6, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, girder, f), SupportKind::Clamp));
    }
    b.projectile(elastic("mass", at("girder.mid", girder, 0.5), [0.0, -40.0]));
    b.projectile(rigid("hammer", at("girder.side", girder, 1.0 / 3.0), [0.0, -10.0], 0.5));
    let (frames, run) = Frames::of(&b.build().unwrap(), &Settings::new(3e-3, 1e-5));
    let (impacts, ..) = reported(&run, 1);
    let at = frames.iter().find(|f| f.of(1, true) > 0.0).unwrap();
    assert!(at.time > 1e-3 && at.of(0, false) > 1e3, "{} {}", at.time, at.of(0, false));
    assert!((at.of(1, true) - impacts[0].impulse).abs() < 1e-9 * impacts[0].impulse);
    assert!(frames.iter().all(|f| f.of(0, true) == 0.0 && f.of(1, false) == 0.0));
}

/// A run from equilibrium begins with the forces of its contacts.
#[test]
fn the_first_frame_has_the_contact_forces_of_the_equilibrium() {
    let stiff = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e4 }));
    for law in [TouchLaw::Rigid(RigidLaw::frictionless(0.0)), stiff] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, 7850.0));
        let section = b.section(Section::rectangle("strip", 0.01, 0.002));
        let strip = b.beam(beam("strip", [0.0; 2], [2.0, 0.0], 40, material, section));
        b.support(Support::new("root", at("root", strip, 0.0), SupportKind::Clamp));
        let shape = ObstacleShape::HalfPlane { point: [0.0, -0.101], normal: [0.0, 1.0] };
        let floor = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
        let between = [ContactPartner::Beam(strip), ContactPartner::Obstacle(floor)];
        b.contact(Contact::new("on_floor", between, law));
        b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -9.81] }));
        let model = b.build().unwrap();
        let expected = equilibrium(&model).unwrap().contacts[0].force;
        let settings = Settings { start: Start::Static, ..Settings::new(2e-3, 1e-3) };
        let (frames, _) = Frames::of(&model, &settings);
        let first = frames[0].of(0, false);
        assert!(expected > 1.0 && (first - expected).abs() < 1e-6 * expected, "{first} {expected}");
        // The structure is at rest: the next frames have the same.
        let next = frames[1].of(0, false);
        assert!((next - expected).abs() < 1e-2 * expected, "{next} {expected}");
        let impulse = frames.iter().map(|f| f.of(0, true)).fold(0.0, f64::max);
        // Round-off of the equilibrium: a thousandth of what the force gives in a step of 1 ms.
        assert!(impulse < 1e-3 * expected * 1e-3, "nothing strikes: {impulse}");
    }
}
