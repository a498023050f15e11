//! Where a run comes from: what a reader needs to make it again.

use std::fs;
use std::time::SystemTime;

use chrono::{DateTime, SecondsFormat, Utc};
use serde_json::{Value, json};

/// Origin of a run.
#[derive(Clone, Copy, Debug)]
pub struct RunSource<'a> {
    /// Name of the scenario as it was given.
    pub scenario: &'a str,
    /// Changes, each as `path=value`, shape (changes).
    pub overrides: &'a [String],
    /// Start of the run.
    pub started: SystemTime,
}

impl RunSource<'_> {
    /// `provenance` of a summary: also the kind of machine.
    pub(super) fn value(&self) -> Value {
        let started = DateTime::<Utc>::from(self.started);
        json!({
            "scenario": self.scenario,
            "overrides": self.overrides,
            "started": started.to_rfc3339_opts(SecondsFormat::Secs, true),
            "machine": machine(),
        })
    }
}

/// System, architecture, and the processor where the system tells its name.
fn machine() -> String {
    let (system, architecture) = (std::env::consts::OS, std::env::consts::ARCH);
    match processor() {
        Some(name) => format!("{system} {architecture}, {name}"),
        None => format!("{system} {architecture}"),
    }
}

fn processor() -> Option<String> {
    let text = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}
