//! `percuss spectrum`: shock response spectra of accelerations of a finished run.

use crate::common;

use common::Sandbox;

/// A run with steps short enough for every class, and an acceleration of it.
fn sandbox() -> (Sandbox, String) {
    let sandbox = Sandbox::new();
    let run = ["run", "elastic.toml", "--out", "hit", "--no-report", "-q"];
    sandbox.percuss(&run).ends_with(0);
    let asked = sandbox.percuss(&["spectrum", "hit", "none"]);
    asked.ends_with(2).tells("E320");
    let text = asked.stderr.clone();
    let column = text.split('`').find(|word| word.contains(".acceleration_2"));
    let column = column.expect("an acceleration is named").to_owned();
    (sandbox, column)
}

#[test]
fn a_spectrum_is_written_and_reported_and_foreign_files_stay() {
    let (sandbox, column) = sandbox();
    let arguments = ["spectrum", "hit", column.as_str(), "--from", "50Hz", "--to", "500Hz"];
    let arguments = [&arguments[..], &["--cfc", "60", "--out", "srs.csv"]].concat();
    let reported = sandbox.percuss(&arguments);
    reported.ends_with(0);
    assert!(reported.stdout.contains("(CFC 60)"), "{}", reported.stdout);
    let table = std::fs::read_to_string(sandbox.path("srs.csv")).unwrap();
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    assert_eq!((rows[0][0], rows[0].len()), (50.0, 10));
    // The maximax is the larger of the two, and the pseudo-velocity the displacement times the angular frequency.
    for row in &rows {
        assert!(row[3] == row[1].max(row[2]) && row[3] > 0.0, "{row:?}");
        let scaled = 2.0 * std::f64::consts::PI * row[0] * row[9];
        assert!((row[6] - scaled).abs() <= 1e-12 * scaled, "{row:?}");
    }
    // Its own files are replaced, those of others are not.
    sandbox.percuss(&arguments).ends_with(0);
    std::fs::write(sandbox.path("srs.csv"), "mine").unwrap();
    sandbox.percuss(&arguments).ends_with(2).tells("--force");
    assert_eq!(std::fs::read_to_string(sandbox.path("srs.csv")).unwrap(), "mine");
}

#[test]
fn results_that_cannot_be_judged_are_refused_with_a_cure() {
    let (sandbox, column) = sandbox();
    let velocity = column.replace("acceleration", "velocity");
    sandbox.percuss(&["spectrum", "hit", &velocity]).ends_with(2).tells("is no acceleration");
    // It moves along e2 alone.
    let aside = column.replace("acceleration_2", "acceleration_1");
    sandbox.percuss(&["spectrum", "hit", &aside]).ends_with(2).tells("the acceleration is zero");
    sandbox
        .percuss(&["spectrum", "hit", &column, "--to", "1e12"])
        .ends_with(2)
        .tells("samples per second");
    sandbox.percuss(&["spectrum", "hit", &column, "--damping", "1"]).ends_with(2).tells("0.05");
    sandbox.percuss(&["spectrum", "hit", &column, "--cfc", "100"]).ends_with(2).tells("60, 180");
}

#[test]
fn accelerations_are_drawn_in_a_class_and_a_rigid_impact_keeps_its_change_of_velocity() {
    let sandbox = Sandbox::new();
    sandbox.percuss(&["run", "rigid.toml", "--out", "blow", "--no-report", "-q"]).ends_with(0);
    let listed = sandbox.percuss(&["plot", "blow", "--list", "--cfc", "60"]);
    listed.ends_with(0);
    let figure = listed.stdout.split_whitespace().find(|word| word.starts_with("acceleration-"));
    let figure = figure.expect("a figure of an acceleration").to_owned();
    let plain = sandbox.percuss(&["plot", "blow", "--list"]);
    assert!(!plain.stdout.contains("acceleration-"), "{}", plain.stdout);
    let draw =
        ["plot", "blow", "--cfc", "60", "--figure", &figure, "--format", "svg", "--out", "."];
    sandbox.percuss(&draw).ends_with(0);
    let drawn = std::fs::read_to_string(sandbox.path(&format!("{figure}.svg"))).unwrap();
    assert!(drawn.contains("<path"), "an empty picture");

    // Rows are not evenly spaced about an impact, which is said.
    let projectile = figure.trim_start_matches("acceleration-");
    let column = format!("projectile.{projectile}.acceleration_2");
    let asked = ["spectrum", "blow", &column, "--to", "500", "--damping", "0", "--out", "blow.csv"];
    let reported = sandbox.percuss(&asked);
    reported.ends_with(0);
    assert!(reported.stdout.contains("non-uniform output interval"), "{}", reported.stdout);
    // The slowest oscillator stays where it was on its way: what it moves relative to the base is what impacts move the base.
    let table = std::fs::read_to_string(sandbox.path("blow.csv")).unwrap();
    let slowest: Vec<f64> =
        table.lines().nth(1).unwrap().split(',').map(|x| x.parse().unwrap()).collect();
    let history = percuss_output::read_history(sandbox.path("blow")).unwrap();
    let time = history.column("time").unwrap();
    let velocity = history.column(&column.replace("acceleration", "velocity")).unwrap();
    let (mut moved, mut most) = (0.0, 0.0_f64);
    for (t, v) in time.windows(2).zip(velocity.windows(2)) {
        moved += (0.5 * (v[0] + v[1]) - velocity[0]) * (t[1] - t[0]);
        most = most.max(f64::abs(moved));
    }
    // It swings by (2 pi 0.02)^2 / 12 and less of that in the 0.02 s of the run.
    assert!(most > 0.1 && (slowest[7] / most - 1.0).abs() < 5e-3, "{} {most}", slowest[7]);
}

/// A stiff post on ground that shakes with 4 m/s^2 at 3 Hz: what stands on it feels the ground.
const POST: &str = r#"
[material.m]
young = "200 GPa"
density = "7850 kg/m^3"
retardation = "1e-5 s"
[section.s]
shape = "rectangle"
width = "0.2 m"
depth = "0.2 m"
[beam.b]
points = [[0, 0], [0, "0.5 m"]]
elements = 2
material = "m"
section = "s"
[support.l]
at = "b.start"
kind = "clamp"
[load.quake]
kind = "base"
acceleration = ["4 m/s^2", 0]
function = { kind = "harmonic", frequency = "3 Hz" }
[record]
points = ["b.end"]
[time]
end = "4 s"
step = "1 ms"
"#;

#[test]
fn a_floor_spectrum_is_that_of_the_absolute_acceleration() {
    let sandbox = Sandbox::new();
    sandbox.put("post.toml", POST);
    sandbox.percuss(&["run", "post.toml", "--out", "post", "--no-report", "-q"]).ends_with(0);
    let band = ["--from", "1Hz", "--to", "20Hz", "--out", "floor.csv"];
    let of = |column: &str| sandbox.percuss(&[&["spectrum", "post", column], &band[..]].concat());
    of("point.b.end.acceleration_1")
        .ends_with(2)
        .tells("`point.b.end.absolute_acceleration_1` [E320]");
    of("point.b.end.absolute_acceleration_1").ends_with(0);
    let table = std::fs::read_to_string(sandbox.path("floor.csv")).unwrap();
    let rows = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|x| x.parse().unwrap()).collect::<Vec<f64>>());
    // At resonance a/(2 zeta) = 40 m/s^2 of 4, less what 12 periods leave out.
    let largest = rows.max_by(|a, b| a[3].total_cmp(&b[3])).expect("rows");
    assert!((largest[0] - 3.0).abs() < 0.1 && (36.0..41.0).contains(&largest[3]), "{largest:?}");
}
