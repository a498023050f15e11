//! What is reported runs agrees with what their summaries and histories show.

use crate::common::Sandbox;
use serde_json::Value;

/// A cantilever under a blast, at whose end a mass flies: the blast moves the end before the mass arrives.
const BLAST: &str = r#"
[material.m]
preset = "steel"
[section.s]
shape = "rectangle"
width = "50 mm"
depth = "20 mm"
[beam.b]
points = [[0, 0], ["1.5 m", 0]]
elements = 12
material = "m"
section = "s"
[support.a]
at = "b.start"
kind = "clamp"
[load.blast]
kind = "distributed"
on = "b"
force = [0, "-6 kN/m"]
function = { kind = "triangle", duration = "6 ms" }
[projectile.p]
kind = "elastic"
mass = "2 kg"
stiffness = "1e6 N/m"
velocity = [0, "-2 m/s"]
strikes = "b.end"
standoff = "4 mm"
[time]
end = "30 ms"
step = "20 us"
"#;

/// Runs a scenario; the summary, all that is reported and standard error.
fn run(sandbox: &Sandbox, text: &str, set: &[&str]) -> (Value, String, String) {
    sandbox.put("a.toml", text);
    let set = set.iter().flat_map(|one| ["--set", one]);
    let arguments: Vec<&str> =
        ["run", "a.toml", "--no-report", "--out", "a"].into_iter().chain(set).collect();
    let outcome = sandbox.percuss(&arguments);
    outcome.ends_with(0);
    let reported = format!("{}{}", outcome.stdout, outcome.stderr);
    (sandbox.summary("a"), reported, outcome.stderr)
}

/// The findings of a code.
fn findings<'v>(summary: &'v Value, code: &str) -> Vec<&'v Value> {
    let all = summary["advice"].as_array().map_or(&[][..], Vec::as_slice);
    all.iter().filter(|one| one["code"] == code).collect()
}

/// By free flight the mass would arrive after 4 mm / (2 m/s) = 2 ms; the summary says when it did.
#[test]
fn a_first_touch_is_reported_as_the_run_shows_it() {
    let sandbox = Sandbox::empty();
    let (summary, ..) = run(&sandbox, BLAST, &[]);
    let start = summary["contact"]["p"]["intervals"][0]["start"].as_f64().unwrap();
    assert!((start - 2.236e-3).abs() < 1e-6, "{start}");
    let reported = findings(&summary, "W001");
    assert_eq!(reported.len(), 1, "{reported:?}");
    assert_eq!(reported[0]["value"].as_f64(), Some(start), "{reported:?}");
    assert_eq!(reported[0]["text"], "first contact at 2.24 ms of 30 ms");
}

/// Before the run nothing that a blast, a moved support or another projectile may change is reported as certain: where a trial of the model
/// tells the time it is that of the trial, else what else acts is named.
#[test]
fn a_touch_that_loads_change_is_no_fact_before_the_run() {
    let sandbox = Sandbox::empty();
    sandbox.put("a.toml", BLAST);
    let reported = |end: &str| sandbox.percuss(&["check", "a.toml", "--set", end]).stderr;
    // Free flight would take 2 ms.
    let seen = reported("time.end=2.1e-3");
    assert!(seen.contains("no contact before the end (2.1 ms) in a trial computation"), "{seen}");
    let rigid = "kind = \"rigid\"\nrestitution = 0.5";
    sandbox.put(
        "a.toml",
        BLAST.replace("kind = \"elastic\"", rigid).replace("stiffness = \"1e6 N/m\"\n", ""),
    );
    let guessed = reported("time.end=1e-3");
    assert!(guessed.contains("note: p, first contact: first contact at "), "{guessed}");
    assert!(
        guessed.contains("2 ms for free motion, after the end (1 ms); other loads act as well"),
        "{guessed}"
    );
}

/// The rows of hand formulas.
fn by_hand(summary: &Value) -> &[Value] {
    summary["hand_formulas"].as_array().map_or(&[], Vec::as_slice)
}

/// A bound is called one where all that it assumes is so: here a blast acts as well.
#[test]
fn a_bound_whose_assumptions_fail_is_not_called_one() {
    let sandbox = Sandbox::empty();
    let (summary, out, _) = run(&sandbox, BLAST, &[]);
    let rows = by_hand(&summary);
    let force = rows.iter().find(|row| row["quantity"] == "largest contact force").unwrap();
    assert!(force["holds_if"].as_str().unwrap().contains("(not met)"), "{force}");
    assert!(!out.contains("upper bound"), "{out}");
    let [before, after] = ["[load.blast]", "[projectile.p]"].map(|part| BLAST.find(part).unwrap());
    let quiet = format!("{}{}", &BLAST[..before], &BLAST[after..]);
    let (summary, ..) = run(&sandbox, &quiet, &[]);
    let bound = by_hand(&summary).iter().find(|row| row["formula"] == "upper bound of the force");
    let [bound, found] =
        [&bound.unwrap()["by_hand"], &summary["contact"]["p"]["peak_force"]["value"]];
    assert!(bound.as_f64() > found.as_f64(), "{bound} {found}");
}

/// A mass of 40 kg on a pinned beam, as fast as it is given.
const BLOW: &str = r#"
[material.m]
young = "210 GPa"
density = 7850
yield = "235 MPa"
[section.s]
shape = "rectangle"
width = "50 mm"
depth = "50 mm"
fibres = 8
[beam.b]
points = [[0, 0], ["2 m", 0]]
elements = 8
material = "m"
section = "s"
[support.a]
at = "b.start"
kind = "pin"
[support.z]
at = "b.end"
kind = "roller"
[projectile.p]
kind = "elastic"
mass = "40 kg"
stiffness = "2e4 N/m"
velocity = [0, "-0.5 m/s"]
strikes = "b.mid"
[time]
end = "0.3 s"
step = "0.2 ms"
[record]
points = ["b.mid"]
"#;

/// Elastic formulas beside a beam that yielded say so; beside one that could have, and did not, too.
#[test]
fn elastic_formulas_say_whether_the_beam_stayed_elastic() {
    let sandbox = Sandbox::empty();
    let (summary, ..) = run(&sandbox, BLOW, &[]);
    assert!(summary["plastic"]["b"]["first_yield"].is_null());
    let rows = by_hand(&summary);
    assert!(!rows.is_empty());
    for row in rows.iter().filter(|row| row["formula"] != "upper bound of the force") {
        assert!(
            row["holds_if"].as_str().unwrap().contains("elastic, without failure (met)"),
            "{row}"
        );
    }
    let (summary, ..) = run(&sandbox, BLOW, &["projectile.p.velocity=[0, -16]"]);
    assert!(summary["plastic"]["b"]["first_yield"]["time"].as_f64().is_some());
    let rows = by_hand(&summary);
    assert!(!rows.is_empty());
    for row in rows.iter().filter(|row| row["formula"] != "upper bound of the force") {
        assert!(
            row["holds_if"].as_str().unwrap().contains("elastic: beam 'b' yields at "),
            "{row}"
        );
    }
}

/// What a formula of one touch says is set beside that touch, under a name that says so where there were others.
#[test]
fn a_largest_force_by_hand_is_named_after_what_it_is_compared_with() {
    let sandbox = Sandbox::empty();
    let mut seen = [false; 2];
    let stiff = BLOW.replace("2e4 N/m", "1e7 N/m").replace("0.2 ms", "0.05 ms");
    for mass in ["4 kg", "100 kg"] {
        let (summary, ..) = run(&sandbox, &stiff.replace("40 kg", mass), &["time.end=0.05"]);
        let contact = &summary["contact"]["p"];
        let touches = contact["intervals"].as_array().unwrap();
        seen[usize::from(touches.len() > 1)] = true;
        for row in by_hand(&summary) {
            let found = match row["quantity"].as_str().unwrap() {
                "largest contact force" => &contact["peak_force"]["value"],
                "largest force of the first contact" => &touches[0]["peak_force"]["value"],
                _ => continue,
            };
            assert_eq!(row["simulated"], *found, "{row}");
        }
    }
    assert_eq!(seen, [true, true], "one touch, and several");
}

/// A beam of one metre with fibres that yield, clamped at its start.
const FIBRES: &str = r#"
[material.m]
young = "205 GPa"
density = 7850
yield = "275 MPa"
[section.s]
shape = "rectangle"
width = "40 mm"
depth = "40 mm"
fibres = 8
[beam.g]
points = [[0, 0], [1, 0]]
elements = 4
material = "m"
section = "s"
[support.a]
at = "g.start"
kind = "clamp"
"#;

/// A cantilever that a moment of 1.2 times that of first yield preloads, and that it leaves in the run.
fn preloaded() -> String {
    format!("{FIBRES}{PRELOAD}")
}

const PRELOAD: &str = r#"[load.m]
kind = "point"
at = "g.end"
moment = 3900
function = { kind = "table", times = [0, 0.01, 0.03], values = [1, 1, -0.9] }
[time]
end = 0.04
step = 0.0002
start = "static"
"#;

/// What the preload dissipated and what the run did are distinguished: the second is that of the balance of energy.
#[test]
fn energy_dissipated_by_a_preload_is_distinguished_from_the_run() {
    let sandbox = Sandbox::empty();
    let (summary, out, _) = run(&sandbox, &preloaded(), &[]);
    let number = |path: &str| summary.pointer(path).and_then(Value::as_f64).unwrap();
    let all = number("/plastic/g/dissipated");
    let preload = number("/plastic/g/dissipated_by_preload");
    let in_run = number("/energy/plastic");
    assert!(preload > 0.1 * all && in_run > 1e-6 * all, "{all} {preload} {in_run}");
    assert!((all - preload - in_run).abs() < 1e-9 * all, "{all} {preload} {in_run}");
    assert!(out.contains(" in the static start, "), "{out}");
    assert!(out.contains("dissipated by plastic flow in the run"), "{out}");
}

/// Without a damper nothing is said of damping: the contact's own dissipation took what is missing.
#[test]
fn energy_dissipated_in_contacts_is_not_called_damping() {
    let sandbox = Sandbox::empty();
    let dissipates = BLAST.replace("\"1e6 N/m\"", "\"1e6 N/m\"\ndissipation = \"0.3 s/m\"");
    let dissipates = dissipates.replace("-6 kN/m", "0 kN/m");
    let (summary, out, _) = run(&sandbox, &dissipates, &[]);
    let number = |path: &str| summary.pointer(path).and_then(Value::as_f64).unwrap();
    let (lost, scale) = (number("/energy/loss_damping"), number("/energy/scale"));
    assert!(lost > 1e-3 * scale, "{lost} of {scale}");
    assert!((lost - number("/energy/loss_contacts")).abs() < 1e-13 * scale, "{summary}");
    assert!(out.contains("dissipated in contacts"), "{out}");
    assert!(!out.contains("dissipated by damping"), "{out}");
}

/// A beam in millimetres and newtons is reported as that, in one sentence, and not as several slips.
#[test]
fn a_scenario_in_millimetres_is_recognised_once() {
    let sandbox = Sandbox::empty();
    let text = |young: &str, width: &str, depth: &str, length: &str| {
        format!(
            "[material.m]\nyoung = {young}\ndensity = 7850\n[section.s]\nshape = \"rectangle\"\nwidth = {width}\ndepth = {depth}\n\
             [beam.b]\npoints = [[0, 0], [{length}, 0]]\nelements = 4\nmaterial = \"m\"\nsection = \"s\"\n\
             [support.l]\nat = \"b.start\"\nkind = \"pin\"\n[support.r]\nat = \"b.end\"\nkind = \"pin\"\n\
             [load.p]\nkind = \"point\"\nat = \"b.mid\"\nforce = [0, -1000]\n[time]\nend = 0.1\nstep = 0.001\n"
        )
    };
    sandbox.put("mm.toml", text("210000", "100", "200", "4000"));
    let reported = sandbox.percuss(&["check", "mm.toml"]).stderr;
    assert_eq!(reported.matches("warning: ").count(), 1, "{reported}");
    assert!(reported.contains("values appear to be in mm and N"), "{reported}");
    assert!(reported.contains("\"4000 mm\", \"2.10e5 MPa\""), "{reported}");
    for (young, width, depth, length) in
        [("210e9", "0.1", "0.2", "4"), ("2e5", "0.01", "0.02", "0.5"), ("210e9", "2", "3", "100")]
    {
        sandbox.put("m.toml", text(young, width, depth, length));
        let reported = sandbox.percuss(&["check", "m.toml"]).stderr;
        assert!(!reported.contains("in mm and N"), "{reported}");
    }
}

/// A cantilever that a moment at its end bends 1.2 times as far as to first yield: `static` tells what a run that is loaded as slowly tells.
#[test]
fn statics_tells_of_yield_what_a_run_tells() {
    let sandbox = Sandbox::empty();
    let text = preloaded().replace("values = [1, 1, -0.9]", "values = [1, 1, 1]");
    let (summary, ..) = run(&sandbox, &text, &["time.end=0.002"]);
    let outcome = sandbox.percuss(&["static", "a.toml", "--out", "s"]);
    outcome.ends_with(0);
    let found: Value = {
        let text = std::fs::read_to_string(sandbox.path("s").join("static.json")).unwrap();
        serde_json::from_str(&text).unwrap()
    };
    let (found, reported) = (&found["plastic"]["g"], &summary["plastic"]["g"]);
    let near = |path: &str| {
        let of = |value: &Value| value.pointer(path).and_then(Value::as_f64).unwrap();
        let (a, b) = (of(found), of(reported));
        assert!((a - b).abs() <= 1e-6 * b.abs(), "{path}: {a} {b}");
    };
    for path in [
        "/strain_max",
        "/accumulated_max",
        "/rotation",
        "/permanent_set",
        "/dissipated",
        "/hinges/0/rotation",
    ] {
        near(path);
    }
    // First yield at W sigma = 0.04^3/6 * 275e6 = 2933 N m with the outermost of 8 fibres at 7/8 of the half depth, so beyond it.
    let share = found["first_yield"]["load_factor"].as_f64().unwrap();
    assert!((2933.0 / 3900.0..=1.0).contains(&share), "{share}");
    for words in [
        "first yield at s = ",
        "largest plastic strain ",
        "permanent deflection ",
        "plastic hinge: rotation ",
    ] {
        assert!(outcome.stdout.contains(words), "{words}: {}", outcome.stdout);
    }
    assert!(!outcome.stdout.contains("mechanism"), "{}", outcome.stdout);
}

/// A cantilever with hardening of a fiftieth of its stiffness, loaded 1.6 times as far as to first yield: beyond 1.5 times, its plastic
/// moment, only hardening holds it.
#[test]
fn statics_tells_that_a_plastic_mechanism_was_passed() {
    let sandbox = Sandbox::empty();
    let hardens = "yield = \"275 MPa\"\nhardening = { isotropic = \"4.1 GPa\" }";
    let text = preloaded().replace("yield = \"275 MPa\"", hardens).replace("3900", "4700");
    sandbox.put("a.toml", text);
    let outcome = sandbox.percuss(&["static", "a.toml"]);
    outcome.ends_with(0);
    assert!(
        outcome.stdout.contains("plastic mechanism: displacements grew up to "),
        "{}",
        outcome.stdout
    );
}

/// A beam between two clamps that let go after the impact.
fn released() -> String {
    let beam = FIBRES.replace("elements = 4", "elements = 8");
    beam.replace("density = 7850", "density = 7850\nstrain = \"engineering\"") + RELEASE
}

const RELEASE: &str = r#"[support.b]
at = "g.end"
kind = "clamp"
until = 0.005
[projectile.p]
kind = "elastic"
mass = 60
velocity = [0, -8]
strikes = "g.mid"
standoff = 0.0
stiffness = 4e6
[time]
end = 0.01
step = 2e-05
"#;

/// Where a permanent set is `null` its reason stands beside it; without yield it is zero.
#[test]
fn a_permanent_set_is_reported_or_the_reason_why_not() {
    let sandbox = Sandbox::empty();
    let set = |text: &str| {
        let (summary, reported, _) = run(&sandbox, text, &[]);
        let beam = &summary["plastic"]["g"];
        let note = beam["permanent_set_note"].as_str().map(str::to_owned);
        (beam["permanent_set"].as_f64(), note, reported)
    };
    let (held, note, reported) = set(&released());
    assert!(held.unwrap() > 0.01 && note.is_none(), "{held:?} {note:?}");
    assert!(reported.contains("permanent deflection "), "{reported}");
    assert!(reported.contains(" mm, (x, y) = ("), "{reported}");
    let flies = released()
        .replace("kind = \"clamp\"\n[support.b]", "kind = \"clamp\"\nuntil = 0.005\n[support.b]");
    let (none, note, reported) = set(&flies);
    let reason = "it can move without strain at the end";
    assert_eq!((none, note.as_deref()), (None, Some(reason)));
    assert!(
        reported.contains(&format!("permanent deflection not available: {reason}")),
        "{reported}"
    );
    let (zero, note, _) = set(&released().replace("-8", "-0.01"));
    assert_eq!((zero, note), (Some(0.0), None));
}
