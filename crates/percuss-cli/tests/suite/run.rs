//! What `percuss run` and `percuss report` promise.

use crate::common;

use common::{Sandbox, names};
use percuss_output::read_history;

const FILES: [&str; 6] =
    ["envelopes.csv", "fields", "impacts.csv", "report.html", "scenario.toml", "summary.json"];

/// What a run without a report leaves.
const UNREPORTED: [&str; 6] =
    ["envelopes.csv", "fields", "history.parquet", "impacts.csv", "scenario.toml", "summary.json"];

#[track_caller]
fn number(value: &serde_json::Value, pointer: &str) -> f64 {
    let found = value.pointer(pointer).and_then(serde_json::Value::as_f64);
    found.unwrap_or_else(|| panic!("no number {pointer} in {value:#}"))
}

#[test]
fn the_elastic_example_leaves_every_file_and_number_promised() {
    let sandbox = Sandbox::new();
    sandbox
        .percuss(&["run", "elastic.toml", "--out", "out", "--strict"])
        .ends_with(0)
        .tells("Completed, t = 150 ms, ")
        .tells("contact 'mass'")
        .tells("peak force")
        .tells("two-degree-of-freedom model, largest contact force");
    assert_eq!(sandbox.names(), ["elastic.toml", "out", "rigid.toml"]);
    for file in FILES.iter().chain(&["history.parquet"]) {
        assert!(sandbox.path("out").join(file).exists(), "no {file}");
    }
    let page = std::fs::read_to_string(sandbox.path("out/report.html")).unwrap();
    assert!(
        page.contains("<p class=\"status\">Completed, t = 150\u{a0}ms, "),
        "page and terminal agree"
    );
    let summary = sandbox.summary("out");
    assert_eq!(summary["status"], "completed");
    assert_eq!(summary["steps"], 1500);
    for pointer in [
        "/newton_iterations",
        "/factorizations",
        "/wall_seconds",
        "/energy/initial",
        "/energy/final",
        "/energy/residual_max",
        "/momentum/linear_residual_max",
        "/momentum/angular_residual_max",
        "/audit/curvature_drift_max",
        "/audit/angular_rate_drift_max",
        "/projectile/mass/velocity_final/0",
        "/projectile/mass/momentum_transferred",
        "/projectile/mass/energy_given",
        "/projectile/mass/energy_received_by_others",
        "/contact/mass/peak_force/value",
        "/contact/mass/peak_force/time",
        "/contact/mass/intervals/0/start",
        "/contact/mass/intervals/0/end",
        "/contact/mass/intervals/0/impulse",
        "/contact/mass/intervals/0/peak_force/value",
        "/contact/mass/intervals/0/restitution",
        "/contact/mass/intervals/0/place/s",
        "/contact/mass/intervals/0/energy/given/0",
        "/contact_residual_max",
        "/hand_formulas/0/difference_percent",
        "/point/girder.mid/displacement_max/component_1/value",
        "/point/girder.mid/displacement_max/component_2/time",
        "/energy/loss_damping",
        "/support/left/force_2/min/value",
        "/section_forces/girder/moment/max/s",
        "/section_forces/girder/moment_max/value",
    ] {
        number(&summary, pointer);
    }
    assert!((number(&summary, "/contact/mass/intervals/0/start") - 0.01).abs() < 1e-12);
    let history = read_history(sandbox.path("out")).expect("a history");
    assert_eq!(history.rows(), 1501);
    assert!(history.column("projectile.mass.position_2").is_some());
}

#[test]
fn the_rigid_example_leaves_impacts_and_a_comparison() {
    let sandbox = Sandbox::new();
    sandbox
        .percuss(&["run", "rigid.toml"])
        .ends_with(0)
        .tells("t = 500 \u{b5}s: impulse")
        .tells("effective mass")
        .tells("warning: ");
    let summary = sandbox.summary("runs/rigid");
    for key in ["time", "impulse", "approach_velocity", "separation_velocity"] {
        number(&summary, &format!("/contact/hammer/impacts/0/{key}"));
    }
    let series = percuss_output::read_comparison(sandbox.path("runs/rigid")).expect("a comparison");
    let labels: Vec<&str> = series.iter().map(|one| one.label.as_str()).collect();
    assert_eq!(labels, ["restitution 1", "restitution 0.5", "restitution 0"]);
    let last = |k: usize| *series[k].energy.last().expect("a row");
    assert!((last(0) / 80_000.0 - 1.0).abs() < 1e-12);
    assert!(last(1) < last(0) && last(2) < last(1));
}

#[test]
fn the_coefficients_compared_are_those_asked_for() {
    let sandbox = Sandbox::new();
    let asked = ["run", "rigid.toml", "--set", "report.restitution=[0.8, 0.2]", "--quiet"];
    sandbox.percuss(&asked).ends_with(0);
    let series = percuss_output::read_comparison(sandbox.path("runs/rigid")).expect("a comparison");
    let labels: Vec<&str> = series.iter().map(|one| one.label.as_str()).collect();
    assert_eq!(labels, ["restitution 0.8", "restitution 0.2"]);
    // A long run is not repeated unasked; a run without a report has none to put it in.
    sandbox.percuss(&["run", "rigid.toml", "--set", "time.step=5e-7", "-q"]).ends_with(0);
    assert!(!sandbox.path("runs/rigid/comparison.csv").exists());
    sandbox.percuss(&["run", "rigid.toml", "--no-report", "-q"]).ends_with(0);
    assert_eq!(names(&sandbox.path("runs/rigid")), UNREPORTED);
}

#[test]
fn the_advisor_speaks_before_the_run_and_in_the_report() {
    let sandbox = Sandbox::new();
    let coarse = ["run", "elastic.toml", "--set", "time.step=0.02 s"];
    let run = sandbox.percuss(&coarse);
    run.ends_with(0).tells("mass, contact duration: ").tells("set time.step to ");
    let warned = run.stderr.find("contact duration").expect("a finding");
    let table = run.stderr.find("Completed, t = ").expect("a table");
    assert!(warned < table, "it comes before the run");
    let advice = &sandbox.summary("runs/elastic")["advice"];
    let topics: Vec<&str> =
        advice.as_array().expect("a list").iter().filter_map(|a| a["topic"].as_str()).collect();
    assert!(topics.contains(&"first contact") && topics.contains(&"minimum span"), "{topics:?}");
    let page = std::fs::read_to_string(sandbox.path("runs/elastic/report.html")).expect("a page");
    assert!(page.contains(">Model and result checks</h2>") && page.contains("<h2>Impact log</h2>"));
    let check = sandbox.percuss(&["check", "elastic.toml", "--set", "time.step=0.02 s"]);
    check.ends_with(0).tells("mass, contact duration: ");
    let quiet = sandbox.percuss(&[&coarse[..], &["--quiet", "--no-report"]].concat());
    assert_eq!(quiet.ends_with(0).stderr, "");
}

#[test]
fn the_impact_log_is_a_table_in_the_order_of_time() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&["run", "rigid.toml", "--no-report", "-q"]).ends_with(0);
    let text = std::fs::read_to_string(sandbox.path("runs/rigid/impacts.csv")).expect("a log");
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let column = |name: &str| header.iter().position(|h| *h == name).expect("a column");
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let summary = sandbox.summary("runs/rigid");
    assert_eq!(
        rows.len() as u64,
        summary["contact"]["hammer"]["impact_count"].as_u64().expect("a count")
    );
    let first = number(&summary, "/contact/hammer/impacts/0/impulse");
    assert_eq!(rows[0][column("impulse_N_s")].parse::<f64>(), Ok(first));
    assert!(rows.iter().all(|row| row[column("force_peak_N")].is_empty()));
    let times = rows.iter().map(|row| row[column("start_s")].parse::<f64>().expect("a time"));
    assert!(times.is_sorted());
}

#[test]
fn json_is_all_there_is_on_standard_output() {
    let sandbox = Sandbox::new();
    let run = sandbox.percuss(&["run", "elastic.toml", "--json", "--no-report"]);
    run.ends_with(0);
    // The advisor may have a note; the table stands nowhere.
    assert!(run.stderr.lines().all(|line| line.starts_with("note: ")), "{}", run.stderr);
    let printed: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON alone");
    assert_eq!(printed, sandbox.summary("runs/elastic"));
    let plain = sandbox.percuss(&["run", "elastic.toml", "--no-report"]);
    assert_eq!(plain.ends_with(0).stdout, "");
}

#[test]
fn quiet_says_nothing() {
    let sandbox = Sandbox::new();
    let run = sandbox.percuss(&["run", "rigid.toml", "--quiet", "--no-report"]);
    run.ends_with(0);
    assert_eq!((run.stdout.as_str(), run.stderr.as_str()), ("", ""));
}

#[test]
fn set_changes_the_run_and_the_scenario_kept() {
    let sandbox = Sandbox::new();
    let velocity = "projectile.mass.velocity=[0,30]";
    let end = "time.end=0.01 s";
    let run = ["run", "elastic.toml", "--set", velocity, "--set", end, "--history", "csv", "-q"];
    sandbox.percuss(&run).ends_with(0);
    assert_eq!(number(&sandbox.summary("runs/elastic"), "/energy/initial"), 225_000.0);
    assert_eq!(sandbox.summary("runs/elastic")["steps"], 100);
    let history = read_history(sandbox.path("runs/elastic")).expect("a history");
    assert_eq!(history.source, "history.csv");
    // The scenario kept gives the same run.
    std::fs::copy(sandbox.path("runs/elastic/scenario.toml"), sandbox.path("again.toml"))
        .expect("a copy");
    sandbox.percuss(&["run", "again.toml", "--history", "csv", "-q"]).ends_with(0);
    let bytes =
        |run: &str| std::fs::read(sandbox.path(run).join("history.csv")).expect("a history");
    assert_eq!(bytes("runs/elastic"), bytes("runs/again"));
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let sandbox = Sandbox::new();
    for file in ["elastic", "rigid"] {
        let name = format!("{file}.toml");
        let mut histories = Vec::new();
        for out in ["first", "second"] {
            sandbox.percuss(&["run", &name, "--out", out, "--no-report", "-q"]).ends_with(0);
            histories
                .push(std::fs::read(sandbox.path(out).join("history.parquet")).expect("a file"));
        }
        assert!(histories[0] == histories[1], "{file}: histories differ");
    }
}

#[test]
fn a_directory_that_is_no_run_is_refused() {
    let sandbox = Sandbox::new();
    std::fs::create_dir(sandbox.path("thesis")).expect("a directory");
    sandbox.put("thesis/chapter.txt", "years of work");
    let run = sandbox.percuss(&["run", "elastic.toml", "--out", "thesis"]);
    run.ends_with(2).tells("thesis").tells("not empty and not the directory of a run");
    assert_eq!(names(&sandbox.path("thesis")), ["chapter.txt"]);
    assert_eq!(sandbox.names(), ["elastic.toml", "rigid.toml", "thesis"]);
    sandbox
        .percuss(&["run", "elastic.toml", "--out", "rigid.toml"])
        .ends_with(2)
        .tells("rigid.toml");
}

#[test]
fn a_run_replaces_the_one_before() {
    let sandbox = Sandbox::new();
    sandbox
        .percuss(&["run", "elastic.toml", "--out", "out", "--history", "csv", "-q"])
        .ends_with(0);
    sandbox.percuss(&["run", "rigid.toml", "--out", "out", "--no-report", "-q"]).ends_with(0);
    assert_eq!(names(&sandbox.path("out")), UNREPORTED);
    assert_eq!(sandbox.names(), ["elastic.toml", "out", "rigid.toml"]);
    // A faulty scenario leaves it alone.
    let faulty = ["run", "elastic.toml", "--out", "out", "--set", "beam.girder.elements=0"];
    sandbox.percuss(&faulty).ends_with(2);
    assert!(sandbox.summary("out")["contact"]["hammer"].is_object());
}

#[test]
fn open_balances_fail_a_strict_run_and_say_which() {
    let sandbox = Sandbox::new();
    let set = "integrator.scheme=\"midpoint\"";
    sandbox.percuss(&["run", "elastic.toml", "--no-report", "--set", set]).ends_with(0);
    sandbox
        .percuss(&["run", "elastic.toml", "--no-report", "--set", set, "--strict"])
        .ends_with(4)
        .tells("energy balance error");
    assert_eq!(sandbox.summary("runs/elastic")["status"], "completed");
}

#[test]
fn a_solver_that_gives_up_leaves_what_it_has() {
    let sandbox = Sandbox::new();
    // A force far beyond anything a beam withstands.
    let text = common::ELASTIC.replace("time]", "load.x]\nkind = \"point\"\nat = \"girder.mid\"\nforce = [-1e300, 1e300]\nfrom = 0.01\n\n[time]");
    sandbox.put("hopeless.toml", text);
    sandbox.percuss(&["run", "hopeless.toml"]).ends_with(3).tells("error: no convergence at t = ");
    let summary = sandbox.summary("runs/hopeless");
    assert_eq!(summary["status"], "failed");
    assert!(summary["error"].is_string());
    let history = read_history(sandbox.path("runs/hopeless")).expect("a history");
    assert!(history.rows() >= 100, "{} rows", history.rows());
    assert!(sandbox.path("runs/hopeless/report.html").is_file());
}

#[test]
fn the_first_thing_reported_is_what_happened() {
    let sandbox = Sandbox::new();
    let said = "'girder.mid' was struck by projectile 'mass' at 20 m/s, t = 10 ms.";
    sandbox.percuss(&["run", "elastic.toml", "--out", "out"]).ends_with(0).tells(said);
    let page = std::fs::read_to_string(sandbox.path("out/report.html")).expect("a page");
    let first = page.find("<canvas").expect("a scene");
    assert!(first < page.find("Key results").expect("results"), "the scene comes first");
    assert!(page.replace('\u{a0}', " ").replace("&#39;", "'").contains(said));
    let fields = percuss_output::fields::read(sandbox.path("out")).expect("whole").expect("fields");
    let (first, last) = (&fields.frames[0], &fields.frames[fields.frames.len() - 1]);
    assert_eq!((first.time, last.time), (0.0, 0.15));
    // The whole contact of some 90 ms is there, step by step or nearly so.
    let touching = fields.frames.iter().filter(|f| !f.contact_forces.is_empty()).count();
    assert!(touching > 300, "{touching} frames");
    sandbox
        .percuss(&["run", "elastic.toml", "--out", "bare", "--set", "record.shapes=0"])
        .ends_with(0);
    assert!(!sandbox.path("bare/fields").exists() && sandbox.path("bare/report.html").is_file());
    sandbox
        .percuss(&["run", "elastic.toml", "--set", "record.shapes=-1"])
        .ends_with(2)
        .tells("record.shapes");
}

#[test]
fn a_report_can_be_rebuilt() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&["run", "rigid.toml", "-q", "--figures"]).ends_with(0);
    let page = sandbox.path("runs/rigid/report.html");
    let before = std::fs::read(&page).expect("a page");
    let pictures = names(&sandbox.path("runs/rigid/figures"));
    std::fs::remove_file(&page).expect("a file");
    std::fs::remove_dir_all(sandbox.path("runs/rigid/figures")).expect("a directory");
    sandbox.percuss(&["report", "runs/rigid", "--figures"]).ends_with(0).tells("report.html");
    assert!(std::fs::read(&page).expect("a page") == before, "another page");
    assert_eq!(names(&sandbox.path("runs/rigid/figures")), pictures);
}

#[test]
fn a_report_needs_a_run() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&["report", "nowhere"]).ends_with(2).tells("nowhere: no such directory");
    sandbox.percuss(&["report", "rigid.toml"]).ends_with(2).tells("not a directory");
    sandbox.percuss(&["report", "."]).ends_with(2).tells("not the directory of a run");
    sandbox.percuss(&["run", "elastic.toml", "--no-report", "-q"]).ends_with(0);
    std::fs::remove_file(sandbox.path("runs/elastic/history.parquet")).expect("a file");
    sandbox.percuss(&["report", "runs/elastic"]).ends_with(2).tells("contains no history");
}

#[test]
fn a_report_made_again_has_the_envelopes() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&["run", "elastic.toml", "--out", "out", "-q"]).ends_with(0);
    let page = || std::fs::read_to_string(sandbox.path("out/report.html")).expect("a page");
    let first = page();
    assert!(first.contains("\"envelope-moment-girder\"") && first.contains("\"reaction-2\""));
    std::fs::remove_file(sandbox.path("out/report.html")).expect("a page");
    sandbox.percuss(&["report", "out"]).ends_with(0);
    assert!(page() == first);
}

#[test]
fn a_scenario_in_the_directory_of_results_is_never_replaced() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&["run", "rigid.toml", "--out", "out", "-q"]).ends_with(0);
    let echo = std::fs::read_to_string(sandbox.path("out/scenario.toml")).expect("a scenario");
    let again = ["run", "out/scenario.toml", "--out", "out"];
    sandbox.percuss(&again).ends_with(2).tells("this directory contains the scenario");
    // A comment of the user's makes it his own, whatever is run.
    sandbox.put("out/scenario.toml", format!("# mine\n{echo}"));
    sandbox
        .percuss(&["run", "rigid.toml", "--out", "out"])
        .ends_with(2)
        .tells("was modified after percuss wrote it");
    let kept = std::fs::read_to_string(sandbox.path("out/scenario.toml")).expect("a scenario");
    assert!(kept.starts_with("# mine"));
}

#[test]
fn a_run_that_gives_up_leaves_the_complete_one_before_it() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&["run", "rigid.toml", "--out", "out", "-q", "--no-report"]).ends_with(0);
    let text = common::ELASTIC.replace("time]", "load.x]\nkind = \"point\"\nat = \"girder.mid\"\nforce = [-1e300, 1e300]\nfrom = 0.01\n\n[time]");
    sandbox.put("hopeless.toml", text);
    let run = sandbox.percuss(&["run", "hopeless.toml", "--out", "out", "--no-report"]);
    run.ends_with(3).tells("out.incomplete").tells("the complete ones in out are unchanged");
    assert_eq!(sandbox.summary("out")["status"], "completed");
    assert_eq!(sandbox.summary("out.incomplete")["status"], "failed");
}

#[test]
fn energy_out_of_nothing_ends_the_run_in_words() {
    let sandbox = Sandbox::empty();
    sandbox.put("beam.toml", include_str!("../../../../scenarios/flying-beam.toml"));
    let run = |scheme: &str, out: &str| {
        let scheme = format!("integrator.scheme={scheme}");
        let step = "time.step=0.4 s";
        sandbox.percuss(&["run", "beam.toml", "--set", &scheme, "--set", step, "--out", out])
    };
    let grown = run("midpoint", "m");
    grown.ends_with(3);
    for words in ["energy growth: ", "does not conserve energy", "energy-momentum"] {
        assert!(grown.stderr.contains(words), "{}", grown.stderr);
    }
    assert!(!grown.stderr.contains("NaN"), "{}", grown.stderr);
    // What conserves energy takes the same step to the end.
    run("energy-momentum", "e").ends_with(0);
    assert!(sandbox.summary("e")["energy"]["residual_max"].as_f64().expect("a number") < 1e-10);
}
