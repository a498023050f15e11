//! Shear stresses and von Mises stresses of elastic sections of a known shape, against closed forms.

use crate::common;

use common::*;
use percuss::*;

/// Dead force across the tip \[N\]; strains are below 1e-6, so that second-order effects are below 1e-6.
const FORCE: f64 = 10.0;

fn material() -> Material {
    Material { poisson: Some(0.3), ..Material::new("m", 2e11, 7850.0) }
}

/// Section forces of a cantilever under a force across its tip, in equilibrium.
fn cantilever(
    length: f64,
    theory: Theory,
    material: Material,
    section: Section,
    force: f64,
) -> SectionForceSummary {
    let mut b = ModelBuilder::new();
    let (material, section) = (b.material(material), b.section(section));
    let slender = beam("arm", [0.0, 0.0], [length, 0.0], 4, material, section);
    let arm = b.beam(Beam { theory, ..slender });
    b.support(Support::new("root", at("root", arm, 0.0), SupportKind::Clamp));
    let (at, force) = (at("tip", arm, 1.0), [0.0, -force]);
    let kind = LoadKind::Point { at, force, moment: 0.0, follower: false };
    b.load(Load::new("tip", kind));
    equilibrium(&b.build().unwrap()).unwrap().section_forces.remove(0)
}

fn close(found: f64, known: f64) {
    assert!((found / known - 1.0).abs() < 2e-6, "{found} {known}");
}

/// `V Q/(I b)`, and `sqrt(sigma^2 + 3 tau^2)` at the root, of a short arm and of a long one.
#[test]
fn a_cantilever_has_the_stresses_of_its_shape() {
    let r3 = 3.0_f64.sqrt();
    for theory in [Theory::Slender, Theory::Shear] {
        for length in [0.02, 3.0] {
            // The shear stress is a multiple of the mean one.
            let check = |section: Section, multiple: f64| {
                let bending = 2e4;
                let force = bending * section.inertia / (0.5 * section.depth.unwrap() * length);
                let shear = multiple * force / section.area;
                let found = cantilever(length, theory, material(), section, force);
                close(found.shear_stress.largest().value.abs(), shear);
                close(found.stress.largest().value.abs(), bending);
                let most = found.von_mises();
                close(most.value, bending.max(r3 * shear));
                assert_eq!(found.shear_governs(), r3 * shear > bending);
                assert!(found.shear_governs() == (length < 0.1), "{length}: {found:?}");
                if length > 0.1 {
                    assert_eq!(most.s, 0.0);
                }
            };
            check(Section::rectangle("plate", 0.1, 0.2), 1.5);
            check(Section::circle("rod", 0.1), 4.0 / 3.0);
            // Of a thin wall 2, but for 2 (t/D)^2/3 of it.
            check(Section::tube("tube", 0.1, 1e-4), 2.0 * (1.0 - 2e-6 / 3.0));
        }
    }
}

/// Of an I of medium length the outer end of the web governs: neither the axis nor the extreme fibres.
#[test]
fn the_end_of_the_web_of_an_i_may_govern() {
    let (b, h, f, t, length) = (0.1_f64, 0.2_f64, 0.0085, 0.0056, 0.3);
    let clear = h - 2.0 * f;
    let inertia = (b * h.powi(3) - (b - t) * clear.powi(3)) / 12.0;
    let flange = b * (h * h - clear * clear) / 8.0;
    let (outer, most) = (
        FORCE * flange / (inertia * t),
        FORCE * (flange + t * clear * clear / 8.0) / (inertia * t),
    );
    let bent = |height: f64| FORCE * length * height / inertia;
    let found =
        cantilever(length, Theory::Shear, material(), Section::i_shape("i", b, h, f, t), FORCE);
    close(found.shear_stress.largest().value.abs(), most);
    let governs = bent(0.5 * clear).hypot(3.0_f64.sqrt() * outer);
    assert!(governs > bent(0.5 * h) && governs > 3.0_f64.sqrt() * most);
    close(found.von_mises().value, governs);
    assert_eq!(found.von_mises().s, 0.0);
}

#[test]
fn a_taper_has_its_largest_shear_stress_where_it_is_smallest() {
    let station = |at: f64, depth: f64| {
        let Section { area, inertia, depth, profile, .. } = Section::rectangle("r", 0.05, depth);
        Station { at, area, inertia, depth, profile, properties: Default::default() }
    };
    let stations = vec![station(0.0, 0.2), station(1.0, 0.1)];
    let taper = Section { stations, ..Section::rectangle("taper", 0.05, 0.2) };
    let found = cantilever(0.1, Theory::Slender, material(), taper, FORCE);
    let most = found.shear_stress.largest();
    close(most.value.abs(), 1.5 * FORCE / (0.05 * 0.1));
    assert_eq!(most.s, 0.1);
}

#[test]
fn sections_without_a_shape_and_beams_that_yield_have_no_shear_stress() {
    let plain = Section { depth: Some(0.2), ..Section::new("plain", 0.02, 6e-5) };
    let mut yields = material();
    yields.inelasticity = Some(Inelasticity::Plastic(Plasticity {
        curve: vec![Hardening { from: 0.0, stress: 3e8, modulus: 0.0 }],
        kinematic: 0.0,
        overstress: None,
        failure_strain: None,
    }));
    let plate = Section::rectangle("plate", 0.1, 0.2);
    for (material, section) in [(material(), plain), (yields, plate)] {
        let found = cantilever(0.5, Theory::Slender, material, section, FORCE);
        assert!(found.stress.max.value > 0.0, "{found:?}");
        assert!(found.shear_stress.max.value.is_nan() && found.von_mises().value.is_nan());
        assert!(!found.shear_governs() && found.beyond_inside.is_none());
    }
}

/// A short arm passes its strength by shear alone, if that is one that von Mises stresses are compared with.
#[test]
fn shear_alone_may_pass_a_strength() {
    let plate = || Section::rectangle("plate", 0.1, 0.2);
    let most = 3.0_f64.sqrt() * 1.5 * FORCE / 0.02;
    let found = |tension: f64, compression: f64| {
        let strength = Some(Strength { tension, compression });
        cantilever(0.03, Theory::Slender, Material { strength, ..material() }, plate(), FORCE)
    };
    let passed = found(0.999 * most, 0.999 * most);
    assert!(passed.beyond.is_none() && passed.shear_governs(), "{passed:?}");
    close(passed.beyond_inside.unwrap().value, most);
    assert!(found(1.001 * most, 1.001 * most).beyond_inside.is_none());
    assert!(found(0.999 * most, 0.998 * most).beyond_inside.is_none());
}

/// In a run the shear stress is that of the shear force, and no von Mises stress is less than the fibre stress.
#[test]
fn a_struck_beam_has_the_shear_stress_of_its_shear_force() {
    let mut b = ModelBuilder::new();
    let material = b.material(material());
    let section = b.section(Section::rectangle("bar", 0.1, 0.2));
    let bar = b.beam(beam("bar", [0.0, 0.0], [2.0, 0.0], 16, material, section));
    for end in [0.0, 1.0] {
        b.support(Support::new(format!("at {end}"), at("end", bar, end), SupportKind::Pin));
    }
    let struck = at("mid", bar, 0.53);
    b.projectile(Projectile::new("mass", ProjectileKind::spring(5e7), 50.0, [0.0, -4.0], struck));
    let model = b.build().unwrap();
    let run = simulate(&model, &Settings::new(0.02, 2e-5), &mut NoRecorder).unwrap();
    let found = &run.section_forces[0];
    for (shear, force) in
        [(found.shear_stress.min, found.shear.min), (found.shear_stress.max, found.shear.max)]
    {
        assert!(shear.value != 0.0 && (shear.s, shear.time) == (force.s, force.time), "{shear:?}");
        // The same product but for the order of its factors.
        assert!((shear.value * 0.02 / (1.5 * force.value) - 1.0).abs() < 1e-13);
    }
    let (most, fibre) = (found.von_mises(), found.stress.largest().value.abs());
    assert!(most.value >= fibre, "{most:?} {fibre}");
    let shear = found.shear_stress.largest().value.abs();
    assert!(found.von_mises_inside.value >= 3.0_f64.sqrt() * shear * (1.0 - 1e-13));
}
