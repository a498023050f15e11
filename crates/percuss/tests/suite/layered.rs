//! Sections given by fibres of several materials: consequences for forces, balances, faults.

use crate::common;

use common::numbers::Numbers;
use common::{at, beam};
use percuss::*;

/// A metal that yields.
fn metal(name: &str, young: f64, density: f64, limit: f64, kinematic: f64) -> Material {
    let curve = vec![Hardening { from: 0.0, stress: limit, modulus: 0.0 }];
    let law = Plasticity { curve, kinematic, overstress: None, failure_strain: None };
    Material {
        strain: StrainMeasure::Engineering,
        inelasticity: Some(Inelasticity::Plastic(law)),
        ..Material::new(name, young, density)
    }
}

/// Fibres with heights from the elastic centroid.
fn centred(
    mut fibres: Vec<SectionFibre>,
    young: impl Fn(&SectionFibre) -> f64,
) -> Vec<SectionFibre> {
    let sum = |f: &dyn Fn(&SectionFibre) -> f64| fibres.iter().map(f).sum::<f64>();
    let centroid = sum(&|f| young(f) * f.area * f.height) / sum(&|f| young(f) * f.area);
    fibres.iter_mut().for_each(|f| f.height -= centroid);
    fibres
}

#[test]
fn a_section_of_two_materials_vibrates_as_one_of_its_stiffness_and_mass() {
    let (steel, alloy) = ([210e9, 7850.0], [70e9, 2700.0]);
    let heights = [(-0.01, 0), (-0.004, 0), (0.002, 1), (0.011, 1)];
    let simple = |b: &mut ModelBuilder, material, section| {
        let girder = b.beam(beam("girder", [0.0, 0.0], [1.0, 0.0], 12, material, section));
        b.support(Support::new("left", at("left", girder, 0.0), SupportKind::Pin));
        let roller = SupportKind::Roller { direction: [1.0, 0.0] };
        b.support(Support::new("right", at("right", girder, 1.0), roller));
    };
    let mut b = ModelBuilder::new();
    let of = |(name, [young, density]): (&str, [f64; 2])| Material::new(name, young, density);
    let ids = [("steel", steel), ("alloy", alloy)].map(|m| b.material(of(m)));
    let fibre = |(height, i): (f64, usize)| SectionFibre {
        height,
        area: 1e-4,
        material: (i == 1).then_some(ids[1]),
    };
    let stiff = |f: &SectionFibre| if f.material.is_some() { alloy } else { steel };
    let fibres = centred(heights.map(fibre).to_vec(), |f| stiff(f)[0]);
    let sum = |f: &dyn Fn(&SectionFibre) -> f64| fibres.iter().map(f).sum::<f64>();
    let axial = sum(&|f| stiff(f)[0] * f.area);
    let bending = sum(&|f| stiff(f)[0] * f.area * f.height.powi(2));
    let mass = sum(&|f| stiff(f)[1] * f.area);
    let rotary = sum(&|f| stiff(f)[1] * f.area * f.height.powi(2));
    let section = b.section(Section::of_fibres("layers", fibres.clone()));
    simple(&mut b, ids[0], section);
    let found = natural_frequencies(&b.build().unwrap(), 5);

    let mut b = ModelBuilder::new();
    let (young, area) = (1e11, axial / 1e11);
    let material = b.material(Material::new("one", young, mass / area));
    let same = Section::new("one", area, bending / young);
    let section = b.section(Section { rotary_inertia: RotaryInertia::Given(rotary), ..same });
    simple(&mut b, material, section);
    let expected = natural_frequencies(&b.build().unwrap(), 5);
    assert!(expected.len() == 5 && expected[0] > 1.0);
    // Elements of fibres have membrane strains of their own, as slender ones have: not the same element to the last digit.
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found / expected - 1.0).abs() < 1e-7, "{found} Hz, {expected} Hz");
    }
}

/// A beam of a body that yields, or not, with stiffer bars that yield, struck.
fn struck(number: u64) -> RunSummary {
    let mut r = Numbers(number.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x1234_5678);
    for _ in 0..8 {
        r.next();
    }
    let mut b = ModelBuilder::new();
    let (soft, hard) = (r.decades(5e9, 5e10), 2e11);
    let body = if r.chance(0.5) {
        Material::new("body", soft, r.between(1e3, 3e3))
    } else {
        metal("body", soft, r.between(1e3, 3e3), soft * r.decades(1e-3, 5e-3), 0.0)
    };
    let body = Material { strain: StrainMeasure::Engineering, ..body };
    let retardation = if r.chance(0.3) { 1e-6 } else { 0.0 };
    let body = b.material(Material { retardation, ..body });
    let kinematic = if r.chance(0.5) { hard * 0.02 } else { 0.0 };
    let bars = metal("bars", hard, 7850.0, r.between(2e8, 6e8), kinematic);
    let bars = b.material(Material { retardation, ..bars });
    let (depth, width) = (r.between(0.02, 0.06), r.between(0.02, 0.05));
    let fibre = |i: u32| {
        let height = depth * ((f64::from(i) + 0.5) / 10.0 - 0.5);
        SectionFibre { height, area: width * depth / 10.0, material: None }
    };
    let mut fibres: Vec<_> = (0..10).map(fibre).collect();
    for height in [-0.4 * depth, r.between(-0.4, 0.4) * depth] {
        let area = width * depth * r.between(0.005, 0.05);
        fibres.push(SectionFibre { height, area, material: Some(bars) });
    }
    let fibres = centred(fibres, |f| if f.material.is_some() { hard } else { soft });
    let section = b.section(Section::of_fibres("reinforced", fibres));
    let girder = b.beam(beam("girder", [0.0, 0.0], [1.0, 0.0], 6, body, section));
    let clamped = r.chance(0.5);
    for f in [0.0, 1.0] {
        let kind = if clamped { SupportKind::Clamp } else { SupportKind::Pin };
        b.support(Support::new(format!("hold{f}"), at("held", girder, f), kind));
    }
    let kind = if r.chance(0.5) {
        ProjectileKind::spring(r.decades(1e6, 1e8))
    } else {
        ProjectileKind::Rigid { restitution: r.next() }
    };
    let strikes = at("struck", girder, r.between(0.2, 0.8));
    let velocity = [0.0, -r.decades(5.0, 60.0)];
    b.projectile(Projectile::new("shot", kind, r.decades(0.2, 10.0), velocity, strikes));
    let model = b.build().unwrap_or_else(|faults| panic!("beam {number}: {faults:?}"));
    let settings = Settings::new(2e-3, 2e-5);
    Simulation::new(&model, &settings).unwrap().run(&mut NoRecorder)
}

#[test]
fn thirty_struck_beams_of_two_materials_account_for_all_energy() {
    let (mut yielded, mut worst) = (0, 0.0_f64);
    for number in 0..30 {
        let summary = struck(number);
        let energy = &summary.energy;
        assert!(
            matches!(summary.termination, Termination::Completed),
            "beam {number}: {summary:?}"
        );
        assert!(energy.residual_max < 1e-10, "beam {number}: {energy:?}");
        worst = worst.max(energy.residual_max);
        let own = summary.plastic[0].dissipated;
        assert!((own - energy.plastic).abs() <= 1e-12 * energy.scale, "beam {number}: {own:e}");
        yielded += usize::from(energy.plastic > 0.01 * energy.scale);
    }
    println!("{yielded} yielded, largest residual {worst:e}");
    assert!(yielded >= 10, "{yielded}");
}

/// Faults of a beam of such a section.
fn faults(section: impl FnOnce(MaterialId) -> Section) -> Vec<String> {
    let mut b = ModelBuilder::new();
    let stiff = b.material(Material::new("stiff", 2e11, 7850.0));
    let soft = b.material(Material::new("soft", 1e10, 1000.0));
    let section = b.section(section(stiff));
    b.beam(beam("girder", [0.0, 0.0], [1.0, 0.0], 2, soft, section));
    let found = b.build().err().unwrap_or_default();
    found.iter().map(ToString::to_string).collect()
}

#[test]
fn every_fault_of_fibres_is_reported_once() {
    let plain = |height: f64, area: f64| SectionFibre { height, area, material: None };
    let of = |fibres: Vec<SectionFibre>| faults(|_| Section::of_fibres("s", fibres));
    let reported = |found: Vec<String>, words: &str| {
        assert!(found.len() == 1 && found[0].contains(words), "{words}: {found:?}");
    };
    assert!(of(vec![plain(-0.01, 1e-4), plain(0.01, 1e-4)]).is_empty());
    reported(of(vec![]), "from 2 to 200 fibres");
    reported(of(vec![plain(-0.01, 1e-4), plain(0.01, -1e-4)]), "areas above zero");
    reported(of(vec![plain(0.0, 1e-4), plain(0.0, 1e-4)]), "different heights");
    reported(of(vec![plain(-0.01, 1e-4), plain(0.02, 1e-4)]), "-5.000000e-3 m added to each");
    let shallow = |_: MaterialId| Section {
        depth: Some(0.01),
        ..Section::of_fibres("s", vec![plain(-0.01, 1e-4), plain(0.01, 1e-4)])
    };
    reported(faults(shallow), "within half the depth");
    // The stiffer one draws the centroid to itself: 2e11 against 1e10.
    let two = |stiff: MaterialId| {
        let bar = SectionFibre { material: Some(stiff), ..plain(0.01, 1e-4) };
        Section::of_fibres("s", vec![plain(-0.01, 1e-4), bar])
    };
    reported(faults(two), "-9.047619e-3 m added to each");
    // Fibres with another strain measure, or another damping, would differ from their material.
    let mut b = ModelBuilder::new();
    let own = b.material(Material::new("own", 1e10, 1000.0));
    let damped = b.material(Material { mass_damping: 5.0, ..Material::new("damped", 1e10, 1e3) });
    let other = SectionFibre { material: Some(damped), ..plain(0.01, 1e-4) };
    let section = b.section(Section::of_fibres("s", vec![plain(-0.01, 1e-4), other]));
    b.beam(beam("girder", [0.0, 0.0], [1.0, 0.0], 2, own, section));
    let found = b.build().err().unwrap_or_default();
    reported(found.iter().map(ToString::to_string).collect(), "`damped`");
}
