//! `[allow]`: codes of findings and warnings, each with a reason.

use percuss_codes::{Caution, Topic};
use percuss_scenario::read;

const ELASTIC: &str = include_str!("../files/elastic.toml");

fn with(line: &str) -> Result<percuss_scenario::Scenario, String> {
    let text = format!("{ELASTIC}\n[allow]\n{line}\n");
    read(&text, "f.toml").map_err(|faults| faults.coded())
}

#[track_caller]
fn refused(line: &str, parts: &[&str]) {
    let reported = with(line).expect_err(line);
    assert_eq!(reported.lines().count(), 1, "{reported}");
    for part in parts {
        assert!(reported.contains(part), "{reported}\nlacks {part}");
    }
}

#[test]
fn a_reason_is_kept_and_written_back() {
    let scenario = with("W007 = \"a short beam is \\\"meant\\\"\"\nW012 = \" seen \"").unwrap();
    let content = scenario.content();
    assert_eq!(content.reason_to_allow(Topic::Span.into()), Some("a short beam is \"meant\""));
    assert_eq!(content.reason_to_allow(Topic::Recording.into()), Some("seen"));
    assert_eq!(content.reason_to_allow(Topic::FirstContact.into()), None);
    let again = read(&scenario.to_toml(), "again.toml").unwrap();
    assert_eq!(again.content(), content);
}

#[test]
fn warnings_of_the_audit_can_be_allowed() {
    let scenario = with("W105 = \"the scheme is meant\"").unwrap();
    let content = scenario.content();
    assert_eq!(content.reason_to_allow(Caution::Balance.into()), Some("the scheme is meant"));
    assert!(scenario.to_toml().contains("W105 = \"the scheme is meant\""));
}

#[test]
fn codes_that_cannot_be_allowed_are_refused() {
    let whole = ["W107\" (interrupted), which reports on a command", "W101 to W105", "[E008]"];
    refused("W107 = \"x\"", &whole);
    refused("W099 = \"x\"", &["allow.W099", "found the code \"W099\"", "[E007]"]);
    refused("w007 = \"x\"", &["found the code \"w007\"", "(did you mean `W007`?)", "[E007]"]);
    let whole = ["an error, which cannot be accepted", "W001 to W027", "[E008]"];
    refused("E006 = \"x\"", &whole);
    refused("W007 = \"\"", &["found an empty reason, expected the reason", "[E005]"]);
    refused("W007 = \"  \"", &["found an empty reason"]);
    refused("W007 = true", &["found `true`", "[E005]"]);
}
