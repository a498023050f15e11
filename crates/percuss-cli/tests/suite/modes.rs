//! `percuss modes`: frequencies, shapes on disk, what is wrong.

use crate::common;

use common::{Sandbox, names};
use serde_json::Value;

const BEAM: &str = r#"
title = "A plank"

[material.steel]
young = "210 GPa"
density = "7850 kg/m^3"

[section.flat]
area = "10 cm^2"
inertia = "8 cm^4"

[beam.arm]
points = [[0, 0], ["2 m", 0]]
elements = 8
material = "steel"
section = "flat"

[time]
end = "1 s"
step = "1 ms"
"#;
const CLAMP: &str = "\n[support.wall]\nat = \"arm.start\"\nkind = \"clamp\"\n";
const FILES: [&str; 5] = ["modes.html", "modes.json", "modes.png", "modes.svg", "shapes.csv"];

fn load(force: &str) -> String {
    format!("\n[load.tip]\nkind = \"point\"\nat = \"arm.end\"\nforce = {force}\n")
}

fn value(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON alone")
}

#[test]
fn a_cantilever_has_the_frequencies_of_the_textbook() {
    let sandbox = Sandbox::empty();
    sandbox.put("arm.toml", format!("{BEAM}{CLAMP}"));
    let found = sandbox.percuss(&["modes", "arm.toml", "--count", "3", "--json"]);
    let value = value(&found.ends_with(0).stdout);
    let modes = value["modes"].as_array().expect("modes");
    assert_eq!(modes.len(), 3);
    let scale = (210e9_f64 * 8e-8 / (7850.0 * 1e-3)).sqrt() / 4.0 / std::f64::consts::TAU;
    for (mode, root) in modes.iter().zip([1.8751041_f64, 4.6940911, 7.8547574]) {
        let frequency = mode["frequency"].as_f64().expect("a frequency");
        // Rotary inertia, which the textbook leaves out, lowers them a little.
        assert!((frequency / (root * root * scale) - 1.0).abs() < 3e-3, "{mode}");
        assert_eq!(mode["kind"], "vibration");
        let period = mode["period"].as_f64().expect("a period");
        assert!((period * frequency - 1.0).abs() < 1e-12);
    }
    assert_eq!((&value["about"], &value["stable"]), (&"reference".into(), &true.into()));
    assert_eq!(names(&sandbox.path("runs/arm-modes")), FILES);
    let kept = std::fs::read_to_string(sandbox.path("runs/arm-modes/modes.json")).expect("a file");
    assert_eq!(kept, found.stdout);
    let shapes =
        std::fs::read_to_string(sandbox.path("runs/arm-modes/shapes.csv")).expect("a file");
    assert_eq!(shapes.lines().count(), 1 + 3 * 9, "modes times nodes");
    let page = std::fs::read_to_string(sandbox.path("runs/arm-modes/modes.html")).expect("a file");
    assert!(page.contains("A plank") && page.contains("<svg") && !page.contains("{{"));
    let (_, index) = page.split_once("id=\"percuss-index\">").expect("what is drawn");
    let index: Value = self::value(index.split_once("</script>").expect("its end").0);
    assert_eq!(index["scenes"][0]["scene"]["supports"][0]["kind"], "clamp");
    let panels = index["details"]["panels"].as_array().expect("a panel each mode");
    assert_eq!(panels.len(), 3);
    assert_eq!((&panels[2]["shape"], &panels[2]["about"]), (&3.into(), &0.into()));
}

#[test]
fn a_beam_in_flight_has_three_motions_of_a_rigid_body() {
    let sandbox = Sandbox::empty();
    sandbox.put("free.toml", BEAM);
    let found = sandbox.percuss(&["modes", "free.toml", "--count", "4", "--out", "m"]);
    found.ends_with(0).tells("results  m");
    assert_eq!(found.stdout.matches("rigid-body mode").count(), 3, "{}", found.stdout);
    let about_static = sandbox.percuss(&["modes", "free.toml", "--about", "static"]);
    about_static.ends_with(2).tells("mechanism");
}

#[test]
fn stresses_count_about_a_static_equilibrium() {
    let sandbox = Sandbox::empty();
    sandbox
        .put("pulled.toml", format!("{BEAM}start = \"static\"\n{CLAMP}{}", load("[\"20 kN\", 0]")));
    let first = |arguments: &[&str]| {
        let found = sandbox.percuss(&[&["modes", "pulled.toml", "--json"], arguments].concat());
        let value = value(&found.ends_with(0).stdout);
        (value["about"].clone(), value["modes"][0]["frequency"].as_f64().expect("a frequency"))
    };
    let (about, tight) = first(&[]);
    assert_eq!(about, "static", "as the scenario starts");
    let (about, loose) = first(&["--about", "reference"]);
    assert_eq!(about, "reference");
    assert!(tight > 1.2 * loose, "{tight} {loose}");
}

#[test]
fn a_column_beyond_eulers_load_is_unstable() {
    let sandbox = Sandbox::empty();
    // Euler's load is pi^2 EI / (2 L)^2 = 10.36 kN.
    sandbox.put("column.toml", format!("{BEAM}{CLAMP}{}", load("[\"-10.6 kN\", 0]")));
    let arguments = ["modes", "column.toml", "--about", "static", "--count", "2"];
    let found = sandbox.percuss(&[&arguments[..], &["--json"]].concat());
    found.ends_with(0).tells("unstable equilibrium: 1 unstable mode");
    let value = value(&found.stdout);
    assert_eq!(value["stable"], false);
    let first = &value["modes"][0];
    assert_eq!(first["kind"], "unstable");
    assert!(first["frequency"].is_null() && first["period"].is_null(), "{first}");
    assert!(first["eigenvalue"].as_f64().is_some_and(|e| e < 0.0), "{first}");
    assert_eq!(value["modes"][1]["kind"], "vibration");
    let table = sandbox.percuss(&arguments);
    assert!(table.stdout.contains("unstable mode"), "{}", table.stdout);
}

/// NAFEMS FV5: sections rotate without deflection at the cut-off frequency, which is the tenth mode.
#[test]
fn modes_of_the_second_spectrum_are_named() {
    let sandbox = Sandbox::empty();
    let pins = ["start", "end"]
        .map(|end| format!("\n[support.{end}]\nat = \"arm.{end}\"\nkind = \"pin\"\n"));
    let deep = BEAM
        .replace("210 GPa\"", "200 GPa\"\npoisson = 0.3")
        .replace("7850", "8000")
        .replace("\"10 cm^2\"", "4\nshear_factor = 0.849673")
        .replace("\"8 cm^4\"", "1.3333333333333333")
        .replace("\"2 m\"", "10")
        .replace("elements = 8", "elements = 64\ntheory = \"shear\"");
    sandbox.put("deep.toml", format!("{deep}{}", pins.concat()));
    let arguments = ["modes", "deep.toml", "--count", "11"];
    let found = sandbox.percuss(&[&arguments[..], &["--json"]].concat());
    let value = value(&found.ends_with(0).stdout);
    let modes = value["modes"].as_array().expect("modes");
    let second: Vec<bool> = modes.iter().map(|m| m["second_spectrum"] == true).collect();
    assert_eq!(second, [vec![false; 9], vec![true; 2]].concat());
    let cut_off = (0.849673 * 200e9 / 2.6 * 3.0 / 8000.0_f64).sqrt() / std::f64::consts::TAU;
    let tenth = modes[9]["frequency"].as_f64().expect("a frequency");
    assert!((tenth / cut_off - 1.0).abs() < 1.1e-3, "{tenth} {cut_off}");
    let table = sandbox.percuss(&arguments).stdout;
    assert_eq!(table.matches("second spectrum").count(), 2, "{table}");
}

#[test]
fn wrong_input_is_reported_and_nothing_written() {
    let sandbox = Sandbox::empty();
    sandbox.put("arm.toml", format!("{BEAM}{CLAMP}"));
    sandbox.percuss(&["modes", "arm.toml", "--count", "0"]).ends_with(2).tells("--count");
    sandbox.percuss(&["modes", "arm.toml", "--about", "nothing"]).ends_with(2).tells("reference");
    sandbox.percuss(&["modes", "none.toml"]).ends_with(2).tells("none.toml");
    sandbox.put("notes.txt", "mine");
    sandbox.percuss(&["modes", "arm.toml", "--out", "."]).ends_with(2).tells(".percuss.json");
    sandbox
        .percuss(&["modes", "arm.toml", "--out", "notes.txt"])
        .ends_with(2)
        .tells("not a directory");
    assert_eq!(sandbox.names(), ["arm.toml", "notes.txt"]);
}

#[test]
fn more_modes_than_the_mesh_has_are_fewer() {
    let sandbox = Sandbox::empty();
    sandbox.put("arm.toml", format!("{BEAM}{CLAMP}").replace("elements = 8", "elements = 1"));
    let found = sandbox.percuss(&["modes", "arm.toml", "--count", "50", "--json"]);
    let modes = value(&found.ends_with(0).stdout)["modes"].as_array().map_or(0, Vec::len);
    assert!((1..=8).contains(&modes), "{modes}");
}
