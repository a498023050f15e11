//! Blocks of the book that no command runs: what they show is what the program takes.

use std::path::Path;

use percuss::RunSummary;
use percuss_book::{Fence, Part, authored, parts};
use percuss_scenario::{Diagnostics, StudyFile, is_study, read};

use crate::repository;

/// Blocks of a language on the pages written by hand, each with the path of its page.
fn blocks(language: &str) -> Vec<(String, Fence)> {
    let pages = authored(repository()).unwrap();
    let of_page = |(path, text): &(String, String)| -> Vec<(String, Fence)> {
        let fences = parts(text).into_iter().filter_map(|part| match part {
            Part::Fence(fence) if fence.language == language => Some((path.clone(), fence)),
            _ => None,
        });
        fences.collect()
    };
    pages.iter().flat_map(of_page).collect()
}

/// What is wrong with an excerpt of a file, apart from what it leaves out: missing keys and tables, names given elsewhere, files.
fn faults(text: &str) -> Vec<String> {
    let reported =
        |found: Diagnostics| -> Vec<String> { found.coded().lines().map(str::to_string).collect() };
    let found = if is_study(text) || text.contains("[[correlation]]") {
        StudyFile::read(text, "study.toml").err().map(reported)
    } else {
        match read(text, "scenario.toml") {
            Ok(scenario) => scenario.compile().err().map(reported),
            Err(found) => Some(reported(found)),
        }
    };
    let left_out = ["[E001]", "[E004]", "[E007]"];
    let lines = found.unwrap_or_default().into_iter();
    lines.filter(|line| !left_out.iter().any(|code| line.ends_with(code))).collect()
}

#[test]
fn excerpts_of_files_have_keys_and_values_of_the_format() {
    let blocks = blocks("toml");
    assert!(blocks.len() > 10, "{} blocks", blocks.len());
    let wrong: Vec<String> = blocks
        .iter()
        .flat_map(|(path, fence)| {
            faults(&fence.text()).into_iter().map(move |fault| format!("{path}: {fault}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(!faults("[time]\nend = \"0.1 s\"\nstride = 1\n").is_empty());
}

/// The second example of the page on Rust, as it stands there.
fn from_a_file(file: &Path) -> Result<RunSummary, Diagnostics> {
    let scenario = percuss_scenario::load(file)?;
    let compiled = scenario.compile()?;
    let run = percuss::simulate(&compiled.model, &compiled.settings, &mut percuss::NoRecorder);
    let summary = run.expect("settings of a scenario fit its model");
    Ok(summary)
}

#[test]
fn examples_in_rust_are_those_that_are_compiled() {
    let file = repository().join("scenarios/paper/elastic-free.toml");
    assert!(from_a_file(&file).unwrap().energy.residual_max < 1e-10);
    let readme = std::fs::read_to_string(repository().join("README.md")).unwrap();
    let compiled = [readme.as_str(), include_str!("fragments.rs")].concat();
    let lines: Vec<&str> = compiled.lines().map(str::trim).collect();
    let blocks = blocks("rust");
    assert!(!blocks.is_empty());
    for (path, fence) in &blocks {
        let alien = fence.lines.iter().map(|line| line.trim()).find(|line| !lines.contains(line));
        assert_eq!(alien, None, "{path}");
    }
}
