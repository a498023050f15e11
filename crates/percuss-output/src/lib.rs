//! What a run leaves on disk: the history, the summary, the report and its pictures.
//!
//! This crate knows files, not the terminal. A run goes to a [`RunDirectory`], its rows through a
//! [`HistoryWriter`], its result through [`summary_value`] and [`write_summary`], and
//! [`report::write()`] makes the page and the pictures from what the files say.

pub mod checkpoint;
mod comparison;
mod csv_text;
mod directory;
mod envelopes;
mod equilibrium;
mod error;
pub mod fields;
mod files;
mod history;
mod impacts;
mod modes;
pub mod paraview;
mod path;
mod place;
pub mod report;
pub mod round_off;
mod shapes;
pub mod shock;
pub mod shown;
mod summary;
mod time_estimate;
mod unfinished;

pub use comparison::{ComparisonSeries, read_comparison, write_comparison};
pub use directory::{Extent, Placed, Results, RunDirectory, RunUpdate};
pub use envelopes::{BeamEnvelope, read_envelopes, write_envelopes};
pub use equilibrium::{EquilibriumInfo, equilibrium_value, write_equilibrium};
pub use error::Error;
pub use files::{create_new, write_new};
pub use history::{
    Channel, History, HistoryFile, HistoryFormat, HistoryReader, HistorySource, HistoryWriter,
    read as read_history,
};
pub use impacts::write_impacts;
pub use modes::{ModesInfo, modes_value, write_modes};
pub use path::{PathInfo, PathShapes, path_value, write_path};
pub use summary::{
    Picked, RunInfo, RunSource, SummaryPath, pick, pick_derivatives, read_summary,
    scenario_summary, summary_paths, summary_value, write_summary,
};
pub use time_estimate::TimeEstimate;
pub use unfinished::{Unfinished, unfinished};
