//! `--set path=value`.

use percuss_scenario::{apply_overrides, read};

const ELASTIC: &str = include_str!("../files/elastic.toml");

fn set(overrides: &[&str]) -> Result<String, String> {
    let all: Vec<String> = overrides.iter().map(|o| o.to_string()).collect();
    apply_overrides(ELASTIC, "f.toml", &all).map_err(|e| e.to_string())
}

#[test]
fn values_are_toml_or_else_texts() {
    let text = set(&[
        "projectile.mass.velocity=[0,30]",
        "time.step=\"1e-5 s\"",
        "time.end = 30 ms",
        "projectile.mass.force=midpoint",
        "beam.girder.elements=12",
    ])
    .unwrap();
    let scenario = read(&text, "f.toml").unwrap();
    let content = scenario.content();
    assert_eq!(content.projectile[0].table.velocity, [0.0, 30.0]);
    assert_eq!((content.time.end, content.time.step), (0.03, Some(1e-5)));
    assert_eq!(content.beam[0].table.elements, Some(12));
    assert!(text.contains("force = \"midpoint\""));
}

#[test]
fn comments_and_everything_else_stay() {
    let text = set(&["support.left.kind=pin"]).unwrap();
    let expected = ELASTIC.replacen("kind = \"clamp\" ", "kind = \"pin\" ", 1);
    assert_eq!(text, expected);
    assert_eq!(set(&[]).unwrap(), ELASTIC);
}

#[test]
fn tables_that_stand_once_are_added() {
    let text = set(&["integrator.scheme=midpoint", "record.every=10", "title=Other"]).unwrap();
    let scenario = read(&text, "f.toml").unwrap();
    assert_eq!(scenario.content().record.every, 10);
    assert_eq!(scenario.content().title, "Other");
    assert!(text.contains("[integrator]\nscheme = \"midpoint\""));
}

#[test]
fn paths_that_do_not_exist_come_with_the_nearest_names() {
    for (path, expected) in [
        ("projectile.mas.velocity=1", "found the unknown name `mas`, expected `mass`"),
        ("projectle.mass.velocity=1", "(did you mean `projectile`?)"),
        ("projectile.mass.velocty=1", "(did you mean `velocity`?)"),
        ("load.weight.at=1", "found the unknown name `weight`, expected none at all"),
        ("time=1", "found 1 instead of a table, expected the path of a value in it"),
        ("projectile.mass=1", "found 1 instead of a table"),
        ("title.x=1", "found `x` behind `title`, expected the path `title`"),
        ("time.step", "found `time.step`, expected path=value"),
        ("", "found ``, expected path=value"),
        ("=", "found an empty name, expected a path of names and indices"),
        ("..=..", "found an empty name"),
    ] {
        let fault = set(&[path]).expect_err(path);
        assert!(fault.starts_with("--set: ") && fault.contains(expected), "{path}: {fault}");
    }
    assert_eq!(set(&["a=1", "b=2"]).unwrap_err().lines().count(), 2);
}

#[test]
fn a_file_with_syntax_errors_reports_them() {
    let fault = apply_overrides("x = \n", "f.toml", &["time.step=1".into()]).unwrap_err();
    assert!(fault.to_string().starts_with("f.toml:1:"), "{fault}");
}

#[test]
fn tables_in_braces_and_dotted_keys_can_be_set() {
    let text = "time = { end = 1, step = 0.1 }\nprojectile.p.mass = 1 # heavy\n";
    let all = ["time.step=0.2".to_string(), "projectile.p.mass=2".to_string()];
    let text = apply_overrides(text, "f.toml", &all).unwrap();
    assert_eq!(text, "time = { end = 1, step = 0.2 }\nprojectile.p.mass = 2 # heavy\n");
}

#[test]
fn tables_in_braces_are_reached_through_the_keys_they_stand_behind() {
    let load = "[load.l]\nkind = \"point\"\nfunction = { kind = \"ramp\", duration = 1 } # slow\n";
    let set = |path: &str| {
        apply_overrides(load, "f.toml", &[path.to_string()]).map_err(|e| e.to_string())
    };
    assert_eq!(set("load.l.function.duration=2 ms"), Ok(load.replace("= 1 }", "= \"2 ms\" }")));
    let text = set("path.until.value=-0.1").unwrap();
    assert!(text.contains("[path]\nuntil = { value = -0.1 }"), "{text}");
    for (path, part) in [
        ("load.l.function.durtion=1", "(did you mean `duration`?)"),
        (
            "load.l.from.duration=1",
            "found `duration` behind `from`, expected the path `load.l.from`",
        ),
        ("path.until.value.x=1", "found `x` behind `value`"),
    ] {
        let fault = set(path).unwrap_err();
        assert!(fault.contains(part), "{fault}");
    }
    let fault = apply_overrides(
        "[load.l]\nfunction = \"constant\"\n",
        "f.toml",
        &["load.l.function.duration=1".into()],
    );
    let fault = fault.unwrap_err().to_string();
    assert!(fault.contains("found a string in the file, expected a table"), "{fault}");
}
