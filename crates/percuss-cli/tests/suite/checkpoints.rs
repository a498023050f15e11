//! Runs that are stopped or killed go on from their checkpoints and end in the bits of runs that never stopped.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::common::{RIGID, Sandbox};

/// What a run determines: every file, but for times of computing.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(place) = folders.pop() {
        for entry in fs::read_dir(&place).unwrap() {
            let path = entry.unwrap().path();
            let name = path.strip_prefix(folder).unwrap().display().to_string();
            if path.is_dir() {
                folders.push(path);
            } else if name == "summary.json" {
                let mut value: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
                let table = value.as_object_mut().unwrap();
                assert!(
                    table.remove("wall_seconds").is_some() && table.remove("provenance").is_some()
                );
                found.insert(name, value.to_string().into_bytes());
            } else if ![".percuss.json", "checkpoint", "report.html"].contains(&name.as_str()) {
                found.insert(name, fs::read(&path).unwrap());
            }
        }
    }
    found
}

/// Names of the files that differ.
fn differences(a: &Path, b: &Path) -> Vec<String> {
    let (a, b) = (contents(a), contents(b));
    assert!(a.contains_key("summary.json") && a.len() >= 6, "{:?}", a.keys());
    a.keys().chain(b.keys()).filter(|name| a.get(*name) != b.get(*name)).cloned().collect()
}

const RUN: [&str; 6] = ["run", "rigid.toml", "--quiet", "--no-report", "--set", "time.step=1e-6"];

fn arguments<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [RUN.as_slice(), more].concat()
}

#[test]
fn a_killed_run_goes_on_where_it_was() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&arguments(&["--out", "whole"])).ends_with(0);
    let mut resumed = 0;
    for _ in 0..200 {
        let state = sandbox.path("out.checkpoint/state");
        let more = ["--out", "out", "--checkpoint", "500 steps", "--resume"];
        let mut child = sandbox.command(&arguments(&more)).spawn().unwrap();
        let before = fs::metadata(&state).and_then(|m| m.modified()).ok();
        resumed += usize::from(before.is_some());
        // Killed once it has written a checkpoint of its own, wherever it then is.
        let ended = loop {
            if let Some(status) = child.try_wait().unwrap() {
                break Some(status.code());
            }
            let now = fs::metadata(&state).and_then(|m| m.modified()).ok();
            if now.is_some() && now != before && resumed < 12 {
                child.kill().unwrap();
                child.wait().unwrap();
                break None;
            }
            std::thread::yield_now();
        };
        if let Some(code) = ended {
            assert_eq!(code, Some(0));
            break;
        }
    }
    assert!(resumed >= 3, "{resumed}");
    assert_eq!(differences(&sandbox.path("whole"), &sandbox.path("out")), Vec::<String>::new());
    assert!(!sandbox.path("out.checkpoint").exists());
}

#[test]
fn a_run_is_extended_in_its_place_or_beside_it_once_and_again() {
    let sandbox = Sandbox::new();
    let at = |end: &'static str, out: &'static str| arguments(&["--set", end, "--out", out]);
    // The first end lies within a step.
    let first = [at("time.end=0.0100005", "run"), vec!["--checkpoint", "1 h", "--history", "csv"]];
    sandbox.percuss(&first.concat()).ends_with(0);
    let whole = [at("time.end=0.02", "whole"), vec!["--history", "csv"]];
    sandbox.percuss(&whole.concat()).ends_with(0);
    let short = contents(&sandbox.path("run"));
    let extend = |more: &[&str]| {
        sandbox.percuss(&[&["extend", "run", "--quiet", "--no-report"], more].concat())
    };
    extend(&["--end", "20 ms", "--out", "long"]).ends_with(0);
    assert_eq!(differences(&sandbox.path("whole"), &sandbox.path("long")), Vec::<String>::new());
    assert_eq!(short, contents(&sandbox.path("run")));
    extend(&["--end", "15 ms"]).ends_with(0);
    extend(&["--end", "20 ms"]).ends_with(0);
    assert_eq!(differences(&sandbox.path("whole"), &sandbox.path("run")), Vec::<String>::new());
    extend(&["--end", "20 ms"])
        .ends_with(2)
        .tells("already reaches t = 20 ms; choose a later time");
    let without = sandbox.percuss(&["extend", "whole", "--end", "1 s"]);
    without.ends_with(2).tells("only a complete run with --checkpoint has one");
}

#[test]
fn an_extension_that_was_killed_goes_on_where_it_was() {
    let sandbox = Sandbox::new();
    let end = |end: &'static str| arguments(&["--set", end]);
    sandbox.percuss(&[end("time.end=0.03"), vec!["--out", "whole"]].concat()).ends_with(0);
    let first = [end("time.end=0.01"), vec!["--out", "out", "--checkpoint", "1 h"]].concat();
    sandbox.percuss(&first).ends_with(0);
    let extend = ["extend", "out", "--end", "30 ms", "--quiet", "--no-report"];
    let extend = [extend.as_slice(), &["--checkpoint", "500 steps", "--resume"]].concat();
    let state = sandbox.path("out.checkpoint/state");
    let mut child = sandbox.command(&extend).spawn().unwrap();
    while !state.exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended without a checkpoint");
        std::thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(sandbox.summary("out")["time"], 0.01, "the run before is not whole");
    sandbox.percuss(&extend[..extend.len() - 1]).ends_with(2).tells("continue with --resume");
    sandbox.percuss(&extend).ends_with(0);
    assert_eq!(differences(&sandbox.path("whole"), &sandbox.path("out")), Vec::<String>::new());
    assert!(!sandbox.path("out.checkpoint").exists());
    // A queue that starts the job once more finds nothing to do.
    sandbox.percuss(&extend).ends_with(0);
    let reported: Vec<&str> = extend.iter().copied().filter(|word| *word != "--quiet").collect();
    sandbox.percuss(&reported).ends_with(0).tells("reached t = 30 ms; nothing to do");
}

#[test]
fn files_that_are_no_checkpoint_of_the_run_are_refused_and_left_alone() {
    let sandbox = Sandbox::new();
    let resume = |more: &[&str]| {
        sandbox.percuss(&arguments(&[&["--out", "out", "--resume"], more].concat()))
    };
    resume(&[]).ends_with(2).tells("no checkpoint: a run writes one with --checkpoint");
    // One that a killed run left, made by one that cannot write its results.
    let mut child = sandbox
        .command(&arguments(&["--set", "time.end=10", "--out", "out", "--checkpoint", "10 steps"]))
        .spawn()
        .unwrap();
    let state = sandbox.path("out.checkpoint/state");
    while !state.exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended without a checkpoint");
        std::thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = fs::read(&state).unwrap();
    let again = sandbox.percuss(&arguments(&["--out", "out", "--checkpoint", "1 s"]));
    again.ends_with(2).tells("continue with --resume, or remove it");
    sandbox.put("rigid.toml", RIGID.replace("restitution = ", "restitution = 0.25 # "));
    resume(&[]).ends_with(2).tells("belongs to a different scenario");
    sandbox.put("rigid.toml", RIGID);
    for (cut, word) in
        [(kept.len() - 9, "damaged"), (10, "not a checkpoint"), (0, "not a checkpoint")]
    {
        fs::write(&state, &kept[..cut]).unwrap();
        resume(&[]).ends_with(2).tells(word);
    }
    let older = String::from_utf8_lossy(&kept[..21]).replace(" 1\n", " 0\n");
    fs::write(&state, [older.as_bytes(), &kept[21..]].concat()).unwrap();
    resume(&[]).ends_with(2).tells("another version of Percuss");
    fs::write(&state, &kept).unwrap();
    let rows = sandbox.path("out.checkpoint/rows");
    let mut damaged = fs::read(&rows).unwrap();
    damaged[20] ^= 1;
    fs::write(&rows, damaged).unwrap();
    resume(&[]).ends_with(2).tells("damaged");
    sandbox.put("out.checkpoint/mine", "my own");
    resume(&[]).ends_with(2).tells("is the checkpoint directory but contains mine; move this file");
    assert_eq!(fs::read(sandbox.path("out.checkpoint/mine")).unwrap(), b"my own");
    assert!(!sandbox.path("out").exists());
}
