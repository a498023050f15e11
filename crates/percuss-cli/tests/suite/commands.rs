//! `check`, `new`, `schema`, `verify`, `completions`, and the world outside.

use crate::common;

use std::io::Read;
use std::process::Stdio;

use common::Sandbox;

#[test]
fn a_valid_scenario_is_counted_and_its_effective_mass_printed() {
    let sandbox = Sandbox::new();
    let elastic = sandbox.percuss(&["check", "elastic.toml"]);
    let counts = "elastic.toml: no errors; 1 beam, 6 elements, 7 nodes, 2 supports, 1 projectile, mass of the beams 900 kg, 1500 steps\n";
    assert_eq!(elastic.ends_with(0).stdout, counts);
    assert!(elastic.stderr.lines().all(|line| line.starts_with("note: ")), "{}", elastic.stderr);
    let rigid = sandbox.percuss(&["check", "rigid.toml", "--set", "beam.girder.elements=768"]);
    rigid.ends_with(0).tells("effective mass");
    assert!(rigid.stdout.contains("768 elements") && !rigid.stderr.contains("warning"));
    sandbox.percuss(&["check", "rigid.toml"]).ends_with(0).tells("warning: ");
    assert_eq!(sandbox.names(), ["elastic.toml", "rigid.toml"]);
}

#[test]
fn every_template_can_be_written_and_is_valid() {
    let sandbox = Sandbox::empty();
    let list = sandbox.percuss(&["new"]);
    list.ends_with(0);
    for line in list.stdout.lines() {
        let name = line.split_whitespace().next().expect("a name");
        let file = format!("{name}.toml");
        sandbox.percuss(&["new", name, "--out", &file]).ends_with(0).tells("and run: percuss ");
        sandbox.percuss(&["check", &file]).ends_with(0);
        let printed = sandbox.percuss(&["new", name]);
        assert_eq!(printed.stdout.as_bytes(), std::fs::read(sandbox.path(&file)).expect("a file"));
    }
    assert!(sandbox.names().len() >= 5);
    for name in ["study", "fit"] {
        assert!(list.stdout.contains(&format!("\n{name} ")), "{}", list.stdout);
    }
    // Files that are there already are kept.
    let kept = Sandbox::empty();
    kept.put("my.csv", "t [ms],F [kN],u [mm]\n8,0,0\n20,200,50\n40,300,80\n60,100,90\n");
    let written = kept.percuss(&["new", "fit", "--out", "fit.toml"]);
    written.ends_with(0).tells("my.toml written").tells("percuss fit fit.toml");
    assert!(!written.stderr.contains("my.csv"), "{}", written.stderr);
    assert_eq!(kept.names(), ["fit.toml", "my.csv", "my.toml"]);
    let checked = kept.percuss(&["check", "fit.toml"]);
    checked.ends_with(0);
    let counts = "3 free parameters, 1 test, 8 residuals";
    assert!(checked.stdout.contains(counts), "{}", checked.stdout);
}

#[test]
fn a_template_overwrites_nothing() {
    let sandbox = Sandbox::empty();
    sandbox.put("mine.toml", "precious");
    sandbox.percuss(&["new", "elastic", "--out", "mine.toml"]).ends_with(2).tells("exists already");
    assert_eq!(std::fs::read(sandbox.path("mine.toml")).expect("a file"), b"precious");
    sandbox
        .percuss(&["new", "elastic", "--out", "no/such/place.toml"])
        .ends_with(1)
        .tells("place.toml");
    sandbox.percuss(&["new", "--out", "mine.toml"]).ends_with(2).tells("TEMPLATE");
    // The base of a fit has that name.
    sandbox.percuss(&["new", "fit", "--out", "my.toml"]).ends_with(2).tells("give another --out");
    assert_eq!(sandbox.names(), ["mine.toml"]);
}

#[test]
fn the_schema_is_json() {
    let schema = Sandbox::empty().percuss(&["schema"]);
    let schema: serde_json::Value =
        serde_json::from_str(&schema.ends_with(0).stdout).expect("JSON alone");
    assert!(schema["properties"]["projectile"].is_object());
    let study = Sandbox::empty().percuss(&["schema", "--study"]);
    let study: serde_json::Value =
        serde_json::from_str(&study.ends_with(0).stdout).expect("JSON alone");
    assert!(study["properties"]["parameter"].is_object());
}

#[test]
fn verification_names_what_was_measured_and_expected() {
    let sandbox = Sandbox::empty();
    let one = sandbox.percuss(&["verify", "rigid-rod", "frequencies"]);
    one.ends_with(0).tells("2 cases").tells("all passed");
    assert_eq!(one.stdout.lines().count(), 3, "{}", one.stdout);
    assert!(one.stdout.contains("measured") && one.stdout.contains("tolerance"));
    let all = sandbox.percuss(&["verify", "rigid-rod", "--all-checks"]);
    assert!(all.ends_with(0).stdout.lines().count() > 3);
    let json = sandbox.percuss(&["verify", "rigid-rod", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json.stdout).expect("JSON alone");
    assert_eq!(json["holds"], true);
    assert!(json["cases"][0]["checks"][0]["expected"].is_number());
    let list = sandbox.percuss(&["verify", "--list"]);
    for case in percuss_verification::CASES {
        assert!(list.stdout.contains(case.id) && list.stdout.contains(case.title));
    }
}

#[test]
fn completions_know_the_commands_and_cases() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = Sandbox::empty().percuss(&["completions", shell]);
        assert!(script.ends_with(0).stdout.contains("verify"), "{shell}");
    }
    for shell in ["bash", "zsh"] {
        let script = Sandbox::empty().percuss(&["completions", shell]);
        assert!(script.stdout.contains("bouncing-ball"), "{shell}");
    }
}

#[test]
fn help_and_version_go_to_standard_output() {
    let sandbox = Sandbox::empty();
    let version = sandbox.percuss(&["--version"]);
    assert_eq!(version.ends_with(0).stdout, format!("percuss {}\n", env!("CARGO_PKG_VERSION")));
    for command in [
        "run",
        "check",
        "static",
        "modes",
        "sweep",
        "new",
        "schema",
        "report",
        "verify",
        "completions",
    ] {
        assert!(sandbox.percuss(&["--help"]).stdout.contains(command));
        assert!(sandbox.percuss(&[command, "--help"]).ends_with(0).stdout.contains("Usage"));
    }
    for command in ["run", "static", "modes", "sweep", "verify"] {
        assert!(sandbox.percuss(&[command, "--help"]).stdout.contains("Examples:"), "{command}");
    }
}

#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    let sandbox = Sandbox::empty();
    let mut child = sandbox.command(&["schema"]).spawn().expect("the command starts");
    let mut first = [0_u8; 1];
    let mut stdout = child.stdout.take().expect("a pipe");
    stdout.read_exact(&mut first).expect("a byte");
    drop(stdout);
    let mut reported = String::new();
    child.stderr.take().expect("a pipe").read_to_string(&mut reported).expect("UTF-8");
    assert_eq!((child.wait().expect("an end").code(), reported.as_str()), (Some(0), ""));
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_reported_in_one_line() {
    let sandbox = Sandbox::empty();
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("/dev/full");
    let output = sandbox.command(&["schema"]).stdout(Stdio::from(full)).output().expect("an end");
    let reported = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{reported}");
    assert!(reported.starts_with("error: standard output: cannot write: "), "{reported}");
    assert_eq!(reported.lines().count(), 1);
}
