//! The book: its commands run, its codes are reported, its results reference says what a run leaves.

use std::collections::BTreeSet;
use std::path::Path;

use percuss_book::{Effort, Provocations, Sandbox, authored, run, set};
use percuss_codes::Code;
use serde_json::Value;

use crate::common::Sandbox as Table;

fn repository() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// Runs the pages whose paths begin with one of `folders`.
fn runs(folders: &[&str]) {
    let mut faults = Vec::new();
    let mut count = 0;
    for (path, text) in authored(repository()).unwrap() {
        if !folders.iter().any(|folder| path.starts_with(folder)) {
            continue;
        }
        let folder = tempfile::tempdir().unwrap();
        let sandbox =
            Sandbox::new(folder.path().join("desk"), Path::new(env!("CARGO_BIN_EXE_percuss")));
        let (text, wrong) = run(&text, &sandbox.unwrap(), Effort::Quick).unwrap();
        faults
            .extend(wrong.into_iter().chain(set(&text, "").1).map(|one| format!("{path}: {one}")));
        count += 1;
    }
    assert!(count > 0, "no pages");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn commands_of_the_first_hour_run() {
    runs(&["first-hour.md"]);
}

#[test]
fn commands_of_the_tasks_run() {
    runs(&["tasks/"]);
}

#[test]
fn commands_of_the_theory_run() {
    runs(&["theory/"]);
}

#[test]
fn every_code_is_reported_by_its_example() {
    let provocations = Provocations::load(&repository().join("docs/book/codes.toml")).unwrap();
    let mut faults = Vec::new();
    for code in Code::all() {
        let folder = tempfile::tempdir().unwrap();
        let sandbox =
            Sandbox::new(folder.path().join("desk"), Path::new(env!("CARGO_BIN_EXE_percuss")));
        faults.extend(provocations.provoke(code, &sandbox.unwrap()).unwrap().faults);
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Every key of a JSON value, those of tables by the user's names left out.
fn keys(value: &Value, under: &str, found: &mut BTreeSet<String>) {
    const NAMED: [&str; 5] = ["contact", "projectile", "point", "support", "section_forces"];
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                if !NAMED.contains(&under) {
                    found.insert(key.clone());
                }
                keys(value, if NAMED.contains(&under) { "" } else { key }, found);
            }
        }
        Value::Array(all) => all.iter().for_each(|one| keys(one, under, found)),
        _ => {}
    }
}

#[test]
fn the_results_reference_names_what_a_run_leaves() {
    let text = std::fs::read_to_string(repository().join("docs/results.md")).unwrap();
    let sandbox = Table::new();
    let mut found = BTreeSet::new();
    for name in ["elastic", "rigid"] {
        let outcome = sandbox.percuss(&["run", &format!("{name}.toml"), "--out", name]);
        assert_eq!(outcome.status, Some(0), "{}", outcome.stderr);
        keys(&sandbox.summary(name), "", &mut found);
        let folder = std::fs::read_dir(sandbox.path(name)).unwrap();
        let files = folder.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        found.extend(files);
    }
    // Words within backticks, file names whole.
    let code: Vec<&str> = text.split('`').skip(1).step_by(2).collect();
    let words = |one: &&str| -> Vec<String> {
        let split = one.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        split.chain([one.trim_end_matches('/')]).map(str::to_string).collect()
    };
    let named: BTreeSet<String> = code.iter().flat_map(words).collect();
    let missing: Vec<&String> = found.difference(&named).collect();
    assert!(missing.is_empty(), "docs/results.md does not name {missing:?}");
}
