//! Whatever is wrong with the input: exit status 2, one clear message with its place, nothing written.

use crate::common;

use common::{ELASTIC, RIGID, Sandbox};

/// Runs and checks `text`: both fail alike, with a message at the place of `mark` (its line, and the
/// column where it begins) that contains `found` and `expected`; nothing is written.
#[track_caller]
fn fault(text: &str, mark: &str, found: &str, expected: &str) {
    let line = text.lines().position(|line| line.contains(mark)).expect("the mark is in the file");
    let column =
        text.lines().nth(line).and_then(|l| l.find(mark)).expect("the mark is in its line");
    let value = mark.find("= ").map_or(0, |at| at + 2);
    let place = format!("bad.toml:{}:{}: ", line + 1, column + value + 1);
    let sandbox = Sandbox::empty();
    sandbox.put("bad.toml", text);
    let run = sandbox.percuss(&["run", "bad.toml"]);
    run.ends_with(2).tells(&place).tells(found).tells(expected);
    assert_eq!(run.stderr.lines().count(), 1, "more than one message:\n{}", run.stderr);
    assert_eq!(run.stdout, "");
    let check = sandbox.percuss(&["check", "bad.toml"]);
    check.ends_with(2);
    assert_eq!(check.stderr, run.stderr);
    assert_eq!(sandbox.names(), ["bad.toml"], "something was written");
}

/// As [`fault`], with `old` in `text` replaced by `new`, the mark.
#[track_caller]
fn changed(text: &str, old: &str, new: &str, found: &str, expected: &str) {
    assert!(text.contains(old), "no {old:?} in the example");
    fault(&text.replacen(old, new, 1), new, found, expected);
}

#[test]
fn a_mass_must_be_positive() {
    for bad in ["mass = \"-500 kg\"", "mass = 0", "mass = \"0 kg\""] {
        changed(ELASTIC, "mass = \"500 kg\"", bad, "projectile.mass.mass: found", "above zero");
    }
}

#[test]
fn a_density_must_not_be_negative() {
    for bad in ["density = -3000", "density = \"-1 kg/m^3\""] {
        changed(
            ELASTIC,
            "density = \"3000 kg/m^3\"",
            bad,
            "composite.density: found",
            "zero or above",
        );
    }
}

#[test]
fn an_area_must_be_positive() {
    for bad in ["area = \"-1 cm^2\"", "area = 0.0"] {
        changed(ELASTIC, "area = \"1e3 cm^2\"", bad, "section.plank.area: found", "above zero");
    }
}

#[test]
fn a_beam_must_have_a_length() {
    let zero = "points = [[0, 0], [0, 0]]";
    changed(ELASTIC, "points = [[0, 0], [\"3 m\", 0]]", zero, "beam.girder.points", "expected");
}

#[test]
fn a_beam_must_have_elements() {
    for bad in ["elements = 0", "elements = -6", "elements = 2.5"] {
        changed(ELASTIC, "elements = 6", bad, "beam.girder.elements: found", "expected");
    }
}

#[test]
fn a_restitution_lies_between_zero_and_one() {
    for bad in ["restitution = 1.01", "restitution = -0.1"] {
        changed(RIGID, "restitution = 1.0", bad, "hammer.restitution: found", "from 0 to 1");
    }
}

#[test]
fn a_unit_must_have_the_dimension_due() {
    let bad = "area = \"8330 cm^4\"";
    changed(ELASTIC, "area = \"1e3 cm^2\"", bad, "a second moment of area (m^4)", "an area (m^2)");
    let bad = "mass = \"500 N\"";
    changed(ELASTIC, "mass = \"500 kg\"", bad, "a force (N)", "a mass (kg)");
}

#[test]
fn an_unknown_key_is_answered_with_the_nearest_known_one() {
    let text = ELASTIC.replacen("stiffness = ", "stifness = ", 1);
    let sandbox = Sandbox::empty();
    sandbox.put("bad.toml", text);
    let run = sandbox.percuss(&["run", "bad.toml"]);
    run.ends_with(2).tells("bad.toml:30:1: ").tells("unknown key `stifness`");
    run.tells("did you mean `stiffness`?");
    assert_eq!(sandbox.names(), ["bad.toml"]);
}

#[test]
fn a_point_must_exist() {
    let old = "strikes = \"girder.mid\"";
    for bad in ["girder.middle", "girders.mid", "girder@1.5", "girder@4m"] {
        let new = format!("strikes = \"{bad}\"");
        changed(ELASTIC, old, &new, "projectile.mass.strikes: found", "expected");
    }
}

#[test]
fn a_projectile_must_not_start_in_the_beam() {
    let bad = "standoff = \"-1 mm\"";
    changed(ELASTIC, "standoff = \"0.2 m\"", bad, "projectile.mass.standoff: found", "expected");
    let bad = "standoff = -0.001";
    changed(RIGID, "standoff = \"2 cm\"", bad, "projectile.hammer.standoff: found", "expected");
}

#[test]
fn a_step_must_fit_into_the_run() {
    let bad = "step = \"0.2 s\"";
    changed(ELASTIC, "step = \"1e-4 s\"", bad, "longer than the run", "no longer than the run");
}

#[test]
fn numbers_must_be_finite() {
    for bad in ["nan", "inf", "-inf", "1e999"] {
        let new = format!("mass = {bad}");
        changed(ELASTIC, "mass = \"500 kg\"", &new, "projectile.mass.mass: found", "expected");
    }
    for bad in ["end = nan", "end = inf"] {
        changed(ELASTIC, "end = \"0.15 s\"", bad, "time.end: found", "expected");
    }
}

#[test]
fn every_fault_is_reported_at_once() {
    let text = RIGID
        .replace("density = \"3000 kg/m^3\"", "density = -1")
        .replace("elements = 6", "elements = 0")
        .replace("mass = \"100 kg\"", "mass = \"100 m\"");
    let sandbox = Sandbox::empty();
    sandbox.put("bad.toml", text);
    let check = sandbox.percuss(&["check", "bad.toml"]);
    check.ends_with(2).tells("bad.toml:5:11").tells("bad.toml:13:12").tells("bad.toml:27:8");
    assert_eq!(check.stderr.lines().count(), 3, "{}", check.stderr);
}

#[test]
fn binary_files_are_no_scenarios() {
    let sandbox = Sandbox::empty();
    sandbox.put("latin.toml", b"# one\ntitle = \"\xfcber\"\n");
    sandbox.put("empty.toml", "");
    std::fs::create_dir(sandbox.path("directory.toml")).expect("a directory");
    let before = sandbox.names();
    for command in ["run", "check"] {
        let latin = sandbox.percuss(&[command, "latin.toml"]);
        latin.ends_with(2).tells("latin.toml:2:10: ").tells("not UTF-8").tells("expected a text");
        let empty = sandbox.percuss(&[command, "empty.toml"]);
        empty.ends_with(2).tells("empty.toml").tells("an empty file").tells("expected a scenario");
        let directory = sandbox.percuss(&[command, "directory.toml"]);
        directory.ends_with(2).tells("directory.toml: found a directory").tells("a scenario file");
        let missing = sandbox.percuss(&[command, "missing.toml"]);
        missing.ends_with(2).tells("missing.toml: found no such file").tells("a scenario file");
    }
    assert_eq!(sandbox.names(), before);
}

#[test]
fn a_change_that_does_not_fit_is_a_fault() {
    let sandbox = Sandbox::new();
    let before = sandbox.names();
    let unknown = sandbox.percuss(&["run", "elastic.toml", "--set", "projectile.mass.mas=3"]);
    unknown.ends_with(2).tells("--set").tells("did you mean `mass`?");
    let nobody = sandbox.percuss(&["run", "elastic.toml", "--set", "projectile.ball.mass=3"]);
    nobody.ends_with(2).tells("the unknown name `ball`");
    let negative = sandbox.percuss(&["run", "elastic.toml", "--set", "projectile.mass.mass=-3"]);
    negative.ends_with(2).tells("elastic.toml:29:8: ").tells("found -3").tells("--set changes");
    assert_eq!(sandbox.names(), before);
}

#[test]
fn the_command_line_itself_is_checked() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&["rum", "elastic.toml"]).ends_with(2).tells("'run'");
    sandbox.percuss(&["run"]).ends_with(2).tells("<FILE>");
    sandbox.percuss(&["run", "elastic.toml", "--stric"]).ends_with(2).tells("--strict");
    sandbox.percuss(&["run", "elastic.toml", "--history", "xml"]).ends_with(2).tells("parquet");
    sandbox.percuss(&["new", "elastik"]).ends_with(2).tells("'elastic'");
    sandbox.percuss(&["verify", "rigid-rot"]).ends_with(2).tells("'rigid-rod'");
}

/// The elastic example with its projectile free; `keys` stand below.
fn free(keys: &str) -> String {
    let end = "[time]";
    let text = ELASTIC.replace("standoff = \"0.2 m\"\n", "contact = \"surface\"\n");
    text.replacen(end, &format!("{keys}\n{end}"), 1)
}

#[test]
fn keys_of_free_projectiles_say_so() {
    let old = "standoff = \"2 cm\"";
    for bad in ["radius = \"5 cm\"", "position = [1, 1]", "friction = 0.3", "spin = 2"] {
        let key = bad.split(' ').next().expect("a key");
        let found = format!("hammer.{key}: found `{key}`, which belongs to contact = \"surface\"");
        let text = RIGID.replacen(old, &format!("{old}\n{bad}"), 1);
        let sandbox = Sandbox::empty();
        sandbox.put("bad.toml", text);
        sandbox.percuss(&["check", "bad.toml"]).ends_with(2).tells("bad.toml:31:1: ").tells(&found);
    }
}

#[test]
fn an_elastic_projectile_takes_a_rebound_for_a_restitution() {
    let old = "standoff = \"0.2 m\"";
    let sandbox = Sandbox::empty();
    sandbox.put("bad.toml", ELASTIC.replacen(old, &format!("{old}\nrestitution = 0.5"), 1));
    let run = sandbox.percuss(&["run", "bad.toml"]);
    run.ends_with(2).tells("bad.toml:34:1: projectile.mass.restitution: found `restitution`");
    run.tells("expected `rebound = { restitution = ..., velocity = ... }`");
    let rebound = "rebound = { restitution = 1.5, velocity = 2 }";
    sandbox.put("bad.toml", ELASTIC.replacen(old, &format!("{old}\n{rebound}"), 1));
    let run = sandbox.percuss(&["run", "bad.toml"]);
    run.ends_with(2).tells("bad.toml:34:27: projectile.mass.rebound.restitution: found 1.5");
}

#[test]
fn a_free_projectile_begins_somewhere_and_strikes_what_there_is() {
    let text = free("").replacen("\"girder.mid\"", "\"girder\"", 1);
    let sandbox = Sandbox::empty();
    sandbox.put("bad.toml", text);
    sandbox.percuss(&["run", "bad.toml"]).ends_with(2).tells("found no `position`");
    let unknown = free("").replacen("\"girder.mid\"", "[\"girder.mid\", \"flor\"]", 1);
    sandbox.put("bad.toml", unknown + "[obstacle.floor]\nkind = \"half-plane\"\npoint = [0, -1]\n");
    let run = sandbox.percuss(&["run", "bad.toml"]);
    run.ends_with(2)
        .tells("unknown beam, obstacle or projectile \"flor\"")
        .tells("did you mean `floor`?");
    run.tells("obstacle.floor.normal: found no `normal`");
    assert_eq!(run.stderr.lines().count(), 2, "{}", run.stderr);
}

#[test]
fn an_obstacle_stands_for_something_to_touch() {
    let wall = "[obstacle.wall]\nkind = \"wall\"\nends = [[0, 2], [3, 2]]\n";
    let sandbox = Sandbox::empty();
    sandbox.put("bad.toml", format!("{ELASTIC}\n{wall}"));
    sandbox.percuss(&["run", "bad.toml"]).ends_with(2).tells("obstacle.wall: found no contact");
    let contact = "[contact.c]\nbetween = [\"mass\", \"wall\"]\nstiffness = 1\n";
    sandbox.put("bad.toml", format!("{ELASTIC}\n{wall}{contact}"));
    let run = sandbox.percuss(&["run", "bad.toml"]);
    run.ends_with(2).tells("contact.c.between: found the projectile \"mass\", which is guided");
}
