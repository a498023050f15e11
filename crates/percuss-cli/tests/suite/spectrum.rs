//! `percuss spectrum`: shock response spectra of accelerations of a finished run.

use crate::common;

use common::Desk;

/// A run with steps short enough for every class, and an acceleration of it.
fn desk() -> (Desk, String) {
    let desk = Desk::new();
    let run = ["run", "elastic.toml", "--out", "hit", "--no-report", "-q"];
    desk.percuss(&run).ends_with(0);
    let asked = desk.percuss(&["spectrum", "hit", "none"]);
    asked.ends_with(2).tells("E320");
    let text = asked.stderr.clone();
    let column = text.split('`').find(|word| word.contains(".acceleration_2"));
    let column = column.expect("an acceleration is named").to_owned();
    (desk, column)
}

#[test]
fn a_spectrum_is_written_and_told_and_foreign_files_stay() {
    let (desk, column) = desk();
    let arguments = ["spectrum", "hit", column.as_str(), "--from", "50Hz", "--to", "500Hz"];
    let arguments = [&arguments[..], &["--cfc", "60", "--out", "srs.csv"]].concat();
    let told = desk.percuss(&arguments);
    told.ends_with(0);
    assert!(told.stdout.contains("(CFC 60)"), "{}", told.stdout);
    let table = std::fs::read_to_string(desk.path("srs.csv")).unwrap();
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
    desk.percuss(&arguments).ends_with(0);
    std::fs::write(desk.path("srs.csv"), "mine").unwrap();
    desk.percuss(&arguments).ends_with(2).tells("--force");
    assert_eq!(std::fs::read_to_string(desk.path("srs.csv")).unwrap(), "mine");
}

#[test]
fn what_cannot_be_judged_is_refused_with_what_would_do() {
    let (desk, column) = desk();
    let velocity = column.replace("acceleration", "velocity");
    desk.percuss(&["spectrum", "hit", &velocity]).ends_with(2).tells("is no acceleration");
    // It moves along e2 alone.
    let aside = column.replace("acceleration_2", "acceleration_1");
    desk.percuss(&["spectrum", "hit", &aside]).ends_with(2).tells("zero throughout");
    desk.percuss(&["spectrum", "hit", &column, "--to", "1e12"])
        .ends_with(2)
        .tells("samples a second");
    desk.percuss(&["spectrum", "hit", &column, "--damping", "1"]).ends_with(2).tells("0.05");
    desk.percuss(&["spectrum", "hit", &column, "--cfc", "100"]).ends_with(2).tells("60, 180");
}
