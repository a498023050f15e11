//! Fuzz targets, one function for each reader: each takes bytes and must return without a panic within limits of time and memory. `fuzz/` runs them
//! with libFuzzer; a test replays the stored corpus.

mod checkpoints;
mod files;
mod input;
mod runs;
mod texts;

pub use checkpoints::checkpoint;
pub use files::{csv_table, fields, history, record, summary};
pub use runs::run;
pub use texts::{fit, overrides, scenario, study, unit};

/// A function under test.
pub type Target = fn(&[u8]);

/// All targets with the names of their corpora.
pub const TARGETS: [(&str, Target); 12] = [
    ("scenario", scenario),
    ("study", study),
    ("fit", fit),
    ("unit", unit),
    ("overrides", overrides),
    ("csv_table", csv_table),
    ("record", record),
    ("summary", summary),
    ("history", history),
    ("fields", fields),
    ("run", run),
    ("checkpoint", checkpoint),
];
