//! Studies as functions: values, derivatives, and the results that they take from columns.

use percuss_scenario::Diagnostics;
use percuss_study::{Means, Study};

/// A cantilever struck at its end by a mass behind a spring.
const STUDY: &str = r#"
        scenario = """
[material.m]
young = 2e9
density = 3e3
[section.s]
area = 0.1
inertia = 8e-5
[beam.b]
points = [[0, 0], [3, 0]]
elements = 4
material = "m"
section = "s"
[support.left]
at = "b.start"
kind = "clamp"
[projectile.p]
kind = "elastic"
mass = 100
stiffness = 1e6
velocity = [0, 10]
strikes = "b.end"
[time]
end = 0.02
step = 2e-4
"""
        [parameter.speed]
        path = "projectile.p.velocity[1]"
        range = { from = "5 m/s", to = "20 m/s" }
        [parameter.mass]
        path = "projectile.p.mass"
        range = { from = "50 kg", to = "200 kg" }
        [design]
        kind = "sobol"
        runs = 4
        [results]
        force = "contact.p.peak_force.value"
        exit = "projectile.p.velocity_final[1]"
    "#;

fn study() -> Study {
    Study::from_toml(STUDY, "study.toml").unwrap_or_else(|faults| panic!("{faults}"))
}

/// The study with other results.
fn with_results(results: &str) -> Result<Study, Diagnostics> {
    let head = STUDY.split("[results]").next().expect("a study");
    Study::from_toml(&format!("{head}[results]\n{results}"), "study.toml")
}

#[test]
fn values_are_those_of_the_runs_of_a_design() {
    let study = study();
    let shard = study.run_shard(0);
    let column = |name| shard.table.numbers(name).unwrap_or_default();
    let points: Vec<Vec<f64>> =
        column("speed").iter().zip(column("mass")).map(|(v, m)| vec![*v, m]).collect();
    let mut function = study.function().expect("numbers");
    for (k, values) in function.values(&points).into_iter().enumerate() {
        assert_eq!(values, Ok(vec![column("force")[k], column("exit")[k]]));
    }
}

#[test]
fn a_jacobian_is_what_differences_tend_to() {
    let study = study();
    let mut function = study.function().expect("numbers");
    let at = [12.0, 90.0];
    let jacobian = function.jacobian(&at).expect("derivatives");
    for k in 0..2 {
        let moved = |sign: f64| {
            let mut point = at.to_vec();
            point[k] += sign * 1e-4 * at[k];
            point
        };
        let ends = function.values(&[moved(-1.0), moved(1.0)]);
        let [Ok(low), Ok(high)] = &ends[..] else { panic!("{ends:?}") };
        for (row, (a, b)) in jacobian.derivatives.iter().zip(low.iter().zip(high)) {
            let difference = (b - a) / (2e-4 * at[k]);
            assert!((row[k] / difference - 1.0).abs() < 1e-4, "{} {difference}", row[k]);
        }
    }
}

/// A result each for the times of a column, with derivatives; those without exact ones are differenced, and the answer says so.
#[test]
fn columns_are_results_with_derivatives() {
    let of = |results: &str| with_results(results).unwrap_or_else(|faults| panic!("{faults}"));
    let column = "{ column = \"contact.p.force\", at = [\"5 ms\", \"7.3 ms\"] }";
    let study = of(&format!("F = {column}\nexit = \"projectile.p.velocity_final[1]\""));
    let names: Vec<&str> = study.results().iter().map(|r| r.name.as_str()).collect();
    assert_eq!(names, ["F[0]", "F[1]", "exit"]);
    assert_eq!(study.results()[0].path.unit(), "N");
    let again = Study::from_toml(&study.to_toml(), "study.toml").expect("the same study");
    assert_eq!(again.fingerprint(), study.fingerprint());
    let at = [12.0, 90.0];
    let found = study.function().expect("numbers").jacobian(&at).expect("derivatives");
    assert_eq!(found.means, Means::Exact);
    let run = study.function().expect("numbers").values(&[at.to_vec()]);
    assert_eq!(run[0].as_ref(), Ok(&found.values));

    let moment = "M = { column = \"section.b.end.moment\", max = [0, \"20 ms\"] }\n";
    let both = of(&format!("{moment}F = {column}\nexit = \"projectile.p.velocity_final[1]\""));
    let mixed = both.function().expect("numbers").jacobian(&at).expect("derivatives");
    let Means::Differences { why } = &mixed.means else { panic!("{:?}", mixed.means) };
    assert!(why.contains("section.b.end.moment"), "{why}");
    assert_eq!(mixed.derivatives[1..], found.derivatives[..], "exact where they are known");
    assert!(mixed.derivatives[0].iter().all(|slope| slope.is_finite()));
}

#[test]
fn faults_of_column_results_name_their_place() {
    let refused = |results: &str| with_results(results).expect_err("a fault").to_string();
    let unknown = refused("F = { column = \"contact.p.forces\", at = 0.01 }");
    assert!(unknown.contains("contact.p.force"), "{unknown}");
    let both = refused("F = { column = \"contact.p.force\", at = 0.01, max = [0, 0.01] }");
    assert!(both.contains("one of the two"), "{both}");
    let window = refused("F = { column = \"contact.p.force\", max = [0.02, 0.01] }");
    assert!(window.contains("its start, then its end"), "{window}");
    let nothing = refused("F = { column = \"contact.p.force\" }");
    assert!(nothing.contains("no time"), "{nothing}");
    // The run lasts 20 ms.
    for (times, place, found, expected) in [
        ("at = \"-1 ms\"", "at", "the time -0.001 s before the run", "times from zero on"),
        ("at = [0.01, 0.005]", "at", "the time 0.005 s behind 0.01 s", "in increasing order"),
        ("at = [0.01, 0.01]", "at", "the time 0.01 s behind 0.01 s", "in increasing order"),
        ("at = [0.01, 0.03]", "at", "the time 0.03 s, when the run has ended", "`time.end`"),
        ("max = [0.03, 0.04]", "max", "the time 0.03 s, when the run has ended", "0.02 s"),
        ("min = [-0.02, -0.01]", "min", "a window that ends before the run", "from zero on"),
    ] {
        let text = refused(&format!("F = {{ column = \"contact.p.force\", {times} }}"));
        assert!(text.contains(&format!("results.F.{place}: ")), "{times}: {text}");
        assert!(text.contains(found) && text.contains(expected), "{times}: {text}");
    }
    // At the end there is a last row.
    assert!(with_results("F = { column = \"contact.p.force\", at = [0, 0.02] }").is_ok());
}

#[test]
fn an_end_that_varies_bounds_no_times() {
    let head = STUDY.split("[results]").next().expect("a study");
    let varies = head.replace("projectile.p.mass", "time.end").replace("50 kg", "30 ms");
    let varies = varies.replace("200 kg", "40 ms");
    let late = "[results]\nF = { column = \"contact.p.force\", at = 0.03 }";
    let study = Study::from_toml(&format!("{varies}{late}"), "study.toml");
    assert!(study.is_ok(), "{:?}", study.err().map(|faults| faults.to_string()));
}

#[test]
fn names_of_parameters_are_matched_or_refused() {
    let study = study();
    let function = study.function().expect("numbers");
    assert_eq!(function.places(&["mass", "speed"]), Ok(vec![1, 0]));
    for (names, evaluated) in [
        (["sped", "mass"], "expected one of `speed`, `mass` (did you mean `speed`?)"),
        (["mass", "mass"], "no value for `speed`; the study's parameters are speed, mass"),
    ] {
        let found = function.places(&names).expect_err(evaluated);
        assert!(found.ends_with(evaluated), "{found}");
    }
    let twice = function.places(&["mass", "speed", "mass"]);
    assert_eq!(twice, Err("two values for `mass`".to_owned()));
}

#[test]
fn shares_become_values_of_the_distributions_and_their_copula() {
    let study = study();
    let function = study.function().expect("numbers");
    assert_eq!(function.at(&[0.0, 1.0]), Ok(vec![5.0, 200.0]));
    assert!(function.at(&[0.5, 1.5]).is_err_and(|why| why.contains("a share from 0 to 1")));
    assert_eq!(function.correlation(), None);
    let text = STUDY.replace(
        "[design]",
        "[[correlation]]\nbetween = [\"speed\", \"mass\"]\ncoefficient = 0.6\n[design]",
    );
    let study = Study::from_toml(&text, "study.toml").unwrap_or_else(|e| panic!("{e}"));
    let function = study.function().expect("numbers");
    let matrix = function.correlation().expect("a matrix");
    assert!((matrix[0][1] - 0.6).abs() < 1e-12 && (matrix[1][1] - 1.0).abs() < 1e-12);
    // The median of the speed, and a standard score of z1 = 1: the mass at a score of 0.6 * 0 + 0.8 * 1. Shares of a normal distribution
    // below 1 and 0.8 standard deviations.
    let [one, less] = [0.841_344_746_068_542_9, 0.788_144_601_416_603_4];
    let point = function.at(&[0.5, one]).expect("a point");
    // Quantiles are inverses to some ten digits.
    assert!((point[0] - 12.5).abs() < 1e-6, "{point:?}");
    assert!((point[1] - (50.0 + 150.0 * less)).abs() < 1e-6, "{point:?}");
}

#[test]
fn points_outside_a_study_are_refused() {
    let study = study();
    let mut function = study.function().expect("numbers");
    let evaluated =
        function.values(&[vec![1.0], vec![1.0, f64::NAN], vec![10.0, -1.0], vec![12.0, 90.0]]);
    let reason = |k: usize| evaluated[k].as_ref().err().map_or("", String::as_str);
    assert_eq!(reason(0), "1 numbers for 2 parameters (speed, mass) [E319]");
    assert_eq!(reason(1), "`mass` is NaN: a number is needed [E319]");
    assert!(reason(2).contains("projectile.p.mass"), "{}", reason(2));
    assert!(evaluated[3].is_ok(), "faults of one point leave the others alone");
    let lists = STUDY.replace("range = { from = \"50 kg\", to = \"200 kg\" }", "values = [\"a\"]");
    let lists =
        lists.replace("projectile.p.mass", "projectile.p.kind").replace("[\"a\"]", "[\"elastic\"]");
    let lists = lists
        .replace("kind = \"sobol\"\n        runs = 4", "kind = \"latin-hypercube\"\n runs = 4");
    let study = Study::from_toml(&lists, "study.toml").unwrap_or_else(|faults| panic!("{faults}"));
    assert!(study.function().is_err_and(|error| error.code().to_string() == "E318"));
}

/// A ball of 0.5 kg leaves a contact of 1 MN/m after `pi sqrt(m/k)` = 2.22 ms, at the speed at which it came; a run that ends before that has no final
/// results, and the function says which.
#[test]
fn results_of_contacts_that_are_still_closed_are_not_final() {
    let text = r#"
scenario = """
[projectile.ball]
kind = "elastic"
contact = "surface"
mass = 0.5
velocity = [0, -2]
stiffness = 1e6
position = [0, 0]
strikes = "floor"
[obstacle.floor]
kind = "half-plane"
point = [0, 0]
normal = [0, 1]
[time]
end = "3 ms"
step = "4 us"
"""
[parameter.end]
path = "time.end"
values = ["0.5 ms", "3 ms"]
[design]
kind = "grid"
[results]
impulse = "contact.ball.intervals[0].impulse"
steps = "steps"
out = "projectile.ball.velocity_final[1]"
"#;
    let study = Study::from_toml(text, "ball.toml").unwrap_or_else(|faults| panic!("{faults}"));
    let found = study.function().unwrap().evaluated(&[vec![5e-4], vec![3e-3]]);
    let [short, long] = &found[..] else { panic!("{found:?}") };
    let (short, long) = (short.as_ref().unwrap(), long.as_ref().unwrap());
    assert_eq!((short.open.as_slice(), long.open.as_slice()), (&[0, 2][..], &[][..]));
    assert!((long.values[2] - 2.0).abs() < 1e-3, "{long:?}");
    let said = study.not_final(&short.open).unwrap();
    assert!(said.starts_with("`impulse`, `out` are not final"), "{said}");
    assert_eq!(study.not_final(&long.open), None);
}

/// The largest force of a stop that is closed at the end of a run, and still rising, is not final either.
#[test]
fn largest_forces_of_stops_that_are_still_rising_are_not_final() {
    let text = r#"
scenario = """
[material.m]
young = "200 GPa"
density = 7850
[section.s]
shape = "rectangle"
width = "50 mm"
depth = "50 mm"
[beam.a]
points = [[0, 0], [2, 0]]
elements = 6
material = "m"
section = "s"
[support.root]
at = "a.start"
kind = "clamp"
[support.stop]
at = "a.end"
kind = "stop"
direction = [0, 1]
gap = "1 mm"
stiffness = "1 MN/m"
[load.q]
kind = "point"
at = "a.mid"
force = [0, 20000]
[time]
end = "16 ms"
step = "50 us"
"""
[parameter.end]
path = "time.end"
values = ["10 ms", "16 ms"]
[design]
kind = "grid"
[results]
largest = "support.stop.force_2.min.value"
root = "support.root.moment.max.value"
"#;
    let study = Study::from_toml(text, "stop.toml").unwrap_or_else(|faults| panic!("{faults}"));
    let found = study.function().unwrap().evaluated(&[vec![0.01], vec![0.016]]);
    let open: Vec<Vec<usize>> = found.into_iter().map(|one| one.unwrap().open).collect();
    assert_eq!(open, [vec![0], vec![]]);
    let said = study.not_final(&open[0]).unwrap();
    assert!(said.starts_with("`largest` is not final"), "{said}");
}
