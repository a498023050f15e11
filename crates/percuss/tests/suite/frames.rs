//! Frames and the scene: data of drawings agree with the other results of the run.

use crate::common;

use common::{at, beam, elastic, plank, rigid};
use percuss::scene::{BodyShape, ObstacleOutline, SupportSymbol};
use percuss::*;

/// A frame as it was shown.
struct Shown {
    time: f64,
    impulsive: bool,
    displacement: Vec<[f64; 4]>,
    section_forces: Vec<[[f64; 3]; 2]>,
    section_points: Vec<SectionPoint>,
    contact_forces: Vec<FrameForce>,
    load_factors: Vec<f64>,
}

/// Keeps every frame and, of one column, every row.
#[derive(Default)]
struct Frames {
    frames: Vec<Shown>,
    impulsive: bool,
    column: &'static str,
    index: usize,
    rows: Vec<f64>,
}

impl Recorder for Frames {
    fn begin(&mut self, channels: &[Channel]) -> Result<(), RecorderError> {
        let found = channels.iter().position(|c| c.name == self.column);
        self.index = found.unwrap_or(0);
        Ok(())
    }

    fn row(&mut self, values: &[f64]) -> Result<(), RecorderError> {
        self.rows.push(values[self.index]);
        Ok(())
    }

    fn wants_frame(&mut self, _time: f64, _force: f64, impulse: f64) -> bool {
        self.impulsive = impulse > 0.0;
        true
    }

    fn frame(&mut self, frame: &Frame<'_>) {
        self.frames.push(Shown {
            time: frame.time,
            impulsive: self.impulsive,
            displacement: frame.displacement.to_vec(),
            section_forces: frame.section_forces.to_vec(),
            section_points: frame.section_points.to_vec(),
            contact_forces: frame.contact_forces.to_vec(),
            load_factors: frame.load_factors.to_vec(),
        });
    }
}

fn clamped(b: &mut ModelBuilder) -> BeamId {
    let (material, section) = plank(b);
    let girder = b.beam(beam("girder", [0.0; 2], [3.0, 0.0], 6, material, section));
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, girder, f), SupportKind::Clamp));
    }
    girder
}

#[test]
fn frames_hold_the_impulses_of_the_impacts() {
    let mut b = ModelBuilder::new();
    let girder = clamped(&mut b);
    b.projectile(rigid("hammer", at("girder.mid", girder, 0.5), [0.0, -40.0], 1.0));
    let model = b.build().unwrap();
    let mut frames = Frames::default();
    let run = simulate(&model, &Settings::new(0.03, 1e-5), &mut frames).unwrap();
    let ContactRecord::Nonsmooth { impacts, .. } = &run.contacts[0].record else {
        panic!("not a rigid contact")
    };
    assert!(!impacts.is_empty());
    let shown: Vec<&Shown> = frames.frames.iter().filter(|f| f.impulsive).collect();
    assert_eq!(shown.len(), impacts.len());
    let scene = b.scene(&model);
    // On the second partner: the hammer moves down, so that a force on it points up.
    let sign = if scene.contacts[0].between[1] == "hammer" { 1.0 } else { -1.0 };
    for (frame, impact) in shown.iter().zip(impacts) {
        let [force] = frame.contact_forces[..] else { panic!("not one force") };
        assert!(force.impulsive && (frame.time - impact.time).abs() < 1e-6);
        assert!((sign * force.force[1] - impact.impulse).abs() < 1e-12 * impact.impulse);
        assert!((force.position[0] - 1.5).abs() < 1e-9);
    }
    // Before its first impact there is no contact, not even at the start of the impact interval.
    let before = frames.frames.iter().filter(|f| f.time < impacts[0].time);
    assert!(before.clone().count() > 1);
    assert!(before.clone().all(|f| !f.impulsive && f.contact_forces.is_empty()));
}

#[test]
fn the_first_frame_has_the_loads_that_act_at_the_start() {
    let mut b = ModelBuilder::new();
    let girder = clamped(&mut b);
    let kind = || LoadKind::Point {
        at: at("girder.mid", girder, 0.5),
        force: [0.0, -1e3],
        moment: 0.0,
        follower: false,
    };
    b.load(Load::new("dead", kind()));
    b.load(Load { from: 2e-4, ..Load::new("later", kind()) });
    let cosine = TimeFunction::Harmonic { frequency: 50.0, phase: 0.5 * std::f64::consts::PI };
    b.load(Load { function: cosine, ..Load::new("shake", kind()) });
    let mut frames = Frames::default();
    simulate(&b.build().unwrap(), &Settings::new(1e-3, 1e-4), &mut frames).unwrap();
    let first = &frames.frames[0].load_factors;
    assert!(first[0] == 1.0 && first[1] == 0.0 && (first[2] - 1.0).abs() < 1e-6, "{first:?}");
    // Later ones are means over the step before: 50 Hz turn by a hundredth of pi in it.
    let step = 0.01 * std::f64::consts::PI;
    assert!((frames.frames[1].load_factors[2] - step.sin() / step).abs() < 1e-9);
    assert_eq!(frames.frames[3].load_factors[1], 1.0);
}

#[test]
fn the_forces_of_frames_add_up_to_the_impulse_of_the_contact() {
    let mut b = ModelBuilder::new();
    let girder = clamped(&mut b);
    b.projectile(elastic("mass", at("girder.mid", girder, 0.5), [0.0, -20.0]));
    let model = b.build().unwrap();
    let mut frames = Frames { column: "contact.mass.impulse", ..Frames::default() };
    let (h, end) = (1e-4, 0.15);
    simulate(&model, &Settings::new(end, h), &mut frames).unwrap();
    let reported: f64 = frames.rows.iter().sum();
    let forces = frames.frames.iter().flat_map(|f| &f.contact_forces);
    let shown: f64 = forces.map(|c| h * c.force[1].abs()).sum();
    assert!(reported > 1e4 && (shown - reported).abs() < 1e-9 * reported, "{shown}, {reported}");
}

#[test]
fn section_forces_of_frames_are_the_reactions_at_supports() {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let girder = b.beam(beam("girder", [0.0; 2], [3.0, 0.0], 5, material, section));
    b.support(Support::new("root", at("root", girder, 0.0), SupportKind::Clamp));
    let kind = LoadKind::Point {
        at: at("tip", girder, 1.0),
        force: [0.0, -100.0],
        moment: 0.0,
        follower: false,
    };
    b.load(Load::new("push", kind));
    let model = b.build().unwrap();
    let settings = Settings { start: Start::Static, ..Settings::new(1e-3, 1e-3) };
    let mut frames = Frames::default();
    let run = simulate(&model, &settings, &mut frames).unwrap();
    let moment = run.supports[0].moment.max.value;
    let first = &frames.frames[0];
    let [axial, shear, bending] = first.section_forces[0][0];
    assert!((bending.abs() - moment.abs()).abs() < 1e-9 * moment.abs(), "{bending}, {moment}");
    assert!((shear.hypot(axial) - 100.0).abs() < 1e-7, "{axial}, {shear}");
    let tip = first.section_forces[4][1];
    assert!(tip[2].abs() < 1e-7 * moment.abs(), "{tip:?}");
    assert_eq!(first.displacement.len(), model.node_count());
}

#[test]
fn a_scene_says_which_ends_are_round() {
    let mut b = ModelBuilder::new();
    let (material, _) = plank(&mut b);
    let section = b.section(Section::rectangle("bar", 0.1, 0.1));
    let bar = beam("bar", [0.0; 2], [3.0, 0.0], 6, material, section);
    b.beam(Beam { ends: Ends::Round, ..bar });
    let model = b.build().unwrap();
    let beam = &b.scene(&model).beams[0];
    assert_eq!(beam.roundings, [0.05; 2]);
}

#[test]
fn a_scene_says_which_beams_are_shear_flexible() {
    let mut b = ModelBuilder::new();
    let steel = Material { poisson: Some(0.3), ..Material::new("steel", 210e9, 7850.0) };
    let (material, section) = (b.material(steel), b.section(Section::rectangle("bar", 0.1, 0.2)));
    let slender = beam("slender", [0.0; 2], [3.0, 0.0], 6, material, section);
    b.beam(Beam { name: "deep".into(), theory: Theory::Shear, ..slender.clone() });
    b.beam(slender);
    let model = b.build().unwrap();
    let scene = b.scene(&model);
    let found: Vec<_> = scene.beams.iter().map(|b| (b.name.as_str(), b.shear_flexible)).collect();
    assert_eq!(found, [("deep", true), ("slender", false)]);
}

#[test]
fn a_scene_names_what_stands_there_and_the_nodes_that_place_it() {
    let mut b = ModelBuilder::new();
    let girder = clamped(&mut b);
    let ball = b.disc(common::disc("ball", 1.0, 0.1, [1.0, 1.0], [0.0, -1.0]));
    let floor = Obstacle {
        name: "floor".into(),
        shape: ObstacleShape::HalfPlane { point: [0.0, -1.0], normal: [0.0, 2.0] },
        motion: None,
    };
    let floor = b.obstacle(floor);
    let law = TouchLaw::Rigid(RigidLaw::frictionless(0.5));
    let partners = [ContactPartner::Disc(ball), ContactPartner::Obstacle(floor)];
    b.contact(Contact::new("drop", partners, law.clone()));
    b.contact(Contact::new(
        "clap",
        [ContactPartner::Disc(ball), ContactPartner::Beam(girder)],
        law,
    ));
    let model = b.build().unwrap();
    let scene = b.scene(&model);
    assert_eq!(scene.beams[0].stations.len(), 7);
    assert_eq!(scene.bodies.len(), 1); // the ground under the floor is none
    assert_eq!(scene.bodies[0].shape, BodyShape::Disc { radius: 0.1 });
    assert_eq!(scene.nodes.len(), 8);
    assert_eq!(
        scene.obstacles[0].outline,
        ObstacleOutline::HalfPlane { point: [0.0, -1.0], normal: [0.0, 1.0] }
    );
    assert!(scene.supports.iter().all(|s| s.symbol == SupportSymbol::Clamp && !s.moves));
    assert_eq!((scene.supports[1].at.beam, scene.supports[1].at.s), (0, 3.0));
    assert_eq!(scene.beams[0].roundings, [0.0; 2]);
    let last = scene.beams[0].stations[6];
    assert!(last.ends_span && last.element == 5 && (last.inertia - 8.33e-5).abs() < 1e-15);
}

/// Closed form: a plank on two supports under a force inside an element, `M = F a b / L` there and V from `F b / L` to `-F a / L`. The moment
/// of a load along the beam is a parabola, largest in the middle of an element of seven.
#[test]
fn vertices_of_section_forces_go_through_jumps_corners_and_crests() {
    let on_supports = |more: &dyn Fn(&mut ModelBuilder, BeamId)| {
        let mut b = ModelBuilder::new();
        let (material, section) = plank(&mut b);
        let girder = b.beam(beam("girder", [0.0; 2], [2.0, 0.0], 7, material, section));
        b.support(Support::new("left", at("left", girder, 0.0), SupportKind::Pin));
        let level = SupportKind::Roller { direction: [1.0, 0.0] };
        b.support(Support::new("right", at("right", girder, 1.0), level));
        more(&mut b, girder);
        equilibrium(&b.build().unwrap()).unwrap()
    };
    let near =
        |found: f64, known: f64| assert!((found / known - 1.0).abs() < 1e-4, "{found} {known}");
    let force = |b: &mut ModelBuilder, girder: BeamId| {
        let (at, moment, follower) = (at("load", girder, 0.3), 0.0, false);
        b.load(Load::new("f", LoadKind::Point { at, force: [0.0, -1.0], moment, follower }));
    };
    let found = on_supports(&force);
    let here: Vec<&SectionPoint> =
        found.element_points.iter().filter(|p| (p.s - 0.6).abs() < 1e-9).collect();
    let [behind, ahead] = here[..] else { panic!("{here:?}") };
    [(behind, 0.7), (ahead, -0.3)].into_iter().for_each(|(p, shear)| near(p.forces[1], shear));
    [behind, ahead].into_iter().for_each(|p| near(p.forces[2], 0.42));
    let envelope = &found.section_forces[0].envelope;
    assert!(envelope.s.is_sorted());
    let places: Vec<usize> =
        (0..envelope.s.len()).filter(|k| (envelope.s[*k] - 0.6).abs() < 1e-9).collect();
    let [before, after] = places[..] else { panic!("{places:?}") };
    let shears = [(before, 0.7), (after, -0.3)];
    shears.into_iter().for_each(|(k, shear)| near(envelope.shear[0][k], shear));
    [before, after].into_iter().for_each(|k| near(envelope.moment[1][k], 0.42));
    let spread = |b: &mut ModelBuilder, girder: BeamId| {
        let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
        let kind = LoadKind::Distributed {
            beam: girder,
            stretch,
            force: [[0.0, -1.0]; 2],
            follower: false,
        };
        b.load(Load::new("q", kind));
    };
    let found = on_supports(&spread);
    let most = found.element_points.iter().map(|p| p.forces[2]).fold(0.0, f64::max);
    near(most, 0.5);
    let told = found.section_forces[0].moment.largest().value.abs();
    assert!((most / told - 1.0).abs() < 1e-9, "{most} {told}");
}

/// A plank of seven elements struck in the middle of the fourth: what a frame shows is what points record, and nothing is larger than the
/// summary has it.
#[test]
fn the_largest_vertices_of_all_frames_are_the_largest_section_forces_of_the_run() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 210e9, 7850.0));
    let section = b.section(Section::rectangle("plank", 0.2, 0.012));
    let girder = b.beam(beam("girder", [0.0; 2], [2.0, 0.0], 7, material, section));
    b.support(Support::new("left", at("left", girder, 0.0), SupportKind::Pin));
    let level = SupportKind::Roller { direction: [1.0, 0.0] };
    b.support(Support::new("right", at("right", girder, 1.0), level));
    b.projectile(Projectile {
        kind: ProjectileKind::spring(40e3),
        mass: 10.0,
        standoff: 0.05,
        ..elastic("bag", at("mid", girder, 0.5), [0.0, -5.0])
    });
    b.record_point(at("aside", girder, 0.41));
    let model = b.build().unwrap();
    let mut frames = Frames { column: "section.aside.moment", ..Frames::default() };
    let run = simulate(&model, &Settings::new(0.07, 2e-4), &mut frames).unwrap();
    let beam = &run.section_forces[0];
    let largest = |i: usize| {
        let all = frames.frames.iter().flat_map(|f| &f.section_points);
        all.map(|p| p.forces[i].abs()).fold(0.0, f64::max)
    };
    for (i, range) in [&beam.axial, &beam.shear, &beam.moment].into_iter().enumerate() {
        let known = range.largest().value.abs();
        assert!((largest(i) / known - 1.0).abs() < 1e-9, "{i}: {} {known}", largest(i));
    }
    let size = beam.moment.largest().value.abs();
    for (frame, recorded) in frames.frames.iter().zip(&frames.rows) {
        let after = frame.section_points.iter().position(|p| p.s > 0.82).unwrap();
        let [a, b] = [&frame.section_points[after - 1], &frame.section_points[after]];
        let shown = a.forces[2] + (0.82 - a.s) / (b.s - a.s) * (b.forces[2] - a.forces[2]);
        assert!((shown - recorded).abs() < 0.01 * size, "{}: {shown} {recorded}", frame.time);
    }
}
