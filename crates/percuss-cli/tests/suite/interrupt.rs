//! Ctrl-C leaves a readable result.
#![cfg(unix)]

use crate::common;

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use common::{Outcome, Sandbox};

/// Waits until something is true, for at most a minute; says whether it came true.
fn wait_for(mut is_true: impl FnMut() -> bool) -> bool {
    let begun = Instant::now();
    while !is_true() {
        if begun.elapsed() > Duration::from_secs(60) {
            return false;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    true
}

/// A run without end, its history begun.
fn endless(sandbox: &Sandbox) -> Child {
    let set = ["--set", "time.end=1e4", "--set", "record.every=1000"];
    let arguments = [["run", "elastic.toml"].as_slice(), &set, &["--out", "out"]].concat();
    begun(sandbox, &mut sandbox.command(&arguments))
}

/// Starts a run to `out` and waits until its history has begun.
fn begun(sandbox: &Sandbox, command: &mut Command) -> Child {
    let mut child = command.spawn().expect("the command starts");
    let is_staging = |name: &String| name.starts_with(".out.percuss-staged-");
    let has_begun = wait_for(|| {
        let staging = sandbox.names().into_iter().find(is_staging);
        staging.is_some_and(|dir| sandbox.path(&dir).join(".history.parquet.partial").exists())
    });
    if !has_begun {
        let _ = child.kill(); // it would run for ever
        panic!("waited in vain for a history");
    }
    child
}

/// Whether a command has taken over Ctrl-C, where the system tells.
fn listens(child: &Child) -> bool {
    let status = std::fs::read_to_string(format!("/proc/{}/status", child.id()));
    let Ok(status) = status else {
        std::thread::sleep(Duration::from_millis(500));
        return true;
    };
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
    // Signal 2 is the second bit.
    caught.is_some_and(|mask| u64::from_str_radix(mask.trim(), 16).is_ok_and(|m| m & 2 != 0))
}

fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill").args([name, &child.id().to_string()]).status();
    assert!(sent.expect("kill starts").success());
}

fn end_of(child: Child) -> Outcome {
    child.wait_with_output().expect("the command ends").into()
}

#[test]
fn an_interrupted_run_leaves_a_readable_result() {
    // The last ones are sent by batch systems when time is up, and by terminals that go away.
    for name in ["-INT", "-TERM", "-HUP", "-USR1", "-USR2", "-XCPU"] {
        let sandbox = Sandbox::new();
        let child = endless(&sandbox);
        signal(&child, name);
        end_of(child).ends_with(130).tells("interrupted at t = ");
        let summary = sandbox.summary("out");
        assert_eq!(summary["status"], "interrupted");
        assert!(summary["steps"].as_u64() > Some(0));
        let history = percuss_output::read_history(sandbox.path("out")).expect("a history");
        assert_eq!(summary["rows"].as_u64(), Some(history.rows() as u64));
        assert!(sandbox.path("out/report.html").is_file());
        assert_eq!(sandbox.names(), ["elastic.toml", "out", "rigid.toml"]);
    }
}

/// The checkpoint is of the instant that was reached, not of one some time before.
#[test]
fn a_signal_of_a_batch_system_leaves_a_checkpoint_of_what_was_reached() {
    for name in ["-USR1", "-HUP", "-TERM"] {
        let sandbox = Sandbox::new();
        let run = ["run", "elastic.toml", "--set", "time.end=1e4", "--set", "record.every=1000"];
        let run = [&run[..], &["--out", "out", "--checkpoint", "1 h", "--no-report"]].concat();
        let child = begun(&sandbox, &mut sandbox.command(&run));
        signal(&child, name);
        end_of(child).ends_with(130).tells("the same command with --resume continues from t = ");
        let reached = sandbox.summary("out")["time"].clone();
        let state = std::fs::read(sandbox.path("out.checkpoint/state")).expect("a checkpoint");
        let head = state.split(|byte| *byte == b'\n').find(|line| line.starts_with(b"{"));
        let head = head.or_else(|| state.split(|byte| *byte == b'\n').next()).unwrap_or_default();
        let head = String::from_utf8_lossy(head);
        let head = &head[head.find('{').expect("a line of JSON")..];
        let head: serde_json::Value = serde_json::from_str(head).expect("a line of JSON");
        assert_eq!(head["time_s"], reached, "{name}: {head}");
    }
}

/// The library of the tests of disks refuses every thread, as where no more processes may run.
#[cfg(target_os = "linux")]
#[test]
fn no_command_needs_a_thread() {
    let sandbox = Sandbox::new();
    let Some(shim) = crate::disk_faults::shim(&sandbox) else { return };
    sandbox.put(
        "study.toml",
        "base = \"elastic.toml\"\n[parameter.end]\npath = \"time.end\"\nrange = { from = 1e-3, to = 2e-3, count = 3 }\n\
         [design]\nkind = \"grid\"\n[results]\nenergy = \"energy.final\"\n",
    );
    let run = ["run", "elastic.toml", "--quiet", "--set", "time.end=2e-3", "--out"];
    sandbox.percuss(&[&run[..], &["expected", "--figures"]].concat()).ends_with(0);
    let commands: [&[&str]; 6] = [
        &[&run[..], &["out", "--figures"]].concat(),
        &["report", "out", "--figures"],
        &["export", "out", "--format", "pvd"],
        &["modes", "elastic.toml", "--out", "modes", "--json"],
        &["static", "elastic.toml", "--out", "rest", "--json"],
        &["sweep", "study.toml", "--out", "study", "--quiet"],
    ];
    for allowed in ["0", "1", "2"] {
        for arguments in commands {
            let mut command = sandbox.command(arguments);
            command.env("LD_PRELOAD", &shim).env("FAULT_THREADS", allowed);
            let ended: Outcome = command.output().expect("the command starts").into();
            ended.ends_with(0);
        }
        for file in ["history.parquet", "fields/frames.parquet"] {
            let bytes = |run: &str| std::fs::read(sandbox.path(run).join(file)).expect(file);
            assert!(bytes("out") == bytes("expected"), "{file} with {allowed} threads");
        }
        assert!(sandbox.path("study/results.parquet").is_file());
    }
    // It ends by signals all the same, with what it has.
    let set = ["run", "elastic.toml", "--set", "time.end=1e4", "--set", "record.every=1000"];
    let mut command = sandbox.command(&[&set[..], &["--out", "long"]].concat());
    command.env("LD_PRELOAD", &shim).env("FAULT_THREADS", "0");
    let child = command.spawn().expect("the command starts");
    assert!(wait_for(|| sandbox
        .names()
        .iter()
        .any(|name| name.starts_with(".long.percuss-staged"))));
    std::thread::sleep(Duration::from_millis(300));
    signal(&child, "-TERM");
    end_of(child).ends_with(130);
    assert_eq!(sandbox.summary("long")["status"], "interrupted");
}

/// What `nohup` relies on.
#[test]
fn an_ignored_hangup_stays_ignored() {
    let sandbox = Sandbox::new();
    let program = env!("CARGO_BIN_EXE_percuss");
    let run = "run elastic.toml --set time.end=1e4 --set record.every=1000 --out out";
    let mut shell = Command::new("sh");
    let script = format!("trap '' HUP; exec '{program}' {run} --no-report");
    shell.args(["-c", &script]).current_dir(sandbox.path("")).stdout(Stdio::piped());
    let mut child = begun(&sandbox, shell.stderr(Stdio::piped()));
    signal(&child, "-HUP");
    std::thread::sleep(Duration::from_millis(100));
    assert!(child.try_wait().expect("a state").is_none(), "ended by a hang-up");
    signal(&child, "-INT");
    end_of(child).ends_with(130);
    assert_eq!(sandbox.summary("out")["status"], "interrupted");
}

/// Commands that do not work in steps end at once; what they have not finished goes with them.
#[test]
fn every_long_command_ends_at_the_first_signal() {
    let fine = ["--set", "beam.girder.elements=400000"];
    let long: [&[&str]; 6] = [
        &["static", "elastic.toml", "--out", "out", fine[0], fine[1]],
        &["modes", "elastic.toml", "--out", "out", "--count", "300", fine[0], fine[1]],
        &["converge", "elastic.toml", "--set", "time.end=20"],
        &[
            "sensitivity",
            "elastic.toml",
            "--parameter",
            "projectile.mass.mass",
            "--set",
            "time.end=1e4",
        ],
        &["verify"],
        &["check", "-"],
    ];
    for arguments in long {
        let sandbox = Sandbox::new();
        let mut command = sandbox.command(arguments);
        let mut child = command.stdin(Stdio::piped()).spawn().expect("the command starts");
        // What is read from must stay open until the end.
        let input = child.stdin.take();
        assert!(wait_for(|| listens(&child)), "{arguments:?} does not listen");
        signal(&child, "-INT");
        let ended = end_of(child);
        drop(input);
        assert_eq!(ended.status, Some(130), "{arguments:?}: {}", ended.stderr);
        assert_eq!(sandbox.names(), ["elastic.toml", "rigid.toml"], "{arguments:?}");
    }
}

/// As `timeout` does, to the program and then to its group.
#[test]
fn a_signal_that_is_sent_twice_leaves_a_readable_result() {
    let sandbox = Sandbox::new();
    let child = endless(&sandbox);
    signal(&child, "-TERM");
    signal(&child, "-TERM");
    assert_eq!(end_of(child).status, Some(130));
    assert_eq!(sandbox.summary("out")["status"], "interrupted");
}

#[test]
fn a_second_signal_ends_at_once_and_leaves_no_half_result() {
    let sandbox = Sandbox::new();
    let child = endless(&sandbox);
    signal(&child, "-INT");
    std::thread::sleep(Duration::from_millis(250));
    signal(&child, "-INT");
    // Whether the second came while the first was being served or after, nothing is half there.
    assert_eq!(end_of(child).status, Some(130));
    if sandbox.path("out").exists() {
        assert_eq!(sandbox.summary("out")["status"], "interrupted");
        percuss_output::read_history(sandbox.path("out")).expect("a history");
    }
    let names = sandbox.names();
    assert!(names.iter().all(|name| !name.contains("percuss")), "left behind: {names:?}");
}
