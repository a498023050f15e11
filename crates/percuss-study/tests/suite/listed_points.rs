//! Points chosen elsewhere: listed in the study or in a file.

use percuss_scenario::FileAccess;
use percuss_study::{Input, Study};

use crate::common::CANTILEVER;

const RESULTS: &str = "[results]\nforce = \"contact.p.peak_force.value\"\n";

const LISTED: &str = r#"
[parameter.speed]
path = "projectile.p.velocity[1]"
values = [1.0, "2 m/s", 3.0, nan]
[parameter.mass]
path = "projectile.p.mass"
values = [10.0, 12.5, -1.0, 10.0]
[parameter.support]
path = "support.left.kind"
values = ["clamp", "pin", "clamp", "clamp"]
[design]
kind = "points"
"#;

fn read(rest: &str) -> Result<Study, percuss_scenario::Diagnostics> {
    Study::from_toml(&format!("scenario = '''{CANTILEVER}'''\n{rest}{RESULTS}"), "study.toml")
}

fn study(rest: &str) -> Study {
    read(rest).unwrap_or_else(|faults| panic!("{faults}"))
}

/// A study whose points are in a file of its folder.
fn from_file(folder: &std::path::Path, rest: &str, csv: &str) -> Result<Study, String> {
    std::fs::write(folder.join("points.csv"), csv).expect("written");
    let design = "[design]\nkind = \"points\"\nfile = \"points.csv\"\n";
    let text = format!("scenario = '''{CANTILEVER}'''\n{rest}{design}{RESULTS}");
    let name = folder.join("study.toml");
    let name = name.to_str().expect("a name");
    Study::from_toml_with(&text, name, FileAccess::OwnFolder).map_err(|faults| faults.to_string())
}

#[test]
fn a_run_takes_its_entry_of_each_parameter() {
    let study = study(LISTED);
    assert_eq!(study.run_count(), 4);
    let number = Input::Number;
    assert_eq!(study.inputs(1), [number(2.0), number(12.5), Input::Word("\"pin\"")]);
    assert!(!study.draws_values());
}

#[test]
fn points_that_cannot_be_are_rows_and_leave_the_others_alone() {
    let all = study(LISTED).run_shard(0).table;
    let status = all.texts("status").expect("texts");
    assert_eq!(status, ["completed", "completed", "invalid", "invalid"].map(String::from));
    let reason = all.texts("reason").expect("texts");
    assert!(reason[2].contains("projectile.p.mass"), "{}", reason[2]);
    assert_eq!(reason[3], "`speed` is NaN: a number is needed [E319]");
    let force = all.numbers("force").expect("numbers");
    assert!(force[0] > 0.0 && force[2].is_nan() && force[3].is_nan());
}

#[test]
fn listed_points_give_what_a_grid_gives() {
    let text = |kind: &str| {
        format!(
            "[parameter.speed]\npath = \"projectile.p.velocity[1]\"\nvalues = [1, 2, 3]\n\
             [design]\nkind = \"{kind}\"\n"
        )
    };
    let [listed, grid] = ["points", "grid"].map(|kind| study(&text(kind)).run_shard(0).table);
    assert_eq!(listed.numbers("force"), grid.numbers("force"));
}

#[test]
fn a_file_lists_points_by_name_or_path_and_the_study_then_needs_it_no_more() {
    let folder = tempfile::tempdir().expect("a folder");
    let mass = "[parameter.mass]\npath = \"projectile.p.mass\"\nrange = { from = 1, to = 20 }\n";
    let csv = "mass [g],projectile.p.velocity[1]\n10000,1\n,2\n12500,3 m/s\n";
    let study = from_file(folder.path(), mass, csv).unwrap_or_else(|faults| panic!("{faults}"));
    let names: Vec<&str> = study.parameters().iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["mass", "projectile_p_velocity_1"]);
    assert_eq!(study.inputs(2), [Input::Number(12.5), Input::Number(3.0)]);
    std::fs::remove_file(folder.path().join("points.csv")).expect("removed");
    let again = Study::from_toml(&study.to_toml(), "again").unwrap_or_else(|f| panic!("{f}"));
    assert_eq!(again.fingerprint(), study.fingerprint());
    let table = again.run_shard(0).table;
    let status = table.texts("status").expect("texts");
    assert_eq!(status, ["completed", "invalid", "completed"].map(String::from));
}

#[test]
fn what_is_wrong_with_points_is_reported_with_what_would_be_right() {
    let folder = tempfile::tempdir().expect("a folder");
    let mass = "[parameter.mass]\npath = \"projectile.p.mass\"\n";
    for (csv, wanted) in [
        ("mass\n", "a header without rows"),
        ("1\n2\n", "no header"),
        ("mass,speed\n1,2\n", "the column \"speed\""),
        ("mass,projectile.p.mass\n1,2\n", "a second column"),
        ("projectile.p.velocity[1]\n1\n", "no column for the parameter `mass`"),
        ("mass,projectile.p.velocity[1]\n1\n", "1 cells for 2 columns in line 2"),
    ] {
        let reported = from_file(folder.path(), mass, csv).err().unwrap_or_default();
        assert!(reported.contains(wanted), "{csv:?}: {reported}");
    }
    for (rest, wanted) in [
        (LISTED.replace(", -1.0, 10.0]", "]"), "2 values"),
        (LISTED.replace("values = [10.0, 12.5, -1.0, 10.0]", ""), "no variation"),
        (
            LISTED.replace("values = [10.0, 12.5, -1.0, 10.0]", "range = { from = 1, to = 2 }"),
            "a range or distribution among listed points",
        ),
        (LISTED.replace("12.5", "\"12 m\""), "12 m"),
    ] {
        let reported = read(&rest).err().map(|faults| faults.to_string()).unwrap_or_default();
        assert!(reported.contains(wanted), "{wanted}: {reported}");
    }
    let misspelt = LISTED.replace("values = [1.0", "valeus = [1.0");
    assert_eq!(read(&misspelt).err().map(|faults| faults.all().len()), Some(1));
    let outside = format!(
        "scenario = '''{CANTILEVER}'''\n[design]\nkind = \"points\"\nfile = \"../points.csv\"\n{RESULTS}"
    );
    let reported = Study::from_toml(&outside, "study.toml").err().map(|f| f.to_string());
    assert!(reported.unwrap_or_default().contains("outside the folder"));
}
