//! The report of a run: one page and its pictures, made from the files of the run alone.

mod advice;
mod audit;
mod contacts;
mod dashes;
pub(crate) mod decimate;
mod draft;
mod envelopes;
mod extremes;
pub(crate) mod figure;
mod figures;
pub(crate) mod html;
mod impact;
mod log;
mod notebook;
pub(crate) mod page;
mod payload;
pub(crate) mod pictures;
mod png_file;
pub mod prints;
mod provenance;
pub(crate) mod quantity;
mod raster;
mod results;
mod scene;
pub mod sheet;
pub mod side_by_side;
pub(crate) mod still;
mod story;
mod structure;
mod thin;

pub use notebook::scene_page;
pub use scene::{scene_choices, scene_colours, scene_scripts};
pub use story::{story, told_as_start};

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
    /// Total energies of other restitution coefficients; may be empty.
    pub comparison: Vec<ComparisonSeries>,
    /// Section forces along the beams; may be empty.
    pub envelopes: Vec<BeamEnvelope>,
    /// How the scene moved, if that was kept.
    pub fields: Option<Fields>,
}

impl ReportData {
    /// Reads what [`write()`] needs from the directory of a run; the rows of the history stay there
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

/// Writes `report.html` into `dir`.
///
/// # Errors
/// If the history cannot be read or the file not written.
pub fn write(dir: impl AsRef<Path>, data: &ReportData) -> Result<(), Error> {
    write_page(dir.as_ref(), data, &figures::all(data)?)
}

/// Writes `report.html`, and `figures/` with every figure as SVG and PNG, into `dir`.
///
/// # Errors
/// If the history cannot be read, a file not written or a picture not drawn.
pub fn write_with_figures(dir: impl AsRef<Path>, data: &ReportData) -> Result<(), Error> {
    let figures = figures::all(data)?;
    write_page(dir.as_ref(), data, &figures)?;
    pictures::write(&dir.as_ref().join("figures"), &figures)
}

fn write_page(dir: &Path, data: &ReportData, figures: &[figure::Figure]) -> Result<(), Error> {
    files::write(&dir.join("report.html"), page::render(data, figures).as_bytes())
}
