//! A run on disk, as `percuss run` leaves it.

use std::path::{Path, PathBuf};

use percuss::RunSummary;
use percuss_output::fields::{self, Fields};
use percuss_output::report::{self, ReportData};
use percuss_output::{
    Error, Extent, HistoryFormat, HistoryWriter, RunDirectory, write_envelopes, write_impacts,
    write_new, write_summary,
};
use serde_json::Value;

use crate::error::Refusal;

/// What a run left besides its history.
pub struct Left<'a> {
    pub run: &'a RunSummary,
    pub summary: &'a Value,
    pub fields: &'a Fields,
}

/// A directory of results being filled.
pub struct Directory {
    directory: RunDirectory,
    report: bool,
}

impl Directory {
    /// Prepares it; `scenario` is the text with every default written out.
    pub fn create(target: &Path, scenario: &str, report: bool) -> Result<Self, Refusal> {
        let directory = RunDirectory::create(target)?;
        let file = directory.path().join("scenario.toml");
        write_new(&file, scenario.as_bytes()).map_err(|error| {
            Refusal::System(format!("{}: cannot write: {error}", file.display()))
        })?;
        Ok(Self { directory, report })
    }

    /// What writes its history.
    pub fn history(&self, scenario: String) -> HistoryWriter {
        HistoryWriter::new(self.directory.path(), HistoryFormat::Parquet, scenario)
    }

    /// Completes it and puts it in place.
    pub fn finish(self, history: HistoryWriter, left: Left<'_>) -> Result<PathBuf, Error> {
        let Left { run, summary, fields } = left;
        let dir = self.directory.path();
        history.finish()?;
        write_summary(dir, summary)?;
        write_envelopes(dir, &run.section_forces)?;
        write_impacts(dir, &run.contacts, &run.supports)?;
        if !fields.frames.is_empty() {
            fields::write(dir, fields)?;
        }
        if self.report {
            report::write(dir, &ReportData::read(dir)?)?;
        }
        let whole = matches!(run.termination, percuss::Termination::Completed);
        let extent = if whole { Extent::Complete } else { Extent::Partial };
        Ok(self.directory.commit_as(extent)?.place)
    }
}
