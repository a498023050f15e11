//! Failure under growing static loads: at the load factor of full strength, with or without an equilibrium of the rest.

use crate::common;

use common::*;
use percuss::*;

const YOUNG: f64 = 205e9;
const YIELD: f64 = 275e6;
const SIDE: f64 = 0.04;

fn bar(b: &mut ModelBuilder, inelasticity: Option<Plasticity>, elements: usize) -> BeamId {
    let material = b.material(Material {
        strain: StrainMeasure::Engineering,
        inelasticity: inelasticity.map(Inelasticity::Plastic),
        ..Material::new("steel", YOUNG, 7850.0)
    });
    let section = b.section(Section::rectangle("square", SIDE, SIDE));
    let bar = b.beam(beam("g", [0.0, 0.0], [1.0, 0.0], elements, material, section));
    b.support(Support::new("wall", at("root", bar, 0.0), SupportKind::Clamp));
    b.record_point(at("tip", bar, 1.0));
    bar
}

fn pull(b: &mut ModelBuilder, bar: BeamId, force: [f64; 2]) {
    let at = at("tip", bar, 1.0);
    let kind = LoadKind::Point { at, force, moment: 0.0, follower: false };
    b.load(Load::new("f", kind));
}

fn law(limit: f64, modulus: f64, failure_strain: Option<f64>) -> Plasticity {
    let curve = vec![Hardening { from: 0.0, stress: limit, modulus }];
    Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain }
}

/// A cantilever that a spring above its tip helps, which flows at 3 kN and fails at an extension, if at any.
fn helped(force: f64, fails_at: Option<f64>) -> Model {
    let mut b = ModelBuilder::new();
    let g = bar(&mut b, None, 8);
    b.spring(Spring {
        name: "k".into(),
        between: [Anchor::Point(at("tip", g, 1.0)), Anchor::Ground([1.0, 0.4])],
        law: SpringLaw::Linear { stiffness: 1e6 },
        damping: 0.0,
        length: None,
        strength: None,
        yielding: Some(law(3e3, 0.0, fails_at)),
    });
    pull(&mut b, g, [0.0, -force]);
    b.build().unwrap()
}

fn assert_in_balance(found: &Equilibrium, load: [f64; 2]) {
    let StaticBalance { loads, reactions, springs, unbalanced, .. } = found.balance;
    let size = load[0].abs().max(load[1].abs());
    for i in 0..2 {
        assert_eq!(loads[i], load[i]);
        let reported: f64 = found.reactions.iter().map(|(_, r)| r[i]).sum();
        assert!((reported - reactions[i]).abs() <= 1e-12 * size, "{reported} {reactions:?}");
        assert!((loads[i] + reported + springs[i]).abs() < 1e-10 * size, "{:?}", found.balance);
        assert!(unbalanced[i].abs() < 1e-10 * size);
    }
}

#[test]
fn a_pulled_bar_parts_where_its_law_says_and_carries_nothing_beyond() {
    let (failure, modulus, load) = (0.01, 1e9, 464e3);
    let mut b = ModelBuilder::new();
    let g = bar(&mut b, Some(law(YIELD, modulus, Some(failure))), 4);
    pull(&mut b, g, [load, 0.0]);
    let error = equilibrium(&b.build().unwrap()).unwrap_err();
    // On the tension curve the failure strain is reached at this stress.
    let tangent = YOUNG * modulus / (YOUNG + modulus);
    let most = SIDE * SIDE * (YIELD + tangent * (failure - YIELD / YOUNG));
    assert_eq!(error.code(), AnalysisCode::NothingLeft);
    let reported = error.to_string();
    assert!(reported.contains(&format!("at load factor {:.6}", most / load)), "{reported}");
    assert!(reported.contains("`beam.g` fractures at s = "), "{reported}");
    // Short of it the bar holds.
    let mut b = ModelBuilder::new();
    let g = bar(&mut b, Some(law(YIELD, modulus, Some(failure))), 4);
    pull(&mut b, g, [0.9999 * most, 0.0]);
    let found = equilibrium(&b.build().unwrap()).unwrap();
    assert!(found.failures.is_empty() && found.stable);
    assert_in_balance(&found, [0.9999 * most, 0.0]);
}

#[test]
fn a_spring_that_fails_leaves_the_load_to_the_rest() {
    let (load, extension) = (1e4, 0.05);
    let found = equilibrium(&helped(load, Some(extension))).unwrap();
    // The load at which a spring that never fails is as long.
    let reach = |force: f64| equilibrium(&helped(force, None)).unwrap().yielding[0].extension;
    let (mut low, mut high) = (0.0, load);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if reach(middle) < extension { low = middle } else { high = middle }
    }
    let [failure] = &found.failures[..] else { panic!("{:?}", found.failures) };
    assert_eq!((failure.name.as_str(), failure.kind), ("spring.k", FailureKind::Extension));
    assert!((failure.factor * load / high - 1.0).abs() < 1e-9, "{failure:?} {high}");
    assert!(found.yielding[0].failed && found.yielding[0].force == 0.0 && found.stable);
    assert_in_balance(&found, [0.0, -load]);
    // It is the cantilever alone.
    let mut b = ModelBuilder::new();
    let g = bar(&mut b, None, 8);
    pull(&mut b, g, [0.0, -load]);
    let alone = equilibrium(&b.build().unwrap()).unwrap();
    for i in 0..2 {
        let [with, without] = [&found, &alone].map(|f| f.points[0].1[i]);
        assert!((with / without - 1.0).abs() < 1e-9, "{with} {without}");
    }
    // The load of a step has no influence on the point of failure.
    for step in [0.03, 1.0] {
        let other = equilibrium_in(&helped(load, Some(extension)), step).unwrap();
        assert!((other.failures[0].factor / failure.factor - 1.0).abs() < 1e-9, "{other:?}");
    }
    let held = equilibrium(&helped(0.5 * load, Some(extension))).unwrap();
    assert!(held.failures.is_empty() && held.balance.springs[1] > 2e3);
    assert_in_balance(&held, [0.0, -0.5 * load]);
}

/// Two girders that clamps hold and a hinge joins; the load is on the first.
fn joined(strength: Option<f64>) -> Model {
    let mut b = ModelBuilder::new();
    let (material, section) = plank(&mut b);
    let first = b.beam(beam("first", [0.0, 0.0], [2.0, 0.0], 4, material, section));
    let second = b.beam(beam("second", [2.0, 0.0], [3.0, 0.0], 4, material, section));
    b.support(Support::new("left", at("a", first, 0.0), SupportKind::Clamp));
    b.support(Support::new("right", at("b", second, 1.0), SupportKind::Clamp));
    if let Some(force) = strength {
        let strength = Some(JointStrength { force: Some(force), moment: None });
        let between = [at("first.end", first, 1.0), at("second.start", second, 0.0)];
        b.joint(Joint { strength, ..Joint::new("pin", JointKind::Hinge, between) });
    }
    let (at, force) = (at("end", first, 1.0), [0.0, -20.0]);
    b.load(Load::new("weight", LoadKind::Point { at, force, moment: 0.0, follower: false }));
    b.record_point(self::at("middle", first, 1.0));
    b.build().unwrap()
}

#[test]
fn a_joint_tears_at_its_strength_and_lets_its_load_go() {
    // Tips of 3 EI / l^3 each share the load: the second, half as long, carries eight ninths.
    let found = equilibrium(&joined(Some(10.0))).unwrap();
    let [failure] = &found.failures[..] else { panic!("{:?}", found.failures) };
    assert_eq!((failure.name.as_str(), failure.kind), ("joint.pin", FailureKind::Torn));
    assert!((failure.factor / (10.0 / (8.0 / 9.0 * 20.0)) - 1.0).abs() < 1e-3, "{failure:?}");
    assert_in_balance(&found, [0.0, -20.0]);
    // Nothing is left of the forces in the second, not even round-off.
    assert_eq!(found.reactions[1].1, [0.0; 3]);
    let left = found.element_forces[4..].iter().flatten().flatten();
    assert!(left.clone().count() == 24 && left.clone().all(|x| *x == 0.0), "{left:?}");
    let alone = equilibrium(&joined(None)).unwrap();
    let [with, without] = [&found, &alone].map(|f| f.points[0].1[1]);
    assert!((with / without - 1.0).abs() < 1e-9, "{with} {without}");
    // A run starts from it at rest, the joint torn.
    let model = joined(Some(10.0));
    let settings = Settings { start: Start::Static, ..Settings::new(0.02, 1e-4) };
    let summary = simulate(&model, &settings, &mut NoRecorder).unwrap();
    assert_eq!(summary.joints[0].parted.map(|parted| parted.time), Some(0.0));
    let tip = summary.points[0].displacement_max[1].value;
    assert!((tip / with - 1.0).abs() < 1e-9, "{tip} {with}");
}

fn to_displacement(component: usize, value: f64, first: f64) -> PathSettings {
    let end = PathEnd::Displacement { point: "tip".into(), component, value };
    PathSettings { first, points: 2000, end }
}

#[test]
fn a_path_ends_its_arcs_where_a_spring_fails_and_agrees_with_statics() {
    let (load, extension) = (2e4, 0.05);
    let model = helped(load, Some(extension));
    let at_rest = equilibrium(&model).unwrap();
    for first in [0.05, 0.02, 0.2] {
        let settings = PathSettings { first, ..PathSettings::default() };
        let path = equilibrium_path(&model, &settings).unwrap();
        assert!(path.reached && path.limit_points.is_empty() && path.torn.is_none(), "{path:?}");
        let [failure] = &path.failures[..] else { panic!("{:?}", path.failures) };
        assert_eq!((failure.name.as_str(), failure.kind), ("spring.k", FailureKind::Extension));
        let expected = at_rest.failures[0].factor;
        assert!((failure.factor / expected - 1.0).abs() < 1e-9, "{failure:?} {expected}");
        assert!((expected - 0.479).abs() < 2e-3, "{expected}");
        for i in 0..2 {
            let [along, alone] = [&path.end, &at_rest].map(|f| f.points[0].1[i]);
            assert!((along / alone - 1.0).abs() < 1e-9, "{along} {alone}");
        }
        assert!(path.points.iter().all(|p| p.stable) && path.end.stable && at_rest.stable);
    }
    // With constant displacement the load decreases by the force of the spring.
    let path = equilibrium_path(&model, &to_displacement(2, -0.06, 0.05)).unwrap();
    let drop = path.points.windows(2).map(|w| w[0].factor - w[1].factor).fold(0.0, f64::max);
    assert!(path.reached && (drop * load / 3e3 - 1.0).abs() < 0.02, "{drop}");
}

#[test]
fn a_path_ends_where_a_bar_parts() {
    let most = SIDE * SIDE * (YIELD + YOUNG * 1e9 / (YOUNG + 1e9) * (0.01 - YIELD / YOUNG));
    let mut b = ModelBuilder::new();
    let g = bar(&mut b, Some(law(YIELD, 1e9, Some(0.01))), 4);
    pull(&mut b, g, [464e3, 0.0]);
    let path = equilibrium_path(&b.build().unwrap(), &PathSettings::default()).unwrap();
    assert!(!path.reached && path.torn.as_deref() == Some("beam.g"), "{:?}", path.torn);
    let last = path.points.last().unwrap().factor;
    assert!((last * 464e3 / most - 1.0).abs() < 1e-9, "{last}");
}

#[test]
fn a_bar_that_hardens_is_pulled_to_its_load_with_long_arcs() {
    let mut b = ModelBuilder::new();
    let g = bar(&mut b, Some(law(YIELD, 1e9, None)), 4);
    pull(&mut b, g, [452.8e3, 0.0]);
    let model = b.build().unwrap();
    let path = equilibrium_path(&model, &PathSettings::default()).unwrap();
    assert!(path.reached && path.limit_points.is_empty() && path.bifurcations.is_empty());
    assert!(path.points.len() < 40, "{}", path.points.len());
    let tangent = YOUNG * 1e9 / (YOUNG + 1e9);
    let expected = YIELD / YOUNG + (452.8e3 / (SIDE * SIDE) - YIELD) / tangent;
    let found = equilibrium(&model).unwrap();
    for tip in [path.points.last().unwrap().displacements[0][0], found.points[0].1[0]] {
        assert!((tip / expected - 1.0).abs() < 1e-9, "{tip} {expected}");
    }
    assert!(found.stable && path.end.stable);
}

/// A column of 1 m under an axial force of 80 kN and a lateral share of it.
fn column(inelasticity: Option<Plasticity>, aside: f64) -> Model {
    let mut b = ModelBuilder::new();
    let material = b.material(Material {
        strain: StrainMeasure::Engineering,
        inelasticity: inelasticity.map(Inelasticity::Plastic),
        ..Material::new("steel", YOUNG, 7850.0)
    });
    let section = b.section(Section { fibres: 8, ..Section::rectangle("square", SIDE, SIDE) });
    let g = b.beam(beam("g", [0.0, 0.0], [0.0, 1.0], 8, material, section));
    b.support(Support::new("foot", at("root", g, 0.0), SupportKind::Clamp));
    b.record_point(at("tip", g, 1.0));
    pull(&mut b, g, [80e3 * aside, -80e3]);
    b.build().unwrap()
}

#[test]
fn a_column_that_yields_has_one_limit_point_and_is_unstable_beyond() {
    let curve = vec![Hardening { from: 0.0, stress: YIELD, modulus: 0.0 }];
    let law = Plasticity { curve, kinematic: 2e9, overstress: None, failure_strain: None };
    let model = column(Some(law), 0.01);
    for first in [0.05, 0.02] {
        let path = equilibrium_path(&model, &to_displacement(1, 0.15, first)).unwrap();
        let [limit] = &path.limit_points[..] else { panic!("{:?}", path.limit_points) };
        assert!((limit.factor / 1.0273 - 1.0).abs() < 1e-4, "{limit:?}");
        assert!(path.reached && path.bifurcations.is_empty(), "{:?}", path.bifurcations);
        assert!(path.points.len() < 200, "{}", path.points.len());
        for point in &path.points {
            let before = point.displacements[0][0] < 0.99 * limit.displacements[0][0];
            let behind = point.displacements[0][0] > 1.01 * limit.displacements[0][0];
            assert!(if before { point.stable } else { !behind || !point.stable }, "{point:?}");
        }
        assert!(!path.end.stable);
    }
}

#[test]
fn a_straight_column_branches_at_its_critical_load_and_is_unstable_beyond() {
    let model = column(None, 0.0);
    let settings = PathSettings { end: PathEnd::Factor(2.0), ..PathSettings::default() };
    let path = equilibrium_path(&model, &settings).unwrap();
    let bending = YOUNG * SIDE.powi(4) / 12.0;
    let critical = std::f64::consts::PI.powi(2) / 4.0 * bending / 80e3;
    let [branch] = &path.bifurcations[..] else { panic!("{:?}", path.bifurcations) };
    assert!((branch.factor / critical - 1.0).abs() < 2e-3, "{branch:?} {critical}");
    assert!(path.limit_points.is_empty() && path.reached);
    for point in &path.points {
        assert_eq!(point.stable, point.factor < branch.factor, "{point:?}");
    }
    assert!(!path.end.stable);
}
