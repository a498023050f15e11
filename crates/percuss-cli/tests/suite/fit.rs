//! `percuss fit`.

use crate::common::{Sandbox, names};

const FIT: &str = include_str!("../../../../scenarios/fits/young-of-a-swinging-beam.toml");
const BEAM: &str = include_str!("../../../../scenarios/fits/swinging-beam.toml");
const RECORD: &str = include_str!("../../../../scenarios/fits/swinging-beam.csv");

/// The published row of SDNL32, with a step five times as long.
fn sandbox() -> Sandbox {
    let sandbox = Sandbox::empty();
    sandbox.put("fit.toml", FIT);
    sandbox.put("swinging-beam.toml", BEAM.replace("10 us", "50 us"));
    sandbox.put("swinging-beam.csv", RECORD);
    sandbox
}

#[test]
fn the_modulus_behind_a_published_row_is_found_and_written() {
    let sandbox = sandbox();
    let check = sandbox.percuss(&["check", "fit.toml"]);
    check.ends_with(0);
    assert_eq!(check.stdout, "fit.toml: no errors; 1 free parameter, 1 test, 12 residuals\n");
    let fit = sandbox.percuss(&["fit", "fit.toml", "--out", "out", "--json"]);
    let value: serde_json::Value =
        serde_json::from_str(&fit.ends_with(0).stdout).expect("JSON alone");
    let young = &value["parameters"][0];
    // Rounded to two digits where it was published: 67 GPa, from a start of 60.7 GPa.
    let found = young["value"].as_f64().expect("a number");
    assert!((found / 67e9 - 1.0).abs() < 2e-3, "{found}");
    let end = |k: usize| young["interval"][k].as_f64().expect("a number");
    assert!(end(0) < 67e9 && end(1) > 67e9, "{young}");
    let files = names(&sandbox.path("out"));
    for name in ["curves.csv", "fit.html", "fit.json", "fit.txt", "fitted.toml"] {
        assert!(files.iter().any(|file| file == name), "{files:?}");
    }
    sandbox.percuss(&["check", "out/fitted.toml"]).ends_with(0);
    // Earlier results of a fit make room, what is not of one stays.
    let again = sandbox.percuss(&[
        "fit",
        "fit.toml",
        "--out",
        "out",
        "--profile",
        "young",
        "--profile",
        "young",
    ]);
    assert!(again.ends_with(0).stdout.contains("[parameters]"), "{}", again.stdout);
    assert!(again.stdout.contains("[profiles]\n  young  95 %: "), "{}", again.stdout);
    let text = std::fs::read_to_string(sandbox.path("out/fit.json")).expect("fit.json");
    let again: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(again["profiles"].as_array().map(Vec::len), Some(1));
    let profile = &again["profiles"][0];
    assert_eq!(profile["values"].as_array().map(Vec::len), Some(17));
    for k in [0, 1] {
        // Curves are nearly linear in the modulus within the interval.
        let [found, first] = [&profile["interval"][k], &young["interval"][k]].map(|v| v.as_f64());
        let (found, first) = (found.expect("a number"), first.expect("a number"));
        assert!((found / first - 1.0).abs() < 2e-5, "{found} {first}");
    }
    std::fs::create_dir(sandbox.path("mine")).expect("a directory");
    sandbox.put("mine/notes.txt", "precious");
    sandbox.percuss(&["fit", "fit.toml", "--out", "mine"]).ends_with(2).tells("[E203]");
}

#[test]
fn faults_of_a_fit_are_reported_with_their_places_and_nothing_is_written() {
    let sandbox = sandbox();
    sandbox.put(
        "wrong.toml",
        FIT.replace("swinging-beam.csv", "nothing.csv").replace("60.7 GPa", "60.7 m"),
    );
    for command in ["check", "fit"] {
        let reported = sandbox.percuss(&[command, "wrong.toml"]);
        reported.ends_with(2).tells("parameter.young.start").tells("test.published.data");
        reported.tells("where there is no file");
    }
    assert!(!sandbox.path("runs/wrong-fit").exists());
    // The command for another kind of file names the one for this.
    for command in ["sweep", "run"] {
        let refused = sandbox.percuss(&[command, "fit.toml"]);
        refused.ends_with(2).tells("a fit, which").tells("`percuss fit`");
    }
    let refused = sandbox.percuss(&["fit", "swinging-beam.toml"]);
    refused.ends_with(2).tells("a scenario, which").tells("`percuss run`");
    let changed = sandbox.percuss(&["check", "fit.toml", "--set", "time.step=1e-5"]);
    changed.ends_with(2).tells("[E317]").tells("give the values in the fit");
    let unknown = sandbox.percuss(&["fit", "fit.toml", "--profile", "yung", "--out", "out"]);
    unknown.ends_with(2).tells("no free parameter `yung` for --profile").tells("`young`");
    assert!(!sandbox.path("out").exists());
    let help = sandbox.percuss(&["fit", "--help"]);
    let status = "130  interrupted; nothing is written";
    assert!(help.ends_with(0).stdout.contains(status), "{}", help.stdout);
    let schema = sandbox.percuss(&["schema", "--fit"]);
    let schema: serde_json::Value =
        serde_json::from_str(&schema.ends_with(0).stdout).expect("JSON alone");
    assert!(schema["properties"]["test"].is_object());
    let explained = sandbox.percuss(&["explain", "test.align"]);
    assert!(explained.ends_with(0).stdout.contains("onset"), "{}", explained.stdout);
}

#[test]
fn a_start_whose_run_fails_ends_with_its_reason() {
    let sandbox = sandbox();
    let text = BEAM
        .replace("10 us", "50 us")
        .replace("stiffness = \"18 kN/m\"", "stiffness = \"1e300 N/m\"");
    sandbox.put("swinging-beam.toml", text);
    let fit = sandbox.percuss(&["fit", "fit.toml"]);
    fit.ends_with(3).tells("[E116]");
    assert!(!sandbox.path("runs/fit-fit").exists());
}
