//! What hostile input is tried on, one function a reader: each takes bytes and must come back, without a panic, within bounds of
//! time and memory. `fuzz/` drives them with libFuzzer; a test replays the corpus that is kept.

mod checkpoints;
mod files;
mod input;
mod runs;
mod texts;

pub use checkpoints::checkpoint;
pub use files::{csv_table, fields, history, summary};
pub use runs::run;
pub use texts::{overrides, scenario, study, unit};

/// A function under test.
pub type Target = fn(&[u8]);

/// All of them with the names of their corpora.
pub const TARGETS: [(&str, Target); 10] = [
    ("scenario", scenario),
    ("study", study),
    ("unit", unit),
    ("overrides", overrides),
    ("csv_table", csv_table),
    ("summary", summary),
    ("history", history),
    ("fields", fields),
    ("run", run),
    ("checkpoint", checkpoint),
];
