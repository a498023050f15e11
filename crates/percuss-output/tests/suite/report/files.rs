//! Files of a run, read back for its report.

use super::*;

#[test]
fn a_comparison_reads_back() -> Outcome {
    let dir = tempfile::tempdir()?;
    assert!(read_comparison(dir.path())?.is_empty(), "none was written");
    let series = |label: &str, by: f64| ComparisonSeries {
        label: label.to_owned(),
        time: vec![0.0, 0.1, 0.30000000000000004],
        energy: vec![by, by / 3.0, by * 1e-20],
    };
    let written = vec![series("restitution 0.5", 1.0), series("with, \"commas\"", 2.0)];
    write_comparison(dir.path(), &written)?;
    assert_eq!(read_comparison(dir.path())?, written);
    fs::write(dir.path().join("comparison.csv"), "series,time,energy_total\na,0,b\n")?;
    assert!(read_comparison(dir.path()).is_err_and(|e| e.to_string().contains("line 2")));
    Ok(())
}

#[test]
fn a_report_from_files_is_that_from_memory() -> Outcome {
    for format in [HistoryFormat::Parquet, HistoryFormat::Csv] {
        let mut data = rigid()?;
        let dir = tempfile::tempdir()?;
        let mut writer = HistoryWriter::new(dir.path(), format, "");
        synthetic::rigid(&mut writer, "hammer", 300, 1.0)?;
        writer.finish()?;
        write_summary(dir.path(), &data.summary)?;
        write_comparison(dir.path(), &data.comparison)?;
        write_envelopes(dir.path(), &[synthetic::section_forces("girder", 1.0)])?;
        fs::write(dir.path().join("scenario.toml"), &data.scenario)?;
        let read = ReportData::read(dir.path())?;
        assert!(matches!(read.history, HistorySource::File(_)));
        data.summary = read.summary.clone(); // its last digits may have been rounded
        data.envelopes = read.envelopes.clone(); // the file has places of extremes, too
        assert!(page(&read)? == page(&data)?, "{format:?}");
    }
    Ok(())
}

#[test]
fn envelopes_read_back() -> Outcome {
    let dir = tempfile::tempdir()?;
    assert!(read_envelopes(dir.path())?.is_empty(), "none was written");
    let written =
        [synthetic::section_forces("a, \"b\"", 1.0), synthetic::section_forces("c", 1e-7)];
    write_envelopes(dir.path(), &written)?;
    let read = read_envelopes(dir.path())?;
    assert_eq!(read.len(), 2);
    for (read, written) in read.iter().zip(&written) {
        assert_eq!(read.name, written.name);
        // With the extremes of the beam, which the synthetic places do not have.
        let (found, known) = (&read.envelope, &written.envelope);
        assert!(found.s.is_sorted() && known.s.iter().all(|s| found.s.contains(s)));
        for (side, peak) in [written.moment.min, written.moment.max].iter().enumerate() {
            let own = &found.moment[side];
            assert!(known.moment[side].iter().all(|value| own.contains(value)));
            assert!(found.s.iter().zip(own).any(|(s, m)| *s == peak.s && *m == peak.value));
        }
        assert!(read.envelope.stress.iter().flatten().all(|v| v.is_nan()));
    }
    fs::write(dir.path().join("envelopes.csv"), "beam,s\n")?;
    assert!(read_envelopes(dir.path()).is_err_and(|e| e.is_content()));
    Ok(())
}
