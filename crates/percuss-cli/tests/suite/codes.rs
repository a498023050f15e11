//! Every code can be provoked: by its example in the book, or by a test that knows it.

use std::path::Path;

use percuss_book::Provocations;
use percuss_codes::{Caution, Code, FaultCode, Topic};
use percuss_output::RunDirectory;

use crate::common::Sandbox;

fn repository() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

#[test]
fn a_code_has_an_example_or_a_test_that_names_it() {
    let provocations = Provocations::load(&repository().join("docs/book/codes.toml")).unwrap();
    let mut by_tests = Vec::new();
    for code in Code::all() {
        // Codes without an entry, and examples that do not provoke theirs, are faults of `every_code_is_reported_by_its_example`.
        let Some(test) = provocations.test(code) else { continue };
        let (file, name) = test.split_once("::").expect("FILE::NAME");
        let text = std::fs::read_to_string(repository().join(file)).expect(file);
        let (_, body) = text.split_once(&format!("fn {name}()")).expect(test);
        let body = body.split("#[test]").next().unwrap_or_default();
        assert!(
            body.contains(&format!("\"{code}\"")) || body.contains(&format!("[{code}]")),
            "{test} names no {code}"
        );
        by_tests.push(code.code);
    }
    // What a page could show is to stand there: few are left to tests.
    assert_eq!(by_tests, ["E107", "E114", "E204", "E302", "E303", "W101"]);
}

#[test]
fn results_that_another_process_is_writing() {
    let sandbox = Sandbox::new();
    let held = RunDirectory::create(sandbox.path("out")).unwrap();
    sandbox.percuss(&["run", "elastic.toml", "--out", "out"]).ends_with(2).tells("[E204]");
    drop(held);
    sandbox.percuss(&["run", "elastic.toml", "--out", "out", "--quiet"]).ends_with(0);
}

#[test]
fn codes_are_listed_in_their_groups_and_explained() {
    let sandbox = Sandbox::new();
    let list = sandbox.percuss(&["explain"]).stdout;
    for group in Code::groups() {
        assert!(list.contains(&format!("{}\n  {}", group.name, group.codes[0])), "{list}");
        for one in group.codes {
            assert!(list.contains(&format!("  {one}  {}\n", one.name)), "{list}");
            let reported = sandbox.percuss(&["explain", &one.code.to_lowercase()]);
            reported.ends_with(0);
            assert!(
                reported.stdout.starts_with(&format!("{one}  {}\n\n", one.name)),
                "{}",
                reported.stdout
            );
            assert!(reported.stdout.lines().all(|line| line.len() <= 96), "{}", reported.stdout);
        }
    }
    sandbox.percuss(&["explain", "W099"]).ends_with(2).tells("no such code");
}

#[test]
fn a_run_that_fails_has_its_code_in_the_summary_and_on_the_page() {
    let sandbox = Sandbox::new();
    sandbox.put("beam.toml", include_str!("../../../../scenarios/flying-beam.toml"));
    let set = ["--set", "integrator.scheme=\"midpoint\"", "--set", "time.step=0.4"];
    let run = sandbox.percuss(&[&["run", "beam.toml", "--out", "out"], &set[..]].concat());
    let summary = sandbox.summary("out");
    let code = summary["error_code"].as_str().expect("a code");
    assert_eq!(code, "E108");
    run.ends_with(3).tells(&format!(" [{code}]"));
    let page = std::fs::read_to_string(sandbox.path("out/report.html")).unwrap();
    assert!(page.contains(&format!(" [{code}]</p>")), "{code}");
}

#[test]
fn warnings_of_the_audit_are_denied_and_allowed_like_findings() {
    let sandbox = Sandbox::new();
    let text = std::fs::read_to_string(sandbox.path("elastic.toml")).unwrap();
    let midpoint = "\n[integrator]\nscheme = \"midpoint\"\n";
    sandbox.put("midpoint.toml", format!("{text}{midpoint}"));
    let run = |file: &str, more: &[&str]| {
        sandbox.percuss(&[&["run", file, "--out", "out"], more].concat())
    };
    run("midpoint.toml", &[]).ends_with(0).tells("warning: energy balance error ");
    assert_eq!(sandbox.summary("out")["warnings"][0]["code"], "W105");
    assert_eq!(sandbox.summary("out")["warnings"][0]["verdict"], "warning");
    run("midpoint.toml", &["--deny", "W105", "-q"]).ends_with(4).tells("[W105] is denied [E308]");
    let allow = "\n[allow]\nW105 = \"the midpoint rule is what I look at\"\nW103 = \"none\"\n";
    sandbox.put("allowed.toml", format!("{text}{midpoint}{allow}"));
    let reported = run("allowed.toml", &["--deny", "w105"]);
    reported.ends_with(0).tells("(reason: the midpoint rule is what I look at) [W105]");
    reported.tells("[allow] W103: no such warning (");
    assert!(!reported.stderr.contains("warning: the balance"), "{}", reported.stderr);
    let summary = sandbox.summary("out");
    assert_eq!(summary["warnings"][0]["verdict"], "allowed");
    let found: Vec<_> = summary["allow"].as_array().unwrap().iter().map(|a| &a["found"]).collect();
    assert_eq!(found, [true, false]);
    let page = std::fs::read_to_string(sandbox.path("out/report.html")).unwrap();
    assert!(page.contains("accepted: the midpoint rule is what I look at ("));
    // Before a run nothing is known of its audit.
    let check = sandbox.percuss(&["check", "allowed.toml"]);
    assert!(!check.stderr.contains("W10"), "{}", check.stderr);
}

#[test]
fn codes_of_how_a_command_went_cannot_be_allowed() {
    let sandbox = Sandbox::new();
    let text = std::fs::read_to_string(sandbox.path("elastic.toml")).unwrap();
    for caution in Caution::ALL.into_iter().filter(|one| !one.is_of_the_audit()) {
        sandbox.put("f.toml", format!("{text}\n[allow]\n{} = \"why\"\n", caution.code()));
        let check = sandbox.percuss(&["check", "f.toml"]);
        check.ends_with(2).tells("which reports on a command and cannot be accepted in a scenario");
        check.tells("expected a warning of the model and result checks, W001 to W027, or of the audit of a run, W101 to W105 [E008]");
    }
    sandbox.put("f.toml", format!("{text}\n[allow]\nW15 = \"why\"\n"));
    sandbox.percuss(&["check", "f.toml"]).ends_with(2).tells("[E007]");
}

#[test]
fn only_warnings_are_denied() {
    let sandbox = Sandbox::new();
    for fault in FaultCode::ALL {
        let check = sandbox.percuss(&["check", "elastic.toml", "--deny", fault.code()]);
        check.ends_with(2).tells("is an error");
    }
    for topic in Topic::ALL.into_iter().filter(|topic| *topic != Topic::Span) {
        sandbox.percuss(&["check", "elastic.toml", "--deny", topic.code()]).ends_with(0);
    }
}

#[test]
fn runs_of_a_study_have_the_codes_of_their_reasons() {
    let sandbox = Sandbox::new();
    let study = "base = \"elastic.toml\"\n[parameter.mass]\npath = \"projectile.mass.mass\"\n\
                 values = [500, -500]\n[design]\nkind = \"grid\"\n[results]\npeak = \"contact.mass.peak_force.value\"\n";
    sandbox.put("study.toml", study);
    sandbox
        .percuss(&["check", "study.toml", "--deny", "W115"])
        .ends_with(2)
        .tells("[W115] is denied");
    let sweep = sandbox.percuss(&["sweep", "study.toml", "--out", "out"]);
    sweep.ends_with(0).tells("[E016] [W112]");
}
