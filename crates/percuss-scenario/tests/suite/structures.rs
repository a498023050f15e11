//! Materials, sections and beams: what they accept and what they say of the rest.

use percuss_scenario::{Content, Diagnostics, FileAccess, read, read_with};

pub const HEAD: &str = "[material.m]\nyoung = 1e9\ndensity = 1e3\n\
                    [section.s]\narea = 1\ninertia = 1\n";
pub const BEAM: &str = "[beam.b]\npoints = [[0, 0], [3, 0]]\nelements = 6\nmaterial = \"m\"\n\
                    section = \"s\"\n";
const TIME: &str = "[time]\nend = 1\nstep = 0.1\n";

pub fn file(parts: &[&str]) -> String {
    parts.concat() + TIME
}

#[track_caller]
pub fn good(text: &str) -> Content {
    let scenario = read(text, "f.toml").unwrap_or_else(|e| panic!("{text}\n{e}"));
    let again = read(&scenario.to_toml(), "again").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(again.content(), scenario.content());
    scenario.content().clone()
}

/// Reads, and compiles what reads.
fn faults(text: &str) -> Diagnostics {
    let read = read_with(text, "f.toml", FileAccess::Anywhere).and_then(|s| s.compile());
    read.map(|_| panic!("no fault in\n{text}")).unwrap_err()
}

/// All faults of a file.
#[track_caller]
pub fn bad(text: &str, expected: &[&str]) {
    let all = faults(text).to_string();
    let lines: Vec<&str> = all.lines().map(|l| l.trim_start_matches("f.toml:")).collect();
    assert_eq!(lines, expected);
}

#[test]
fn presets_give_their_yield_stress_where_asked() {
    let material = |text: &str| {
        file(&[
            "[section.s]\nshape = \"rectangle\"\nwidth = 1\ndepth = 1\n",
            BEAM,
            "[material.m]\n",
            text,
        ])
    };
    let content = good(&material("preset = \"steel\"\nyield = \"preset\"\nrate = \"preset\"\n"));
    let metal = &content.material[0].table;
    assert_eq!(metal.r#yield, Some(235e6));
    assert_eq!(metal.rate.as_ref().map(|rate| [rate.C, rate.q]), Some([40.4, 5.0]));
    assert_eq!(good(&material("preset = \"steel\"\n")).material[0].table.r#yield, None);
    bad(
        &material("preset = \"titanium\"\nyield = \"preset\"\nrate = \"preset\"\n"),
        &["13:8: material.m.rate: found \"preset\", and no rate constants of titanium known, \
           expected a table { C = ..., q = ... }"],
    );
    bad(
        &material("preset = \"glass\"\nyield = \"preset\"\n"),
        &["12:9: material.m.yield: found \"preset\", and no yield stress of glass known, \
           expected a pressure (Pa), such as \"0.2e10 Pa\""],
    );
    bad(
        &material("young = 1e9\ndensity = 1e3\nyield = \"preset\"\n"),
        &["13:9: material.m.yield: found \"preset\" of a material without one, \
           expected a pressure (Pa), such as \"0.2e10 Pa\""],
    );
}

#[test]
fn presets_fill_in_what_is_not_given() {
    let content = good(&file(&[
        "[material.m]\npreset = \"aluminium\"\ndensity = 2750\n",
        "[section.s]\narea = 1\ninertia = 1\n",
        BEAM,
    ]));
    let material = &content.material[0].table;
    assert_eq!((material.young, material.density), (Some(70e9), Some(2750.0)));
    let material =
        |text: &str| file(&["[section.s]\narea = 1\ninertia = 1\n", BEAM, "[material.m]\n", text]);
    let text = faults(&material("preset = \"aluminum\"\n")).to_string();
    assert!(
        text.starts_with(
            "f.toml:10:10: material.m.preset: found the text \"aluminum\", expected one of `steel`"
        ),
        "{text}"
    );
    assert!(text.ends_with("(did you mean `aluminium`?)"), "{text}");
    bad(
        &material("density = 1\n"),
        &["9:1: material.m.young: found no `young`, expected a pressure (Pa), such as \"0.2e10 \
             Pa\", or a `preset`"],
    );
    bad(
        &material("preset = \"steel\"\nretardation = \"1 m\"\nmass_damping = \"1 Hz\"\n"),
        &[
            "11:15: material.m.retardation: found \"1 m\", which is a length (m), expected a \
             time (s), such as \"0.15 s\"",
            "12:16: material.m.mass_damping: found \"1 Hz\", in Hz, expected a rate (1/s), such \
             as \"0.5 1/s\"",
        ],
    );
}

#[test]
fn a_misspelt_required_key_is_one_fault() {
    bad(
        &file(&[
            "[material.m]\nyuong = 1e9\ndensity = 1e3\n[section.s]\narae = 1\ninertia = 1\n",
            BEAM,
        ]),
        &[
            "2:1: material.m.yuong: found the unknown key `yuong`, expected one of `preset`, \
             `young`, `density`, `poisson`, `shear_modulus`, `strain`, `retardation`, `mass_damping`, `expansion`, `yield`, \
             `hardening`, `rate`, `failure_strain`, `bears` (did you mean `young`?)",
            "5:1: section.s.arae: found the unknown key `arae`, expected one of \
             `rotary_inertia`, `fibres`, `shear_factor`, `area`, `inertia`, `depth`, `shape` (did you mean `area`?)",
        ],
    );
    let text = file(&[HEAD, &BEAM.replace("elements", "elemnts")]);
    assert_eq!(faults(&text).all().len(), 1, "{}", faults(&text));
    let text = file(&[HEAD, BEAM, "[support.s]\nat = \"b.start\"\nknid = \"pin\"\n"]);
    assert_eq!(faults(&text).all().len(), 1, "{}", faults(&text));
    let text = file(&[HEAD, BEAM]).replace("[time]", "[tim]");
    assert_eq!(faults(&text).all().len(), 1, "{}", faults(&text));
    // A key that another table misses stays a fault.
    let text = file(&[HEAD, BEAM, "[section.t]\narea = 1\n"])
        .replace("area = 1\ninertia", "area = 1\ninerta");
    let all = faults(&text);
    let lines: Vec<usize> = all.all().iter().map(|d| d.line).collect();
    assert_eq!(lines, [6, 12], "{all}");
}

#[test]
fn sections_come_in_shapes() {
    let section =
        |text: &str| file(&[BEAM, "[material.m]\npreset = \"steel\"\n[section.s]\n", text]);
    for text in [
        "shape = \"explicit\"\narea = 1\ninertia = 1\ndepth = 1\n",
        "shape = \"rectangle\"\nwidth = \"1 cm\"\ndepth = 1\n",
        "shape = \"circle\"\ndiameter = 1\n",
        "shape = \"tube\"\ndiameter = 1\nthickness = 0.1\n",
        "shape = \"i\"\nwidth = 1\ndepth = 2\nflange = 0.1\nweb = 0.1\n",
        "shape = \"box\"\nwidth = 1\ndepth = 2\nthickness = 0.1\n",
        "shape = \"tapered\"\nstations = [0, 1]\nsections = [\"t\", \"t\"]\n[section.t]\narea = \
         1\ninertia = 1\n",
    ] {
        good(&section(text));
    }
    for (text, expected) in [
        (
            "area = 1\ninertia = 1\ndepth = 0\n",
            "11:9: section.s.depth: found 0 m, expected a depth above zero",
        ),
        (
            "shape = \"circle\"\ndiameter = -1\n",
            "10:12: section.s.diameter: found -1 m, expected a diameter above zero",
        ),
        (
            "shape = \"tube\"\ndiameter = 1\nthickness = 0.5\n",
            "11:13: section.s.thickness: found 0.5 m, expected less than half the diameter, 0.5 m",
        ),
        (
            "shape = \"i\"\nwidth = 1\ndepth = 2\nflange = 1\nweb = 0.1\n",
            "12:10: section.s.flange: found 1 m, expected less than half the depth, 1 m",
        ),
        (
            "shape = \"i\"\nwidth = 1\ndepth = 2\nflange = 0.1\nweb = 1.5\n",
            "13:7: section.s.web: found 1.5 m, expected less than the width, 1 m",
        ),
        (
            "shape = \"box\"\nwidth = 1\ndepth = 2\nthickness = 0.5\n",
            "12:13: section.s.thickness: found 0.5 m, expected less than half the smaller side, \
             0.5 m",
        ),
        (
            "shape = \"rectangle\"\nwidth = \"1 cm^2\"\ndepth = 1\n",
            "10:9: section.s.width: found \"1 cm^2\", which is an area (m^2), expected a length \
             (m), such as \"3 m\"",
        ),
        (
            "shape = \"tapered\"\nstations = [0, 0.5]\nsections = [\"t\", \
             \"t\"]\n[section.t]\narea = 1\ninertia = 1\n",
            "10:12: section.s.stations: found stations from 0 to 0.5, expected stations from 0 \
             to 1",
        ),
        (
            "shape = \"tapered\"\nstations = [0, 0.5, 0.5, 1]\nsections = [\"t\", \"t\", \"t\", \
             \"t\"]\n[section.t]\narea = 1\ninertia = 1\n",
            "10:12: section.s.stations: found 0.5 after 0.5, expected stations that increase",
        ),
        (
            "shape = \"tapered\"\nstations = [0, 1]\nsections = [\"t\"]\n[section.t]\narea = \
             1\ninertia = 1\n",
            "11:12: section.s.sections: found 1 section for 2 stations, expected a section for \
             each station",
        ),
        (
            "shape = \"tapered\"\nstations = [0, 1]\nsections = [\"t\", \
             \"s\"]\n[section.t]\narea = 1\ninertia = 1\n",
            "11:12: section.s.sections: found \"s\", which is tapered itself, expected sections \
             that do not vary along the beam",
        ),
        (
            "shape = \"tapered\"\nstations = [0, 1]\nsections = [\"t\", \
             \"tt\"]\n[section.t]\narea = 1\ninertia = 1\n",
            "11:18: section.s.sections: found the unknown section \"tt\", expected one of `s`, \
             `t` (did you mean `t`?)",
        ),
        // What follows from the section named is not reported again.
        (
            "shape = \"tapered\"\nstations = [0, 1]\nsections = [\"t\", \
             \"t\"]\n[section.t]\narea = 1\ninertia = 0\n",
            "14:11: section.t.inertia: found 0 m^4, expected a second moment of area above zero",
        ),
        (
            "shape = \"tapered\"\nstations = [0, 1]\nsections = [\"t\", \
             \"t\"]\n[section.t]\narea = 1\ninertia = \"1 m\"\n",
            "14:11: section.t.inertia: found \"1 m\", which is a length (m), expected a second \
             moment of area (m^4), such as \"8330 cm^4\"",
        ),
    ] {
        bad(&section(text), &[expected]);
    }
    let text = faults(&section("area = 1\ninertia = 1\nweb = 1\n")).to_string();
    assert!(
        text.contains("found `web`, which belongs to shape = \"i\", expected one of"),
        "{text}"
    );
    let text = faults(&section("shape = \"tub\"\n")).to_string();
    assert!(text.contains("(did you mean `tube`?)"), "{text}");
}

#[test]
fn fibres_are_listed_with_one_fault_for_each_slip() {
    let section = |text: &str| {
        let materials =
            "[material.m]\npreset = \"steel\"\n[material.soft]\nyoung = 1e10\ndensity = 1\n";
        file(&[BEAM, materials, "[section.s]\nshape = \"fibres\"\n", text])
    };
    good(&section("heights = [\"-1 cm\", 0.01]\nareas = [\"1 cm^2\", 1e-4]\n"));
    let two = "heights = [-0.01, 0.01]\nareas = [1e-4, 1e-4]\n";
    good(&section(&format!("{two}materials = [\"soft\", \"soft\"]\ndepth = \"3 cm\"\n")));
    let taper =
        "\n[section.t]\nshape = \"tapered\"\nstations = [0, 1]\nsections = [\"s\", \"s\"]\n";
    for (text, words) in [
        ("heights = [-0.01, 0.01]\nareas = [1e-4]\n".to_owned(), "found 1 area for 2 fibres"),
        ("heights = [-0.01, 0.01]\nareas = [1e-4, 0]\n".to_owned(), "expected areas above zero"),
        ("heights = []\nareas = []\n".to_owned(), "from 2 to 200 fibres"),
        (format!("{two}materials = [\"m\"]\n"), "found 1 material for 2 fibres"),
        (format!("{two}materials = [\"m\", \"sift\"]\n"), "the unknown material \"sift\""),
        (format!("{two}materials = [\"m\", \"soft\"]\n"), "measured from the elastic centroid"),
        (format!("{two}depth = \"1 cm\"\n"), "within half the depth of the centre line"),
        (format!("{two}depth = 0\n"), "a depth above zero"),
        (format!("{two}fibres = 8\n"), "whose fibres are listed"),
        (format!("{two}{taper}"), "which is made of fibres"),
    ] {
        let all = faults(&section(&text));
        let found = all.to_string();
        assert!(all.all().len() == 1 && found.contains(words), "{text}: {found}");
    }
}

fn beam(from: &str, to: &str) -> String {
    assert!(BEAM.contains(from));
    file(&[HEAD, &BEAM.replace(from, to)])
}

#[test]
fn elements_are_given_by_number_or_by_length() {
    let table = good(&beam("elements = 6", "element_length = \"10 cm\"")).beam[0].table.clone();
    assert_eq!((table.elements, table.element_length), (None, Some(0.1)));
    bad(
        &beam("elements = 6", "elements = 6\nelement_length = \"10 cm\""),
        &["10:18: beam.b.element_length: found `element_length` besides `elements`, expected \
             one of the two"],
    );
    bad(
        &beam("elements = 6\n", ""),
        &["7:1: beam.b.elements: found no number of elements, expected `elements`, such as 6, \
             or `element_length`, such as \"0.1 m\""],
    );
    bad(
        &beam("elements = 6", "element_length = \"10 cm^2\""),
        &["9:18: beam.b.element_length: found \"10 cm^2\", which is an area (m^2), expected a \
             length (m), such as \"3 m\""],
    );
}

#[test]
fn curves_gradings_and_changes_are_read() {
    let more = "elements = 6\ncurve = \"spline\"\ngrading = { towards = \"0.75 m\", ratio = 4 }\n\
                changes = [{ at = \"mid\", material = \"m\" }, { at = 0.75, section = \"s\" }]";
    good(&beam("elements = 6", more));
    good(&beam("elements = 6", "elements = 6\ngrading = 1"));
    let change = |text: &str| beam("elements = 6", &format!("elements = 6\n{text}"));
    bad(
        &change("curve = \"arch\""),
        &["10:9: beam.b.curve: found the text \"arch\", expected one of `polyline`, `arc`, \
             `spline` (did you mean `arc`?)"],
    );
    bad(
        &change("grading = { towards = \"middle\", ratio = \"2 m\" }"),
        &[
            "10:23: beam.b.grading.towards: found the text \"middle\", expected a place along \
             the beam: \"start\", \"mid\", \"end\", 0.25 or \"0.75 m\" (did you mean `mid`?)",
            "10:41: beam.b.grading.ratio: found \"2 m\", which is a length (m), expected a \
             number, such as 0.8",
        ],
    );
    bad(
        &change("grading = 3"),
        &["10:11: beam.b.grading: found the number 3, expected 1 or a table { towards = ..., \
             ratio = ... }"],
    );
    bad(
        &change(
            "changes = [{ at = \"3 kg\", section = \"s\" }, { at = 0.1 }, { section = \"x\" }]",
        ),
        &[
            "10:19: beam.b.changes.at: found `3 kg`, which is a mass (kg), expected a fraction \
             or a length, such as 0.25 or 0.75m",
            "10:44: beam.b.changes: found a change without a section or material, expected `section`, `material` or \
             both",
            "10:58: beam.b.changes.at: found no `at`, expected a place along the beam: \
             \"start\", \"mid\", \"end\", 0.25 or \"0.75 m\"",
            "10:70: beam.b.changes.section: found the unknown section \"x\", expected `s`",
        ],
    );
}

#[test]
fn points_come_from_files() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/f.toml");
    let text = beam("[[0, 0], [3, 0]]", "\"line.csv\"");
    let scenario = read(&text, folder).unwrap_or_else(|e| panic!("{e}"));
    let expected = [[0.0, 0.0], [1.0, 0.25], [2.0, 0.25], [3.0, 0.0]];
    assert_eq!(scenario.content().beam[0].table.points, expected);
    for (rows, found) in [
        ("0,0\n1,zwei\n", "a text, which is no finite number, in line 2 of \"FILE\""),
        ("x,y\n0,0\n\n1,2,3\n", "3 columns in line 4 of \"FILE\""),
        ("1\n2\n", "1 column in line 1 of \"FILE\""),
        ("0 0\n1 inf\n", "\"inf\", which is no finite number, in line 2 of \"FILE\""),
    ] {
        let name = format!("percuss-points-{}-{}.csv", std::process::id(), rows.len());
        let path = std::env::temp_dir().join(name);
        std::fs::write(&path, rows).unwrap();
        let path_text = path.display().to_string();
        let text = beam("[[0, 0], [3, 0]]", &format!("'{path_text}'"));
        let expected = format!(
            "8:10: beam.b.points: found {}, expected a CSV file with two columns, x and y (m)",
            found.replace("FILE", &path_text)
        );
        bad(&text, &[&expected]);
        std::fs::remove_file(path).unwrap();
    }
    bad(
        &beam("[[0, 0], [3, 0]]", "\"none.csv\""),
        &["8:10: beam.b.points: found \"none.csv\", which does not exist, expected a CSV file \
             with two columns, x and y (m)"],
    );
}

/// A motion acts where its support does; what would have no effect is a fault.
#[test]
fn motions_along_free_directions_are_refused() {
    let section = "[section.s]\nshape = \"rectangle\"\nwidth = 1\ndepth = 1\n";
    let material = "[material.m]\nyoung = 1e9\ndensity = 1e3\n";
    let held = "[support.l]\nat = \"b.start\"\nkind = \"clamp\"\n";
    let of = |kind: &str, motion: &str| {
        let ramp = "function = { kind = \"ramp\", duration = 0.5 }";
        let support = format!(
            "[support.r]\nat = \"b.end\"\n{kind}\nmotion = {{ displacement = {motion}, {ramp} }}\n"
        );
        file(&[material, section, BEAM, held, &support])
    };
    let across = "kind = \"elastic\"\nstiffness = [0, 1e6]";
    let both = "kind = \"elastic\"\nstiffness = [1e6, 1e6]";
    let stop = "kind = \"stop\"\ndirection = [0, -1]\nstiffness = 1e6";
    let slope = "kind = \"roller\"\ndirection = [1, 1]";
    for (kind, motion, free) in [
        ("kind = \"roller\"", "[0, 0.005]", false),
        ("kind = \"roller\"", "[0.005, 0]", true),
        ("kind = \"roller\"", "[0.005, 0.005]", true),
        (slope, "[0.005, -0.005]", false),
        (slope, "[0.005, 0]", true),
        (stop, "[0, 0.005]", false),
        (stop, "[0.001, 0.005]", true),
        (across, "[0, 0.005]", false),
        (across, "[0.005, 0]", true),
        (both, "[0.005, 0.003]", false),
        ("kind = \"pin\"", "[0.005, 0.003]", false),
        ("kind = \"fix\"\ncomponents = [2]", "[0.005, 0]", true),
    ] {
        let text = of(kind, motion);
        let built = read_with(&text, "f.toml", FileAccess::Anywhere).and_then(|s| s.compile());
        match built {
            Ok(_) => assert!(!free, "{kind}, {motion} is accepted"),
            Err(faults) => {
                let all = faults.coded();
                assert!(free && all.contains("support.r.motion"), "{kind}, {motion}: {all}");
                assert!(all.contains("E015"), "{all}");
            }
        }
    }
}
