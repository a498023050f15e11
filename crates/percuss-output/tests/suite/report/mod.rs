//! The page and the pictures.

mod figures;
mod files;
mod tables;
mod untrusted;

use crate::synthetic;

use std::error::Error;
use std::fs;

use percuss::{MemoryRecorder, RecorderError, Settings};
use percuss_output::report::{self, ReportData};
use percuss_output::{
    BeamEnvelope, Channel, ComparisonSeries, History, HistoryFormat, HistorySource, HistoryWriter,
    RunInfo, read_comparison, read_envelopes, summary_value, write_comparison, write_envelopes,
    write_summary,
};
use serde_json::{Value, json};

type Outcome = Result<(), RecorderError>;

fn rigid() -> Result<ReportData, RecorderError> {
    let mut recorder = MemoryRecorder::default();
    synthetic::rigid(&mut recorder, "hammer", 300, 1.0)?;
    let history = History::from(&recorder);
    let comparison =
        ComparisonSeries::from_history("restitution 1", &history).into_iter().collect();
    let run = synthetic::summary("hammer", synthetic::impacts(250));
    let settings = Settings::new(0.02, 1e-5);
    let (advice, comparisons) = (synthetic::advice("hammer"), synthetic::comparisons("hammer"));
    let info = RunInfo {
        title: "Hammer",
        settings: &settings,
        wall_seconds: 0.1,
        advice: &advice,
        warnings: &[],
        comparisons: &comparisons,
    };
    let summary = summary_value(&run, info);
    let envelopes = vec![envelope("girder", 1.0)];
    let scenario = "[beam]\n".to_owned();
    Ok(ReportData {
        history: history.into(),
        summary,
        scenario,
        comparison,
        envelopes,
        fields: None,
    })
}

fn envelope(name: &str, size: f64) -> BeamEnvelope {
    let envelope = synthetic::section_forces(name, size).envelope;
    BeamEnvelope { name: name.to_owned(), envelope }
}

/// The history of data that are in memory.
fn memory(data: &mut ReportData) -> &mut History {
    if !matches!(data.history, HistorySource::Memory(_)) {
        data.history = HistorySource::default();
    }
    match &mut data.history {
        HistorySource::Memory(history) => history,
        HistorySource::File(_) => unreachable!("just replaced"),
    }
}

fn page(data: &ReportData) -> Result<String, Box<dyn Error + Send + Sync>> {
    let dir = tempfile::tempdir()?;
    report::write(dir.path(), data)?;
    Ok(fs::read_to_string(dir.path().join("report.html"))?)
}

/// The JSON index embedded in a page.
fn index(page: &str) -> Result<Value, RecorderError> {
    let start = page.find("id=\"percuss-index\">").ok_or("no index")? + 19;
    let end = page[start..].find("</script>").ok_or("no end")? + start;
    Ok(serde_json::from_str(&page[start..end])?)
}
