//! Studies of what yields.

use percuss::{NoRecorder, Simulation};
use percuss_study::{Ladder, Study, converge};

/// A cantilever that yields, on a spring that yields, struck at its end.
const BASE: &str = r#"
[material.m]
preset = "steel"
yield = "100 MPa"
[section.s]
shape = "rectangle"
width = "4 cm"
depth = "4 cm"
[beam.b]
points = [[0, 0], [1, 0]]
elements = 4
material = "m"
section = "s"
[support.left]
at = "b.start"
kind = "clamp"
[spring.stay]
between = ["b.end", [1.0, -1.0]]
stiffness = "1 MN/m"
yield_force = "1 kN"
[projectile.p]
kind = "elastic"
mass = 10
stiffness = 1e6
velocity = [0, 1]
strikes = "b.end"
[time]
end = 5e-2
step = 5e-5
"#;

const RESULTS: [[&str; 2]; 7] = [
    ["set", "plastic.b.permanent_set"],
    ["along", "plastic.b.permanent_set_at.displacement[1]"],
    ["strain", "plastic.b.strain_max"],
    ["began", "plastic.b.first_yield.time"],
    ["turned", "plastic.b.hinges[0].rotation"],
    ["elongated", "yielding.spring.stay.plastic_extension"],
    ["none", "plastic.b.hinges[7].rotation"],
];

fn study() -> Study {
    let results = RESULTS.map(|[name, path]| format!("{name} = '{path}'")).join("\n");
    let text = format!(
        "scenario = '''{BASE}'''\n[parameter.speed]\npath = \"projectile.p.velocity[1]\"\n\
         values = [0.1, 3, 8]\n[design]\nkind = \"grid\"\n[results]\n{results}"
    );
    Study::from_toml(&text, "study.toml").unwrap_or_else(|faults| panic!("{faults}"))
}

#[test]
fn yielding_in_a_study_agrees_with_the_single_run() {
    let table = study().run_shard(0).table;
    for (run, speed) in ["0.1", "3", "8"].iter().enumerate() {
        let changes = [format!("projectile.p.velocity=[0, {speed}]")];
        let text = percuss_scenario::apply_overrides(BASE, "base", &changes).expect("valid");
        let compiled = percuss_scenario::read(&text, "base").and_then(|s| s.compile());
        let compiled = compiled.expect("valid");
        let alone = Simulation::new(&compiled.model, &compiled.settings).expect("valid");
        let alone = alone.run(&mut NoRecorder);
        let number = |name: &str| table.numbers(name).expect(name)[run];
        assert!(number("none").is_nan());
        let beam = &alone.plastic[0];
        if run == 0 {
            assert!(beam.first_yield.is_none() && number("began").is_nan());
            assert!(number("turned").is_nan());
            // Nothing yielded, and nothing stays: a mean over the runs counts it.
            assert_eq!([number("set"), number("along"), number("strain")], [0.0; 3]);
            continue;
        }
        let set = beam.permanent_set.expect("a set");
        assert_eq!(number("set"), set.size());
        assert_eq!(number("along"), set.displacement[1]);
        assert!(number("along") > 1e-3, "struck upwards it stays bent upwards");
        assert_eq!(number("strain"), beam.strain_max.value);
        assert_eq!(number("began"), beam.first_yield.expect("it yielded").time);
        assert_eq!(number("turned"), beam.hinges[0].rotation);
        assert_eq!(number("elongated"), alone.yielding[0].plastic);
        assert!(number("elongated") > 1e-4);
    }
}

#[test]
fn units_of_what_yields_are_reported() {
    let study = study();
    let table = study.run_shard(0).table;
    assert!(table.numbers("set").is_some());
    let units: Vec<&str> = study.results().iter().map(|result| result.path.unit()).collect();
    assert_eq!(units, ["m", "m", "1", "s", "rad", "m", "rad"]);
}

#[test]
fn convergence_looks_at_what_stays_and_not_at_numbered_hinges() {
    let text = BASE.replace("velocity = [0, 1]", "velocity = [0, 8]");
    let scenario = percuss_scenario::read(&text, "base").expect("valid");
    let ladder = Ladder { results: Vec::new(), levels: 3, accuracy: None };
    let found = converge(&scenario, &ladder, &|| true, &|_, _| {}).expect("levels");
    let paths: Vec<&str> = found.results.iter().map(|one| one.path.as_str()).collect();
    for wanted in ["plastic.b.permanent_set", "plastic.b.rotation"] {
        assert!(paths.contains(&wanted), "{paths:?}");
    }
    assert!(!paths.iter().any(|path| path.contains("hinges")), "{paths:?}");
    let set = found.results.iter().find(|one| one.path.ends_with("permanent_set")).expect("a set");
    // Four elements and steps of 5e-5 s are within a few per cent of the limit, and the limit is reported.
    assert!((set.value / set.limit - 1.0).abs() < 0.1, "{set:?}");
    assert_eq!(set.unit, "m");
}
