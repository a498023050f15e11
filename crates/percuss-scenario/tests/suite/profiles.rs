//! Steel profiles and grades by name: their properties against published tables, and what is said of names that nothing has.

use percuss_scenario::content::SteelProfile;
use percuss_scenario::{Scenario, read};

use crate::structures::{bad, file, good};

const MATERIAL: &str = "[material.m]\npreset = \"S355\"\n";

/// A beam of a material and a section, by their names.
fn beam(material: &str, section: &str) -> String {
    format!(
        "[beam.b]\npoints = [[0, 0], [3, 0]]\nelements = 6\nmaterial = {material:?}\nsection = {section:?}\n"
    )
}

/// Area \[cm^2\], second moment of area \[cm^4\] and section modulus \[cm^3\] as published, within what relative error.
#[track_caller]
fn published(rows: &[(&str, [f64; 3])], most: f64) {
    for (name, [area, inertia, modulus]) in rows {
        let section = SteelProfile::find(name).expect(name).section("s");
        let w = section.inertia / (0.5 * section.depth.unwrap());
        let values =
            [(section.area, area * 1e-4), (section.inertia, inertia * 1e-8), (w, modulus * 1e-6)];
        for (found, right) in values {
            assert!((found / right - 1.0).abs() < most, "{name}: {found:e}, published {right:e}");
        }
    }
}

/// EN 10365: cm^2, cm^4 and cm^3 of a manufacturer's tables, with four digits.
const EUROPEAN: &[(&str, [f64; 3])] = &[
    ("IPE 80", [7.64, 80.1, 20.0]),
    ("IPE 100", [10.3, 171.0, 34.2]),
    ("IPE 120", [13.2, 318.0, 53.0]),
    ("IPE 140", [16.4, 541.0, 77.3]),
    ("IPE 160", [20.1, 869.0, 108.7]),
    ("IPE 180", [23.9, 1317.0, 146.3]),
    ("IPE 200", [28.5, 1943.0, 194.3]),
    ("IPE 220", [33.4, 2772.0, 252.0]),
    ("IPE 240", [39.1, 3892.0, 324.3]),
    ("IPE 270", [45.9, 5790.0, 428.9]),
    ("IPE 300", [53.8, 8356.0, 557.1]),
    ("IPE 330", [62.6, 11770.0, 713.1]),
    ("IPE 360", [72.7, 16270.0, 903.6]),
    ("IPE 400", [84.5, 23130.0, 1156.0]),
    ("IPE 450", [98.8, 33740.0, 1500.0]),
    ("IPE 500", [115.5, 48200.0, 1928.0]),
    ("IPE 550", [134.4, 67120.0, 2441.0]),
    ("IPE 600", [156.0, 92080.0, 3069.0]),
    ("HEA 100", [21.2, 349.0, 72.8]),
    ("HEA 120", [25.3, 606.0, 106.3]),
    ("HEA 140", [31.4, 1033.0, 155.4]),
    ("HEA 160", [38.8, 1673.0, 220.1]),
    ("HEA 180", [45.3, 2510.0, 293.6]),
    ("HEA 200", [53.8, 3692.0, 388.6]),
    ("HEA 220", [64.3, 5410.0, 515.2]),
    ("HEA 240", [76.8, 7763.0, 675.1]),
    ("HEA 260", [86.8, 10450.0, 836.4]),
    ("HEA 280", [97.3, 13670.0, 1013.0]),
    ("HEA 300", [112.5, 18260.0, 1260.0]),
    ("HEA 320", [124.4, 22930.0, 1479.0]),
    ("HEA 340", [133.5, 27690.0, 1678.0]),
    ("HEA 360", [142.8, 33090.0, 1891.0]),
    ("HEA 400", [159.0, 45070.0, 2311.0]),
    ("HEA 450", [178.0, 63720.0, 2896.0]),
    ("HEA 500", [197.5, 86970.0, 3550.0]),
    ("HEA 550", [211.8, 111900.0, 4146.0]),
    ("HEA 600", [226.5, 141200.0, 4787.0]),
    ("HEA 650", [241.6, 175200.0, 5474.0]),
    ("HEA 700", [260.5, 215300.0, 6241.0]),
    ("HEA 800", [285.8, 303400.0, 7682.0]),
    ("HEA 900", [320.5, 422100.0, 9485.0]),
    ("HEA 1000", [346.8, 553800.0, 11190.0]),
    ("HEB 100", [26.0, 450.0, 89.9]),
    ("HEB 120", [34.0, 864.0, 144.1]),
    ("HEB 140", [43.0, 1509.0, 215.6]),
    ("HEB 160", [54.3, 2492.0, 311.5]),
    ("HEB 180", [65.3, 3831.0, 425.7]),
    ("HEB 200", [78.1, 5696.0, 569.6]),
    ("HEB 220", [91.0, 8091.0, 735.5]),
    ("HEB 240", [106.0, 11260.0, 938.3]),
    ("HEB 260", [118.4, 14920.0, 1148.0]),
    ("HEB 280", [131.4, 19270.0, 1376.0]),
    ("HEB 300", [149.1, 25170.0, 1678.0]),
    ("HEB 320", [161.3, 30820.0, 1926.0]),
    ("HEB 340", [170.9, 36660.0, 2156.0]),
    ("HEB 360", [180.6, 43190.0, 2400.0]),
    ("HEB 400", [197.8, 57680.0, 2884.0]),
    ("HEB 450", [218.0, 79890.0, 3551.0]),
    ("HEB 500", [238.6, 107200.0, 4287.0]),
    ("HEB 550", [254.1, 136700.0, 4971.0]),
    ("HEB 600", [270.0, 171000.0, 5701.0]),
    ("HEB 650", [286.3, 210600.0, 6480.0]),
    ("HEB 700", [306.4, 256900.0, 7340.0]),
    ("HEB 800", [334.2, 359100.0, 8977.0]),
    ("HEB 900", [371.3, 494100.0, 10980.0]),
    ("HEB 1000", [400.0, 644700.0, 12890.0]),
];

#[test]
fn european_sections_have_the_published_properties() {
    published(EUROPEAN, 5e-3);
}

/// AISC Shapes Database, v15.0: in^2, in^4, in^3. Depth and flange are printed there with three digits: half a unit of the last one
/// changes the second moment of area by up to 1 %.
#[test]
fn american_wide_flanges_have_the_published_properties() {
    let rows = [
        ("W36X150", [44.3, 9040.0, 504.0]),
        ("W30X99", [29.0, 3990.0, 269.0]),
        ("W27X84", [24.7, 2850.0, 213.0]),
        ("W24X76", [22.4, 2100.0, 176.0]),
        ("W21X62", [18.3, 1330.0, 127.0]),
        ("W18X50", [14.7, 800.0, 88.9]),
        ("W16X26", [7.68, 301.0, 38.4]),
        ("W14X426", [125.0, 6600.0, 706.0]),
        ("W14X90", [26.5, 999.0, 143.0]),
        ("W14X22", [6.49, 199.0, 29.0]),
        ("W12X26", [7.65, 204.0, 33.4]),
        ("W12X65", [19.1, 533.0, 87.9]),
        ("W10X49", [14.4, 272.0, 54.6]),
        ("W8X31", [9.13, 110.0, 27.5]),
        ("W6X8.5", [2.52, 14.9, 5.1]),
        ("W4X13", [3.83, 11.3, 5.46]),
    ];
    let metric =
        |[a, i, w]: [f64; 3]| [a * 2.54_f64.powi(2), i * 2.54_f64.powi(4), w * 2.54_f64.powi(3)];
    published(&rows.map(|(name, values)| (name, metric(values))), 1e-2);
}

/// EN 10210-2, hot finished.
#[test]
fn hollow_sections_have_the_published_properties() {
    published(
        &[
            ("RHS 50x30x2.5", [3.68, 11.8, 4.73]),
            ("RHS 60x40x6.3", [10.6, 43.4, 14.5]),
            ("RHS 80x40x4", [8.79, 68.2, 17.1]),
            ("RHS 80x40x8", [16.0, 106.0, 26.5]),
            ("RHS 200x100x8", [44.8, 2234.0, 223.0]),
            ("RHS 300x200x10", [94.9, 11820.0, 788.0]),
            ("SHS 100x5", [18.7, 279.0, 55.9]),
            ("CHS 60.3x4", [7.07, 28.2, 9.34]),
            ("CHS 168.3x5", [25.7, 856.0, 102.0]),
            ("CHS 219.1x10", [65.7, 3598.0, 328.0]),
        ],
        5e-3,
    );
}

#[test]
fn a_name_may_be_written_in_several_ways() {
    let same = |names: &[&str]| {
        let sections: Vec<_> =
            names.iter().map(|name| SteelProfile::find(name).expect(name).section("s")).collect();
        assert!(sections.windows(2).all(|pair| pair[0] == pair[1]), "{names:?}");
    };
    same(&["IPE 200", "ipe200", "IPE-200"]);
    same(&["HEA 200", "HE 200 A", "he200a"]);
    same(&["HEB 200", "HE 200 B"]);
    same(&["W12x26", "W 12 X 26", "w12×26"]);
    same(&["SHS 100x5", "SHS 100x100x5", "RHS 100x100x5"]);
    for none in ["", "200", "IPE", "IPE 200x2", "W12", "CHS 10x5", "RHS 100x50x12.5", "HE 200 M"] {
        assert!(SteelProfile::find(none).is_none(), "{none}");
    }
}

fn compiled(text: &str) -> percuss::Model {
    let scenario: Scenario = read(text, "f.toml").unwrap_or_else(|e| panic!("{e}"));
    scenario.compile().unwrap_or_else(|e| panic!("{e}")).model
}

/// Mass of the beam, 3 m long, from that at its start \[kg\].
fn mass(model: &percuss::Model) -> f64 {
    3.0 * model.beam(0).span_at(0.0).section_at(0.0).mass
}

/// A table with `profile`, one with `shape` beside it, and the name in the beam itself.
#[test]
fn profiles_and_grades_need_no_table() {
    let direct = file(&[&beam("S355", "IPE 200")]);
    let table = |lines: &str| file(&[MATERIAL, "[section.s]\n", lines, &beam("m", "s")]);
    let area = SteelProfile::find("IPE 200").unwrap().section("s").area;
    for text in [
        direct,
        table("profile = \"IPE 200\"\n"),
        table("shape = \"profile\"\nprofile = \"IPE 200\"\nfibres = 24\n"),
    ] {
        good(&text);
        let found = mass(&compiled(&text));
        assert!((found / (7850.0 * 3.0 * area) - 1.0).abs() < 1e-12, "{found} in\n{text}");
    }
}

/// A table of the file comes before what is known by its name.
#[test]
fn a_table_of_the_file_comes_first() {
    let own =
        "[material.S355]\nyoung = 1e9\ndensity = 1000\n[section.IPE200]\narea = 1\ninertia = 1\n";
    let found = mass(&compiled(&file(&[own, &beam("S355", "IPE200")])));
    assert!((found - 3000.0).abs() < 1e-9, "{found}");
}

#[test]
fn profiles_stand_in_changes_and_tapers() {
    let taper = "[section.t]\nshape = \"tapered\"\nstations = [0, 1]\nsections = [\"IPE 200\", \"IPE 300\"]\n";
    good(&file(&[MATERIAL, taper, &beam("m", "t")]));
    compiled(&file(&[MATERIAL, taper, &beam("m", "t")]));
    let changes = "changes = [{ at = 0.5, section = \"HEB 200\", material = \"S460\" }]\n";
    compiled(&file(&[&beam("S235", "HEA 200"), changes]));
}

/// Sections that get a table are the same sections, also where a name of the file is taken.
#[test]
fn tables_of_profiles_change_nothing() {
    let taken = "[section.IPE_200]\narea = 1\ninertia = 1\n";
    let text = file(&[taken, &beam("S355", "IPE 200")]);
    let scenario = read(&text, "f.toml").unwrap().with_tables_of_profiles();
    let names: Vec<&str> =
        scenario.content().section.iter().map(|section| section.name.as_str()).collect();
    assert_eq!(names, ["IPE_200", "IPE_200_"]);
    assert_eq!(scenario.content().beam[0].table.section, "IPE_200_");
    let found = mass(&scenario.compile().unwrap().model);
    assert_eq!(found, mass(&compiled(&text)));
}

#[test]
fn an_unknown_profile_is_reported_with_those_near_it() {
    let profile = |name: &str, expected: &str| {
        let text = format!("[section.s]\nprofile = {name:?}\n");
        let expected = format!(
            "4:11: section.s.profile: found the unknown profile {name:?}, expected {expected}"
        );
        bad(&file(&[MATERIAL, &text, &beam("m", "s")]), &[&expected]);
    };
    profile("IPE 210", "a profile of its series, such as `IPE 200`, `IPE 220`, `IPE 180`");
    // A typing error, rather than the largest of its series.
    profile("IPE 2000", "a profile of its series, such as `IPE 200`, `IPE 600`, `IPE 500`");
    profile("W120x26", "a profile of its series, such as `W12x26`, `W10x26`, `W16x26`");
    profile("W12x27", "a profile of its series, such as `W12x26`, `W12x30`, `W12x22`");
    profile(
        "RHS 100x50x20",
        "depth, width and wall in mm, such as `RHS 200x100x8`, the wall below a quarter of the smaller side",
    );
    profile(
        "CHS 100x50",
        "diameter and wall in mm, such as `CHS 168.3x5`, the wall below half the diameter",
    );
    profile(
        "UPN 200",
        "a profile of the series IPE, HEA, HEB, W, RHS, SHS or CHS, such as \"IPE 200\", \"W12x26\", \
         \"RHS 200x100x8\" or \"CHS 168.3x5\"",
    );
    bad(
        &file(&[MATERIAL, &beam("m", "IPE 210")]),
        &[
            "7:11: beam.b.section: found the unknown profile \"IPE 210\", expected a profile of its series, such as \
           `IPE 200`, `IPE 220`, `IPE 180`; or the name of a section",
        ],
    );
    bad(
        &file(&[MATERIAL, &beam("m", "CHS 100x60")]),
        &[
            "7:11: beam.b.section: found the unknown profile \"CHS 100x60\", expected diameter and wall in mm, such as \
           `CHS 168.3x5`, the wall below half the diameter; or the name of a section",
        ],
    );
    bad(
        &file(&[MATERIAL, &beam("m", "HE 200")]),
        &[
            "7:11: beam.b.section: found the unknown profile \"HE 200\", expected a profile of the series HEA or HEB, such as \
           `HEA 200` or `HEB 200`; or the name of a section",
        ],
    );
    // Nothing is missed of the kind that stands where no profile is named.
    bad(
        &file(&[MATERIAL, "[section.s]\nprofil = \"IPE 200\"\n", &beam("m", "s")]),
        &["4:1: section.s.profil: found the unknown key `profil`, expected `profile`"],
    );
    // Neither a profile nor the beginning of one.
    bad(
        &file(&[MATERIAL, &beam("m", "web")]),
        &[
            "7:11: beam.b.section: found the unknown section \"web\", expected a table [section.web]",
        ],
    );
    bad(
        &file(&[MATERIAL, &beam("s355", "IPE 200")]),
        &[
            "6:12: beam.b.material: found the unknown material \"s355\", expected `m`, or the preset `S355`",
        ],
    );
}

/// EN 1993-1-1, table 3.1 and EN 1992-1-1, table 3.1.
#[test]
fn grades_have_the_values_of_their_standards() {
    let preset = |name: &str| {
        let text = format!("[material.m]\npreset = {name:?}\n");
        good(&file(&[&text, &beam("m", "IPE 200")])).material[0].table.preset.unwrap()
    };
    for (name, yields) in [
        ("S235", 235e6),
        ("S275", 275e6),
        ("S355", 355e6),
        ("S420", 420e6),
        ("S450", 440e6),
        ("S460", 460e6),
    ] {
        let steel = preset(name);
        assert_eq!((steel.young, steel.density, steel.yields), (210e9, 7850.0, Some(yields)));
    }
    // Ecm = 22 GPa (fcm / 10 MPa)^0.3, fcm = fck + 8 MPa; fctm = 0.3 fck^(2/3) MPa up to C50/60: rounded in the table.
    for (name, fck) in [
        ("C12/15", 12.0_f64),
        ("C16/20", 16.0),
        ("C20/25", 20.0),
        ("C25/30", 25.0),
        ("C30/37", 30.0),
        ("C35/45", 35.0),
        ("C40/50", 40.0),
        ("C45/55", 45.0),
        ("C50/60", 50.0),
    ] {
        let concrete = preset(name);
        let strength = concrete.strength.unwrap();
        assert_eq!((strength.compression, concrete.yields), (fck * 1e6, None));
        let tension = 0.3 * fck.powf(2.0 / 3.0) * 1e6;
        assert!((strength.tension - tension).abs() < 0.051e6, "{name}: {}", strength.tension);
        let young = 22e9 * ((fck + 8.0) / 10.0).powf(0.3);
        assert!((concrete.young - young).abs() < 0.51e9, "{name}: {}", concrete.young);
    }
}
