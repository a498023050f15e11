//! Equilibria of structures whose members may be slack: ropes, stays.

use crate::common;

use common::*;
use percuss::*;

const YOUNG: f64 = 100e9;
const DENSITY: f64 = 7850.0;
const GRAVITY: f64 = 9.81;

/// A tension-only material.
fn rope(b: &mut ModelBuilder, density: f64) -> MaterialId {
    b.material(Material {
        strain: StrainMeasure::Engineering,
        inelasticity: Some(Inelasticity::OneSided(Slack::Compression)),
        ..Material::new("rope", YOUNG, density)
    })
}

fn weigh(b: &mut ModelBuilder) {
    b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, -GRAVITY] }));
}

/// A rope of 100 mm^2 between two pins 10 m apart, through the points given, under its weight.
fn hung(points: &[[f64; 2]], depth: f64, elements: usize) -> Model {
    let mut b = ModelBuilder::new();
    let material = rope(&mut b, DENSITY);
    let section = b.section(Section::rectangle("strand", 1e-4 / depth, depth));
    let curve = if points.len() > 2 { Curve::Spline } else { Curve::Polyline };
    let rope = b.beam(Beam { curve, ..Beam::new("rope", points, elements, material, section) });
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, rope, f), SupportKind::Pin));
    }
    weigh(&mut b);
    b.record_point(at("mid", rope, 0.5));
    b.build().unwrap()
}

fn sum(found: &Equilibrium) -> [f64; 2] {
    let add = |k: usize| found.reactions.iter().map(|(_, r)| r[k]).sum::<f64>();
    [add(0), add(1)]
}

/// Horizontal force of the elastic catenary of the free length l between supports at one height: the root of
/// `H l / EA + 2 H / w asinh(w l / (2 H)) = span`.
fn catenary(length: f64, span: f64) -> f64 {
    let (w, stiffness) = (DENSITY * 1e-4 * GRAVITY, YOUNG * 1e-4);
    let reach = |h: f64| h * length / stiffness + 2.0 * h / w * (0.5 * w * length / h).asinh();
    let (mut low, mut high) = (1e-3, 1e6);
    for _ in 0..200 {
        let middle: f64 = f64::sqrt(low * high);
        if reach(middle) < span { low = middle } else { high = middle }
    }
    low
}

#[test]
fn a_rope_under_its_weight_hangs_as_its_catenary() {
    // Straight and free of stress, of a square section, whose stiffness in bending shortens its sag, and of a strand.
    for (depth, tolerance) in [(0.01, 5e-3), (0.001, 2e-4)] {
        let model = hung(&[[0.0, 0.0], [10.0, 0.0]], depth, 20);
        let found = equilibrium(&model).unwrap();
        let expected = catenary(10.0, 10.0);
        assert!((expected - 1352.0).abs() < 1.0, "{expected}");
        let pull = found.reactions[1].1[0];
        assert!((pull / expected - 1.0).abs() < tolerance, "{depth}: {pull} {expected}");
        let weight = DENSITY * 1e-4 * GRAVITY * 10.0;
        let [along, up] = sum(&found);
        assert!(along.abs() < 1e-9 * expected && (up / weight - 1.0).abs() < 1e-9, "{up}");
        assert!(found.stable, "{depth}");
    }
}

#[test]
fn a_sagging_rope_finds_its_catenary() {
    let points = [[0.0, 0.0], [2.5, -0.9], [5.0, -1.2], [7.5, -0.9], [10.0, 0.0]];
    let model = hung(&points, 0.001, 24);
    let length: f64 = model.beam_elements("rope").map(|e| e.1).sum();
    let found = equilibrium(&model).unwrap();
    let (pull, expected) = (found.reactions[1].1[0], catenary(length, 10.0));
    assert!((pull / expected - 1.0).abs() < 2e-3, "{pull} {expected}");
    let weight = DENSITY * 1e-4 * GRAVITY * length;
    // The unbalanced force is about 3e-8 of the weight: strains of slack fibres round at the size of slopes.
    let up = sum(&found)[1];
    assert!((up / weight - 1.0).abs() < 1e-7, "{up} {weight}");
}

/// A mast on a pin between two stays under 45 degrees, with a force of 1 kN at its top: one stay carries `F / cos 45`, the other is slack.
fn mast(density: f64) -> Model {
    let mut b = ModelBuilder::new();
    let steel = b.material(Material {
        strain: StrainMeasure::Engineering,
        ..Material::new("steel", 210e9, DENSITY)
    });
    let wire = rope(&mut b, density);
    let tube = b.section(Section::tube("tube", 0.2, 0.01));
    let strand = b.section(Section::circle("strand", 0.01));
    let mast = b.beam(beam("mast", [0.0, 0.0], [0.0, 10.0], 4, steel, tube));
    b.support(Support::new("foot", at("foot", mast, 0.0), SupportKind::Pin));
    for (name, x) in [("windward", -10.0), ("leeward", 10.0)] {
        let stay = b.beam(beam(name, [x, 0.0], [0.0, 10.0], 8, wire, strand));
        let anchor = format!("{name}.anchor");
        b.support(Support::new(anchor.clone(), at(&anchor, stay, 0.0), SupportKind::Pin));
        let between = [at("top", mast, 1.0), at(name, stay, 1.0)];
        b.joint(Joint::new(format!("{name}.top"), JointKind::Hinge, between));
    }
    let kind = LoadKind::Point {
        at: at("top", mast, 1.0),
        force: [1000.0, 0.0],
        moment: 0.0,
        follower: false,
    };
    b.load(Load::new("wind", kind));
    if density > 0.0 {
        weigh(&mut b);
    }
    b.record_point(at("top", mast, 1.0));
    b.build().unwrap()
}

#[test]
fn the_leeward_stay_of_a_mast_goes_slack() {
    for density in [0.0, DENSITY] {
        let model = mast(density);
        let found = equilibrium(&model).unwrap();
        let force = |name: &str| {
            let of = found.reactions.iter().find(|(n, _)| n == name).unwrap();
            of.1
        };
        let [windward, leeward] = ["windward.anchor", "leeward.anchor"].map(force);
        let weight = if density > 0.0 {
            let tube = std::f64::consts::PI * (0.1_f64.powi(2) - 0.09_f64.powi(2)) * 10.0;
            let stays = std::f64::consts::PI * 25e-6 * 2.0 * 200_f64.sqrt();
            GRAVITY * DENSITY * (tube + stays)
        } else {
            0.0
        };
        let [along, up] = sum(&found);
        assert!((along + 1000.0).abs() < 1e-6, "{density}: {along}");
        assert!((up - weight).abs() < 1e-6, "{density}: {up} {weight}");
        let slack = slack_members(&model, &found.state);
        if density == 0.0 {
            let [leeward_stay] = slack.as_slice() else { panic!("{slack:?}") };
            assert_eq!(leeward_stay.beam, "leeward");
            // Without weight it lies anywhere: at least some of its elements are shorter than they were.
            assert!(leeward_stay.slack > 0.0, "{slack:?}");
            assert!((windward[0] + 1000.0).abs() < 1.0, "{windward:?}");
            assert!(leeward[0].abs() < 1e-6 && leeward[1].abs() < 1e-6, "{leeward:?}");
        } else {
            // It is in tension under its weight.
            assert!(-windward[0] > 3.0 * leeward[0].abs(), "{windward:?} {leeward:?}");
        }
    }
}

#[test]
fn a_run_that_starts_at_rest_with_a_hanging_rope_stays_at_rest() {
    let model = hung(&[[0.0, 0.0], [10.0, 0.0]], 0.001, 16);
    let settings = Settings { start: Start::Static, ..Settings::new(0.05, 1e-3) };
    let mut rows = MemoryRecorder::default();
    let summary = simulate(&model, &settings, &mut rows).unwrap();
    assert!(matches!(summary.termination, Termination::Completed), "{summary:?}");
    let velocity = rows.column("point.mid.velocity_2").unwrap();
    assert!(velocity.iter().all(|v| v.abs() < 1e-8), "{velocity:?}");
}
