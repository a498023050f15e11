//! The report of a run: one page and its pictures, made from the files of the run alone.

mod advice;
mod audit;
mod canvas;
mod contacts;
mod dashes;
mod data;
pub(crate) mod decimate;
mod draft;
mod envelopes;
mod extremes;
pub(crate) mod figure;
mod figures;
mod foundations;
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
mod state;
pub(crate) mod still;
mod story;
mod structure;
mod template;
mod thin;
mod warnings;
mod yields;

pub use data::ReportData;
pub use notebook::scene_page;
pub use scene::{instant, scene_choices, scene_colours, scene_scripts};
pub use state::RunState;
pub use story::{story, taken_as_start};

use std::path::Path;

use crate::error::Error;
use crate::files;

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
