//! A beam of 3 m to put things on, and what is said of them.
#![allow(dead_code, reason = "every test file uses its own share of these")]

use percuss_scenario::{Content, Diagnostics, FileAccess, read, read_with};

/// Twelve lines: a beam of 3 m.
pub const BEAM: &str = "[material.m]\nyoung = 1e9\ndensity = 1e3\n\
                        [section.s]\nshape = \"circle\"\ndiameter = 0.01\n\
                        [beam.b]\npoints = [[0, 0], [3, 0]]\nelements = 6\nmaterial = \"m\"\n\
                        section = \"s\"\n\n";
/// What stands below.
pub const TIME: &str = "[time]\nend = 1\nstep = 0.1\n";
/// Four lines, on which `wall` stands.
pub const WALL: &str = "[obstacle.wall]\nkind = \"wall\"\nends = [[0, 1], [3, 1]]\n\n";

/// What a valid file contains, which is the same when it is written out.
#[track_caller]
pub fn good(text: &str) -> Content {
    let scenario = read(&[BEAM, text, TIME].concat(), "f.toml").unwrap_or_else(|e| panic!("{e}"));
    let again = read(&scenario.to_toml(), "again").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(again.content(), scenario.content());
    scenario.content().clone()
}

/// All faults of a file, of reading and of the model.
pub fn faults(text: &str) -> Diagnostics {
    let all = read_with(&[BEAM, text, TIME].concat(), "f.toml", FileAccess::Anywhere)
        .and_then(|s| s.compile());
    all.map(|_| panic!("no fault in\n{text}")).unwrap_err()
}

/// All faults of what follows the twelve lines.
#[track_caller]
pub fn bad(text: &str, expected: &[&str]) {
    let all = faults(text).to_string();
    let lines: Vec<&str> = all.lines().map(|l| l.trim_start_matches("f.toml:")).collect();
    assert_eq!(lines, expected);
}

/// Five lines, 13 to 17, and what is given.
pub fn projectile(text: &str) -> String {
    format!("[projectile.p]\nmass = 1\nvelocity = [0, -1]\n\n\n{text}\n")
}

/// A projectile that strikes a point; what is given stands from line 19 on.
pub fn guided(text: &str) -> String {
    projectile(&format!("strikes = \"b.mid\"\n{text}"))
}

/// The same behind a spring, from line 20 on.
pub fn elastic(text: &str) -> String {
    guided(&format!("kind = \"elastic\"\n{text}"))
}

/// A free rigid projectile; what is given stands from line 21 on.
pub fn free(text: &str) -> String {
    projectile(&format!("contact = \"surface\"\nkind = \"rigid\"\nrestitution = 0.5\n{text}"))
}

/// The beam may touch the wall; what is given stands from line 19 on.
pub fn contact(text: &str) -> String {
    format!("{WALL}[contact.c]\nbetween = [\"b\", \"wall\"]\n{text}\n")
}
