//! Values set by their paths are those that the file would have had.

use percuss_scenario::{Scenario, apply_overrides, known_steps, load, read, templates};

/// Paths of all numbers of a scenario that stand behind a key alone.
fn numbers(scenario: &mut Scenario) -> Vec<(String, f64)> {
    let text = scenario.to_toml();
    let mut header = String::new();
    let mut out = Vec::new();
    for line in text.lines() {
        if let Some(table) = line.strip_prefix('[').and_then(|l| l.strip_suffix(']')) {
            header = table.to_string();
        } else if let Some((key, value)) = line.split_once(" = ") {
            if value.starts_with('{') || header == "allow" {
                continue; // a table in one line; reasons are no numbers
            }
            let path = if header.is_empty() { key.to_string() } else { format!("{header}.{key}") };
            let Ok(field) = scenario.field(&path) else { panic!("no field {path}") };
            if let Some((number, _)) = scenario.number(&field) {
                out.push((path, number));
            }
        }
    }
    out
}

#[test]
fn numbers_set_in_place_are_those_read_again() {
    let everything = load(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/everything.toml"));
    let everything = everything.unwrap_or_else(|e| panic!("{e}")).to_toml();
    let mut texts: Vec<String> = templates().iter().map(|t| t.text.to_string()).collect();
    texts.push(everything);
    let mut compared = 0;
    for text in texts {
        let base = read(&text, "base").unwrap_or_else(|e| panic!("{e}"));
        for (path, number) in numbers(&mut base.clone()) {
            let field = base.field(&path).expect("a field");
            let other = if number.fract() == 0.0 { number + 1.0 } else { 0.5 * number };
            let mut set = base.clone();
            set.set_number(&field, other).expect("a number");
            // What no file can have, a second component 3 say, is refused when the model is built.
            let Ok(written) = read(&set.to_toml(), "written") else { continue };
            assert_eq!(set.content(), written.content(), "{path} = {other}");
            // A place along a beam is no bare number in a file; what is left out has no place in it.
            let changed = apply_overrides(&text, "changed", &[format!("{path}={other}")]);
            let Some(changed) = changed.ok().and_then(|text| read(&text, "changed").ok()) else {
                continue;
            };
            assert_eq!(set.content(), changed.content(), "{path} = {other}");
            compared += 1;
        }
    }
    assert!(compared > 200, "{compared} numbers only");
}

#[test]
fn entries_of_lists_and_places_along_beams_have_paths() {
    let mut scenario = read(templates()[0].text, "elastic").expect("valid");
    let field = scenario.field("projectile.mass.velocity[1]").expect("a field");
    assert_eq!(scenario.number(&field).expect("a number").1, "m/s");
    scenario.set_toml(&field, "\"72 km/h\"").expect("a velocity");
    assert!((scenario.number(&field).expect("a number").0 - 20.0).abs() < 1e-12);
    let fault = scenario.set_toml(&field, "\"72 km\"").expect_err("a length");
    assert!(fault.found.contains("a length"), "{}", fault.found);

    let end = scenario.field("beam.girder.points.1.0").expect("a field");
    scenario.set_number(&end, 2.5).expect("set");
    assert_eq!(scenario.content().beam[0].table.points[1][0], 2.5);

    let place = scenario.field("projectile.mass.strikes").expect("a field");
    scenario.set_toml(&place, "\"50 cm\"").expect("a place");
    assert_eq!(scenario.number(&place), Some((0.5, "m")));
    scenario.set_number(&place, 0.75).expect("set");
    assert!(scenario.to_toml().contains("strikes = \"girder@0.75m\""));
    scenario.set_toml(&place, "\"girder.mid\"").expect("a point");
    assert_eq!(scenario.number(&place), Some((0.5, "")));

    let count = scenario.field("beam.girder.elements").expect("a field");
    assert!(scenario.set_number(&count, 2.5).is_err());
    assert!(scenario.field("projectile.mass.kind").expect("a field").needs_reread());
}

#[test]
fn paths_that_lead_nowhere_name_what_is_near() {
    let scenario = read(templates()[0].text, "elastic").expect("valid");
    for (path, wanted) in [
        ("projectle.mass.mass", "did you mean `projectile`?"),
        ("projectile.mas.mass", "`mass`"),
        ("projectile.mass.stifness", "did you mean `stiffness`?"),
        ("projectile.mass.restitution", "one of"),
        ("projectile.mass.velocity[3]", "an entry from 0 to 1"),
        ("projectile.mass.mass.more", "the path `projectile.mass.mass`"),
    ] {
        let fault = scenario.field(path).expect_err(path);
        assert!(fault.expected.contains(wanted), "{path}: {} / {}", fault.found, fault.expected);
    }
    for path in ["", "projectile", "projectile.mass"] {
        assert!(scenario.field(path).is_err(), "{path}");
    }
}

/// The values of studies, changes by `--set` and what Python reads have their paths from one place.
#[test]
fn all_that_takes_a_path_refuses_it_in_the_same_words() {
    let text = templates()[0].text;
    let scenario = read(text, "elastic").expect("valid");
    for path in [
        "",
        "time..end",
        "time.end.more",
        "time.end[0]",
        "projectile.mass.velocity[-1]",
        "projectile.mass.velocity.-1",
        "projectile.mass.velocity[1",
        "projectile.mass.velocity[2]",
        "projectile.mass.velocty[1]",
        "projectile.my mass.mass",
        "projectile.mas.mass",
        "projectle.mass.mass",
    ] {
        let fault = scenario.field(path).expect_err(path);
        let found = fault.found.split(" in the path ").next().unwrap_or_default();
        let set = apply_overrides(text, "f.toml", &[format!("{path}=1")]).expect_err(path);
        let read = known_steps(path, "f.toml", Some(text)).expect_err(path);
        for reported in [set, read] {
            let one = &reported.all()[0];
            assert_eq!((one.message.as_str(), &one.help), (found, &fault.expected), "{path}");
        }
    }
}

#[test]
fn tables_take_the_place_of_whole_tables() {
    let text = "[support.a]\nat = \"b.start\" # left\nkind = \"pin\"\n\n[time]\nend = 1\n";
    let set = |change: &str| apply_overrides(text, "f.toml", &[change.to_owned()]);
    let one = set("support.a={ at = \"b.end\" }").expect("a table");
    assert_eq!(one, text.replace("\"b.start\" # left\nkind = \"pin\"", "\"b.end\""));
    let all = set("support={ c = { at = \"b.end\" } }").expect("tables");
    assert!(all.contains("[support.c]\nat = \"b.end\"\n") && !all.contains("support.a"), "{all}");
    let unknown = set("support.a={ att = 1 }").expect_err("an unknown key");
    assert!(
        unknown.to_string().contains("support.a.att: found the unknown key `att`"),
        "{unknown}"
    );
    assert!(set("support.c={ at = \"b.end\" }").is_err(), "tables with names have to exist");
}

#[test]
fn settings_of_the_computation_are_known_by_their_paths() {
    let scenario = read(templates()[0].text, "elastic").expect("valid");
    let is_setting = |path: &str| scenario.field(path).expect(path).is_setting();
    for path in ["time.step", "time.end", "beam.girder.elements", "record.every"] {
        assert!(is_setting(path), "{path}");
    }
    for path in ["projectile.mass.mass", "material.composite.young", "beam.girder.points[1][0]"] {
        assert!(!is_setting(path), "{path}");
    }
}
