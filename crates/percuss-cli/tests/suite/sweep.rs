//! What `percuss sweep` promises.

use crate::common;

use std::process::{Command, Stdio};
use std::time::Duration;

use common::Sandbox;

const STUDY: &str = r#"
title = "Peak force over speed and mass"
base = "elastic.toml"
seed = 11

[parameter.speed]
path = "projectile.mass.velocity[1]"
distribution = { kind = "uniform", from = "10 m/s", to = "30 m/s" }

[parameter.mass]
path = "projectile.mass.mass"
range = { from = "400 kg", to = "600 kg" }

[design]
kind = "sobol"
runs = 96

[results]
peak_force = "contact.mass.peak_force.value"
"#;

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    std::fs::write(sandbox.path("study.toml"), STUDY).expect("a study");
    sandbox
}

#[test]
fn a_study_killed_three_times_ends_in_the_same_bytes() {
    let sandbox = sandbox();
    sandbox
        .percuss(&["sweep", "study.toml", "--out", "whole"])
        .ends_with(0)
        .tells("96 runs, 96 completed");
    let whole = std::fs::read(sandbox.path("whole/results.parquet")).expect("results");
    // Whatever the speed of the machine, some are killed at the start and some on the way.
    for pause in [30, 150, 400] {
        let mut sweep = Command::new(env!("CARGO_BIN_EXE_percuss"))
            .args(["sweep", "study.toml", "--out", "killed", "--quiet"])
            .current_dir(sandbox.path("."))
            .stderr(Stdio::null())
            .spawn()
            .expect("percuss");
        std::thread::sleep(Duration::from_millis(pause));
        sweep.kill().expect("SIGKILL");
        sweep.wait().expect("an end");
    }
    sandbox.percuss(&["sweep", "study.toml", "--out", "killed"]).ends_with(0);
    let killed = std::fs::read(sandbox.path("killed/results.parquet")).expect("results");
    assert!(whole == killed, "other bytes after three kills");
    assert!(sandbox.path("killed/report.html").exists());
}

/// Why a result has no Sobol indices is reported, and how many runs have a value: what never touched has no force.
#[test]
fn a_result_without_indices_says_why() {
    let sandbox = Sandbox::new();
    let study = STUDY
        .replace("runs = 96", "runs = 2\nsobol_indices = true")
        .replace("[results]", "[results]\nnever = \"contact.mass.intervals[7].impulse\"");
    sandbox.put("study.toml", study);
    let reported = sandbox.percuss(&["sweep", "study.toml", "--out", "out", "--json"]);
    assert_eq!(reported.status, Some(0), "{}", reported.stderr);
    let json: serde_json::Value = serde_json::from_str(&reported.stdout).expect("JSON alone");
    assert!(json["sobol_indices"]["never"].is_null(), "{json}");
    assert_eq!(json["sobol_indices_why"]["never"], "no run has a value");
    assert!(json["sobol_indices_why"]["peak_force"].is_null(), "{json}");
    assert_eq!(json["results"]["peak_force"]["values"], 8);
    let index = |which: &str| {
        let value = &json["sobol_indices"]["peak_force"]["parameter"]["speed"][which]["value"];
        format!("{:.2}", value.as_f64().expect("an index"))
    };
    sandbox
        .percuss(&["sweep", "study.toml", "--out", "out"])
        .ends_with(0)
        .tells("never: no Sobol' indices: no run has a value")
        .tells(&format!("(first, total): speed {}, {}; mass ", index("first"), index("total")));
}

#[test]
fn parts_of_a_study_make_the_whole() {
    let sandbox = sandbox();
    sandbox.percuss(&["sweep", "study.toml", "--out", "whole", "--quiet"]).ends_with(0);
    for part in ["2/3", "1/3"] {
        sandbox
            .percuss(&["sweep", "study.toml", "--out", "parts", "--shard", part])
            .ends_with(0)
            .tells("this shard is finished; others are not");
        assert!(!sandbox.path("parts/results.parquet").exists());
    }
    sandbox.percuss(&["sweep", "study.toml", "--out", "parts", "--shard", "3/3"]).ends_with(0);
    let results =
        |name: &str| std::fs::read(sandbox.path(name).join("results.parquet")).expect("results");
    assert!(results("whole") == results("parts"));
    sandbox.percuss(&["sweep", "study.toml", "--shard", "4/3"]).ends_with(2).tells("such as 3/20");
}

#[test]
fn a_changed_study_does_not_mix_with_an_old_one() {
    let sandbox = sandbox();
    sandbox.percuss(&["sweep", "study.toml", "--out", "out", "--quiet"]).ends_with(0);
    let changed = STUDY.replace("seed = 11", "seed = 12");
    std::fs::write(sandbox.path("study.toml"), changed).expect("a study");
    sandbox
        .percuss(&["sweep", "study.toml", "--out", "out"])
        .ends_with(2)
        .tells("belongs to another study")
        .tells("--out");
}

#[test]
fn check_warns_of_invalid_runs() {
    let sandbox = sandbox();
    sandbox.percuss(&["check", "study.toml"]).ends_with(0);
    let bad = STUDY.replace("from = \"400 kg\"", "from = \"-100 kg\"");
    std::fs::write(sandbox.path("bad.toml"), bad).expect("a study");
    sandbox
        .percuss(&["check", "bad.toml"])
        .ends_with(0)
        .tells("have a reason instead of results")
        .tells("projectile.mass.mass");
    sandbox.percuss(&["sweep", "bad.toml", "--out", "bad"]).ends_with(0).tells("warning: 1 run: ");
}

#[test]
fn faults_of_a_study_are_reported_by_line() {
    let sandbox = sandbox();
    let bad =
        STUDY.replace("velocity[1]", "velocty[1]").replace("peak_force.value", "peak_forc.value");
    std::fs::write(sandbox.path("bad.toml"), bad).expect("a study");
    sandbox
        .percuss(&["sweep", "bad.toml"])
        .ends_with(2)
        .tells("bad.toml:7:8: parameter.speed.path: found the unknown key `velocty`")
        .tells("did you mean `velocity`?")
        .tells("did you mean `peak_force`?");
    assert!(!sandbox.path("runs").exists());
}

#[test]
fn a_cluster_without_python_is_reported() {
    let sandbox = sandbox();
    let mut sweep = sandbox.command(&[
        "sweep",
        "study.toml",
        "--scheduler",
        "tcp://127.0.0.1:1",
        "--out",
        "out",
    ]);
    let ended = sweep.env("PERCUSS_PYTHON", "/nowhere/python").output().expect("percuss");
    let said = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(2), "{said}");
    assert!(
        said.contains("needs Python with percuss and Dask") && said.contains("/nowhere/python"),
        "{said}"
    );
    assert!(!sandbox.path("out").exists());
}

#[test]
fn a_kept_run_is_the_one_of_the_table_and_the_page_leads_to_it() {
    let sandbox = sandbox();
    sandbox
        .percuss(&["sweep", "study.toml", "--out", "s", "--keep-run", "96"])
        .ends_with(2)
        .tells("the study has runs 0 to 95");
    assert!(!sandbox.path("s").exists(), "refused before anything was run");
    sandbox.percuss(&["sweep", "study.toml", "--out", "s", "--keep-run", "17"]).ends_with(0);
    let study = percuss_study::Study::load(sandbox.path("study.toml")).expect("a study");
    let table = percuss_study::Folder::open(sandbox.path("s"), &study)
        .and_then(|folder| folder.results(&study))
        .expect("a table");
    let of_table = table.numbers("peak_force").expect("a column")[17];
    let peak = &sandbox.summary("s/kept/run-17")["contact"]["mass"]["peak_force"]["value"];
    let kept = peak.as_f64().expect("a force");
    assert!((kept / of_table - 1.0).abs() < 1e-9, "{kept} for {of_table}");
    // Another one later; the first stays on the page.
    sandbox.percuss(&["sweep", "study.toml", "--out", "s", "--keep-run", "3"]).ends_with(0);
    let page = std::fs::read_to_string(sandbox.path("s/report.html")).expect("a page");
    for run in ["run-3", "run-17"] {
        assert!(page.contains(&format!("href=\"kept/{run}/report.html\"")), "{run}");
        assert!(sandbox.path(&format!("s/kept/{run}/report.html")).is_file());
    }
}

#[cfg(unix)]
fn program(sandbox: &Sandbox, name: &str, text: &str) -> String {
    use std::os::unix::fs::PermissionsExt as _;
    sandbox.put(name, text);
    let path = sandbox.path(name);
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).expect("a program");
    path.to_string_lossy().into_owned()
}

#[cfg(unix)]
#[test]
fn a_cluster_that_leaves_no_results_is_no_success() {
    let sandbox = sandbox();
    let python = program(&sandbox, "idle", "#!/bin/sh\nexit 0\n");
    let mut command =
        sandbox.command(&["sweep", "study.toml", "--scheduler", "tcp://nowhere:1", "--out", "c"]);
    let done = command.env("PERCUSS_PYTHON", python).output().expect("percuss");
    let reported = String::from_utf8_lossy(&done.stderr).into_owned();
    assert_eq!(done.status.code(), Some(1), "{reported}");
    assert!(reported.contains("the sweep on the cluster ended without results"), "{reported}");
}

#[cfg(unix)]
#[test]
fn a_sweep_on_a_cluster_hands_on_a_signal() {
    let sandbox = sandbox();
    let script = "#!/bin/sh\ncase \"$2\" in *runpy*) ;; *) exit 0 ;; esac\n\
                  trap 'echo > told; exit 130' INT\n: > begun\nwhile :; do sleep 0.02; done\n";
    let python = program(&sandbox, "waits", script);
    let mut command =
        sandbox.command(&["sweep", "study.toml", "--scheduler", "tcp://nowhere:1", "--out", "c"]);
    let child = command.env("PERCUSS_PYTHON", python).spawn().expect("percuss");
    while !sandbox.path("begun").exists() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let sent = std::process::Command::new("kill").args(["-TERM", &child.id().to_string()]).status();
    assert!(sent.expect("kill").success());
    let done = child.wait_with_output().expect("an end");
    assert_eq!(done.status.code(), Some(130));
    assert!(sandbox.path("told").exists());
}

#[test]
fn modules_of_the_working_directory_are_not_run() {
    let sandbox = sandbox();
    for name in ["percuss.py", "distributed.py", "runpy.py"] {
        sandbox.put(name, "open('hijacked', 'w').close()\n");
    }
    let mut command =
        sandbox.command(&["sweep", "study.toml", "--scheduler", "tcp://127.0.0.1:1", "--out", "c"]);
    // An interpreter of its own: what is installed for the user does not matter.
    let done = command.env("PYTHONNOUSERSITE", "1").stdin(Stdio::null()).output();
    let done = done.expect("percuss");
    assert_ne!(done.status.code(), Some(0));
    assert!(!sandbox.path("hijacked").exists(), "a file of the working directory was run");
}
