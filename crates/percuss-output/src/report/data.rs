//! What a report is made of, read from the directory of a run.

use std::path::Path;

use serde_json::Value;

use crate::comparison::{ComparisonSeries, read_comparison};
use crate::envelopes::{BeamEnvelope, read_envelopes};
use crate::error::Error;
use crate::fields::{self, Fields};
use crate::files;
use crate::history::{HistoryReader, HistorySource};
use crate::summary::read_summary;

/// What a report is made of.
#[derive(Clone, Debug, Default)]
pub struct ReportData {
    /// The history; of a file only what the figures draw is read, piece by piece.
    pub history: HistorySource,
    /// The content of `summary.json`.
    pub summary: Value,
    /// The text of `scenario.toml`; may be empty.
    pub scenario: String,
    /// Total energies of other restitution coefficients; may be empty, shape (coefficients).
    pub comparison: Vec<ComparisonSeries>,
    /// Section forces along the beams; may be empty, shape (beams).
    pub envelopes: Vec<BeamEnvelope>,
    /// How the scene moved, if that was kept.
    pub fields: Option<Fields>,
}

impl ReportData {
    /// Reads what [`write`](super::write()) needs from the directory of a run; the rows of the history stay there
    /// until then.
    ///
    /// # Errors
    /// If the summary or the history is missing or damaged.
    pub fn read(dir: impl AsRef<Path>) -> Result<Self, Error> {
        let dir = dir.as_ref();
        let scenario = dir.join("scenario.toml");
        Ok(Self {
            summary: read_summary(dir)?,
            history: HistorySource::File(HistoryReader::open(dir)?),
            scenario: if scenario.is_file() { files::read_text(&scenario)? } else { String::new() },
            comparison: read_comparison(dir)?,
            envelopes: read_envelopes(dir)?,
            fields: fields::read(dir)?,
        })
    }
}
