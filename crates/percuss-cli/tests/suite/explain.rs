//! Codes of the advisor: each is provoked, explained, and can be denied; tables, keys and words of files are explained, too.

use std::path::Path;

use percuss_advice::Topic;

use crate::common::Sandbox;

const SCENARIOS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/");

/// A rod struck along its axis: by a hammer, or by a wall that it flies into.
const ROD: &str = r#"
[material.steel]
preset = "steel"
[section.rod]
shape = "rectangle"
width = "20 mm"
depth = "5 mm"
[beam.rod]
points = [[0, 0], [1, 0]]
elements = 10
material = "steel"
section = "rod"
[time]
end = "3 ms"
step = "2 us"
"#;
const HAMMER: &str = r#"
[support.foot]
at = "rod.start"
kind = "clamp"
[projectile.hammer]
kind = "elastic"
mass = "1 kg"
stiffness = "1e8 N/m"
velocity = ["-5 m/s", 0]
strikes = "rod.end"
standoff = "1 mm"
"#;
const WALL: &str = r#"
[initial.rod]
velocity = ["-5 m/s", 0]
[obstacle.wall]
kind = "half-plane"
point = ["-1 mm", 0]
normal = [1, 0]
[contact.face]
between = ["rod", "wall"]
law = "linear"
stiffness = "1e12 N/m"
"#;

/// It swings down before it starts.
const PENDULUM: &str = r#"
start = "static"
[support.pivot]
at = "rod.start"
kind = "elastic"
stiffness = ["1e8 N/m", "1e8 N/m"]
rotational_stiffness = "0.1 N*m"
[load.weight]
kind = "gravity"
acceleration = [0, "-9.81 m/s^2"]
"#;
/// It lies along another one.
const RAM: &str = r#"
[support.foot]
at = "rod.start"
kind = "clamp"
[beam.lath]
points = [["0.2 m", "6 mm"], ["0.7 m", "6 mm"]]
elements = 5
material = "steel"
section = "rod"
[initial.lath]
velocity = [0, "-1 m/s"]
[contact.clap]
between = ["rod", "lath"]
law = "linear"
stiffness = "1e5 N/m"
"#;
/// Another one begins where it ends, and nothing joins them.
const LOOSE: &str = r#"
[support.foot]
at = "rod.start"
kind = "clamp"
[beam.arm]
points = [[1, 0], [1, 0.5]]
elements = 4
material = "steel"
section = "rod"
[support.head]
at = "arm.end"
kind = "clamp"
"#;
/// A run that provokes each code: the scenario, and one change.
fn provocations() -> Vec<(Topic, String, &'static str)> {
    let of = |name: &str| format!("{SCENARIOS}{name}.toml");
    let (elastic, puck) = ("elastic.toml".to_owned(), of("oblique-throw"));
    let stiff = "projectile.puck.stiffness=\"1e14 N/m\"";
    Topic::ALL
        .into_iter()
        .map(|topic| {
            let (file, set) = match topic {
                Topic::FirstContact => (elastic.clone(), "time.end=0.005"),
                Topic::ContactDuration => (elastic.clone(), "time.step=0.01"),
                Topic::BendingWave => (puck.clone(), stiff),
                Topic::WaveTransit => (of("disc-chain"), "record.every=1"),
                Topic::EffectiveMass => (of("paper/rigid-clamped-e1"), "record.every=1"),
                Topic::Stiffness => (puck.clone(), stiff),
                Topic::Span => (elastic.clone(), "record.every=1"),
                Topic::RearMass => ("rear.toml".to_owned(), "record.every=1"),
                Topic::Shear => (of("drop-weight"), "time.end=0.005"),
                Topic::Stability => ("hammer.toml".to_owned(), "record.every=1"),
                Topic::ForceRise => ("wall.toml".to_owned(), "record.every=1"),
                Topic::Recording => (of("rattling-tube"), "time.end=0.01"),
                Topic::Reactions => (of("disc-chain"), "record.every=1"),
                Topic::Taper => (of("sweet-spot"), "record.every=1"),
                Topic::Strain | Topic::Magnitude => {
                    (elastic.clone(), "material.composite.young=2e5")
                }
                Topic::Ending => (elastic.clone(), "time.end=0.02"),
                Topic::StaticStart => ("pendulum.toml".to_owned(), "record.every=1"),
                Topic::FaceStiffness => ("ram.toml".to_owned(), "record.every=1"),
                Topic::Pressed => ("pressed.toml".to_owned(), "record.every=1"),
                Topic::CarriedCrush => ("carried.toml".to_owned(), "record.every=1"),
                Topic::Accuracy => ("accuracy.toml".to_owned(), "record.every=1"),
                Topic::Unresolved => ("unresolved.toml".to_owned(), "record.every=1"),
                Topic::Ductility => ("ductility.toml".to_owned(), "record.every=1"),
                Topic::Bed => ("bed.toml".to_owned(), "record.every=1"),
                Topic::LooseEnds => ("loose.toml".to_owned(), "record.every=1"),
                Topic::Strength => (of("disc-chain"), "material.steel.preset=\"concrete\""),
            };
            (topic, file, set)
        })
        .collect()
}

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.put("hammer.toml", [ROD, HAMMER].concat());
    sandbox.put("wall.toml", [ROD, WALL].concat());
    let rear = "stiffness = \"7.5e5 N/m\"\nrear = { mass = 100, stiffness = \"1e12 N/m\" }";
    let text = crate::common::ELASTIC.replace("stiffness = \"7.5e5 N/m\"", rear);
    sandbox.put("rear.toml", text);
    sandbox.put("pendulum.toml", [ROD, PENDULUM].concat());
    sandbox.put("ram.toml", [ROD, RAM].concat());
    // Those whose examples stand whole in the book.
    let book = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/book/codes.toml");
    let book = percuss_book::Provocations::load(&book).unwrap();
    let whole = [
        ("pressed.toml", "W022"),
        ("carried.toml", "W023"),
        ("accuracy.toml", "W024"),
        ("unresolved.toml", "W025"),
        ("ductility.toml", "W026"),
        ("bed.toml", "W027"),
    ];
    for (file, code) in whole {
        sandbox.put(file, book.scenario(code).expect("a whole scenario"));
    }
    sandbox.put("loose.toml", [ROD, LOOSE].concat());
    sandbox
}

#[test]
fn every_code_can_be_provoked_and_is_explained() {
    let sandbox = sandbox();
    let list = sandbox.percuss(&["explain"]).stdout;
    for (topic, file, set) in provocations() {
        let (code, name) = (topic.code(), topic.name());
        let run = sandbox.percuss(&["run", &file, "--out", "out", "--no-report", "--set", set]);
        run.ends_with(0).tells(&format!("[{code}]"));
        let advice = sandbox.summary("out")["advice"].as_array().expect("a list").clone();
        assert!(
            advice.iter().any(|a| a["code"] == code && a["topic"] == name),
            "{code}: {advice:?}"
        );
        let reported = sandbox.percuss(&["explain", &code.to_lowercase()]);
        reported.ends_with(0);
        assert!(reported.stdout.starts_with(&format!("{code}  {name}\n\n")), "{}", reported.stdout);
        assert!(reported.stdout.lines().all(|line| line.len() <= 96), "{}", reported.stdout);
        assert!(list.contains(&format!("{code}  {name}\n")), "{list}");
    }
    for fault in percuss_scenario::FaultCode::ALL {
        let heading = format!("{}  {}\n", fault.code(), fault.name());
        assert!(list.contains(&heading), "{list}");
        let reported = sandbox.percuss(&["explain", fault.code()]);
        reported.ends_with(0);
        assert!(reported.stdout.starts_with(&(heading + "\n")), "{}", reported.stdout);
    }
    sandbox.percuss(&["explain", "W099"]).ends_with(2).tells("no such code");
}

#[test]
fn denied_findings_end_a_run_before_it_or_fail_it_after() {
    let sandbox = sandbox();
    let run = |more: &[&str]| {
        sandbox.percuss(&[&["run", "elastic.toml", "--no-report", "--out", "out"], more].concat())
    };
    run(&["--deny", "W007"]).ends_with(2).tells("[W007] is denied");
    assert!(!sandbox.path("out").exists());
    sandbox
        .percuss(&["check", "elastic.toml", "--deny", "w007"])
        .ends_with(2)
        .tells("[W007] is denied");
    // What is found only afterwards: the results stay.
    let late = ["--set", "time.end=0.02", "--deny", "W016"];
    run(&late).ends_with(4).tells("[W016] is denied");
    assert!(sandbox.path("out/summary.json").is_file());
    run(&["--deny", "W005", "--deny", "W016"]).ends_with(0);
    run(&["--deny", "W0"]).ends_with(2).tells("no such code");
}

#[test]
fn allowed_findings_are_reported_with_their_reason_and_not_denied() {
    let sandbox = sandbox();
    let text = std::fs::read_to_string(sandbox.path("elastic.toml")).unwrap();
    let allow =
        "\n[allow]\nW007 = \"a short <beam>\"\nW012 = \"rows are few\"\nW013 = \"none are read\"\n";
    sandbox.put("allowed.toml", text + allow);
    let check = sandbox.percuss(&["check", "allowed.toml", "--deny", "W007"]);
    check.ends_with(0).tells("(reason: a short <beam>) [W007]");
    check.tells("[allow] W012: no such warning (");
    assert!(!check.stderr.contains("W013"), "only a run can tell: {}", check.stderr);
    for line in check.stderr.lines().filter(|line| line.contains("[W007]")) {
        assert!(line.starts_with("allowed: "), "{line}");
    }
    let run = sandbox.percuss(&["run", "allowed.toml", "--deny", "W007", "--out", "out"]);
    run.ends_with(0).tells("[allow] W013: no such warning (");
    let summary = sandbox.summary("out");
    let advice = summary["advice"].as_array().unwrap();
    let one = advice.iter().find(|a| a["code"] == "W007").unwrap();
    assert_eq!((&one["verdict"], &one["reason"]), (&"allowed".into(), &"a short <beam>".into()));
    let found: Vec<bool> =
        summary["allow"].as_array().unwrap().iter().map(|a| a["found"] == true).collect();
    assert_eq!(found, [true, false, false]);
    let page = std::fs::read_to_string(sandbox.path("out/report.html")).unwrap();
    assert!(page.contains("accepted: a short &lt;beam&gt; ("));
    assert!(page.contains("Allowed in the scenario but not raised: W012, W013"));
    // The results keep what was allowed, so that they can be run again.
    sandbox.percuss(&["check", "out/scenario.toml"]).ends_with(0).tells("a short <beam>");
    sandbox.percuss(&["check", "elastic.toml", "--deny", "W007"]).ends_with(2);
}

/// What is printed is the reference from which the book is written.
#[test]
fn tables_keys_and_words_of_files_are_explained() {
    let sandbox = Sandbox::empty();
    let explained = |topic: &str| {
        let outcome = sandbox.percuss(&["explain", topic]);
        outcome.ends_with(0);
        outcome.stdout
    };
    let beam = explained("beam");
    assert!(beam.starts_with("[beam.NAME]\n\n"), "{beam}");
    assert!(beam.lines().all(|line| line.chars().count() <= 96), "{beam}");
    let reference = percuss_scenario::reference();
    let table = reference.iter().find(|table| table.places == ["beam"]).unwrap();
    let in_one_line = beam.split_whitespace().collect::<Vec<_>>().join(" ");
    for key in &table.body.keys {
        assert!(beam.contains(&format!("\n  {}\n", key.name)), "{}: {beam}", key.name);
        assert!(in_one_line.contains(&key.about), "{}: {beam}", key.name);
    }
    assert!(in_one_line.contains("see `percuss explain beam.grading`"), "{beam}");
    // With the user's name of the table, as in a message.
    for path in ["projectile.stiffness", "projectile.hammer.stiffness"] {
        let key = explained(path);
        let start =
            "projectile.stiffness (kind = \"elastic\", law = \"linear\")\n\nStiffness (N/m).\n";
        assert!(key.starts_with(start), "{key}");
        assert!(key.contains("\"7.5e5 N/m\"") && key.contains("Required."), "{key}");
    }
    let hertz = explained("hertz");
    let places = ["projectile.law = \"hertz\" (kind = \"elastic\")", "contact.law = \"hertz\""];
    for words in places.into_iter().chain(["hertz_stiffness"]) {
        assert!(hertz.contains(words), "{words}: {hertz}");
    }
    assert!(explained("sequential").starts_with("time.multiple_impacts = \"sequential\"\n\n"));
    assert!(explained("latin-hypercube").contains("design.kind = \"latin-hypercube\" of a study"));
    for profile in ["IPE", "IPE 200", "W12x26", "chs 168.3x5"] {
        let text = explained(profile);
        assert!(text.starts_with("section.profile"), "{profile}: {text}");
        assert!(text.contains("EN 10365"), "{profile}: {text}");
    }
    // What is explained on the spot is not referred to.
    for table in ["joint.strength", "load.function"] {
        let text = explained(table).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(!text.contains(&format!("see `percuss explain {table}`")), "{text}");
        assert!(text.contains(&format!("{table} = {{ ... }}")), "{text}");
    }
    let base = explained("load.base.acceleration");
    assert!(base.starts_with("load.acceleration (kind = \"base\")\n"), "{base}");
    let list = sandbox.percuss(&["explain"]).stdout;
    assert!(
        list.contains("Tables of scenario files\n  [material.NAME]  Material of a beam."),
        "{list}"
    );
    sandbox.percuss(&["explain", "beeam"]).ends_with(2).tells("no such code, table, key or word");
}

/// The field's names stand beside the keys that have others.
#[test]
fn keys_are_documented_by_the_names_of_the_field() {
    let sandbox = Sandbox::empty();
    for (key, name) in [
        ("material.retardation", "Rayleigh's beta"),
        ("material.mass_damping", "Rayleigh's alpha"),
        ("material.bears", "Tension-only or compression-only"),
        ("material.failure_strain", "Fracture strain"),
        ("projectile.kind", "nonsmooth"),
        ("projectile.strikes", "Contact target"),
        ("projectile.standoff", "Initial gap"),
        ("projectile.rear", "trailing"),
        ("projectile.local_mass", "Added nodal mass"),
        ("joint.strength", "Breakaway strength"),
        ("fix", "Partial fixity"),
        ("contact.law", "compliant"),
        ("connector.law", "how the force follows from the extension"),
        ("grade", "structural steel S355, yield strength 355 MPa"),
        ("beam.section", "or a steel profile, such as \"IPE 200\""),
        ("beam.material", "such as \"S355\""),
        ("load.base.acceleration", "times `function`"),
    ] {
        let outcome = sandbox.percuss(&["explain", key]);
        outcome.ends_with(0);
        let text = outcome.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(name), "{key}: {text}");
    }
}
