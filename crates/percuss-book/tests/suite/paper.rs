//! The paper about the program: what the Journal of Open Source Software asks of its form.

use std::collections::BTreeSet;
use std::path::Path;

/// Sections that the journal requires, in their order.
const SECTIONS: [&str; 8] = [
    "Summary",
    "Statement of need",
    "State of the field",
    "Software design",
    "Research impact statement",
    "AI usage disclosure",
    "Acknowledgements",
    "References",
];
/// Words that it may have; fewer leave no room for what the sections must say.
const WORDS: std::ops::RangeInclusive<usize> = 250..=1750;

fn read(name: &str) -> String {
    let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../paper")).join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The text behind the metadata.
fn body(paper: &str) -> &str {
    let behind = paper.strip_prefix("---\n").expect("metadata at the beginning");
    behind.split_once("\n---\n").expect("an end of the metadata").1
}

/// Keys of the bibliography: `@article{KEY,`.
fn entries(bibliography: &str) -> Vec<&str> {
    let heads = bibliography.lines().filter(|line| line.starts_with('@'));
    heads.filter_map(|line| Some(line.split_once('{')?.1.trim_end_matches(','))).collect()
}

/// Keys that a text cites: `@KEY`, within brackets or without.
fn cited(text: &str) -> BTreeSet<&str> {
    let begins =
        |before: &str| before.is_empty() || before.ends_with([' ', '\n', '[', '(', '-', ';']);
    let key = |at: usize| {
        let rest = &text[at + 1..];
        let end = rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
        (end > 0 && begins(&text[..at])).then_some(&rest[..end])
    };
    text.match_indices('@').filter_map(|(at, _)| key(at)).collect()
}

#[test]
fn the_paper_has_the_sections_of_the_journal_and_its_length() {
    let paper = read("paper.md");
    let text = body(&paper);
    let sections: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("# ")).collect();
    assert_eq!(sections, SECTIONS);
    let words = text.split_whitespace().count();
    assert!(WORDS.contains(&words), "{words} words");
}

#[test]
fn every_citation_has_an_entry_and_every_entry_is_cited() {
    let (paper, bibliography) = (read("paper.md"), read("paper.bib"));
    let entries = entries(&bibliography);
    let known: BTreeSet<&str> = entries.iter().copied().collect();
    assert_eq!(known.len(), entries.len(), "an entry stands there twice: {entries:?}");
    let cited = cited(body(&paper));
    assert!(cited.len() > 3, "{cited:?}");
    assert_eq!(cited, known);
}

#[test]
fn keys_are_found_in_brackets_and_in_sentences_and_not_in_addresses() {
    let text = "As @first1 says [@second; see @third, p. 3], not me@home or @ alone.";
    assert_eq!(cited(text), BTreeSet::from(["first1", "second", "third"]));
    assert_eq!(entries("@article{a1,\n  x = {@b},\n}\n@book{b,\n"), ["a1", "b"]);
}
