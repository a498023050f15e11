//! What a command leaves as it is: files edited while it works, the folder in which the shell stands.
#![cfg(target_os = "linux")]

use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{Outcome, Sandbox};
use crate::disk_faults::shim;

const RUN: [&str; 6] = ["run", "elastic.toml", "--quiet", "--out", "out", "--no-report"];

/// A command that waits before it makes a file, while something is done.
fn meanwhile(
    sandbox: &Sandbox,
    arguments: &[&str],
    at: &str,
    act: impl FnOnce(),
) -> Option<Outcome> {
    let shim = shim(sandbox)?;
    let (go, waiting) = (sandbox.path("go"), sandbox.path("go.waiting"));
    let _ = (fs::remove_file(&go), fs::remove_file(&waiting));
    let mut command = sandbox.command(arguments);
    command.env("LD_PRELOAD", shim).env("FAULT_PAUSE_AT", at).env("FAULT_GO", &go);
    let child = command.spawn().expect("the command starts");
    let begun = Instant::now();
    while !waiting.exists() && begun.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(5));
    }
    act();
    fs::write(&go, "").unwrap();
    Some(child.wait_with_output().expect("the command ends").into())
}

#[test]
fn files_edited_while_a_run_computes_are_kept_and_reported() {
    let sandbox = Sandbox::new();
    let run = &RUN[..];
    sandbox.percuss(run).ends_with(0);
    let edit = || fs::write(sandbox.path("out/summary.json"), "with a remark of mine").unwrap();
    let Some(ended) = meanwhile(&sandbox, run, ".summary.json.partial", edit) else { return };
    ended.ends_with(0).tells("[W118]").tells("summary.json.changed-1");
    let kept = fs::read_to_string(sandbox.path("out/summary.json.changed-1")).unwrap();
    assert_eq!(kept, "with a remark of mine");
    assert_eq!(sandbox.summary("out")["status"], "completed");
    // The page, which is made again from the run.
    sandbox.percuss(&["report", "out"]).ends_with(0);
    let edit = || fs::write(sandbox.path("out/report.html"), "<p>mine").unwrap();
    let ended = meanwhile(&sandbox, &["report", "out"], ".report.html.partial", edit).unwrap();
    ended.ends_with(0).tells("[W118]");
    assert_eq!(fs::read_to_string(sandbox.path("out/report.html.changed-1")).unwrap(), "<p>mine");
    // A comparison of runs, a single file.
    let compare = ["report", "out", "out", "--out", "both.html"];
    sandbox.percuss(&compare).ends_with(0);
    let edit = || fs::write(sandbox.path("both.html"), "mine").unwrap();
    let ended = meanwhile(&sandbox, &compare, ".both.html.percuss.partial", edit).unwrap();
    ended.ends_with(0).tells("both.html.changed-1");
    assert_eq!(fs::read_to_string(sandbox.path("both.html.changed-1")).unwrap(), "mine");
    assert!(!sandbox.names().iter().any(|name| name.contains("percuss")), "{:?}", sandbox.names());
}

#[test]
fn the_shell_s_own_folder_stays_where_it_is() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&RUN).ends_with(0);
    fs::create_dir(sandbox.path("out/notes")).unwrap();
    for folder in ["out", "out/notes"] {
        let up = if folder == "out" { ".." } else { "../.." };
        let out = if folder == "out" { "." } else { ".." };
        let program = env!("CARGO_BIN_EXE_percuss");
        let line = format!(
            "cd {folder} && '{program}' run {up}/elastic.toml --quiet --no-report --out {out} && ls {out}/summary.json && touch here"
        );
        let mut shell = Command::new("sh");
        shell.args(["-c", &line]).current_dir(sandbox.path("")).stdin(Stdio::null());
        let ended: Outcome = shell.output().expect("a shell").into();
        ended.ends_with(0);
        assert!(sandbox.path(folder).join("here").is_file(), "{folder}");
    }
    assert_eq!(sandbox.names(), ["elastic.toml", "out", "rigid.toml"]);
}
