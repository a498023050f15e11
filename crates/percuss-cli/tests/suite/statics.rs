//! `percuss static`: equilibrium, reactions, buckling, mechanisms, paths.

use crate::common;

use std::process::Command;

use common::{Sandbox, names};

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
    // Results go beside the scenario unless a test says where.
    let output = Command::new(env!("CARGO_BIN_EXE_percuss"))
        .current_dir(file.parent().unwrap())
        .arg("static")
        .arg(file)
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

#[test]
fn a_hogging_cantilever_has_tension_at_its_top() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("arm.toml");
    let scenario = format!("{CANTILEVER}{CLAMP}")
        .replace("inertia = ", "depth = \"4 cm\"\ninertia = ")
        .replace("[\"arm.end\"]", "[\"arm.mid\"]");
    std::fs::write(&file, scenario).unwrap();
    let out = dir.path().join("out");
    let (status, stdout, stderr) = percuss(&file, &["--json", "--out", out.to_str().unwrap()]);
    assert_eq!(status, Some(0), "{stderr}");
    let found: serde_json::Value = serde_json::from_str(&stdout).unwrap();
    let mid = &found["section"]["arm.mid"];
    // M = -P L / 2, sigma = M y / I = 100 * 0.02 / 8e-8.
    for (key, exact) in [("moment", -100.0), ("stress_top", 25e6), ("stress_bottom", -25e6)] {
        assert!((mid[key].as_f64().unwrap() / exact - 1.0).abs() < 1e-3, "{key}: {mid}");
    }
}

#[test]
fn a_cantilever_sags_by_the_hand_formula() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("arm.toml");
    std::fs::write(&file, format!("{CANTILEVER}{CLAMP}")).unwrap();
    let out = dir.path().join("out");
    let out = out.to_str().unwrap();
    let (status, stdout, stderr) = percuss(&file, &["--json", "--out", out]);
    assert_eq!(status, Some(0), "{stderr}");
    let found: serde_json::Value = serde_json::from_str(&stdout).unwrap();
    let sag = found["point"]["arm.end"]["displacement"][1].as_f64().unwrap();
    let hand = -100.0 * 8.0 / (3.0 * 210e9 * 8e-8); // P L^3 / 3 EI
    assert!((sag / hand - 1.0).abs() < 1e-3, "{sag} {hand}");
    let slope = found["point"]["arm.end"]["rotation"].as_f64().unwrap();
    let by_hand = -100.0 * 4.0 / (2.0 * 210e9 * 8e-8); // P L^2 / 2 EI
    assert!((slope / by_hand - 1.0).abs() < 1e-3, "{slope} {by_hand}");
    let most = &found["largest_displacement"];
    assert!((most["value"].as_f64().unwrap() / -hand - 1.0).abs() < 1e-3, "{most}");
    assert!(most["beam"] == "arm" && most["s"].as_f64() == Some(2.0), "{most}");
    let moment = found["section_forces"]["arm"]["moment_max"]["value"].as_f64().unwrap();
    assert!((moment / -200.0 - 1.0).abs() < 1e-3, "{moment}");
    let forces = &found["section_forces"]["arm"];
    assert_eq!(forces["moment_max"], forces["moment"]["min"], "the larger magnitude, signed");
    assert!(forces["stress"]["max"]["value"].is_null(), "a section without a depth");
    let end = &found["section"]["arm.end"];
    assert!(end["stress_top"].is_null() && end["stress"].is_null(), "{end}");
    assert!((end["shear"].as_f64().unwrap().abs() / 100.0 - 1.0).abs() < 1e-3, "{end}");
    // The wall pushes up and turns against the load.
    let wall = &found["support"]["wall"];
    assert!((wall["force_2"].as_f64().unwrap() - 100.0).abs() < 1e-6, "{wall}");
    assert!((wall["moment"].as_f64().unwrap() - 200.0).abs() < 0.2, "{wall}");
    assert!(found["linear_buckling"].is_array());
    let (status, stdout, stderr) = percuss(&file, &["--out", out]);
    assert_eq!(status, Some(0), "{stderr}");
    assert!(stdout.contains("'wall': force") && stdout.contains("100 N"), "{stdout}");
    assert!(stdout.contains("largest displacement: ") && stdout.contains("rotation "), "{stdout}");
    assert!(!stdout.contains("fibre stress"), "{stdout}");
}

#[test]
fn a_column_buckles_at_eulers_load() {
    let sandbox = Sandbox::empty();
    let column = CANTILEVER.replace("[0, \"-100 N\"]", "[\"-1 kN\", 0]");
    sandbox.put("column.toml", format!("{column}{CLAMP}"));
    let found = sandbox.percuss(&["static", "column.toml", "--json"]);
    let value: serde_json::Value = serde_json::from_str(&found.ends_with(0).stdout).unwrap();
    let factor = value["linear_buckling"][0].as_f64().unwrap();
    let euler = std::f64::consts::PI.powi(2) * 210e9 * 8e-8 / 16.0 / 1000.0; // pi^2 EI / (2 L)^2
    assert!((factor / euler - 1.0).abs() < 1e-2, "{factor} {euler}");
    let text = sandbox.percuss(&["static", "column.toml"]);
    assert!(text.stdout.contains("linear buckling factor "), "{}", text.stdout);
    text.tells("runs/column-static");
    assert_eq!(names(&sandbox.path("runs/column-static")), ["static.html", "static.json"]);
    let kept = std::fs::read_to_string(sandbox.path("runs/column-static/static.json")).unwrap();
    assert_eq!(kept, found.stdout);
}

/// What a page draws.
fn index(page: &std::path::Path) -> serde_json::Value {
    let text = std::fs::read_to_string(page).unwrap();
    assert!(!text.contains("{{"), "a hole was left open");
    let (_, rest) = text.split_once("id=\"percuss-index\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn the_page_of_an_equilibrium_has_supports_loads_forces_and_the_buckling_mode() {
    let sandbox = Sandbox::empty();
    let column = CANTILEVER.replace("[0, \"-100 N\"]", "[\"-1 kN\", 0]");
    sandbox.put("column.toml", format!("title = \"</script><b>\"\n{column}{CLAMP}"));
    sandbox.percuss(&["static", "column.toml", "--out", "s"]).ends_with(0);
    let page = index(&sandbox.path("s/static.html"));
    let scene = &page["scenes"][0];
    assert_eq!(scene["scene"]["supports"][0]["kind"], "clamp");
    assert_eq!(scene["scene"]["loads"][0]["force"][0], -1000.0);
    let column = |name: &str| {
        let k = scene["frames"][name].as_u64().unwrap() as usize;
        page["columns"][k][1].as_u64().unwrap()
    };
    // The equilibrium and the mode, nine nodes, eight elements, one load.
    assert_eq!((column("time"), column("displacement")), (2, 2 * 9 * 4));
    assert_eq!((column("sections"), column("loads"), column("velocity")), (2 * 8 * 6, 2, 0));
    let details = &page["details"];
    assert_eq!((&details["kind"], &details["panels"][0]["shape"]), (&"static".into(), &1.into()));
    assert!(details["panels"][0]["about"].is_null(), "about the reference configuration");
    let text = std::fs::read_to_string(sandbox.path("s/static.html")).unwrap();
    assert!(text.contains("Stable equilibrium") && !text.contains("</script><b>"));
}

const CLAMP: &str = "\n[support.wall]\nat = \"arm.start\"\nkind = \"clamp\"\n";

const ARCH: &str = r#"
[material.spring]
preset = "steel"

[section.strip]
shape = "rectangle"
width = "40 mm"
depth = "3 mm"

[beam.arch]
points = [[0, 0], [0.5, 0.04], [1, 0]]
curve = "arc"
elements = 16
material = "spring"
section = "strip"

[support.left]
at = "arch.start"
kind = "pin"

[support.right]
at = "arch.end"
kind = "pin"

[load.crown]
kind = "point"
at = "arch.mid"
force = [0, "-1 kN"]

[record]
points = ["arch.mid"]

[time]
end = "1 s"
step = "1 ms"
"#;

#[test]
fn beyond_a_limit_point_the_path_is_reported_and_followed() {
    let sandbox = Sandbox::empty();
    sandbox.put("arch.toml", ARCH);
    let lost = sandbox.percuss(&["static", "arch.toml"]);
    lost.ends_with(3).tells("limit point").tells("percuss static --path");
    assert_eq!(sandbox.names(), ["arch.toml"], "nothing is written");
    let text = sandbox.percuss(&["static", "arch.toml", "--path"]);
    text.ends_with(0).tells("runs/arch-path");
    assert!(text.stdout.contains("limit point at load factor 0.16"), "{}", text.stdout);
    assert_eq!(
        names(&sandbox.path("runs/arch-path")),
        ["path.csv", "path.html", "path.json", "path.png", "path.svg"]
    );
    let page = index(&sandbox.path("runs/arch-path/path.html"));
    let (details, frames) = (&page["details"], &page["scenes"][0]["frames"]);
    let titles: Vec<&str> =
        details["panels"].as_array().unwrap().iter().filter_map(|p| p["title"].as_str()).collect();
    assert!(titles[0].starts_with("limit point at load factor 0.16"), "{titles:?}");
    assert!(titles.contains(&"end, at load factor 1"), "{titles:?}");
    assert_eq!(details["kind"], "path");
    let limit = details["chart"]["limits"][0].as_u64().unwrap() as usize;
    assert_eq!(details["panels"][0]["frame"], limit);
    let kept = details["chart"]["kept"].as_array().unwrap();
    assert!(kept[limit].as_f64().unwrap() > kept[limit - 1].as_f64().unwrap());
    // Configurations, and the buckling mode behind them.
    let time = &page["columns"][frames["time"].as_u64().unwrap() as usize];
    assert_eq!(time[1].as_u64().unwrap() as usize, kept.len() + 1);
    let csv = std::fs::read_to_string(sandbox.path("runs/arch-path/path.csv")).unwrap();
    let header = "factor,point.arch.mid.displacement_1,point.arch.mid.displacement_2,stable";
    assert_eq!(csv.lines().next(), Some(header));
    let json =
        sandbox.percuss(&["static", "arch.toml", "--path", "--json", "--out", "runs/arch-path"]);
    let value: serde_json::Value = serde_json::from_str(&json.ends_with(0).stdout).unwrap();
    assert_eq!(value["path"]["reached"], true);
    assert_eq!(value["path"]["factor"], 1.0);
    assert_eq!(value["path"]["points"].as_u64(), Some(csv.lines().count() as u64 - 1));
    let limit = &value["path"]["limit_points"][0];
    assert!(limit["factor"].as_f64().is_some_and(|f| (f - 0.16).abs() < 0.01), "{limit}");
    assert!(limit["point"]["arch.mid"]["displacement"][1].as_f64().is_some_and(|u| u < 0.0));
    let kept = std::fs::read_to_string(sandbox.path("runs/arch-path/path.json")).unwrap();
    assert_eq!(kept, json.stdout);
}

#[test]
fn a_path_that_ends_too_soon_is_written_and_fails() {
    let sandbox = Sandbox::empty();
    sandbox.put("arch.toml", format!("{ARCH}\n[path]\npoints = 3\n"));
    sandbox
        .percuss(&["static", "arch.toml", "--path", "--out", "p"])
        .ends_with(3)
        .tells("the path stopped at load factor ");
    assert!(sandbox.path("p/path.csv").is_file());
    sandbox.percuss(&["static", "arch.toml", "--out", "q"]).ends_with(3).tells("--path");
    assert!(!sandbox.path("q").exists(), "nothing is written");
}

#[test]
fn the_moment_that_the_green_law_cannot_carry_is_reported() {
    let sandbox = Sandbox::empty();
    let green = CANTILEVER
        .replace("young =", "strain = \"green\"\nyoung =")
        .replace("8 cm^4", "8000 cm^4")
        .replace("force = [0, \"-100 N\"]", "moment = \"30 MN m\"");
    sandbox.put("green.toml", format!("{green}{CLAMP}"));
    let found = sandbox.percuss(&["static", "green.toml"]);
    found.ends_with(3).tells("Green strains").tells("`arm`").tells("percuss static --path");
    assert_eq!(found.stdout, "");
}

#[test]
fn a_path_without_a_load_has_no_beginning() {
    let sandbox = Sandbox::empty();
    let (before, load) = CANTILEVER.split_once("[load.tip]").unwrap();
    let (_, after) = load.split_once("[record]").unwrap();
    sandbox.put("bare.toml", format!("{before}[record]{after}{CLAMP}"));
    sandbox.percuss(&["static", "bare.toml", "--path"]).ends_with(3).tells("a path begins with");
    assert_eq!(sandbox.names(), ["bare.toml"], "nothing is written");
}

#[test]
fn a_path_overwrites_no_run() {
    let sandbox = Sandbox::empty();
    sandbox.put("arch.toml", ARCH);
    sandbox
        .percuss(&["run", "arch.toml", "--set", "time.end=2e-3", "--out", "out", "-q"])
        .ends_with(0);
    sandbox
        .percuss(&["static", "arch.toml", "--path", "--out", "out"])
        .ends_with(2)
        .tells("contains other results (run)");
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

/// `P L / (2 I / depth)` at the root, against the 235 MPa at which structural steel yields.
#[test]
fn a_stress_beyond_the_strength_of_a_known_material_is_reported() {
    let arm = CANTILEVER
        .replace("young = \"210 GPa\"", "preset = \"steel\"")
        .replace("inertia = \"8 cm^4\"", "inertia = \"8 cm^4\"\ndepth = \"40 mm\"");
    let sandbox = Sandbox::new();
    let found = |force: f64, more: &str| {
        let text = arm.replace("\"-100 N\"", &format!("{force}"));
        sandbox.put("arm.toml", format!("{text}{CLAMP}{more}"));
        percuss(
            &sandbox.path("arm.toml"),
            &["--json", "--out", sandbox.path("out").to_str().unwrap()],
        )
    };
    let beyond = |stdout: &str| {
        let value: serde_json::Value = serde_json::from_str(stdout).unwrap();
        value["section_forces"]["arm"]["beyond_strength"].clone()
    };
    let (status, stdout, stderr) = found(-400.0, "");
    assert_eq!(status, Some(0), "{stderr}");
    assert!(beyond(&stdout).is_null() && !stderr.contains("W018"), "{stderr}");
    let (_, stdout, stderr) = found(-500.0, "");
    let (stress, hand) = (beyond(&stdout)["value"].as_f64().unwrap(), 500.0 * 2.0 * 0.02 / 8e-8);
    assert!((stress.abs() / hand - 1.0).abs() < 5e-3, "{stress:e} {hand:e}");
    assert_eq!(beyond(&stdout)["s"], 0.0);
    assert!(stderr.contains("warning: beam arm, usual strength exceeded: "), "{stderr}");
    assert!(
        stderr.contains(" MPa at s = 0 m (strength of the material 235 MPa)")
            && stderr.contains(". The material is modelled as elastic")
            && stderr.contains("[W018]")
    );
    let (_, _, stderr) = found(-500.0, "[allow]\nW018 = \"S355\"\n");
    assert!(!stderr.contains("warning") && stderr.contains("(reason: S355)"), "{stderr}");
}

/// What fails is reported with its load factor, and so is that nothing is left.
#[test]
fn failures_on_the_way_are_reported_with_their_load_factor() {
    let sandbox = Sandbox::empty();
    let spring = |load: &str| {
        let spring = "between = [\"arm.end\", [\"2 m\", \"1 m\"]]\nstiffness = \"100 kN/m\"\nyield_force = \"60 N\"\n";
        let arm = CANTILEVER.replace("-100 N", load);
        format!("{arm}{CLAMP}\n[spring.k]\n{spring}failure_extension = \"2 mm\"\n")
    };
    sandbox.put("arm.toml", spring("-200 N"));
    let found = sandbox.percuss(&["static", "arm.toml", "--json", "--out", "a"]);
    let value: serde_json::Value = serde_json::from_str(&found.ends_with(0).stdout).unwrap();
    assert_eq!(value["failures"][0]["name"], "spring.k");
    assert_eq!(value["failures"][0]["kind"], "extension");
    let factor = value["failures"][0]["factor"].as_f64().unwrap();
    // The arm takes 3 EI w / l^3, the spring what it flows at.
    let expected = (3.0 * 210e9 * 8e-8 * 2e-3 / 8.0 + 60.0) / 200.0;
    assert!((factor / expected - 1.0).abs() < 1e-3, "{factor} {expected}");
    let reaction = value["support"]["root"]["force_2"].as_f64();
    let only = value["support"].as_object().unwrap().values().next().unwrap();
    let reaction = reaction.or(only["force_2"].as_f64()).unwrap();
    assert!((reaction / 200.0 - 1.0).abs() < 1e-10, "{reaction}");
    let left = value["balance"]["unbalanced"][1].as_f64().unwrap();
    assert!(left.abs() < 1e-9 * 200.0, "{left}");
    let text = sandbox.percuss(&["static", "arm.toml", "--path"]);
    let reported = text.ends_with(0);
    assert!(reported.stdout.contains("`spring.k` fails at load factor"), "{}", reported.stdout);
}

/// A support that bears nothing beside springs to the ground that bear all: its reaction is zero, not the round-off of theirs.
#[test]
fn reactions_of_round_off_beside_springs_to_the_ground_are_zero() {
    let sandbox = Sandbox::empty();
    let foundation = "[foundation.bed]\non = \"arm\"\nstiffness = \"20 MN/m^2\"\n\n\
        [support.roller]\nat = \"arm.mid\"\nkind = \"fix\"\ncomponents = [1]\n\n[load.tip]";
    sandbox.put("bed.toml", CANTILEVER.replace("[load.tip]", foundation));
    let (status, out, _) = percuss(&sandbox.path("bed.toml"), &[]);
    assert_eq!(status, Some(0), "{out}");
    assert!(out.contains("'roller': force (x, y) = (0 N, 0 N), moment 0 N m"), "{out}");
}
