//! Bad input is reported with its place, what was found and what would be right.

use percuss_fit::{FitError, Problem, Supplied};
use percuss_scenario::fit::{Record, RecordColumn};
use percuss_scenario::{FileAccess, FitFile};

use crate::common::{FIT, SCENARIO, desk, problem, put, record};

fn reported(text: &str) -> String {
    reported_with(SCENARIO, text)
}

/// The same with another scenario.
fn reported_with(scenario: &str, text: &str) -> String {
    let desk = desk(&record(scenario, 0, 1.0));
    put(desk.path(), "drop.toml", scenario);
    match problem(desk.path(), text) {
        Err(FitError::Faults(faults)) => {
            faults.all().iter().map(|one| format!("{one}\n")).collect()
        }
        Err(error) => panic!("{error:?}"),
        Ok(_) => panic!("no fault in {text}"),
    }
}

/// Changes of the file, and what is reported of each: `from | to | place | found`, with `; ` between lines.
const FAULTS: &str = r#"
path = "projectile.hammer.stiffness" | path = "projectile.hammer.stifness" | parameter.stiffness.path | stifness
start = "1.5 MN/m" | start = "15 kg" | parameter.stiffness.start | a mass
start = "1.5 MN/m" | start = "15 MN/m" | parameter.stiffness.start | outside the bounds
start = "1.5 MN/m"; bounds = ["0.5 MN/m", "8 MN/m"]; spacing = "log" | start = "-1 MN/m" | parameter.stiffness.start | found -1000000 N/m, expected a stiffness above zero
path = "projectile.hammer.stiffness"; start = "1.5 MN/m"; bounds = ["0.5 MN/m", "8 MN/m"]; spacing = "log" | path = "material.aluminium.young"; start = 0 | parameter.stiffness.start | expected a Young's modulus above zero
["0.5 MN/m", "8 MN/m"] | ["8 MN/m", "0.5 MN/m"] | parameter.stiffness.bounds | from
bounds = [0, "1 s/m"] | bounds = [0, "1 s/m"]; spacing = "log" | parameter.dissipation.spacing | above zero
data = "drop.csv" | data = "drip.csv" | test.drop.data | where there is no file
time = "t" | time = "tt" | test.drop.time | no column of the record
contact.hammer.force | contact.hamer.force | test.drop.channel.F.column | contact.hammer.force
sigma = "30 N" | sigma = "30 m" | test.drop.channel.F.sigma | a length
sigma = "30 N" | sigma = 0 | test.drop.channel.F.sigma | above zero
sigma = "30 N" |  | test.drop.channel.F.sigma | every channel
sigma = "30 N" | sigma = "30 N"; cfc = 700 | test.drop.channel.F.cfc | 60, 180, 600 or 1000
sigma = "30 N" | sigma = "30 N"; cfc = 1000 | test.drop.channel.F.cfc | samples per second, where CFC 1000
[fit] | [fit]; loss = "quadratic" | fit.loss | soft_l1
align = "fit" | align = "fit"; hold_out = true | test | hold_out
align = "fit" | align = "none"; from = "1 s" | test.drop.data | of which 0 times
align = "fit" | align = "none"; set = ["projectile.hammer.mass"] | test.drop.set | without `=`
align = "fit" | align = "none"; set = ["projectile.hammer.mas=3"] | test.drop.set | `mas`
[fit] | [fit]; starts = 0 | fit.starts | 0
[fit] | [fit]; starts = 100000000000 | fit.starts | from 1 to 100000
[fit] | [fit]; iterations = 0 | fit.iterations | 0
path = "projectile.hammer.stiffness"; start = "1.5 MN/m"; bounds = ["0.5 MN/m", "8 MN/m"]; spacing = "log" | path = "beam.bar.elements" | parameter.stiffness.path | a setting of the computation
path = "projectile.hammer.stiffness"; start = "1.5 MN/m"; bounds = ["0.5 MN/m", "8 MN/m"]; spacing = "log" | path = "time.step" | parameter.stiffness.path | a setting of the computation
path = "projectile.hammer.stiffness"; start = "1.5 MN/m"; bounds = ["0.5 MN/m", "8 MN/m"]; spacing = "log" | path = "time.end" | parameter.stiffness.path | a setting of the computation
path = "projectile.hammer.stiffness" | paths = ["projectile.hammer.stiffness", "projectile.hammer.mass"] | parameter.stiffness.paths | (kg)
path = "projectile.hammer.stiffness" | paths = ["projectile.hammer.stiffness", "projectile.hammer.stiffness"] | parameter.stiffness.paths | twice
spacing = "log" | tests = [] | parameter.stiffness.tests | an empty list
sigma = "30 N" | sigma = "30 N"; factor = 0 | test.drop.channel.F.factor | 0
align = "fit" | align = "fit"; from = "3 ms"; to = "2 ms" | test.drop.to | a window from
align = "fit" | align = "none"; offset = "1 s" | test.drop.data | of which 0 times lie within the run
align = "fit" | align = "none"; offset_bounds = [0, 1] | test.drop.offset_bounds | no effect
align = "fit" | align = "onset"; offset = 0 | test.drop.offset | no effect
"#;

#[test]
fn each_fault_names_its_place() {
    for row in FAULTS.trim().lines() {
        let parts: Vec<String> = row.split(" | ").map(|part| part.replace("; ", "\n")).collect();
        let [from, to, place, found] = parts.as_slice() else { panic!("{row}") };
        assert!(FIT.contains(from.as_str()), "{from}");
        let reported = reported(&FIT.replacen(from.as_str(), to, 1));
        let named = reported.contains(&format!("{place}: ")) && reported.contains(found.as_str());
        assert!(named, "{to}: {reported}");
    }
}

#[test]
fn a_count_and_the_size_of_elements_are_no_parameters() {
    let given = "start = \"1.5 MN/m\"\nbounds = [\"0.5 MN/m\", \"8 MN/m\"]\nspacing = \"log\"\n";
    assert!(FIT.contains(given));
    let of = |path: &str| FIT.replace(given, "").replace("projectile.hammer.stiffness", path);
    let damped = format!("{SCENARIO}[damping]\nmodal = 0.01\nmodes = 3\n");
    let reported = reported_with(&damped, &of("damping.modes"));
    assert!(reported.contains("parameter.stiffness.path: found `damping.modes`, a whole number"));
    let sized = SCENARIO.replace("elements = 4", "element_length = \"0.2 m\"");
    let reported = reported_with(&sized, &of("beam.bar.element_length"));
    assert!(reported.contains("`beam.bar.element_length`, a setting of the computation"));
}

#[test]
fn starting_points_need_bounds_and_a_number_is_set_once() {
    let no_bounds =
        FIT.replace("bounds = [0, \"1 s/m\"]\n", "").replace("[fit]", "[fit]\nstarts = 4");
    assert!(
        reported(&no_bounds)
            .contains("parameter.dissipation.bounds: found no bounds with 4 starting points")
    );
    let twice = FIT
        .replace("projectile.hammer.dissipation", "projectile.hammer.stiffness")
        .replace("start = \"0.1 s/m\"\nbounds = [0, \"1 s/m\"]", "start = \"1 MN/m\"");
    assert!(reported(&twice).contains("which another parameter sets too"));
    // Two ways to write one place.
    let component = FIT
        .replace("projectile.hammer.stiffness", "projectile.hammer.velocity[1]")
        .replace("projectile.hammer.dissipation", "projectile.hammer.velocity.1")
        .replace("start = \"1.5 MN/m\"\nbounds = [\"0.5 MN/m\", \"8 MN/m\"]\nspacing = \"log\"", "")
        .replace("start = \"0.1 s/m\"\nbounds = [0, \"1 s/m\"]", "");
    assert!(reported(&component).contains("which another parameter sets too"));
}

#[test]
fn standard_deviations_are_known_in_all_tests_or_in_none() {
    let second = "[test.second]\ndata = \"drop.csv\"\ntime = \"t\"\nalign = \"onset\"\n\
                  [test.second.channel.F]\ncolumn = \"contact.hammer.force\"\n";
    for hold_out in ["", "hold_out = true\n"] {
        let mixed = format!(
            "{FIT}{}",
            second.replace("[test.second.", &format!("{hold_out}[test.second."))
        );
        let reported = reported(&mixed);
        assert_eq!(reported.lines().count(), 1, "{reported}");
        assert!(
            reported.contains("test.second.channel.F.sigma: ")
                && reported.contains("every channel of all tests"),
            "{reported}"
        );
    }
}

#[test]
fn what_follows_from_another_fault_is_not_reported_besides() {
    let window = FIT.replace("align = \"fit\"", "align = \"none\"\nfrom = \"1 s\"");
    assert_eq!(reported(&window).lines().count(), 1, "{}", reported(&window));
    let no_path = FIT.replace("path = \"projectile.hammer.stiffness\"\n", "");
    assert_eq!(reported(&no_path).lines().count(), 1, "{}", reported(&no_path));
}

#[test]
fn files_outside_the_folder_are_not_read() {
    let reported = reported(&FIT.replace("drop.csv", "../drop.csv"));
    assert!(reported.contains("outside the folder"), "{reported}");
}

#[test]
fn columns_of_a_program_have_a_finite_number_a_row() {
    let desk = desk(&record(SCENARIO, 0, 1.0));
    let name = desk.path().join("fit.toml").display().to_string();
    let file = FitFile::read_with(FIT, &name, FileAccess::OwnFolder).expect("a file");
    let supplied = |time: &[f64], force: &[f64]| {
        let column = |header, values: &[f64]| RecordColumn::new(header, values.to_vec());
        let columns =
            vec![column("t [ms]", time), column("F [kN]", force), column("u [mm]", &[0.0; 4])];
        let records = [("drop".to_owned(), Record { columns })].into();
        Supplied { records, ..Supplied::default() }
    };
    let times = [0.0, 1.0, 2.0, 3.0];
    for (supplied, fault) in [
        (
            supplied(&times, &[0.0, f64::NAN, 0.0, 1.0]),
            "channel.F.data: found NaN in row 2 of `F [kN]`",
        ),
        (supplied(&times, &[0.0; 3]), "channel.F.data: found 3 values of `F` beside 4 times"),
        (
            supplied(&[0.0, f64::INFINITY, 2.0, 3.0], &[0.0; 4]),
            "time: found inf in row 2 of `t [ms]`",
        ),
    ] {
        let Err(FitError::Faults(faults)) = Problem::new(&file, &supplied, 0, &|| true) else {
            panic!("no fault: {fault}")
        };
        assert!(faults.to_string().contains(&format!("test.drop.{fault}")), "{faults}");
    }
}

/// An accelerometer on shaken ground measures the absolute acceleration, not that relative to the ground.
#[test]
fn accelerations_relative_to_a_shaken_base_are_not_compared() {
    let base = "\n[load.quake]\nkind = \"base\"\nacceleration = [\"1 m/s^2\", 0]\n[record]\npoints = [\"bar.mid\"]\n";
    let scenario = format!("{SCENARIO}{base}");
    let text = FIT.replace("contact.hammer.force", "point.bar.mid.acceleration_1");
    let faults = reported_with(&scenario, &text);
    assert!(faults.contains("relative to the accelerated base"), "{faults}");
    assert!(faults.contains("`point.bar.mid.absolute_acceleration_1`"), "{faults}");
}
