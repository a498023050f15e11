//! Scenes of every kind reach every command, from a file or from standard input.

use crate::common;

use std::io::Write;
use std::process::Stdio;

use common::{ELASTIC, Sandbox};

/// Three discs in a row and a wall: a cradle that comes back.
const CRADLE: &str = r#"
[projectile.a]
kind = "rigid"
contact = "surface"
mass = 1
radius = 0.03
position = [0, 0]
velocity = [1, 0]
strikes = "b"
restitution = 1
[projectile.b]
kind = "rigid"
contact = "surface"
mass = 1
radius = 0.03
position = [0.1, 0]
velocity = [0, 0]
strikes = "wall"
restitution = 1
[obstacle.wall]
kind = "half-plane"
point = [0.3, 0]
normal = [-1, 0]
[time]
end = 1
step = 1e-3
"#;

fn fed(sandbox: &Sandbox, text: &str, arguments: &[&str]) -> common::Outcome {
    let mut child = sandbox.command(arguments).stdin(Stdio::piped()).spawn().expect("the command");
    child.stdin.take().expect("its input").write_all(text.as_bytes()).expect("the scenario");
    child.wait_with_output().expect("its end").into()
}

/// The first disc strikes the second, which comes back from the wall and strikes it in turn: it leaves as fast as it came.
#[test]
fn a_scene_needs_no_beam() {
    let sandbox = Sandbox::empty();
    sandbox.put("cradle.toml", CRADLE);
    let checked = sandbox.percuss(&["check", "cradle.toml"]);
    assert_eq!(checked.status, Some(0), "{}", checked.stderr);
    assert!(checked.stdout.contains("no errors; 0 beams"), "{}", checked.stdout);
    let run = sandbox.percuss(&["run", "cradle.toml", "--json"]);
    assert_eq!(run.status, Some(0), "{}", run.stderr);
    let summary: serde_json::Value = serde_json::from_str(&run.stdout).expect("a summary");
    let velocity = summary["projectile"]["a"]["velocity_final"][0].as_f64().expect("a velocity");
    assert!((velocity + 1.0).abs() < 1e-9, "{velocity}");
    assert!(sandbox.path("runs/cradle/report.html").exists());
    assert_eq!(sandbox.percuss(&["report", "runs/cradle"]).status, Some(0));
    for command in ["static", "modes"] {
        let refused = sandbox.percuss(&[command, "cradle.toml"]);
        assert_eq!(refused.status, Some(2));
        assert!(refused.stderr.contains("this scenario has no beams"), "{}", refused.stderr);
    }
}

#[test]
fn a_dash_reads_standard_input() {
    let sandbox = Sandbox::empty();
    let checked = fed(&sandbox, ELASTIC, &["check", "-"]);
    assert_eq!(
        (checked.status, checked.stdout.starts_with("standard input: no errors")),
        (Some(0), true)
    );
    let run =
        fed(&sandbox, ELASTIC, &["run", "-", "--no-report", "--quiet", "--set", "time.end=0.02"]);
    assert_eq!(run.status, Some(0), "{}", run.stderr);
    assert!(sandbox.path("runs/stdin/summary.json").exists());
    assert_eq!(fed(&sandbox, ELASTIC, &["modes", "-"]).status, Some(0));
    assert!(sandbox.path("runs/stdin-modes/modes.json").exists());
    assert_eq!(fed(&sandbox, ELASTIC, &["static", "-"]).status, Some(0));
    let wrong = fed(&sandbox, "[time]\nend = 1\nstep = 0.1\n", &["check", "-"]);
    assert_eq!(wrong.status, Some(2));
    assert!(wrong.stderr.contains("standard input:1:1: beam: found no beam"), "{}", wrong.stderr);
    // Files that it names lie from the working directory on.
    sandbox.put("push.csv", "0,0\n1,1\n");
    let pushed = format!(
        "{ELASTIC}\n[load.push]\nkind = \"point\"\nat = \"girder.mid\"\nforce = [0, 1]\n\
         function = {{ kind = \"table\", csv = \"push.csv\" }}\n"
    );
    let checked = fed(&sandbox, &pushed, &["check", "-"]);
    assert!(!checked.stderr.contains("push.csv"), "{}", checked.stderr);
}

#[test]
fn entries_of_lists_are_set_by_the_paths_of_studies() {
    let sandbox = Sandbox::new();
    let set = ["run", "elastic.toml", "--no-report", "--json", "--set", "time.end=1e-3", "--set"];
    let speed = |change: &str| {
        let run = sandbox.percuss(&[&set[..], &[change]].concat());
        assert_eq!(run.status, Some(0), "{}", run.stderr);
        let summary: serde_json::Value = serde_json::from_str(&run.stdout).expect("a summary");
        summary["projectile"]["mass"]["velocity_final"][1].as_f64()
    };
    assert_eq!(speed("projectile.mass.velocity[1]=30 m/s"), Some(30.0));
    assert_eq!(speed("projectile.mass.velocity.1=25"), Some(25.0));
    let beyond =
        sandbox.percuss(&["check", "elastic.toml", "--set", "projectile.mass.velocity[2]=1"]);
    assert_eq!(beyond.status, Some(2));
    assert!(beyond.stderr.contains("an entry from 0 to 1"), "{}", beyond.stderr);
}

#[test]
fn converge_tells_orders_limits_and_settings() {
    let sandbox = Sandbox::new();
    let arguments = ["converge", "elastic.toml", "--levels", "3", "--accuracy", "1 %", "--quiet"];
    let result = ["--result", "contact.mass.peak_force.value", "--set", "time.step=1e-3"];
    let reported = sandbox.percuss(&[&arguments[..], &result].concat());
    assert_eq!(reported.status, Some(0), "{}", reported.stderr);
    for words in ["step: converges with order", "mesh: ", "limit", "least work for an error of 1 %"]
    {
        assert!(reported.stdout.contains(words), "{words}: {}", reported.stdout);
    }
    let json = sandbox.percuss(&[&arguments[..], &result, &["--json"]].concat());
    let value: serde_json::Value = serde_json::from_str(&json.stdout).expect("JSON");
    assert!(value["results"][0]["step"]["order"].as_f64().is_some_and(|order| order > 1.5));
    let wrong = sandbox.percuss(&["converge", "elastic.toml", "--accuracy", "1 m"]);
    assert_eq!(wrong.status, Some(2));
}

#[test]
fn derivatives_that_are_refused_are_wrong_input() {
    let sandbox = Sandbox::new();
    let arguments =
        ["sensitivity", "elastic.toml", "--parameter", "projectile.mass.mass", "--result"];
    let refused = sandbox.percuss(&[&arguments[..], &["support.left.force_2.max.value"]].concat());
    assert_eq!(refused.status, Some(2), "{}", refused.stderr);
    let reported = sandbox.percuss(&[&arguments[..], &["contact.mass.peak_force.value"]].concat());
    assert_eq!(
        (reported.status, reported.stdout.contains("+-")),
        (Some(0), true),
        "{}",
        reported.stdout
    );
}

/// A result without a derivative is named with the reason, in a table and in JSON; where none has one there is nothing to tell.
#[test]
fn results_without_derivatives_are_named() {
    let sandbox = Sandbox::new();
    let arguments =
        ["sensitivity", "elastic.toml", "--parameter", "projectile.mass.mass", "--result", "steps"];
    let alone = sandbox.percuss(&arguments);
    assert_eq!(alone.status, Some(2), "{}", alone.stdout);
    assert!(alone.stderr.contains("it is a count"), "{}", alone.stderr);
    let both = [&arguments[..], &["--result", "contact.mass.peak_force.time"]].concat();
    let reported = sandbox.percuss(&both);
    assert!(reported.stdout.contains("none: it is a count"), "{}", reported.stdout);
    let json = sandbox.percuss(&[&both[..], &["--json"]].concat());
    let json: serde_json::Value = serde_json::from_str(&json.stdout).expect("JSON alone");
    assert!(json["derivatives"][0][0].is_null() && json["horizon"].is_null(), "{json}");
    assert!(json["derivatives"][1][0].as_f64().is_some_and(|x| x > 0.0), "{json}");
    assert_eq!(json["without"][0]["why"], "it is a count");
    let step = ["sensitivity", "elastic.toml", "--parameter", "time.step"];
    let refused = sandbox.percuss(&step);
    assert_eq!(refused.status, Some(2), "{}", refused.stdout);
    assert!(refused.stderr.contains("is an error"), "{}", refused.stderr);
}

/// What crushed is reported where the run ends, and what it took stands with its name; an accuracy in place of a step is reported likewise.
#[test]
fn permanent_penetration_and_lengths_of_steps_are_reported() {
    let sandbox = Sandbox::empty();
    let post = include_str!("../../../../scenarios/guard-rail-post.toml");
    let post = post.replace("end = \"0.3 s\"", "end = \"20 ms\"");
    let chosen = post.replace("step = \"50 us\"", "accuracy = \"2 %\"");
    assert!(post != chosen && chosen.contains("20 ms"));
    for (name, text) in [("post", &post), ("chosen", &chosen)] {
        sandbox.put(&format!("{name}.toml"), text);
        let run = sandbox.percuss(&["run", &format!("{name}.toml"), "--no-report"]);
        run.ends_with(0).tells("permanent indentation").tells("dissipated in contacts");
        let contact = &sandbox.summary(&format!("runs/{name}"))["contact"]["car"];
        let permanent = contact["permanent_penetration"].as_f64().unwrap_or(0.0);
        // 40 kN slow 900 kg down: 5 m/s over 20 ms come to 91 mm, less what the post gives way by.
        assert!((0.08..0.091).contains(&permanent), "{contact:#}");
        // The post yields: the force is that on an elastic one.
        assert_eq!(contact["equivalent_force"]["as_if_elastic"], true, "{contact:#}");
        let summary = sandbox.summary(&format!("runs/{name}"));
        assert_eq!(summary.get("step_control").is_some(), name == "chosen", "{summary:#}");
    }
    let both = chosen.replace("accuracy", "step = 1e-5\naccuracy");
    sandbox.put("both.toml", both);
    sandbox.percuss(&["run", "both.toml"]).ends_with(2).tells("accuracy");
}

/// A block that slides to rest on rigid ground: v^2 / (2 mu g) = 0.5 m, m v^2 / 2 = 4 J.
#[test]
fn sliding_distance_and_friction_work_are_reported() {
    const SLIDE: &str = r#"
[projectile.block]
kind = "rigid"
contact = "surface"
mass = 2
inertia = 1e9
radius = 0.1
position = [0, 0.1]
velocity = [2, 0]
strikes = "ground"
restitution = 0
friction = 0.4
[obstacle.ground]
kind = "half-plane"
point = [0, 0]
normal = [0, 1]
[load.weight]
kind = "gravity"
acceleration = [0, -10]
[time]
end = 0.6
step = 1e-3
"#;
    let sandbox = Sandbox::empty();
    sandbox.put("slide.toml", SLIDE);
    let run = sandbox.percuss(&["run", "slide.toml"]);
    run.ends_with(0).tells("sliding distance 500 mm, friction work 4 J");
    let contact = &sandbox.summary("runs/slide")["contact"]["block"];
    let of = |key: &str| contact[key].as_f64().unwrap_or(f64::NAN);
    assert!((of("sliding_distance") - 0.5).abs() < 1e-5, "{contact:#}");
    assert!((of("friction_work") - 4.0).abs() < 1e-8, "{contact:#}");
    let page = std::fs::read_to_string(sandbox.path("runs/slide/report.html")).expect("the page");
    assert!(page.contains("sliding distance") && page.contains("friction work"));
    sandbox.put("smooth.toml", SLIDE.replace("friction = 0.4\n", ""));
    let smooth = sandbox.percuss(&["run", "smooth.toml", "--no-report"]);
    smooth.ends_with(0);
    assert!(!smooth.stderr.contains("friction work"), "{}", smooth.stderr);
}

/// The sentence on springs and hinges that yield is about the one that dissipated most, and what they dissipated makes the whole.
#[test]
fn energy_taken_by_springs_and_hinges_is_reported() {
    let sandbox = Sandbox::empty();
    sandbox
        .put("barrier.toml", include_str!("../../../../docs/book/examples/yielding-barrier.toml"));
    let run = sandbox.percuss(&["run", "barrier.toml", "--no-report"]);
    run.ends_with(0);
    let summary = sandbox.summary("runs/barrier");
    let all = summary["yielding"].as_object().expect("what can yield");
    let lost = |one: &serde_json::Value| one["dissipated"].as_f64().unwrap_or(f64::NAN);
    let (most, _) = all.iter().max_by(|a, b| lost(a.1).total_cmp(&lost(b.1))).expect("one of them");
    let reported = format!("{}{}", run.stdout, run.stderr);
    let reported = reported.split_whitespace().collect::<Vec<_>>().join(" ");
    let most = most.replacen('.', " '", 1);
    let sentence = format!(
        "4 of 4 springs and joints with a limit yielded. Largest dissipation in {most}': first yield at t = "
    );
    assert!(reported.contains(&sentence), "{reported}");
    let plastic = summary["energy"]["plastic"].as_f64().unwrap_or(f64::NAN);
    let sum: f64 = all.values().map(lost).sum();
    assert!((sum / plastic - 1.0).abs() < 1e-12, "{sum}, {plastic}");
    // The tie fails; what it stored is lost with it.
    let tie = &all["spring.tie"];
    assert!(
        tie["failure"]["time"].is_number() && summary["energy"]["failure"].as_f64() > Some(0.0)
    );
}
