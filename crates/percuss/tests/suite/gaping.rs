//! Materials with stress of one sign only that yield under it: concrete and masonry in compression, straps in tension.

use crate::common;

use common::numbers::Numbers;
use common::{at, beam};
use percuss::*;

/// A material that gapes under stress of one sign, and flows at a limit under the other.
fn one_sided(slack: Slack, young: f64, limit: f64, failure_strain: Option<f64>) -> Material {
    let curve = vec![Hardening { from: 0.0, stress: limit, modulus: 0.0 }];
    let law = Plasticity { curve, kinematic: 0.0, overstress: None, failure_strain };
    Material {
        strain: StrainMeasure::Engineering,
        inelasticity: Some(Inelasticity::OneSidedPlastic(slack, law)),
        ..Material::new("concrete", young, 2400.0)
    }
}

/// A rectangle without tension under axial force and moment, its compressed edge strained to a multiple m > 1 of the strain at
/// which it yields: over the compressed depth x the stress is constant but for the last x/m, where it falls to zero. So
/// `N = b f x (1 - 1/(2m))`, its distance from the edge `z = x (1/2 - 1/(2m) + 1/(6m^2)) / (1 - 1/(2m))`, and the curvature is
/// `m f / (E x)`. With m = 2 this is the bilinear stress block of EN 1992-1-1, 3.1.7: .75 and .389.
#[test]
fn a_section_that_gapes_and_yields_has_the_stress_block_of_the_codes() {
    let (young, limit, width, depth) = (30e9, 30e6, 0.3, 0.4);
    let cases = [(1.2_f64, 0.6, 0.1), (2.0, 0.4, 0.1), (2.0, 0.7, 0.1), (3.5, 0.6, 0.02)];
    for (multiple, share, length) in cases {
        let x = share * depth;
        let area = 1.0 - 0.5 / multiple;
        let axial = width * limit * x * area;
        let edge = x * (0.5 - 0.5 / multiple + 1.0 / (6.0 * multiple * multiple)) / area;
        let moment = axial * (0.5 * depth - edge);
        let bent = multiple * limit / (young * x);

        let mut b = ModelBuilder::new();
        let material = b.material(one_sided(Slack::Tension, young, limit, None));
        let section = Section { fibres: 200, ..Section::rectangle("r", width, depth) };
        let section = b.section(section);
        let arm = b.beam(beam("arm", [0.0, 0.0], [length, 0.0], 4, material, section));
        b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
        let tip = at("tip", arm, 1.0);
        b.record_point(tip.clone());
        let kind = LoadKind::Point { at: tip, force: [-axial, 0.0], moment, follower: true };
        b.load(Load::new("end", kind));
        let found = equilibrium(&b.build().unwrap()).unwrap();
        let deflection = found.points[0].1[1];
        let expected = 0.5 * bent * length * length;
        // The axial force bends, too: its arm is the deflection, some thousandths of the eccentricity; and the block ends within a fibre.
        let miss = deflection / expected - 1.0;
        println!("m = {multiple}, x = {share} h: {miss:.2e}");
        assert!(miss.abs() < 1e-2, "m = {multiple}, x = {share} h: {deflection} {expected}");
    }
}

/// Any beam of it, struck at any speed.
fn struck(number: u64) -> (String, RunSummary) {
    let mut r = Numbers(number.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x0BAD_F00D);
    for _ in 0..8 {
        r.next();
    }
    let mut b = ModelBuilder::new();
    let young = r.decades(5e9, 5e10);
    let slack = if r.chance(0.6) { Slack::Tension } else { Slack::Compression };
    let failure = r.chance(0.3).then(|| r.decades(4e-3, 5e-2));
    let retardation = if r.chance(0.3) { r.decades(1e-7, 1e-5) } else { 0.0 };
    let material = one_sided(slack, young, young * r.decades(3e-4, 2e-3), failure);
    let material = b.material(Material { retardation, ..material });
    let depth = r.between(0.05, 0.3);
    let section = Section { fibres: 8, ..Section::rectangle("r", 0.2, depth) };
    let section = b.section(section);
    let wall = b.beam(beam("wall", [0.0, 0.0], [2.0, 0.0], 8, material, section));
    let ends = r.below(3);
    for f in [0.0, 1.0].into_iter().take(ends) {
        let kind = if r.chance(0.5) { SupportKind::Clamp } else { SupportKind::Pin };
        b.support(Support::new(format!("hold{f}"), at("held", wall, f), kind));
    }
    let kind = if r.chance(0.5) {
        ProjectileKind::spring(r.decades(1e6, 1e8))
    } else {
        ProjectileKind::Rigid { restitution: r.next() }
    };
    let strikes = at("struck", wall, r.between(0.2, 0.8));
    let velocity = [0.0, -r.decades(1.0, 40.0)];
    b.projectile(Projectile::new("shot", kind, r.decades(5.0, 500.0), velocity, strikes));
    let model = b.build().unwrap_or_else(|faults| panic!("wall {number}: {faults:?}"));
    let summary = simulate(&model, &Settings::new(4e-3, 2e-5), &mut NoRecorder).unwrap();
    (format!("wall {number}, {slack:?}, {failure:?}"), summary)
}

#[test]
fn walls_that_gape_and_crush_keep_their_balance_under_any_impact() {
    let (mut crushed, mut worst) = (0, 0.0_f64);
    for (name, summary) in (0..60).map(struck) {
        assert!(matches!(summary.termination, Termination::Completed), "{name}");
        worst = worst.max(summary.energy.residual_max);
        assert!(summary.energy.residual_max < 1e-10, "{name}: {:e}", summary.energy.residual_max);
        assert!(summary.momentum.linear_residual_max < 1e-10, "{name}");
        assert!(summary.energy.plastic >= 0.0, "{name}");
        crushed += usize::from(summary.energy.plastic > 0.01 * summary.energy.initial);
    }
    println!("{crushed} of 60 crushed, worst residual {worst:e}");
    assert!(crushed > 10, "{crushed}");
}

#[test]
fn materials_of_one_sign_have_neither_kinematic_hardening_nor_rate() {
    let mut b = ModelBuilder::new();
    let curve = vec![Hardening { from: 0.0, stress: 30e6, modulus: 0.0 }];
    let overstress = Some(Overstress { rate: 40.0, exponent: 5.0 });
    let law = Plasticity { curve, kinematic: 1e9, overstress, failure_strain: None };
    let inelasticity = Some(Inelasticity::OneSidedPlastic(Slack::Tension, law));
    let material = Material { inelasticity, ..one_sided(Slack::Tension, 30e9, 30e6, None) };
    let material = b.material(material);
    let section = b.section(Section::rectangle("r", 0.1, 0.1));
    b.beam(beam("wall", [0.0, 0.0], [2.0, 0.0], 4, material, section));
    let faults = b.build().unwrap_err();
    let paths: Vec<_> = faults.iter().map(|f| f.path.as_str()).collect();
    assert_eq!(paths, ["material.concrete.hardening.kinematic", "material.concrete.rate"]);
}
