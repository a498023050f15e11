//! Equilibrium paths along which rigid contacts close and open.

use crate::common;

use common::*;
use percuss::*;

const GRAVITY: f64 = 9.81;
const BENDING: f64 = 2.1e11 * 0.01 * 8e-9 / 12.0;
/// Weight of the strip per length [N/m].
const WEIGHT: f64 = 7850.0 * 2e-5 * GRAVITY;

fn rigid() -> TouchLaw {
    TouchLaw::Rigid(RigidLaw::frictionless(0.0))
}

fn floor(b: &mut ModelBuilder, beams: &[BeamId], height: f64, law: TouchLaw) {
    let shape = ObstacleShape::HalfPlane { point: [0.0, height], normal: [0.0, 1.0] };
    let obstacle = b.obstacle(Obstacle { name: "floor".into(), shape, motion: None });
    for (i, beam) in beams.iter().enumerate() {
        let between = [ContactPartner::Beam(*beam), ContactPartner::Obstacle(obstacle)];
        b.contact(Contact::new(format!("on_floor{i}"), between, law.clone()));
    }
}

/// A clamped steel strip of 10 x 2 mm, 2 m long, under a share of its weight, over a floor.
fn strip(elements: usize, gap: f64, share: f64) -> Model {
    strip_on(elements, gap, share, rigid())
}

fn strip_on(elements: usize, gap: f64, share: f64, law: TouchLaw) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = Section { depth: Some(2e-3), ..Section::new("strip", 2e-5, 0.01 * 8e-9 / 12.0) };
    let section = b.section(section);
    b.load(Load::new("g", LoadKind::Gravity { acceleration: [0.0, -share * GRAVITY] }));
    let beam = b.beam(beam("strip", [0.0, 0.0], [2.0, 0.0], elements, material, section));
    b.record_point(at("tip", beam, 1.0));
    b.support(Support::new("root", at("root", beam, 0.0), SupportKind::Clamp));
    floor(&mut b, &[beam], -gap - 1e-3, law);
    b.build().unwrap()
}

fn root(found: &Equilibrium) -> [f64; 3] {
    found.reactions.iter().find(|(n, _)| n == "root").unwrap().1
}

#[test]
fn a_strip_lies_down_as_its_load_grows() {
    for (elements, gap, first) in
        [(20, 2e-3, 0.1), (100, 2e-3, 0.1), (100, 2e-3, 0.01), (60, 1e-2, 0.1), (100, 0.1, 0.1)]
    {
        for factor in [0.3, 1.0, 2.0] {
            let case = format!("{elements} elements, {gap} m, {first}, {factor}");
            let end = PathEnd::Factor(factor);
            let settings = PathSettings { first, points: 200, end };
            let path = equilibrium_path(&strip(elements, gap, 1.0), &settings)
                .unwrap_or_else(|e| panic!("{case}: {e}"));
            assert!(
                path.reached && path.limit_points.is_empty(),
                "{case}: {:?} {:?}",
                path.points.len(),
                path.limit_points
            );
            let direct = equilibrium(&strip(elements, gap, factor)).unwrap();
            let (along, at_once) = (root(&path.end), root(&direct));
            let (a, b) = (path.end.contacts[0].force, direct.contacts[0].force);
            assert!((a - b).abs() < 1e-8 * b, "{case}: {a} for {b}");
            for k in 1..3 {
                let relative = (along[k] - at_once[k]).abs() / at_once[k].abs();
                assert!(relative < 1e-8, "{case}: {along:?} for {at_once:?}");
            }
            // Points near enough for a curve: no rise of the load is more than one and a half times the one before.
            let rises: Vec<f64> =
                path.points.windows(2).map(|p| p[1].factor - p[0].factor).collect();
            let even = rises.windows(2).all(|r| r[1] > 0.0 && r[1] < 1.51 * r[0].max(first));
            assert!(even || gap > 0.05, "{case}: {rises:?}");
        }
        if gap > 0.05 {
            continue;
        }
        // Linear beam that touches at a without slope and moment: h = q a^4 / 72 EI; the clamp carries 2/3 q a.
        let settings = PathSettings { first, points: 200, end: PathEnd::Factor(2.0) };
        let path = equilibrium_path(&strip(elements, gap, 1.0), &settings).unwrap();
        let q = 2.0 * WEIGHT;
        let free = (72.0 * BENDING * gap / q).powf(0.25);
        let (force, up) = (2.0 / 3.0 * q * free, root(&path.end)[1]);
        let slack = 0.25 * q / elements as f64 + (gap / free).powi(2) * force;
        assert!((up - force).abs() < slack, "{elements} {gap}: {up} for {force}");
    }
}

/// A shallow toggle of two bars under a unit force, over a floor.
fn toggle_over(rise: f64, area: f64, height: f64, law: TouchLaw) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("stuff", 1e9, 1e3));
    // Stiff enough not to buckle.
    let section = b.section(Section::new("bar", area, 1e-5));
    let left = b.beam(beam("left", [-1.0, 0.0], [0.0, rise], 2, material, section));
    let right = b.beam(beam("right", [0.0, rise], [1.0, 0.0], 2, material, section));
    b.support(Support::new("a", at("a", left, 0.0), SupportKind::Pin));
    b.support(Support::new("b", at("b", right, 1.0), SupportKind::Pin));
    let between = [at("top", left, 1.0), at("top", right, 0.0)];
    b.joint(Joint::new("top", JointKind::Hinge, between));
    b.record_point(at("top", left, 1.0));
    let force = [0.0, -1.0];
    let at = at("top", left, 1.0);
    b.load(Load::new("push", LoadKind::Point { at, force, moment: 0.0, follower: false }));
    floor(&mut b, &[left, right], height, law);
    b.build().unwrap()
}

#[test]
fn a_strip_lies_down_on_a_compliant_floor() {
    for (stiffness, factor) in [(1e3, 1.0), (1e4, 2.0), (1e6, 2.0)] {
        let law = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness }));
        let model = |share: f64| strip_on(60, 2e-3, share, law.clone());
        let settings = PathSettings { first: 0.1, points: 200, end: PathEnd::Factor(factor) };
        let path = equilibrium_path(&model(1.0), &settings).unwrap();
        let last = path.points.last();
        assert!(path.reached && path.limit_points.is_empty(), "{stiffness}: {last:?}");
        let direct = equilibrium(&model(factor)).unwrap();
        let [a, b] = [&path.end, &direct].map(|e| (root(e)[1], e.contacts[0].force));
        assert!((a.0 / b.0 - 1.0).abs() < 1e-7 && (a.1 / b.1 - 1.0).abs() < 1e-7, "{a:?} {b:?}");
    }
}

#[test]
fn a_toggle_snaps_onto_a_floor_and_presses_on_it() {
    for (rise, at) in [(0.05, -0.03), (0.05, -0.048), (0.1, -0.02), (0.02, -0.012)] {
        let area = 1e-4;
        // Bars in Green strain: P = EA (rise^2 - h^2) h / l0^3.
        let l0 = 1.0_f64.hypot(rise);
        let load = |h: f64| 1e9 * area * (rise * rise - h * h) * h / l0.powi(3);
        let most = load(rise / 3.0_f64.sqrt());
        let end = PathEnd::Factor(1.5 * most);
        let settings = PathSettings { first: 0.02 * most, points: 2000, end };
        let path = equilibrium_path(&toggle_over(rise, area, at, rigid()), &settings).unwrap();
        assert!(path.reached, "{rise} {at}: {:?}", path.points.last());
        let turns: Vec<f64> = path.limit_points.iter().map(|p| p.factor).collect();
        // It comes down to its own limit point, or to the floor before that.
        let lowest = load(at.max(-rise / 3.0_f64.sqrt()));
        let [up, down] = turns[..] else { panic!("{rise} {at}: {turns:?}") };
        assert!((up / most - 1.0).abs() < 1e-6, "{rise} {at}: {up} for {most}");
        assert!((down / lowest - 1.0).abs() < 1e-6, "{rise} {at}: {down} for {lowest}");
        let pressed: f64 = path.end.contacts.iter().map(|c| c.force).sum();
        let asked = 1.5 * most - load(at);
        assert!((pressed / asked - 1.0).abs() < 1e-8, "{rise} {at}: {pressed} for {asked}");
        // On a stiff spring the same, but for how far that gives way.
        let spring = TouchLaw::Smooth(SmoothLaw::elastic(Potential::Linear { stiffness: 1e7 }));
        let path = equilibrium_path(&toggle_over(rise, area, at, spring), &settings).unwrap();
        assert!(path.reached, "{rise} {at}: {:?}", path.points.last());
        let down = path.limit_points[1].factor;
        assert!((down / lowest - 1.0).abs() < 1e-3, "{rise} {at}: {down} for {lowest}");
        let springs: f64 = path.end.contacts.iter().map(|c| c.force).sum();
        assert!((springs / asked - 1.0).abs() < 1e-2, "{rise} {at}: {springs} for {asked}");
    }
}

#[test]
fn a_strip_pressed_down_by_a_spring_lifts_off() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material::new("steel", 2.1e11, 7850.0));
    let section = Section { depth: Some(2e-3), ..Section::new("strip", 2e-5, 0.01 * 8e-9 / 12.0) };
    let section = b.section(section);
    let bar = b.beam(beam("strip", [0.0, 0.0], [1.0, 0.0], 20, material, section));
    b.support(Support::new("root", at("root", bar, 0.0), SupportKind::Clamp));
    b.record_point(at("tip", bar, 1.0));
    floor(&mut b, &[bar], -1e-3, rigid());
    // Pulls the tip down by 5 N where it lies.
    let between = [Anchor::Point(at("tip", bar, 1.0)), Anchor::Ground([1.0, -1.0])];
    let name = "stay".into();
    b.spring(Spring {
        name,
        between,
        law: SpringLaw::Linear { stiffness: 100.0 },
        damping: 0.0,
        length: Some(0.95),
        strength: None,
        yielding: None,
    });
    let (at, force) = (at("tip", bar, 1.0), [0.0, 8.0]);
    b.load(Load::new("lift", LoadKind::Point { at, force, moment: 0.0, follower: false }));
    let model = b.build().unwrap();
    let settings = PathSettings { first: 0.05, points: 200, end: PathEnd::Factor(1.0) };
    let path = equilibrium_path(&model, &settings).unwrap();
    assert!(path.reached, "{} {:?}", path.points.len(), path.points.last());
    for p in &path.points {
        let up = p.displacements[0][1];
        // It is released at 5 N, and from there the spring and the strip deform.
        let exact = (8.0 * p.factor - 5.0).max(0.0) / (100.0 + 3.0 * BENDING);
        assert!((up - exact).abs() < 1e-2 * exact.max(1e-9), "{}: {up} for {exact}", p.factor);
    }
}
