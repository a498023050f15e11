//! Reports of made-up runs, to look at: `cargo run --release --example sample_reports DIR`.

#[path = "../tests/synthetic/mod.rs"]
mod synthetic;

use std::path::{Path, PathBuf};
use std::time::Instant;

use percuss::{RecorderError, RunSummary, Settings};
use percuss_output::{
    ComparisonSeries, History, HistoryFormat, HistoryWriter, RunDirectory, RunInfo, report,
    summary_value, write_comparison, write_summary,
};

const SCENARIO: &str =
    "title = \"made up\" # </script> & <b>\n[projectile.hammer]\nkind = \"rigid\"\n";

fn main() -> Result<(), RecorderError> {
    let out = PathBuf::from(std::env::args().nth(1).ok_or("give a directory")?);
    sample(&out.join("elastic"), |w| synthetic::elastic(w, "mass", 1501, 0.15), elastic_summary())?;
    sample(&out.join("rigid"), |w| synthetic::rigid(w, "hammer", 2000, 1.0), rigid_summary())?;
    let rows = 1_000_001;
    sample(&out.join("million"), |w| synthetic::elastic(w, "mass", rows, 0.3), elastic_summary())?;
    Ok(())
}

fn elastic_summary() -> RunSummary {
    synthetic::summary("mass", synthetic::smooth())
}

fn rigid_summary() -> RunSummary {
    synthetic::summary("hammer", synthetic::impacts(250))
}

fn sample(
    out: &Path,
    record: impl Fn(&mut HistoryWriter) -> Result<(), RecorderError>,
    run: RunSummary,
) -> Result<(), RecorderError> {
    let dir = RunDirectory::create(out)?;
    std::fs::write(dir.path().join("scenario.toml"), SCENARIO)?;
    let mut writer = HistoryWriter::new(dir.path(), HistoryFormat::Parquet, SCENARIO);
    record(&mut writer)?;
    writer.finish()?;
    let title = format!("Made-up run \"{}\" <with markup> & accents", run.contacts[0].name);
    let settings = Settings::new(0.15, 1e-4);
    let info = RunInfo { title: &title, settings: &settings, wall_seconds: 0.0421 };
    write_summary(dir.path(), &summary_value(&run, info))?;
    if run.contacts[0].name == "hammer" {
        write_comparison(dir.path(), &comparison()?)?;
    }

    let start = Instant::now();
    let data = report::ReportData::read(dir.path())?;
    let read = start.elapsed();
    report::write(dir.path(), &data)?;
    let page = std::fs::metadata(dir.path().join("report.html"))?.len() as f64 / 1e6;
    println!(
        "{}: {} rows, read {:.0} ms, report {:.0} ms, page {page:.2} MB",
        out.display(),
        data.history.rows(),
        read.as_secs_f64() * 1e3,
        (start.elapsed() - read).as_secs_f64() * 1e3,
    );
    dir.commit()?;
    Ok(())
}

fn comparison() -> Result<Vec<ComparisonSeries>, RecorderError> {
    let mut all = Vec::new();
    for restitution in [1.0, 0.5, 0.0] {
        let mut recorder = percuss::MemoryRecorder::default();
        synthetic::rigid(&mut recorder, "hammer", 1000, restitution)?;
        let label = format!("restitution {restitution}");
        all.extend(ComparisonSeries::from_history(label, &History::from(&recorder)));
    }
    Ok(all)
}
