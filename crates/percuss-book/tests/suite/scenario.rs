//! The scenario reference: complete, with examples that the program reads.

use percuss_book::{missing_examples, reference_pages, samples};
use percuss_scenario::{
    BodyReference, FileAccess, FitFile, StudyFile, TableReference, fit_reference, is_fit, is_study,
    read, reference, study_reference,
};

use crate::repository;

/// Names what has no text in a body, below `at`.
fn silent(body: &BodyReference, at: &str, found: &mut Vec<String>) {
    let keys = body.keys.iter().filter(|key| key.about.trim().is_empty());
    found.extend(keys.map(|key| format!("{at}.{}", key.name)));
    for kinds in &body.kinds {
        if kinds.about.trim().is_empty() {
            found.push(format!("{at}.{}", kinds.tag));
        }
        for (word, variant) in &kinds.variants {
            let at = format!("{at}.{}={word}", kinds.tag);
            if variant.about.trim().is_empty() {
                found.push(at.clone());
            }
            silent(variant, &at, found);
        }
    }
}

#[test]
fn every_table_kind_and_key_says_what_it_means() {
    let mut found = Vec::new();
    let others = [study_reference(), fit_reference()].concat();
    for TableReference { name, body, .. } in reference().iter().chain(&others) {
        if body.about.trim().is_empty() {
            found.push((*name).to_string());
        }
        silent(body, name, &mut found);
    }
    assert!(found.is_empty(), "without a doc comment: {}", found.join(", "));
}

#[test]
fn every_key_stands_in_an_example() {
    let samples = samples(repository()).unwrap();
    let mut missing = missing_examples(&reference(), &samples);
    missing.extend(missing_examples(&study_reference(), &samples));
    missing.extend(missing_examples(&fit_reference(), &samples));
    let wanted = "keys without an example; add them to a file in docs/book/examples";
    assert!(missing.is_empty(), "{wanted}:\n{}", missing.join("\n"));
}

#[test]
fn every_example_is_read_without_a_fault() {
    for sample in samples(repository()).unwrap() {
        let path = repository().join(&sample.name);
        if is_fit(&sample.text) {
            let name = path.display().to_string();
            let fit = FitFile::read_with(&sample.text, &name, FileAccess::OwnFolder);
            fit.and_then(|fit| fit.settle(Vec::new())).unwrap_or_else(|e| panic!("{e}"));
            continue;
        }
        if is_study(&sample.text) {
            let study = StudyFile::read(&sample.text, &path.display().to_string());
            study.and_then(|s| s.settle(Vec::new())).unwrap_or_else(|e| panic!("{e}"));
            continue;
        }
        let scenario = read(&sample.text, &path.display().to_string());
        // A law that a program gives is in no file.
        let given = sample.text.contains("\"given\"");
        let compiled = scenario.and_then(|s| if given { Ok(()) } else { s.compile().map(drop) });
        compiled.unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn pages_are_the_same_whenever_they_are_written() {
    let samples = samples(repository()).unwrap();
    let texts = || -> Vec<String> {
        reference_pages("scenario", &reference(), &samples).into_iter().map(|p| p.text).collect()
    };
    assert_eq!(texts(), texts());
}
