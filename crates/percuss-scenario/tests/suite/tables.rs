//! Tables of numbers in files of their own: short ones are written out, long ones named with their checksum.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use percuss_scenario::{FileAccess, load, load_whole, load_with};
use sha2::{Digest, Sha256};

const ELASTIC: &str = include_str!("../files/elastic.toml");

/// A scenario in `folder/of.toml` whose load follows a table; `more` stands beside the name of its file.
fn pulled(folder: &Path, file: &str, more: &str) -> std::path::PathBuf {
    let path = folder.join("of.toml");
    let load = format!(
        "\n[load.pull]\nkind = \"point\"\nat = \"girder.end\"\nforce = [0, 1]\nfunction = {{ kind = \"table\", file = \"{file}\"{more} }}\n"
    );
    fs::write(&path, format!("{ELASTIC}{load}")).unwrap();
    path
}

/// A table of so many rows.
fn rows(count: usize) -> String {
    (0..count).fold(String::new(), |mut text, k| {
        let _ = writeln!(text, "{k}e-3, {}", k % 7);
        text
    })
}

fn sum(text: &str) -> String {
    Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn a_table_of_a_thousand_rows_is_written_out_and_a_longer_one_named() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("pull.csv");
    for (count, named) in [(1000, false), (1001, true)] {
        fs::write(&file, rows(count)).unwrap();
        let scenario = load(pulled(folder.path(), "pull.csv", "")).unwrap();
        let written = scenario.to_toml();
        let line = format!(
            "file = \"{}\", sha256 = \"{}\"",
            file.canonicalize().unwrap().display(),
            sum(&rows(count))
        );
        assert_eq!(written.contains(&line), named, "{line}\n{written}");
        assert_eq!(written.contains("times = [0, 0.001"), !named);
        // Who sends it elsewhere gets the rows whatever their number.
        let whole = load_whole(folder.path().join("of.toml"), FileAccess::OwnFolder).unwrap();
        assert!(whole.to_toml().contains("times = [0, 0.001"));
    }
}

#[test]
fn written_tables_read_back_the_same_from_anywhere() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("pull.csv"), rows(3000)).unwrap();
    let scenario = load(pulled(folder.path(), "pull.csv", "")).unwrap();
    let other = tempfile::tempdir().unwrap();
    let echo = other.path().join("scenario.toml");
    fs::write(&echo, scenario.to_toml()).unwrap();
    // The checksum shows that whoever wrote it knows the file, so that it may lie outside.
    let again = load(&echo).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(again.content(), scenario.content());
    assert_eq!(again.to_toml(), scenario.to_toml());
    let (a, b) = (again.compile().unwrap(), scenario.compile().unwrap());
    assert_eq!(format!("{:?}", a.model), format!("{:?}", b.model));
    let function = &scenario.content().load[0].table.function;
    assert_eq!(function.columns().map(|both| both.map(<[f64]>::len)), Some([3000, 3000]));
}

#[test]
fn a_file_that_changed_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("pull.csv");
    fs::write(&file, rows(1500)).unwrap();
    let echo = folder.path().join("echo.toml");
    fs::write(&echo, load(pulled(folder.path(), "pull.csv", "")).unwrap().to_toml()).unwrap();
    let (before, after) = (sum(&rows(1500)), sum(&rows(1501)));
    fs::write(&file, rows(1501)).unwrap();
    let reported = load(&echo).unwrap_err().coded();
    assert!(reported.ends_with("[E023]") && reported.contains(&before), "{reported}");
    // An absolute path counts as outside, of which nothing more is reported; allowed or within, the other sum is.
    assert!(!reported.contains(&after), "{reported}");
    let reported = load_with(&echo, FileAccess::Anywhere).unwrap_err().coded();
    assert!(reported.contains(&format!("which has changed: its SHA-256 is {after}")), "{reported}");
    let more = format!(", sha256 = \"{before}\"");
    let reported = load(pulled(folder.path(), "pull.csv", &more)).unwrap_err().coded();
    assert!(reported.contains("which has changed") && reported.contains("[E023]"), "{reported}");
    fs::remove_file(&file).unwrap();
    let reported = load(&echo).unwrap_err().coded();
    assert!(reported.contains("is not there with the content that `sha256` says"), "{reported}");
}

#[test]
fn a_checksum_stands_beside_a_file_and_is_one() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("pull.csv"), rows(5)).unwrap();
    let (right, short) = (sum(&rows(5)).to_uppercase(), "abc");
    load(pulled(folder.path(), "pull.csv", &format!(", sha256 = \"{right}\""))).unwrap();
    let wrong = load(pulled(folder.path(), "pull.csv", &format!(", sha256 = \"{short}\"")));
    let reported = wrong.unwrap_err().coded();
    assert!(
        reported.contains("found the text \"abc\", expected the SHA-256 of the file"),
        "{reported}"
    );
    let text = format!(
        "{ELASTIC}\n[load.pull]\nkind = \"point\"\nat = \"girder.end\"\nforce = [0, 1]\n\
         function = {{ kind = \"table\", times = [0, 1], values = [0, 1], sha256 = \"{right}\" }}\n"
    );
    let reported = percuss_scenario::read(&text, "f.toml").unwrap_err().coded();
    assert!(reported.contains("found `sha256` without `file`"), "{reported}");
}

/// A header that names units is heeded; one that does not, or names others, is refused.
#[test]
fn headers_of_tables_say_in_which_units_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let read = |text: &str| {
        fs::write(folder.path().join("pull.csv"), text).unwrap();
        load(pulled(folder.path(), "pull.csv", ""))
    };
    let times = |text: &str| {
        let scenario = read(text).unwrap_or_else(|faults| panic!("{faults}"));
        let function = &scenario.content().load[0].table.function;
        let [times, _] = function.columns().unwrap();
        times.to_vec()
    };
    assert_eq!(times("ms, factor\n0, 0\n20, 1\n"), [0.0, 0.02]);
    assert_eq!(times("time [us]; value [-]\n0; 0\n20; 1\n"), [0.0, 20e-6]);
    assert_eq!(times("time (s), factor\n0, 0\n20, 1\n"), [0.0, 20.0]);
    assert_eq!(times("0, 0\n20, 1\n"), [0.0, 20.0]);
    let reported = read("ms,g\n0, 0\n20, 1\n").unwrap_err().coded();
    assert!(
        reported.contains("a header in \"g\", which is a mass (kg), in line 1 of \"pull.csv\""),
        "{reported}"
    );
    let reported = read("frame,acc\n0, 0\n20, 1\n").unwrap_err().coded();
    assert!(reported.contains("a header without a unit that is known in line 1"), "{reported}");
    assert!(
        reported.contains("or is one of `t`, `time`, `times` and one of `value`, "),
        "{reported}"
    );
}

/// The file of a base load may hold accelerations: those of its header's unit, times a direction. Other functions of time are factors.
#[test]
fn files_of_base_loads_hold_factors_or_accelerations() {
    let folder = tempfile::tempdir().unwrap();
    let load_of = |header: &str, keys: &str| {
        let rows = format!("{header}\n0, 0\n1, 0.5\n");
        fs::write(folder.path().join("record.csv"), rows).unwrap();
        let function = "function = { kind = \"table\", file = \"record.csv\" }";
        let path = folder.path().join("f.toml");
        fs::write(&path, format!("{ELASTIC}\n[load.quake]\n{keys}\n{function}\n")).unwrap();
        load(path)
    };
    let peak = |header: &str, acceleration: &str| {
        let keys = format!("kind = \"base\"\nacceleration = {acceleration}");
        let scenario = load_of(header, &keys).unwrap_or_else(|faults| panic!("{faults}"));
        scenario.content().load[0].table.function.columns().unwrap()[1][1]
    };
    assert_eq!(peak("time (s),acceleration (m/s^2)", "[1, 0]"), 0.5);
    assert_eq!(peak("time (s),acceleration (mm/s^2)", "[0.6, -0.8]"), 0.5e-3);
    assert_eq!(peak("time (s),acceleration (g)", "[1, 0]"), 0.5 * 9.80665);
    assert_eq!(peak("time,acceleration", "[0, 1]"), 0.5);
    assert_eq!(peak("time (s),factor", "[\"9.81 m/s^2\", 0]"), 0.5);
    let reported = |header: &str, keys: &str| load_of(header, keys).unwrap_err().coded();
    let twice = reported("t,acceleration (g)", "kind = \"base\"\nacceleration = [9.81, 0]");
    let expected = "load.quake.acceleration: found 9.81 m/s^2 times a file that holds accelerations by its header, expected a direction of \
                    magnitude 1 m/s^2";
    assert!(twice.contains(expected), "{twice}");
    // Set in place, as a study does, it is the same fault.
    let base = load_of("t,acceleration (g)", "kind = \"base\"\nacceleration = [1, 0]");
    let mut scenario = base.unwrap_or_else(|faults| panic!("{faults}"));
    let field = scenario.field("load.quake.acceleration[0]").unwrap();
    scenario.set_number(&field, 9.81).unwrap();
    let set = scenario.compile().map(|_| ()).unwrap_err().coded();
    assert!(set.contains(expected), "{set}");
    scenario.set_number(&field, -1.0).unwrap();
    assert!(scenario.compile().is_ok());
    let length = reported("t,x (mm)", "kind = \"base\"\nacceleration = [1, 0]");
    let expected = "a header in \"mm\", which is a length (m), in line 1 of \"record.csv\", expected a CSV file with two columns, time (s) and \
                    value or acceleration (m/s^2)";
    assert!(length.contains(expected), "{length}");
    let gravity = reported("t,acc (m/s^2)", "kind = \"gravity\"\nacceleration = [1, 0]");
    assert!(gravity.contains("a header in \"m/s^2\", which is an acceleration"), "{gravity}");
}
