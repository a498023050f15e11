//! Files of output directories, and files that scenarios name.

use std::fs;
use std::path::Path;
use std::sync::Once;

use percuss_output::report::{ReportData, story, write};
use percuss_output::{HistoryReader, fields as fields_of, read_history};
use percuss_scenario::fit::Record;
use percuss_scenario::load;

/// Directories are created in memory if possible.
fn folder() -> tempfile::TempDir {
    let memory = Path::new("/dev/shm");
    match memory.is_dir() {
        true => tempfile::tempdir_in(memory),
        false => tempfile::tempdir(),
    }
    .expect("a temporary directory")
}

/// A table of a measured force that a scenario names.
pub fn csv_table(data: &[u8]) {
    const SCENARIO: &str = r#"
[material.m]
young = "1 GPa"
density = 1000
[section.s]
shape = "rectangle"
width = 0.1
depth = 0.1
[beam.b]
points = [[0, 0], [1, 0]]
elements = 2
material = "m"
section = "s"
[support.left]
at = "b.start"
kind = "clamp"
[load.measured]
kind = "point"
at = "b.end"
force = [0, 1]
function = { kind = "table", file = "pulse.csv" }
[time]
end = 0.01
step = 0.001
"#;
    static CHECKED: Once = Once::new();
    let answer = |data: &[u8]| {
        let dir = folder();
        fs::write(dir.path().join("pulse.csv"), data).expect("written");
        fs::write(dir.path().join("scenario.toml"), SCENARIO).expect("written");
        load(dir.path().join("scenario.toml")).and_then(|scenario| scenario.compile())
    };
    // Errors of the scenario would hide those of the table.
    CHECKED.call_once(|| {
        let _ = answer(b"0,0\n1,1\n").unwrap_or_else(|faults| panic!("{faults}"));
    });
    let _ = answer(data);
}

/// A record of measured curves that a fit names.
pub fn record(data: &[u8]) {
    let dir = folder();
    let path = dir.path().join("record.csv");
    fs::write(&path, data).expect("written");
    match Record::read(&path) {
        Err((found, expected)) => assert!(!found.is_empty() && !expected.is_empty()),
        Ok(record) => {
            let rows = record.columns.first().map_or(0, |column| column.values.len());
            assert!(record.columns.iter().all(|column| column.values.len() == rows));
            for column in &record.columns {
                let _ = record.column(&column.name);
                let _ = column.in_unit("s");
            }
        }
    }
}

/// `summary.json`: the summary text and the page made from it.
pub fn summary(data: &[u8]) {
    let Ok(summary) = serde_json::from_slice(data) else { return };
    let _ = story(&summary);
    let dir = folder();
    let page = ReportData { summary, ..ReportData::default() };
    write(dir.path(), &page).expect("a page of whatever it says");
}

/// `history.csv`, or `history.parquet` where the first byte is odd.
pub fn history(data: &[u8]) {
    let Some((kind, content)) = data.split_first() else { return };
    let dir = folder();
    let name = if kind % 2 == 1 { "history.parquet" } else { "history.csv" };
    fs::write(dir.path().join(name), content).expect("written");
    let _ = read_history(dir.path());
    let _ = HistoryReader::open(dir.path());
}

/// `fields/`: the scene up to the first zero byte, the frames after it.
pub fn fields(data: &[u8]) {
    let cut = data.iter().position(|b| *b == 0).unwrap_or(data.len());
    let dir = folder();
    let place = dir.path().join("fields");
    fs::create_dir(&place).expect("a directory");
    fs::write(place.join("scene.json"), &data[..cut]).expect("written");
    fs::write(place.join("frames.parquet"), data.get(cut + 1..).unwrap_or_default())
        .expect("written");
    let _ = fields_of::read(dir.path());
}
