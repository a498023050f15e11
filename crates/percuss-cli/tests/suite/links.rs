//! Links planted at the names that commands write: nothing behind them is touched.
#![cfg(target_os = "linux")]

use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;

use crate::common::{ELASTIC, Sandbox};
use crate::disk_faults::{copy, shim};

const STUDY: &str = r#"
base = "elastic.toml"
[parameter.end]
path = "time.end"
range = { from = 1e-3, to = 2e-3, count = 3 }
[design]
kind = "grid"
[results]
energy = "energy.final"
"#;
const RUN: [&str; 7] =
    ["run", "../elastic.toml", "--quiet", "--out", "out", "--set", "time.end=2e-3"];

/// Paths that a command makes, within the folder in which it works, but for those of a random name.
fn made(sandbox: &Sandbox, shim: &Path, earlier: &[&[&str]], command: &[&str]) -> BTreeSet<String> {
    let names = sandbox.path("names");
    let _ = fs::remove_file(&names);
    fresh(sandbox, earlier);
    let work = sandbox.path("work").canonicalize().unwrap();
    let mut run = sandbox.command(command);
    run.current_dir(&work).env("LD_PRELOAD", shim).env("FAULT_UNDER", sandbox.path(""));
    run.env("FAULT_NAMES", &names).env("FAULT_AT", "-1");
    let ended = run.output().unwrap();
    assert!(ended.status.success(), "{command:?}: {}", String::from_utf8_lossy(&ended.stderr));
    let text = fs::read_to_string(&names).unwrap_or_default();
    let within = |line: &str| {
        let (kind, path) = line.split_at(2);
        let path = Path::new(path).strip_prefix(&work).ok()?.to_str()?;
        Some(format!("{kind}{path}"))
    };
    text.lines().filter_map(within).collect()
}

fn fresh(sandbox: &Sandbox, earlier: &[&[&str]]) {
    let (work, before) = (sandbox.path("work"), sandbox.path("before"));
    if !before.exists() {
        fs::create_dir(&work).unwrap();
        for arguments in earlier {
            let done = sandbox.command(arguments).current_dir(&work).output().unwrap();
            assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        }
        fs::rename(&work, &before).unwrap();
    } else {
        fs::remove_dir_all(&work).unwrap();
    }
    fs::create_dir(&work).unwrap();
    copy(&before, &work);
}

/// Plants a link at every name that a command writes and that can be foreseen, one after the other; how many there are.
fn follows_none(earlier: &[&[&str]], command: &[&str]) -> usize {
    let sandbox = Sandbox::new();
    sandbox.put("study.toml", STUDY);
    sandbox.put(
        "heavy.toml",
        format!("{ELASTIC}\n[load.weight]\nkind = \"gravity\"\nacceleration = [0, -9.81]\n"),
    );
    let Some(shim) = shim(&sandbox) else { return usize::MAX };
    let once = made(&sandbox, &shim, earlier, command);
    let twice = made(&sandbox, &shim, earlier, command);
    let (mut planted, mut faults) = (0, Vec::new());
    for line in once.intersection(&twice) {
        let (kind, name) = line.split_at(2);
        for link in ["link", "dangling", "second name"] {
            fresh(&sandbox, earlier);
            let place = sandbox.path("work").join(name);
            let is_folder = kind == "D ";
            let may_stand = place.parent().is_some_and(Path::is_dir)
                && fs::symlink_metadata(&place).is_err()
                && !(is_folder && link == "second name");
            if !may_stand {
                continue;
            }
            let (victim, gone) = (sandbox.path("victim"), sandbox.path("gone"));
            let _ = fs::remove_dir_all(&victim);
            fs::create_dir(&victim).unwrap();
            fs::write(victim.join("thesis.tex"), "years").unwrap();
            match (link, is_folder) {
                ("link", true) => symlink(&victim, &place).unwrap(),
                ("link", false) => symlink(victim.join("thesis.tex"), &place).unwrap(),
                ("dangling", _) => symlink(&gone, &place).unwrap(),
                _ => fs::hard_link(victim.join("thesis.tex"), &place).unwrap(),
            }
            planted += 1;
            let mut run = sandbox.command(command);
            let ended = run.current_dir(sandbox.path("work")).output().unwrap();
            let text = String::from_utf8_lossy(&ended.stderr).into_owned();
            let whole = fs::read_to_string(victim.join("thesis.tex")).is_ok_and(|t| t == "years")
                && crate::common::names(&victim) == ["thesis.tex"];
            if !whole || gone.exists() || text.contains("panicked") {
                faults.push(format!("{name} ({link}): {text}"));
            }
            let _ = fs::remove_file(&gone);
            let _ = fs::remove_dir_all(&gone);
        }
    }
    assert!(faults.is_empty(), "{command:?} follows\n{}", faults.join("\n"));
    eprintln!("{}: {planted} links planted", command[0]);
    planted
}

#[test]
fn runs_and_analyses_follow_no_link() {
    let checkpoints = [&RUN[..], &["--no-report", "--checkpoint", "7 steps", "--resume"]].concat();
    let modes = ["modes", "../rigid.toml", "--out", "out", "--json"];
    let statics = ["static", "../heavy.toml", "--out", "out", "--json"];
    for command in [&RUN[..], &checkpoints, &modes, &statics] {
        assert!(follows_none(&[], command) >= 2, "{command:?}");
    }
}

#[test]
fn commands_on_a_run_follow_no_link() {
    let bare = [&RUN[..], &["--no-report", "--checkpoint", "1 h"]].concat();
    let other = ["run", "../rigid.toml", "--quiet", "--out", "other", "--no-report"];
    let commands: [&[&str]; 4] = [
        &["report", "out"],
        &["report", "out", "other", "--out", "both.html"],
        &["export", "out", "--format", "pvd"],
        &["extend", "out", "--end", "3 ms", "--quiet", "--no-report"],
    ];
    for command in commands {
        assert!(follows_none(&[&bare, &other], command) >= 2, "{command:?}");
    }
}

#[cfg(feature = "pictures")]
#[test]
fn pictures_follow_no_link() {
    let bare = [&RUN[..], &["--no-report"]].concat();
    let commands: [&[&str]; 3] = [
        &["plot", "out", "--out", ".", "--figure", "energy", "--format", "svg"],
        &["animate", "out", "--out", "film.gif", "--duration", "0.2", "--quiet"],
        &["animate", "out", "--out", "still.svg", "--still", "1e-3", "--quiet"],
    ];
    for command in commands {
        assert!(follows_none(&[&bare], command) >= 2, "{command:?}");
    }
}

#[test]
fn studies_and_texts_follow_no_link() {
    let commands: [&[&str]; 3] = [
        &["sweep", "../study.toml", "--out", "out", "--quiet", "--jobs", "1", "--keep-run", "1"],
        &["new", "elastic", "--out", "mine.toml"],
        &["man", "--out", "."],
    ];
    // A new scenario refuses whatever stands there; a folder of a study cannot be foreseen to be there.
    for (command, least) in commands.iter().zip([1, 0, 2]) {
        assert!(follows_none(&[], command) >= least, "{command:?}");
    }
}
