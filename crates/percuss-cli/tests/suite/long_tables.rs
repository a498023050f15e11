//! A table of many rows is named in the results, not copied; what was computed with it can be run again, extended and resumed.

use std::fmt::Write as _;
use std::fs;

use crate::common::{ELASTIC, Sandbox};

const ROWS: usize = 20_000;

/// A load that follows a table of many rows, of another amplitude each time.
fn table(amplitude: u32) -> String {
    (0..ROWS).fold(String::new(), |mut text, k| {
        let _ = writeln!(text, "{:.7}, {}", 1e-5 * k as f64, amplitude * (k as u32 % 100));
        text
    })
}

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::empty();
    fs::create_dir_all(sandbox.path("in")).unwrap();
    let load = "\n[load.pull]\nkind = \"point\"\nat = \"girder.mid\"\nforce = [0, 1]\nfunction = { kind = \"table\", file = \"pull.csv\" }\n";
    sandbox.put("in/pulled.toml", format!("{ELASTIC}{load}"));
    sandbox.put("in/pull.csv", table(1));
    sandbox
}

#[test]
fn nothing_of_it_is_copied_and_the_results_are_run_again_and_extended() {
    let sandbox = sandbox();
    let run = |file: &str, more: &[&str]| {
        sandbox.percuss(&[&["run", file, "--quiet", "--set", "time.end=0.02"], more].concat())
    };
    run("in/pulled.toml", &["--out", "a", "--checkpoint", "1 h"]).ends_with(0);
    let echo = fs::read_to_string(sandbox.path("a/scenario.toml")).unwrap();
    assert!(echo.contains("pull.csv\", sha256 = \""), "{echo}");
    assert!(echo.len() < 4000, "{} bytes", echo.len());
    // The time of a row in the middle stands nowhere: not on the page, nor in what describes the history and the scene.
    let row = "0.10037";
    assert!(table(1).contains(row));
    for name in ["report.html", "summary.json", "fields/scene.json"] {
        assert!(!fs::read_to_string(sandbox.path("a").join(name)).unwrap().contains(row), "{name}");
    }
    let history = fs::metadata(sandbox.path("a/history.parquet")).unwrap().len();
    assert!(history < 2_000_000, "{history} bytes");
    run("a/scenario.toml", &["--out", "b"]).ends_with(0);
    let energy = |name: &str| sandbox.summary(name)["energy"].clone();
    assert_eq!(energy("a"), energy("b"));
    sandbox.percuss(&["extend", "a", "--end", "0.03", "--out", "c", "--quiet"]).ends_with(0);
    sandbox.put("in/pull.csv", table(2));
    let reported =
        "outside the folder of this file and is not there with the content that `sha256` says";
    sandbox.percuss(&["extend", "a", "--end", "0.04", "--quiet"]).ends_with(2).tells(reported);
    run("a/scenario.toml", &["--out", "b"]).ends_with(2).tells("[E023]");
    let open = run("a/scenario.toml", &["--out", "b", "--allow-outside"]);
    open.ends_with(2).tells("pull.csv\", which has changed: its SHA-256 is ");
}

#[test]
fn a_run_does_not_go_on_with_another_table() {
    let sandbox = sandbox();
    let run = ["run", "in/pulled.toml", "--out", "a", "--quiet", "--no-report"];
    let begin = ["--set", "time.end=100", "--checkpoint", "10 steps"];
    let mut child = sandbox.command(&[&run[..], &begin[..]].concat()).spawn().unwrap();
    while !sandbox.path("a.checkpoint/state").exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended without a checkpoint");
        std::thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
    sandbox.put("in/pull.csv", table(2));
    let resume = sandbox.percuss(&[&run[..], &["--resume"]].concat());
    resume.ends_with(2).tells("pull.csv was modified after the checkpoint was written");
    sandbox.put("in/pull.csv", table(1));
    sandbox.percuss(&[&run[..], &["--resume"]].concat()).ends_with(0);
}
