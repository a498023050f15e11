//! Histories written and read back.

use crate::synthetic;

use std::fs;

use percuss::{Channel, Recorder, RecorderError};
use percuss_output::{History, HistoryFormat, HistoryWriter, read_history};

type Outcome = Result<(), RecorderError>;

const FORMATS: [HistoryFormat; 2] = [HistoryFormat::Parquet, HistoryFormat::Csv];

fn awkward_channels() -> Vec<Channel> {
    ["time", "point.a,b \"c\".displacement_1", "energy.total"]
        .map(|name| Channel { name: name.into(), unit: "m", description: format!("Is {name}.") })
        .into()
}

const AWKWARD: [f64; 9] = [
    0.1,
    -0.0,
    f64::MIN_POSITIVE,
    5e-324,
    f64::MAX,
    1.0 / 3.0,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

#[test]
fn every_bit_comes_back() -> Outcome {
    for format in FORMATS {
        let dir = tempfile::tempdir()?;
        let mut writer = HistoryWriter::new(dir.path(), format, "");
        writer.begin(&awkward_channels())?;
        for (r, value) in AWKWARD.iter().enumerate() {
            writer.row(&[r as f64, *value, -value])?;
        }
        let file = writer.finish()?.ok_or("no file")?;
        assert_eq!(file.rows, AWKWARD.len());
        let history = read_history(dir.path())?;
        let bits = |column: &[f64]| column.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        let back = history.column("point.a,b \"c\".displacement_1").ok_or("no column")?;
        assert_eq!(bits(&back[..8]), bits(&AWKWARD[..8]), "{format:?}");
        assert!(back[8].is_nan());
        assert_eq!(history.channels[1].unit, "m");
        assert_eq!(history.channels[2].description, "Is energy.total.");
    }
    Ok(())
}

#[test]
fn many_row_groups_come_back_in_order() -> Outcome {
    let dir = tempfile::tempdir()?;
    let channels: Vec<Channel> = (0..300)
        .map(|k| Channel { name: format!("c.{k}"), unit: "1", description: String::new() })
        .collect();
    let mut writer = HistoryWriter::new(dir.path(), HistoryFormat::Parquet, "");
    writer.begin(&channels)?;
    let rows = 20_011;
    for r in 0..rows {
        writer.row(&(0..300).map(|k| f64::from(r * 300 + k)).collect::<Vec<_>>())?;
    }
    writer.finish()?;
    let history = read_history(dir.path())?;
    assert_eq!(history.rows(), rows as usize);
    for (k, column) in history.columns.iter().enumerate() {
        assert!(column.iter().enumerate().all(|(r, v)| *v == (r * 300 + k) as f64), "column {k}");
    }
    Ok(())
}

#[test]
fn no_half_file_bears_the_final_name() -> Outcome {
    for format in FORMATS {
        let dir = tempfile::tempdir()?;
        let mut writer = HistoryWriter::new(dir.path(), format, "");
        writer.begin(&awkward_channels())?;
        writer.row(&[0.0, 1.0, 2.0])?;
        assert!(!dir.path().join("history.parquet").exists());
        assert!(!dir.path().join("history.csv").exists());
        drop(writer); // as when the run ends by an error
        assert_eq!(read_history(dir.path())?.rows(), 1, "{format:?}");
        let left = fs::read_dir(dir.path())?.filter_map(Result::ok);
        assert!(left.map(|e| e.file_name()).all(|n| !n.to_string_lossy().contains("partial")));
    }
    Ok(())
}

#[test]
fn a_run_without_rows_leaves_no_history() -> Outcome {
    for format in FORMATS {
        let dir = tempfile::tempdir()?;
        let mut writer = HistoryWriter::new(dir.path(), format, "");
        writer.begin(&awkward_channels())?;
        assert_eq!(writer.finish()?, None);
        assert!(read_history(dir.path()).is_err());
    }
    Ok(())
}

#[test]
fn a_row_that_does_not_match_the_channels_is_an_error() -> Outcome {
    for format in FORMATS {
        let dir = tempfile::tempdir()?;
        let mut writer = HistoryWriter::new(dir.path(), format, "");
        assert!(writer.row(&[0.0]).is_err(), "before the channels");
        writer.begin(&awkward_channels())?;
        assert!(writer.row(&[0.0]).is_err(), "{format:?}");
    }
    Ok(())
}

#[test]
fn a_directory_that_is_not_there_is_named() {
    let mut writer = HistoryWriter::new("/nonexistent/run", HistoryFormat::Parquet, "");
    let error = writer.begin(&awkward_channels()).err().map(|e| e.to_string()).unwrap_or_default();
    assert!(error.contains("/nonexistent/run"), "{error}");
}

#[test]
fn damaged_files_are_errors_with_their_place() -> Outcome {
    let dir = tempfile::tempdir()?;
    let csv = dir.path().join("history.csv");
    for (text, place) in [
        ("time,x\n0,1\n1,two\n", "line 3"),
        ("time,x\n0,1,2\n", "line 2"),
        ("time,x\n0\n", "line 2"),
        ("", "empty"),
    ] {
        fs::write(&csv, text)?;
        let error = read_history(dir.path()).err().map(|e| e.to_string()).unwrap_or_default();
        assert!(error.contains(place) && error.contains("history.csv"), "{error}");
    }
    let mut writer = HistoryWriter::new(dir.path(), HistoryFormat::Parquet, "");
    synthetic::elastic(&mut writer, "mass", 500, 0.1)?;
    let path = writer.finish()?.ok_or("no file")?.path;
    let whole = fs::read(&path)?;
    for length in [0, 4, 100, whole.len() / 2, whole.len() - 9] {
        fs::write(&path, &whole[..length])?;
        assert!(read_history(dir.path()).is_err(), "cut at {length}");
    }
    Ok(())
}

#[test]
fn memory_and_disk_agree() -> Outcome {
    let dir = tempfile::tempdir()?;
    let mut memory = percuss::MemoryRecorder::default();
    synthetic::rigid(&mut memory, "hammer", 200, 0.5)?;
    let mut writer = HistoryWriter::new(dir.path(), HistoryFormat::Parquet, "");
    synthetic::rigid(&mut writer, "hammer", 200, 0.5)?;
    writer.finish()?;
    let (memory, disk) = (History::from(&memory), read_history(dir.path())?);
    assert_eq!(memory.channels, disk.channels);
    assert_eq!(memory.columns, disk.columns);
    Ok(())
}
