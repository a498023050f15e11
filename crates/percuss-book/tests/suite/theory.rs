//! What the theory refers to, and what refers to it, exists: source files, equations by number, pages.

use std::fs;
use std::path::{Path, PathBuf};

use super::repository;

/// Pages of the theory with their numbers: `3-contact.md` is page 3, and its equations are (3.1), (3.2) and so on.
fn pages() -> Vec<(usize, String)> {
    let folder = repository().join("docs/book/src/theory");
    let files = fs::read_dir(&folder).expect("the theory").map(|file| file.expect("a file").path());
    let page = |path: PathBuf| {
        let (number, _) = path.file_name()?.to_str()?.split_once('-')?;
        Some((number.parse().ok()?, fs::read_to_string(&path).expect("a page")))
    };
    files.filter_map(page).collect()
}

/// Sources in Rust below a folder.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for file in fs::read_dir(folder).expect("a folder") {
        let path = file.expect("a file").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|kind| kind == "rs") {
            found.push(path);
        }
    }
}

/// Sources of all crates.
fn all_sources() -> Vec<PathBuf> {
    let mut found = Vec::new();
    for one in fs::read_dir(repository().join("crates")).expect("crates") {
        sources(&one.expect("a crate").path().join("src"), &mut found);
    }
    found
}

/// Texts between parentheses of the form (2.13): page and equation.
fn equations_named(text: &str) -> Vec<(usize, usize)> {
    let number = |part: &str| part.parse().ok().filter(|n| *n > 0 && part.len() < 3);
    let inside = |rest: &str| {
        let (page, equation) = rest.split_once(')')?.0.split_once('.')?;
        Some((number(page)?, number(equation)?))
    };
    text.split('(').skip(1).filter_map(inside).collect()
}

#[test]
fn sources_named_by_the_theory_exist() {
    let known = all_sources();
    let mut missing = Vec::new();
    let mut count = 0;
    for (number, page) in pages() {
        // Every second part is between backticks.
        let named = page.lines().flat_map(|line| line.split('`').skip(1).step_by(2));
        for name in named.filter(|name| name.ends_with(".rs") && !name.contains(' ')) {
            count += 1;
            if !known.iter().any(|path| path.ends_with(name)) {
                missing.push(format!("page {number}: {name}"));
            }
        }
    }
    assert!(count > 30, "{count} sources named");
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn equations_named_by_number_exist() {
    let pages = pages();
    let equations = |number: usize| {
        let page = pages.iter().find(|page| page.0 == number);
        page.map_or(0, |page| page.1.matches("```math,eq=").count())
    };
    let mut count = 0;
    for (number, text) in &pages {
        for (page, equation) in equations_named(text) {
            count += 1;
            let known = (1..=equations(page)).contains(&equation);
            assert!(known, "page {number} refers to ({page}.{equation})");
        }
    }
    assert!(count > 3, "{count} references");
    assert_eq!(equations_named("as in (2.2), (a.b), f(0.5) and (3)."), [(2, 2)]);
}

#[test]
fn sources_refer_to_pages_of_the_theory() {
    let pages = pages();
    let mut count = 0;
    for path in all_sources() {
        let text = fs::read_to_string(&path).expect("a source");
        for rest in text.split("(theory, ").skip(1) {
            let digits =
                rest.strip_prefix("page ").and_then(|rest| rest.split([')', ',', ' ']).next());
            let page = digits.and_then(|digits| digits.parse::<usize>().ok());
            let known = page.is_some_and(|page| pages.iter().any(|one| one.0 == page));
            let line = rest.lines().next().unwrap_or_default();
            assert!(known, "{}: (theory, {line}", path.display());
            count += 1;
        }
    }
    assert!(count > 5, "{count} references");
}
