//! Faults of shear-flexible beams: what their materials, sections and supports need.

use crate::common;

use common::*;
use percuss::*;

/// Paths of the faults of a beam with the given parts.
fn faults(
    material: Material,
    section: Section,
    change: impl Fn(&mut ModelBuilder, BeamId),
) -> Vec<String> {
    let mut b = ModelBuilder::new();
    let (material, section) = (b.material(material), b.section(section));
    let slender = beam("arm", [0.0, 0.0], [1.0, 0.0], 2, material, section);
    let arm = b.beam(Beam { theory: Theory::Shear, ..slender });
    change(&mut b, arm);
    match b.build() {
        Ok(_) => Vec::new(),
        Err(faults) => faults.into_iter().map(|fault| fault.path).collect(),
    }
}

#[test]
fn shear_flexible_beams_need_shear_stiffness_and_rotary_inertia() {
    let bar = || Section::rectangle("s", 0.1, 0.2);
    let isotropic =
        |poisson: f64| Material { poisson: Some(poisson), ..Material::new("m", 2e11, 7850.0) };
    let steel = || isotropic(0.3);
    let none = |_: &mut ModelBuilder, _: BeamId| {};
    assert!(faults(steel(), bar(), none).is_empty());
    assert_eq!(faults(Material::new("m", 2e11, 7850.0), bar(), none), ["material.m.poisson"]);
    assert_eq!(faults(isotropic(0.6), bar(), none), ["material.m.poisson"]);
    let both = |shear: f64| Material { shear_modulus: Some(shear), ..steel() };
    // The isotropic one is 76.9 GPa; as tables round it, it may stand beside the ratio.
    assert!(faults(both(77e9), bar(), none).is_empty());
    assert_eq!(faults(both(7e8), bar(), none), ["material.m.shear_modulus"]);
    assert_eq!(faults(both(-7e8), bar(), none), ["material.m.shear_modulus"]);
    assert_eq!(faults(both(f64::NAN), bar(), none), ["material.m.shear_modulus"]);
    let bare = Section::new("s", 0.01, 1e-5);
    assert_eq!(faults(steel(), bare.clone(), none), ["section.s.shear_factor"]);
    assert!(faults(steel(), Section { shear_factor: Some(0.8), ..bare }, none).is_empty());
    let still = Section { rotary_inertia: RotaryInertia::Neglected, ..bar() };
    assert_eq!(faults(steel(), still, none), ["section.s.rotary_inertia"]);
    let slack =
        Material { inelasticity: Some(Inelasticity::OneSided(Slack::Compression)), ..steel() };
    assert!(faults(slack, bar(), none).is_empty());
    let stretch = |b: &mut ModelBuilder, arm: BeamId| {
        let kind = SupportKind::Fix { components: vec![Component::Stretch] };
        b.support(Support::new("end", at("end", arm, 1.0), kind));
    };
    assert_eq!(faults(steel(), bar(), stretch), ["support.end.components"]);
}
