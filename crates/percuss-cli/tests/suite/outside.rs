//! Files that a scenario names, and scenarios that come through pipes.
#![cfg(unix)]

use std::io::Write;
use std::os::unix::fs::symlink;
use std::process::{Command, Stdio};

use crate::common::{ELASTIC, Outcome, Sandbox};

fn pulled_by(file: &str) -> String {
    format!(
        "{ELASTIC}\n[load.measured]\nkind = \"point\"\nat = \"girder.end\"\nforce = [0, 1]\nfunction = {{ kind = \"table\", file = \"{file}\" }}\n"
    )
}

fn check(sandbox: &Sandbox, more: &[&str]) -> Outcome {
    sandbox.percuss(&[&["check", "in/pull.toml"], more].concat())
}

#[test]
fn a_scenario_reads_no_file_outside_its_folder_unless_allowed() {
    let sandbox = Sandbox::empty();
    std::fs::create_dir_all(sandbox.path("in/below")).unwrap();
    sandbox.put("secret.csv", "0, 1\n1, swordfish\n");
    sandbox.put("pulse.csv", "0, 0\n1, 1\n");
    sandbox.put("in/below/pulse.csv", "0, 0\n1, 1\n");
    symlink(sandbox.path("pulse.csv"), sandbox.path("in/link.csv")).unwrap();
    symlink(sandbox.path("in/below/pulse.csv"), sandbox.path("in/within.csv")).unwrap();
    let absolute = sandbox.path("pulse.csv").display().to_string();
    for name in ["../pulse.csv", "below/../../pulse.csv", "link.csv", absolute.as_str()] {
        sandbox.put("in/pull.toml", pulled_by(name));
        check(&sandbox, &[]).ends_with(2).tells("which lies outside the folder of this file");
        check(&sandbox, &["--allow-outside"]).ends_with(0);
    }
    for name in ["below/pulse.csv", "within.csv", "./below/../within.csv"] {
        sandbox.put("in/pull.toml", pulled_by(name));
        check(&sandbox, &[]).ends_with(0);
    }
    // Whether it is there is not reported either, nor what is in it.
    sandbox.put("in/pull.toml", pulled_by("../nothing.csv"));
    check(&sandbox, &[]).ends_with(2).tells("which lies outside the folder of this file");
    sandbox.put("in/pull.toml", pulled_by("../secret.csv"));
    let reported = check(&sandbox, &["--allow-outside"]);
    reported.ends_with(2).tells("a text, which is no finite number, in line 2");
    assert!(!reported.stderr.contains("swordfish"), "{}", reported.stderr);
}

#[test]
fn so_does_the_scenario_of_a_study() {
    let sandbox = Sandbox::empty();
    std::fs::create_dir_all(sandbox.path("in")).unwrap();
    sandbox.put("pulse.csv", "0, 0\n1, 1\n");
    sandbox.put("in/pull.toml", pulled_by("../pulse.csv"));
    sandbox.put(
        "study.toml",
        "base = \"in/pull.toml\"\n[parameter.step]\npath = \"time.step\"\nvalues = [1e-4, 2e-4]\n[design]\nkind = \"grid\"\n\
         [results]\nenergy = \"energy.final\"\n",
    );
    let outside = sandbox.percuss(&["check", "study.toml"]);
    outside.ends_with(2).tells("which lies outside the folder of this file");
    sandbox.percuss(&["check", "study.toml", "--allow-outside"]).ends_with(0);
}

#[test]
fn a_scenario_comes_through_a_pipe_once() {
    let sandbox = Sandbox::empty();
    let mut command = sandbox.command(&["check", "/dev/stdin"]);
    let mut child = command.stdin(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(ELASTIC.as_bytes()).unwrap();
    Outcome::from(child.wait_with_output().unwrap()).ends_with(0);
    let fifo = sandbox.path("fifo");
    assert!(Command::new("mkfifo").arg(&fifo).status().unwrap().success());
    let child = sandbox
        .command(&["run", "fifo", "--quiet", "--no-report", "--out", "out"])
        .spawn()
        .unwrap();
    std::fs::write(&fifo, ELASTIC).unwrap();
    Outcome::from(child.wait_with_output().unwrap()).ends_with(0);
    assert!(sandbox.path("out/summary.json").is_file());
    // Bytes that are no text are reported, not waited for again.
    let child = sandbox.command(&["check", "fifo"]).spawn().unwrap();
    std::fs::write(&fifo, [0xff, 0xfe, 0x00]).unwrap();
    Outcome::from(child.wait_with_output().unwrap()).ends_with(2).tells("not UTF-8");
    sandbox.percuss(&["check", "/dev/zero"]).ends_with(2).tells("input exceeds ");
}

#[test]
fn names_need_not_be_utf_8() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let sandbox = Sandbox::new();
    let (out, mine) = (OsStr::from_bytes(b"out\xfd"), OsStr::from_bytes(b"mine\xfe.txt"));
    let run = |end: &str| {
        let mut command =
            sandbox.command(&["run", "elastic.toml", "--quiet", "--no-report", "--set", end]);
        Outcome::from(command.arg("--out").arg(out).output().unwrap())
    };
    run("time.end=2e-3").ends_with(0);
    let own = sandbox.path(".").join(out).join(mine);
    std::fs::write(&own, "my own").unwrap();
    run("time.end=3e-3").ends_with(0);
    assert_eq!(std::fs::read(&own).unwrap(), b"my own");
    std::fs::remove_file(own.with_file_name(".percuss.json")).unwrap();
    run("time.end=4e-3").ends_with(2).tells("not empty and not the directory of a run");
}

#[test]
fn and_the_base_of_a_study() {
    let sandbox = Sandbox::empty();
    std::fs::create_dir_all(sandbox.path("in/below")).unwrap();
    for place in ["elastic.toml", "in/below/elastic.toml"] {
        sandbox.put(place, ELASTIC);
    }
    symlink(sandbox.path("elastic.toml"), sandbox.path("in/link.toml")).unwrap();
    let absolute = sandbox.path("elastic.toml").display().to_string();
    let study = |base: &str| {
        let rest = "[parameter.step]\npath = \"time.step\"\nvalues = [1e-4, 2e-4]\n[design]\nkind = \"grid\"\n\
                    [results]\nenergy = \"energy.final\"\n";
        sandbox.put("in/study.toml", format!("base = {base:?}\n{rest}"));
    };
    for base in
        ["../elastic.toml", "below/../../elastic.toml", "link.toml", &absolute, "../none.toml"]
    {
        study(base);
        let check = sandbox.percuss(&["check", "in/study.toml"]);
        check.ends_with(2).tells("in/study.toml:1:8: base: found ");
        check.tells(
            "which lies outside the folder of this file, expected a file in that folder or below",
        );
        assert_eq!(check.stderr.trim_end().lines().count(), 1, "{}", check.stderr);
        assert!(check.stderr.trim_end().ends_with("[E001]"), "{}", check.stderr);
        let sweep = sandbox.percuss(&["sweep", "in/study.toml", "--out", "out", "--quiet"]);
        sweep.ends_with(2).tells("which lies outside the folder of this file");
        let there = if base == "../none.toml" { 2 } else { 0 };
        sandbox.percuss(&["check", "in/study.toml", "--allow-outside"]).ends_with(there);
    }
    study("below/elastic.toml");
    sandbox.percuss(&["check", "in/study.toml"]).ends_with(0);
    study("../elastic.toml");
    sandbox
        .percuss(&["sweep", "in/study.toml", "--out", "out", "--quiet", "--allow-outside"])
        .ends_with(0);
}
