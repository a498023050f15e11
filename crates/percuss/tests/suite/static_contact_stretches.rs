//! Rigid contact at rest over long stretches, and of beams that nothing but contact holds.

use crate::common;

use common::*;
use percuss::*;

const GRAVITY: f64 = 9.81;
const LENGTH: f64 = 2.0;
const BENDING: f64 = 2.1e11 * 0.01 * 8e-9 / 12.0;
/// Weight of the strip per length [N/m].
const WEIGHT: f64 = 7850.0 * 2e-5 * GRAVITY;

fn rigid() -> TouchLaw {
    TouchLaw::Rigid(RigidLaw::frictionless(0.0))
}

/// A steel strip of 10 x 2 mm on the x axis, 2 m long, bent about its small side, that can lie down on what is added.
fn strip(b: &mut ModelBuilder, elements: usize) -> BeamId {
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = Section { depth: Some(2e-3), ..Section::new("strip", 2e-5, 0.01 * 8e-9 / 12.0) };
    let section = b.section(section);
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -GRAVITY] }));
    b.beam(beam("strip", [0.0, 0.0], [LENGTH, 0.0], elements, material, section))
}

fn lies_on(b: &mut ModelBuilder, beam: BeamId, name: &str, shape: ObstacleShape) {
    let obstacle = b.obstacle(Obstacle { name: name.into(), shape, motion: None });
    let between = [ContactPartner::Beam(beam), ContactPartner::Obstacle(obstacle)];
    b.contact(Contact::new(format!("on_{name}"), between, rigid()));
}

fn floor(gap: f64) -> ObstacleShape {
    ObstacleShape::HalfPlane { point: [0.0, -gap - 1e-3], normal: [0.0, 1.0] }
}

fn reaction(found: &Equilibrium, name: &str) -> [f64; 3] {
    found.reactions.iter().find(|(n, _)| n == name).unwrap().1
}

#[test]
fn a_strip_lies_on_a_floor_over_most_of_its_length() {
    for (gap, elements) in [
        (1e-3, 20),
        (1e-3, 100),
        (1e-3, 400),
        (2e-3, 20),
        (2e-3, 37),
        (2e-3, 100),
        (2e-3, 250),
        (2e-3, 400),
        (5e-3, 60),
        (5e-3, 150),
        (1e-2, 33),
        (1e-2, 200),
    ] {
        let mut b = ModelBuilder::new();
        let beam = strip(&mut b, elements);
        b.support(Support::new("root", at("root", beam, 0.0), SupportKind::Clamp));
        lies_on(&mut b, beam, "floor", floor(gap));
        let found =
            equilibrium(&b.build().unwrap()).unwrap_or_else(|e| panic!("{gap} {elements}: {e}"));
        // Linear beam that touches at a without slope and moment: h = w a^4 / 72 EI; the clamp carries 2/3 w a.
        let free = (72.0 * BENDING * gap / WEIGHT).powf(0.25);
        let (force, moment) = (2.0 / 3.0 * WEIGHT * free, WEIGHT * free * free / 6.0);
        let [_, up, turn] = reaction(&found, "root");
        let contact = &found.contacts[0];
        // It touches at candidates alone, two in an element: half of their distance moves the force by half of its weight. Inclined by
        // some h / a it differs from a linear beam by the square of that.
        let apart = LENGTH / (2 * elements) as f64;
        let slack = 0.25 * WEIGHT * apart + (gap / free).powi(2) * force;
        assert!((up - force).abs() < slack, "{gap} {elements}: {up} for {force}");
        assert!((turn - moment).abs() < slack * free, "{gap} {elements}: {turn} for {moment}");
        assert!((contact.s[0] - free).abs() <= 1.01 * apart, "{contact:?} for {free}");
        assert!(contact.gap.abs() < 1e-13 && found.stable);
        // To the round-off of elements that are EA / l = 1e9 N/m stiff.
        let sum = up + contact.force - WEIGHT * LENGTH;
        assert!(sum.abs() < 1e-9, "{gap} {elements}: {sum}");
    }
}

#[test]
fn forces_of_rigid_contacts_do_not_depend_on_the_way_to_them() {
    let model = |elements| {
        let mut b = ModelBuilder::new();
        let beam = strip(&mut b, elements);
        b.support(Support::new("root", at("root", beam, 0.0), SupportKind::Clamp));
        lies_on(&mut b, beam, "floor", floor(0.02));
        b.build().unwrap()
    };
    for elements in [40, 160] {
        let model = model(elements);
        let [a, b] = [0.1, 1.0].map(|step| equilibrium_in(&model, step).unwrap());
        let [fa, fb] = [&a, &b].map(|e| e.contacts[0].force);
        assert!((fa - fb).abs() < 1e-10 * fa, "{fa} {fb}");
        let [ca, cb] = [&a, &b].map(|e| e.contacts[0].centre);
        assert!((ca - cb).abs() < 1e-7, "{ca} {cb}");
    }
}

#[test]
fn the_moment_is_largest_at_a_contact_inside_an_element() {
    // A cantilever over a stop at a, gap none, with a force at its tip: M = -P (L - a) there, F = P (3 L / a - 1) / 2.
    for place in [0.53, 0.512, 0.575] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, 7850.0));
        let section =
            b.section(Section { depth: Some(0.01), ..Section::new("bar", 1e-4, 1e-8 / 12.0) });
        let bar = b.beam(beam("bar", [0.0, 0.0], [1.0, 0.0], 10, material, section));
        b.support(Support::new("root", at("root", bar, 0.0), SupportKind::Clamp));
        let kind = LoadKind::Point {
            at: at("tip", bar, 1.0),
            force: [0.0, -0.1],
            moment: 0.0,
            follower: false,
        };
        b.load(Load::new("push", kind));
        lies_on(&mut b, bar, "stop", ObstacleShape::Disc { centre: [place, -0.015], radius: 0.01 });
        let found = equilibrium(&b.build().unwrap()).unwrap();
        let contact = &found.contacts[0];
        let force = 0.1 * (3.0 / place - 1.0) / 2.0;
        // Cubics meet the deflection of a force inside an element to some l^3 / 192 L^3.
        assert!((contact.force / force - 1.0).abs() < 2e-3, "{contact:?} for {force}");
        let forces = &found.section_forces[0];
        let (moment, exact) = (forces.moment.min, -0.1 * (1.0 - place));
        assert!((moment.value / exact - 1.0).abs() < 1e-5, "{moment:?} for {exact}");
        assert!((moment.s - place).abs() < 1e-5, "{moment:?}");
    }
}

#[test]
fn a_free_strip_rests_on_a_floor() {
    for (gap, elements) in [(0.0, 30), (1e-3, 30), (0.05, 100)] {
        let mut b = ModelBuilder::new();
        let beam = strip(&mut b, elements);
        lies_on(&mut b, beam, "floor", floor(gap));
        let model = b.build().unwrap();
        assert_eq!(mechanisms(&model), []);
        let found = equilibrium(&model).unwrap_or_else(|e| panic!("{gap} {elements}: {e}"));
        let contact = &found.contacts[0];
        assert!((contact.force - WEIGHT * LENGTH).abs() < 1e-9, "{contact:?}");
        assert!((contact.centre - 0.5 * LENGTH).abs() < 1e-6, "{contact:?}");
        assert!(contact.gap.abs() < 1e-13 && found.stable, "{contact:?}");
        assert_eq!(found.sliding, ["strip"]);
    }
}

#[test]
fn a_bar_stands_on_its_end_until_its_weight_is_beside_it() {
    for (lean, stands) in [(1e-4, true), (1e-3, true), (0.015, true), (0.03, false)] {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("steel", 2.1e11, 7850.0));
        let section =
            Section { depth: Some(0.02), ..Section::new("bar", 2e-4, 0.01 * 8e-6 / 12.0) };
        let section = b.section(section);
        b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -GRAVITY] }));
        let bar = Beam {
            ends: Ends::Flat,
            ..beam("bar", [0.0, 0.0105], [lean, 0.5105], 10, material, section)
        };
        let bar = b.beam(bar);
        let ground = ObstacleShape::HalfPlane { point: [0.0, 0.0], normal: [0.0, 1.0] };
        lies_on(&mut b, bar, "ground", ground);
        b.record_point(at("top", bar, 1.0));
        let found = equilibrium(&b.build().unwrap()).unwrap_or_else(|e| panic!("{lean}: {e}"));
        let weight = 7850.0 * 2e-4 * lean.hypot(0.5) * GRAVITY;
        assert!((found.contacts[0].force / weight - 1.0).abs() < 1e-9, "{:?}", found.contacts);
        assert_eq!(found.stable, stands, "{lean}");
        if stands {
            // Upright, and free to slide.
            assert!((found.points[0].1[0] + lean).abs() < 1e-6, "{lean}: {:?}", found.points);
            assert_eq!(found.sliding, ["bar"], "{lean}");
        }
    }
}

#[test]
fn a_free_strip_slides_on_two_stones_to_where_each_carries_half() {
    // Near its ends it sags into a valley, wherever it is put down. Further in its ends droop, and what slides goes on sliding.
    for (left, right, stays) in [(0.15, 1.85, true), (0.12, 1.8, true), (0.5, 1.5, false)] {
        let mut b = ModelBuilder::new();
        let beam = strip(&mut b, 40);
        for (name, x) in [("left", left), ("right", right)] {
            lies_on(&mut b, beam, name, ObstacleShape::Disc { centre: [x, -0.02], radius: 0.01 });
        }
        let found = equilibrium(&b.build().unwrap()).unwrap_or_else(|e| panic!("{left}: {e}"));
        let exact = 0.5 * WEIGHT * LENGTH;
        for contact in &found.contacts {
            let up = contact.resultant[1];
            // Contacts with discs slide from element to element; cubics differ across them by their fourth order.
            assert!((up / exact - 1.0).abs() < 1e-5, "{left} {right}: {contact:?}");
        }
        assert_eq!(found.stable, stays, "{left} {right}");
        assert!(found.sliding.is_empty(), "{left} {right}: a slope either way holds it");
    }
}

#[test]
fn closed_contacts_hold_what_buckles_and_what_vibrates() {
    // A pinned column with a stop at mid-height, pushed onto it by a force, at a tenth of its buckling load:
    // Euler's column of half the length, 4 pi^2 EI / L^2; its second mode of vibration is the lowest.
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = Section { depth: Some(0.01), ..Section::new("bar", 1e-4, 1e-8 / 12.0) };
    let section = b.section(section);
    let column = b.beam(beam("column", [0.0, 0.0], [0.0, 1.0], 20, material, section));
    b.support(Support::new("foot", at("foot", column, 0.0), SupportKind::Pin));
    let roller = SupportKind::Roller { direction: [0.0, 1.0] };
    b.support(Support::new("head", at("head", column, 1.0), roller));
    let bending = 2.1e11 * 1e-8 / 12.0;
    let load = 0.1 * std::f64::consts::PI.powi(2) * bending;
    let point =
        |at: PointRef, force: [f64; 2]| LoadKind::Point { at, force, moment: 0.0, follower: false };
    b.load(Load::new("down", point(at("head", column, 1.0), [0.0, -load])));
    b.load(Load::new("aside", point(at("mid", column, 0.5), [1.0, 0.0])));
    lies_on(&mut b, column, "stop", ObstacleShape::Disc { centre: [0.015, 0.5], radius: 0.01 });
    let model = b.build().unwrap();
    let found = equilibrium(&model).unwrap();
    let contact = &found.contacts[0];
    assert!((contact.force - 1.0).abs() < 1e-6, "{contact:?}");
    let [alone, held] =
        [buckling(&model, 1), buckling_in_contact(&model, &found, 1)].map(|b| b.modes[0].factor);
    // Membrane strains of the column shorten it by the strain under the load.
    assert!(
        (alone / 10.0 - 1.0).abs() < 2e-3 && (held / 40.0 - 1.0).abs() < 2e-3,
        "{alone} {held}"
    );
    let mode = modes_about_equilibrium(&model, &found, 1)[0].frequency();
    // Of a pinned beam of half the length under its share of the load.
    let k = 2.0 * std::f64::consts::PI;
    let exact = (k.powi(4) * bending / (7850.0 * 1e-4) * (1.0 - load / (k * k * bending))).sqrt();
    let exact = exact / std::f64::consts::TAU;
    // Rotary inertia: (k r)^2 / 2.
    assert!((mode / exact - 1.0).abs() < 5e-4, "{mode} for {exact}");
}

#[test]
fn a_beam_that_nothing_holds_is_named() {
    // Above nothing: there is no contact that could hold it.
    let mut b = ModelBuilder::new();
    strip(&mut b, 10);
    let faults = mechanisms(&b.build().unwrap());
    assert!(faults[0].to_string().contains("`strip`"), "{faults:?}");
    // Pushed along a floor.
    let mut b = ModelBuilder::new();
    let beam = strip(&mut b, 10);
    lies_on(&mut b, beam, "floor", floor(0.0));
    let (at, force) = (at("start", beam, 0.0), [0.1, 0.0]);
    b.load(Load::new("push", LoadKind::Point { at, force, moment: 0.0, follower: false }));
    let text = equilibrium(&b.build().unwrap()).unwrap_err().to_string();
    assert!(text.contains("`strip` is not supported"), "{text}");
    // Beside a floor.
    let mut b = ModelBuilder::new();
    let beam = strip(&mut b, 10);
    let shape = ObstacleShape::HalfPlane { point: [0.0, 1.0], normal: [0.0, -1.0] };
    lies_on(&mut b, beam, "ceiling", shape);
    let text = equilibrium(&b.build().unwrap()).unwrap_err().to_string();
    assert!(text.contains("`strip` is not supported"), "{text}");
}
