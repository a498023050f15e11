//! Supports, springs, masses, loads, starts and paths: what they accept and what they say of the rest.

use crate::common;

use common::{BEAM, TIME, bad, faults, good};
use percuss_scenario::content::{Anchor, Function, ModalRatios};
use percuss_scenario::read;

fn support(text: &str) -> String {
    format!("[support.s]\nat = \"b.mid\"\n{text}\n")
}

#[test]
fn supports_move_and_let_go() {
    let motion = "kind = \"clamp\"\nuntil = \"5 ms\"\nmotion = { displacement = [0, \"1 cm\"] }";
    let content = good(&support(motion));
    let support_table = &content.support[0].table;
    assert_eq!(support_table.until, 0.005);
    let motion = support_table.motion.as_ref().unwrap();
    assert_eq!((motion.displacement, motion.rotation), ([0.0, 0.01], 0.0));
    assert_eq!(motion.function, Function::Constant);
    assert!(good(&support("kind = \"pin\"")).support[0].table.until.is_infinite());
    bad(
        &support("kind = \"pin\"\nuntil = \"5 mm\"\nmotion = { rotation = \"5 m\", funktion = 1 }"),
        &[
            "16:9: support.s.until: found \"5 mm\", which is a length (m), expected a time (s), \
             such as \"0.15 s\"",
            "17:23: support.s.motion.rotation: found \"5 m\", which is a length (m), expected an \
             angle (rad), such as \"30 deg\"",
            "17:30: support.s.motion.funktion: found the unknown key `funktion`, expected one of \
             `displacement`, `rotation`, `function` (did you mean `function`?)",
        ],
    );
    bad(
        &support("kind = \"pin\"\nmotion = { function = { kind = \"ramp\", duration = 0 } }"),
        &["16:51: support.s.motion.function.duration: found 0 s, expected a duration above zero"],
    );
    bad(
        &support("kind = \"pin\"\nmotion = 3"),
        &["16:10: support.s.motion: found the number 3, expected a table in braces, such as { \
             displacement = ... }"],
    );
}

#[test]
fn supports_are_springs_and_stops() {
    good(&support(
        "kind = \"elastic\"\nrotational_stiffness = \"5 kN*m/rad\"\nrotational_damping = \"1 \
         N*m*s\"",
    ));
    good(&support("kind = \"elastic\"\nstiffness = [\"1 kN/mm\", 0]\ndamping = [0, \"2 N*s/m\"]"));
    good(&support("kind = \"stop\"\ndirection = [0, 1]\nstiffness = \"1 MN/m\"\ntwo_sided = true"));
    bad(
        &support(
            "kind = \"elastic\"\nstiffness = \"1 kN/mm\"\ndamping = [0, \"2 \
             N/m\"]\nrotational_stiffness = \"1 N/m\"",
        ),
        &[
            "16:13: support.s.stiffness: found the text \"1 kN/mm\", expected two components, \
             each a stiffness (N/m), such as [0, \"7.5e5 N/m\"]",
            "17:15: support.s.damping: found \"2 N/m\", which is a stiffness (N/m), expected a \
             damping constant (N*s/m), such as \"200 N*s/m\"",
            "18:24: support.s.rotational_stiffness: found \"1 N/m\", which is a stiffness (N/m), \
             expected a rotational stiffness (N*m), such as \"5 kN*m/rad\"",
        ],
    );
    bad(
        &support("kind = \"stop\"\ngap = \"2 s\"\nstiffness = 1\ntwo_sided = \"yes\""),
        &[
            "13:1: support.s.direction: found no `direction`, expected two components, each a \
             pure number, such as [0, 0.8]",
            "16:7: support.s.gap: found \"2 s\", which is a time (s), expected a length (m), \
             such as \"3 m\"",
            "18:13: support.s.two_sided: found the text \"yes\", expected true or false",
        ],
    );
}

#[test]
fn hinges_may_be_stiff() {
    let other = "[beam.c]\npoints = [[3, 0], [3, 1]]\nelements = 1\nmaterial = \"m\"\nsection = \
     \"s\"\n\
                 [joint.j]\nbetween = [\"b.end\", \"c.start\"]\n";
    good(&format!("{other}kind = \"hinge\"\nstiffness = \"1 kN*m/rad\"\ndamping = \"2 N*m*s\"\n"));
    good(&format!("{other}kind = \"hinge\"\n"));
    let text = faults(&format!("{other}kind = \"rigid\"\nstiffness = 1\n")).to_string();
    assert!(
        text.starts_with(
            "f.toml:21:1: joint.j.stiffness: found `stiffness`, which belongs to kind = \"hinge\""
        ),
        "{text}"
    );
}

#[test]
fn joints_at_projectiles_name_the_spring_to_use() {
    let ball = "[projectile.ball]\nkind = \"elastic\"\ncontact = \"surface\"\nmass = 1\n\
                velocity = [0, 0]\nposition = [3, 1]\nradius = 0.1\nstiffness = 1\n\
                [joint.j]\nkind = \"hinge\"\n";
    for (end, place) in [("ball", "23:21"), ("ball.start", "23:21")] {
        let found = format!(
            "{place}: joint.j.between: found {end:?}, the projectile \"ball\", expected a point on a \
             beam; a projectile is connected by a stiff spring, `[spring.NAME] between = [..., \
             \"ball\"]`, and a mass on a hinge at a point is a `[mass.NAME]`"
        );
        bad(&format!("{ball}between = [\"b.end\", {end:?}]\n"), &[&found]);
    }
}

#[test]
fn springs_reach_beams_and_ground() {
    let content =
        good("[spring.a]\nbetween = [\"b.end\", [3, \"50 cm\"]]\nstiffness = \"1 kN/m\"\n");
    let [one, two] = &content.spring[0].table.between;
    assert!(matches!(one, Anchor::Point(p) if p.label == "b.end"));
    assert_eq!(*two, Anchor::Ground([3.0, 0.5]));
    assert_eq!(content.spring[0].table.length, None);
    bad(
        "[spring.a]\nbetween = [\"c.end\", [3, \"5 s\"]]\nstiffness = 1\ndamping = \"1 \
         N\"\nlength = 1\n",
        &[
            "14:12: spring.a.between: found the unknown beam \"c\", expected `b`",
            "14:25: spring.a.between: found \"5 s\", which is a time (s), expected a length (m), \
             such as \"3 m\"",
            "16:11: spring.a.damping: found \"1 N\", which is a force (N), expected a damping \
             constant (N*s/m), such as \"200 N*s/m\"",
        ],
    );
    bad(
        "[spring.a]\nbetween = [3, \"b.mid\"]\nstiffness = 1\n",
        &["14:12: spring.a.between: found the number 3, expected a point on a beam: \
             BEAM.start, BEAM.mid, BEAM.end, BEAM@0.25 or BEAM@0.75m; the name of a projectile; or a place on the ground, such as [0, \"2 m\"]"],
    );
}

#[test]
fn springs_end_at_projectiles() {
    let ball = "[projectile.ball]\nkind = \"rigid\"\nrestitution = 1\nmass = 1\nvelocity = [0, 0]\n\
                contact = \"surface\"\nradius = 0.1\nposition = [1, -1]\n";
    let text =
        |end: &str| format!("{ball}[spring.a]\nbetween = [\"b.mid\", \"{end}\"]\nstiffness = 1\n");
    let content = good(&text("ball"));
    assert_eq!(content.spring[0].table.between[1], Anchor::Projectile("ball".into()));
    bad(
        &text("bal"),
        &["22:21: spring.a.between: found the text \"bal\", expected a point on a beam: \
             BEAM.start, BEAM.mid, BEAM.end, BEAM@0.25 or BEAM@0.75m; the name of a projectile; or a place on the \
             ground, such as [0, \"2 m\"] (did you mean `ball`?)"],
    );
}

#[test]
fn masses_sit_on_beams() {
    good("[mass.bob]\nat = \"b@1m\"\nmass = \"2 t\"\nrotary_inertia = \"1 kg*m^2\"\n");
    bad(
        "[mass.bob]\nat = \"b.middle\"\nrotary_inertia = \"1 kg*m\"\n",
        &[
            "13:1: mass.bob.mass: found no `mass`, expected a mass (kg), such as \"500 kg\"",
            "14:6: mass.bob.at: found the unknown place `.middle`, expected one of `start`, \
             `mid`, `end` (did you mean `mid`?), or `@` with a fraction or a length",
            "15:18: mass.bob.rotary_inertia: found \"1 kg*m\", which is a rotary inertia per \
             length (kg*m), expected a mass moment of inertia (kg*m^2), such as \"2 kg*m^2\"",
        ],
    );
}

#[test]
fn loads_are_spread_and_follow() {
    let content = good(
        "[load.l]\nkind = \"distributed\"\non = \"b\"\nforce = [0, \"-2 kN/m\"]\nfollower = true\n",
    );
    let text = format!("{:?}", content.load[0].table.kind);
    assert!(text.contains("stretch: [Fraction(0.0), Fraction(1.0)]"), "{text}");
    good("[load.l]\nkind = \"point\"\nat = \"b.end\"\nforce = [0, 1]\nfollower = true\n");
    bad(
        "[load.l]\nkind = \"distributed\"\non = \"c\"\nstretch = [\"begin\", \"1 s\"]\nforce = \
         [0, \"-2 kN\"]\n",
        &[
            "15:6: load.l.on: found the unknown beam \"c\", expected `b`",
            "16:12: load.l.stretch: found the text \"begin\", expected a place along the beam: \
             \"start\", \"mid\", \"end\", 0.25 or \"0.75 m\"",
            "16:21: load.l.stretch: found `1 s`, which is a time (s), expected a fraction or a \
             length, such as 0.25 or 0.75m",
            "17:13: load.l.force: found \"-2 kN\", which is a force (N), expected a force per \
             length (N/m), such as \"5 kN/m\"",
        ],
    );
}

fn load(function: &str) -> String {
    format!("[load.l]\nkind = \"point\"\nat = \"b.end\"\nforce = [0, 1]\nfunction = {function}\n")
}

#[test]
fn loads_take_their_course() {
    for function in [
        "\"constant\"",
        "{ kind = \"constant\" }",
        "{ kind = \"step\", at = 0 }",
        "{ kind = \"ramp\", duration = \"1 ms\" }",
        "{ kind = \"half-sine\", duration = 1 }",
        "{ kind = \"triangle\", duration = 1 }",
        "{ kind = \"harmonic\", frequency = \"50 Hz\", phase = \"90 deg\" }",
        "{ kind = \"table\", times = [0, 1], values = [2, 3], smooth = true }",
    ] {
        good(&load(function));
    }
    for (function, expected) in [
        (
            "3",
            "17:12: load.l.function: found the number 3, expected \"constant\" or a table, such \
             as { kind = \"ramp\", duration = \"10 ms\" }",
        ),
        (
            "\"half-sine\"",
            "17:12: load.l.function: found the text \"half-sine\", expected a table { kind = \
             \"half-sine\", duration = ... }",
        ),
        (
            "{ kind = \"ramp\" }",
            "17:12: load.l.function.duration: found no `duration`, expected a time (s), such as \
             \"0.15 s\"",
        ),
        (
            "{ kind = \"triangle\", duration = -1 }",
            "17:44: load.l.function.duration: found -1 s, expected a duration above zero",
        ),
        (
            "{ kind = \"harmonic\", frequency = \"60 rpm\" }",
            "17:45: load.l.function.frequency: found \"60 rpm\", which is an angular velocity (rad/s), expected a frequency \
             (Hz), such as \"50 Hz\"",
        ),
        (
            "{ kind = \"table\", times = [0, 1], values = [2] }",
            "17:55: load.l.function.values: found 1 value for 2 times, expected as many values \
             as times",
        ),
        (
            "{ kind = \"table\", times = [0], values = [2] }",
            "17:38: load.l.function.times: found a table of 1 time, expected at least two",
        ),
        (
            "{ kind = \"table\", times = [0, 2, 2], values = [2, 1, 0] }",
            "17:38: load.l.function.times: found 2 s after 2 s, expected times that increase",
        ),
        (
            "{ kind = \"table\", times = [0, 2] }",
            "17:12: load.l.function.values: found no `values`, expected `times` and `values`, or \
             `file`",
        ),
        (
            "{ kind = \"table\", times = [0, nan], values = [0, 1] }",
            "17:42: load.l.function.times: found the number nan, expected a finite number",
        ),
    ] {
        bad(&load(function), &[expected]);
    }
    let text = faults(&load("{ kind = \"halfsine\", duration = 1 }")).to_string();
    assert!(text.contains("(did you mean `half-sine`?)"), "{text}");
}

#[test]
fn tables_come_from_files() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/files/f.toml");
    let text = [BEAM, &load("{ kind = \"table\", file = \"pulse.csv\" }"), TIME].concat();
    let scenario = read(&text, folder).unwrap_or_else(|e| panic!("{e}"));
    let Function::Table { times, values, file, .. } = &scenario.content().load[0].table.function
    else {
        panic!("no table");
    };
    assert_eq!(times.as_deref(), Some(&[0.0, 0.002, 0.005, 0.01][..]));
    assert_eq!((values.as_deref(), file), (Some(&[0.0, 1.0, 0.4, 0.0][..]), &None));
    for (rows, expected) in [
        (
            "t,f\n0,0\n1,1\n1,2\n",
            "1 s after 1 s in line 4 of \"FILE\", expected times that increase from row to row",
        ),
        ("t,f\n0,0\n", "\"FILE\" with 1 row, expected at least two rows"),
        (
            "0,0\n1,nan\n",
            "\"nan\", which is no finite number, in line 2 of \"FILE\", expected a CSV file with \
             two columns, time (s) and value",
        ),
    ] {
        let name = format!("percuss-pulse-{}-{}.csv", std::process::id(), rows.len());
        let path = std::env::temp_dir().join(name);
        std::fs::write(&path, rows).unwrap();
        let name = path.display().to_string();
        let function = format!("{{ kind = \"table\", file = '{name}' }}");
        let expected = format!("17:37: load.l.function.file: found {expected}");
        bad(&load(&function), &[&expected.replace("FILE", &name)]);
        std::fs::remove_file(path).unwrap();
    }
    bad(
        &load("{ kind = \"table\", file = \"none.csv\" }"),
        &["17:37: load.l.function.file: found \"none.csv\", which does not exist, expected a \
             CSV file with two columns, time (s) and value"],
    );
    let both = "{ kind = \"table\", times = [0, 1], values = [0, 1], file = \"none.csv\" }";
    assert!(faults(&load(both)).to_string().contains("found `times` besides `file`"));
}

#[test]
fn motion_and_damping_of_the_whole_are_read() {
    let content = good(
        "[initial]\nvelocity = [\"36 km/h\", 0]\nspin = \"180 deg/s\"\nabout = [\"1 cm\", 0]\n\
                        [damping]\nmodal = 0.01\n",
    );
    assert_eq!(content.initial.all.velocity, [10.0, 0.0]);
    assert_eq!(content.initial.all.spin, std::f64::consts::PI);
    assert_eq!(
        (&content.damping.modal, content.damping.modes),
        (&ModalRatios::All(0.01), Some(10))
    );
    good("[damping]\nmodal = [0.01, 0.02]\n");
    good("[damping]\nmodal = \"0.5\"\nmodes = 3\n");
    bad(
        "[initial]\nvelocity = [1]\nspin = \"2 Hz\"\nabout = [1, \"1 s\"]\n",
        &[
            "14:12: initial.velocity: found a list of 1 entry, expected two components, each a \
             velocity (m/s), such as [0, \"20 m/s\"]",
            "15:8: initial.spin: found \"2 Hz\", which is a frequency (Hz), expected an angular velocity (rad/s), \
             such as \"90 deg/s\"",
            "16:13: initial.about: found \"1 s\", which is a time (s), expected a length (m), \
             such as \"3 m\"",
        ],
    );
    bad(
        "[damping]\nmodal = [0.01, 0.02]\nmodes = 3\n",
        &["15:9: damping.modes: found `modes` without a single ratio for all of them, expected \
             `modal` to be one ratio, such as 0.01, or no `modes`"],
    );
    bad(
        "[damping]\nmodal = 0.01\nmodes = 0\n",
        &["15:9: damping.modes: found 0 modes, expected from 1 to 10000 modes"],
    );
    bad(
        "[damping]\nmodal = true\nmodes = 3\n",
        &["14:9: damping.modal: found `true`, expected a ratio of critical damping, such as \
             0.01, or a list of them"],
    );
}

#[test]
fn analyses_start_at_rest_and_follow_paths() {
    let compiled = |text: &str| {
        let text = [BEAM, "[support.s]\nat = \"b.start\"\nkind = \"clamp\"\n", text, TIME].concat();
        read(&text, "f.toml").unwrap().compile().unwrap_or_else(|e| panic!("{e}"))
    };
    assert_eq!(compiled("").path, percuss::PathSettings::default());
    assert_eq!(compiled("").settings.start, percuss::Start::Reference);
    let reach = "[path]\nfirst = 0.1\npoints = 20\n\
                 until = { point = \"b.mid\", component = 2, value = \"-0.1 m\" }\n";
    let end = percuss::PathEnd::Displacement { point: "b.mid".into(), component: 2, value: -0.1 };
    assert_eq!(compiled(reach).path, percuss::PathSettings { first: 0.1, points: 20, end });
    assert!(format!("{:?}", compiled(reach).model).contains("b.mid"));
    assert_eq!(compiled("[path]\nfactor = 2\n").path.end, percuss::PathEnd::Factor(2.0));
    for (text, expected) in [
        (
            "factor = 2\nuntil = { point = \"b.mid\", component = 2, value = 1 }",
            "15:9: path.until: found `until` besides `factor`, expected one of the two",
        ),
        (
            "until = { point = \"b.mid\", component = 3, value = 1 }",
            "14:40: path.until.component: found 3, expected 1 or 2",
        ),
        (
            "until = { point = \"b.mid\", component = 1 }",
            "14:9: path.until.value: found no `value`, expected a length (m), such as \"3 m\"",
        ),
        ("first = 0", "14:9: path.first: found 0, expected a load factor above zero"),
        (
            "until = { point = \"b@4m\", component = 1, value = 1 }",
            "14:19: path.until.point: found b@4m (4 m along the beam), expected a point of `b`, \
             from 0 to 3 m",
        ),
        ("points = 0", "14:10: path.points: found 0, expected at least 1 point"),
        ("factor = 0", "14:10: path.factor: found 0, expected a load factor to reach, not zero"),
    ] {
        bad(&format!("[path]\n{text}\n"), &[expected]);
    }
    let text = [BEAM, TIME, "start = \"statics\"\n"].concat();
    let fault = read(&text, "f.toml").unwrap_err().to_string();
    assert_eq!(
        fault,
        "f.toml:16:9: time.start: found the text \"statics\", expected one of `reference`, \
         `static` (did you mean `static`?)"
    );
    let text = text.replace("statics", "static");
    assert_eq!(
        read(&text, "f.toml").unwrap().compile().unwrap().settings.start,
        percuss::Start::Static
    );
}

#[test]
fn faults_of_a_broken_beam_are_reported_once() {
    let text = BEAM.replace("[3, 0]", "[\"3 s\", 0]")
        + "[mass.bob]\nat = \"b@7\"\nmass = 1\n\
           [spring.a]\nbetween = [\"b@7\", [0, 0]]\nstiffness = 1\n\
           [load.l]\nkind = \"distributed\"\non = \"b\"\nforce = [0, 1]\nstretch = [0, \"7 m\"]\n\
           [path]\nuntil = { point = \"b@7\", component = 1, value = 1 }\n"
        + TIME;
    let all = read(&text, "f.toml").unwrap_err();
    assert_eq!(all.all().len(), 1, "{all}");
}
