//! `percuss static`: equilibrium, mechanisms.

use std::process::Command;

const CANTILEVER: &str = r#"
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

[load.tip]
kind = "point"
at = "arm.end"
force = [0, "-100 N"]

[record]
points = ["arm.end"]

[time]
end = "1 s"
step = "1 ms"
"#;

fn percuss(file: &std::path::Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_percuss"))
        .arg("static")
        .arg(file)
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

#[test]
fn a_cantilever_sags_by_the_hand_formula() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("arm.toml");
    let clamp = "\n[support.wall]\nat = \"arm.start\"\nkind = \"clamp\"\n";
    std::fs::write(&file, format!("{CANTILEVER}{clamp}")).unwrap();
    let (status, stdout, stderr) = percuss(&file, &["--json"]);
    assert_eq!(status, Some(0), "{stderr}");
    let found: serde_json::Value = serde_json::from_str(&stdout).unwrap();
    let sag = found["point"]["arm.end"]["displacement"][1].as_f64().unwrap();
    let hand = -100.0 * 8.0 / (3.0 * 210e9 * 8e-8); // P L^3 / 3 EI
    assert!((sag / hand - 1.0).abs() < 1e-3, "{sag} {hand}");
    let moment = found["section_forces"]["arm"]["moment_max"]["value"].as_f64().unwrap();
    assert!((moment / -200.0 - 1.0).abs() < 1e-3, "{moment}");
}

#[test]
fn a_mechanism_is_named_with_its_place() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("loose.toml");
    let pin = "\n[support.wall]\nat = \"arm.start\"\nkind = \"pin\"\n";
    std::fs::write(&file, format!("{CANTILEVER}{pin}")).unwrap();
    let (status, stdout, stderr) = percuss(&file, &[]);
    assert_eq!(status, Some(2), "{stderr}");
    assert!(stdout.is_empty());
    assert!(stderr.contains("loose.toml:10:"), "{stderr}");
    assert!(stderr.contains("mechanism") && stderr.contains("`arm`"), "{stderr}");
    assert!(stderr.contains("supports and joints"), "{stderr}");
}
