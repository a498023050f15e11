//! Shear-flexible beams of fibres: layered sections, closed forms of yielding, balances.

use crate::common;

use common::*;
use percuss::*;

/// A material that yields at a stress \[Pa\], with linear isotropic hardening.
fn metal(limit: f64, modulus: f64, change: impl FnOnce(&mut Plasticity)) -> Material {
    let mut plasticity = Plasticity {
        curve: vec![Hardening { from: 0.0, stress: limit, modulus }],
        kinematic: 0.0,
        overstress: None,
        failure_strain: None,
    };
    change(&mut plasticity);
    Material {
        strain: StrainMeasure::Engineering,
        poisson: Some(0.3),
        inelasticity: Some(Inelasticity::Plastic(plasticity)),
        ..Material::new("metal", 200e9, 7850.0)
    }
}

/// A cantilever of 1 m with a force across its tip \[N\].
fn cantilever(mut b: ModelBuilder, beam: Beam, force: f64) -> Model {
    let arm = b.beam(beam);
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let tip = at("tip", arm, 1.0);
    b.record_point(tip.clone());
    if force != 0.0 {
        let kind = LoadKind::Point { at: tip, force: [0.0, force], moment: 0.0, follower: false };
        b.load(Load::new("tip", kind));
    }
    b.build().unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn straight(elements: usize, material: MaterialId, section: SectionId) -> Beam {
    beam("arm", [0.0, 0.0], [1.0, 0.0], elements, material, section)
}

/// A soft core between two stiff faces.
fn layered(elements: usize, force: f64) -> (Model, [f64; 5]) {
    let mut b = ModelBuilder::new();
    let of = |young: f64, density: f64, shear: f64| Material {
        shear_modulus: Some(shear),
        strain: StrainMeasure::Engineering,
        ..Material::new(format!("m{young}"), young, density)
    };
    let (core, face) = ([1e9, 300.0, 5e7], [70e9, 2700.0, 26e9]);
    let [inner, outer] = [core, face].map(|[e, rho, g]| b.material(of(e, rho, g)));
    let layers = [(-0.055, 1e-3, true), (-0.025, 5e-3, false), (0.025, 5e-3, false)];
    let layers = layers.into_iter().chain([(0.055, 1e-3, true)]);
    let fibre = |(height, area, stiff): (f64, f64, bool)| SectionFibre {
        height,
        area,
        material: stiff.then_some(outer),
    };
    let fibres: Vec<SectionFibre> = layers.map(fibre).collect();
    let sum = |f: &dyn Fn([f64; 3], f64) -> f64| -> f64 {
        let of = |x: &SectionFibre| if x.material.is_some() { face } else { core };
        fibres.iter().map(|x| x.area * f(of(x), x.height)).sum()
    };
    let factor = 0.6;
    let constants = [
        sum(&|[e, ..], _| e),
        sum(&|[e, ..], y| e * y * y),
        factor * sum(&|[_, _, g], _| g),
        sum(&|[_, rho, _], _| rho),
        sum(&|[_, rho, _], y| rho * y * y),
    ];
    let layers = Section::of_fibres("layers", fibres);
    let section = b.section(Section { shear_factor: Some(factor), ..layers });
    let arm = Beam { theory: Theory::Shear, ..straight(elements, inner, section) };
    (cantilever(b, arm, force), constants)
}

/// `F L^3 / (3 EI) + F L / (kappa GA)` with the sums over the layers, for any number of elements, and the stress `E y M / EI` of a face.
#[test]
fn a_layered_cantilever_has_the_deflection_of_its_composite_stiffnesses() {
    for elements in [1, 2, 7] {
        let force = 5.0;
        let (model, [_, bending, shear, ..]) = layered(elements, force);
        let found = equilibrium(&model).unwrap();
        let tip = force / (3.0 * bending) + force / shear;
        let [_, y] = found.points[0].1;
        assert!((y / tip - 1.0).abs() < 1e-6, "{elements}: {y:e} {tip:e}");
        // At the point in the middle of the first element.
        let moment = force * (1.0 - 0.5 / elements as f64);
        let stress = found.section_forces[0].stress.largest();
        let known = 70e9 * 0.055 * moment / bending;
        assert!((stress.value.abs() / known - 1.0).abs() < 1e-5, "{stress:?} {known:e}");
        assert!((stress.s - 0.5 / elements as f64).abs() < 1e-12, "{stress:?}");
        let root = found.section_forces[0].moment.largest();
        assert!((root.value.abs() / force - 1.0).abs() < 1e-6 && root.s == 0.0, "{root:?}");
    }
}

#[test]
fn layers_vibrate_as_a_section_of_their_stiffness_and_mass() {
    let (model, [axial, bending, shear, mass, rotary]) = layered(12, 0.0);
    let found = natural_frequencies(&model, 5);
    let mut b = ModelBuilder::new();
    let (young, area) = (1e10, axial / 1e10);
    let of =
        Material { shear_modulus: Some(shear / area), ..Material::new("one", young, mass / area) };
    let material = b.material(of);
    let section = b.section(Section {
        rotary_inertia: RotaryInertia::Given(rotary),
        shear_factor: Some(1.0),
        ..Section::new("one", area, bending / young)
    });
    let arm = Beam { theory: Theory::Shear, ..straight(12, material, section) };
    let expected = natural_frequencies(&cantilever(b, arm, 0.0), 5);
    assert!(expected.len() == 5 && expected[0] > 1.0);
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found / expected - 1.0).abs() < 1e-8, "{found} Hz, {expected} Hz");
    }
}

/// Bending stiffness and yield moment of the two flanges of [`flanges`].
const BENDING: f64 = 1e6;
const YIELD_MOMENT: f64 = 200.0;
/// Force on their tip.
const FORCE: f64 = 300.0;

/// Two flanges that yield at 2 MPa, each of 1e-3 m^2, 0.1 m apart: a bilinear relation of moment and curvature.
fn flanges(elements: usize, shear_modulus: f64, theory: Theory) -> Model {
    let mut b = ModelBuilder::new();
    let material = metal(2e6, 10e9, |_| {});
    let material =
        b.material(Material { poisson: None, shear_modulus: Some(shear_modulus), ..material });
    let fibre = |height| SectionFibre { height, area: 1e-3, material: None };
    let two = Section::of_fibres("flanges", [-0.05, 0.05].map(fibre).to_vec());
    let section = b.section(Section { shear_factor: Some(0.5), ..two });
    cantilever(b, Beam { theory, ..straight(elements, material, section) }, FORCE)
}

/// Plastic curvature under a moment.
fn plastic_curvature(moment: f64) -> f64 {
    let hardening = BENDING * 10.0 / 210.0;
    (moment - YIELD_MOMENT).max(0.0) * (1.0 / hardening - 1.0 / BENDING)
}

/// Deflection `F L^3 / (3 EI) + F L / (kappa GA)`, and that by the plastic curvature at the points of the elements; the latter tends to the integral
/// with their second order.
#[test]
fn a_bilinear_cantilever_has_its_plastic_deflection_beside_those_of_bending_and_shear() {
    let shear = 0.5 * 1e9 * 2e-3;
    let elastic = FORCE / (3.0 * BENDING) + FORCE / shear;
    // Both parts of the integral of (F x - M_y) x from M_y / F to 1.
    let from = YIELD_MOMENT / FORCE;
    let whole = (plastic_curvature(FORCE) / (FORCE - YIELD_MOMENT))
        * (FORCE * (1.0 - from.powi(3)) / 3.0 - YIELD_MOMENT * (1.0 - from * from) / 2.0);
    // The sums below miss the integral by 9.0e-3, 5.5e-4 and 1.4e-4 of the deflection.
    for (elements, off) in [(8, 9.5e-3), (32, 6e-4), (64, 2e-4)] {
        let model = flanges(elements, 1e9, Theory::Shear);
        let found = equilibrium(&model).unwrap();
        let length = 1.0 / elements as f64;
        let arm = |k: usize| 1.0 - (k as f64 + 0.5) * length;
        let curved = |k: usize| length * plastic_curvature(FORCE * arm(k));
        let lasting: f64 = (0..elements).map(|k| curved(k) * arm(k)).sum();
        let [_, y] = found.points[0].1;
        assert!((y / (elastic + lasting) - 1.0).abs() < 1e-5, "{elements}: {y:e}");
        assert!((y / (elastic + whole) - 1.0).abs() < off, "{elements}: {y:e}");
        let all = yielded_at_rest(&model, &found);
        let [arm_of] = all.as_slice() else { panic!("{all:?}") };
        let set = arm_of.permanent_set.unwrap();
        assert!((set.displacement[1] / lasting - 1.0).abs() < 1e-4, "{set:?} {lasting:e}");
        let [hinge] = arm_of.hinges.as_slice() else { panic!("{:?}", arm_of.hinges) };
        let turned: f64 = (0..elements).map(curved).sum();
        assert!((hinge.rotation / turned - 1.0).abs() < 1e-5, "{hinge:?} {turned:e}");
        let yielded = (0..elements).filter(|k| FORCE * arm(*k) > YIELD_MOMENT).count();
        assert!((hinge.length - yielded as f64 * length).abs() < 1e-12, "{hinge:?}");
    }
}

#[test]
fn a_beam_that_yields_is_a_slender_one_as_its_shear_stiffness_grows() {
    let tip = |model: &Model| equilibrium(model).unwrap().points[0].1[1];
    let slender = tip(&flanges(64, 1e9, Theory::Slender));
    for modulus in [1e9, 1e12, 1e15] {
        let sheared = FORCE / (0.5 * modulus * 2e-3);
        let found = tip(&flanges(64, modulus, Theory::Shear)) - sheared;
        assert!((found / slender - 1.0).abs() < 5e-4, "{modulus:e}: {found:e} {slender:e}");
    }
}

/// `kappa = (2 sy / (E h)) / sqrt(3 (1 - M / M0))`, `M0 = sy b h^2 / 4`, a circular arc: of pure bending, with large turns.
#[test]
fn an_end_moment_bends_a_perfectly_plastic_cantilever_to_the_closed_form() {
    let (limit, h, length, moment) = (1300e6_f64, 5e-3_f64, 0.05_f64, 22.0);
    let most = limit * 3e-3 * h * h / 4.0;
    let bent = 2.0 * limit / (200e9 * h) / (3.0 * (1.0 - moment / most)).sqrt();
    let exact = (1.0 - (bent * length).cos()) / bent;
    let found = |fibres: usize, moment: f64| {
        let mut b = ModelBuilder::new();
        let material = b.material(metal(limit, 0.0, |_| {}));
        let section = b.section(Section { fibres, ..Section::rectangle("r", 3e-3, h) });
        let arm = beam("arm", [0.0, 0.0], [length, 0.0], 8, material, section);
        bent_by_end_moment(b, Beam { theory: Theory::Shear, ..arm }, moment)
    };
    let miss = |fibres: usize| {
        let found = found(fibres, moment).unwrap();
        let stress = found.section_forces[0].stress.largest().value;
        assert!((stress.abs() / limit - 1.0).abs() < 1e-9, "{stress:e}");
        (found.points[0].1[1] / exact - 1.0).abs()
    };
    let (coarse, fine) = (miss(16), miss(96));
    assert!(coarse < 1e-2 && fine < 2e-4, "{coarse:e} {fine:e}");
    // The plastic moment is that of the section.
    assert!(found(48, 0.99 * most).is_ok());
    assert!(found(48, 1.001 * most).is_err());
}

/// A short deep beam, clamped at both ends, with a mass of 5 kg that strikes it at a speed \[m/s\].
fn struck(material: Material, kind: ProjectileKind, speed: f64) -> RunSummary {
    let mut b = ModelBuilder::new();
    let material = b.material(material);
    let section = b.section(Section::rectangle("s", 0.03, 0.06));
    let girder = beam("girder", [0.0, 0.0], [0.3, 0.0], 10, material, section);
    let girder = b.beam(Beam { theory: Theory::Shear, ..girder });
    for (name, f) in [("left", 0.0), ("right", 1.0)] {
        b.support(Support::new(name, at(name, girder, f), SupportKind::Clamp));
    }
    let strikes = at("struck", girder, 0.43);
    b.projectile(Projectile::new("shot", kind, 5.0, [0.0, -speed], strikes));
    let model = b.build().unwrap_or_else(|faults| panic!("{faults:?}"));
    Simulation::new(&model, &Settings::new(2e-3, 2e-6)).unwrap().run(&mut NoRecorder)
}

fn assert_balances(summary: &RunSummary, name: &str) {
    assert!(matches!(summary.termination, Termination::Completed), "{name}: {summary:?}");
    let (energy, momentum) = (&summary.energy, &summary.momentum);
    assert!(energy.residual_max < 1e-10, "{name}: {energy:?}");
    assert!(momentum.linear_residual_max < 1e-10, "{name}: {momentum:?}");
    assert!(momentum.angular_residual_max < 1e-10, "{name}: {momentum:?}");
    let own = summary.plastic[0].dissipated;
    assert!((own - energy.plastic).abs() <= 1e-12 * energy.scale, "{name}: {own:e}");
}

#[test]
fn a_struck_beam_closes_its_balance_while_it_yields() {
    let rate = Some(Overstress { rate: 40.4, exponent: 5.0 });
    for (name, material) in [
        ("perfect", metal(250e6, 0.0, |_| {})),
        ("kinematic", metal(250e6, 0.0, |p| p.kinematic = 2e9)),
        ("rate", metal(250e6, 1e9, |p| p.overstress = rate)),
        ("viscous", Material { retardation: 1e-6, ..metal(250e6, 1e9, |_| {}) }),
    ] {
        for kind in [ProjectileKind::spring(5e7), ProjectileKind::Rigid { restitution: 0.3 }] {
            let summary = struck(material.clone(), kind, 25.0);
            assert_balances(&summary, name);
            let girder = &summary.plastic[0];
            assert!(summary.energy.plastic > 0.03 * summary.energy.initial, "{name}: {girder:?}");
            assert!(!girder.hinges.is_empty() && girder.permanent_set.is_ok(), "{girder:?}");
        }
    }
}

#[test]
fn a_struck_beam_that_parts_accounts_for_all_energy() {
    let material = metal(250e6, 0.0, |p| p.failure_strain = Some(0.02));
    let summary = struck(material, ProjectileKind::spring(5e7), 60.0);
    assert_balances(&summary, "parting");
    assert!(summary.plastic[0].failed > 0 && summary.energy.failure > 0.0, "{summary:?}");
}

#[test]
fn a_free_beam_that_yields_keeps_its_momenta() {
    let mut b = ModelBuilder::new();
    let material = b.material(metal(250e6, 0.0, |p| p.kinematic = 1e9));
    let section = b.section(Section::rectangle("s", 0.03, 0.06));
    let bar = beam("bar", [0.0, 0.0], [0.6, 0.0], 12, material, section);
    let bar = b.beam(Beam { theory: Theory::Shear, ..bar });
    for (i, f) in [0.3, 0.8].into_iter().enumerate() {
        let (name, strikes) = (format!("ball{i}"), at(&format!("p{i}"), bar, f));
        let kind = ProjectileKind::spring(2e7);
        b.projectile(Projectile::new(name, kind, 1.0, [0.0, -90.0], strikes));
    }
    let model = b.build().unwrap();
    let summary = simulate(&model, &Settings::new(2e-3, 2e-6), &mut NoRecorder).unwrap();
    assert_balances(&summary, "free");
    assert!(summary.energy.plastic > 0.0, "{:?}", summary.energy);
}

#[test]
fn what_fibres_of_a_shear_flexible_beam_need_is_named() {
    let faults = |material: Material, factor: Option<f64>| {
        let mut b = ModelBuilder::new();
        let material = b.material(material);
        let fibre = |height| SectionFibre { height, area: 1e-3, material: None };
        let two = Section::of_fibres("flanges", [-0.05, 0.05].map(fibre).to_vec());
        let section = b.section(Section { shear_factor: factor, ..two });
        b.beam(Beam { theory: Theory::Shear, ..straight(4, material, section) });
        let found = b.build().err().unwrap_or_default();
        found.iter().map(|fault| fault.path.clone()).collect::<Vec<_>>()
    };
    let good = || metal(250e6, 0.0, |_| {});
    assert!(faults(good(), Some(0.5)).is_empty());
    assert_eq!(faults(good(), None), ["section.flanges.shear_factor"]);
    let unknown = Material { poisson: None, ..good() };
    assert_eq!(faults(unknown, Some(0.5)), ["material.metal.poisson"]);
    let green = Material { strain: StrainMeasure::Green, ..good() };
    assert_eq!(faults(green, Some(0.5)), ["material.metal.strain"]);
}
