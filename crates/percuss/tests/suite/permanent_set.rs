//! Permanent deflection: that of the rest position of a damped run, with the remaining connections.

use crate::common;

use common::*;
use percuss::*;

/// Steel that yields at 275 MPa and hardens; `damping` by its mass \[1/s\], and as much by its strain, brings it to rest.
fn steel(b: &mut ModelBuilder, damping: f64) -> MaterialId {
    let plasticity = Plasticity {
        curve: vec![Hardening { from: 0.0, stress: 275e6, modulus: 1e9 }],
        kinematic: 0.0,
        overstress: None,
        failure_strain: None,
    };
    b.material(Material {
        strain: StrainMeasure::Engineering,
        mass_damping: damping,
        // Oscillations that steps do not resolve are damped only by stiffness-proportional damping.
        retardation: 1e-7 * damping,
        inelasticity: Some(Inelasticity::Plastic(plasticity)),
        ..Material::new("steel", 205e9, 7850.0)
    })
}

fn bar(b: &mut ModelBuilder, name: &str, material: MaterialId, y: f64) -> BeamId {
    let section = Section { fibres: 8, ..Section::rectangle(name, 0.04, 0.04) };
    let section = b.section(section);
    b.beam(beam(name, [0.0, y], [1.0, y], 8, material, section))
}

fn ball(name: &str, beam: BeamId, fraction: f64, velocity: f64) -> Projectile {
    Projectile {
        mass: 60.0,
        kind: ProjectileKind::spring(4e6),
        standoff: 0.0,
        ..elastic(name, at(name, beam, fraction), [0.0, velocity])
    }
}

/// A run, and where a recorded point is in the end \[m\].
fn run(model: &Model, end: f64, point: &str) -> (RunSummary, [f64; 2]) {
    let mut rows = MemoryRecorder::default();
    let summary = simulate(model, &Settings::new(end, 2e-5), &mut rows).unwrap();
    assert!(matches!(summary.termination, Termination::Completed), "{:?}", summary.termination);
    let last = |k: usize| {
        let column = rows.column(&format!("point.{point}.displacement_{k}")).expect("recorded");
        column.last().copied().expect("rows")
    };
    (summary, [last(1), last(2)])
}

fn assert_near(found: [f64; 2], right: [f64; 2], share: f64, what: &str) {
    let size = right[0].hypot(right[1]);
    let off = (found[0] - right[0]).hypot(found[1] - right[1]);
    assert!(off <= share * size, "{what}: {found:?} {right:?}");
}

/// A beam between two clamps of which one is released 5 ms after the impact: it rests as a cantilever, not bent back by the released clamp.
#[test]
fn a_clamp_that_has_let_go_does_not_bend_the_set_back() {
    let mut b = ModelBuilder::new();
    let material = steel(&mut b, 100.0);
    let beam = bar(&mut b, "g", material, 0.0);
    b.support(Support::new("a", at("a", beam, 0.0), SupportKind::Clamp));
    let far = Support::new("b", at("b", beam, 1.0), SupportKind::Clamp);
    b.support(Support { until: 5e-3, ..far });
    b.projectile(ball("p", beam, 0.5, -8.0));
    b.record_point(at("end", beam, 1.0));
    let (summary, rest) = run(&b.build().unwrap(), 0.5, "end");
    let set = summary.plastic[0].permanent_set.expect("a set");
    assert_eq!(set.s, 1.0);
    assert!(rest[1] < -0.03, "{rest:?}");
    assert_near(set.displacement, rest, 1e-6, "the end");
}

/// A cantilever with a displaced and rotated clamp: the deflection is relative to the position without plastic strains, for permanent and temporary
/// clamps.
#[test]
fn a_moved_support_is_no_set() {
    for (until, turned) in [(f64::INFINITY, 0.0), (10.0, 0.0), (f64::INFINITY, 0.05), (10.0, 0.05)]
    {
        let mut b = ModelBuilder::new();
        let material = steel(&mut b, 100.0);
        let beam = bar(&mut b, "g", material, 0.0);
        let moved = [0.0, 0.04];
        let function = TimeFunction::Ramp { duration: 3e-3 };
        let motion = Some(Motion { displacement: moved, rotation: turned, function });
        let root = Support::new("root", at("root", beam, 0.0), SupportKind::Clamp);
        b.support(Support { motion, until, ..root });
        b.record_point(at("tip", beam, 1.0));
        let (summary, rest) = run(&b.build().unwrap(), 0.4, "tip");
        let set = summary.plastic[0].permanent_set.expect("a set");
        let unstrained = [moved[0] + turned.cos() - 1.0, moved[1] + turned.sin()];
        let stays = [rest[0] - unstrained[0], rest[1] - unstrained[1]];
        assert!(stays[1].abs() > 1e-3, "{stays:?}");
        assert_near(set.displacement, stays, 1e-5, &format!("{until} {turned}"));
    }
}

/// One body is supported and another one free: the first has a permanent deflection, the same as alone, the second has none.
#[test]
fn a_body_that_flies_takes_no_set_from_one_that_is_held() {
    let build = |flies: bool| {
        let mut b = ModelBuilder::new();
        let material = steel(&mut b, 0.0);
        let held = bar(&mut b, "held", material, 0.0);
        b.support(Support::new("root", at("root", held, 0.0), SupportKind::Clamp));
        b.projectile(ball("p", held, 1.0, -8.0));
        if flies {
            let free = bar(&mut b, "free", material, 1.0);
            b.projectile(ball("q", free, 0.3, 30.0));
        }
        b.record_point(at("tip", held, 1.0));
        b.build().unwrap()
    };
    let [alone, both] = [false, true].map(|flies| run(&build(flies), 0.05, "tip").0);
    let [own, same] = [&alone, &both].map(|s| s.plastic[0].permanent_set.expect("a set"));
    assert!(own.size() > 1e-3);
    assert_near(same.displacement, own.displacement, 1e-9, "the tip");
    assert!(both.plastic[1].first_yield.is_some());
    assert_eq!(both.plastic[1].permanent_set, Err(NoPermanentSet::NotHeld));
}

/// A supported body without yielding has zero permanent deflection, so that a mean over runs includes it; an unsupported one has no place.
#[test]
fn a_run_without_yield_has_a_set_of_zero() {
    let set = |held: bool| {
        let mut b = ModelBuilder::new();
        let material = steel(&mut b, 0.0);
        let beam = bar(&mut b, "g", material, 0.0);
        if held {
            b.support(Support::new("root", at("root", beam, 0.0), SupportKind::Clamp));
        }
        b.projectile(ball("p", beam, 0.7, -0.01));
        b.record_point(at("tip", beam, 1.0));
        let summary = run(&b.build().unwrap(), 5e-3, "tip").0;
        assert!(summary.plastic[0].first_yield.is_none());
        summary.plastic[0].permanent_set
    };
    assert_eq!(set(true).map(|set| set.displacement), Ok([0.0; 2]));
    assert_eq!(set(false), Err(NoPermanentSet::NotHeld));
}

/// An elastic bar on a hinge that yields: unloaded it is straight, rotated by the plastic rotation.
#[test]
fn a_hinge_that_yields_has_the_set_of_the_beams_it_ties() {
    let mut b = ModelBuilder::new();
    let material = b.material(Material {
        strain: StrainMeasure::Engineering,
        ..Material::new("steel", 205e9, 7850.0)
    });
    let section = b.section(Section::rectangle("square", 0.04, 0.04));
    let stub = b.beam(beam("stub", [-0.2, 0.0], [0.0, 0.0], 1, material, section));
    let arm = b.beam(beam("arm", [0.0, 0.0], [1.0, 0.0], 6, material, section));
    b.support(Support::new("root", at("root", stub, 0.0), SupportKind::Clamp));
    let kind = JointKind::ElasticHinge { stiffness: 1e5, damping: 0.0 };
    let between = [at("stub.end", stub, 1.0), at("arm.start", arm, 0.0)];
    let yielding = Some(Plasticity {
        curve: vec![Hardening { from: 0.0, stress: 500.0, modulus: 0.0 }],
        kinematic: 0.0,
        overstress: None,
        failure_strain: None,
    });
    b.joint(Joint { yielding, ..Joint::new("knee", kind, between) });
    b.projectile(ball("p", arm, 1.0, -3.0));
    b.record_point(at("tip", arm, 1.0));
    let summary = run(&b.build().unwrap(), 0.1, "tip").0;
    assert!(summary.plastic.is_empty(), "no beam can yield");
    let knee = &summary.yielding[0];
    let turned = knee.plastic;
    assert!(turned < -0.05, "{turned}");
    let found = knee.permanent_set.clone().expect("a set");
    assert_eq!((found.beam.as_str(), found.set.s), ("arm", 1.0));
    assert_near(found.set.displacement, [turned.cos() - 1.0, turned.sin()], 1e-9, "the arm");
}
