//! No input panics.

use percuss_scenario::{apply_overrides, read, units};
use proptest::prelude::*;

const ELASTIC: &str = include_str!("../files/elastic.toml");
const RIGID: &str = include_str!("../files/rigid.toml");
/// It names files that are not found from here; what is wrong with it besides is all the same.
const EVERYTHING: &str = include_str!("../files/everything.toml");
/// Files, and how many characters are passed over in them.
const FILES: [(usize, &str); 3] = [(1, ELASTIC), (1, RIGID), (29, EVERYTHING)];

/// Reads, compiles, shows; whatever comes of it.
fn exercise(text: &str) {
    match read(text, "f.toml") {
        Ok(scenario) => {
            let again = read(&scenario.to_toml(), "again").expect("a written scenario reads");
            assert_eq!(again.content(), scenario.content());
            // Meshes of millions of elements are valid, but of no interest here.
            if scenario.content().beam.iter().all(|b| b.table.elements.is_some_and(|n| n < 1000)) {
                let _ = scenario.compile().map_err(|e| (e.to_string(), e.fancy(false, 80)));
            }
        }
        Err(faults) => {
            assert!(!faults.all().is_empty());
            let lines = text.matches('\n').count() + 1;
            assert!(faults.all().iter().all(|d| d.line <= lines && d.span.end <= text.len()));
            let _ = (faults.to_string(), faults.fancy(false, 80));
        }
    }
}

#[test]
fn files_cut_off_anywhere_do_not_panic() {
    for (stride, file) in FILES {
        for (end, _) in file.char_indices().step_by(stride) {
            exercise(&file[..end]);
            exercise(&file[end..]);
        }
    }
}

#[test]
fn files_with_a_character_lost_do_not_panic() {
    for (stride, file) in FILES {
        for (at, c) in file.char_indices().step_by(stride) {
            exercise(&format!("{}{}", &file[..at], &file[at + c.len_utf8()..]));
        }
    }
}

#[test]
fn files_with_a_line_lost_or_doubled_do_not_panic() {
    for (_, file) in FILES {
        let lines: Vec<&str> = file.lines().collect();
        for i in 0..lines.len() {
            exercise(&[&lines[..i], &lines[i + 1..]].concat().join("\n"));
            exercise(&[&lines[..=i], &lines[i..]].concat().join("\n"));
        }
    }
}

#[test]
fn every_value_may_be_of_every_type() {
    let values = ["", "0", "-1", "1e308", "nan", "true", "\"\"", "\"@\"", "\".\"", "\"@m\"", "[]"];
    let more = ["[[]]", "[1]", "[\"\", {}]", "{}", "{a=1}", "1979-05-27", "'''x\ny'''", "\"é m\""];
    for (_, file) in FILES {
        let lines: Vec<&str> = file.lines().collect();
        // A sample has one line in four.
        let every = if std::env::var_os("PERCUSS_WHOLE").is_some() { 1 } else { 4 };
        for (i, line) in lines.iter().enumerate().step_by(every) {
            let Some((key, _)) = line.split_once('=') else { continue };
            for value in values.iter().chain(&more) {
                let line = format!("{key}= {value}");
                exercise(&[&lines[..i], &[line.as_str()], &lines[i + 1..]].concat().join("\n"));
            }
        }
    }
}

#[test]
fn deep_and_long_files_end() {
    let deep = 20_000;
    exercise(&format!("a = {}", "[".repeat(deep)));
    exercise(&format!("a = {}", "{a=".repeat(deep)));
    exercise(&format!("{}a = 1", "a.".repeat(deep)));
    exercise(&format!("[{}a]", "a.".repeat(deep)));
    exercise(&format!("title = \"{}\"", "x".repeat(100_000)));
    exercise(&format!("[section.s]\narea = \"1 {}\"", "m ".repeat(deep)));
    exercise(&format!("[section.s]\narea = \"1 {}\"", "(".repeat(deep)));
    exercise(&format!("[section.s]\narea = \"1{}\"", "0".repeat(deep)));
    let wrong = "a b\n".repeat(20_000);
    let faults = read(&wrong, "f.toml").unwrap_err();
    assert!(faults.all().len() >= 20_000);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn changed_bytes_do_not_panic(
        rigid in any::<bool>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut bytes = if rigid { RIGID } else { ELASTIC }.as_bytes().to_vec();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        exercise(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn any_text_does_not_panic(text in "\\PC*") {
        exercise(&text);
        let _ = units::parse(&text);
        let _ = apply_overrides(ELASTIC, "f.toml", std::slice::from_ref(&text));
        let _ = apply_overrides(ELASTIC, "f.toml", &[format!("time.step={text}")]);
        let _ = apply_overrides(&text, "f.toml", &["time.step=1".into()]);
    }

    #[test]
    fn any_quantity_like_text_does_not_panic(text in "[-+0-9.e_]{0,8} ?[a-zA-Zµ°²⁻*/().^ 0-9-]{0,12}") {
        if let Ok(quantity) = units::parse(&text) {
            prop_assert!(quantity.value.is_finite());
        }
    }
}
