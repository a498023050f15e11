//! What speaks against a result is reported.

use std::fmt::Write;

use crate::common::{FIT, Noise, SCENARIO, desk, fitted, history, parameter, problem, put, record};

fn kinds(fit: &percuss_fit::Fit) -> Vec<&'static str> {
    fit.doubts.iter().map(|doubt| doubt.kind.name()).collect()
}

#[test]
fn a_sound_fit_has_no_doubts() {
    let desk = desk(&record(SCENARIO, 7, 1.0));
    let fit = fitted(desk.path(), FIT).expect("a fit");
    let reported = kinds(&fit);
    // The step is coarse: its error may be reported, and nothing else.
    assert!(reported.iter().all(|kind| *kind == "step"), "{:?}", fit.doubts);
}

#[test]
fn residuals_above_their_deviation_are_reported() {
    let desk = desk(&record(SCENARIO, 7, 4.0));
    let fit = fitted(desk.path(), FIT).expect("a fit");
    assert!(kinds(&fit).contains(&"residuals"), "{:?}", fit.doubts);
    assert!(fit.reduced_chi_square > 10.0, "{}", fit.reduced_chi_square);
    let unknown = FIT.replace("sigma = \"30 N\"\n", "").replace("sigma = \"20 um\"\n", "");
    let fit = fitted(desk.path(), &unknown).expect("a fit");
    assert!(fit.sigma_unknown && !kinds(&fit).contains(&"residuals"));
}

#[test]
fn parameters_that_cannot_be_distinguished_are_named() {
    let desk = desk(&record(SCENARIO, 7, 1.0));
    // Area and inertia of the bar are what the run knows of: width and density of it act as one, but for the stiffness.
    let more = "[parameter.young]\npath = \"material.aluminium.young\"\n[parameter.width]\npath = \"section.bar.width\"\n\
                [parameter.density]\npath = \"material.aluminium.density\"\n[test.drop]";
    let text = FIT.replace("[test.drop]", more);
    let fit = fitted(desk.path(), &text).expect("a fit");
    assert!(kinds(&fit).contains(&"correlation"), "{:?}", fit.doubts);
    assert!(parameter(&fit, "width").stderr > 0.01 * parameter(&fit, "width").value);
}

#[test]
fn a_parameter_without_influence_is_to_be_fixed() {
    let desk = desk(&record(SCENARIO, 7, 1.0));
    // Of a test that is only compared.
    let more = "[parameter.mass]\npath = \"projectile.hammer.mass\"\ntests = [\"second\"]\n[test.second]\ndata = \"drop.csv\"\n\
                time = \"t\"\nalign = \"onset\"\nhold_out = true\n[test.second.channel.F]\ncolumn = \"contact.hammer.force\"\nsigma = \"30 N\"\n";
    let fit = fitted(desk.path(), &format!("{FIT}{more}")).expect("a fit");
    let mass = parameter(&fit, "mass");
    assert!(mass.stderr.is_infinite() && (mass.value - mass.start).abs() < 1e-9, "{mass:?}");
    let named = |text: &str| fit.doubts.iter().any(|doubt| doubt.text.contains(text));
    assert!(named("the data do not determine `mass`: fix it,"), "{:?}", fit.doubts);
    assert!(parameter(&fit, "stiffness").stderr.is_finite());
}

#[test]
fn a_value_in_wide_bounds_is_at_its_bound_only_within_its_standard_error() {
    let desk = desk(&record(SCENARIO, 7, 1.0));
    // 0.2 s/m lies at a share of 2e-4 of these bounds, and many standard errors above their lower end.
    let wide = FIT.replace("bounds = [0, \"1 s/m\"]", "bounds = [0, \"1e3 s/m\"]");
    let fit = fitted(desk.path(), &wide).expect("a fit");
    assert!(!kinds(&fit).contains(&"bound"), "{:?}", fit.doubts);
    let tight = FIT.replace("bounds = [0, \"1 s/m\"]", "bounds = [0, \"0.15 s/m\"]");
    let fit = fitted(desk.path(), &tight).expect("a fit");
    assert!(kinds(&fit).contains(&"bound"), "{:?}", fit.doubts);
}

#[test]
fn a_coarse_step_is_reported_where_the_record_is_better() {
    let desk = desk(&record(SCENARIO, 7, 0.01));
    let precise = FIT.replace("30 N", "0.3 N").replace("20 um", "0.2 um");
    let fit = fitted(desk.path(), &precise).expect("a fit");
    assert!(kinds(&fit).contains(&"step"), "{:?}", fit.doubts);
}

#[test]
fn starting_points_lie_in_the_bounds_and_are_the_same_each_time() {
    let desk = desk(&record(SCENARIO, 7, 1.0));
    let text = FIT.replace("[fit]", "[fit]\nstarts = 5\nseed = 3");
    let problem = problem(desk.path(), &text).expect("a problem");
    let starts = problem.starts();
    assert_eq!(starts.len(), 5);
    assert_eq!(starts, problem.starts());
    for start in &starts {
        let within =
            start.iter().zip(problem.bounds()).all(|(z, [low, high])| *z >= low && *z <= high);
        assert!(within, "{start:?}");
    }
    let fit = fitted(desk.path(), &text).expect("a fit");
    assert_eq!(fit.minima.len(), 5);
    let best = fit.minima.iter().map(|one| one.cost).fold(f64::INFINITY, f64::min);
    assert!((fit.cost - best).abs() < 1e-12);
}

#[test]
fn a_profile_has_its_least_cost_at_the_minimum() {
    let desk = desk(&record(SCENARIO, 7, 1.0));
    let problem = problem(desk.path(), FIT).expect("a problem");
    let minima = problem.minima(&|| true).expect("minima");
    let fit = problem.diagnose(minima, &|| true).expect("a fit");
    let profile =
        problem.profile(&fit, "stiffness", 4, &|| true).expect("runs").expect("a profile");
    assert_eq!(profile.values.len(), 9);
    assert!(profile.values.windows(2).all(|pair| pair[0] < pair[1]));
    assert!(profile.costs.iter().all(|cost| *cost >= fit.cost - 1e-6), "{:?}", profile.costs);
    let found = parameter(&fit, "stiffness");
    for (end, expected) in profile.interval.iter().zip(found.interval) {
        // Nearly linear within the interval: the profile agrees with the standard error to a tenth of it.
        assert!(
            (end - expected).abs() < 0.1 * (found.interval[1] - found.interval[0]),
            "{end} {expected}"
        );
    }
    assert!(problem.profile(&fit, "nothing", 4, &|| true).expect("no runs").is_none());
}

#[test]
fn a_profile_reaches_up_to_a_bound() {
    let desk = desk(&record(SCENARIO, 7, 1.0));
    // 2 MN/m made the record.
    let tight = FIT.replace("\"8 MN/m\"]", "\"1.9 MN/m\"]");
    let problem = problem(desk.path(), &tight).expect("a problem");
    let minima = problem.minima(&|| true).expect("minima");
    let mut fit = problem.diagnose(minima, &|| true).expect("a fit");
    let profile =
        problem.profile(&fit, "stiffness", 2, &|| true).expect("runs").expect("a profile");
    let last = profile.values.last().expect("values");
    assert!((last / 1.9e6 - 1.0).abs() < 1e-4, "{:?}", profile.values);
    assert!(profile.interval[0] < 1.9e6 && profile.interval[1].is_nan(), "{:?}", profile.interval);
    // What leads to a lower cost is a warning.
    let lower =
        percuss_fit::Profile { costs: vec![0.5 * fit.cost; profile.costs.len()], ..profile };
    fit.add(lower);
    assert_eq!(fit.profiles.len(), 1);
    assert_eq!(fit.doubts.last().map(|doubt| doubt.kind.name()), Some("minima"));
}

#[test]
fn derivatives_that_are_required_and_not_known_leave_no_minimum() {
    let desk = desk(&record(SCENARIO, 7, 1.0));
    let text = FIT.replace("[fit]", "[fit]\njacobian = \"exact\"").replace("\"fit\"", "\"onset\"");
    let error = fitted(desk.path(), &text).expect_err("no derivatives");
    let percuss_fit::FitError::Run(code, why) = error else { panic!("{error:?}") };
    assert!(matches!(code, percuss_codes::AnalysisCode::NoFit), "{code:?}");
    assert!(why.starts_with("the iteration fails: ") && why.contains("by their onset"), "{why}");
}

/// A ball on the floor: its restitution moves every later impact, so that the cost of a late part of the record has many minima.
const BALL: &str = r#"
[projectile.ball]
kind = "rigid"
contact = "surface"
mass = 1
radius = "1 cm"
position = [0, "51 cm"]
velocity = [0, 0]
restitution = 0.8
strikes = "floor"
[obstacle.floor]
kind = "half-plane"
point = [0, 0]
normal = [0, 1]
[load.weight]
kind = "gravity"
acceleration = [0, -9.81]
[time]
end = "2 s"
step = "5 ms"
"#;

#[test]
fn many_minima_are_reported_with_the_starting_points_that_reach_the_best() {
    let run = history(BALL);
    let (time, height) = (run.column("time"), run.column("projectile.ball.position_2"));
    let (time, height) = (time.expect("times"), height.expect("heights"));
    let mut noise = Noise::new(3);
    let mut text = "t [s],y [m]\n".to_owned();
    for k in 0..40 {
        let t = 1.2 + 0.02 * f64::from(k);
        let next = time.partition_point(|row| *row <= t).clamp(1, time.len() - 1);
        let share = (t - time[next - 1]) / (time[next] - time[next - 1]);
        let y = height[next - 1] + share * (height[next] - height[next - 1]);
        writeln!(text, "{t:?},{:?}", y + 0.1 * noise.next()).expect("a String");
    }
    let desk = tempfile::tempdir().expect("a folder");
    put(desk.path(), "ball.toml", BALL);
    put(desk.path(), "ball.csv", &text);
    let fit = "base = \"ball.toml\"\n[fit]\nstarts = 12\n[parameter.e]\npath = \"projectile.ball.restitution\"\nstart = 0.7\n\
               bounds = [0.5, 0.97]\n[test.late]\ndata = \"ball.csv\"\ntime = \"t\"\n[test.late.channel.y]\n\
               column = \"projectile.ball.position_2\"\nsigma = \"10 cm\"\n";
    let fit = fitted(desk.path(), fit).expect("a fit");
    // SciPy finds 0.8018 with a cost of 17.22, and 0.742 with 23.48.
    assert!((parameter(&fit, "e").value - 0.8018).abs() < 2e-3, "{}", parameter(&fit, "e").value);
    let doubt = fit.doubts.iter().find(|doubt| doubt.kind.name() == "minima").expect("minima");
    assert!(doubt.text.contains("of 12 starting points reach the best minimum"), "{}", doubt.text);
    // One starting point far from it finds another, and cannot know.
    let costs: Vec<f64> = fit.minima.iter().map(|one| one.cost).collect();
    assert!(costs.iter().any(|cost| *cost > 1.2 * fit.cost), "{costs:?}");
}
