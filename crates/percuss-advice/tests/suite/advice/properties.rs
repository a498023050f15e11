//! Magnitudes of shear moduli, shear factors, thermal expansion, given strains and foundations that are off by a unit.

use super::*;

/// A cantilever of 2 m, 0.1 m by 0.1 m, of a material and a shear factor.
fn cantilever(material: Material, shear_factor: Option<f64>) -> (ModelBuilder, BeamId) {
    let mut b = ModelBuilder::new();
    let material = b.material(material);
    let section = b.section(Section { shear_factor, ..Section::rectangle("bar", 0.1, 0.1) });
    let beam = b.beam(Beam::new("beam", &[[0.0, 0.0], [2.0, 0.0]], 4, material, section));
    hold(&mut b, beam, &SupportKind::Clamp, &[0.0]);
    (b, beam)
}

fn steel() -> Material {
    Material { expansion: 12e-6, ..Material::new("steel", 2.1e11, 7850.0) }
}

fn magnitude(b: &ModelBuilder) -> Option<Verdict> {
    verdict(&advise(&freeze(b), &Settings::new(0.01, 1e-5)), Topic::Magnitude)
}

/// Timber has E/16; a thousand times more or less, or what only some laminates have, is reported.
#[test]
fn shear_moduli_that_no_material_has_are_reported() {
    let cases = [
        (650e6, None),
        (5.5e9, None),
        (6e9, Some(Verdict::Note)),
        (650e9, Some(Verdict::Warning)),
        (65e6, Some(Verdict::Note)),
        (650e3, Some(Verdict::Warning)),
    ];
    for (modulus, reported) in cases {
        let timber =
            Material { shear_modulus: Some(modulus), ..Material::new("timber", 11e9, 450.0) };
        assert_eq!(magnitude(&cantilever(timber, Some(0.833)).0), reported, "{modulus} Pa");
    }
}

#[test]
fn shear_factors_above_one_are_reported() {
    for (factor, reported) in [(0.85, None), (1.0, None), (850.0, Some(Verdict::Warning))] {
        let steel = Material { shear_modulus: Some(8.1e10), ..steel() };
        assert_eq!(magnitude(&cantilever(steel, Some(factor)).0), reported, "{factor}");
    }
}

#[test]
fn thermal_expansions_of_no_solid_are_reported() {
    let cases = [(12e-6, None), (1.5e-4, Some(Verdict::Note)), (12e-3, Some(Verdict::Warning))];
    for (expansion, reported) in cases {
        let material = Material { expansion, ..steel() };
        assert_eq!(magnitude(&cantilever(material, None).0), reported, "{expansion} 1/K");
    }
}

#[test]
fn changes_of_temperature_and_strains_that_nothing_bears_are_reported() {
    let of = |kind: &dyn Fn(BeamId) -> LoadKind| {
        let (mut b, beam) = cantilever(steel(), None);
        b.load(Load::new("given", kind(beam)));
        magnitude(&b)
    };
    let stretch = [Along::Fraction(0.0), Along::Fraction(1.0)];
    for (change, reported) in [
        (80.0, None),
        (-290.0, None),
        (-400.0, Some(Verdict::Warning)),
        (3e4, Some(Verdict::Warning)),
    ] {
        let heat = |beam| LoadKind::Temperature { beam, stretch, change, gradient: 0.0 };
        assert_eq!(of(&heat), reported, "{change} K");
    }
    // A strain of 2 % is none of 1670 K.
    for (strain, reported) in
        [(5e-3, None), (0.02, None), (0.5, Some(Verdict::Warning)), (5.0, Some(Verdict::Warning))]
    {
        let given = |beam| LoadKind::Strain { beam, stretch, strain, curvature: 0.0 };
        assert_eq!(of(&given), reported, "{strain}");
    }
}

/// The beam weighs 78.5 kg/m; it sinks by its length of 2 m into 385 N/m^2, and EI/L^4 is 109 kN/m^2.
#[test]
fn foundations_that_no_ground_is_are_reported() {
    let linear = |stiffness: f64| FoundationLaw::Linear { stiffness };
    let table = |scale: f64| FoundationLaw::Table {
        deflection: vec![-10.0 * scale, 0.0, 5.0 * scale],
        reaction: vec![-5e3, 0.0, 6e4],
    };
    for (law, reported) in [
        (linear(2e7), None),
        (linear(2e4), None),
        (linear(380.0), Some(Verdict::Note)),
        (linear(1e15), Some(Verdict::Warning)),
        (table(1e-3), None),
        (table(1.0), Some(Verdict::Warning)),
    ] {
        let (mut b, beam) = cantilever(steel(), None);
        b.foundation(Foundation {
            name: "ground".to_owned(),
            beam,
            stretch: [Along::Fraction(0.0), Along::Fraction(1.0)],
            direction: None,
            law: law.clone(),
            damping: 0.0,
            yielding: None,
        });
        assert_eq!(magnitude(&b), reported, "{law:?}");
    }
}

/// Faces of aluminium on a foam: each has moduli of its own, and the mean over the area is that of neither.
#[test]
fn shear_moduli_of_layers_are_compared_with_their_own_young_moduli() {
    let of = |core_shear: f64| {
        let mut b = ModelBuilder::new();
        let face =
            b.material(Material { poisson: Some(0.33), ..Material::new("face", 7e10, 2700.0) });
        let shear_modulus = Some(core_shear);
        let core = b.material(Material { shear_modulus, ..Material::new("core", 6e7, 80.0) });
        let fibre = |height: f64, area: f64, material: MaterialId| SectionFibre {
            height,
            area,
            material: Some(material),
        };
        let fibres = vec![
            fibre(-0.0105, 6e-5, face),
            fibre(0.0105, 6e-5, face),
            fibre(-0.005, 6e-4, core),
            fibre(0.005, 6e-4, core),
        ];
        let layers = Section::of_fibres("layers", fibres);
        let section = b.section(Section { shear_factor: Some(0.0104), ..layers });
        let theory = Theory::Shear;
        let points = [[0.0, 0.0], [0.5, 0.0]];
        let panel = b.beam(Beam { theory, ..Beam::new("panel", &points, 4, face, section) });
        hold(&mut b, panel, &SupportKind::Clamp, &[0.0]);
        magnitude(&b)
    };
    assert_eq!(of(2.5e7), None);
    assert_eq!(of(2.5e10), Some(Verdict::Warning));
}

/// A bed that only pushes lies below the beam, or the weight pulls the beam off it.
#[test]
fn a_bed_above_the_weight_is_reported() {
    let of = |reversed: bool, direction: Option<[f64; 2]>, law: FoundationLaw, weight: f64| {
        let mut b = ModelBuilder::new();
        let material = b.material(Material::new("m", 30e9, 2500.0));
        let section = b.section(Section::rectangle("s", 1.0, 0.5));
        let points = if reversed { [[2.0, 0.0], [0.0, 0.0]] } else { [[0.0, 0.0], [2.0, 0.0]] };
        let beam = b.beam(Beam::new("footing", &points, 4, material, section));
        b.foundation(Foundation {
            name: "bed".into(),
            beam,
            stretch: [Along::Fraction(0.0), Along::Fraction(1.0)],
            direction,
            law,
            damping: 6e4,
            yielding: None,
        });
        b.load(Load::new("weight", LoadKind::Gravity { acceleration: [0.0, weight] }));
        verdict(&advise(&freeze(&b), &Settings::new(0.3, 1e-3)), Topic::Bed)
    };
    let bed = || FoundationLaw::Compression { stiffness: 5e6, gap: 0.0 };
    let warned = Some(Verdict::Warning);
    assert_eq!(of(true, None, bed(), -9.81), warned);
    assert_eq!(of(false, Some([0.0, -1.0]), bed(), -9.81), warned);
    assert_eq!(of(false, None, bed(), -9.81), None);
    assert_eq!(of(true, Some([0.0, 1.0]), bed(), -9.81), None);
    assert_eq!(of(true, None, FoundationLaw::Linear { stiffness: 5e6 }, -9.81), None);
    assert_eq!(of(true, None, bed(), 0.0), None);
}
