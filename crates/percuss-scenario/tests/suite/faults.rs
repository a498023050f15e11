//! Every fault of a file: its place, what was found, what would be right.

use percuss_scenario::content::Touch;
use percuss_scenario::{Diagnostics, read};

const ELASTIC: &str = include_str!("../files/elastic.toml");
const RIGID: &str = include_str!("../files/rigid.toml");

/// Reads and compiles; every fault that comes of it.
fn faults(text: &str) -> Diagnostics {
    match read(text, "f.toml").and_then(|s| s.compile()) {
        Ok(_) => panic!("no fault in\n{text}"),
        Err(faults) => faults,
    }
}

/// The one fault of a file after `from` has been replaced.
fn one(file: &str, from: &str, to: &str) -> String {
    assert!(file.contains(from), "{from}");
    let faults = faults(&file.replacen(from, to, 1));
    assert_eq!(faults.all().len(), 1, "{faults}");
    faults.to_string()
}

#[track_caller]
fn check(file: &str, from: &str, to: &str, expected: &str) {
    assert_eq!(one(file, from, to), format!("f.toml:{expected}"));
}

#[test]
fn a_wrong_dimension_names_both() {
    check(
        ELASTIC,
        "area = \"1e3 cm^2\"",
        "area = \"8330 cm^4\"",
        "9:8: section.plank.area: found \"8330 cm^4\", which is a second moment of area (m^4), \
         expected an area (m^2), such as \"1e3 cm^2\"",
    );
    check(
        ELASTIC,
        "500 kg",
        "500",
        "29:8: projectile.mass.mass: found \"500\", which is a pure number, \
         expected a mass (kg), such as \"500 kg\"",
    );
    check(
        ELASTIC,
        "\"20 m/s\"",
        "\"20 N*s/m\"",
        "31:16: projectile.mass.velocity: found \"20 N*s/m\", which is a damping constant (N*s/m), \
         expected a velocity (m/s), such as \"20 m/s\"",
    );
}

#[test]
fn angles_are_no_ratios_and_revolutions_no_rates() {
    for (from, to, part) in [
        (
            "restitution = 1.0",
            "restitution = \"30 deg\"",
            "which is an angle (rad), expected a number",
        ),
        (
            "[time]",
            "[initial]\nspin = \"1500 1/min\"\n[time]",
            "which is a frequency (Hz), expected an angular velocity (rad/s)",
        ),
        (
            "[time]",
            "[initial]\nspin = \"25 Hz\"\n[time]",
            "which is a frequency (Hz), expected an angular velocity (rad/s)",
        ),
        (
            "restitution = 1.0",
            "restitution = 1.0\nfriction = \"17 deg\"\ncontact = \"surface\"",
            "which is an angle (rad), expected a",
        ),
    ] {
        let text = faults(&RIGID.replacen(from, to, 1)).to_string();
        assert!(text.contains(part), "{to}: {text}");
    }
    let turns = "[initial]\nspin = \"1500 rev/min\"\n[time]";
    let mut scenario = read(&RIGID.replacen("[time]", turns, 1), "f.toml").unwrap();
    let spin = scenario.field("initial.spin").unwrap();
    let (value, unit) = scenario.number(&spin).unwrap();
    assert!(
        (value / (50.0 * std::f64::consts::PI) - 1.0).abs() < 1e-15 && unit == "rad/s",
        "{value}"
    );
}

#[test]
fn an_unknown_unit_is_marked_inside_its_text() {
    check(
        ELASTIC,
        "500 kg",
        "500 Kg",
        "29:13: projectile.mass.mass: found the unknown unit `Kg`, \
         expected a known unit (did you mean `kg`?)",
    );
}

#[test]
fn an_unknown_key_comes_with_a_suggestion() {
    check(
        ELASTIC,
        "standoff =",
        "stand_off =",
        "33:1: projectile.mass.stand_off: found the unknown key `stand_off`, expected one of \
         `mass`, `velocity`, `direction`, `dissipation`, `rebound`, `force`, `stiffness`, `unloading_stiffness`, \
         `strikes`, `standoff`, `rear`, `local_mass`, `kind`, `contact`, `law` \
         (did you mean `standoff`?)",
    );
    assert!(one(ELASTIC, "title", "titel").contains("(did you mean `title`?)"));
}

#[test]
fn a_key_of_another_kind_says_so() {
    let text = one(RIGID, "standoff =", "stiffness = 1.0\nstandoff =");
    assert!(text.starts_with(
        "f.toml:30:1: projectile.hammer.stiffness: found `stiffness`, which belongs to \
         kind = \"elastic\", expected one of"
    ));
    let text = one(ELASTIC, "step =", "closed_tolerance = 1e-9\nstep =");
    assert!(text.contains("which belongs to impacts = \"time-stepping\""), "{text}");
    let text = one(RIGID, "scheme = \"energy-momentum\"", "spectral_radius = 0.5");
    assert!(text.contains("which belongs to scheme = \"generalized-alpha\""), "{text}");
}

#[test]
fn a_missing_key_points_at_the_header_of_its_table() {
    check(
        ELASTIC,
        "area = \"1e3 cm^2\"\n",
        "",
        "8:1: section.plank.area: found no `area`, expected an area (m^2), such as \"1e3 cm^2\"",
    );
    let text = one(ELASTIC, "kind = \"elastic\"", "# ");
    assert!(text.starts_with("f.toml:27:1: projectile.mass.kind: found no `kind`"), "{text}");
}

#[test]
fn a_missing_table_is_named() {
    let beam = faults("[time]\nend = 1\nstep = 0.1\n");
    assert_eq!(
        beam.to_string(),
        "f.toml:1:1: beam: found no beam, expected at least one table [beam.NAME], or free projectiles \
         [projectile.NAME] and their contacts"
    );
    let text = &ELASTIC[..ELASTIC.find("[time]").unwrap()];
    assert!(faults(text).to_string().contains("time: found no [time], expected a table with"));
    let text = faults("[beam]\n[time]\nend = 1\nstep = 0.1\n").to_string();
    assert!(text.starts_with("f.toml:1:1: beam: found no beam"), "{text}");
}

#[test]
fn a_wrong_type_is_named() {
    for (from, to, found) in [
        ("elements = 6", "elements = 6.5", "the number 6.5"),
        ("elements = 6", "elements = -6", "the number -6"),
        ("elements = 6", "elements = \"6\"", "the text \"6\""),
        ("area = \"1e3 cm^2\"", "area = true", "`true`"),
        ("area = \"1e3 cm^2\"", "area = 1979-05-27", "a date"),
        ("area = \"1e3 cm^2\"", "area = [1]", "a list of 1 entry"),
        ("area = \"1e3 cm^2\"", "area = {x = 1}", "a table"),
        ("strikes = \"girder.mid\"", "strikes = 3", "the number 3"),
        ("points = [[0, 0], [\"3 m\", 0]]", "points = 3", "the number 3"),
    ] {
        let text = faults(&ELASTIC.replacen(from, to, 1)).to_string();
        assert!(text.contains(&format!("found {found}, expected ")), "{to}: {text}");
    }
    assert!(one(ELASTIC, "[time]", "[[time]]").contains("expected a table [time]"));
    let text = faults(&ELASTIC.replace("[support.left]", "[support]")).to_string();
    assert!(text.contains("expected a table [support.at]"), "{text}");
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    for value in ["nan", "inf", "-inf", "1e400", "\"1e400 m\"", "\"nan m\"", "\"inf m\""] {
        let text = one(ELASTIC, "\"0.2 m\"", value);
        assert!(text.starts_with("f.toml:33:1"), "{text}");
    }
}

#[test]
fn an_unknown_name_comes_with_a_suggestion() {
    check(
        ELASTIC,
        "material = \"composite\"",
        "material = \"compsite\"",
        "16:12: beam.girder.material: found the unknown material \"compsite\", expected `composite`",
    );
    let text = one(ELASTIC, "strikes = \"girder.mid\"", "strikes = \"grider.mid\"");
    assert!(text.contains("found the unknown beam \"grider\", expected `girder`"), "{text}");
}

#[test]
fn points_on_beams_are_read_in_every_form() {
    let label = |point: &str| -> String {
        let text = ELASTIC.replacen("strikes = \"girder.mid\"", &format!("strikes = {point:?}"), 1);
        let scenario = read(&text, "f.toml").unwrap_or_else(|e| panic!("{e}"));
        let Touch::Point { strikes: point, .. } = &scenario.content().projectile[0].table.contact
        else {
            panic!("{text}");
        };
        format!("{} {:?}", point.label, point.along)
    };
    assert_eq!(label("girder.start"), "girder.start Fraction(0.0)");
    assert_eq!(label("girder.mid"), "girder.mid Fraction(0.5)");
    assert_eq!(label("girder.end"), "girder.end Fraction(1.0)");
    assert_eq!(label("girder@0.25"), "girder@0.25 Fraction(0.25)");
    assert_eq!(label("girder@0.75m"), "girder@0.75m Distance(0.75)");
    assert_eq!(label(" girder @ 75 cm "), "girder@75cm Distance(0.75)");
    for (point, part) in [
        ("girder", "expected a point on a beam"),
        ("girder.middle", "(did you mean `mid`?)"),
        ("girder@", "does not begin with a number"),
        ("girder@3 kg", "which is a mass (kg)"),
        ("girder@1.5", "from 0 to 1"),
        ("girder@4 m", "from 0 to 3"),
    ] {
        let text = one(ELASTIC, "\"girder.mid\"", &format!("{point:?}"));
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn a_name_with_a_dot_is_refused() {
    let text = one(ELASTIC, "[support.left]", "[support.\"le.ft\"]");
    assert!(text.contains("found the name \"le.ft\", expected a name of letters"), "{text}");
}

#[test]
fn faults_of_the_model_are_found_where_their_values_stand() {
    check(
        RIGID,
        "100 kg",
        "-100 kg",
        "27:8: projectile.hammer.mass: found -100 kg, expected a mass above zero",
    );
    check(
        RIGID,
        "restitution = 1.0",
        "restitution = 2",
        "31:15: projectile.hammer.restitution: found 2, expected a coefficient from 0 to 1",
    );
    let text = one(RIGID, "2 cm", "-2 cm");
    assert!(text.starts_with("f.toml:30:12: projectile.hammer.standoff: found"), "{text}");
    let text = one(RIGID, "1e-5 s", "0 s");
    assert!(text.starts_with("f.toml:35:8: time.step: found 0 s"), "{text}");
    let text = one(RIGID, "elements = 6", "elements = 0");
    assert!(text.starts_with("f.toml:13:12: beam.girder.elements: found 0 elements"), "{text}");
    let text = one(RIGID, "scheme = \"energy-momentum\"", "scheme = \"newmark\"");
    assert!(text.starts_with("f.toml:39:10: integrator.scheme: found a scheme"), "{text}");
}

#[test]
fn a_step_or_an_accuracy_is_given_and_not_both() {
    let step = "step = \"1e-5 s\"";
    let valid = read(&RIGID.replace(step, "accuracy = \"1 %\""), "f.toml").unwrap();
    let settings = valid.compile().unwrap().settings;
    assert_eq!(settings.accuracy, Some(0.01));
    assert!(settings.step > 0.0 && settings.step < 0.1 * settings.end);
    let text = one(RIGID, step, "");
    let expected = "time.step: found neither `step` nor `accuracy`, expected `step` (a time, such as \"1e-5 s\") or \
                    `accuracy` (such as \"1 %\")";
    assert!(text.contains(expected), "{text}");
    // A slip of the pen is one fault.
    let text = one(RIGID, step, "acuracy = 0.01");
    assert!(text.contains("did you mean `accuracy`?") && text.lines().count() == 1, "{text}");
    let text = one(RIGID, step, &format!("{step}\naccuracy = 0.01"));
    assert!(
        text.starts_with(
            "f.toml:36:12: time.accuracy: found `accuracy` besides `step`, expected one of the two"
        ),
        "{text}"
    );
    for (accuracy, found) in [
        ("0", "found 0, expected an accuracy from 1e-6 to 0.2"),
        ("2", "found 2, expected an accuracy from 1e-6 to 0.2"),
        ("\"1 s\"", "time.accuracy: found"),
    ] {
        let text = one(RIGID, step, &format!("accuracy = {accuracy}"));
        assert!(text.starts_with("f.toml:35:12: time.accuracy") && text.contains(found), "{text}");
    }
    let text = RIGID.replace(step, "accuracy = 0.01");
    let text = one(&text, "impacts = \"event\"", "impacts = \"time-stepping\"");
    assert!(text.contains("a gap that is evaluated once per step"), "{text}");
}

#[test]
fn faults_of_reading_of_the_model_and_of_the_settings_appear_together() {
    let text = RIGID
        .replace("area = \"1e3 cm^2\"", "area = \"1e3 cm\"")
        .replace("density = \"3000 kg/m^3\"", "density = -1")
        .replace("\"100 kg\"", "\"-100 kg\"")
        .replace("step = \"1e-5 s\"", "step = 0")
        .replace("girder.end", "grider.end");
    let all = faults(&text);
    let paths: Vec<&str> = all.all().iter().map(|d| d.path.as_str()).collect();
    let expected = [
        "material.stiff.density",
        "section.plank.area",
        "support.right.at",
        "projectile.hammer.mass",
        "time.step",
    ];
    assert_eq!(paths, expected);
    let text = text.replace("grider.end", "girder.end").replace("1e3 cm\"", "1e3 cm^2\"");
    assert_eq!(faults(&text).all().len(), 3);
}

#[test]
fn a_value_that_could_not_be_read_causes_no_second_fault() {
    for (from, to) in [
        ("points = [[0, 0], [\"3 m\", 0]]", "points = [[0, 0], [\"3 s\", 0]]"),
        ("end = \"0.02 s\"", "end = \"0.02 m\""),
        ("velocity = [0, \"-40 m/s\"]", "velocity = [0, \"-40 m\"]"),
        ("kind = \"rigid\"", "kind = \"rigit\""),
        ("elements = 6", "elements = \"six\""),
    ] {
        let text = RIGID.replace("strikes = \"girder.mid\"", "strikes = \"girder@2.5m\"");
        one(&text, from, to);
    }
}

#[test]
fn points_of_valid_beams_are_checked_beside_a_broken_one() {
    let text = RIGID.replace("strikes = \"girder.mid\"", "strikes = \"girder@7\"")
        + "[beam.other]\npoints = \"?\"\nelements = 1\nmaterial = \"stiff\"\nsection = \"plank\"\n\
           [support.other]\nat = \"other@7\"\nkind = \"pin\"\n";
    let all = faults(&text);
    let paths: Vec<&str> = all.all().iter().map(|d| d.path.as_str()).collect();
    assert_eq!(paths, ["projectile.hammer.strikes", "beam.other.points"]);
}

#[test]
fn comparison_wants_coefficients_and_a_rigid_projectile() {
    let with = |file: &str, list: &str| format!("{file}\n[report]\nrestitution = {list}\n");
    let compiled = read(&with(RIGID, "[0, 0.5, 1]"), "f.toml").unwrap().compile().unwrap();
    assert_eq!(compiled.comparison, Some(vec![0.0, 0.5, 1.0]));
    assert!(faults(&with(RIGID, "[2]")).to_string().contains("coefficients from 0 to 1"));
    assert!(faults(&with(RIGID, "[]")).to_string().contains("an empty list"));
    assert!(faults(&with(ELASTIC, "[1]")).to_string().contains("without a rigid projectile"));
}

#[test]
fn supports_hold_components_by_number_and_by_name() {
    let fix = |list: &str| {
        ELASTIC.replacen(
            "kind = \"clamp\"  ",
            &format!("kind = \"fix\"\ncomponents = {list}\n#"),
            1,
        )
    };
    let a = read(&fix("[1, 2, \"rotation\", \"stretch\"]"), "a").unwrap();
    let names = "[\"displacement_1\", \"displacement_2\", \"rotation\", \"stretch\"]";
    assert_eq!(a.content(), read(&fix(names), "b").unwrap().content());
    let text = faults(&fix("[3, \"rotaton\"]")).to_string();
    assert!(text.contains("found the number 3") && text.contains("(did you mean `rotation`?)"));
    let text = faults(&fix("[]")).to_string();
    assert!(text.contains("support.left.components: found no components"), "{text}");
}

/// What other programs call a key or a kind is answered by what it is called here.
#[test]
fn words_of_other_programs_are_answered_by_ours() {
    let table = |keys: &str| format!("{ELASTIC}\n[{keys}\n");
    for (from, to, ours) in [
        ("young =", "E =", "young"),
        ("density =", "rho =", "density"),
        ("area =", "A =", "area"),
        ("inertia =", "I =", "inertia"),
        ("step =", "dt =", "step"),
        ("elements =", "nodes =", "elements"),
        ("\"clamp\"", "\"fixed\"", "clamp"),
        ("\"clamp\"", "\"encastre\"", "clamp"),
        ("\"clamp\"", "\"pinned\"", "pin"),
        ("\"clamp\"", "\"hinged\"", "pin"),
    ] {
        let text = one(ELASTIC, from, to);
        assert!(text.contains(&format!("(did you mean `{ours}`?)")), "{to}: {text}");
        assert!(!text.contains(&format!("no `{ours}`")), "told once: {text}");
    }
    let reported = |text: &str| percuss_scenario::read(text, "f.toml").unwrap_err().coded();
    let beams = reported(&table("nodes.a]\nx = 0"));
    assert!(beams.contains("did you mean `beam`?"), "{beams}");
    let poisson = one(ELASTIC, "young =", "nu = 0.3\nyoung =");
    assert!(poisson.contains("`poisson`, used by shear-flexible beams"), "{poisson}");
}

/// Gravity pulls down, in the example of the message too.
#[test]
fn the_example_of_gravity_points_down() {
    let text = format!("{ELASTIC}\n[load.weight]\nkind = \"gravity\"\n");
    let reported = percuss_scenario::read(&text, "f.toml").unwrap_err().coded();
    assert!(reported.contains("such as [0, \"-9.81 m/s^2\"]"), "{reported}");
}
