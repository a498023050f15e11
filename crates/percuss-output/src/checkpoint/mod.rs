//! Checkpoints on disk: what a run needs to go on after its process has ended, in the bits of one that never stopped.
//!
//! While a run steps they stand in a directory beside that of its results, `NAME.checkpoint`: `rows` holds the rows recorded so far,
//! appended to; `state` all else, replaced in one piece. A finished run that was asked for checkpoints keeps the one before its
//! last step among its results, from which it can be extended; its rows are those of the history.

mod fingerprint;
mod folder;
mod format;
mod rows;

pub use folder::CheckpointFolder;
pub use format::Saved;
pub use rows::Rows;

/// File of the last checkpoint among the results.
pub const KEPT: &str = "checkpoint";
