//! The version and its date, wherever they are reported.

use crate::repository;

fn read(name: &str) -> String {
    let path = repository().join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// What stands behind a beginning of a line, of the first such line.
fn behind<'a>(text: &'a str, begin: &str) -> &'a str {
    let line = text.lines().find_map(|line| line.strip_prefix(begin));
    line.unwrap_or_else(|| panic!("no line begins with {begin:?}")).trim_end_matches('"')
}

/// Whether it is a day as in 2026-11-26.
fn is_day(text: &str) -> bool {
    let parts: Vec<&str> = text.split('-').collect();
    let digits = |part: &&str| part.bytes().all(|byte| byte.is_ascii_digit());
    parts.iter().map(|part| part.len()).eq([4, 2, 2]) && parts.iter().all(digits)
}

#[test]
fn every_file_tells_the_version_of_the_workspace() {
    let cargo = read("Cargo.toml");
    let version = behind(&cargo, "version = \"");
    assert_eq!(behind(&read("CITATION.cff"), "version: "), version);
    assert!(read("docs/book/src/cite.md").contains(&format!("version = {{{version}}}")));
    assert!(read("README.md").contains(&format!("pip install percuss-{version}-*.whl")));
    assert!(read("pyproject.toml").contains("dynamic = [\"version\"]"), "the wheel asks Cargo");
}

#[test]
fn the_changelog_begins_with_what_is_unreleased_and_then_has_this_version_with_its_day() {
    let (changelog, cargo) = (read("CHANGELOG.md"), read("Cargo.toml"));
    let heads: Vec<&str> = changelog.lines().filter_map(|line| line.strip_prefix("## ")).collect();
    assert_eq!(heads[0], "Unreleased");
    let (version, day) = heads[1].split_once(" - ").expect("a version and its day");
    assert_eq!(version, behind(&cargo, "version = \""));
    assert!(is_day(day), "{day}");
    assert_eq!(behind(&read("CITATION.cff"), "date-released: "), day);
    assert!(read("docs/book/src/cite.md").contains(&format!("year    = {{{}}}", &day[..4])));
}
