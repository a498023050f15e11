//! The templates and the two files of the paper.

use percuss_scenario::{
    Compiled, FileAccess, FitFile, Scenario, StudyFile, fit_templates, is_fit, load, read,
    study_templates, templates,
};

const ELASTIC: &str = include_str!("../files/elastic.toml");
const RIGID: &str = include_str!("../files/rigid.toml");

#[test]
fn every_template_reads_and_compiles_without_faults() {
    for template in templates() {
        let name = format!("{}.toml", template.name);
        let scenario = read(template.text, &name).unwrap_or_else(|e| panic!("{e}"));
        assert!(!scenario.content().title.is_empty() && !template.summary.is_empty());
        compile(&scenario);
    }
}

#[test]
fn studies_and_fits_to_start_from_are_read_without_faults() {
    for template in study_templates() {
        let file = StudyFile::read(template.text, "study.toml").unwrap_or_else(|e| panic!("{e}"));
        file.settle(Vec::new()).unwrap_or_else(|e| panic!("{e}"));
        let base = file.content.base.expect("a base");
        assert!(template.files.iter().any(|(name, _)| *name == base));
    }
    for template in fit_templates() {
        let file = FitFile::read_with(template.text, "fit.toml", FileAccess::OwnFolder);
        let file = file.unwrap_or_else(|e| panic!("{e}"));
        file.settle(Vec::new()).unwrap_or_else(|e| panic!("{e}"));
        let base = file.content.base.expect("a base");
        let data = file.content.test.iter().map(|test| &test.table.data);
        for named in data.chain([&base]) {
            assert!(template.files.iter().any(|(name, _)| name == named), "{named}");
        }
    }
}

/// Compiles; `None` for a curved beam as long as the core builds none.
fn compile(scenario: &Scenario) -> Option<Compiled> {
    match scenario.compile() {
        Err(e) if e.to_string().contains("beams are straight in this version") => None,
        compiled => Some(compiled.unwrap_or_else(|e| panic!("{e}"))),
    }
}

#[test]
fn scenarios_of_structures_say_the_same_as_their_templates() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios");
    for (file, name) in [
        ("portal-frame", "portal"),
        ("shallow-arch", "arch"),
        ("gapped-pipe", "gapped-pipe"),
        ("flying-beam", "flying-beam"),
        ("oblique-throw", "surface"),
    ] {
        let scenario = load(format!("{folder}/{file}.toml")).unwrap_or_else(|e| panic!("{e}"));
        let template = templates().iter().find(|t| t.name == name).unwrap();
        assert_eq!(scenario.content(), read(template.text, name).unwrap().content());
        compile(&scenario);
    }
}

#[test]
fn every_scenario_at_hand_compiles() {
    let mut folders = vec![concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios").into()];
    let mut count = 0;
    while let Some(folder) = folders.pop() {
        let folder: std::path::PathBuf = folder;
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                if !path.ends_with("studies") {
                    folders.push(path);
                }
            } else if path.extension().is_some_and(|e| e == "toml")
                && !is_fit(&std::fs::read_to_string(&path).unwrap())
            {
                compile(&load(&path).unwrap_or_else(|e| panic!("{e}")));
                count += 1;
            }
        }
    }
    assert!(count >= 29, "{count}");
}

#[test]
fn templates_of_the_paper_say_the_same_as_its_files() {
    for (file, name) in [(ELASTIC, "elastic"), (RIGID, "rigid")] {
        let template = templates().iter().find(|t| t.name == name).unwrap();
        let (a, b) = (read(file, "a").unwrap(), read(template.text, "b").unwrap());
        assert_eq!(a.content(), b.content());
    }
}

#[test]
fn written_out_scenarios_read_back_the_same_model() {
    for text in templates().iter().map(|t| t.text).chain([ELASTIC, RIGID]) {
        let scenario = read(text, "a").unwrap();
        let written = scenario.to_toml();
        let again = read(&written, "b").unwrap_or_else(|e| panic!("{written}\n{e}"));
        assert_eq!(again.content(), scenario.content());
        assert_eq!(again.to_toml(), written);
        let Some(one) = compile(&scenario) else { continue };
        let two = again.compile().unwrap();
        assert_eq!(one.settings, two.settings);
        assert_eq!(format!("{:?}", one.model), format!("{:?}", two.model));
    }
}

#[test]
fn written_out_scenarios_name_every_default() {
    let text = read(RIGID, "rigid.toml").unwrap().to_toml();
    for line in [
        "strain = \"green\"",
        "rotary_inertia = true",
        "area = 0.1  # m^2",
        "inertia = 8.33e-5  # m^4",
        "contact = \"point\"",
        "impacts = \"event\"",
        "scheme = \"energy-momentum\"",
        "every = 1",
        "points = []",
    ] {
        assert!(text.lines().any(|l| l == line), "`{line}` is not in\n{text}");
    }
}

#[test]
fn another_restitution_reaches_every_rigid_projectile() {
    let scenario = read(RIGID, "rigid.toml").unwrap().with_restitution(0.25);
    assert!(scenario.to_toml().contains("restitution = 0.25"));
    let elastic = read(ELASTIC, "elastic.toml").unwrap();
    assert_eq!(elastic.with_restitution(0.25).content(), elastic.content());
}

#[test]
fn files_load_and_missing_ones_say_so() {
    let files = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files");
    assert!(load(format!("{files}/elastic.toml")).is_ok());
    let missing = load(format!("{files}/none.toml")).unwrap_err().to_string();
    assert!(missing.ends_with("none.toml: found no such file, expected a scenario file"));
    assert!(load(files).unwrap_err().to_string().contains("found a directory"));
}
