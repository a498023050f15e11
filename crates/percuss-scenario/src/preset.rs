//! Materials known by name, with the published sources of their values.
//!
//! They are values for design: what a real piece of timber, concrete or laminate has differs from them, by tens of per
//! cent for some. Where the values matter, give `young` and `density` as measured.

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
}

/// The name of a material known by name.
pub(crate) struct Presets;

macro_rules! presets {
    ($($name:literal = $mega:literal MPa, $density:literal kg, $about:literal;)*) => {
        &[$((
            $name,
            Preset { name: $name, young: $mega as f64 * 1e6, density: $density as f64 },
            concat!($about, ": ", $mega, " MPa, ", $density, " kg/m^3"),
        )),*]
    };
}

impl Words for Presets {
    type Value = Preset;
    #[rustfmt::skip]
    const WORDS: &'static [(&'static str, Preset, &'static str)] = presets! {
        "steel" = 210_000 MPa, 7850 kg,
            "structural steel (EN 1993-1-1, 3.2.6; density EN 1993-1-2)";
        "stainless-steel" = 200_000 MPa, 7900 kg,
            "austenitic stainless steel 1.4301 (EN 10088-1)";
        "aluminium" = 70_000 MPa, 2700 kg,
            "aluminium alloys (EN 1999-1-1, 3.2.5)";
        "titanium" = 110_000 MPa, 4430 kg,
            "Ti-6Al-4V, annealed (MMPDS: 16.0e3 ksi, 0.160 lb/in^3)";
        "copper" = 117_000 MPa, 8940 kg,
            "oxygen-free copper C10200 (Copper Development Association: 17e3 ksi, 0.323 lb/in^3)";
        "brass" = 110_000 MPa, 8530 kg,
            "cartridge brass C26000 (Copper Development Association: 16e3 ksi, 0.308 lb/in^3)";
        "concrete" = 33_000 MPa, 2500 kg,
            "reinforced concrete C30/37, uncracked (EN 1992-1-1, table 3.1; density EN 1991-1-1)";
        "glass" = 70_000 MPa, 2500 kg,
            "soda lime silicate glass (EN 572-1)";
        "spruce" = 11_000 MPa, 420 kg,
            "softwood along the grain, class C24, mean values (EN 338)";
        "oak" = 11_000 MPa, 640 kg,
            "oak along the grain, class D30, mean values (EN 338)";
        "ash-wood" = 12_000 MPa, 670 kg,
            "white ash along the grain, the wood of bats, 12 % moisture (Wood Handbook, table 5-3)";
        "gfrp" = 23_000 MPa, 1900 kg,
            "pultruded glass fibre profiles, grade E23, lengthwise (EN 13706-3; density of equal volumes of E-glass and polyester)";
        "cfrp-ud" = 147_000 MPa, 1600 kg,
            "unidirectional carbon fibre AS4/3501-6, along the fibres (Daniel and Ishai 2006)";
        "nylon" = 3100 MPa, 1140 kg,
            "polyamide 66, dry; moist air halves its modulus (data sheet of Zytel 101L)";
    };
}
