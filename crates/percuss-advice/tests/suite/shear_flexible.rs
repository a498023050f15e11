//! Advice on shear-flexible beams: none that holds of slender ones alone.

use crate::common::at;
use percuss::*;
use percuss_advice::*;

/// A steel beam struck in its middle.
fn struck(theory: Theory, kind: ProjectileKind) -> Model {
    let mut b = ModelBuilder::new();
    let material =
        b.material(Material { poisson: Some(0.3), ..Material::new("steel", 2.1e11, 7850.0) });
    let section = b.section(Section::rectangle("bar", 0.1, 0.2));
    let beam = Beam { theory, ..Beam::new("beam", &[[0.0; 2], [3.0, 0.0]], 24, material, section) };
    let beam = b.beam(beam);
    for end in [0.0, 1.0] {
        b.support(Support::new(format!("at {end}"), at("end", beam, end), SupportKind::Pin));
    }
    b.projectile(Projectile::new("mass", kind, 50.0, [0.0, -4.0], at("mid", beam, 0.5)));
    b.build().unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn reported(theory: Theory, kind: ProjectileKind, topic: Topic) -> Option<Advice> {
    let all = advise(&struck(theory, kind), &Settings::new(0.05, 2e-5));
    all.into_iter().find(|advice| advice.topic == topic)
}

#[test]
fn shear_that_a_beam_has_is_not_said_to_be_neglected() {
    let spring = || ProjectileKind::spring(5e5);
    assert!(reported(Theory::Slender, spring(), Topic::Shear).is_some());
    assert_eq!(reported(Theory::Shear, spring(), Topic::Shear), None);
    // Formulas of slender beams stand beside no run of another.
    let settings = Settings::new(0.05, 2e-5);
    let formulas = |theory: Theory| {
        let model = struck(theory, spring());
        let summary = simulate(&model, &settings, &mut NoRecorder).unwrap();
        let all = compare(&model, &settings, &summary);
        all.into_iter().map(|row| row.formula).collect::<Vec<_>>()
    };
    let slender = formulas(Theory::Slender);
    assert!(slender.iter().any(|name| name.contains("two-degree")), "{slender:?}");
    let shear = formulas(Theory::Shear);
    assert!(!shear.iter().any(|name| name.contains("two-degree")), "{shear:?}");
}

#[test]
fn the_force_after_a_rigid_impact_is_reported_with_its_limit() {
    let kind = |restitution: f64| ProjectileKind::Rigid { restitution };
    for (restitution, verdict) in [(0.0, Verdict::Note), (0.5, Verdict::Warning)] {
        let found = reported(Theory::Shear, kind(restitution), Topic::EffectiveMass).unwrap();
        assert_eq!(found.verdict, verdict);
        assert!(found.text.contains("2 v sqrt(kappa G A rho A)"), "{}", found.text);
        // Of the limit, an effective mass, nothing is left.
        assert!(found.text.contains("tends to 0 kg"), "{}", found.text);
    }
    let slender = reported(Theory::Slender, kind(0.0), Topic::EffectiveMass).unwrap();
    assert!(!slender.text.contains("kappa"), "{}", slender.text);
}

/// A short steel arm, with a strength that its von Mises stress exceeds in the middle of its depth alone.
#[test]
fn a_strength_passed_by_shear_is_reported_as_a_von_mises_stress() {
    let mut b = ModelBuilder::new();
    let most = 3.0_f64.sqrt() * 1.5 * 1e5 / 0.02;
    let limit = 0.99 * most;
    let strength = Some(Strength { tension: limit, compression: limit });
    let material = b.material(Material { strength, ..Material::new("steel", 2.1e11, 7850.0) });
    let section = b.section(Section::rectangle("bar", 0.1, 0.2));
    let arm = b.beam(Beam::new("arm", &[[0.0; 2], [0.03, 0.0]], 4, material, section));
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let (at, force) = (at("tip", arm, 1.0), [0.0, -1e5]);
    b.load(Load::new("tip", LoadKind::Point { at, force, moment: 0.0, follower: false }));
    let model = b.build().unwrap_or_else(|faults| panic!("{faults:?}"));
    let found = equilibrium(&model).unwrap();
    let all = at_rest(&model, &found);
    let [advice] = all.as_slice() else { panic!("{all:?}") };
    assert!(advice.text.contains("von Mises stress 1"), "{}", advice.text);
    // 13.0 MPa, the strength 12.9 MPa; the rotation of the tip changes them by 1e-5.
    assert!((advice.value / most - 1.0).abs() < 1e-4, "{advice:?}");
    assert!((advice.reference / limit - 1.0).abs() < 1e-12, "{advice:?}");
}

/// A concrete arm bears much less in tension than in compression: each side has its own limit, and its own largest stress.
#[test]
fn each_side_of_a_bent_beam_is_compared_with_its_own_strength() {
    let reported = |force: f64| {
        let mut b = ModelBuilder::new();
        let strength = Some(Strength { tension: 2.9e6, compression: 30e6 });
        let material = b.material(Material { strength, ..Material::new("c", 3.3e10, 2500.0) });
        let section = b.section(Section::rectangle("bar", 0.1, 0.2));
        let arm = b.beam(Beam::new("arm", &[[0.0; 2], [2.0, 0.0]], 4, material, section));
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        let (at, force) = (at("tip", arm, 1.0), [0.0, -force]);
        b.load(Load::new("tip", LoadKind::Point { at, force, moment: 0.0, follower: false }));
        let model = b.build().unwrap();
        let found = equilibrium(&model).unwrap();
        at_rest(&model, &found).pop().expect("a finding")
    };
    // 6 F L / (b d^2): 6 MPa, and 60 MPa.
    let small = reported(2e3);
    assert!(
        small.text.contains("6 MPa at s = 0 m (strength of the material 2.9 MPa)")
            && !small.text.contains("compression"),
        "{}",
        small.text
    );
    let large = reported(20e3);
    assert!(large.text.contains("(strength 2.9 MPa) and compression -6"), "{}", large.text);
    assert!(large.text.contains("(strength 30 MPa)"), "{}", large.text);
    assert!(large.value > 0.0 && large.reference == 2.9e6, "{large:?}");
}
