//! What `percuss check` takes: time that grows with the file, memory that is there, messages that end.

use std::fmt::Write;
use std::process::Command;
use std::time::{Duration, Instant};

use crate::common::{Outcome, Sandbox};

const HEAD: &str = "[material.steel]\nyoung = \"210 GPa\"\ndensity = 7850\n\
    [section.plate]\nshape = \"rectangle\"\ndepth = 0.02\nwidth = 0.1\n\
    [time]\nend = 1e-3\nstep = 1e-5\n";

/// Beams one above the other, half a metre apart, each clamped at its start.
fn stack(beams: usize) -> String {
    let mut text = HEAD.to_owned();
    for i in 0..beams {
        let y = 0.5 * i as f64;
        let line = format!(
            "points = [[0, {y}], [1, {y}]]\nsection = \"plate\"\nmaterial = \"steel\"\nelements = 4"
        );
        let _ = writeln!(
            text,
            "[beam.b{i}]\n{line}\n[support.s{i}]\nat = \"b{i}.start\"\nkind = \"clamp\""
        );
    }
    text
}

/// Contacts between each beam of a stack and so many above it.
fn contacts(beams: usize, each: usize) -> String {
    let mut text = stack(beams);
    for i in 0..beams {
        for j in i + 1..beams.min(i + 1 + each) {
            let _ = writeln!(
                text,
                "[contact.c{i}-{j}]\nbetween = [\"b{i}\", \"b{j}\"]\nstiffness = 2e6"
            );
        }
    }
    text
}

/// Beams in a row, hinged to each other.
fn row(beams: usize) -> String {
    let mut text = format!("{HEAD}[support.s]\nat = \"b0.start\"\nkind = \"clamp\"\n");
    for i in 0..beams {
        let (from, to) = (i, i + 1);
        let line = format!(
            "points = [[{from}, 0], [{to}, 0]]\nsection = \"plate\"\nmaterial = \"steel\"\nelements = 4"
        );
        let _ = writeln!(text, "[beam.b{i}]\n{line}");
        if to < beams {
            let _ = writeln!(
                text,
                "[joint.j{i}]\nbetween = [\"b{i}.end\", \"b{to}.start\"]\nkind = \"hinge\""
            );
        }
    }
    text
}

/// A zigzag through so many points, of which others are recorded.
fn zigzag(points: usize, recorded: usize) -> String {
    let places: Vec<String> =
        (0..points).map(|i| format!("[{}, {}]", 0.01 * i as f64, 0.01 * (i % 2) as f64)).collect();
    let labels: Vec<String> =
        (0..recorded).map(|i| format!("\"b@{:.6}\"", i as f64 / recorded as f64)).collect();
    format!(
        "{HEAD}[beam.b]\npoints = [{}]\nsection = \"plate\"\nmaterial = \"steel\"\nelements = {points}\n\
         [support.s]\nat = \"b.start\"\nkind = \"clamp\"\n[record]\npoints = [{}]\n",
        places.join(", "),
        labels.join(", ")
    )
}

/// The time that files took in which anything was done for each pair of things: minutes. What grows with the file takes seconds, here
/// without optimisation too.
#[test]
fn the_time_of_a_check_grows_with_the_file() {
    for (name, text) in [
        ("stack", stack(6000)),
        ("row", row(6000)),
        ("contacts", contacts(300, 15)),
        ("points", zigzag(20_000, 0)),
        ("recorded", zigzag(2, 100_000)),
    ] {
        let sandbox = Sandbox::empty();
        sandbox.put("large.toml", text);
        let begun = Instant::now();
        let reported = sandbox.percuss(&["check", "large.toml"]);
        let took = begun.elapsed();
        assert!(reported.status == Some(0), "{name}: {}", reported.stderr);
        assert!(took < Duration::from_secs(40), "{name}: {took:?}");
        let goes_on = reported.stderr.contains("still checking after 5 s");
        assert!(took < Duration::from_secs(6) || goes_on, "{name}: {took:?}: {}", reported.stderr);
    }
}

#[test]
fn of_very_many_messages_the_rest_is_counted() {
    let sandbox = Sandbox::empty();
    let unknown = |n: usize| stack(n).replace("section =", "colour = 1\nsection =");
    sandbox.put("faults.toml", unknown(80));
    let reported = sandbox.percuss(&["check", "faults.toml"]);
    reported.ends_with(2).tells("and 30 more errors");
    assert_eq!(reported.stderr.lines().count(), 51, "{}", reported.stderr);
    sandbox.put("faults.toml", unknown(50));
    let reported = sandbox.percuss(&["check", "faults.toml"]);
    assert_eq!(reported.stderr.lines().count(), 50, "{}", reported.stderr);
    // Notes that differ in their subjects and numbers are one.
    let mut notes = stack(80);
    for i in 0..80 {
        let _ = writeln!(notes, "[mass.m{i}]\nat = \"b{i}.end\"\nmass = {}e12", 12 + i);
    }
    sandbox.put("notes.toml", notes);
    sandbox.percuss(&["check", "notes.toml"]).ends_with(0).tells("and 74 more, ");
}

/// What `ulimit -v` leaves is what there is.
#[test]
#[cfg(target_os = "linux")]
fn scenes_beyond_memory_are_refused_with_an_estimate() {
    let sandbox = Sandbox::empty();
    let fine =
        |elements: usize| stack(1).replace("elements = 4", &format!("elements = {elements}"));
    sandbox.put("fine.toml", fine(6_000_000));
    let limited = |file: &str, kilobytes: usize| -> Outcome {
        let line =
            format!("ulimit -v {kilobytes}; exec '{}' check {file}", env!("CARGO_BIN_EXE_percuss"));
        let shell = Command::new("sh").args(["-c", &line]).current_dir(sandbox.path(".")).output();
        shell.expect("a shell").into()
    };
    let reported = limited("fine.toml", 4_000_000);
    reported.ends_with(1).tells("6e6 elements").tells("need about").tells("GB of memory (");
    // Half of what is refused fits, so that the estimate is no wild guess.
    sandbox.put("half.toml", fine(300_000));
    limited("half.toml", 2_000_000).ends_with(0);
}

#[test]
fn a_load_that_swings_faster_than_any_step_is_refused() {
    let sandbox = Sandbox::new();
    let shaken = |frequency: &str| {
        let load = "[load.hum]\nkind = \"point\"\nat = \"girder.mid\"\nforce = [0, 1]\n";
        let function =
            format!("function = {{ kind = \"harmonic\", frequency = \"{frequency}\" }}\n");
        sandbox.put("hum.toml", format!("{}\n{load}{function}", crate::common::ELASTIC));
        sandbox.percuss(&["check", "hum.toml"])
    };
    shaken("50 Hz").ends_with(0);
    shaken("1e300 Hz").ends_with(2).tells("load.hum.function").tells("periods in a step");
}
