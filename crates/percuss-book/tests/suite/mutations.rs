//! Mistakes that scripts/sensitivity makes: each still has its place in the sources, and its row on the page.

use std::collections::BTreeSet;

use toml_edit::{DocumentMut, Item};

use crate::repository;

struct Mutation {
    id: String,
    what: String,
    /// File below the sources of the mechanics, what stands there, what takes its place.
    edits: Vec<[String; 3]>,
}

fn read(name: &str) -> String {
    let path = repository().join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn mutations() -> Vec<Mutation> {
    let file: DocumentMut = read("docs/book/mutations.toml").parse().unwrap();
    let text = |item: &Item| item.as_str().expect("a text").to_string();
    let tables = file["mutation"].as_array_of_tables().unwrap();
    let mutation = |table: &toml_edit::Table| Mutation {
        id: text(&table["id"]),
        what: text(&table["what"]),
        edits: table["edits"].as_array().unwrap().iter().map(edit).collect(),
    };
    tables.iter().map(mutation).collect()
}

fn edit(value: &toml_edit::Value) -> [String; 3] {
    let parts = value.as_array().expect("a file and two texts");
    let texts: Vec<String> = parts.iter().map(|p| p.as_str().unwrap().to_string()).collect();
    texts.try_into().expect("a file and two texts")
}

#[test]
fn each_mistake_has_exactly_one_place_in_the_sources() {
    let mutations = mutations();
    let ids: BTreeSet<&str> = mutations.iter().map(|mutation| mutation.id.as_str()).collect();
    assert!(mutations.len() == ids.len() && ids.len() >= 8);
    for Mutation { id, edits, .. } in &mutations {
        for [file, search, replace] in edits {
            let source = read(&format!("crates/percuss/src/{file}"));
            assert_eq!(source.matches(search.as_str()).count(), 1, "{id}: {search}");
            assert_ne!(search, replace, "{id}");
        }
    }
}

#[test]
fn the_page_has_a_row_for_each_mistake_and_says_which_none_notices() {
    let page = read("docs/book/src/verification/sensitivity.md");
    let rows: Vec<Vec<&str>> = page
        .lines()
        .filter(|line| line.starts_with("| ") && !line.starts_with("| Mistake"))
        .map(|line| line.trim_matches('|').split(" | ").map(str::trim).collect())
        .collect();
    let later = page.lines().find_map(|line| line.strip_prefix("Not measured yet: "));
    let later = later.map(|line| line.trim_end_matches('.').split("; ").collect::<Vec<_>>());
    let mut reported: Vec<&str> =
        rows.iter().map(|row| row[0]).chain(later.unwrap_or_default()).collect();
    let mutations = mutations();
    let mut known: Vec<&str> = mutations.iter().map(|mutation| mutation.what.as_str()).collect();
    reported.sort_unstable();
    known.sort_unstable();
    assert_eq!(reported, known);
    assert!(rows.len() >= 8, "{} rows", rows.len());
    for row in &rows {
        let names = row[2].matches('`').count() / 2;
        assert_eq!(row[1], names.to_string(), "{}", row[0]);
        let blind = page.lines().any(|l| l.starts_with("Noticed by none: ") && l.contains(row[0]));
        assert_eq!(names == 0, blind, "{}", row[0]);
    }
}

/// Names in backticks of the line of the page that begins so.
fn named(page: &str, begin: &str) -> BTreeSet<String> {
    let line = page.lines().find(|line| line.starts_with(begin)).unwrap_or_default();
    line.split('`').skip(1).step_by(2).map(str::to_string).collect()
}

#[test]
fn every_case_was_run_with_the_mistakes_or_is_named_as_added_since() {
    let sources = repository().join("crates/percuss-verification/src");
    let lists = std::fs::read_dir(sources.join("catalogue")).unwrap();
    let lists = lists.map(|entry| entry.unwrap().path()).chain([sources.join("catalogue.rs")]);
    let lists = lists.map(|path| std::fs::read_to_string(path).unwrap()).collect::<String>();
    let names = lists.lines().filter_map(|line| line.trim().strip_prefix("id: \""));
    let cases: BTreeSet<String> =
        names.filter_map(|rest| rest.strip_suffix("\",")).map(str::to_string).collect();
    let kept: serde_json::Value = serde_json::from_str(&read("docs/book/noticed.json")).unwrap();
    let run = kept["sound"].as_array().unwrap().iter().map(|case| case.as_str().unwrap());
    let run: BTreeSet<String> = run.map(str::to_string).collect();
    assert!(run.is_subset(&cases), "cases that no longer exist: run scripts/sensitivity");
    let page = read("docs/book/src/verification/sensitivity.md");
    let newer: BTreeSet<String> = cases.difference(&run).cloned().collect();
    let on_page = named(&page, "Cases added since (");
    assert_eq!(on_page, newer, "run scripts/sensitivity --page");
    assert!(page.contains(&format!(" {} cases; ", run.len())), "{} cases were run", run.len());
}
