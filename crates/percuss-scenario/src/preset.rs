//! Materials known by name, with the published sources of their values.
//!
//! They are values for design: what a real piece of timber, concrete or laminate has differs from them, by tens of per
//! cent for some. Where the values matter, give `young` and `density` as measured.

use percuss::Strength;

use crate::words::Words;

/// A material known by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Its name in the file.
    pub name: &'static str,
    /// Young's modulus (Pa).
    pub young: f64,
    /// Density (kg/m^3).
    pub density: f64,
    /// Stresses that it usually bears.
    pub strength: Option<Strength>,
    /// Yield stress (Pa) of one that yields: what `yield = "preset"` stands for.
    pub yields: Option<f64>,
    /// Thermal expansion (1/K), where a standard gives it.
    pub expansion: Option<f64>,
    /// Strain at the largest force of a tension test, where it is known.
    pub uniform_strain: Option<f64>,
    /// Constants C (1/s) and q of Cowper and Symonds, shape (2) \[1/s, -\], where they have been measured: what `rate = "preset"` stands for.
    pub rate: Option<[f64; 2]>,
}

/// The name of a material known by name.
pub(crate) struct Presets;

impl Presets {
    /// The material of a name.
    pub fn named(name: &str) -> Option<Preset> {
        Self::WORDS.iter().find(|word| word.0 == name).map(|word| word.1)
    }
}

macro_rules! presets {
    ($($name:literal = $mega:literal MPa, $density:literal kg, [$($micro:literal)?], $bears:expr, $about:literal;)*) => {
        &[$((
            $name,
            Preset {
                name: $name,
                young: $mega as f64 * 1e6,
                density: $density as f64,
                strength: $bears.0,
                yields: $bears.1,
                rate: $bears.2,
                uniform_strain: $bears.3,
                expansion: expansion(&[$($micro as f64)?]),
            },
            concat!(
                $about, ": Young's modulus ", $mega, " MPa, density ", $density, " kg/m^3"
                $(, ", thermal expansion ", $micro, "e-6 1/K")?
            ),
        )),*]
    };
}

/// What a material bears, where it yields, how that depends on rates, and the strain at its largest force.
type Limits = (Option<Strength>, Option<f64>, Option<[f64; 2]>, Option<f64>);

/// What bears as much in tension as in compression (MPa), and does not yield.
const fn both(stress: f64) -> Limits {
    each(stress, stress)
}

/// What bears different stresses in tension and in compression (MPa).
const fn each(tension: f64, compression: f64) -> Limits {
    (Some(Strength { tension: 1e6 * tension, compression: 1e6 * compression }), None, None, None)
}

/// What yields at a stress (MPa), at higher ones with constants of Cowper and Symonds if there are any.
const fn metal(stress: f64, rate: Option<[f64; 2]>) -> Limits {
    (both(stress).0, Some(1e6 * stress), rate, None)
}

/// Hot rolled structural steel of given yield and tensile strength (MPa): its strain at the largest force is 0.6 (1 - yield/tensile), and at least
/// 0.06 (Yun and Gardner 2017, J. Constr. Steel Res. 133).
const fn hot_rolled(stress: f64, tensile: f64, rate: Option<[f64; 2]>) -> Limits {
    let strain = 0.6 * (1.0 - stress / tensile);
    (both(stress).0, Some(1e6 * stress), rate, Some(if strain > 0.06 { strain } else { 0.06 }))
}

/// A thermal expansion (1/K) from one in millionths, if there is one.
const fn expansion(millionths: &[f64]) -> Option<f64> {
    match millionths {
        [one, ..] => Some(*one / 1e6),
        [] => None,
    }
}

/// What has no usual strength.
const UNKNOWN: Limits = (None, None, None, None);

impl Words for Presets {
    type Value = Preset;
    #[rustfmt::skip]
    const WORDS: &'static [(&'static str, Preset, &'static str)] = presets! {
        // In brackets the thermal expansion in 1e-6/K (EN 1991-1-5, table C.1: structural steel, stainless steel, aluminium, concrete, timber along
        // the grain; glass EN 572-1).
        // Strength: yield stress of S235 (EN 1993-1-1, table 3.1). Rates: mild steel (Cowper and Symonds 1957; Jones 1989, table 8.1).
        "steel" = 210_000 MPa, 7850 kg, [12], hot_rolled(235.0, 360.0, Some([40.4, 5.0])),
            "structural steel, yield strength 235 MPa (EN 1993-1-1, 3.2.6; density EN 1993-1-2)";
        // Yield and tensile strength of thicknesses up to 40 mm (EN 1993-1-1, table 3.1).
        "S235" = 210_000 MPa, 7850 kg, [12], hot_rolled(235.0, 360.0, Some([40.4, 5.0])),
            "structural steel S235, yield strength 235 MPa (EN 1993-1-1, 3.2.6 and table 3.1; density EN 1991-1-1)";
        "S275" = 210_000 MPa, 7850 kg, [12], hot_rolled(275.0, 430.0, None),
            "structural steel S275, yield strength 275 MPa (EN 1993-1-1, 3.2.6 and table 3.1; density EN 1991-1-1)";
        "S355" = 210_000 MPa, 7850 kg, [12], hot_rolled(355.0, 490.0, None),
            "structural steel S355, yield strength 355 MPa (EN 1993-1-1, 3.2.6 and table 3.1; density EN 1991-1-1)";
        "S420" = 210_000 MPa, 7850 kg, [12], hot_rolled(420.0, 520.0, None),
            "structural steel S420 N or M, yield strength 420 MPa (EN 1993-1-1, 3.2.6 and table 3.1; density EN 1991-1-1)";
        "S450" = 210_000 MPa, 7850 kg, [12], hot_rolled(440.0, 550.0, None),
            "structural steel S450, yield strength 440 MPa (EN 1993-1-1, 3.2.6 and table 3.1; density EN 1991-1-1)";
        "S460" = 210_000 MPa, 7850 kg, [12], hot_rolled(460.0, 540.0, None),
            "structural steel S460 N or M, yield strength 460 MPa (EN 1993-1-1, 3.2.6 and table 3.1; density EN 1991-1-1)";
        // Proof stress of hot rolled plate (EN 10088-2). Rates: AISI 304 (Forrestal and Sagartz 1978; Jones 1989, table 8.1).
        "stainless-steel" = 200_000 MPa, 7900 kg, [16], metal(210.0, Some([100.0, 10.0])),
            "austenitic stainless steel 1.4301, yield strength 210 MPa (EN 10088-1)";
        // Proof stress of EN AW-6061 T6 (EN 1999-1-1, table 3.2b): alloys reach from 35 to some 300 MPa. Rates: 6061-T6 (Symonds 1965;
        // Jones 1989, table 8.1).
        "aluminium" = 70_000 MPa, 2700 kg, [24], metal(240.0, Some([6500.0, 4.0])),
            "aluminium alloys, yield strength 240 MPa (EN 1999-1-1, 3.2.5)";
        // Yield stress of annealed sheet (MMPDS: 120 ksi).
        "titanium" = 110_000 MPa, 4430 kg, [], metal(827.0, None),
            "Ti-6Al-4V, annealed, yield strength 827 MPa (MMPDS: 16.0e3 ksi, 0.160 lb/in^3)";
        // From soft to hard by a factor of five: no usual strength.
        "copper" = 117_000 MPa, 8940 kg, [], UNKNOWN,
            "oxygen-free copper C10200 (Copper Development Association: 17e3 ksi, 0.323 lb/in^3)";
        "brass" = 110_000 MPa, 8530 kg, [], UNKNOWN,
            "cartridge brass C26000 (Copper Development Association: 16e3 ksi, 0.308 lb/in^3)";
        // Mean tensile and characteristic compressive strength (EN 1992-1-1, table 3.1).
        "concrete" = 33_000 MPa, 2500 kg, [10], each(2.9, 30.0),
            "reinforced concrete C30/37, uncracked (EN 1992-1-1, table 3.1; density EN 1991-1-1)";
        // Mean tensile and characteristic compressive strength (EN 1992-1-1, table 3.1).
        "C12/15" = 27_000 MPa, 2500 kg, [10], each(1.6, 12.0),
            "reinforced concrete C12/15, uncracked, secant modulus (EN 1992-1-1, table 3.1; density EN 1991-1-1)";
        "C16/20" = 29_000 MPa, 2500 kg, [10], each(1.9, 16.0),
            "reinforced concrete C16/20, uncracked, secant modulus (EN 1992-1-1, table 3.1; density EN 1991-1-1)";
        "C20/25" = 30_000 MPa, 2500 kg, [10], each(2.2, 20.0),
            "reinforced concrete C20/25, uncracked, secant modulus (EN 1992-1-1, table 3.1; density EN 1991-1-1)";
        "C25/30" = 31_000 MPa, 2500 kg, [10], each(2.6, 25.0),
            "reinforced concrete C25/30, uncracked, secant modulus (EN 1992-1-1, table 3.1; density EN 1991-1-1)";
        "C30/37" = 33_000 MPa, 2500 kg, [10], each(2.9, 30.0),
            "reinforced concrete C30/37, uncracked, secant modulus (EN 1992-1-1, table 3.1; density EN 1991-1-1)";
        "C35/45" = 34_000 MPa, 2500 kg, [10], each(3.2, 35.0),
            "reinforced concrete C35/45, uncracked, secant modulus (EN 1992-1-1, table 3.1; density EN 1991-1-1)";
        "C40/50" = 35_000 MPa, 2500 kg, [10], each(3.5, 40.0),
            "reinforced concrete C40/50, uncracked, secant modulus (EN 1992-1-1, table 3.1; density EN 1991-1-1)";
        "C45/55" = 36_000 MPa, 2500 kg, [10], each(3.8, 45.0),
            "reinforced concrete C45/55, uncracked, secant modulus (EN 1992-1-1, table 3.1; density EN 1991-1-1)";
        "C50/60" = 37_000 MPa, 2500 kg, [10], each(4.1, 50.0),
            "reinforced concrete C50/60, uncracked, secant modulus (EN 1992-1-1, table 3.1; density EN 1991-1-1)";
        // Characteristic bending strength of float glass (EN 572-1).
        "glass" = 70_000 MPa, 2500 kg, [9], each(45.0, f64::INFINITY),
            "soda lime silicate glass (EN 572-1)";
        // Characteristic bending strengths of the classes (EN 338).
        "spruce" = 11_000 MPa, 420 kg, [5], both(24.0),
            "softwood along the grain, class C24, mean values (EN 338)";
        "oak" = 11_000 MPa, 640 kg, [5], both(30.0),
            "oak along the grain, class D30, mean values (EN 338)";
        // Modulus of rupture (Wood Handbook, table 5-3).
        "ash-wood" = 12_000 MPa, 670 kg, [5], both(103.0),
            "white ash along the grain, the wood of bats, 12 % moisture (Wood Handbook, table 5-3)";
        // Flexural strength lengthwise (EN 13706-3).
        "gfrp" = 23_000 MPa, 1900 kg, [], both(240.0),
            "pultruded glass fibre profiles, grade E23, lengthwise (EN 13706-3; density of equal volumes of E-glass and polyester)";
        // Along the fibres (Daniel and Ishai 2006).
        "cfrp-ud" = 147_000 MPa, 1600 kg, [], each(2280.0, 1725.0),
            "unidirectional carbon fibre AS4/3501-6, along the fibres (Daniel and Ishai 2006)";
        // Yield stress, dry (data sheet of Zytel 101L).
        "nylon" = 3100 MPa, 1140 kg, [], both(82.0),
            "polyamide 66, dry; moist air halves its modulus (data sheet of Zytel 101L)";
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    /// EN 1991-1-5, table C.1; glass EN 572-1.
    #[test]
    fn thermal_expansions_are_those_of_the_standards() {
        let of = |name: &str| Presets::named(name).unwrap().expansion;
        for (names, expansion) in [
            (&["steel", "S235", "S275", "S355", "S420", "S450", "S460"][..], 12e-6),
            (&["stainless-steel"], 16e-6),
            (&["aluminium"], 24e-6),
            (&["concrete", "C12/15", "C20/25", "C30/37", "C50/60"], 10e-6),
            (&["glass"], 9e-6),
            (&["spruce", "oak", "ash-wood"], 5e-6),
        ] {
            for name in names {
                assert_eq!(of(name), Some(expansion), "{name}");
            }
        }
        assert_eq!([of("copper"), of("gfrp"), of("nylon")], [None; 3]);
        let about = |name: &str| Presets::WORDS.iter().find(|word| word.0 == name).unwrap().2;
        assert!(about("S355").ends_with(" kg/m^3, thermal expansion 12e-6 1/K"));
        assert!(about("copper").ends_with(" kg/m^3"));
    }

    /// 0.6 (1 - 355/490) and the least value.
    #[test]
    fn structural_steels_have_the_strain_at_their_largest_force() {
        let of = |name: &str| Presets::named(name).unwrap().uniform_strain;
        assert!((of("S355").unwrap() - 0.165_306).abs() < 1e-6);
        assert!(of("S460").unwrap() > 0.06 && of("S460").unwrap() < of("S235").unwrap());
        assert_eq!([of("aluminium"), of("concrete"), of("copper")], [None; 3]);
    }

    #[test]
    fn materials_that_yield_say_where() {
        let mut yielding = 0;
        for (name, preset, about) in Presets::WORDS {
            let said = preset.yields.map(|stress| format!(", yield strength {} MPa", stress / 1e6));
            yielding += usize::from(said.is_some());
            match said {
                Some(said) => assert!(about.contains(&said), "{name}: {about}"),
                None => assert!(!about.contains("yield strength"), "{name}: {about}"),
            }
        }
        assert!(yielding >= 9, "{yielding}");
    }
}
