//! Bounds of numbers, found by trying them: what the program refuses is what stands in the reference.

use std::collections::BTreeMap;

use percuss_scenario::{TableReference, apply_overrides, read};

use crate::excerpts::{Sample, table_uses};

/// Bounds of keys: by declaration and key, a few words.
pub type Bounds = BTreeMap<(&'static str, String), &'static str>;

/// Numbers that are tried.
const TRIED: [&str; 5] = ["-1", "0", "0.5", "1", "2"];

/// Which of the numbers tried are accepted, and how that is said.
const SAID: &[([bool; 5], &str)] = &[
    ([true, true, true, true, true], "any"),
    ([false, true, true, true, true], "0 or more"),
    ([false, false, true, true, true], "above 0"),
    ([false, false, false, true, true], "1 or more"),
    ([false, false, false, false, true], "above 1"),
    ([false, true, true, true, false], "0 to 1"),
    ([false, false, true, true, false], "above 0, up to 1"),
    ([false, true, true, false, false], "0 to below 1"),
    ([false, false, true, false, false], "between 0 and 1"),
    ([true, true, true, true, false], "up to 1"),
    ([true, true, true, false, false], "below 1"),
    // Whole numbers.
    ([false, false, false, true, false], "1"),
    ([false, true, false, true, true], "0 or more"),
];

/// Bounds of every number that stands in one of the files, by trying others in its place.
pub fn bounds(samples: &[Sample], format: &[TableReference]) -> Bounds {
    let mut found = Bounds::new();
    for sample in samples {
        for table_use in table_uses(sample, format) {
            for (key, path) in table_use.keys {
                let place = (table_use.table, key);
                if !found.contains_key(&place)
                    && let Some(said) = of_path(sample, &path)
                {
                    found.insert(place, said);
                }
            }
        }
    }
    found
}

/// The bounds of the number at a path; none where no number stands, or where they depend on others.
fn of_path(sample: &Sample, path: &str) -> Option<&'static str> {
    let scenario = read(&sample.text, &sample.name).ok()?;
    scenario.clone().number(&scenario.field(path).ok()?)?;
    let accepted = TRIED.map(|number| accepts(sample, path, number));
    let said = SAID.iter().find(|(pattern, _)| *pattern == accepted)?;
    Some(said.1)
}

/// Whether a number is accepted at a path: nothing is said of the key itself.
fn accepts(sample: &Sample, path: &str, number: &str) -> bool {
    let change = [format!("{path}={number}")];
    let text = match apply_overrides(&sample.text, &sample.name, &change) {
        Ok(text) => text,
        Err(_) => return false,
    };
    let faults = read(&text, &sample.name).and_then(|scenario| scenario.compile().map(drop));
    faults.err().is_none_or(|faults| faults.all().iter().all(|fault| fault.path != path))
}
