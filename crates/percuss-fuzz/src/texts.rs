//! Texts written by people: scenarios, studies, fits, units, changes by `--set`.

use percuss_scenario::{FileAccess, FitFile, StudyFile, apply_overrides, read, templates, units};

use super::input::text;

/// A scenario: a readable one is written and read again, with the same content; one that can be built is checked by the advisor.
pub fn scenario(data: &[u8]) {
    let Some(text) = text(data) else { return };
    match read(text, "fuzz.toml") {
        Err(faults) => assert!(!faults.to_string().is_empty(), "a fault without words"),
        Ok(scenario) => {
            let again = read(&scenario.to_toml(), "again.toml").expect("what was written is read");
            assert_eq!(again.content(), scenario.content(), "written out and read again");
            if super::runs::is_small(&scenario)
                && let Ok(compiled) = scenario.compile()
            {
                let _ = percuss_advice::advise(&compiled.model, &compiled.settings);
            }
        }
    }
}

/// A study.
pub fn study(data: &[u8]) {
    let Some(text) = text(data) else { return };
    match StudyFile::read(text, "fuzz.toml") {
        Err(faults) => assert!(!faults.to_string().is_empty(), "a fault without words"),
        Ok(study) => {
            let _ = study.content.to_toml();
        }
    }
}

/// A fit: one without faults is written and read again, with the same content.
pub fn fit(data: &[u8]) {
    let Some(text) = text(data) else { return };
    let read = |text: &str| FitFile::read_with(text, "fuzz.toml", FileAccess::OwnFolder);
    let whole = read(text).and_then(|file| file.settle(Vec::new()).map(|()| file.content));
    match whole {
        Err(faults) => assert!(!faults.to_string().is_empty(), "a fault without words"),
        Ok(content) => {
            let again = read(&content.to_toml()).expect("what was written is read");
            assert_eq!(again.content, content, "written out and read again");
        }
    }
}

/// A quantity with its unit: finite if it is accepted.
pub fn unit(data: &[u8]) {
    let Some(text) = text(data) else { return };
    if let Ok(quantity) = units::parse(text) {
        assert!(!quantity.value.is_nan(), "{text:?} is no number");
    }
}

/// A change by `--set` in the first line, and the changed file in the others, or a template.
pub fn overrides(data: &[u8]) {
    let Some(text) = text(data) else { return };
    let (change, file) = text.split_once('\n').unwrap_or((text, ""));
    let file = if file.trim().is_empty() { templates()[0].text } else { file };
    if let Ok(changed) = apply_overrides(file, "fuzz.toml", &[change.to_owned()]) {
        let _ = read(&changed, "fuzz.toml");
    }
}
