//! Every operation on the disk fails in turn, or the process dies there: afterwards the earlier results are whole, or the new ones.
#![cfg(target_os = "linux")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::common::{ELASTIC, Outcome, Sandbox};

/// ENOSPC.
const NO_SPACE: i32 = 28;

/// Errors of the system, in turn: no space, input and output, permission, too many files.
const ERRORS: [i32; 4] = [NO_SPACE, 5, 13, 24];

/// The library that makes operations fail; none where there is no C compiler.
pub fn shim(sandbox: &Sandbox) -> Option<PathBuf> {
    let source = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/faults.c");
    let library = sandbox.path("faults.so");
    let options = ["-shared", "-fPIC", "-O1", "-o"];
    match Command::new("cc").args(options).arg(&library).arg(source).arg("-ldl").status() {
        Ok(status) => {
            assert!(status.success(), "the library that makes operations fail cannot be built");
            Some(library)
        }
        Err(_) => {
            eprintln!("skipped: no C compiler (cc)");
            None
        }
    }
}

/// Every file below a folder, but for what tells of times of computing. A list of files goes by its names.
fn contents(folder: &Path) -> Files {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(place) = folders.pop() {
        for entry in fs::read_dir(&place).into_iter().flatten() {
            let path = entry.unwrap().path();
            let name = path.strip_prefix(folder).unwrap().display().to_string();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let mut bytes = fs::read(&path).unwrap();
            if let Ok(mut value) = serde_json::from_slice::<Value>(&bytes) {
                if let Some(table) = value.as_object_mut() {
                    table.remove("wall_seconds");
                    table.remove("provenance");
                    if let Some(files) = table.get_mut("files").and_then(Value::as_object_mut) {
                        files.values_mut().for_each(|one| *one = Value::Null);
                    }
                }
                bytes = value.to_string().into_bytes();
            }
            // The page and the checkpoint tell how long it took.
            if name.ends_with(".html") || name == "checkpoint" {
                bytes.clear();
            }
            found.insert(name, bytes);
        }
    }
    found
}

type Files = BTreeMap<String, Vec<u8>>;

/// Names of files that differ.
fn differing(a: &Files, b: &Files) -> String {
    let names: BTreeSet<&String> = a.keys().chain(b.keys()).collect();
    let differ = names.into_iter().filter(|name| a.get(*name) != b.get(*name));
    differ.cloned().collect::<Vec<_>>().join(", ")
}

/// A command that leaves results in `out`, where earlier ones are.
struct Case<'a> {
    sandbox: Sandbox,
    shim: PathBuf,
    /// Commands that lead to the earlier results, and the one under test.
    earlier: &'a [&'a [&'a str]],
    command: &'a [&'a str],
    /// What may stand there besides while results are incomplete.
    beside: &'a [&'a str],
    /// Whether the command adds files to results, which stay, each in one piece.
    adds: bool,
}

impl Case<'_> {
    fn fresh(&self) {
        for entry in fs::read_dir(self.sandbox.path("work")).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                fs::remove_dir_all(path).unwrap()
            } else {
                fs::remove_file(path).unwrap()
            }
        }
        copy(&self.sandbox.path("before"), &self.sandbox.path("work"));
    }

    fn run(&self, fault: Option<(usize, i32)>) -> Outcome {
        let mut command = self.sandbox.command(self.command);
        command.current_dir(self.sandbox.path("work"));
        if let Some((at, error)) = fault {
            let under = self.sandbox.path("work").canonicalize().unwrap();
            command.env("LD_PRELOAD", &self.shim).env("FAULT_UNDER", under);
            command.env("FAULT_COUNT", self.sandbox.path("count"));
            command.env("FAULT_AT", at.to_string()).env("FAULT_ERRNO", error.to_string());
        }
        command.output().unwrap().into()
    }

    /// Results in `out`, without the user's own file there, which must be whole.
    fn results(&self) -> Files {
        let mut found = contents(&self.sandbox.path("work/out"));
        // What a process that died was writing is nobody's, and goes with the next one.
        let hidden = |part: &str| part.starts_with(".percuss-") || part.ends_with(".partial");
        let of_a_shard = |name: &str| name.starts_with("shards/.") || name.starts_with(".results");
        found.retain(|name, _| {
            !name.split('/').any(hidden)
                && !(self.adds && (of_a_shard(name) || name.starts_with(".report")))
        });
        assert_eq!(
            found.remove("mine.txt").as_deref(),
            Some(&b"my own"[..]),
            "the user's file is gone"
        );
        found
    }

    /// Lets one operation fail, or the process die there, then runs the command again.
    fn try_one(
        &self,
        at: usize,
        error: i32,
        (before, after, whole_after): (&Files, &Files, &Files),
        names: &[String],
    ) -> Result<(), String> {
        self.fresh();
        let outcome = self.run(Some((at, error)));
        let said = format!("status {:?} {}", outcome.status, outcome.stderr.trim());
        let holds =
            |right: bool, what: &str| if right { Ok(()) } else { Err(format!("{what}: {said}")) };
        holds(!outcome.stderr.contains("panicked"), "it panics")?;
        let found = self.results();
        let one_of = |(name, bytes): (&String, &Vec<u8>)| {
            before.get(name) == Some(bytes) || after.get(name) == Some(bytes)
        };
        let added = self.adds
            && found.iter().all(one_of)
            && before.keys().all(|name| found.contains_key(name) || !after.contains_key(name));
        let whole = added || found == *before || found == *after;
        holds(whole, &format!("neither earlier nor new results ({})", differing(&found, after)))?;
        let reported = outcome.status.is_some_and(|s| s != 0);
        holds(error == 0 || found != *before || reported, "nothing was done, and nothing said")?;
        let named =
            error != NO_SPACE || !reported || outcome.stderr.contains("No space left on device");
        holds(named, "the full disk is not named")?;
        // Whoever comes next puts it in order; an extension that is done is not done again.
        let again = self.run(None);
        let done = found == *after && again.stderr.contains("already reaches t = 3 ms");
        holds(done || again.status == Some(0), &format!("the next one fails: {}", again.stderr))?;
        let differs = differing(&contents(&self.sandbox.path("work/out")), whole_after);
        holds(differs.is_empty(), &format!("the next one ends otherwise in {differs}"))?;
        let expected =
            |n: &String| names.contains(n) || self.beside.iter().any(|b| n.starts_with(b));
        let mut left = crate::common::names(&self.sandbox.path("work"));
        left.retain(|n| !done && !expected(n));
        holds(left.is_empty(), &format!("{left:?} are left"))
    }

    /// Tries every operation; the number of faults.
    fn try_all(&self) -> usize {
        fs::create_dir(self.sandbox.path("work")).unwrap();
        for arguments in self.earlier {
            let mut command = self.sandbox.command(arguments);
            let done: Outcome =
                command.current_dir(self.sandbox.path("work")).output().unwrap().into();
            done.ends_with(0);
        }
        fs::write(self.sandbox.path("work/out/mine.txt"), "my own").unwrap();
        fs::rename(self.sandbox.path("work"), self.sandbox.path("before")).unwrap();
        fs::create_dir(self.sandbox.path("work")).unwrap();
        self.fresh();
        let before = self.results();
        let names: Vec<String> = crate::common::names(&self.sandbox.path("work"));
        self.run(Some((0, 0))).ends_with(0);
        let after = self.results();
        let whole_after = contents(&self.sandbox.path("work/out"));
        assert_ne!(before, after, "the command changes nothing");
        let count = fs::read_to_string(self.sandbox.path("count")).unwrap();
        let count: usize = count.trim().parse().unwrap();
        assert!(count > 5, "{count}");
        let mut faults = Vec::new();
        // A sample has one operation in five, and all errors.
        let every = if crate::common::whole() { 1 } else { 5 };
        for at in (1..=count).step_by(every) {
            for error in [0, ERRORS[at % ERRORS.len()]] {
                let reported = self.try_one(at, error, (&before, &after, &whole_after), &names);
                faults.extend(
                    reported.err().map(|fault| format!("operation {at}, error {error}: {fault}")),
                );
            }
        }
        assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
        2 * count.div_ceil(every)
    }
}

pub fn copy(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let place = to.join(entry.file_name());
        if entry.path().is_dir() {
            fs::create_dir(&place).unwrap();
            copy(&entry.path(), &place);
        } else {
            fs::copy(entry.path(), &place).unwrap();
        }
    }
}

fn survives(earlier: &[&[&str]], command: &[&str], beside: &[&str], adds: bool) {
    let sandbox = Sandbox::new();
    sandbox.put("study.toml", STUDY);
    sandbox.put("heavy.toml", format!("{ELASTIC}{WEIGHT}"));
    let Some(shim) = shim(&sandbox) else { return };
    let case = Case { sandbox, shim, earlier, command, beside, adds };
    let faults = case.try_all();
    eprintln!("{faults} faults survived");
}

/// Where results go that are not complete, or could not be put in place.
const BESIDE: [&str; 2] = ["out.incomplete", "out.rescued"];
const STUDY: &str = r#"
base = "elastic.toml"
[parameter.end]
path = "time.end"
range = { from = 1e-3, to = 2e-3, count = 600 }
[design]
kind = "grid"
[results]
energy = "energy.final"
"#;
const WEIGHT: &str = "
[load.weight]
kind = \"gravity\"
acceleration = [0, -9.81]
";
const EARLIER: [&str; 7] =
    ["run", "../elastic.toml", "--quiet", "--out", "out", "--set", "time.end=2e-3"];

#[test]
fn a_run_loses_nothing_whatever_fails() {
    let command = ["run", "../elastic.toml", "--quiet", "--out", "out", "--set", "time.end=3e-3"];
    survives(&[&EARLIER], &command, &BESIDE, false);
}

#[test]
fn nor_does_a_report() {
    survives(&[&[EARLIER.as_slice(), &["--no-report"]].concat()], &["report", "out"], &[], true);
}

#[test]
fn nor_does_an_extension() {
    let earlier = [EARLIER.as_slice(), &["--no-report", "--checkpoint", "1 h"]].concat();
    let command = ["extend", "out", "--end", "3 ms", "--quiet", "--no-report"];
    survives(&[&earlier], &command, &BESIDE, false);
}

#[test]
fn nor_does_a_run_with_checkpoints() {
    let earlier = [EARLIER.as_slice(), &["--no-report"]].concat();
    let command = [
        &["run", "../elastic.toml", "--quiet", "--out", "out", "--no-report"],
        ["--checkpoint", "7 steps", "--resume", "--set", "time.end=3e-3"].as_slice(),
    ]
    .concat();
    survives(&[&earlier], &command, &BESIDE, false);
}

#[test]
fn nor_do_modes() {
    let modes = ["modes", "../rigid.toml", "--out", "out", "--json", "--count"];
    let (earlier, command) =
        ([modes.as_slice(), &["3"]].concat(), [modes.as_slice(), &["5"]].concat());
    survives(&[&earlier], &command, &BESIDE, false);
}

#[test]
fn nor_does_a_study() {
    let sweep = ["sweep", "../study.toml", "--out", "out", "--quiet", "--jobs", "1"];
    survives(&[&[sweep.as_slice(), &["--shard", "2/2"]].concat()], &sweep, &[], true);
}

#[test]
fn nor_does_an_equilibrium() {
    let statics = ["static", "../heavy.toml", "--out", "out", "--json"];
    let command = [statics.as_slice(), &["--set", "load.weight.acceleration=[0, -5]"]].concat();
    survives(&[&statics], &command, &BESIDE, false);
}

#[test]
fn nor_does_an_export() {
    let export = ["export", "out", "--format", "vtkhdf"];
    survives(&[&[EARLIER.as_slice(), &["--no-report"]].concat()], &export, &[], true);
}

#[test]
fn nor_does_a_figure() {
    let plot = ["plot", "out", "--out", "out", "--figure", "energy", "--format", "svg"];
    survives(&[&[EARLIER.as_slice(), &["--no-report"]].concat()], &plot, &[], true);
}

#[test]
fn nor_does_a_film() {
    let film = ["animate", "out", "--out", "out/film.gif", "--duration", "0.2", "--quiet"];
    survives(&[&[EARLIER.as_slice(), &["--no-report"]].concat()], &film, &[], true);
}
