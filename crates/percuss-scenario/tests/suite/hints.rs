//! What is said of a value that means something else than its writer thought.

use percuss_scenario::{StudyFile, read};

const ELASTIC: &str = include_str!("../files/elastic.toml");

/// The one fault of a file with more tables.
fn one(more: &str) -> String {
    let text = format!("{ELASTIC}\n{more}");
    let faults = read(&text, "f.toml").expect_err("a fault");
    assert_eq!(faults.all().len(), 1, "{faults}");
    faults.to_string()
}

#[test]
fn a_missing_design_is_named_with_its_kinds() {
    let study = StudyFile::read("base = \"f.toml\"\n", "s.toml").expect("a study");
    let reported = study.settle(Vec::new()).expect_err("no design").to_string();
    let expected = "found no [design], expected a table with `kind` = \"grid\", \"latin-hypercube\", \"sobol\", \
                    \"monte-carlo\"";
    assert!(reported.contains(expected), "{reported}");
}

/// In every file `g` is the gram.
#[test]
fn an_acceleration_in_g_is_reported_in_its_unit() {
    let base = "[load.quake]\nkind = \"base\"\nacceleration = [\"0.2 g\", 0]\n";
    let reported = one(base);
    let expected = "found \"0.2 g\", which is a mass (kg), expected an acceleration (m/s^2), such as \"-9.81 m/s^2\"; \
                    0.2 times standard gravity is \"1.96133 m/s^2\"";
    assert!(reported.contains(expected), "{reported}");
    let reported = one(&base.replace("0.2 g", "2 kg"));
    assert!(!reported.contains("standard gravity"), "{reported}");
}

/// A projectile has no places but its centre.
#[test]
fn a_place_on_a_projectile_is_its_name() {
    let ends = "between = [\"mass.centre\", [0, 9]]";
    let reported = one(&format!("[spring.rope]\n{ends}\nlaw = \"tension\"\nstiffness = 1\n"));
    let expected = "found \"mass.centre\", a place on the projectile \"mass\", expected its name alone, \"mass\", for its \
                    centre";
    assert!(reported.contains(expected), "{reported}");
}
