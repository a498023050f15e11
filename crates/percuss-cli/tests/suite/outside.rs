//! Files that a scenario names, and scenarios that come through pipes.
#![cfg(unix)]

use std::io::Write;
use std::os::unix::fs::symlink;
use std::process::{Command, Stdio};

use crate::common::{Desk, ELASTIC, Outcome};

fn pulled_by(file: &str) -> String {
    format!(
        "{ELASTIC}\n[load.measured]\nkind = \"point\"\nat = \"girder.end\"\nforce = [0, 1]\nfunction = {{ kind = \"table\", file = \"{file}\" }}\n"
    )
}

fn check(desk: &Desk, more: &[&str]) -> Outcome {
    desk.percuss(&[&["check", "in/pull.toml"], more].concat())
}

#[test]
fn a_scenario_reads_no_file_outside_its_folder_unless_allowed() {
    let desk = Desk::empty();
    std::fs::create_dir_all(desk.path("in/below")).unwrap();
    desk.put("secret.csv", "0, 1\n1, swordfish\n");
    desk.put("pulse.csv", "0, 0\n1, 1\n");
    desk.put("in/below/pulse.csv", "0, 0\n1, 1\n");
    symlink(desk.path("pulse.csv"), desk.path("in/link.csv")).unwrap();
    symlink(desk.path("in/below/pulse.csv"), desk.path("in/within.csv")).unwrap();
    let absolute = desk.path("pulse.csv").display().to_string();
    for name in ["../pulse.csv", "below/../../pulse.csv", "link.csv", absolute.as_str()] {
        desk.put("in/pull.toml", pulled_by(name));
        check(&desk, &[]).ends_with(2).tells("which lies outside the folder of this file");
        check(&desk, &["--allow-outside"]).ends_with(0);
    }
    for name in ["below/pulse.csv", "within.csv", "./below/../within.csv"] {
        desk.put("in/pull.toml", pulled_by(name));
        check(&desk, &[]).ends_with(0);
    }
    // Whether it is there is not told either, nor what is in it.
    desk.put("in/pull.toml", pulled_by("../nothing.csv"));
    check(&desk, &[]).ends_with(2).tells("which lies outside the folder of this file");
    desk.put("in/pull.toml", pulled_by("../secret.csv"));
    let told = check(&desk, &["--allow-outside"]);
    told.ends_with(2).tells("a text, which is no finite number, in line 2");
    assert!(!told.stderr.contains("swordfish"), "{}", told.stderr);
}

#[test]
fn so_does_the_scenario_of_a_study() {
    let desk = Desk::empty();
    std::fs::create_dir_all(desk.path("in")).unwrap();
    desk.put("pulse.csv", "0, 0\n1, 1\n");
    desk.put("in/pull.toml", pulled_by("../pulse.csv"));
    desk.put(
        "study.toml",
        "base = \"in/pull.toml\"\n[parameter.step]\npath = \"time.step\"\nvalues = [1e-4, 2e-4]\n[design]\nkind = \"grid\"\n\
         [results]\nenergy = \"energy.final\"\n",
    );
    let outside = desk.percuss(&["check", "study.toml"]);
    outside.ends_with(2).tells("which lies outside the folder of this file");
    desk.percuss(&["check", "study.toml", "--allow-outside"]).ends_with(0);
}

#[test]
fn a_scenario_comes_through_a_pipe_once() {
    let desk = Desk::empty();
    let mut command = desk.command(&["check", "/dev/stdin"]);
    let mut child = command.stdin(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(ELASTIC.as_bytes()).unwrap();
    Outcome::from(child.wait_with_output().unwrap()).ends_with(0);
    let fifo = desk.path("fifo");
    assert!(Command::new("mkfifo").arg(&fifo).status().unwrap().success());
    let child =
        desk.command(&["run", "fifo", "--quiet", "--no-report", "--out", "out"]).spawn().unwrap();
    std::fs::write(&fifo, ELASTIC).unwrap();
    Outcome::from(child.wait_with_output().unwrap()).ends_with(0);
    assert!(desk.path("out/summary.json").is_file());
    // Bytes that are no text are told of, not waited for again.
    let child = desk.command(&["check", "fifo"]).spawn().unwrap();
    std::fs::write(&fifo, [0xff, 0xfe, 0x00]).unwrap();
    Outcome::from(child.wait_with_output().unwrap()).ends_with(2).tells("not UTF-8");
    desk.percuss(&["check", "/dev/zero"]).ends_with(2).tells("input exceeds ");
}

#[test]
fn names_need_not_be_utf_8() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let desk = Desk::new();
    let (out, mine) = (OsStr::from_bytes(b"out\xfd"), OsStr::from_bytes(b"mine\xfe.txt"));
    let run = |end: &str| {
        let mut command =
            desk.command(&["run", "elastic.toml", "--quiet", "--no-report", "--set", end]);
        Outcome::from(command.arg("--out").arg(out).output().unwrap())
    };
    run("time.end=2e-3").ends_with(0);
    let own = desk.path(".").join(out).join(mine);
    std::fs::write(&own, "my own").unwrap();
    run("time.end=3e-3").ends_with(0);
    assert_eq!(std::fs::read(&own).unwrap(), b"my own");
    std::fs::remove_file(own.with_file_name(".percuss.json")).unwrap();
    run("time.end=4e-3").ends_with(2).tells("not empty and not the directory of a run");
}

#[test]
fn and_the_base_of_a_study() {
    let desk = Desk::empty();
    std::fs::create_dir_all(desk.path("in/below")).unwrap();
    for place in ["elastic.toml", "in/below/elastic.toml"] {
        desk.put(place, ELASTIC);
    }
    symlink(desk.path("elastic.toml"), desk.path("in/link.toml")).unwrap();
    let absolute = desk.path("elastic.toml").display().to_string();
    let study = |base: &str| {
        let rest = "[parameter.step]\npath = \"time.step\"\nvalues = [1e-4, 2e-4]\n[design]\nkind = \"grid\"\n\
                    [results]\nenergy = \"energy.final\"\n";
        desk.put("in/study.toml", format!("base = {base:?}\n{rest}"));
    };
    for base in
        ["../elastic.toml", "below/../../elastic.toml", "link.toml", &absolute, "../none.toml"]
    {
        study(base);
        let check = desk.percuss(&["check", "in/study.toml"]);
        check.ends_with(2).tells("in/study.toml:1:8: base: found ");
        check.tells(
            "which lies outside the folder of this file, expected a file in that folder or below",
        );
        assert_eq!(check.stderr.trim_end().lines().count(), 1, "{}", check.stderr);
        assert!(check.stderr.trim_end().ends_with("[E001]"), "{}", check.stderr);
        let sweep = desk.percuss(&["sweep", "in/study.toml", "--out", "out", "--quiet"]);
        sweep.ends_with(2).tells("which lies outside the folder of this file");
        let there = if base == "../none.toml" { 2 } else { 0 };
        desk.percuss(&["check", "in/study.toml", "--allow-outside"]).ends_with(there);
    }
    study("below/elastic.toml");
    desk.percuss(&["check", "in/study.toml"]).ends_with(0);
    study("../elastic.toml");
    desk.percuss(&["sweep", "in/study.toml", "--out", "out", "--quiet", "--allow-outside"])
        .ends_with(0);
}
